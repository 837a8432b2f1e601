"""Arms with bodies, and Pinocchio's view of them."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

import holdfast as hf
import oracles


def to_pinocchio(arm: hf.Arm) -> tuple[pin.Model, pin.Data, int]:
    """The oracles' model, its data, and the id of the tool frame."""
    model, tool = oracles.to_pinocchio(arm)
    return model, model.createData(), tool


def gravity_torque(arm: hf.Arm, q: np.ndarray) -> np.ndarray:
    """(n,) torques that hold the arm, N m or N."""
    model, data, _ = to_pinocchio(arm)
    return pin.computeGeneralizedGravity(model, data, q).copy()


def mass_matrix(arm: hf.Arm, q: np.ndarray) -> np.ndarray:
    """(n, n) joint-space inertia, rotors included."""
    model, data, _ = to_pinocchio(arm)
    made = pin.crba(model, data, q)
    return np.triu(made) + np.triu(made, 1).T


def swing_angle(arm: hf.Arm, q: np.ndarray, joint: int) -> float:
    """Signed turn of the joint, in (-pi, pi], that brings the centre of mass of what it carries lowest."""
    model, data, _ = to_pinocchio(arm)
    pin.forwardKinematics(model, data, q)
    placement = data.oMi[joint + 1]
    axis = placement.rotation @ arm.joints[joint].axis
    first = np.zeros(3)
    for k in range(joint + 1, model.njoints):
        body = model.inertias[k]
        first += body.mass * (data.oMi[k].act(body.lever) - placement.translation)
    across = first - axis * (axis @ first)
    down = arm.gravity - axis * (axis @ arm.gravity)
    return float(np.arctan2(axis @ np.cross(across, down), across @ down))
