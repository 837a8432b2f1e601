"""Locks injected into a motion: against the closed form of a planar arm, and against what the motion itself says."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.response.lock_survival.injection import can_finish_path, interpolate_motion
from unit_links import LIMITS, arm, survives, timed


@pytest.fixture(scope="module")
def motion():
    machine = arm(LIMITS)
    path = timed([1.9, -0.9], [0.6, 1.7])
    return machine, path, hf.plan_motion(machine, path, samples=41, spacing=0.1)


def test_a_failed_arm_gets_as_far_as_the_closed_form_says(motion, rng):
    machine, path, best = motion
    time, joint = rng.uniform(0, path.duration, 60), rng.integers(0, 3, 60)
    q = interpolate_motion(best._problem, best.q, time)
    assert np.abs(machine.forward_kinematics(q)[:, :2, 3] - path.pose(time)[:, :2, 3]).max() < 1e-9
    got = can_finish_path(best._problem, q, time, joint, q_start=best.q[0])
    points = [path.pose(np.linspace(t, path.duration, 60))[:, :2, 3] for t in time]
    want = np.array([survives(machine, *each) for each in zip(q, joint, points, strict=True)])
    assert 0 < want.sum() < want.size
    assert (got != want).sum() <= 1


@pytest.mark.parametrize("mode", ["on-path", "detour"])
def test_injected_locks_say_what_the_motion_says(motion, mode):
    machine, path, best = motion
    tried = best if mode == "on-path" else hf.evaluate_motion(machine, best.q, path, mode=mode, samples=41)
    found = tried.test_locks(80, seed=3)
    assert found.interval.low <= tried.survival <= found.interval.high
    assert found.agreement >= 0.98
    assert found.told.mean() > 0.9
    assert len(found.disagreements) == (found.survived != found.expected)[found.told].sum()
    again = tried.test_locks(80, seed=3)
    assert (again.survived == found.survived).all()


def test_locks_come_as_the_rates_say(motion):
    machine, path, best = motion
    fast = hf.evaluate_motion(machine, best.q, path, rates=[3.0, 0.0, 1.0], per_second=True, samples=41)
    found = fast.test_locks(200, seed=1)
    assert set(found.joint) == {0, 2}
    assert (found.joint == 0).mean() == pytest.approx(0.75, abs=0.1)
    # Exponential times, cut off at the end: the mean of those that come.
    end = path.duration
    mean = 1 / 4 - end * np.exp(-4 * end) / (1 - np.exp(-4 * end))
    assert found.time.mean() == pytest.approx(mean, abs=0.06)
    assert found.interval.low <= fast.survival <= found.interval.high
    with pytest.raises(hf.InputError, match="locks is 0"):
        best.test_locks(0)
