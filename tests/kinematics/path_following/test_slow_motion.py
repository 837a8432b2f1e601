"""How slow is slow enough, against brute force over the time scale."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import arms
from holdfast.kinematics.path_following import slow_enough
from holdfast.kinematics.path_following.slow_motion import _required_time_stretch

GRID = np.geomspace(1e-3, 1e3, 60_001)


def excess(arm, q, qd, qdd, bound, k):
    """``|torque - gravity torque| / bound`` (T, n) of the motion slowed k times."""
    return np.abs(arm.inverse_dynamics(q, qd / k, qdd / k**2) - arm.gravity_torque(q)) / bound


@pytest.fixture
def moving(rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RPRR", limits=2.0), rng, payload=True, armature=True)
    arm = replace(arm, joints=tuple(replace(j, friction=rng.uniform(1, 9)) for j in arm.joints))
    return arm, oracles.inside(arm, rng, 30), rng.normal(size=(30, 4)), rng.normal(size=(30, 4))


def test_against_brute_force(moving, rng):
    arm, q, qd, qdd = moving
    for _ in range(20):
        rows = rng.integers(30, size=3)
        state, bound = (q[rows], qd[rows], qdd[rows]), 10 ** rng.uniform(-2, 2, 4)
        found = slow_enough(arm, q[rows], qd[rows], qdd=qdd[rows], bound=bound)
        k = found.time_scale
        assert excess(arm, *state, bound, k)[found.worst_time_index, found.worst_joint] == pytest.approx(1, rel=1e-6)
        for slower in (1, 1.0001, 1.01, 1.1, 2, 10, 100):
            assert excess(arm, *state, bound, k * slower).max() <= 1 + 1e-6
        assert excess(arm, *state, bound, k * (1 - 1e-6)).max() > 1
        assert found.satisfied == (k <= 1)


def test_every_sign_of_friction_and_inertia(rng):
    """The last point of a grid at which the bound is broken, also where the motion meets it in between."""
    a, b = rng.normal(size=400) * 10 ** rng.uniform(-2, 2, 400), rng.normal(size=400) * 10 ** rng.uniform(-1, 1, 400)
    broken = np.abs(b[:, None] / GRID + a[:, None] / GRID**2) > 1
    expected = GRID[len(GRID) - 1 - broken[:, ::-1].argmax(axis=1)]
    found = _required_time_stretch(b, a)
    assert broken.any(axis=1).all()
    np.testing.assert_allclose(found, expected, rtol=1e-3)
    between = (np.diff(broken.astype(int), axis=1) != 0).sum(axis=1) > 1
    assert between.any()
    np.testing.assert_array_equal(_required_time_stretch(np.zeros(2), np.array([0.0, 4.0])), [0, 2])
    np.testing.assert_array_equal(_required_time_stretch(np.array([-3.0, 3.0]), np.zeros(2)), [3, 3])


def test_stretching_a_motion_divides_its_scale(moving):
    arm, q, qd, qdd = moving
    k = slow_enough(arm, q, qd, qdd=qdd, bound=5.0).time_scale
    slowed = slow_enough(arm, q, qd / (2 * k), qdd=qdd / (2 * k) ** 2, bound=5.0)
    assert slowed.time_scale == pytest.approx(0.5)
    assert slowed.satisfied
    assert not slow_enough(arm, q, 2 * qd / k, qdd=qdd * (2 / k) ** 2, bound=[5.0] * 4).satisfied


def test_a_motion_at_rest_and_joints_without_load(moving):
    arm, q, qd, _ = moving
    still = slow_enough(arm, q, 0 * qd, qdd=0 * qd, bound=0.0)
    assert (still.time_scale, still.satisfied) == (0, True)
    assert slow_enough(arm, q, qd, qdd=qd, bound=np.inf).time_scale == 0
    # Its last joint turns steadily about the axis on which its rod lies: no torque, so no bound is too tight.
    rod = hf.Link(1.0, np.array([0, 0, 0.5]), np.diag([0.1, 0.1, 0.0]))
    joints = (hf.Joint("lift", "prismatic", np.eye(4), axis=[0, 0, 1]), hf.Joint("spin", "revolute", np.eye(4), axis=[0, 0, 1]))
    lift = hf.Arm(name="lift", joints=joints, links=(rod, rod))
    found = slow_enough(lift, [0.0, 0.0], [0.0, 1.0], qdd=[8.0, 0.0], bound=[1.0, 0.0])
    assert found.time_scale == pytest.approx(4)  # 2 kg times 8 m/s^2 over 1 N
    assert (found.worst_joint, found.worst_time_index) == (0, 0)


def test_bad_input():
    arm = arms.load("panda")
    q = np.zeros((3, 7))
    broken = q.copy()
    broken[1, 2] = np.nan
    for arguments, words in (
        ((q, q + 1, q, 0.0), "bound of joint 'panda_joint1' is 0, but friction or inertia"),
        ((q, q, q, -1.0), "must be above 0"),
        ((q, q, q, np.nan), "must be above 0"),
        ((q, q, q, [1.0, 2.0]), r"bound has shape \(2,\)"),
        ((q, q, q, "small"), "bound is 'small'; it must be numbers"),
        ((broken, q, q, 1.0), "NaN or infinity at sample 1"),
        ((q[:0], q[:0], q[:0], 1.0), "no samples"),
        ((q, q[:2], q, 1.0), "has 2 rows"),
    ):
        with pytest.raises(hf.InputError, match=words):
            slow_enough(arm, *arguments[:2], **dict(zip(("qdd", "bound"), arguments[2:], strict=True)))
