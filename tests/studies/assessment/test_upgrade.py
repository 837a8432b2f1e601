"""Which joint deserves a redundant motor or brake, against the worst case worked out again from the rows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binomtest

import holdfast as hf
import oracles
from holdfast.core.probability.distribution import Distribution
from holdfast.kinematics.regions.region import builtin_region

PAPER = builtin_region("pa10-9dof")


@pytest.fixture(scope="module")
def run(pa10):
    return hf.assess(pa10, PAPER, poses=120, seed=2, optimise=True)


def rows(run, optimised):
    """The index after each failure, 0 where there is no configuration, from the configurations alone."""
    q = run.dataset["optimised_q" if optimised else "q"].values
    found = np.zeros(q.shape)
    ok = np.isfinite(q).all(1)
    j = oracles.jacobian(run.arm, q[ok])
    found[ok] = oracles.index("relative-manipulability", j, [[k] for k in range(run.arm.n)])
    return found


def test_the_distribution_without_a_joint_is_the_worst_case_over_the_others(run):
    by_failure = rows(run, False)
    h = np.linspace(0.013, 0.6, 30)
    for k, name in enumerate(run.arm.joint_names):
        value = np.delete(by_failure, k, axis=1).min(1)
        d = run.if_never_fails(name)
        assert (d.samples, d.unreached) == (120, run.distribution.unreached)
        np.testing.assert_array_equal(d.cdf(h), (value < h[:, None]).mean(1))
        np.testing.assert_array_equal(run.if_never_fails(k).values, d.values)


@pytest.mark.parametrize("threshold", [0.1, 0.25, None])
def test_gains_are_ranked_paired_fractions(run, threshold):
    found = run.upgrades(threshold)
    h = 0.29 if threshold is None else threshold
    by_failure = rows(run, False)
    before = by_failure.min(1) >= h
    assert [u.gain for u in found] == sorted((u.gain for u in found), reverse=True)
    assert sorted(u.joint for u in found) == sorted(run.arm.joint_names)
    for u in found:
        after = np.delete(by_failure, run.arm.joint_index(u.joint), axis=1).min(1) >= h
        gained = int((after & ~before).sum())
        assert not (before & ~after).any()
        assert u.before == pytest.approx(before.mean(), abs=1e-15)
        assert u.after == pytest.approx(after.mean(), abs=1e-15)
        limits = binomtest(gained, 120).proportion_ci(0.95, "exact")
        np.testing.assert_allclose([u.gain, u.low, u.high], [gained / 120, limits.low, limits.high], atol=1e-12)


def test_the_interval_covers_a_paired_bootstrap(run, rng):
    """Resampling whole poses: the spread of the gain is that of its interval."""
    u = run.upgrades(0.2)[0]
    by_failure = rows(run, False)
    k = run.arm.joint_index(u.joint)
    change = (np.delete(by_failure, k, 1).min(1) >= 0.2).astype(float) - (by_failure.min(1) >= 0.2)
    draws = change[rng.integers(120, size=(4000, 120))].mean(1)
    np.testing.assert_allclose([u.low, u.high], np.quantile(draws, [0.025, 0.975]), atol=0.03)


def test_by_hand(pa10):
    """Three configurations of a condition number, of which smaller is better: one row per case."""
    arm = hf.arms.load("planar-3r")
    region = hf.Region.joints([0.3] * 3, [1.2] * 3)
    run = hf.assess(arm, region, "condition-number", task="planar", poses=3)
    made = dict(run._rows)
    made["by_failure"] = np.array([[9.0, 2.0, 3.0], [5.0, 1.0, 8.0], [1.0, 1.0, 2.0]])
    made["index"] = made["by_failure"].max(1)
    distribution = Distribution.from_values(made["index"], "smaller")
    run = replace(run, distribution=distribution, _rows=made)
    found = {u.joint: u for u in run.upgrades(4.0)}
    a, b, c = arm.joint_names
    assert [found[x].before for x in (a, b, c)] == [1 / 3] * 3
    assert [found[x].after for x in (a, b, c)] == pytest.approx([2 / 3, 1 / 3, 1 / 3])
    np.testing.assert_array_equal(run.if_never_fails(a).values, [2, 3, 8])
    np.testing.assert_array_equal(run.if_never_fails(c).values, [1, 5, 9])


def test_sets_of_joints_count_where_the_joint_has_no_part(pa10):
    index = hf.indices.relative_manipulability(pa10, failures=[[0], [1, 3], [3]])
    run = hf.assess(pa10, PAPER, index, poses=40, seed=1)
    values = run.dataset["by_failure"].values
    values = values[np.isfinite(values).all(1)]
    np.testing.assert_array_equal(run.if_never_fails(3).values, np.sort(values[:, 0]))
    np.testing.assert_array_equal(run.if_never_fails(1).values, np.sort(values[:, [0, 2]].min(1)))
    np.testing.assert_array_equal(run.if_never_fails(8).values, run.distribution.values)
    assert {u.joint for u in run.upgrades(0.1)} == {pa10.joint_names[k] for k in (0, 1, 3)}
    alone = hf.assess(pa10, PAPER, hf.indices.relative_manipulability(pa10, failures=[[2]]), poses=20)
    with pytest.raises(hf.InputError, match="no failure remains without it"):
        alone.if_never_fails(2)
    assert alone.upgrades(0.1) == []


def test_weights_count(pa10):
    region = replace(PAPER, weight=lambda samples: (samples[:, 2] > PAPER.center[2]) + 0.5)
    run = hf.assess(pa10, region, poses=80, seed=3)
    weight = run.dataset["weight"].values
    by_failure = np.nan_to_num(run.dataset["by_failure"].values)
    u = run.upgrades(0.2)[0]
    k = pa10.joint_index(u.joint)
    gained = (np.delete(by_failure, k, 1).min(1) >= 0.2) & (by_failure.min(1) < 0.2)
    assert u.gain == pytest.approx(weight[gained].sum() / weight.sum())
    assert u.after == pytest.approx(run.if_never_fails(k).probability(at_least=0.2))


def test_gap_to_the_bound(run):
    assert run.index.bound == pytest.approx(np.sqrt(3 / 9))
    for optimised in (False, True):
        values = np.sort(rows(run, optimised).min(1))[run.distribution.unreached :]
        middle = values[int(np.ceil(len(values) / 2)) - 1]
        assert run.gap(optimised) == pytest.approx(np.sqrt(1 / 3) - middle, abs=1e-9)
    assert hf.assess(run.arm, PAPER, "manipulability", poses=5).gap() is None


def test_what_cannot_be_said(run, pa10):
    bins = hf.assess(pa10, PAPER, poses=20, keep=False)
    assert not bins.has_rows
    with pytest.raises(hf.InputError, match="were not kept"):
        bins.upgrades(0.2)
    with pytest.raises(hf.InputError, match="not optimised"):
        bins.if_never_fails(0, optimised=True)
    with pytest.raises(hf.InputError, match="threshold is nan"):
        run.upgrades(float("nan"))
    with pytest.raises(hf.InputError, match="'elbow'"):
        run.if_never_fails("elbow")
    assert run.upgrades(0.2, confidence=0.8)[0].confidence == 0.8
