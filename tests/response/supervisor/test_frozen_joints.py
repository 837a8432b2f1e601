"""Frozen joints in the inverse kinematics of mink and pink."""

from __future__ import annotations

import mink
import numpy as np
import pink
import pinocchio
import pytest

import holdfast as hf
from holdfast.response.diagnosis import FaultVerdict
from holdfast.response.supervisor import FrozenJoints


@pytest.mark.parametrize("library", ["mink", "pink"])
@pytest.mark.parametrize("joint", [1, 3])
def test_a_frozen_joint_stands_still_and_the_tool_reaches_its_target(library, joint):
    arm, frozen, step = hf.arms.load("panda"), FrozenJoints(), 0.01
    home = np.array(hf.arms.about("panda").home)
    target = arm.forward_kinematics(home)[:3, 3] + [0.1, 0.15, -0.1]
    costs = {"position_cost": 1.0, "orientation_cost": 0.0}
    if library == "mink":
        configuration = mink.Configuration(arm.to_mujoco().compile(), q=home)
        task = mink.FrameTask("tool", "site", **costs)
        task.set_target(mink.SE3.from_translation(target))
    else:
        model = arm.to_pinocchio()
        configuration = pink.Configuration(model, model.createData(), home)
        task = pink.FrameTask("tool", **costs)
        task.set_target(pinocchio.SE3(np.eye(3), target))
    solve_ik = {"mink": mink.solve_ik, "pink": pink.solve_ik}[library]
    speeds = []
    for cycle in range(400):
        if cycle == 20:
            verdict = FaultVerdict(True, 0.2, joint=arm.joint_names[joint], kind="locked")
            assert frozen.add_faulty_joint(verdict)
            assert not frozen.add_faulty_joint(verdict)
        velocity = np.asarray(solve_ik(configuration, [task], step, "daqp", constraints=[frozen], limits=[]))
        configuration.integrate_inplace(velocity, step)
        speeds.append(abs(velocity[joint]))
    assert max(speeds[:20]) > 0.01
    assert max(speeds[20:]) < 1e-12
    np.testing.assert_allclose(arm.forward_kinematics(np.asarray(configuration.q))[:3, 3], target, atol=1e-9)


def test_only_verdicts_of_joints_that_stand_still_freeze():
    frozen = FrozenJoints()
    for verdict in (FaultVerdict(False), FaultVerdict(True, joint="j", kind="weak"), FaultVerdict(True, kind="locked")):
        assert not frozen.add_faulty_joint(verdict)
    assert frozen.joints == []


@pytest.mark.parametrize("model", ["to_mujoco", "to_pinocchio"])
def test_a_joint_that_the_model_lacks_is_named(model):
    made = getattr(hf.arms.load("planar-2r"), model)()
    configuration = type("Configuration", (), {"model": made.compile() if model == "to_mujoco" else made})
    with pytest.raises(hf.InputError, match="the model has no joint 'x' to freeze; its joints are 'joint1', 'joint2'"):
        FrozenJoints(["x"]).compute_jacobian(configuration)
