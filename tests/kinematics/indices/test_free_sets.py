"""Susceptibilities of joints that fail together: Pinocchio, differences, one joint of the paper, and the first millisecond."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import susceptibility as sus
from holdfast.core.registry import SUSCEPTIBILITY_REGISTRY
from holdfast.core.status import Status
from holdfast.interface.cli.values import read_objective

pin = pytest.importorskip("pinocchio")
pytestmark = pytest.mark.interpreted


@pytest.fixture
def loaded(rng):
    """Six joints, one sliding, nothing aligned, a payload, rotor inertias, gravity askew."""
    return oracles.with_bodies(oracles.random_arm(rng, types="RRPRRR", limits=2.0), rng, payload=True, armature=True)


def mass_matrix(model, data, q):
    upper = np.triu(pin.crba(model, data, q))
    return upper + np.triu(upper, 1).T


def accelerations(arm, q, free):
    """From Pinocchio's mass matrix and torques, (n,)."""
    model, _ = oracles.to_pinocchio(arm)
    data = model.createData()
    inertia = mass_matrix(model, data, q)
    torque = pin.computeGeneralizedGravity(model, data, q)
    a = np.zeros(arm.n)
    a[free] = -np.linalg.solve(inertia[np.ix_(free, free)], torque[free])
    return a, torque


def down(arm):
    return arm.gravity / np.linalg.norm(arm.gravity)


@pytest.mark.parametrize("free", [[0, 1, 2, 3, 4, 5], [1, 2, 4], [0, 5]])
def test_values_of_pinocchio(loaded, free, rng):
    model, tool = oracles.to_pinocchio(loaded)
    data = model.createData()
    acceleration, release, tool_drop = (make(loaded, free) for make in (sus.free_acceleration, sus.release, sus.tool_drop))
    for q in oracles.inside(loaded, rng, 5):
        a, torque = accelerations(loaded, q, free)
        if len(free) == loaded.n:
            np.testing.assert_allclose(pin.aba(model, data, q, np.zeros(6), np.zeros(6)), a, rtol=1e-9, atol=1e-9)
        jacobian = pin.computeFrameJacobian(model, data, q, tool, pin.LOCAL_WORLD_ALIGNED)
        started = acceleration.evaluate(q)
        np.testing.assert_allclose(started.by_joint, a, rtol=1e-10, atol=1e-10)
        assert started.value == pytest.approx(a @ a, rel=1e-10)
        assert release(q) == pytest.approx(-torque @ a, rel=1e-10)
        assert tool_drop(q) == pytest.approx(down(loaded) @ jacobian[:3] @ a, rel=1e-10)


def test_gradients_of_pinocchio(loaded, rng):
    """Of all joints: the derivatives of forward dynamics and of the tool's acceleration at fixed joint accelerations."""
    model, tool = oracles.to_pinocchio(loaded)
    data, still = model.createData(), np.zeros(loaded.n)
    acceleration, release, tool_drop = (make(loaded) for make in (sus.free_acceleration, sus.release, sus.tool_drop))
    for q in oracles.inside(loaded, rng, 5):
        a, torque = accelerations(loaded, q, list(range(6)))
        slope = pin.computeABADerivatives(model, data, q, still, still)[0].copy()
        torque_slope = pin.computeGeneralizedGravityDerivatives(model, data, q).copy()
        np.testing.assert_allclose(acceleration.jacobian(q), slope, rtol=1e-9, atol=1e-9 * np.abs(slope).max())
        expected = -torque_slope.T @ a - slope.T @ torque
        np.testing.assert_allclose(release.gradient(q), expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())
        pin.computeForwardKinematicsDerivatives(model, data, q, still, a)
        pin.updateFramePlacements(model, data)
        turn = data.oMf[tool].rotation
        fixed = turn @ pin.getFrameAccelerationDerivatives(model, data, tool, pin.LOCAL)[1][:3]
        jacobian = pin.computeFrameJacobian(model, data, q, tool, pin.LOCAL_WORLD_ALIGNED)
        fixed += np.cross(jacobian[3:], jacobian[:3] @ a, axis=0)  # the tool's own axes turn
        expected = down(loaded) @ (fixed + jacobian[:3] @ slope)
        np.testing.assert_allclose(tool_drop.gradient(q), expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("name", ["free-acceleration", "release", "tool-drop"])
@pytest.mark.parametrize("free", [None, ["j0", "j2"], [3]])
def test_gradients_against_differences(loaded, name, free, rng):
    measure = SUSCEPTIBILITY_REGISTRY.make(name, loaded, free=free)
    q = oracles.inside(loaded, rng, 4)
    for x, gradient in zip(q, measure.gradient(q), strict=True):
        steps = 1e-5 * np.eye(loaded.n)
        differences = (measure(x + steps) - measure(x - steps)) / 2e-5
        np.testing.assert_allclose(gradient, differences, rtol=1e-6, atol=1e-7 * max(1.0, np.abs(gradient).max()))


def test_one_joint_is_the_measure_of_the_paper(loaded, rng):
    q = oracles.inside(loaded, rng, 20)
    alone, torque = sus.acceleration(loaded).by_joint(q), loaded.gravity_torque(q)
    slopes = sus.acceleration(loaded).jacobian(q)
    for k in (0, 2, 5):
        together = sus.free_acceleration(loaded, [k])
        np.testing.assert_allclose(together.by_joint(q), alone * (np.arange(6) == k), rtol=1e-13)
        scale = np.abs(slopes[:, k]).max()
        np.testing.assert_allclose(together.jacobian(q)[:, k], slopes[:, k], rtol=1e-11, atol=1e-12 * scale)
        np.testing.assert_allclose(sus.release(loaded, [k])(q), -torque[:, k] * alone[:, k], rtol=1e-13)
        falls = np.einsum("r,ri,i->r", alone[:, k], loaded.jacobian(q)[:, :3, k], down(loaded))
        np.testing.assert_allclose(sus.tool_drop(loaded, [k])(q), falls, rtol=1e-12, atol=1e-12)


def test_the_first_milliseconds_of_a_fall(loaded, rng):
    """``alpha t^2 / 2`` and ``sigma t^2 / 2`` are drop and kinetic energy of Pinocchio's motion, up to the fourth order."""
    model, tool = oracles.to_pinocchio(loaded)
    data = model.createData()
    tool_drop, release = sus.tool_drop(loaded), sus.release(loaded)

    def rates(state):
        return np.concatenate([state[6:], pin.aba(model, data, state[:6], state[6:], np.zeros(6))])

    def height(q):
        pin.framesForwardKinematics(model, data, q)
        return down(loaded) @ data.oMf[tool].translation

    for q in oracles.inside(loaded, rng, 3):
        deviations, alpha, sigma = [], tool_drop(q), release(q)
        for time in (0.004, 0.002):
            state, step = np.concatenate([q, np.zeros(6)]), time / 8
            for _ in range(8):
                k1 = rates(state)
                k2 = rates(state + step / 2 * k1)
                k3 = rates(state + step / 2 * k2)
                state = state + step / 6 * (k1 + 2 * k2 + 2 * k3 + rates(state + step * k3))
            energy = state[6:] @ mass_matrix(model, data, state[:6]) @ state[6:] / 2  # with the rotors
            drop = height(state[:6]) - height(q)
            deviations.append((2 * drop / time**2 - alpha, 2 * energy / time**2 - sigma))
        for far, near, size in zip(*deviations, (9.81, sigma), strict=True):
            assert abs(far) < 0.05 * size
            assert near == pytest.approx(far / 4, rel=0.1, abs=1e-6 * size)  # of second order, relative to the first term


def test_singular_sets_have_no_number(rng):
    """Two parallel slides with nothing between them: their sum moves the mass, their difference nothing."""
    slides = [hf.Joint(f"s{k}", "prismatic", np.eye(4), axis=np.array([0, 0, 1.0]), lower=-1, upper=1) for k in range(2)]
    empty, mass = hf.Link(0.0, np.zeros(3), np.zeros((3, 3))), hf.Link(1.0, np.zeros(3), 0.1 * np.eye(3))
    arm = hf.Arm(name="slides", joints=tuple(slides), links=(empty, mass))
    result = sus.tool_drop(arm).evaluate([0.1, 0.2])
    assert np.isnan(result.value)
    assert result.status == Status.NO_INERTIA
    assert sus.tool_drop(arm, [1])([0.1, 0.2]) == pytest.approx(9.81)
    with_rotor = replace(arm, joints=(replace(slides[0], armature=1.0), slides[1]))
    assert np.isfinite(sus.tool_drop(with_rotor)([0.1, 0.2]))
    unloaded = replace(arm, links=(mass, empty))
    with pytest.raises(hf.ArmError, match="nothing behind joint 's1' has mass"):
        sus.release(unloaded)
    assert np.isfinite(sus.release(unloaded, ["s0"])([0.1, 0.2]))


def test_no_gravity_no_fall(loaded, rng):
    q = oracles.inside(loaded, rng, 3)
    for name in ("free-acceleration", "release", "tool-drop"):
        np.testing.assert_array_equal(sus.by_name(name, replace(loaded, gravity=np.zeros(3)))(q), 0)


def test_names_of_sets():
    arm = hf.arms.load("planar-3r")
    assert sus.by_name("release:1,3", arm).free == sus.release(arm, ["joint1", "joint3"]).free == (0, 2)
    assert sus.by_name("release:joint3,joint1", arm).label == "release:joint1,joint3"
    assert sus.release(arm, [0, 1, 2]).label == sus.release(arm).label == "release"
    assert sus.by_name("free-acceleration:free=1,2", arm).settings["free"] == ("joint1", "joint2")
    assert "joint1, joint3 swing free together" in sus.by_name("tool-drop:1,3", arm).describe()
    assert read_objective(arm, "--minimise", "tool-drop:joint1,3 + 0.1*release:joint2", "planar").terms[0][1].free == (0, 2)
    for bad, words in (("4", "joint 4 is out of range"), ("elbow", "has no joint 'elbow'"), (",", "no joint of")):
        with pytest.raises(hf.InputError, match=words):
            sus.by_name(f"release:{bad}", arm)
    with pytest.raises(hf.InputError, match="'release' has no option 'weights'"):
        sus.by_name("release", arm, [1, 1, 1])


def test_optimised_like_every_objective():
    arm = hf.arms.load("planar-3r")
    q = np.array([0.5, -0.8, 1.1])
    measure = sus.release(arm, [1, 2])
    best = hf.optimise(arm, arm.forward_kinematics(q), measure, task="planar", starts=16)
    fibre = oracles.three_link_fibre(arm, arm.forward_kinematics(q)[:2, 3], 20_000)
    assert best.value == pytest.approx(measure(fibre).min(), rel=1e-3, abs=1e-3)
