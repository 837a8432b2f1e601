"""The compiled arm behind a window: frames, following the hand, self-motions, and what it reads."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg

import holdfast as hf
import oracles
from holdfast.interface.studio.scene.bars import losses_html
from holdfast.interface.studio.scene.machine import REACH_TOLERANCE, CompiledArm
from holdfast.model.arm.task import as_task


@pytest.fixture(scope="module")
def machine(mixed7):
    return CompiledArm(mixed7, as_task(mixed7, "pose"))


def test_the_tool_is_followed_with_locked_joints(machine, rng):
    q = np.clip(rng.uniform(-0.8, 0.8, 7), machine.arm.lower + 0.1, machine.arm.upper - 0.1)
    for failed in ((), (3,)):
        there = q + 0.02 * rng.uniform(-1, 1, 7)
        there[list(failed)] = q[list(failed)]
        pose = machine.tool_pose(there)
        found, on = machine.solve_pose_near(q, pose, failed)
        assert on
        np.testing.assert_allclose(machine.tool_pose(found), pose, atol=1e-5)
        assert (found[list(failed)] == q[list(failed)]).all()
        assert ((found >= machine.arm.lower) & (found <= machine.arm.upper)).all()


def test_out_of_reach_the_arm_never_goes_away_from_the_pose(machine, rng):
    q = rng.uniform(-0.8, 0.8, 7)
    pose = machine.tool_pose(q)
    far = pose.copy()
    far[:3, 3] += 10 * machine.size
    before = np.linalg.norm(far[:3, 3] - pose[:3, 3])
    for _ in range(5):
        q, on = machine.solve_pose_near(q, far, ())
        assert not on
        after = np.linalg.norm(far[:3, 3] - machine.tool_pose(q)[:3, 3])
        assert after <= before + 1.0  # orientation counts as well
        before = after


def test_a_self_motion_leaves_the_hand_where_it_is(machine, rng):
    q = rng.uniform(-0.5, 0.5, 7)
    hand, along = machine.tool_pose(q), machine.self_motion_directions(q, ())[0]
    for _ in range(20):
        new, direction = machine.step_self_motion(q, 0.03 * along, ())
        if not direction.any():
            break  # a limit
        assert np.linalg.norm(new - q) == pytest.approx(0.03, rel=0.2)
        assert direction @ along > 0.7
        q, along = new, direction
        np.testing.assert_allclose(machine.tool_pose(q), hand, atol=1e-4)


def test_without_redundancy_nothing_slides(machine, rng):
    q = rng.uniform(-0.5, 0.5, 7)
    assert len(machine.self_motion_directions(q, (2,))) == 0
    new, direction = machine.step_self_motion(q, np.full(7, 0.01), (2,))
    assert (new == q).all()
    assert not direction.any()


def test_reading_is_of_the_failed_joint_or_of_the_worst(machine, rng):
    q = rng.uniform(-1, 1, 7)
    rho = hf.indices.relative_manipulability(machine.arm)
    reading = machine.evaluate_live_reading(q, (), "relative-manipulability", "torque")
    assert reading.failure_joints == (int(rho.worst_joint(q)),)
    np.testing.assert_array_equal(reading.bars.values, rho.by_joint(q))
    assert machine.evaluate_live_reading(q, (5,), "relative-manipulability", "torque").failure_joints == (5,)
    assert isinstance(reading.weights, str)  # nothing is known of these bodies
    assert "link" in reading.weights


@pytest.mark.parametrize(("task", "angular"), [("pose", [0, 1, 2]), ("pointing", [0, 1]), ("position", [])])
def test_ellipsoids_are_those_of_velocities_without_prescribed_rotation(mixed7, rng, task, angular):
    machine = CompiledArm(mixed7, as_task(mixed7, task))
    q = rng.uniform(-1, 1, 7)
    reading = machine.evaluate_live_reading(q, (4,), "relative-manipulability", "torque")
    j = oracles.jacobian(mixed7, q[None])[0]
    rotations = (mixed7.frames(q)[-1][:3, :3].T @ j[3:])[angular] if angular else np.zeros((1, 7))
    for shape, failed in ((reading.healthy_ellipsoid, []), (reading.failed_ellipsoid, [4])):
        basis = scipy.linalg.null_space(np.delete(rotations, failed, axis=1))
        left, radii, _ = np.linalg.svd(np.delete(j[:3], failed, axis=1) @ basis, full_matrices=False)
        np.testing.assert_allclose(shape.radii, radii, atol=1e-12)
        np.testing.assert_allclose(np.abs(np.sum(shape.axes * left, axis=0)), 1, atol=1e-6)
    text = losses_html(mixed7, machine.task, reading, (4,))
    assert ("ellipsoid of the non-rotating tool, m/s" in text) == bool(angular)
    for radii in (reading.healthy_ellipsoid.radii, reading.failed_ellipsoid.radii):
        assert " × ".join(f"{radius:.2g}" for radius in radii) in text


def test_an_arm_without_redundancy_has_a_sentence_in_place_of_bars():
    arm = hf.arms.load("ur5")
    reading = CompiledArm(arm, as_task(arm, "pose")).evaluate_live_reading(
        np.array(hf.arms.about("ur5").home), (), "relative-manipulability", "torque"
    )
    assert "not redundant" in reading.bars
    assert reading.failure_joints == ()
    assert not isinstance(reading.weights, str)


def test_laws_are_made_once_and_misspelt_ones_refused(machine):
    assert machine.get_law("damped:0.2") is machine.get_law("damped:0.2")
    assert "damping 0.2" in machine.get_law("damped:0.2").describe()
    with pytest.raises(hf.InputError, match="'much' is not a number; give one: damping factor"):
        machine.get_law("damped:much")
    with pytest.raises(hf.InputError, match="takes no setting; write pseudoinverse alone"):
        machine.get_law("pseudoinverse:2")
    with pytest.raises(hf.InputError, match="give one"):
        machine.get_law("damped:")
    with pytest.raises(hf.InputError, match="not known"):
        machine.get_law("best")


def test_a_target_beside_the_arm_is_within_its_limits_and_away(rng):
    for name in ("panda", "ur5-rail", "planar-3r"):
        arm = hf.arms.load(name)
        machine = CompiledArm(arm, as_task(arm, hf.arms.about(name).task))
        low, high = (np.where(np.isfinite(x), x, s) for x, s in ((arm.lower, -3.0), (arm.upper, 3.0)))
        for q in (*rng.uniform(low, high, (20, arm.n)), low, high):
            near = machine.nearby_configuration(q)
            assert ((near >= arm.lower) & (near <= arm.upper)).all()
            assert machine.pose_error_norm(q, machine.tool_pose(near)) > REACH_TOLERANCE


def test_only_arms_with_masses_fall():
    arm = hf.Arm.from_dh([hf.DH(a=1.0, alpha=0.0)] * 3)
    assert not CompiledArm(arm, as_task(arm, "planar")).has_masses
    assert CompiledArm(hf.arms.load("panda"), as_task(hf.arms.load("panda"), "pose")).has_masses
