"""Energy released until an arm hangs still: the paper's closed form, slow falls by SciPy, differences, use as an objective."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import holdfast as hf
import oracles


def random_body(rng, types, limits=None):
    return oracles.with_bodies(oracles.random_arm(rng, types=types, limits=limits), rng, payload=True, armature=True)


def potential(arm, q):
    """The potential energy from the centres of mass of Pinocchio."""
    import pinocchio as pin

    model, _ = oracles.to_pinocchio(arm)
    return pin.computePotentialEnergy(model, model.createData(), np.asarray(q))


def test_one_joint_releases_the_energy_of_the_papers_swing_angle(rng):
    arm = random_body(rng, "RRRR")
    for q in rng.uniform(-3, 3, (10, 4)):
        angles = hf.susceptibility.swing_angle(arm).by_joint(q)
        for joint, angle in enumerate(angles):
            energy = hf.susceptibility.swing_energy(arm, [joint])
            turned = q + angle * np.eye(4)[joint]
            size = abs(potential(arm, q)) + 1
            assert energy(q) == pytest.approx(potential(arm, q) - potential(arm, turned), abs=1e-10 * size)


@pytest.mark.parametrize("types", ["RRR", "RPR"])
def test_the_equilibrium_is_that_of_a_slow_fall(rng, types):
    arm = random_body(rng, types, limits=1.5)
    energy = hf.susceptibility.swing_energy(arm)
    starts = rng.uniform(arm.lower, arm.upper, (6, 3)) * 0.9
    for q, end in zip(starts, energy.settle(starts), strict=True):

        def sink(_, x):
            torque = arm.gravity_torque(np.clip(x, arm.lower, arm.upper))
            return -np.linalg.solve(inertia(arm, x), torque) * 0.1

        held = np.where((end <= arm.lower) | (end >= arm.upper))[0]
        torque = arm.gravity_torque(end)
        free = np.setdiff1d(range(3), held)
        assert np.abs(torque[free]).max(initial=0) < 1e-7
        assert (np.where(end <= arm.lower, torque, np.where(end >= arm.upper, -torque, 0.0)) >= 0).all()
        if not held.size:
            slow = solve_ivp(sink, (0, 400), q, rtol=1e-8, atol=1e-8).y[:, -1]
            if (np.abs(slow) < 1.5).all():
                assert potential(arm, end) == pytest.approx(potential(arm, slow), abs=1e-5)


def inertia(arm, q):
    import pinocchio as pin

    model, _ = oracles.to_pinocchio(arm)
    full = pin.crba(model, model.createData(), np.asarray(q)).copy()
    return np.triu(full) + np.triu(full, 1).T


@pytest.mark.parametrize("free", [None, [1], [0, 2]])
def test_the_gradient_equals_differences(rng, free):
    arm = random_body(rng, "RRPR", limits=1.2)
    energy = hf.susceptibility.swing_energy(arm, free)
    for q in rng.uniform(-1, 1, (8, 4)):
        near = energy.settle(q + 1e-3 * np.vstack([np.eye(4), -np.eye(4)]))
        if np.abs(near - energy.settle(q)).max() > 0.05:
            continue  # another equilibrium is reached from nearby, where the energy has a jump
        numeric = oracles.slope(lambda x: np.atleast_1d(energy(x)), q)
        np.testing.assert_allclose(energy.gradient(q), np.ravel(numeric), atol=1e-6 * (1 + np.abs(numeric).max()))


def test_batches_and_rows_of_nan(rng):
    arm = random_body(rng, "RRR")
    q = np.vstack([rng.uniform(-1, 1, (3, 3)), np.full(3, np.nan)])
    energy = hf.susceptibility.swing_energy(arm)
    np.testing.assert_array_equal(energy(q)[:3], [energy(row) for row in q[:3]])
    assert np.isnan(energy(q)[3])
    assert np.isnan(energy.gradient(q)[3]).all()
    assert (energy(q)[:3] >= -1e-12).all()


def test_an_optimum_releases_less(rng):
    arm = hf.arms.load("panda")
    energy = hf.susceptibility.swing_energy(arm, [3, 4, 5])
    start = np.radians([0.0, -45, 0, -135, 0, 90, 45])
    pose = arm.forward_kinematics(start)
    best = hf.optimise(arm, pose, energy, starts=8)
    assert best.value <= energy(start) + 1e-9
    np.testing.assert_allclose(arm.forward_kinematics(best.q), pose, atol=1e-5)


@pytest.mark.parametrize(("free", "message"), [([9], "9"), ("elbow", "elbow"), ([], "no joint")])
def test_wrong_joints_are_refused(free, message):
    with pytest.raises(hf.InputError, match=message):
        hf.susceptibility.swing_energy(hf.arms.load("panda"), free)
