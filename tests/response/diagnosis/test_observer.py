"""The momentum observer against Pinocchio and MuJoCo, and the test of excess against its definition."""

from __future__ import annotations

import mujoco
import numpy as np
import pinocchio as pin
import pytest

import dynamics
import holdfast as hf
from holdfast.model.arm.formats.mujoco_spec import build_mujoco_spec
from holdfast.response.diagnosis.observer import OBSERVER_GAIN_PER_S, accumulate_excess, momentum_kernel, observe_residuals


@pytest.fixture(scope="module")
def panda():
    return hf.arms.load("panda")


def test_momentum_and_its_terms_are_those_of_pinocchio(panda, rng):
    model, data, _ = dynamics.to_pinocchio(panda)
    q, v = rng.uniform(panda.lower, panda.upper, (8, 7)), rng.normal(size=(8, 7))
    momentum, energy, gravity = momentum_kernel(panda)(q, v)
    for k in range(8):
        assert momentum[k] == pytest.approx(dynamics.mass_matrix(panda, q[k]) @ v[k], rel=1e-9, abs=1e-9)
        assert energy[k] == pytest.approx(pin.computeCoriolisMatrix(model, data, q[k], v[k]).T @ v[k], rel=1e-9, abs=1e-9)
        assert gravity[k] == pytest.approx(dynamics.gravity_torque(panda, q[k]), rel=1e-9, abs=1e-9)


def test_the_residual_is_the_external_torque(panda):
    """A torque on one joint of MuJoCo's arm that no motor gives appears on its row, after the filters, and on no other."""
    model = build_mujoco_spec(panda, np.zeros(7), range(7)).compile()
    model.dof_damping[:] = [joint.friction for joint in panda.joints]
    data = mujoco.MjData(model)
    start = np.array([0, 0.4, 0.2, -1.6, 0.3, 2.0, 0.1])
    data.qpos[:] = start
    places, torques = [], []
    for k in range(600):
        torque = panda.gravity_torque(data.qpos) + 60 * (start + 0.2 * np.sin(k / 300) - data.qpos) - 8 * data.qvel
        data.qfrc_applied[:] = torque + (np.eye(7)[3] * 5.0 if k > 300 else 0.0)
        places.append(data.qpos.copy())
        torques.append(torque)
        mujoco.mj_step(model, data)
    wet = np.array([joint.friction for joint in panda.joints])
    r, *_ = observe_residuals(
        momentum_kernel(panda), np.array(places), np.array(torques), dt=1e-3, coulomb=np.zeros(7), viscous=wet
    )
    assert np.abs(r[100:300]).max() < 0.15
    assert r[-1, 3] == pytest.approx(5.0, abs=0.15)
    assert np.abs(np.delete(r[-1], 3)).max() < 0.15
    rise = np.flatnonzero(r[300:, 3] > 5 * (1 - np.exp(-1)))[0] * 1e-3
    assert rise == pytest.approx(1 / OBSERVER_GAIN_PER_S, abs=0.015)  # the filter on the rates adds its own 8 ms


def test_excess_is_its_definition(rng):
    z = rng.exponential(1.0, (300, 2))
    z[50:60] = np.nan
    total, want = np.zeros(2), []
    for row in z:
        total = np.maximum(0.0, total + np.nan_to_num(row - 1, nan=0.0) * 0.01)
        want.append(total)
    assert accumulate_excess(z, 0.01) == pytest.approx(np.array(want), abs=1e-12)
