"""Goals that leave the tool's z axis an angle: ``recover(..., within=)``."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

import holdfast as hf
import oracles
from holdfast.model.arm.task import as_task
from holdfast.response.faults import FaultEvent, feasible
from holdfast.response.recovery.task_rows import ROW_TOLERANCE, make_row_solver
from holdfast.response.recovery.verification import compute_row_errors

ARM = """<robot name="leaning">
  <link name="base"/><link name="column"/><link name="upper"/><link name="fore"/><link name="hand"/><link name="tool"/>
  <joint name="yaw" type="revolute"><parent link="base"/><child link="column"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <joint name="shoulder" type="revolute"><parent link="column"/><child link="upper"/><axis xyz="0 1 0"/>
    <origin xyz="0 0 0.4"/><limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><axis xyz="0 1 0"/>
    <origin xyz="0 0 0.5"/><limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <joint name="wrist" type="revolute"><parent link="fore"/><child link="hand"/><axis xyz="0 1 0"/>
    <origin xyz="0 0 0.4"/><limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <joint name="mount" type="fixed"><parent link="hand"/><child link="tool"/><origin xyz="0 0 0.1"/></joint>
</robot>"""


@pytest.fixture(scope="module")
def leaning(tmp_path_factory):
    file = tmp_path_factory.mktemp("arm") / "leaning.urdf"
    file.write_text(ARM)
    return hf.Arm.from_urdf(file)


def tilts_by_closed_form(x, z):
    """Angles between the vertical and the tool of that arm, its wrist at 0, at a place (x, 0, z): elbow on either side.

    The tool point is at x = a sin(s) + b sin(s + e) and z = 0.4 + a cos(s) + b cos(s + e), with a = b = 0.5, so that by the
    law of cosines the two links lean by the same angle to either side of the line to the place.
    """
    away = np.hypot(x, z - 0.4)
    half = np.arccos(away / 1.0)
    return np.arctan2(x, z - 0.4) + half, np.arctan2(x, z - 0.4) - half


def pose_with_axis(place, turn):
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = turn.as_matrix(), place
    return pose


@pytest.mark.parametrize("spin", [0.0, 2.0])
def test_a_cone_is_met_from_the_least_tilt_in_closed_form_on(leaning, spin):
    x, z = 0.6, 0.9
    least = min(abs(tilt) for tilt in tilts_by_closed_form(x, z))
    goal = pose_with_axis([x, 0, z], Rotation.from_euler("z", spin))  # any turn about the axis will do
    call = {"goal": goal, "clearance": False, "samples": 0}
    wide = hf.recover(leaning, {"wrist": 0.0}, [0.5, 0.2, 0.3, 0.0], within=least + 1e-3, **call)
    assert wide.verdict.answer == "solved"
    assert wide.within == least + 1e-3
    end = oracles.forward(leaning, wide.q[-1:])[0]
    np.testing.assert_allclose(end[:3, 3], [x, 0, z], atol=1e-6)
    assert Rotation.from_matrix(end[:3, :3]).apply([0, 0, 1])[2] == pytest.approx(np.cos(least), abs=1e-6)
    narrow = hf.recover(leaning, {"wrist": 0.0}, [0.5, 0.2, 0.3, 0.0], within=least - 1e-3, **call)
    assert narrow.verdict.answer == "undecided"  # nothing is proved of the cone
    assert "whole cone" in narrow.verdict.why
    tilt = next(one for one in (narrow.relaxed, *narrow.choices) if one.names == ("tilt of tool z",))
    assert tilt.misses[0] == pytest.approx(1e-3, abs=3e-6)


def test_a_place_out_of_reach_is_proved_for_every_orientation(leaning):
    call = {"clearance": False, "samples": 0, "within": np.deg2rad(40)}
    far = hf.recover(leaning, {"wrist": 0.0}, np.zeros(4), goal=pose_with_axis([1.2, 0, 0.9], Rotation.identity()), **call)
    assert (far.verdict.answer, far.verdict.kind) == ("proved infeasible", "reach bound")
    assert "every orientation" in far.verdict.why
    behind = pose_with_axis([-0.5, 1e-3, 0.5], Rotation.identity())
    limited = leaning.with_limits([-1, 0.2, 0.2, -3], [1, 1.5, 1.5, 3])
    boxes = hf.recover(limited, {"wrist": 0.0}, [0, 0.3, 0.3, 0], goal=behind, **call)
    assert (boxes.verdict.answer, boxes.verdict.kind) == ("proved infeasible", "boxes")
    assert "every orientation" in boxes.verdict.why
    assert boxes.certificate() is not None


def test_the_least_tilt_of_a_panda_is_that_of_an_optimiser():
    arm, at = hf.arms.load("panda"), np.array([0.3, 0.2, 0.1, -2.0, 0.1, 2.0, 0.5])
    healthy = at + np.array([0.5, 0.3, 0.0, -0.3, 0.5, -0.4, 0.2])
    goal = arm.forward_kinematics(healthy)
    free = [0, 1, 2, 4, 5, 6]

    def tilt_and_error(x):
        pose = oracles.forward(arm, np.insert(x, 3, -2.0)[None])[0]
        return pose[:3, 2] @ goal[:3, 2], pose[:3, 3] - goal[:3, 3]

    rng, least = np.random.default_rng(0), np.inf
    for _ in range(3):
        found = minimize(
            lambda x: -tilt_and_error(x)[0],
            healthy[free] + rng.normal(0, 0.1, len(free)),
            method="SLSQP",
            bounds=list(zip(arm.lower[free], arm.upper[free], strict=True)),
            constraints={"type": "eq", "fun": lambda x: tilt_and_error(x)[1]},
        )
        if np.abs(tilt_and_error(found.x)[1]).max() < 1e-6:
            least = min(least, float(np.arccos(-found.fun)))
    assert 0 < np.rad2deg(least) < 20
    call = {"goal": goal, "clearance": False, "samples": 0}
    assert hf.recover(arm, {3: -2.0}, at, within=least + 2e-3, **call).verdict.answer == "solved"
    narrow = hf.recover(arm, {3: -2.0}, at, within=least - 2e-3, **call)
    assert narrow.verdict.answer == "undecided"
    wide = hf.recover(arm, {3: -2.0}, at, within=np.deg2rad(30), **call)
    end = oracles.forward(arm, wide.q[-1:])[0]
    away = Rotation.from_matrix(goal[:3, :3]).inv() * Rotation.from_matrix(end[:3, :3])
    assert np.arccos(away.apply([0, 0, 1])[2]) <= np.deg2rad(30)
    np.testing.assert_allclose(end[:3, 3], goal[:3, 3], atol=1e-6)


def test_the_tilt_and_its_slope(rng):
    arm, within = hf.arms.load("panda"), 0.3
    solver = make_row_solver(arm, as_task(arm, "position"), within)
    q = rng.uniform(arm.lower, arm.upper, (40, arm.n))
    poses = arm.forward_kinematics(rng.uniform(arm.lower, arm.upper, (40, arm.n)))
    z = oracles.forward(arm, q)[:, :3, 2]
    tilt = np.array([Rotation.align_vectors(b[None], a[None])[0].magnitude() for a, b in zip(z, poses[:, :3, 2], strict=True)])
    found = solver.compute_errors(q, poses)
    np.testing.assert_allclose(found[:, 3], np.maximum(tilt - within + ROW_TOLERANCE, 0), atol=1e-7)
    np.testing.assert_allclose(compute_row_errors(arm, solver.rows, q, poses), found, atol=1.1e-6)  # no margin there
    assert (found[:, 3] == 0).any()
    step = 1e-6
    by_differences = np.stack(
        [
            (solver.compute_errors(q + d, poses) - solver.compute_errors(q - d, poses)) / (2 * step)
            for d in step * np.eye(arm.n)
        ],
        axis=2,
    )
    np.testing.assert_allclose(solver.compute_jacobian(q, poses), by_differences, atol=1e-6)


@pytest.mark.parametrize("at", [None, [0.5, 0.2, 0.3, 0.0]])
def test_a_goal_in_a_cone_is_feasible_from_the_least_tilt_on(leaning, at):
    least = min(abs(tilt) for tilt in tilts_by_closed_form(0.6, 0.9))
    goal, fault = pose_with_axis([0.6, 0, 0.9], Rotation.from_euler("z", 1.0)), FaultEvent("locked", "wrist", 0.0)
    found = [feasible(leaning, goal, {fault: 0.0}, within=least + off, at=at) for off in (-1e-3, 1e-3)]
    assert [one.answer for one in found] == ["not found", "yes"]
    end = oracles.forward(leaning, found[1].q[None])[0]
    np.testing.assert_allclose(end[:3, 3], [0.6, 0, 0.9], atol=1e-6)
    assert np.arccos(end[2, 2]) <= least + 1e-3
    assert found[1].q[3] == 0


def test_a_healthy_or_weak_arm_and_a_position_without_an_axis(leaning):
    goal, within = pose_with_axis([0.6, 0, 0.9], Rotation.identity()), np.deg2rad(5)
    assert feasible(leaning, goal, {}, within=within).answer == "yes"
    panda = hf.arms.load("panda")
    goal = panda.forward_kinematics(np.array([0.0, -0.3, 0.0, -2.0, 0.0, 2.0, 0.8]))
    weak = {FaultEvent("weak", "panda_joint2", 0.0, parameters={"gain": 0.9}): 0.0}
    found = feasible(panda, goal, weak, within=within)
    assert found.answer == "yes"
    assert oracles.forward(panda, found.q[None])[0, :3, 2] @ goal[:3, 2] >= np.cos(within)
    with pytest.raises(hf.HoldfastError, match="give a pose"):
        feasible(panda, goal[:3, 3], weak, within=within)


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"within": 0.0}, "within is 0 rad; it must be from"),
        ({"within": 4.0}, "within is 4 rad"),
        ({"within": 0.3, "task": ["vx", "vy"]}, "within needs all position rows"),
    ],
)
def test_a_wrong_cone_is_refused(leaning, options, sentence):
    with pytest.raises(hf.HoldfastError, match=sentence):
        hf.recover(leaning, {"wrist": 0.0}, np.zeros(4), samples=0, **options)
