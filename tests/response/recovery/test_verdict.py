"""What a recovery amounts to, and the other code that says whether its motion does what was asked."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast.interface.presentation import call_presenter
from holdfast.model.arm.task import as_task
from holdfast.model.collision.exact.engines import is_library_installed
from holdfast.response.recovery import RecoveryOutcome, attempt, completion
from holdfast.response.recovery.proofs import reach
from holdfast.response.recovery.proofs.path_proof import coarse_to_fine_indices
from holdfast.response.recovery.proofs.reach import enumerate_configurations, prove_no_configuration
from holdfast.response.recovery.task_rows import make_row_solver
from holdfast.response.recovery.verification import Verification, compute_row_errors, compute_tool_poses, verify_waypoints

HOME = np.array([0.3, 0.6, 0.9])


@pytest.fixture(scope="module")
def three():
    return hf.arms.load("planar-3r")


@pytest.fixture(scope="module")
def moved(three):
    """A recovery that is solved."""
    return hf.recover(three, ["joint2"], HOME, goal=three.forward_kinematics([0.9, 0.6, 0.1]), task="planar", samples=0)


def test_the_chain_of_matrices_is_the_arm(rng):
    arm = oracles.random_arm(rng, types="RRPRRCR")
    q = rng.uniform(-1, 1, (20, arm.n))
    np.testing.assert_allclose(compute_tool_poses(arm, q), oracles.forward(arm, q), atol=1e-12)
    poses = oracles.forward(arm, q + rng.normal(0, 0.4, q.shape))
    for task in ("pose", "pointing", "position", ["vx", "vz", "wx"]):
        solver = make_row_solver(arm, as_task(arm, task))
        np.testing.assert_allclose(compute_row_errors(arm, solver.rows, q, poses), solver.compute_errors(q, poses), atol=1e-9)


def test_what_is_solved_is_verified_by_other_code(moved):
    assert str(moved.verdict) == "solved"
    assert moved.ok
    assert moved.verified is not None
    assert moved.verified.goal_miss == pytest.approx(0, abs=3e-6)
    assert moved.verified.checked >= np.abs(np.diff(moved.q, axis=0)).max() / 2e-3


@pytest.mark.parametrize(
    ("spoil", "fault"),
    [
        (lambda q: q + np.array([0, 1e-11, 0]), "joint2 is locked and moves"),
        (lambda q: np.concatenate([q, q[-1:] + np.array([1e-3, 0, 0])]), "the goal is missed by"),
        (lambda q: np.concatenate([q[:1], [[9.0, 0.6, 0.1]], q[1:]]), "joint1 exceeds its limits by"),
        (lambda q: q + np.array([1e-3, 0, 0]), "does not begin at the start configuration"),
    ],
)
def test_a_spoilt_motion_is_refused(moved, three, spoil, fault):
    arm = replace(three, joints=tuple(replace(j, lower=-3.0, upper=3.0) for j in three.joints))
    bad = hf.Degraded(arm, locked={"joint2": 0.6})
    rows = make_row_solver(arm, moved.task).rows
    assert verify_waypoints(bad, HOME, moved.q, rows=rows, goals=moved.goal_pose[None]).ok
    found = verify_waypoints(bad, HOME, spoil(moved.q), rows=rows, goals=moved.goal_pose[None])
    assert fault in str(found)


def slim(arm, thing):
    return hf.Clearance(arm, hf.Capsules.along_links(arm, 0.02), hf.Cell([thing]), itself=False)


def test_a_motion_into_an_object_is_refused(moved, three):
    tip = three.forward_kinematics(moved.q.mean(axis=0))[:3, 3]
    shape = slim(three, hf.cell.Sphere("ball", 0.05, pose=tip))
    rows = make_row_solver(three, moved.task).rows
    found = verify_waypoints(moved.degraded, HOME, moved.q, rows=rows, clearance=shape)
    assert not found.ok
    assert "ball" in str(found)


def test_a_motion_that_touches_only_between_coarse_samples_is_refused(three):
    """A thin link and a small ball, which is passed within a few mrad of joint 1."""
    q = np.array([[0.0, 0.6, 0.9], [1.0, 0.6, 0.9]])
    tip = three.forward_kinematics([0.5, 0.6, 0.9])[:3, 3]
    thin = hf.Clearance(
        three, hf.Capsules.along_links(three, 0.005), hf.Cell([hf.cell.Sphere("ball", 0.004, pose=tip)]), itself=False
    )
    coarse = q[0] + np.linspace(0, 1, 26)[:, None] * (q[1] - q[0])
    assert (thin.margin_left(coarse) > 0).all()
    rows = make_row_solver(three, as_task(three, "planar")).rows
    bad = hf.Degraded(three, locked={"joint2": 0.6, "joint3": 0.9})
    assert "joint3 & ball" in str(verify_waypoints(bad, q[0], q, rows=rows, clearance=thin))
    away = thin.with_cell(hf.Cell([hf.cell.Sphere("ball", 0.004, pose=1.02 * tip)]))
    assert verify_waypoints(bad, q[0], q, rows=rows, clearance=away).ok


class Wavy:
    """A tool path that meets a straight joint motion at each of its 6 waypoints, and leaves it in between.

    ``turn`` (degrees) and ``lift`` (m) are reached in the middle between two waypoints.
    """

    def __init__(self, arm, q, turn, lift):
        self.arm, self.q, self.turn, self.lift = arm, q, turn, lift

    def pose(self, share):
        poses = self.arm.forward_kinematics(self.q[0] + np.outer(share, self.q[-1] - self.q[0]))
        wave = np.sin(5 * np.pi * np.asarray(share)) ** 2
        spin = Rotation.from_rotvec(np.deg2rad(self.turn) * wave[:, None] * [0, 0, 1]).as_matrix()
        poses[:, :3, :3] = spin @ poses[:, :3, :3]
        poses[:, 2, 3] += self.lift * wave
        return poses


@pytest.mark.parametrize(
    ("size", "turn", "lift", "ok"),
    [
        (1, 0.3, 0.0, True),
        (1, 0.8, 0.0, False),
        (1, 0.0, 0.5e-3, True),
        (1, 0.0, 2e-3, False),
        (10, 0.0, 2e-3, True),
        (10, 0.8, 0.0, False),
    ],
)
def test_between_waypoints_a_tool_path_is_kept_to_half_a_degree_and_a_millimetre(size, turn, lift, ok):
    """The millimetre is that of an arm of 1 m; the largest error is looked for at fifths of the way between waypoints."""
    arm = (
        hf.arms.load("panda")
        if size == 1
        else hf.Arm.from_dh([hf.DH(a=float(size), alpha=1.0, velocity=1.0) for _ in range(7)], name="large")
    )
    at = np.array(hf.arms.about("panda").home)
    q, places = at + np.linspace(0, 1, 6)[:, None] * [0.3, 0.1, 0, 0, 0, 0.2, 0], np.linspace(0, 1, 6)
    rows = make_row_solver(arm, as_task(arm, "pose")).rows
    along = (Wavy(arm, q, turn, lift), places, slice(0, 6))
    found = verify_waypoints(hf.Degraded(arm, speeds={0: 0.5}), at, q, rows=rows, path_samples=along)
    assert found.ok == ok, found
    assert ok or "is off the tool path by" in str(found)
    largest = max(np.deg2rad(turn), lift) * np.sin(0.4 * np.pi) ** 2
    if turn == 0:  # else the three rows of the rotation share it
        assert found.path_miss >= largest / np.sqrt(3) - 1e-9
    assert found.path_miss <= largest + 1e-9


def test_a_motion_that_other_code_refuses_is_no_answer(three, monkeypatch):
    fault = Verification(faults=("it is wrong",), checked=1, exact_by="", goal_miss=None, path_miss=None)
    monkeypatch.setattr(completion, "verify_waypoints", lambda *_, **__: fault)
    found = hf.recover(three, ["joint2"], HOME, goal=three.forward_kinematics([0.9, 0.6, 0.1]), task="planar", samples=0)
    assert found.ending == RecoveryOutcome.GOAL_REACHED
    assert (found.ok, found.verdict.answer) == (False, "undecided")
    assert "it is wrong" in found.verdict.why
    with pytest.raises(hf.HoldfastError):
        found.require_ok()


def placed(x, y, turn=0.0):
    pose = np.eye(4)
    c, s = np.cos(turn), np.sin(turn)
    pose[:2, :2], pose[:2, 3] = [[c, -s], [s, c]], [x, y]
    return pose


@pytest.mark.parametrize(
    ("locked", "asked", "answer", "kind"),
    [
        (["joint2"], {"goal": placed(2.95, 0)}, "proved infeasible", "reach bound"),
        (["joint2"], {"goal": np.array([0.3, 0.9, 0.9])}, "proved infeasible", "limits"),
        ({"joint2": 0.7}, {}, "proved infeasible", "start"),
        (
            ["joint2"],
            {"goal": None, "path": hf.paths.line([1.5, 1.5, 0], [2.95, 0.3, 0])},
            "proved infeasible",
            "a pose of the path",
        ),
        (["joint2"], {"goal": placed(1.5, 0.4, 2.0), "task": "planar-pose"}, "proved infeasible", "boxes"),
    ],
)
def test_each_verdict_names_its_kind(three, locked, asked, answer, kind):
    found = hf.recover(three, locked, HOME, samples=0, **asked)
    assert (found.verdict.answer, found.verdict.kind) == (answer, kind), found.verdict
    assert not found.ok
    assert found.verdict.why
    assert f"Verdict: {answer}" in " ".join(found.describe())
    assert found.to_dict()["verdict"]["answer"] == answer
    assert answer in call_presenter(found, "present").answer


@pytest.mark.skipif(not is_library_installed(), reason="no library for exact signs")
def test_that_every_configuration_touches_something_is_a_proof(three):
    """Two circles meet in two points, and the target is inside a ball."""
    goal = placed(1.5, -1.0)
    shape = slim(three, hf.cell.Sphere("ball", 0.2, pose=[1.5, -1.0, 0.0]))
    every = enumerate_configurations(hf.Degraded(three, locked={"joint2": 0.6}), as_task(three, "planar"), goal, np.inf)
    assert "each of its 2 configurations collides" in str(prove_no_configuration(every, shape))
    assert prove_no_configuration(every, None) is None
    assert prove_no_configuration(every, slim(three, hf.cell.Sphere("ball", 0.2, pose=[-2.0, 2.0, 0.0]))) is None


def test_an_idle_last_joint_is_looked_at_in_one_place_which_proves_nothing_about_what_touches(rng, monkeypatch):
    arm = hf.arms.load("panda")  # the tool point lies on joint 7, which a position leaves idle and a cell does not
    q = rng.uniform(arm.lower, arm.upper)
    locks = {k: q[k] for k in (0, 2, 4)}

    monkeypatch.setattr(reach, "name_certain_contacts", lambda _, q: ["something"] * len(q))  # where joint 7 is in the middle
    for more, sure in (({}, False), ({6: q[6]}, True)):
        task = as_task(arm, "position")
        every = enumerate_configurations(hf.Degraded(arm, locked=locks | more), task, arm.forward_kinematics(q), np.inf)
        assert len(every.q)
        assert (prove_no_configuration(every, hf.Clearance(arm)) is not None) == sure


def test_no_pose_of_a_configuration_is_proved_to_have_none(rng):
    arm = hf.arms.load("panda")
    for locks in (1, 2, 3):
        joints = rng.choice(arm.n, locks, replace=False)
        q, at = rng.uniform(arm.lower, arm.upper, (2, arm.n))
        at[joints] = q[joints]
        bad = hf.Degraded(arm, locked={int(k): q[k] for k in joints})
        found = hf.recover(arm, bad, at, goal=arm.forward_kinematics(q), clearance=False, samples=0, starts=1, tries=0)
        assert found.verdict.answer != "proved infeasible", found.verdict
        assert found.ok or found.stopped or locks == 1, found.verdict  # one start seldom finds it: the boxes do


def test_what_only_a_search_says_is_argued(three, monkeypatch):
    monkeypatch.setattr(attempt, "enumerate_collision_free", lambda *_: (np.zeros((0, 3)), np.zeros(0, dtype=int), [None]))
    found = hf.recover(three, ["joint2"], HOME, goal=placed(1.5, 0.4, 2.0), task="planar-pose", samples=0)
    assert (found.verdict.answer, found.verdict.kind) == ("argued infeasible", "")
    assert "in 256 starts, which proves nothing" in found.verdict.why


def test_a_spent_time_limit_is_undecided_and_says_at_which_level(three):
    path = hf.paths.line([1.5, 1.5, 0], [1.2, 1.6, 0])
    found = hf.recover(three, ["joint2"], HOME, goal=None, path=path, time_limit=1e-9, samples=0)
    assert str(found.verdict) == "undecided: the time limit ended the search while following the tool path"
    with pytest.raises(hf.InputError, match="time_limit is 0"):
        hf.recover(three, ["joint2"], HOME, time_limit=0.0)


def test_any_of_several_poses_will_do(three):
    beyond, near, far = np.eye(4), three.forward_kinematics([0.5, 0.6, 0.9]), three.forward_kinematics([2.2, 0.6, 0.3])
    beyond[0, 3] = 2.95
    found = hf.recover(three, ["joint2"], HOME, goal=np.stack([beyond, far, near]), task="planar", samples=0)
    assert found.ok
    np.testing.assert_allclose(found.goal_pose, near)
    np.testing.assert_allclose(oracles.forward(three, found.q[-1:])[0, :2, 3], near[:2, 3], atol=3e-6)
    alone = hf.recover(three, ["joint2"], HOME, goal=near, task="planar", samples=0)
    assert found.length == pytest.approx(alone.length, rel=1e-6)
    none = hf.recover(three, ["joint2"], HOME, goal=np.stack([beyond, beyond]), task="planar", samples=0)
    assert none.verdict.kind == "reach bound"
    assert "any of 2 poses" in none.goal


def test_the_poses_that_tell_most_come_first():
    assert list(coarse_to_fine_indices(9)) == [8, 0, 4, 2, 6, 1, 3, 5, 7]
    for count in (1, 2, 3, 10, 57):
        assert sorted(coarse_to_fine_indices(count)) == list(range(count))


def test_a_finished_path_is_verified_between_its_waypoints(three):
    path = hf.paths.line(three.forward_kinematics(HOME)[:3, 3], [1.2, 1.6, 0])
    found = hf.recover(three, ["joint2"], HOME, goal=None, path=path, samples=0)
    assert found.ok, found.verdict
    assert 0 < found.verified.path_miss < 1e-3
    leg = found.legs[-1]
    part = slice(leg.first, leg.last + 1)
    bent = found.q.copy()
    bent[(part.start + part.stop) // 2] += [1e-3, 0, 0]
    rows = make_row_solver(three, found.task).rows
    refused = verify_waypoints(found.degraded, HOME, bent, rows=rows, path_samples=(path, found.rest.share, part))
    assert "the tool path is missed by" in str(refused)


def test_the_end_of_a_motion_may_be_1e_5_off_the_goal(three):
    rows, degraded = make_row_solver(three, as_task(three, "planar")).rows, hf.Degraded(three, locked={"joint3": HOME[2]})
    q = np.array([HOME, HOME + np.array([0.1, 0.1, 0])])
    for miss, ok in ((5e-6, True), (1e-4, False)):
        goal = three.forward_kinematics(q[-1])
        goal[0, 3] += miss
        assert verify_waypoints(degraded, HOME, q, rows=rows, goals=goal[None]).ok == ok
        assert verify_waypoints(degraded, HOME, q, rows=rows, goal_q=q[-1] + [0, miss, 0]).ok == ok


def test_only_revolute_joints_without_limits_meet_a_goal_after_a_whole_turn():
    """A slide that is 2 pi m away is not there."""
    kinds = [hf.DH(a=1.0, alpha=0.3, velocity=1.0), hf.DH(a=0.5, alpha=0.2, type="prismatic")]
    arm = hf.Arm.from_dh(kinds, name="turn and slide")
    rows, q = make_row_solver(arm, as_task(arm, "position")).rows, np.array([[0.1, 0.2], [0.3, 0.4]])
    for joint, ok in ((0, True), (1, False)):
        goal = q[-1] + 2 * np.pi * np.eye(2)[joint]
        found = verify_waypoints(hf.Degraded(arm, speeds={0: 0.5}), q[0], q, rows=rows, goal_q=goal)
        assert found.ok == ok, found
        assert found.goal_miss == pytest.approx(0 if ok else 2 * np.pi, abs=1e-12)


def test_a_motion_and_the_timed_motion_have_the_worse_of_both_findings():
    first = Verification(faults=("a",), checked=3, exact_by="", goal_miss=0.1, path_miss=0.5, kept=((1.0, 5.0),))
    timed = Verification(faults=("b",), checked=4, exact_by="", goal_miss=0.2, path_miss=0.3, kept=((2.0, 4.0),))
    both = first.merge_timed(timed)
    assert both.faults == ("a", "in the timed motion, b")
    assert (both.checked, both.path_miss, both.kept) == (7, 0.5, ((2.0, 5.0),))
    assert timed.merge_timed(first).path_miss == 0.5
