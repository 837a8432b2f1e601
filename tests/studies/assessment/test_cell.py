"""Assessments in a cell: what is counted against plane geometry and coal, locks, folders, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

import cells
import holdfast as hf
import oracles
from holdfast.core.errors import InputError, StoreError
from holdfast.model.cell import Sphere

WIDTH = 0.03
DISCS = [("near", (0.9, 0.9), 0.3), ("far", (-0.6, 1.2), 0.25)]
REGION = hf.Region.box([0.6, 1.0, 0], [2.4, 1.6, 0], name="front")


@pytest.fixture(scope="module")
def arm():
    return hf.arms.load("planar-3r")


@pytest.fixture(scope="module")
def cell():
    return hf.Cell([Sphere(name, r, pose=cells.placed(*at, 0)) for name, at, r in DISCS], name="discs")


@pytest.fixture(scope="module")
def call(arm, cell):
    clearance = hf.Clearance(arm, hf.Capsules.along_links(arm, WIDTH), itself=False)
    return {"region": REGION, "task": "planar", "poses": 500, "seed": 3, "clearance": clearance, "cell": cell}


@pytest.fixture(scope="module")
def run(arm, call):
    return hf.assess(arm, **call, optimise=True, after_lock=True)


def apart(q):
    """(N, 2) distance from each disc by plane geometry."""
    return np.stack([cells.from_disc([1, 1, 1], WIDTH, q, at, r) for _, at, r in DISCS], axis=1)


def test_what_is_hit_is_counted_by_object(run):
    rows, found = run.columns, run.collisions
    q, reached = rows["q"], np.isfinite(rows["index"])
    exact = apart(q[reached])
    # The spheres of a chain reach a tenth of its radius beyond it: the bound is lower, by no more than that.
    below, outside = exact - rows["from_each"][reached], exact > 0
    assert (rows["from_each"][reached][~outside] <= 0).all()
    assert below[outside].min() >= -1e-9
    assert below[outside].max() <= 0.1 * WIDTH + 1e-9
    np.testing.assert_array_equal(rows["clearance"][reached], rows["from_each"][reached].min(axis=1))
    assert found.with_each == {name: int(n) for (name, *_), n in zip(DISCS, (rows["from_each"] < 0).sum(axis=0), strict=True)}
    assert found.found == (rows["from_each"][reached].min(axis=1) < 0).sum() > 20
    assert sum(found.blocked_by.values()) == found.blocked > 20
    assert (rows["blocked_by"] >= 0).sum() == found.blocked
    best = np.isfinite(rows["optimised_index"])
    assert apart(rows["optimised_q"][best]).min() >= 0


def every_clear(arm, point, joint=None, angle=0.0, extra=0.0):
    """Whether plane geometry has a clear configuration of a point, with a joint locked."""
    q = oracles.three_link_fibre(arm, point, 2000)
    if joint is not None:
        turned = (q[:, joint] - angle + np.pi) % (2 * np.pi) - np.pi
        q = q[np.abs(turned) < 2e-3]
    return bool(len(q)) and bool((apart(q).min(axis=1) >= extra).any())


def test_poses_reached_clear_are_those_that_plane_geometry_reaches(arm, run):
    rows = run.columns
    clear = rows["clear"] == 1
    exact = np.array([every_clear(arm, point) for point in rows["position"][:150]])
    assert not (clear[:150] & ~exact).any()
    sure = np.array([every_clear(arm, point, extra=0.02) for point in rows["position"][:150]])
    assert clear[:150][sure].mean() > 0.97
    share = run.reached_clear()
    assert share.value == clear.sum() / 500
    assert 0.3 < share.value < run.distribution.reached / 500
    np.testing.assert_array_equal(rows["clear"] == -1, ~np.isfinite(rows["index"]))


def test_what_survives_a_lock_does_so_clear_of_the_cell(arm, run, call):
    rows = run.columns
    left, angle = rows["survives"] == 1, rows["lock_angle"]
    assert not left[rows["clear"] != 1].any()
    free = hf.assess(arm, **{**call, "cell": None, "clearance": False}, after_lock=True)
    for name in arm.joint_names:
        assert run.survival(name)[name].value < free.survival(name)[name].value
    # With one joint locked two links are left: both elbows, in closed form, of every pose.
    for row in np.flatnonzero(rows["clear"] == 1)[:60]:
        q = with_first_locked(rows["position"][row, :2], angle[row, 0])
        inside = (np.abs(q) <= arm.upper).all(axis=1) & np.isfinite(q).all(axis=1)
        exact = inside & (apart(np.nan_to_num(q)).min(axis=1) >= 0)
        sure = inside & (apart(np.nan_to_num(q)).min(axis=1) >= 0.1 * WIDTH)
        assert sure.any() <= left[row, 0] <= exact.any()


def with_first_locked(point, angle):
    """The two configurations (2, 3) of a point with joint 1 locked, NaN where it is out of reach."""
    to = point - np.array([np.cos(angle), np.sin(angle)])
    with np.errstate(invalid="ignore"):
        elbow = np.arccos((to @ to - 2) / 2) * np.array([1.0, -1.0])
    second = np.arctan2(to[1], to[0]) - np.arctan2(np.sin(elbow), 1 + np.cos(elbow)) - angle
    return np.stack([np.full(2, angle), (second + np.pi) % (2 * np.pi) - np.pi, elbow], axis=1)


def test_a_panda_over_a_bench_is_counted_as_coal_counts(rng):
    arm, cell = hf.arms.load("panda"), cells.bench()
    run = hf.assess(arm, hf.Region.box([0.4, 0, 0.5], [0.8, 1.0, 0.8]), "manipulability", poses=300, cell=cell, clearance=False)
    rows = run.columns
    reached = np.isfinite(rows["index"])
    hit = cells.touches(arm, run.plan.clearance.capsules, cell, rows["q"][reached])
    said = rows["from_each"][reached] < 0
    assert run.plan.collision_partners == [solid.name for solid in cell]
    assert not (hit & ~said).any()
    assert hit.sum() > 20
    assert hit.sum() / said.sum() > 0.75


def test_a_folder_holds_the_cell_and_no_other_resumes_it(arm, cell, call, run, tmp_path):
    def stop(done, total):
        raise KeyboardInterrupt

    folder = tmp_path / "run"
    with pytest.raises(KeyboardInterrupt):
        hf.assess(arm, **call, optimise=True, after_lock=True, store=folder, progress=stop)
    other = hf.Cell([Sphere("near", 0.2, pose=cells.placed(0.9, 0.9, 0))], name="discs")
    with pytest.raises(StoreError, match=r"holds another run: its cell is .*discs.*, but .* was requested"):
        hf.assess(arm, **{**call, "cell": other}, optimise=True, after_lock=True, store=folder)
    whole = hf.assess(arm, **call, optimise=True, after_lock=True, store=folder)
    back = hf.load(folder)
    assert back.plan.cell.digest == cell.digest
    assert back.plan.clearance.itself is False
    for each in (whole, back):
        assert (each.collisions, each.clear, each.reached_clear()) == (run.collisions, run.clear, run.reached_clear())
        np.testing.assert_array_equal(each.columns["from_each"], run.columns["from_each"])


def test_a_mesh_that_changes_during_a_run_or_behind_it_is_seen(arm, call, tmp_path):
    points = tmp_path / "scan.npy"
    np.save(points, np.array([[0.9, 0.9, 0.0], [0.95, 0.9, 0.0]]))
    data = {"name": "scanned", "objects": {"scan": {"points": str(points), "radius": 0.05}}}
    cell = hf.Cell.from_dict(data)

    def change(done, total):
        np.save(points, np.array([[0.9, 0.9, 0.1], [0.95, 0.9, 0.0]]))

    with pytest.raises(InputError, match=r"scan\.npy.*changed"):
        hf.assess(arm, **{**call, "poses": 20, "cell": cell}, progress=change)


def test_what_is_asked_without_a_cell_is_refused(arm, call):
    plain = hf.assess(arm, **{**call, "poses": 10, "cell": None})
    with pytest.raises(InputError, match="no cell around the arm"):
        plain.reached_clear()
    assert "cell" not in plain.plan.to_dict()


def test_the_report_and_the_numbers_say_what_is_in_the_way(run, cell, tmp_path):
    said = run.to_dict()["clearance"]
    assert said["cell"]["sha256"] == cell.digest
    assert said["found_with"] == run.collisions.with_each
    assert said["reached_clear"]["value"] == run.reached_clear().value
    page = " ".join(run.report(tmp_path / "report.html").read_text().split())
    for part in (
        "Collisions of the arm with the cell",
        f"cell &#39;discs&#39; with 2 objects ({cell.digest[:12]}), distances from it are lower bounds",
        "Objects that the arm touches",
        "without collision with the cell",
        "--cell cell.yaml --no-clearance",
        "starts without collision with the cell (distances: lower bounds), so the fractions are lower bounds",
    ):
        assert part in page, part


def test_a_run_resumes_with_the_same_files_elsewhere(arm, call, tmp_path):
    def made(place, height=0.0):
        folder = tmp_path / place
        folder.mkdir()
        np.save(folder / "scan.npy", np.array([[0.9, 0.9, height], [0.95, 0.9, 0.0]]))
        (folder / "shape.yaml").write_text(f"radius: {WIDTH}\n")
        objects = {"scan": {"points": "scan.npy", "radius": 0.05}}
        return hf.Cell.from_dict({"name": "scanned", "objects": objects, "arm": {"shape": "shape.yaml"}}, folder)

    call = {**call, "poses": 20, "clearance": False, "store": tmp_path / "run"}
    first = hf.assess(arm, **call | {"cell": made("here")})
    again = hf.assess(arm, **call | {"cell": made("there")})
    np.testing.assert_array_equal(again.columns["q"], first.columns["q"])
    with pytest.raises(StoreError, match="holds another run: its cell is"):
        hf.assess(arm, **call | {"cell": made("else", height=0.1)})
