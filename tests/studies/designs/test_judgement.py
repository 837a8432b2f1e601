"""Arms judged as wholes, against brute force, order statistics and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import beta, binom

import holdfast as hf
import oracles


@pytest.fixture(scope="module")
def judged():
    arms = [hf.arms.load("planar-3r"), hf.designs.record_design("workspace-planar-3R-001").arm]
    return hf.designs.compare_arms(arms, task="planar", thresholds=(0.2, 0.4), level=0.8, poses=60, samples=3000, seed=5)


def column(judged, measure):
    return [k for k, c in enumerate(judged.columns) if c.measure == measure]


def test_fractions_of_the_joint_space(judged):
    for a, arm in enumerate(judged.arms):
        q = np.random.default_rng(5).uniform(-np.pi, np.pi, (3000, 3))
        j = oracles.task_jacobian(arm, q, "planar")
        value = oracles.index("relative-manipulability", j, [(0,), (1,), (2,)]).min(axis=1)
        for k, h in zip(column(judged, "fraction-above"), (0.2, 0.4), strict=True):
            hits = int((value >= h).sum())
            assert judged.values[a, k] == hits / 3000
            assert judged.low[a, k] == pytest.approx(beta.ppf(0.025, hits, 3000 - hits + 1))
            assert judged.high[a, k] == pytest.approx(beta.ppf(0.975, hits + 1, 3000 - hits))


def test_quantiles_over_the_region_are_order_statistics(judged):
    arm = judged.arms[0]
    poses = judged.region.poses(next(judged.region.blocks(0, 5, count=60))[:60])
    index = hf.indices.relative_manipulability(arm, "planar")
    best = hf.optimise(arm, poses, index, seed=5)
    low, high = binom.ppf([0.025, 0.975], 60, 0.2).astype(int)
    turns = [each.size / (2 * np.pi) for each in hf.solvers.fibres(arm, poses, "planar", starts=32, seed=5)]
    for k, values in (
        (column(judged, "quantile")[0], np.sort(np.where(best.success, best.value, 0))),
        (column(judged, "self-motion-size")[1], np.sort(turns)),
    ):
        assert judged.values[0, k] == pytest.approx(values[11])  # the twelfth of sixty
        assert judged.low[0, k] == pytest.approx(values[low - 1])
        assert judged.high[0, k] == pytest.approx(values[high])


def test_the_workspace_that_every_lock_leaves(judged):
    """Nothing, where equal links may lock folded; of two pairs of links what theorem W2 says."""
    (k,) = column(judged, "tolerant-workspace")
    assert judged.columns[k].samples == 0  # exact
    assert judged.values[0, k] == 0
    four = hf.designs.record_design("workspace-planar-4R-least-15-001").arm
    found = hf.designs.compare_arms(four, task="planar", measures=["tolerant-workspace"], points=60)
    assert found.columns[0].samples == 60
    assert found.low[0, 0] < 0.7**2 < found.high[0, 0]
    assert found.high[0, 0] - found.low[0, 0] < 0.4


def test_what_intervals_do_not_tell_apart_is_equal(judged):
    name = judged.columns[column(judged, "fraction-above")[0]].name
    (k,) = [c for c, x in enumerate(judged.columns) if x.name == name]
    order = judged.values[:, k].argmax()
    apart = judged.low[order, k] > judged.high[1 - order, k]
    assert judged.front(name).tolist() == ([order] if apart else [0, 1])
    with pytest.raises(hf.InputError, match="column 'speed' is not known"):
        judged.front("speed")


def test_what_cannot_be_judged(pa10):
    arm = hf.arms.load("planar-3r")
    for options, said in (
        ({"measures": ["speed"]}, "measure 'speed' is not known; use quantile"),
        ({"poses": 0}, "at least 1 pose"),
        ({"level": 1.0}, "a level between 0 and 1"),
    ):
        with pytest.raises(hf.InputError, match=said):
            hf.designs.compare_arms(arm, task="planar", **options)
    with pytest.raises(hf.InputError, match="no arm to compare"):
        hf.designs.compare_arms([])
    with pytest.raises(hf.TaskError, match="needs one degree of redundancy; here it is 3"):
        hf.designs.compare_arms(pa10, measures=["self-motion-size"])
