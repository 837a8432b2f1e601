"""Inertia matrix, bias, and accelerations against Pinocchio and MuJoCo, on arms with slides, payloads, and rotor inertias."""

from __future__ import annotations

import casadi as ca
import mujoco
import numpy as np
import pinocchio as pin
import pytest

import dynamics as pinocchio_view
import holdfast as hf
import oracles
from holdfast.kernels import linalg
from holdfast.model.arm import dynamics, statics


def forward_dynamics(arm, q, qd, torque):
    """Accelerations from the inertia matrix and the bias, as the steps of a fall combine them."""
    rows = [ca.horzsplit(row) for row in ca.vertsplit(statics.inertia_matrix(arm, q))]
    return ca.vertcat(*linalg.solve_spd(rows, ca.vertsplit(ca.densify(torque - dynamics.bias_torques(arm, q, qd)))))


def symbols(n):
    return [ca.SX.sym(name, n) for name in ("q", "qd", "torque")]


@pytest.mark.parametrize("draw", range(6))
def test_accelerations_and_inertia_are_pinocchios(rng, draw):
    arm = oracles.with_bodies(oracles.random_arm(rng), rng, payload=draw % 2 == 0, armature=draw % 3 == 0)
    q, qd, torque = symbols(arm.n)
    outputs = [forward_dynamics(arm, q, qd, torque), statics.inertia_matrix(arm, q)]
    made = ca.Function("made", [q, qd, torque], outputs)
    model, data, _ = pinocchio_view.to_pinocchio(arm)
    for state in rng.normal(size=(5, 3, arm.n)):
        acceleration, inertia = (np.array(value) for value in made(*state))
        expected = pin.aba(model, data, *state)
        condition = np.linalg.cond(pinocchio_view.mass_matrix(arm, state[0]))
        error = np.abs(acceleration[:, 0] - expected).max() / np.abs(expected).max()
        assert error <= max(1e-12, 1e-15 * condition)
        np.testing.assert_allclose(inertia, pinocchio_view.mass_matrix(arm, state[0]), rtol=0, atol=1e-13 * inertia.max())


def test_accelerations_are_mujocos(rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="RPRR"), rng, payload=True, armature=True)
    q, qd, torque = symbols(arm.n)
    made = ca.Function("made", [q, qd, torque], [forward_dynamics(arm, q, qd, torque)])
    model = arm.to_mujoco().compile()
    data = mujoco.MjData(model)
    for state in rng.normal(size=(5, 3, arm.n)) * [[0.05], [1.0], [1.0]]:
        data.qpos[:], data.qvel[:], data.qfrc_applied[:] = state
        mujoco.mj_forward(model, data)
        np.testing.assert_allclose(np.array(made(*state))[:, 0], data.qacc_smooth, rtol=1e-7, atol=1e-9)


def test_gravity_torque_is_the_gradient_of_the_potential_energy(rng):
    arm = oracles.with_bodies(oracles.random_arm(rng, types="PRRPR"), rng, payload=True)
    q = ca.SX.sym("q", arm.n)
    energy = statics.potential_energy(statics.composite_bodies(arm, q))
    made = ca.Function("made", [q], [ca.gradient(energy, q)])
    for values in oracles.inside(arm, rng, 5):
        np.testing.assert_allclose(np.array(made(values))[:, 0], pinocchio_view.gravity_torque(arm, values), atol=1e-11)


def test_the_panda_takes_at_most_1800_operations():
    arm = hf.arms.load("panda")
    inputs = symbols(arm.n)
    made = ca.Function("made", inputs, [forward_dynamics(arm, *inputs)], {"cse": True})
    assert made.n_instructions() - 4 * arm.n <= 1800
