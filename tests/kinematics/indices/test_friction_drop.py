"""Start of a fall with dry friction: the batch engine, closed form without friction, differences, the hold set."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
import oracles


def random_body(rng, types):
    return oracles.with_bodies(oracles.random_arm(rng, types=types), rng, payload=True, armature=True)


@pytest.mark.parametrize("types", ["RRRR", "RPRR"])
def test_it_is_the_start_of_the_simulated_fall(rng, types):
    arm = random_body(rng, types)
    friction = hf.Friction(coulomb=rng.uniform(0.2, 8, 4), viscous=0.0, load=[0.1, 0, 0.2, 0])
    q, time = rng.uniform(-2, 2, (40, 4)), 1e-3
    fall = hf.power_loss(arm, q, friction=friction, stops=False, duration=time, step=1e-4)
    expected = hf.susceptibility.tool_drop_with_friction(arm, friction)(q)
    np.testing.assert_allclose(fall.drop_at(time) * 2 / time**2, expected, atol=2e-3 * (1 + np.abs(expected).max()))


def test_without_friction_it_is_the_symbolic_measure(rng):
    arm = random_body(rng, "RRPR")
    q = rng.uniform(-2, 2, (20, 4))
    with_zero = hf.susceptibility.tool_drop_with_friction(arm, hf.Friction(coulomb=0.0), [0, 2, 3])
    plain = hf.susceptibility.tool_drop(arm, [0, 2, 3])
    np.testing.assert_allclose(with_zero(q), plain(q), rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(with_zero.gradient(q), plain.gradient(q), rtol=1e-7, atol=1e-7)


def test_the_gradient_equals_differences(rng):
    arm = random_body(rng, "RRRR")
    friction = hf.Friction(coulomb=rng.uniform(0.2, 5, 4), load=[0.1, 0.2, 0, 0.1])
    drop = hf.susceptibility.tool_drop_with_friction(arm, friction)
    q = rng.uniform(-2, 2, (12, 4))
    smooth = 0
    for row in q:
        halves = [oracles.slope(lambda x: np.atleast_1d(drop(x)), row, h).ravel() for h in (1e-4, 2e-4)]
        if np.abs(halves[0] - halves[1]).max() < 1e-6 * (1 + np.abs(halves[0]).max()):  # else a kink is near
            smooth += 1
            np.testing.assert_allclose(drop.gradient(row), halves[0], atol=1e-5 * (1 + np.abs(halves[0]).max()))
    assert smooth > 6


def test_it_is_0_exactly_where_the_arm_holds():
    arm = hf.arms.load("panda")
    friction = hf.Friction(coulomb=[1.0, 30, 5, 10, 2, 2, 1])
    q = np.random.default_rng(3).uniform(arm.lower, arm.upper, (300, 7))
    check = hf.holds(arm, q, friction=friction, stops=False)
    drop = hf.susceptibility.tool_drop_with_friction(arm, friction)
    assert 10 < check.holds.sum() < 290
    assert (drop(q)[check.holds] == 0).all()
    assert (drop(q)[~check.holds] != 0).all()
    assert np.isnan(drop(np.vstack([q[:1], np.full(7, np.nan)]))[1])


def test_an_optimum_drops_less():
    arm = hf.arms.load("panda")
    drop = hf.susceptibility.tool_drop_with_friction(arm, hf.Friction(coulomb=1.0))
    start = np.radians([0.0, -45, 0, -135, 0, 90, 45])
    pose = arm.forward_kinematics(start)
    assert hf.optimise(arm, pose, drop, starts=4).value <= drop(start) + 1e-9
