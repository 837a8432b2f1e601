"""Routes through a cell: none touches it, by coal in steps of 2 mrad; what is in the way is named."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import cells
import holdfast as hf
import oracles
from holdfast.model.cell import Capsule, Sphere
from holdfast.response.recovery import RecoveryOutcome, attempt, check_waypoints

START, GOAL = np.array([0.9, -0.4, 0.3]), np.array([-0.9, -0.4, -0.3])


def three_links() -> hf.Arm:
    arm = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0) for _ in range(3)], name="three")
    joints = [replace(j, lower=-x, upper=x) for j, x in zip(arm.joints, (3.0, 2.6, 2.8), strict=True)]
    return replace(arm, joints=tuple(joints))


def bar(start: float, end: float) -> hf.Cell:
    """A bar along x in the plane of the arm."""
    pose = oracles.pose([[0, 0, 1], [0, 1, 0], [-1, 0, 0]], ((start + end) / 2, 0, 0))
    return hf.Cell([Capsule("bar", 0.08, end - start, pose=pose)])


@pytest.fixture(scope="module")
def slim():
    return hf.Capsules.along_links(three_links(), 0.05)


def test_a_route_leads_round_a_bar_and_never_touches_it(slim):
    arm, cell = three_links(), bar(2.2, 3.2)
    clearance = hf.Clearance(arm, slim, itself=False)
    straight = cells.finely(np.stack([START, GOAL]))
    assert cells.touches(arm, slim, cell, straight).any()
    found = hf.recover(arm, {"joint2": -0.4}, START, goal=GOAL, clearance=clearance, cell=cell, margin=0.01, samples=0, tries=1)
    assert found.ending == RecoveryOutcome.GOAL_REACHED, found.describe()
    assert not cells.touches(arm, slim, cell, cells.finely(found.q)).any()
    np.testing.assert_allclose(found.q[[0, -1]], [START, GOAL], atol=1e-9)
    check = found.check()
    assert check.ok
    assert check.least_room >= 0.01
    assert check.closest == "joint3 & bar"


def test_the_first_link_meets_an_object_which_it_does_not_as_a_part_of_the_base(slim, monkeypatch):
    """A bar across the first link: as a capsule on the base it is adjacent to that link and is not looked at."""
    arm, cell = three_links(), bar(0.4, 0.7)
    base = hf.collision.LinkCapsule(-1, (0.4, 0, 0), (0.7, 0, 0), radius=0.08)
    away = (np.array([0.4, 1.5, 0.5]), np.array([-0.4, 1.5, 0.5]))
    common = {"goal": away[1], "samples": 0, "tries": 1}
    loophole = hf.Clearance(arm, hf.Capsules((*slim, base)))
    through = hf.recover(arm, ["joint2"], away[0], clearance=loophole, **common)
    assert through.ending == RecoveryOutcome.GOAL_REACHED
    assert cells.touches(arm, slim, cell, cells.finely(through.q)).any()
    clearance = hf.Clearance(arm, slim, cell, itself=False)
    found = hf.recover(arm, ["joint2"], away[0], clearance=clearance, **common)
    assert found.ending == RecoveryOutcome.PROVED_DISCONNECTED  # the limits of joint 1 close the other way
    assert not len(found.q)
    monkeypatch.setattr(attempt, "prove_goal_disconnected", lambda *_, **__: None)
    found = hf.recover(arm, ["joint2"], away[0], clearance=clearance, **common)
    assert found.ending == RecoveryOutcome.NO_ROUTE_FOUND
    assert "in the way of the straight line: joint1 & bar" in found.reason


def test_a_route_of_a_panda_through_a_bench_never_touches_it(rng):
    arm, cell = hf.arms.load("panda"), cells.bench()
    clearance = hf.Clearance(arm, cell=cell)
    ends = oracles.inside(arm, rng, 4000)
    ends[:, 3] = -2.0
    ends = ends[clearance.margin_left(ends) > 0.02]
    moved = 0
    for case in range(2):
        at, goal = ends[2 * case], arm.forward_kinematics(ends[2 * case + 1])
        found = hf.recover(arm, ["panda_joint4"], at, goal=goal, task="position", cell=cell, samples=0, tries=2, seed=case)
        assert found.clearance.cell is cell
        if not len(found.q):
            continue
        moved += 1
        way = cells.finely(found.q)
        assert not cells.touches(arm, clearance.capsules, cell, way).any()
        assert clearance.margin_left(way).min() >= 0
        assert found.check().ok
    assert moved


def test_what_is_in_the_way_is_named(slim):
    arm = three_links()
    clearance = hf.Clearance(arm, slim, itself=False)
    ball = hf.Cell([Sphere("ball", 0.3, pose=cells.placed(*arm.forward_kinematics(START)[:3, 3]), margin=0.1)])
    found = hf.recover(arm, ["joint2"], START, goal=GOAL, clearance=clearance, cell=ball, samples=0)
    assert found.ending == RecoveryOutcome.START_TOO_CLOSE
    assert "comes closer to the cell than it may (joint3 & ball, 0.35" in found.reason
    pose = arm.forward_kinematics(np.array([-1.5, -0.4, -0.5]))  # in reach, and within an object
    wall = hf.Cell([Sphere("wall", 0.2, pose=pose)])
    found = hf.recover(arm, ["joint2"], START, goal=pose, task="planar", clearance=clearance, cell=wall, samples=0, starts=32)
    assert found.ending == RecoveryOutcome.PROVED_UNREACHABLE
    assert "every configuration within the limits that meets it collides (wall)" in found.reason
    with pytest.raises(hf.InputError, match=r"goal: .* the cell .*\(joint3 & ball"):
        hf.recover(arm, ["joint2"], GOAL, goal=START, clearance=clearance, cell=ball, samples=0)


def test_the_replay_sees_an_object_between_waypoints(slim):
    arm, cell = three_links(), bar(2.2, 3.2)
    clearance = hf.Clearance(arm, slim, itself=False)
    q = np.stack([START, GOAL])
    assert check_waypoints(arm, q, clearance=clearance).ok
    check = check_waypoints(arm, q, clearance=clearance, cell=cell)
    assert not check.ok
    assert (check.closest, check.least_room) == ("joint3 & bar", check.least_clearance)
    assert "VIOLATED" in check.describe()[1]
    assert "joint3 & bar" in check.describe()[1]


def test_what_is_left_is_what_is_clear_of_the_cell(slim):
    """Joint 1 locked, tool points of the failed arm: those whose only configurations touch a disc are lost."""
    arm = three_links()
    centre, disc = np.array([1.6, 0.9]), 0.25
    cell = hf.Cell([Sphere("disc", disc, pose=cells.placed(*centre, 0))])
    clearance = hf.Clearance(arm, slim, itself=False)
    common = {"goal": "home", "task": "planar", "clearance": clearance, "samples": 300, "tries": 0, "starts": 4}
    found = hf.recover(arm, {"joint1": 0.0}, np.array([0.0, -0.5, -0.5]), cell=cell, **common).left
    point = found.position[:, :2] - [1.0, 0.0]
    far = np.linalg.norm(point, axis=1)
    with np.errstate(invalid="ignore"):
        elbow = np.arccos((far**2 - 2) / 2)
    exact, bound = np.zeros((2, len(far)), dtype=bool)
    for sign in (1, -1):
        third = sign * elbow
        second = np.arctan2(point[:, 1], point[:, 0]) - np.arctan2(np.sin(third), 1 + np.cos(third))
        q = np.stack([0 * third, (second + np.pi) % (2 * np.pi) - np.pi, third], axis=1)
        inside = np.isfinite(q).all(axis=1) & (np.abs(q) <= arm.upper).all(axis=1)
        gap = cells.from_disc([1, 1, 1], 0.05, np.nan_to_num(q), centre, disc)
        exact |= inside & (gap >= 0)
        bound |= inside & (gap >= 0.006)  # the spheres of a chain reach 5 mm beyond a capsule
    assert (found.locked <= exact).all()
    assert found.locked[bound].mean() > 0.97
    assert 0.2 < found.locked.mean() < 0.9
