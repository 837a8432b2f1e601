"""The compiled arm behind a window: frames, following the hand, self-motions, and what it reads."""

from __future__ import annotations

import numpy as np
import pytest

import holdfast as hf
from holdfast.interface.studio.machine import REACH_TOLERANCE, CompiledArm, to_plain
from holdfast.model.arm.task import as_task


@pytest.fixture(scope="module")
def machine(mixed7):
    return CompiledArm(mixed7, as_task(mixed7, "pose"))


def test_bars_are_those_of_the_library(machine, rng):
    q = rng.uniform(-1, 1, 7)
    rho = hf.indices.relative_manipulability(machine.arm)
    bars = machine.evaluate_index_bars(q, "relative-manipulability")
    assert bars["values"] == rho.by_joint(q).tolist()
    assert bars["worst"] == int(rho.worst_joint(q))
    assert (bars["title"], bars["better"], bars["unit"]) == ("relative manipulability", "larger", ["1"] * 7)
    with pytest.raises(hf.ArmError, match="link"):  # nothing is known of these bodies
        machine.evaluate_susceptibility_bars(q, "torque")
    panda = hf.arms.load("panda")
    compiled, q = CompiledArm(panda, as_task(panda, "pose")), np.array(hf.arms.about("panda").home)
    bars = compiled.evaluate_susceptibility_bars(q, "torque")
    model = hf.susceptibility.by_name("torque", panda)
    assert bars["values"] == abs(model.by_joint(q)).tolist()
    assert bars["values"][bars["worst"]] == max(bars["values"])
    assert bars["unit"] == ["N m"] * 7


def test_an_arm_without_redundancy_has_no_bars():
    arm = hf.arms.load("ur5")
    with pytest.raises(hf.TaskError, match="not redundant"):
        CompiledArm(arm, as_task(arm, "pose")).evaluate_index_bars(np.zeros(6), "relative-manipulability")


def test_numbers_that_json_lacks_are_null():
    assert to_plain(np.array([[1.5, np.nan], [np.inf, -np.inf]])) == [[1.5, None], [None, None]]
    assert to_plain(np.zeros((0, 3))) == []


def test_the_drop_after_a_power_loss_is_that_of_the_accelerations(rng):
    """Half the vertical acceleration of the tool times the time squared, with accelerations of MuJoCo."""
    mujoco = pytest.importorskip("mujoco")
    panda = hf.arms.load("panda")
    machine = CompiledArm(panda, as_task(panda, "pose"))
    q = np.array(hf.arms.about("panda").home) + rng.uniform(-0.2, 0.2, 7)
    text = machine.describe_power_loss(q, tuple(range(7)), None)
    assert text.startswith("Without torque the arm falls: ")
    data = mujoco.MjData(panda.to_mujoco().compile())
    data.qpos[:] = q
    mujoco.mj_forward(data.model, data)
    rates = data.qacc
    fall = -(panda.jacobian(q)[2] @ rates)
    numbers = [float(part.split(" mm")[0].split()[-1]) for part in text.split("mm after")[:2]]
    assert numbers[0] == pytest.approx(1000 * fall * 0.05**2 / 2, rel=1e-2)
    assert numbers[1] == pytest.approx(4 * numbers[0], rel=1e-2)
    assert machine.describe_power_loss(q, (), None) == ""


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
