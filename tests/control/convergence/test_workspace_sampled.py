"""The six measures by sampling: beside the exact analysis of a planar arm, and beside plain simulations of a spatial one."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import holdfast as hf
import oracles
from holdfast.control import pseudoinverse
from holdfast.control.convergence.analysis import StartConfigurations
from holdfast.control.convergence.places import read_places
from holdfast.control.convergence.start_workspace import mean_intervals
from holdfast.interface.presentation import call_presenter

CELLS = 5


@pytest.fixture(scope="module")
def spatial(generator):
    """Five joints and a position: two joints to spare, the last one, about the tool's axis, idle."""
    arm = oracles.alternating_arm(generator("maps"), 5)
    return pseudoinverse(arm.with_tool(oracles.pose(position=0.2 * arm.joints[-1].axis)), "position")


@pytest.fixture(scope="module")
def goal(spatial):
    arm = spatial.arm
    return arm.forward_kinematics((np.maximum(arm.lower, -2) + np.minimum(arm.upper, 2)) / 2 + 0.3)


@pytest.fixture(scope="module")
def sampled(spatial, goal):
    # As many failures as cells: every cell inside is looked at.
    return hf.workspace(spatial, goal, 6, configurations=3, points=CELLS, cells=CELLS, seed=4)


def test_spatial_arms_are_sampled_unasked(sampled):
    assert sampled.method == "sampled"
    assert (sampled.configurations <= 3).all()
    assert sampled.reach.full.shape == (6, 6)


def test_a_spatial_arm_beside_plain_simulations(sampled, spatial, goal):
    """The healthy motion by scipy, reach by inverse kinematics with the joint locked, the end by single simulations."""
    law, arm = spatial, spatial.arm
    places = read_places(arm, law.task, 6, np.random.default_rng(4))
    owner, q0 = StartConfigurations(law, places, 3, "sampled", 4).find_configurations(0, 6)
    assert arm.forward_kinematics(q0)[:, :3, 3] == pytest.approx(places.points[owner], abs=1e-8)

    def rates(_, q):
        return law.velocity(q, law.gain * (goal[:3, 3] - arm.forward_kinematics(q)[:3, 3]))

    at = -np.log(1 - (np.arange(CELLS) + 0.5) / CELLS) / law.gain
    motions = [solve_ivp(rates, (0, 5), x, "DOP853", at, rtol=1e-9, atol=1e-11) for x in q0]
    kept = np.array([m.success for m in motions])  # the others met a singular configuration
    assert list(np.bincount(owner[~kept], minlength=6)) == list(sampled.lost)
    owner, q = owner[kept], np.stack([m.y.T for m in motions if m.success])  # (R, K, n)
    inside, arrives = np.zeros((*q.shape[:2], arm.n + 1), bool), np.zeros((*q.shape[:2], arm.n + 1))
    for j in range(arm.n):
        values = q[..., j].ravel()
        held = np.clip(values, arm.lower[j], arm.upper[j])
        found = hf.reachable_when_locked(arm, goal, {j: held}, task=law.task, restarts=60).success
        inside[..., j] = (found & (held == values)).reshape(q.shape[:2])
        runs = hf.simulate(law, q.reshape(-1, arm.n), goal, locked=[j], time_limit=2000.0, tolerance=1e-8)
        slow = np.where(runs.error < 0.05, 1.0, np.nan)  # those beside a solution count, others are left out
        ended = np.where(runs.outcome == "undecided", slow, runs.outcome == "converged")
        arrives[..., j] = ended.reshape(q.shape[:2])
    inside[..., -1] = inside[..., :-1].all(axis=-1)
    arrives[..., -1] = arrives[..., :-1].min(axis=-1)
    assert sampled.ends.sum() == inside[..., :-1].sum()
    length = inside.mean(axis=1)
    with np.errstate(invalid="ignore"):
        share = np.where(inside, arrives, 0.0).sum(axis=1) / inside.sum(axis=1)
    for k in np.unique(owner):
        mine = owner == k
        for j in range(arm.n + 1):
            r, f = length[mine, j], share[mine, j][~np.isnan(share[mine, j])]
            got = [sampled.measures[name][k, j] for name in ("R100", "Ravg", "Rsens")]
            assert got == pytest.approx([100 * (r == 1).mean(), 100 * r.mean(), 100 * np.ptp(r)])
            got = [sampled.measures[name][k, j] for name in ("F100", "Favg", "Fsens")]
            if np.isnan(arrives[mine, :, j][inside[mine, :, j]]).any():
                continue
            if f.size:
                assert got == pytest.approx([100 * (f == 1).mean(), 100 * f.mean(), 100 * np.ptp(f)])
            else:
                assert np.isnan(got).all()


def test_a_planar_arm_by_sampling_beside_the_exact_analysis(three, rng):
    """F of the whole way: what arrives is then as uneven as what stays in reach."""
    options = {"points": 2, "cells": 30, "relative_to": "whole"}
    exact = hf.workspace(three, [1.5, 1.5], "grid:12", configurations=8, **options)
    chosen = rng.permutation(len(exact.places))[:50]
    part = hf.workspace(
        three,
        [1.5, 1.5],
        exact.places.poses[chosen],
        configurations=6,
        method="sampled",
        seed=int(rng.integers(1 << 30)),
        **options,
    )
    assert (part.configurations <= 6).all()
    truth, sure, found = exact.means(), part.intervals(0.9999), part.means()
    for name in ("R100", "Ravg", "F100", "Favg"):
        low, high = sure[name].T
        assert ((low <= truth[name]) & (truth[name] <= high)).all(), name
        assert (high - low < 80).all()
        assert ((low <= found[name]) & (found[name] <= high)).all()
    # The greatest difference among some is at most that among more.
    assert (found["Rsens"] <= exact.reach.spread[chosen].mean(axis=0) + 100 * 2 / 8).all()


def test_intervals_count_starts(sampled):
    """However often a start is looked at, it stays one: the interval is no narrower than any that covers so few values may be.

    Of k starts that all have 100 % nothing excludes a mean of ``(1 - confidence) / 2`` to the power ``1 / k`` (a start fails
    wholly with the rest of the probability). Copies of every start, which a count of configurations could not tell from
    more configurations, must narrow it.
    """
    seen = 0
    for name, ends in sampled.intervals(0.9).items():
        for (low, high), values in zip(ends, sampled.measures[name].T, strict=True):
            known = values[~np.isnan(values)]
            if not known.size:
                assert np.isnan([low, high]).all()
                continue
            assert low <= known.mean() + 1e-9
            assert high >= known.mean() - 1e-9
            widest = 100 * (1 - 0.05 ** (1 / known.size))
            if known.min() >= 100 - 1e-9:
                assert 100 - low >= widest - 1e-6
                seen += 1
            if known.max() <= 1e-9:
                assert high >= widest - 1e-6
                seen += 1
    assert seen
    few = mean_intervals(sampled.measures["Ravg"][:, -1:], 0.9)[0]
    many = mean_intervals(np.repeat(sampled.measures["Ravg"][:, -1:], 9, axis=0), 0.9)[0]
    assert np.diff(many) < 0.6 * np.diff(few)


def test_intervals_of_starts_hold_the_mean_of_all_starts(rng):
    """The mean over 4,000 starts is the truth of 300 samples of 12 of them, each start many configurations: Beta shares."""
    everything = 100 * rng.beta(0.3, 0.6, 4000)[:, None]
    inside = 0
    for _ in range(300):
        low, high = mean_intervals(rng.choice(everything, 12), 0.9)[0]
        inside += low <= everything.mean() <= high
    assert inside >= 0.9 * 300


def test_the_share_of_starts_throughout(sampled):
    full, known = sampled.throughout("R100"), sampled.reach.full
    assert [i.value for i in full] == pytest.approx(list(np.nanmean(np.where(np.isnan(known), np.nan, known == 100), axis=0)))
    with pytest.raises(hf.InputError, match="R100 or F100"):
        sampled.throughout("Ravg")


def test_targets_of_a_spatial_arm_are_analyses_of_their_own(spatial, goal):
    goals = np.stack([goal, goal])
    goals[1, 0, 3] += 40.0
    options = {"configurations": 2, "points": 1, "cells": 4, "time_limit": 100.0}
    found = hf.workspace(spatial, goals, 3, over="targets", seed=2, **options)
    one = hf.workspace(spatial, goal, found.starts, seed=2, **options)
    for name, values in one.measures.items():
        np.testing.assert_array_equal(found.values[name][0], values)
        np.testing.assert_array_equal(found.target_intervals()[name][0], one.intervals()[name])
        assert np.isnan(found.values[name][1]).all()
        np.testing.assert_array_equal(found.means()[name], one.means()[name])
    assert set(call_presenter(found, "present").figures) == {"reach-top", "reach-side", "finish-top", "finish-side"}
