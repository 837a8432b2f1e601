"""From start to goal with the least exposure, against brute force over closed forms of a planar arm."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from unit_links import LIMITS, arm, around, configuration


def goals(machine, joint, values, point):
    """Configurations of a point with a joint at each of the values, those within the limits."""
    found = [configuration(joint, v, point, sign) for v in values for sign in (-1, 1)]
    q = np.array([np.where(np.arange(3) == joint, x, around(x)) for x in found if x is not None]).reshape(-1, 3)
    return q[((q >= machine.lower) & (q <= machine.upper)).all(axis=1)]


def brute_force(machine, start, point, price, step=2e-3):
    """The least exposure over a fine grid of goals, with ranges from fine scans of every joint."""
    ends = np.concatenate([goals(machine, 0, np.arange(machine.lower[0], machine.upper[0], step), point)])
    total = np.zeros(len(ends))
    for k in range(3):
        values = np.arange(machine.lower[k], machine.upper[k], step)
        safe = np.array([len(goals(machine, k, [v], point)) > 0 for v in values])
        lost = np.concatenate([[0.0], np.cumsum(np.where(safe, 0.0, step))])
        edges = np.append(values, values[-1] + step) - step / 2
        total += price[k] * np.abs(np.interp(ends[:, k], edges, lost) - np.interp(start[k], edges, lost))
    return total.min()


def test_exposure_is_the_least_of_brute_force(rng):
    machine = arm(LIMITS)
    velocity, rates = np.array([1.0, 2.0, 0.5]), np.array([1.0, 0.5, 2.0])
    positive = 0
    for _ in range(4):
        start, other = rng.uniform(machine.lower, machine.upper, (2, 3))
        point = machine.forward_kinematics(other)[:2, 3]
        got = hf.plan_motion_to(machine, start, point, rates=rates, task="planar", velocity=velocity, spacing=0.05)
        want = brute_force(machine, start, point, rates / velocity)
        assert got.exposure == pytest.approx(want, rel=5e-3, abs=8e-3)
        positive += got.exposure > 0.05
        assert np.abs(machine.forward_kinematics(got.goal)[:2, 3] - point).max() < 1e-8
        assert np.allclose(got.positions_at(0.0), start)
        assert np.allclose(got.positions_at(got.duration + 1), got.goal)
    assert positive >= 2


def test_no_lock_inside_the_ranges_loses_the_goal_and_every_other_does(rng):
    machine = arm(LIMITS)
    start, point = np.array([-1.5, -1.0, 1.5]), np.array([1.2, 1.1])
    way = hf.plan_motion_to(machine, start, point, task="planar", velocity=1.0)
    time = rng.uniform(0, way.duration, 100)
    outside = np.zeros(3)
    for q in way.positions_at(time):
        for k in range(3):
            inside = any(low + 1e-3 <= q[k] <= high - 1e-3 for low, high in way.ranges[k])
            if inside:
                assert len(goals(machine, k, [q[k]], point))
            elif not any(low - 2e-3 <= q[k] <= high + 2e-3 for low, high in way.ranges[k]):
                assert not len(goals(machine, k, [q[k]], point))
                outside[k] += 1
    # As many of the times lie outside as the motion says.
    assert np.abs(outside / 100 * way.duration - way.outside).max() < 0.3 * way.duration


def test_joints_without_limits_go_the_better_way_round():
    free = arm()
    point = np.array([2.9, 0.0])  # nearly stretched: few values of any joint keep it
    ends = [hf.plan_motion_to(free, [x, 0.1, 0.1], point, task="planar", velocity=1.0) for x in (3.0, -3.0, 9.0)]
    assert ends[0].exposure == pytest.approx(ends[1].exposure, rel=0.2)
    assert all(np.abs(e.goal - e.start).max() <= np.pi + 1e-6 for e in ends[:2])
    assert np.abs(around(free.forward_kinematics(ends[2].goal)[:2, 3] - point)).max() < 1e-8


def test_from_a_pose_the_best_start_is_chosen():
    machine = arm(LIMITS)
    start = machine.forward_kinematics([0.5, 0.8, -1.0])
    point = np.array([1.2, 1.1])
    best = hf.plan_motion_to(machine, start, point, task="planar", velocity=1.0)
    given = hf.plan_motion_to(machine, [0.5, 0.8, -1.0], point, task="planar", velocity=1.0)
    assert best.exposure <= given.exposure + 1e-9
    assert np.abs(machine.forward_kinematics(best.start)[:2, 3] - start[:2, 3]).max() < 1e-8


def test_what_is_refused():
    machine = arm(LIMITS)
    with pytest.raises(hf.InputError, match="velocity"):
        hf.plan_motion_to(machine, [0, 0, 0], [1.0, 1.0], task="planar")
    with pytest.raises(hf.InputError, match="outside the joint limits"):
        hf.plan_motion_to(machine, [0, 0, 2.9], [1.0, 1.0], task="planar", velocity=1.0)
    with pytest.raises(hf.HoldfastError, match="goal"):
        hf.plan_motion_to(machine, [0, 0, 0], [4.0, 1.0], task="planar", velocity=1.0)
    with pytest.raises(hf.TaskError, match="one joint more"):
        hf.plan_motion_to(machine, [0, 0, 0], np.eye(4), task="planar-pose", velocity=1.0)
