"""Verdicts on poses without a solution: configurations by Pinocchio, triangles in closed form, collisions, and limits."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest

import holdfast as hf
from holdfast import InputError
from holdfast.model.arms.builtin import DATA_FOLDER
from holdfast.response.recovery import PoseVerdict


def pinocchio_pose(name, tip, joint_names, q):
    model = pin.buildModelFromUrdf(str(DATA_FOLDER / f"{name}.urdf"))
    data, values = model.createData(), pin.neutral(model)
    for joint, value in zip(joint_names, q, strict=True):
        values[model.joints[model.getJointId(joint)].idx_q] = value
    pin.framesForwardKinematics(model, data, values)
    return data.oMf[model.getFrameId(tip)].homogeneous


@pytest.mark.parametrize(("name", "tip"), [("panda", "panda_hand_tcp"), ("iiwa14", None)])
def test_a_pose_of_a_random_configuration_is_reachable(name, tip, rng):
    arm = hf.arms.load(name) if tip else hf.Arm.from_urdf(DATA_FOLDER / f"{name}.urdf")
    tip = tip or arm.chain.tip
    for _ in range(4):
        pose = pinocchio_pose(name, tip, arm.joint_names, rng.uniform(arm.lower, arm.upper))
        answer = hf.explain_ik(arm, pose, seed=3)
        assert answer.verdict == PoseVerdict.REACHABLE
        assert ((answer.q >= arm.lower) & (answer.q <= arm.upper)).all()
        assert np.abs(pinocchio_pose(name, tip, arm.joint_names, answer.q) - pose).max() < 2e-6


def test_it_finds_what_a_solver_with_one_start_misses(rng):
    arm = hf.arms.load("panda")
    poses = arm.forward_kinematics(rng.uniform(arm.lower, arm.upper, (60, 7)))
    missed = poses[~hf.solve_ik(arm, poses, restarts=1).success]
    assert len(missed) > 3
    assert all(hf.explain_ik(arm, pose).verdict == PoseVerdict.REACHABLE for pose in missed[:3])


def test_a_pose_beyond_the_links_is_proved_unreachable(rng):
    arm = hf.arms.load("panda")
    shoulder = np.array([0, 0, 0.333])
    pose = arm.forward_kinematics(rng.uniform(arm.lower, arm.upper))
    direction = rng.normal(size=3)
    pose[:3, 3] = shoulder + (arm.end_to_end + rng.uniform(0.02, 1)) * direction / np.linalg.norm(direction)
    answer = hf.explain_ik(arm, pose)
    assert answer.verdict == PoseVerdict.UNREACHABLE
    assert "boxes of joints" in answer.proof or "box of joints" in answer.proof
    assert answer.values_beyond_limits == {}


def test_verdicts_of_two_links_are_those_of_the_triangle(rng):
    verdicts, beyond = [], 0
    for case in range(12):
        a, b = rng.uniform(0.5, 1.0, 2)
        low, width = rng.uniform(-2.5, -0.5, 2), rng.uniform(1.0, 3.0, 2)
        arm = hf.Arm.from_dh([hf.DH(a=a, alpha=0.0), hf.DH(a=b, alpha=0.0)], name="2R").with_limits(low, low + width)
        q = low + width * rng.uniform(0.05, 0.95, 2)
        target = arm.forward_kinematics(q)[:2, 3] if case < 4 else rng.uniform(-1, 1, 2) * (a + b)
        radius, angle = np.hypot(*target), np.arctan2(target[1], target[0])
        cosine = (radius**2 - a * a - b * b) / (2 * a * b)
        solutions = []
        for elbow in (np.arccos(cosine), -np.arccos(cosine)) if abs(cosine) <= 1 else ():
            first = angle - np.arctan2(b * np.sin(elbow), a + b * np.cos(elbow))
            q = np.array([first, elbow])
            solutions.append(q - 2 * np.pi * np.round((q - low - width / 2) / (2 * np.pi)))
        is_reachable = any(((q >= low) & (q <= low + width)).all() for q in solutions)
        answer = hf.explain_ik(arm, target, task="planar", starts=30)
        assert answer.verdict == (PoseVerdict.REACHABLE if is_reachable else PoseVerdict.UNREACHABLE)
        verdicts.append(answer.verdict)
        assert (answer.values_beyond_limits == {}) == (is_reachable or not solutions)
        if answer.values_beyond_limits:
            beyond += 1
            # An error of 1e-6 m moves a nearly stretched elbow by about 1e-3 rad.
            exceeding = [dict(zip(arm.joint_names, q, strict=True)) for q in solutions]
            assert any(
                all(abs(q[name] - value) < 3e-3 for name, value in answer.values_beyond_limits.items()) for q in exceeding
            )
            fewest = min(int(((q < low) | (q > low + width)).sum()) for q in solutions)
            assert len(answer.values_beyond_limits) == fewest
    assert len(set(verdicts)) == 2
    assert beyond


def test_a_locked_joint_is_a_joint_with_equal_limits():
    arm, q = hf.arms.load("panda"), np.array([0.0, -0.8, 0.0, -2.4, 0.0, 1.6, 0.8])
    pose = arm.forward_kinematics(q)
    lower, upper = arm.lower.copy(), arm.upper.copy()
    lower[3] = upper[3] = -0.1
    answer = hf.explain_ik(arm.with_limits(lower, upper), pose)
    assert answer.verdict == PoseVerdict.UNREACHABLE
    assert "panda_joint4" in answer.values_beyond_limits
    assert any("panda_joint4" in line and "limit -5.73 deg" in line for line in answer.describe())


def test_a_ball_at_the_target_is_named():
    arm = hf.arms.load("planar-3r")
    cell = hf.Cell([hf.cell.Sphere("ball", 0.3, pose=[1.5, 0.2, 0.0])])
    clearance = hf.Clearance(arm, hf.Capsules.along_links(arm, 0.02), cell, itself=False)
    assert hf.explain_ik(arm, [1.5, 0.2], task="planar").verdict == PoseVerdict.REACHABLE
    answer = hf.explain_ik(arm, [1.5, 0.2], task="planar", clearance=clearance, starts=50, time_limit=2)
    assert answer.verdict != PoseVerdict.REACHABLE
    assert "ball" in answer.colliding_pair
    assert any("If collisions are ignored" in line for line in answer.describe())


def test_without_time_the_answer_is_undecided_and_states_the_nearest_pose():
    arm = hf.arms.load("panda")
    pose = np.array([[1.0, 0, 0, 0.9], [0, -1, 0, 0], [0, 0, -1, 0.6], [0, 0, 0, 1]])
    answer = hf.explain_ik(arm, pose, starts=20, time_limit=1e-9)
    assert answer.verdict == PoseVerdict.UNDECIDED
    assert not answer.proof
    reached = arm.forward_kinematics(answer.q)
    assert np.linalg.norm(reached[:3, 3] - pose[:3, 3]) == pytest.approx(answer.position_error, rel=1e-6)
    assert answer.position_error > 1e-3
    assert any("random starts" in line for line in answer.describe())
    assert answer.to_dict()["verdict"] == "undecided"


@pytest.mark.parametrize(("options", "words"), [({"starts": 0}, "starts is 0"), ({"time_limit": 0}, "time_limit 0")])
def test_bad_options_are_named(options, words):
    with pytest.raises(InputError, match=words):
        hf.explain_ik(hf.arms.load("planar-3r"), [1, 1], task="planar", **options)
