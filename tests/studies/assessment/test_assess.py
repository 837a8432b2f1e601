"""Assessment runs: the same rows whatever the threads, the folder or the interruption, and rows that are true."""

from __future__ import annotations

import itertools
import json

import casadi as ca
import numpy as np
import pytest
import xarray as xr
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast import Region, arms, assess, load
from holdfast.core.errors import HoldfastError, InputError, StoreError, TaskError
from holdfast.core.status import Status
from holdfast.kinematics.indices import CustomIndex, by_name
from holdfast.kinematics.regions.region import builtin_region
from holdfast.model.arm.task import as_task
from sealing import read_unsealed, write_sealed

PAPER = builtin_region("pa10-9dof")
FAR = Region.box([10, 0, 0], 0.1)
THREE = Region.joints([-2, -2, -2], [2, 2, 2])
LARGE = 300_000  # rows of a region of joints that fill several chunks


def columns(assessment) -> dict[str, np.ndarray]:
    return {str(name): v.values for name, v in assessment.dataset.data_vars.items()}


def identical(a, b, rows=None) -> None:
    assert set(a) == set(b)
    for name in a:
        assert a[name].dtype == b[name].dtype
        assert a[name][:rows].tobytes() == b[name][:rows].tobytes(), name


class Stop:
    """A progress callback that stops the run once ``after`` rows are done."""

    def __init__(self, after: int) -> None:
        self.after, self.calls = after, []

    def __call__(self, done: int, total: int) -> None:
        self.calls.append((done, total))
        if done >= self.after:
            raise KeyboardInterrupt


@pytest.fixture(scope="module")
def paper(pa10):
    """3000 poses of the paper's region with the paper's arm."""
    return assess(pa10, PAPER, poses=3000, seed=4)


@pytest.fixture(scope="module")
def three():
    return arms.load("planar-3r")


@pytest.fixture(scope="module")
def large(three):
    return assess(three, THREE, task="planar", poses=LARGE, seed=3)


# ---- the rows are true ---------------------------------------------------------------------------------------------


def test_every_reached_row_is_the_drawn_pose_within_the_limits(paper, pa10):
    rows = columns(paper)
    ok = rows["status"] == Status.OK
    assert ok.sum() > 2500
    q = rows["q"][ok]
    assert (q >= pa10.lower).all()
    assert (q <= pa10.upper).all()
    reached = oracles.forward(pa10, q)
    drawn = Rotation.from_quat(rows["quaternion"][ok]).as_matrix()
    assert np.linalg.norm(reached[:, :3, 3] - rows["position"][ok], axis=1).max() < 1e-6
    turn = Rotation.from_matrix(reached[:, :3, :3].transpose(0, 2, 1) @ drawn).magnitude()
    assert turn.max() < 1e-6


def test_every_reached_row_has_the_index_of_its_configuration(paper, pa10):
    rows = columns(paper)
    ok = rows["status"] == Status.OK
    j = oracles.jacobian(pa10, rows["q"][ok])
    tame = oracles.condition(j) < 1e4
    assert tame.all()
    expected = oracles.index("relative-manipulability", j, [[k] for k in range(9)])
    np.testing.assert_allclose(rows["by_failure"][ok], expected, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(rows["index"][ok], expected.min(1), rtol=1e-9)
    np.testing.assert_array_equal(rows["worst"][ok], expected.argmin(1))
    np.testing.assert_allclose((rows["by_failure"][ok] ** 2).sum(1), 3, atol=1e-9)


def test_the_poses_are_those_of_the_region(paper):
    rows = columns(paper)
    samples = np.concatenate(list(itertools.islice(PAPER.blocks(0, 4), 3)))[:3000]
    expected = PAPER.poses(samples)
    np.testing.assert_array_equal(rows["position"], expected[:, :3, 3])
    np.testing.assert_allclose(Rotation.from_quat(rows["quaternion"]).as_matrix(), expected[:, :3, :3], atol=1e-14)


def test_rows_not_found_are_nan_and_counted(paper):
    rows = columns(paper)
    lost = rows["status"] == Status.NOT_FOUND
    assert 0 < lost.sum() == paper.distribution.unreached
    assert set(np.unique(rows["status"])) <= {Status.OK, Status.NOT_FOUND, Status.SINGULAR}
    for name in ("q", "index", "by_failure"):
        assert np.isnan(rows[name][lost]).all()
        assert np.isfinite(rows[name][~lost]).all()
    assert (rows["worst"][lost] == -1).all()
    assert np.isfinite(rows["position"][lost]).all()
    d = paper.distribution
    assert (d.samples, d.reached) == (3000, 3000 - lost.sum())
    np.testing.assert_array_equal(paper.worst_counts, np.bincount(rows["worst"][~lost], minlength=9))


def test_the_distribution_is_that_of_the_rows(paper):
    rows = columns(paper)
    reached, everything = rows["index"][rows["status"] != Status.NOT_FOUND], np.nan_to_num(rows["index"], nan=0.0)
    h = np.linspace(0, 0.6, 30)
    np.testing.assert_array_equal(paper.cdf(h), (everything < h[:, None]).mean(1))
    np.testing.assert_array_equal(paper.cdf(h, reachable_only=True), (reached < h[:, None]).mean(1))
    assert paper.probability(at_least=0.2) == (everything >= 0.2).mean()
    assert paper.interval(at_least=0.2).low < (everything >= 0.2).mean() < paper.interval(at_least=0.2).high
    assert reached.max() <= paper.index.bound == pytest.approx(np.sqrt(3 / 9))
    assert (paper.poses, paper.seed, paper.complete, paper.store) == (3000, 4, True, None)


def test_statistics_of_the_paper_region(paper):
    """Specification, section 6. What inverse kinematics picks is ours, so of the index only the range is compared."""
    d = paper.distribution
    assert (
        0.074 - 0.011 - 2.6 * np.sqrt(0.074 * 0.926 / 3000)
        < d.unreached / d.samples
        < 0.074 + 0.011 + 2.6 * np.sqrt(0.074 * 0.926 / 3000)
    )
    low, middle, high = d.quantile([0.05, 0.5, 0.95])
    assert 0.02 < low < 0.1
    assert 0.15 < middle < 0.25
    assert 0.3 < high < 0.4
    assert 0.15 < d.mean < 0.25
    assert d.highest < 0.52


def test_unreached_poses_stay_unreached_with_more_starts(paper, pa10):
    rows = columns(paper)
    lost = np.flatnonzero(rows["status"] == Status.NOT_FOUND)[:60]
    poses = np.broadcast_to(np.eye(4), (len(lost), 4, 4)).copy()
    poses[:, :3, 3] = rows["position"][lost]
    poses[:, :3, :3] = Rotation.from_quat(rows["quaternion"][lost]).as_matrix()
    assert hf.solve_ik(pa10, poses, seed=77, restarts=300).success.sum() == 0


# ---- the same rows -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [1, 2, 3])
def test_threads_do_not_change_a_bit(count, paper, pa10, threads):
    threads(count)
    again = assess(pa10, PAPER, poses=3000, seed=4)
    identical(columns(again), columns(paper))
    np.testing.assert_array_equal(again.distribution.values, paper.distribution.values)


def test_another_seed_is_another_run(paper, pa10):
    other = assess(pa10, PAPER, poses=500, seed=5)
    assert not np.array_equal(columns(other)["position"], columns(paper)["position"][:500])


@pytest.mark.parametrize("sampling", ["random", "sobol"])
def test_a_shorter_run_is_the_beginning_of_a_longer_one(sampling, paper, pa10):
    longer = paper if sampling == "random" else assess(pa10, PAPER, poses=2500, seed=4, sampling="sobol")
    shorter = assess(pa10, PAPER, poses=1000, seed=4, sampling=sampling)
    assert len(columns(shorter)["index"]) == 1000
    identical(columns(shorter), columns(longer), 1000)


def test_a_folder_holds_the_same_rows(paper, pa10, tmp_path):
    stored = assess(pa10, PAPER, poses=3000, seed=4, store=tmp_path / "run")
    identical(columns(stored), columns(paper))
    identical(columns(load(tmp_path / "run")), columns(paper))
    np.testing.assert_array_equal(stored.worst_counts, paper.worst_counts)


@pytest.mark.parametrize("sampling", ["random", "sobol"])
def test_an_interrupted_run_goes_on_to_the_same_rows(sampling, pa10, tmp_path, threads):
    """9000 poses are two chunks; the second is computed by another call, with another number of threads."""
    call = {"poses": 9000, "seed": 1, "sampling": sampling, "restarts": 3}
    stop = Stop(1)
    with pytest.raises(KeyboardInterrupt):
        assess(pa10, PAPER, store=tmp_path / "run", progress=stop, **call)
    assert stop.calls == [(0, 9000), (8192, 9000)]
    part = load(tmp_path / "run")
    assert not part.complete
    assert part.distribution.samples == 8192
    assert (part.dataset["status"].values[8192:] == Status.NOT_COMPUTED).all()
    threads(1)
    calls = []
    whole = assess(pa10, PAPER, store=tmp_path / "run", progress=lambda *x: calls.append(x), **call)
    assert calls == [(8192, 9000), (9000, 9000)]
    assert whole.complete
    identical(columns(whole), columns(assess(pa10, PAPER, **call)))


def test_a_region_of_joints_goes_on_too(large, three, tmp_path):
    stop = Stop(200_000)
    with pytest.raises(KeyboardInterrupt):
        assess(three, THREE, task="planar", poses=LARGE, seed=3, store=tmp_path / "run", progress=stop)
    assert load(tmp_path / "run").distribution.samples == stop.calls[-1][0] == 262_144
    whole = assess(three, THREE, task="planar", poses=LARGE, seed=3, store=tmp_path / "run")
    identical(columns(whole), columns(large))
    np.testing.assert_array_equal(whole.distribution.values, large.distribution.values)
    np.testing.assert_array_equal(whole.worst_counts, large.worst_counts)


def test_a_stop_without_a_folder_passes_on(pa10):
    with pytest.raises(KeyboardInterrupt):
        assess(pa10, PAPER, poses=3000, progress=Stop(1))
    assert assess(pa10, PAPER, poses=10).distribution.samples == 10


def test_a_finished_run_keeps_its_record_when_it_is_called_again(three, tmp_path):
    assess(three, THREE, task="planar", poses=1000, store=tmp_path / "run")
    notes = dict(load(tmp_path / "run").store.notes)
    assert notes["seconds"] > 0
    assert notes["versions"]["numpy"] == np.__version__
    assert {"finished", "python", "machine", "threads"} <= set(notes)
    again = assess(three, THREE, task="planar", poses=1000, store=tmp_path / "run")
    assert again.complete
    assert load(tmp_path / "run").store.notes == notes


def test_a_run_stopped_before_its_first_chunk(three, tmp_path):
    with pytest.raises(KeyboardInterrupt):
        assess(three, THREE, task="planar", poses=1000, store=tmp_path / "run", progress=Stop(0))
    part = load(tmp_path / "run")
    assert (part.complete, part.distribution.samples, part.distribution.reached) == (False, 0, 0)
    with pytest.raises(InputError, match="no samples"):
        part.probability(at_least=0.1)
    assert assess(three, THREE, task="planar", poses=1000, store=tmp_path / "run").distribution.samples == 1000


# ---- other indices, regions and samplings --------------------------------------------------------------------------


def test_a_region_of_joints_is_evaluated_directly(large, three):
    rows = columns(large)
    assert set(rows) == {"q", "status", "index", "by_failure", "worst"}
    samples = np.concatenate(list(itertools.islice(THREE.blocks(0, 3), 19)))[:LARGE]
    np.testing.assert_array_equal(rows["q"], samples)
    pick = np.arange(0, LARGE, 1001)
    expected = oracles.index("relative-manipulability", oracles.task_jacobian(three, samples[pick], "planar"), [[0], [1], [2]])
    np.testing.assert_allclose(rows["by_failure"][pick], expected, rtol=1e-8, atol=1e-12)
    assert large.distribution.unreached == 0


def test_a_sobol_run(pa10, paper):
    run = assess(pa10, PAPER, poses=2048, seed=2, sampling="sobol")
    rows = columns(run)
    unit = (rows["position"] - np.array(PAPER.center[:3])) / 0.5 + 0.5
    assert all(np.unique(np.floor(unit[:, k] * 2048)).size == 2048 for k in range(3))
    assert run.distribution.unreached / 2048 == pytest.approx(paper.distribution.unreached / 3000, abs=0.02)
    assert run.distribution.mean == pytest.approx(paper.distribution.mean, abs=0.01)


def test_condition_numbers_are_better_when_smaller(pa10):
    run = assess(pa10, PAPER, "condition-number", poses=600, seed=1)
    rows = columns(run)
    ok = rows["status"] == Status.OK
    expected = oracles.index("condition-number", oracles.jacobian(pa10, rows["q"][ok]), [[k] for k in range(9)]).max(1)
    np.testing.assert_allclose(rows["index"][ok], expected, rtol=1e-8)
    everything = np.where(ok, rows["index"], np.inf)
    for h in (5, 20, 100):
        assert run.probability(at_most=h) == pytest.approx((everything <= h).mean())
        assert run.cdf(h) == pytest.approx((everything < h).mean())
    assert np.isinf(run.distribution.quantile(1.0, reachable_only=False))


def test_tasks_failures_and_mixed_joints(mixed8):
    region = Region.joints(np.full(8, -1.0), np.full(8, 1.0))
    index = by_name("minimum-singular-value", mixed8, "position", failures="pairs", length=0.5)
    run = assess(mixed8, region, index, poses=200)
    rows = columns(run)
    j = oracles.task_jacobian(mixed8, rows["q"], "position", length=0.5)
    expected = oracles.index("minimum-singular-value", j, index.failures)
    np.testing.assert_allclose(rows["by_failure"], expected, rtol=1e-8, atol=1e-10)
    assert rows["by_failure"].shape == (200, 28)


def test_singular_configurations_count_as_the_convention_says(flat4):
    straight = Region.joints([-1, 0, 0, 0], [1, 0, 0, 0])
    for name, value in (("relative-manipulability", 0.0), ("condition-number", np.inf)):
        run = assess(flat4, straight, name, poses=50, task="planar")
        d = run.distribution
        assert (d.singular, d.reached, d.unreached) == (50, 50, 0)
        assert (columns(run)["index"] == value).all()
        assert (columns(run)["status"] == Status.SINGULAR).all()
        assert run.worst_counts.sum() == 0
    assert assess(flat4, straight, poses=50, task="planar").probability(at_least=1e-9) == 0


def test_an_unreachable_region_is_an_answer(pa10, tmp_path):
    run = assess(pa10, FAR, poses=40, restarts=5, store=tmp_path / "far")
    assert (run.distribution.reached, run.distribution.unreached) == (0, 40)
    assert run.probability(at_least=0.1) == 0
    assert run.worst_counts.sum() == 0
    assert np.isnan(columns(run)["q"]).all()
    with pytest.raises(InputError, match="no pose was reached"):
        run.distribution.quantile(0.5)
    assert load(tmp_path / "far").distribution.unreached == 40


# ---- datasets and folders ------------------------------------------------------------------------------------------


def test_dataset_has_units_and_says_what_was_computed(paper, pa10, tmp_path):
    stored = assess(pa10, PAPER, poses=20, store=tmp_path / "run")
    for run in (paper, stored):
        data = run.dataset
        assert {n: data[n].attrs["units"] for n in data.data_vars} == {
            "position": "m",
            "quaternion": "1",
            "q": "rad or m",
            "status": "1",
            "index": "1",
            "by_failure": "1",
            "worst": "1",
        }
        assert all(data[n].attrs["long_name"] for n in data.data_vars)
        assert data["q"].dims == ("row", "joint")
        assert data["by_failure"].dims == ("row", "failure")
        assert data["position"].dims == ("row", "axis")
        plan = json.loads(data.attrs["plan"])
        assert plan["fingerprint"] == pa10.fingerprint
        assert plan["failures"] == [[name] for name in pa10.joint_names]


def test_xarray_opens_the_folder_by_itself(three, tmp_path):
    run = assess(three, THREE, task="planar", poses=1000, store=tmp_path / "run")
    with xr.open_zarr(tmp_path / "run" / "samples.zarr", consolidated=False, chunks=None) as data:
        assert data.sizes == {"row": 1000, "joint": 3, "failure": 3}
        for name, values in columns(run).items():
            np.testing.assert_array_equal(data[name].values, values)
        assert data["q"].attrs["units"] == "rad or m"
    plan = json.loads((tmp_path / "run" / "run.json").read_text())["plan"]
    assert (plan["seed"], plan["task"]["name"]) == (0, "planar")


def test_rows_that_are_not_kept(pa10, tmp_path):
    run = assess(pa10, PAPER, poses=50, keep=False)
    assert run.distribution.samples == 50
    for ask in (lambda: run.dataset, lambda: run.save(tmp_path / "x")):
        with pytest.raises(InputError, match="not kept"):
            ask()
    assert not (tmp_path / "x").exists()


def test_save_and_load(paper, tmp_path):
    folder = tmp_path / "a" / "run"
    files = [folder / "run.json", folder / "report.html"]
    assert paper.save(folder) == files
    assert all(file.exists() for file in files)
    back = load(folder)
    identical(columns(back), columns(paper))
    assert back.arm.fingerprint == paper.arm.fingerprint
    assert back.region == paper.region
    assert repr(back.index) == repr(paper.index)
    np.testing.assert_array_equal(back.distribution.values, paper.distribution.values)
    np.testing.assert_array_equal(back.worst_counts, paper.worst_counts)
    assert (back.poses, back.seed, back.sampling, back.restarts, back.complete) == (3000, 4, "random", 100, True)
    assert back.seconds == paper.seconds
    assert back.save(folder) == files
    assert paper.save(folder) == files
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "mine.txt").write_text("keep")
    with pytest.raises(StoreError, match="is not a holdfast run"):
        paper.save(tmp_path / "other")
    assert [p.name for p in (tmp_path / "other").iterdir()] == ["mine.txt"]


def test_save_and_load_of_mixed_arms_with_tasks_of_their_own(mixed8, tmp_path):
    region = Region.joints(np.full(8, -1.0), np.full(8, 1.0))
    index = by_name("manipulability", mixed8, ["vx", "wz"], failures=[["j1", "j2"], ["j5"]], length=0.3)
    run = assess(mixed8, region, index, poses=64)
    run.save(tmp_path / "run")
    back = load(tmp_path / "run")
    assert back.index.failures == ((1, 2), (5,))
    assert back.index.task.length == 0.3
    q = columns(run)["q"]
    np.testing.assert_array_equal(back.index.evaluate(q).by_failure, columns(run)["by_failure"])


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"seed": 1}, "its seed is 0, but 1 was requested"),
        ({"restarts": 7}, "its restarts is 100, but 7 was requested"),
        ({"sampling": "sobol"}, 'its sampling is "random", but "sobol" was requested'),
        ({"poses": 1001}, "it has 1000 rows .* 1001"),
        ({"index": "manipulability"}, "its index is"),
        ({"region": Region.joints([0, 0, 0], [1, 1, 1])}, "its region is"),
        ({"task": "planar-pose", "arm": "planar4"}, "its arm is"),
    ],
)
def test_a_folder_of_another_run_is_refused_and_left_alone(change, word, three, planar4, tmp_path):
    call = {"arm": three, "region": THREE, "task": "planar", "poses": 1000, "store": tmp_path / "run"}
    assess(**call)
    before = {p: p.read_bytes() for p in (tmp_path / "run").rglob("*") if p.is_file()}
    if "arm" in change:
        change = {"arm": planar4, "region": Region.joints([-1] * 4, [1] * 4)}
    with pytest.raises(StoreError, match=f"holds another run: {word}") as caught:
        assess(**{**call, **change})
    assert "\n" not in str(caught.value)
    assert {p: p.read_bytes() for p in (tmp_path / "run").rglob("*") if p.is_file()} == before


@pytest.mark.parametrize("name", ["index", "q", "by_failure", "worst", "status"])
def test_a_lost_chunk_of_any_variable_is_noticed(name, three, tmp_path):
    """A missing file reads as fill values: NaN must not count as a good index."""
    assess(three, THREE, task="planar", poses=1000, store=tmp_path / "run")
    lost = [p for p in (tmp_path / "run" / "samples.zarr" / name / "c").rglob("*") if p.is_file()]
    assert lost
    for p in lost:
        p.unlink()
    with pytest.raises(StoreError, match="damaged"):
        load(tmp_path / "run")


@pytest.mark.parametrize("name", ["index", "q", "by_failure", "worst", "status"])
def test_a_lost_column_is_noticed(name, three, tmp_path):
    assess(three, THREE, task="planar", poses=10, store=tmp_path / "run")
    file = tmp_path / "run" / "run.json"
    run = read_unsealed(file)
    run["columns"] = [c for c in run["columns"] if c[0] != name]
    write_sealed(file, run)
    with pytest.raises(StoreError, match=f"its column '{name}' is lost"):
        load(tmp_path / "run")


def test_a_lost_chunk_of_poses_is_noticed(pa10, tmp_path):
    assess(pa10, PAPER, poses=20, store=tmp_path / "run")
    for p in (tmp_path / "run" / "samples.zarr" / "position" / "c").rglob("*"):
        if p.is_file():
            p.unlink()
    with pytest.raises(StoreError, match="damaged"):
        load(tmp_path / "run")


@pytest.mark.parametrize("name", ["index", "q", "by_failure", "worst"])
@pytest.mark.parametrize("how", ["cut", "flipped", "array gone"])
def test_a_damaged_array_is_noticed(name, how, three, tmp_path):
    folder = tmp_path / "run"
    assess(three, THREE, task="planar", poses=20_000, store=folder)
    array = folder / "samples.zarr" / name
    chunk = next(p for p in (array / "c").rglob("*") if p.is_file())
    raw = bytearray(chunk.read_bytes())
    if how == "cut":
        chunk.write_bytes(raw[: len(raw) // 2])
    elif how == "flipped":
        for k in range(len(raw) // 2, len(raw) // 2 + 8):
            raw[k] ^= 0xFF
        chunk.write_bytes(raw)
    else:
        for p in sorted(array.rglob("*"), reverse=True):
            p.unlink() if p.is_file() else p.rmdir()
        array.rmdir()
    with pytest.raises(StoreError) as caught:
        load(folder)
    assert "damaged" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("key", ["kind", "arm", "region", "index", "task", "failures", "seed", "sampling", "restarts"])
def test_a_plan_without_a_part_is_called_damaged_or_foreign(key, three, tmp_path):
    assess(three, THREE, task="planar", poses=10, store=tmp_path / "run")
    file = tmp_path / "run" / "run.json"
    run = read_unsealed(file)
    del run["plan"][key]
    write_sealed(file, run)
    with pytest.raises(StoreError, match="not an assessment" if key == "kind" else f"damaged.*{key}"):
        load(tmp_path / "run")


@pytest.mark.parametrize(
    "change",
    [
        lambda plan: plan["arm"].update(base=[[1], [1, 2]]),
        lambda plan: plan["arm"]["joints"][0].update(axis="x"),
        lambda plan: plan.update(arm=None),
        lambda plan: plan["region"].update(center=3),
        lambda plan: plan["region"].update(kind="ball"),
        lambda plan: plan["task"].update(rows=[[1, 2]]),
        lambda plan: plan.update(index="charm"),
        lambda plan: plan.update(failures=[["nobody"]]),
    ],
)
def test_a_plan_with_nonsense_gives_a_sentence(change, three, tmp_path):
    assess(three, THREE, task="planar", poses=10, store=tmp_path / "run")
    file = tmp_path / "run" / "run.json"
    run = read_unsealed(file)
    change(run["plan"])
    write_sealed(file, run)
    with pytest.raises(HoldfastError) as caught:
        load(tmp_path / "run")
    assert "\n" not in str(caught.value)


# ---- what is refused -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"poses": 0}, "poses is 0; it must be 1 or more"),
        ({"poses": -5}, "poses is -5"),
        ({"poses": 10.5}, "poses is 10.5"),
        ({"restarts": 0}, "restarts is 0"),
        ({"seed": -1}, "seed is -1"),
        ({"seed": 1.5}, "seed is 1.5"),
        ({"seed": None}, "seed is None"),
        ({"sampling": "grid"}, "sampling 'grid' is not known; use 'random' or 'sobol'"),
        ({"index": "charm"}, "index 'charm' is not known"),
        ({"task": "dance"}, "task 'dance' is not known"),
        ({"region": Region.joints([0], [1])}, "the region has 1 joints, 'planar-3r' has 3"),
    ],
)
def test_bad_options_are_refused_before_anything_is_written(options, sentence, three, tmp_path):
    call = {"region": THREE, "task": "planar", "poses": 10, "store": tmp_path / "run", **options}
    with pytest.raises(HoldfastError, match=sentence):
        assess(three, **call)
    assert not (tmp_path / "run").exists()


def test_numpy_integers_are_integers(three, tmp_path):
    run = assess(
        three, THREE, task="planar", poses=np.int64(10), seed=np.int64(2), restarts=np.int32(3), store=tmp_path / "run"
    )
    identical(columns(run), columns(assess(three, THREE, task="planar", poses=10, seed=2, restarts=3)))
    assert load(tmp_path / "run").seed == 2


def test_arms_and_indices_that_do_not_belong_together_are_refused(three, pa10):
    with pytest.raises(InputError, match="belongs to 'table-1', not to 'planar-3r'"):
        assess(three, THREE, by_name("manipulability", pa10))
    with pytest.raises(TaskError, match="not redundant"):
        assess(arms.load("ur5"), FAR)


def test_an_index_of_ones_own_stays_in_memory(three, tmp_path):
    mine = CustomIndex(lambda j: -ca.sumsqr(j), three, "planar", name="minus sum")
    run = assess(three, THREE, mine, poses=100)
    j = oracles.task_jacobian(three, columns(run)["q"], "planar")
    expected = [[-(np.delete(x, k, 1) ** 2).sum() for k in range(3)] for x in j]
    np.testing.assert_allclose(columns(run)["by_failure"], expected, rtol=1e-9)
    assert run.distribution.highest < 0
    for refused in (lambda: assess(three, THREE, mine, poses=10, store=tmp_path / "run"), lambda: run.save(tmp_path / "run")):
        with pytest.raises(InputError, match="your own"):
            refused()
    assert not (tmp_path / "run").exists()


# ---- what was asked twice --------------------------------------------------------------------------------------------


def test_a_task_that_is_not_that_of_the_index_is_refused(three):
    """It was ignored without a word."""
    index = by_name("manipulability", three, "planar")
    with pytest.raises(InputError, match=r"index is for task planar \(2 rows\), asked for is position \(3 rows\)"):
        assess(three, THREE, index, poses=5, task="position")
    same = assess(three, THREE, index, poses=5, task="planar")
    assert same.index is index
    assert assess(three, THREE, index, poses=5, task=["vx", "vy"]).distribution.total == same.distribution.total


def test_a_task_of_another_length_is_refused(pa10):
    index = by_name("manipulability", pa10, "pose", length=0.5)
    assert assess(pa10, PAPER, index, poses=2, task="pose").index.task.length == 0.5
    with pytest.raises(InputError, match=r"characteristic length 0.5 m, asked for is .* characteristic length 2 m"):
        assess(pa10, PAPER, index, poses=2, task=as_task(pa10, "pose", 2.0))


def test_what_it_says_in_sentences(three, tmp_path):
    whole = assess(three, THREE, task="planar", poses=100)
    headline, arm, region = whole.describe()
    p = whole.probability(at_least=whole.default_threshold())
    assert headline.startswith(f"With probability {p:.2f}")
    assert "planar-3r" in arm
    assert THREE.describe() in region

    def stop(done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        assess(three, THREE, task="planar", poses=10, store=tmp_path / "run", progress=stop)
    headline, *_, notice = load(tmp_path / "run").describe()
    assert headline == "Nothing has been computed yet."
    assert notice.startswith("This run is not complete: 0 of 10 configurations are computed")


def test_the_region_of_an_arm_is_that_of_the_command_line():
    # A built-in arm by its numbers, whoever loaded it; the paper's arm in the paper's region.
    pa10 = hf.arms.load("pa10-9dof")
    assert hf.assess(pa10, poses=4, seed=1).region.name == "Abdi et al. 2012, section V.B"
    assert hf.assess(hf.arms.load("planar-3r"), task="planar", poses=4, seed=1).region.name == "default region"
