"""Falls and swings of the page, against MuJoCo and the library's own falls."""

import mujoco
import numpy as np
import pinocchio as pin
import pytest

import dynamics
import holdfast as hf
import oracles

NO_DRY_FRICTION = {"coulomb": 0.0, "stiction": 0.0}
FALL = """(page, arm, [q, joints, time, gravity]) => {
    const free = arm.freeJoints(arm.joints.map((_, k) => k).filter((k) => !joints.includes(k)));
    return page.simulateFall(arm, q, free, time, gravity); }"""


def inner(arm, rng, count):
    """Configurations in the middle half of the limits."""
    q = oracles.inside(arm, rng, count)
    low, high = np.where(np.isfinite(arm.lower), arm.lower, q), np.where(np.isfinite(arm.upper), arm.upper, q)
    return (low + high) / 2 + (q - (low + high) / 2) / 2


def fall_in_mujoco(arm, q, time, step=5e-5):
    """Configuration after a time of a fall without stops and contacts, by MuJoCo's Runge-Kutta method."""
    spec = arm.to_mujoco()
    for joint in spec.joints:
        joint.limited = mujoco.mjtLimited.mjLIMITED_FALSE
        joint.frictionloss = 0.0
    spec.option.integrator, spec.option.timestep = mujoco.mjtIntegrator.mjINT_RK4, step
    spec.option.disableflags = int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[:] = q
    for _ in range(round(time / step)):
        mujoco.mj_step(model, data)
    return np.array(data.qpos)


@pytest.mark.parametrize("name", ["panda", "iiwa14", "xarm7", "crane", "planar-3r"])
def test_falls_are_mujocos(page_arm, rng, name):
    page = page_arm(name)
    rows = [(q, list(range(page.arm.n)), 0.2, page.arm.gravity) for q in inner(page.arm, rng, 3)]
    for (q, _, time, _), fall in zip(rows, page.call(FALL, rows), strict=True):
        assert fall["limitJoint"] is None
        np.testing.assert_allclose(fall["time"], np.linspace(0, time, len(fall["time"])), rtol=0, atol=1e-12)
        end = np.array(fall["configurations"][-1])
        np.testing.assert_allclose(end, fall_in_mujoco(page.arm, q, time), rtol=0, atol=1e-6)
        moved = page.arm.forward_kinematics(end)[:3, 3] - page.arm.forward_kinematics(q)[:3, 3]
        np.testing.assert_allclose(fall["drop"][-1], moved @ page.arm.gravity / np.linalg.norm(page.arm.gravity), atol=1e-12)


@pytest.mark.parametrize("name", ["panda", "crane"])
def test_falls_of_some_joints_are_the_librarys(page_arm, rng, name):
    page = page_arm(name)
    arm = page.arm
    rows = [
        (q, sorted(rng.permutation(arm.n)[:count].tolist()), 0.15, arm.gravity) for q in inner(arm, rng, 2) for count in (1, 3)
    ]
    for (q, joints, time, _), fall in zip(rows, page.call(FALL, rows), strict=True):
        options = {"friction": hf.Friction(**NO_DRY_FRICTION), "stops": False, "duration": time, "step": 2e-3}
        expected = hf.power_loss(arm, q, free=joints, **options)
        end = np.array(fall["configurations"][-1])
        assert fall["limitJoint"] is None
        np.testing.assert_allclose(end, expected.q_final, rtol=0, atol=1e-9)
        held = np.setdiff1d(range(arm.n), joints)
        np.testing.assert_array_equal(end[held], q[held])


def test_a_fall_ends_where_the_first_joint_is_at_its_limit(page_arm, rng):
    page = page_arm("panda")
    arm = page.arm
    rows = [(q, list(range(arm.n)), 2.0, arm.gravity) for q in inner(arm, rng, 4)]
    for (q, *_), fall in zip(rows, page.call(FALL, rows), strict=True):
        joint, q_end = fall["limitJoint"], np.array(fall["configurations"][-1])
        assert np.isclose(q_end[joint], [arm.lower[joint], arm.upper[joint]], rtol=0, atol=1e-4).any()
        end = fall["time"][-1]
        expected = hf.power_loss(arm, q, friction=hf.Friction(**NO_DRY_FRICTION), stops=False, duration=end, accuracy=1e-6)
        np.testing.assert_allclose(q_end, expected.q_final, rtol=0, atol=1e-4)
        np.testing.assert_allclose(fall["drop"][-1], expected.drop_at(end), rtol=0, atol=1e-4)


@pytest.mark.parametrize("name", ["panda", "crane"])
def test_swings_are_those_of_the_library(page_arm, rng, name):
    page = page_arm(name)
    arm = page.arm
    rows = [(q, joint) for q in oracles.inside(arm, rng, 2) for joint in range(arm.n)]
    for (q, joint), swing in zip(
        rows, page.call("(page, arm, [q, joint]) => page.swingJoint(arm, q, joint)", rows), strict=True
    ):
        settled = hf.indices.susceptibility.swing_energy(arm, [joint]).settle(q)
        np.testing.assert_allclose(swing["toRest"], settled[joint] - q[joint], rtol=0, atol=1e-5)
        assert abs(swing["toFarthest"]) >= abs(swing["toRest"]) - 1e-12
        assert arm.lower[joint] - 1e-12 <= q[joint] + swing["toFarthest"] <= arm.upper[joint] + 1e-12


@pytest.mark.parametrize("name", ["panda", "crane"])
def test_a_swing_without_friction_returns_to_its_potential_energy(page_arm, rng, name):
    arm = page_arm(name).arm
    model, data, _ = dynamics.to_pinocchio(arm)
    rows = [(q, joint) for q in inner(arm, rng, 6) for joint in np.flatnonzero(~arm.prismatic).tolist()]
    swings = page_arm(name).call("(page, arm, [q, joint]) => page.swingJoint(arm, q, joint)", rows)
    compared = 0
    for (q, joint), swing in zip(rows, swings, strict=True):
        farthest = q + swing["toFarthest"] * np.eye(arm.n)[joint]
        if arm.lower[joint] + 1e-6 < farthest[joint] < arm.upper[joint] - 1e-6:
            energies = [pin.computePotentialEnergy(model, data, angles) for angles in (farthest, q)]
            np.testing.assert_allclose(*energies, rtol=0, atol=1e-9)
            compared += abs(swing["toFarthest"]) > 1e-3
    assert compared
