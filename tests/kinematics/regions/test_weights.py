"""Weighted samples against repeated ones, and regions that are a list, a function or a density against counting by hand."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats
from scipy.spatial.transform import Rotation

import holdfast as hf
from holdfast import Region
from holdfast.core.errors import InputError, StoreError
from holdfast.core.probability import Distribution, Interval
from holdfast.core.probability.collector import DistributionCollector
from holdfast.interface.presentation.commands import format_region_file

BOX = Region.box([1.2, 0.3, 0.0], [2.4, 2.4, 0.0])


@pytest.fixture(scope="module")
def arm():
    return hf.arms.load("planar-3r")


def random_poses(rng, count):
    t = np.tile(np.eye(4), (count, 1, 1))
    t[:, :2, 3] = rng.uniform(-2, 2, (count, 2))
    t[:, :3, :3] = Rotation.random(count, rng=rng).as_matrix()
    return t


# ---- statistics ----------------------------------------------------------------------------------------------------

numbers = st.one_of(st.sampled_from([0.0, 0.1, 0.2, 0.5, np.inf]), st.floats(0, 1, allow_subnormal=False))
weighted = st.lists(st.tuples(numbers, st.integers(0, 4)), min_size=1, max_size=25)


@settings(max_examples=80)
@given(weighted, st.lists(st.integers(0, 3), max_size=6), st.sampled_from(["larger", "smaller"]), st.booleans(), st.data())
def test_whole_weights_are_repetitions(found, lost, better, only, data):
    values, w = (np.array(x, dtype=float) for x in zip(*found, strict=True))
    if not w.sum():
        return
    d = Distribution.from_values(values, better, len(lost), singular=1, weights=w, unreached_weights=lost)
    again = Distribution.from_values(np.repeat(values, w.astype(int)), better, sum(lost), singular=1)
    h = np.r_[0, values[np.isfinite(values)], 0.15, 0.7]
    np.testing.assert_array_equal(d.cdf(h, only), again.cdf(h, only))
    p = np.r_[0, 1, data.draw(st.lists(st.floats(0, 1), max_size=6)), np.arange(1, 8) / 8]
    np.testing.assert_array_equal(d.quantile(p, only), again.quantile(p, only))
    np.testing.assert_allclose(d.mean, again.mean, rtol=1e-14)
    np.testing.assert_equal((d.lowest, d.highest), (again.lowest, again.highest))
    assert d.probability(at_least=0.15, reachable_only=only) == pytest.approx(again.probability(0.15, None, only), abs=1e-15)
    assert d.probability(at_most=0.15, reachable_only=only) == pytest.approx(again.probability(None, 0.15, only), abs=1e-15)
    for a, b in zip(d.density(7), again.density(7), strict=True):
        np.testing.assert_allclose(a, b, atol=1e-12)
    assert d.total_weight(only) == again.total_weight(only)
    assert d.effective(only) <= len(values) + (0 if only else len(lost)) + 1e-9


@pytest.mark.parametrize("weight", [1.0, 0.3, 7e5])
def test_equal_weights_are_none(rng, weight):
    values = np.r_[rng.random(500), np.zeros(20)]
    plain = Distribution.from_values(values, "larger", unreached=80)
    d = Distribution.from_values(
        values, "larger", 80, singular=0, weights=np.full(520, weight), unreached_weights=np.full(80, weight)
    )
    h, p = rng.random(50), np.r_[np.arange(1, 601) / 600, rng.random(50)]
    for only in (False, True):
        np.testing.assert_allclose(d.cdf(h, only), plain.cdf(h, only), rtol=1e-12)
        np.testing.assert_array_equal(d.quantile(p, only), plain.quantile(p, only))
        assert d.effective(only) == pytest.approx(plain.effective(only), rel=1e-12)
        assert d.band(0.9, only) == pytest.approx(plain.band(0.9, only), rel=1e-12)
        a, b = d.interval(at_least=0.4, reachable_only=only), plain.interval(at_least=0.4, reachable_only=only)
        np.testing.assert_allclose([a.value, a.low, a.high], [b.value, b.low, b.high], rtol=1e-10)
    assert d.mean == pytest.approx(plain.mean)
    assert (d.samples, d.reached, d.unreached) == (600, 520, 80)
    assert d.unreached_share == pytest.approx(80 / 600)


@pytest.mark.parametrize(("hits", "size"), [(0, 30), (30, 30), (7, 30), (400, 1000)])
def test_interval_of_a_share_is_that_of_a_count(hits, size):
    a, b = Interval.of_share(hits / size, size, 0.9), Interval.from_counts(hits, size, 0.9)
    np.testing.assert_allclose([a.value, a.low, a.high], [b.value, b.low, b.high], rtol=1e-10, atol=1e-15)


def test_effective_sample_size():
    """The total over the largest: half the weight on one of many samples leaves two."""
    d = Distribution.from_values(np.zeros(1001), "larger", weights=np.r_[1000.0, np.ones(1000)])
    assert d.effective() == pytest.approx(2)
    assert d.band() == pytest.approx(np.sqrt(np.log(40) / (2 * d.effective())))
    assert Distribution.from_values(np.zeros(5), "larger", unreached=2).effective() == 7


def test_weighted_intervals_cover_the_true_probability():
    generator, inside = np.random.default_rng(1965), 0
    for _ in range(400):
        x = generator.random(300)
        found = Distribution.from_values(x, "larger", weights=1 + 2 * x).interval(at_least=0.5)
        inside += found.low <= 5 / 8 <= found.high  # weight 1 + 2x: the upper half has 5/8 of it
    assert 0.915 <= inside / 400 <= 0.995


@pytest.mark.parametrize("bound", [1.0, None])
def test_bins_hold_weights_too(rng, bound):
    values, w, lost = rng.beta(2, 3, 60_000), rng.random(60_000), rng.random((10, 50))
    values[:20] = np.inf if bound is None else 0.0
    better = "smaller" if bound is None else "larger"
    few, many = DistributionCollector(better, bound, most=5000), DistributionCollector(better, bound, most=10**9)
    for part, weights, others in zip(np.split(values, 10), np.split(w, 10), lost, strict=True):
        for c in (few, many):
            c.add(part, 50, 0, weights, others)
    d, exact = few.make_distribution(), many.make_distribution()
    assert d.values is None
    assert d.has_weights
    np.testing.assert_array_equal(np.sort(values), exact.values)
    h, p = np.linspace(0, 1, 101), np.linspace(0.01, 0.98, 50)
    for only in (False, True):
        np.testing.assert_allclose(d.cdf(h, only), exact.cdf(h, only), atol=2e-4)
        np.testing.assert_allclose(d.quantile(p, only), exact.quantile(p, only), atol=2e-4)
        assert d.effective(only) == pytest.approx(exact.effective(only), rel=1e-10)
    assert d.mean == pytest.approx(exact.mean, rel=1e-10)
    assert (d.density(20)[1] * np.diff(d.density(20)[0])).sum() == pytest.approx(1, abs=1e-3)
    some = np.isfinite(values)
    share = w[(values >= 0.3) & some].sum() / (w.sum() + lost.sum())
    below = w[values < 0.3].sum() / (w.sum() + lost.sum())
    expected = share if better == "larger" else 1 - below
    assert d.probability(at_least=0.3) == pytest.approx(expected, abs=2e-4)


def test_nothing_has_a_weight():
    d = Distribution.from_values([0.1, 0.2], "larger", weights=[0, 0])
    for ask in (lambda: d.cdf(0.1), d.band, lambda: d.quantile(0.5), d.effective):
        with pytest.raises(InputError, match="weights of these samples are all 0"):
            ask()
    assert np.isnan(d.mean)


# ---- a list --------------------------------------------------------------------------------------------------------


def test_a_list_is_used_once_each_with_its_weights(arm, rng):
    poses, w = BOX.poses(next(BOX.blocks(0, 3))[:300]), rng.random(300)
    run = hf.assess(arm, Region.from_poses(poses, w), task="planar", after_lock=True)
    data = run.dataset
    np.testing.assert_array_equal(data["position"].values, poses[:, :3, 3])
    np.testing.assert_array_equal(data["weight"].values, w)
    index, worst = data["index"].values, data["worst"].values
    reached = data["status"].values == 0
    values = np.where(reached, index, 0.0)
    for h in (0.05, 0.2, 0.4):
        assert run.cdf(h) == pytest.approx(w[values < h].sum() / w.sum())
        assert run.probability(at_least=h) == pytest.approx(w[values >= h].sum() / w.sum())
    assert run.distribution.mean == pytest.approx(np.average(index[reached], weights=w[reached]))
    np.testing.assert_allclose(run.worst_counts, [w[reached & (worst == k)].sum() for k in range(3)])
    np.testing.assert_allclose(run.survivors, w @ (data["survives"].values == 1))
    shares, n = run.survival(), w.sum() / w.max()
    for k, share in enumerate(shares.values()):
        exact = Interval.of_share(run.survivors[k] / w.sum(), n)
        np.testing.assert_allclose([share.value, share.low, share.high], [exact.value, exact.low, exact.high], rtol=1e-12)
    assert run.distribution.effective() == pytest.approx(n)


def test_repeating_poses_is_weighting_them(arm, rng):
    """The rows of a repeated pose may differ (other random starts); a region's poses do not."""
    poses, w = random_poses(rng, 40), rng.integers(1, 5, 40)
    a = Region.from_poses(poses, w)
    b = Region.from_poses(np.repeat(poses, w, axis=0))
    once, again = next(a.blocks(0, 0, count=40)), next(b.blocks(0, 0, count=int(w.sum())))
    np.testing.assert_array_equal(np.repeat(a.poses(once), a.weights(once).astype(int), axis=0), b.poses(again))
    assert a.has_weights(40)
    assert not a.has_weights(41)
    assert not b.has_weights(int(w.sum()))


@pytest.mark.parametrize("sampling", ["random", "sobol"])
def test_more_poses_than_the_list_has_are_drawn_by_weight(arm, rng, sampling):
    poses, w = random_poses(rng, 5), np.array([0.0, 1.0, 2.0, 5.0, 0.0])
    run = hf.assess(arm, Region.from_poses(poses, w), task="planar", poses=2048, sampling=sampling, seed=4)
    assert "weight" not in run.dataset
    assert not run.distribution.has_weights
    place = np.abs(run.dataset["position"].values[:, None] - poses[None, :, :3, 3]).sum(axis=2).argmin(axis=1)
    counts = np.bincount(place, minlength=5)
    assert counts[0] == counts[4] == 0
    assert stats.chisquare(counts[1:4], 2048 * np.array([1, 2, 5]) / 8).pvalue > 1e-4


def test_a_list_in_a_folder_is_complete(arm, rng, tmp_path):
    region = Region.from_poses(random_poses(rng, 400), rng.random(400), name="job")
    first = hf.assess(arm, region, task="planar", store=tmp_path / "run")
    again = hf.load(tmp_path / "run")
    assert again.region == region
    assert again.poses == 400
    np.testing.assert_array_equal(again.worst_counts, first.worst_counts)
    h = np.linspace(0, 0.5, 30)
    np.testing.assert_array_equal(again.cdf(h), first.cdf(h))
    rows = hf.assess(arm, again.region, task="planar").dataset
    np.testing.assert_array_equal(rows["q"].values, first.dataset["q"].values)
    html = again.report(tmp_path / "report.html").read_text()
    assert "effective sample size" in html
    assert "each pose of the list once" in html
    with pytest.raises(StoreError, match="another run"):
        hf.assess(arm, Region.from_poses(random_poses(rng, 400)), task="planar", store=tmp_path / "run")


def test_a_table_of_poses_is_read_as_it_was_written(rng, tmp_path):
    region = Region.from_poses(random_poses(rng, 20), rng.random(20), name="job")
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "job.csv").write_text(region.listed.to_csv())
    (tmp_path / "job.yaml").write_text("poses: sub/job.csv\n")
    assert Region.load(tmp_path / "job.yaml") == region
    assert Region.from_dict(json.loads(json.dumps(region.to_dict()))) == region
    assert region.describe() == "a list of 20 poses, with weights"
    assert hash(region) == hash(Region.load(tmp_path / "job.yaml"))
    assert region != Region.from_poses(region.listed.pose_matrices(np.arange(20)))


def test_columns_may_come_in_any_order(tmp_path):
    (tmp_path / "a.csv").write_text("weight, qw,qx,qy,qz ,x,y,z\n2,1,0,0,0,1,2,3\n\n 4,0.7071,0,0,0.7071,1,2,4\n")
    (tmp_path / "a.yaml").write_text("name: two\nposes: a.csv")
    region = Region.load(tmp_path / "a.yaml")
    np.testing.assert_array_equal(region.listed.weights, [2, 4])
    t = region.poses(np.array([[0.0], [1.0]]))
    np.testing.assert_array_equal(t[:, :3, 3], [[1, 2, 3], [1, 2, 4]])
    np.testing.assert_allclose(t[1, :3, :3], [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=1e-12)


HEAD = "x,y,z,qx,qy,qz,qw\n"
BAD_TABLES = {
    "nothing": ("", "'x' is missing"),
    "no poses": (HEAD, "one line or more of finite numbers below the header"),
    "no header": ("0,0,0,0,0,0,1\n", "column '0'"),
    "unknown column": ("x,y,z,qx,qy,qz,qw,speed\n0,0,0,0,0,0,1,1\n", "'speed' is not known"),
    "twice": ("x,x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n", "'x' is given twice"),
    "missing": ("x,y,z,qx,qy,qz\n0,0,0,0,0,0\n", "'qw' is missing"),
    "short": (HEAD + "0,0,0,0,0,0,1\n0,0,0\n", "line 3: it must hold 7 numbers, got 0,0,0"),
    "word": (HEAD + "0,0,here,0,0,0,1\n", "line 2: it must hold 7 numbers, got 0,0,here"),
    "nan": (HEAD + "0,0,nan,0,0,0,1\n", "line 2: it holds NaN"),
    "quaternion": (HEAD + "0,0,0,0,0,0,1\n0,0,0,0,0,0,2\n", "quaternion of pose 2 has length 2"),
    "large quaternion": (HEAD + "0,0,0,0,0,1e308,1\n", "quaternion of pose 1 has length inf"),
    "negative": ("x,y,z,qx,qy,qz,qw,weight\n0,0,0,0,0,0,1,-1\n", "weight 1 is -1"),
    "no weight": ("x,y,z,qx,qy,qz,qw,weight\n0,0,0,0,0,0,1,0\n", "all weights are 0"),
}


@pytest.mark.parametrize("case", BAD_TABLES)
def test_a_bad_table_is_a_sentence(case, tmp_path):
    text, sentence = BAD_TABLES[case]
    (tmp_path / "a.csv").write_text(text)
    (tmp_path / "a.yaml").write_text("poses: a.csv")
    with pytest.raises(InputError, match=f"a.yaml.*a.csv.*{sentence}") as caught:
        Region.load(tmp_path / "a.yaml")
    assert "\n" not in str(caught.value)


def test_a_table_that_is_not_there(tmp_path):
    (tmp_path / "a.yaml").write_text("poses: b.csv")
    with pytest.raises(InputError, match=r"poses '.*b.csv' cannot be read \(No such file"):
        Region.load(tmp_path / "a.yaml")
    (tmp_path / "b.csv").write_bytes(b"\xff\xfe\x00x")
    with pytest.raises(InputError, match="is not a CSV file"):
        Region.load(tmp_path / "a.yaml")


def test_bad_lists_are_refused(rng):
    good = random_poses(rng, 3)
    broken = good.copy()
    broken[1, 0, 3] = np.nan
    for poses, weights, sentence in (
        (good[:0], None, "no poses"),
        (np.zeros((2, 3)), None, "shape"),
        (np.zeros((2, 4, 4)), None, "no rotation"),
        (broken, None, "pose 2 holds NaN"),
        ("abc", None, "poses is 'abc'; it must be numbers"),
        (good, [1, 2], r"shape \(2,\)"),
        (good, [1, -2, 1], "weight 2 is -2"),
        (good, [1, np.nan, 1], "weight 2 is nan"),
        (good, [0, 0, 0], "all weights are 0"),
        (good, ["a", "b", "c"], "must be numbers"),
    ):
        with pytest.raises(InputError, match=sentence):
            Region.from_poses(poses, weights)


# ---- a function ----------------------------------------------------------------------------------------------------


def ring(generator, count):
    angle, radius = generator.uniform(-np.pi, np.pi, count), generator.uniform(0.5, 3.5, count)
    t = np.tile(np.eye(4), (count, 1, 1))
    t[:, 0, 3], t[:, 1, 3] = radius * np.cos(angle), radius * np.sin(angle)
    return t


def test_a_sampler_draws_the_poses(arm, tmp_path):
    """Radius uniform in 0.5 to 3.5 m, the arm reaches 3 m: five poses of six; with weight r^2, (27 - 1/8)/(343/8 - 1/8)."""
    plain = hf.assess(arm, Region.sampler(ring), task="planar", poses=1500, seed=2)
    d = plain.distribution
    assert stats.binomtest(d.reached, 1500, 5 / 6).pvalue > 1e-4

    def heavy(generator, count):
        t = ring(generator, count)
        return t, np.square(t[:, :2, 3]).sum(axis=1)

    run = hf.assess(arm, Region.sampler(heavy, name="ring"), task="planar", poses=1500, seed=2)
    np.testing.assert_array_equal(run.dataset["position"].values, plain.dataset["position"].values)
    w = run.dataset["weight"].values
    np.testing.assert_allclose(w, np.square(run.dataset["position"].values[:, :2]).sum(axis=1))
    expected, n = (27 - 0.125) / (42.875 - 0.125), run.distribution.effective()
    assert 1 - run.distribution.unreached_share == pytest.approx(expected, abs=5 * np.sqrt(0.25 / n))
    for refused in (lambda: hf.assess(arm, run.region, task="planar", store=tmp_path / "x"), lambda: run.save(tmp_path / "x")):
        with pytest.raises(InputError, match="region 'ring' has a custom function"):
            refused()
    assert not (tmp_path / "x").exists()
    assert "keep the script" in run.report(tmp_path / "r.html").read_text()
    with pytest.raises(InputError, match="it must be 'random'"):
        hf.assess(arm, run.region, task="planar", sampling="sobol")


def test_a_sampler_is_the_same_whatever_was_drawn_before():
    region = Region.sampler(ring)
    stream = region.blocks(0, 7)
    next(stream)
    assert next(stream).tobytes() == next(region.blocks(1, 7)).tobytes()
    with pytest.raises(InputError, match="'sampler' is not known"):
        Region.from_dict(region.to_dict())


@pytest.mark.parametrize(
    ("draw", "sentence"),
    [
        (3, "must be a function"),
        (lambda g, n: np.zeros((n, 3)), "shape"),
        (lambda g, n: np.eye(4), "returned 1 poses; it must return 2"),
        (lambda g, n: np.full((n, 4, 4), np.nan), "finite"),
        (lambda g, n: (ring(g, n), np.full(n, -1.0)), "weight 1 is -1"),
        (lambda g, n: (ring(g, n), np.ones(n + 1)), "shape"),
        (lambda g, n: (ring(g, n), 1, 2), "pair of poses and weights"),
        (lambda g, n: "poses", "its sampler"),
    ],
)
def test_a_bad_sampler_is_refused_at_once(draw, sentence):
    with pytest.raises(InputError, match=sentence):
        Region.sampler(draw)


# ---- a density -----------------------------------------------------------------------------------------------------


def test_a_density_shifts_the_mean_as_the_integral_says(arm):
    """Reached are x <= 3 of x in 0 to 4 at y = 0 (all but rounding): uniform 3/4; weight 1 + x: (3 + 9/2)/(4 + 8)."""
    line = {"center": [2, 0, 0], "size": [4, 0, 0]}
    for weight in ({"x": [(0, 1), (4, 5)]}, lambda samples: 1 + samples[:, 0]):
        region = Region.box(**line, weight=weight)
        run = hf.assess(arm, region, task="planar", poses=2048, sampling="sobol")
        assert 1 - run.distribution.unreached_share == pytest.approx(7.5 / 12, abs=2e-3)
        assert run.probability(at_least=0) == 1
        # Of each sample E w / max w: the mean of 1 + x is 3, the largest, which the density knows and the function tells, 5.
        assert run.distribution.effective() / 2048 == pytest.approx(3 / 5, rel=0.01)
    plain = hf.assess(arm, Region.box(**line), task="planar", poses=2048, sampling="sobol")
    np.testing.assert_array_equal(plain.dataset["q"].values, run.dataset["q"].values)
    uniform = hf.assess(arm, Region.box(**line, weight={"x": [(0, 2)]}), task="planar", poses=2048, sampling="sobol")
    h = np.linspace(0, 0.5, 20)
    np.testing.assert_allclose(uniform.cdf(h), plain.cdf(h), rtol=1e-12)


def test_a_density_in_a_file(tmp_path):
    (tmp_path / "a.yaml").write_text(
        "angles: deg\n"
        "box: {center: [0, 0, 0], size: 1, rpy_size: 90, density: {z: [[0, 1], [0.5, 3]], yaw: [[-45, 0], [45, 1]]}}"
    )
    region = Region.load(tmp_path / "a.yaml")
    x = next(region.blocks(0, 1))
    expected = (1 + 4 * np.clip(x[:, 2], 0, 0.5)) * (x[:, 5] / (np.pi / 2) + 0.5)
    np.testing.assert_allclose(region.weights(x), expected, atol=1e-12)
    assert Region.from_dict(json.loads(json.dumps(region.to_dict()))) == region
    assert "weight by z 1 at 0 m, 3 at 0.5 m; roll 0 at -45 deg, 1 at 45 deg; linear between" in region.describe()
    (tmp_path / "b.yaml").write_text(format_region_file(region))
    np.testing.assert_allclose(Region.load(tmp_path / "b.yaml").weights(x), region.weights(x), rtol=1e-14)


@pytest.mark.parametrize(
    ("weight", "sentence"),
    [
        ({"w": [(0, 1)]}, "density of 'w' is not known"),
        ({"z": [(0, 1), (0, 2)]}, "must ascend"),
        ({"z": [(0, -1)]}, "0 or more"),
        ({"z": [(0, 0)]}, "above 0"),
        ({"z": []}, "points"),
        ({"z": [1, 2]}, "points"),
        ({"z": "high"}, "points"),
        ({}, "at least one"),
        (3, "must be a function"),
    ],
)
def test_bad_weights_of_a_box_are_refused(weight, sentence):
    with pytest.raises(InputError, match=sentence):
        Region.box([0, 0, 0], 1, weight=weight)


@pytest.mark.parametrize("weight", [lambda s: s[:, 0] - 5, lambda s: np.ones(3), lambda s: "a"])
def test_a_bad_weight_function_is_a_sentence(arm, weight):
    with pytest.raises(InputError, match="its weight function: weight"):
        hf.assess(arm, Region.box([1, 0, 0], 1, weight=weight), task="planar", poses=10)


def test_optimised_and_stored_runs_carry_weights(arm, tmp_path):
    region = Region.box([1.2, 0.3, 0.0], [2.4, 2.4, 0.0], weight={"x": [(0, 1), (2.4, 3)]})
    run = hf.assess(arm, region, task="planar", poses=300, optimise=True, store=tmp_path / "run")
    assert run.distribution_of(True).has_weights
    assert (run.cdf(0.3, optimised=True) <= run.cdf(0.3)).all()
    again = hf.load(tmp_path / "run")
    np.testing.assert_array_equal(again.optimised_worst_counts, run.optimised_worst_counts)
    assert again.distribution.effective() == run.distribution.effective()
