"""Inverse dynamics against Pinocchio, energy, and closed forms."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest

import holdfast as hf
import oracles
from holdfast import arms
from holdfast.kernels import Kernel
from holdfast.model.arm import dynamics, kinematics


def compiled(arm):
    """The whole torque on the CasADi machine: many arms without a compilation each."""
    q, qd, qdd = kinematics.joint_symbols(arm), ca.SX.sym("qd", arm.n), ca.SX.sym("qdd", arm.n)
    return Kernel("test", [q, qd, qdd], [dynamics.inverse_dynamics(arm, q, qd, qdd)], backend="casadi")


def close(got, expected, tolerance=1e-11):
    np.testing.assert_allclose(got, expected, rtol=0, atol=tolerance * max(1.0, np.abs(expected).max()))


def random_arm(rng, payload=True, **options):
    """With bodies, rotors, friction, a tilted base and gravity in any direction."""
    arm = oracles.with_bodies(oracles.random_arm(rng, limits=2.0, **options), rng, payload, armature=True)
    return replace(arm, joints=tuple(replace(j, friction=rng.uniform(0, 2)) for j in arm.joints))


def state(arm, rng, count):
    return oracles.inside(arm, rng, count), rng.normal(size=(count, arm.n)), 3 * rng.normal(size=(count, arm.n))


def pinocchio(arm, q, qd, qdd):
    """Torques without friction and rotors, which are added by hand, as numbers of joints' own."""
    import pinocchio as pin

    model, _ = oracles.to_pinocchio(arm)
    model.armature = np.zeros(arm.n)
    data = model.createData()
    bare = np.array([pin.rnea(model, data, *row) for row in zip(q, qd, qdd, strict=True)])
    return bare + [j.armature for j in arm.joints] * qdd + [j.friction for j in arm.joints] * qd


@pytest.mark.interpreted
@pytest.mark.parametrize("types", [None, "R", "P", "PP", "RPRPR", "PRRPRR"])
def test_random_arms_against_pinocchio(types, rng):
    for payload in (False, True, False, True):
        arm = random_arm(rng, payload, types=types)
        q, qd, qdd = state(arm, rng, 6)
        close(compiled(arm).rows(q, qd, qdd), pinocchio(arm, q, qd, qdd))


@pytest.mark.parametrize("name", ["panda", "ur5-rail"])
def test_built_in_arms_against_pinocchio(name, rng):
    arm = arms.load(name).with_base(oracles.random_pose(rng)).with_payload(oracles.random_link(rng))
    arm = replace(arm, joints=tuple(replace(j, friction=0.3, armature=0.1) for j in arm.joints))
    q, qd, qdd = state(arm, rng, 20)
    tau = arm.inverse_dynamics(q, qd, qdd)
    close(tau, pinocchio(arm, q, qd, qdd))
    np.testing.assert_array_equal(arm.inverse_dynamics(q[3], qd[3], qdd[3]), tau[3])
    still = np.zeros(arm.n)
    np.testing.assert_array_equal(arm.inverse_dynamics(q, still, still), arm.gravity_torque(q))
    inertial, viscous, gravity = arm.torque_terms(q, qd, qdd)
    np.testing.assert_array_equal(viscous, 0.3 * qd)
    np.testing.assert_array_equal(gravity, arm.gravity_torque(q))
    np.testing.assert_array_equal(inertial + viscous + gravity, tau)
    # The inertia matrix column by column: symmetric, with the diagonal that the arm tells.
    m = np.array([arm.torque_terms(q[0], still, e)[0] for e in np.eye(arm.n)])
    close(m, m.T)
    close(np.diag(m), arm.inertia_diagonal(q[0]))


@pytest.mark.interpreted
def test_power_is_the_rate_of_energy(rng):
    """Along any motion the torques' power is what friction takes and what kinetic and potential energy gain."""
    for types in ("RPRR", "PRRP"):
        arm = random_arm(rng, types=types)
        amplitude, phase = rng.uniform(0.2, 0.8, arm.n), rng.uniform(0, 6, arm.n)

        def motion(t, amplitude=amplitude, phase=phase):
            return amplitude * np.sin(t + phase), amplitude * np.cos(t + phase), -amplitude * np.sin(t + phase)

        def energy(t, arm=arm, motion=motion):
            q, qd, _ = motion(t)
            made = oracles.frames(arm, q[None])
            total = 0.5 * sum(j.armature * v**2 for j, v in zip(arm.joints, qd, strict=True))
            for k, body in [*enumerate(arm.links), (arm.n - 1, arm.payload)]:
                slide = hf.Arm(name="part", joints=arm.joints[: k + 1], base=arm.base, tool=oracles.pose(None, body.com))
                turn, twist = made[k + 1][0][:3, :3], oracles.jacobian(slide, q[None, : k + 1])[0] @ qd[: k + 1]
                inertia = turn @ body.inertia @ turn.T
                centre = (made[k + 1][0] @ [*body.com, 1])[:3]
                total += 0.5 * body.mass * twist[:3] @ twist[:3] + 0.5 * twist[3:] @ inertia @ twist[3:]
                total -= body.mass * arm.gravity @ centre
            return total

        for t in rng.uniform(0, 5, 4):
            q, qd, qdd = motion(t)
            lost = sum(j.friction * v**2 for j, v in zip(arm.joints, qd, strict=True))
            gained = oracles.slope(lambda x: np.array([energy(y) for y in x[:, 0]]), np.array([t]))[0]
            close(compiled(arm).rows(q, qd, qdd)[0] @ qd - lost, gained, 1e-8)


def test_a_pendulum_and_a_lift_by_hand():
    point = hf.Link(2.0, np.array([0.5, 0, 0]), np.zeros((3, 3)))
    pendulum = hf.Arm(
        name="pendulum",
        joints=(hf.Joint("a", "revolute", np.eye(4), axis=[0, -1, 0], friction=0.4, armature=0.1),),
        links=(point,),
    )
    q, qd, qdd = 0.3, 1.5, -2.0
    expected = (2 * 0.25 + 0.1) * qdd + 0.4 * qd + 2 * 9.81 * 0.5 * np.cos(q)
    close(pendulum.inverse_dynamics([q], [qd], [qdd]), [expected])
    close(pendulum.inverse_dynamics([[q]] * 3, [qd], [[qdd]] * 3), [[expected]] * 3)
    lift = hf.Arm(name="lift", joints=(hf.Joint("a", "prismatic", np.eye(4), axis=[0, 0, 1]),), links=(point,))
    close(lift.inverse_dynamics([0.7], [3.0], [1.5]), [2 * (9.81 + 1.5)])


def test_bad_states_and_bad_arms(panda_states):
    arm, (q, qd, qdd) = panda_states
    qd[1, 2] = np.nan
    tau = arm.inverse_dynamics(q, qd, qdd)
    np.testing.assert_array_equal(np.isnan(tau).all(axis=1), [False, True, False])
    assert np.isfinite(tau[[0, 2]]).all()
    assert arm.inverse_dynamics(np.zeros((0, 7)), np.zeros(7), np.zeros(7)).shape == (0, 7)
    for wrong, words in (
        ((q[0], qd[1], qdd[0]), "qd for 'panda' holds NaN or infinity"),
        ((q, qd[:, :6], qdd), r"qd for 'panda' has shape \(3, 6\); it must be \(7,\) or \(N, 7\)"),
        ((q, qd[:2], qdd), "qd for 'panda' has 2 rows and others have 3"),
        ((q, "fast", qdd), "qd for 'panda' must be numbers"),
    ):
        with pytest.raises(hf.InputError, match=words):
            arm.inverse_dynamics(*wrong)
    with pytest.raises(hf.ArmError, match="no inertial data"):
        arms.load("pa10-7dof").inverse_dynamics(q, qd, qdd)
    bad = replace(arm, payload=hf.Link(1.0, np.zeros(3), np.diag([1.0, 1, 3])))
    with pytest.raises(hf.ArmError, match=r"payload: .*triangle"):
        bad.inverse_dynamics(q, qd, qdd)


@pytest.fixture
def panda_states(rng):
    arm = arms.load("panda")
    return arm, state(arm, rng, 3)
