"""Constraint that keeps faulty joints still in the inverse kinematics of mink and pink."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.formatting import list_names
from holdfast.core.typing import FloatArray
from holdfast.response.diagnosis.kinds import FaultVerdict

STILL_KINDS = ("locked", "standstill", "limp")


@dataclass
class FrozenJoints:
    """Equality constraint for ``solve_ik(..., constraints=[frozen])`` of mink and of pink: the velocity of some joints is 0.

    The constraint may be there from the start, because it has no rows while no joint is frozen. As a task with a cost it would
    be a preference, and the joints would still move.

    Attributes:
        joints: Names of the joints, as in the model of the configuration.
        gain: Gain of the position error, which is always 0; mink and pink read it.
    """

    joints: list[str] = field(default_factory=list)
    gain: float = 1.0

    def add_faulty_joint(self, verdict: FaultVerdict) -> bool:
        """Freeze the joint of a ``verdict`` if it is locked, at a standstill, or limp; return whether this is new."""
        if verdict.joint is None or verdict.kind not in STILL_KINDS or verdict.joint in self.joints:
            return False
        self.joints.append(verdict.joint)
        return True

    def compute_error(self, configuration: Any) -> FloatArray:
        """Return the error (k,), rad or m, of the k frozen joints of a ``Configuration`` of mink or pink, which is always 0."""
        return np.zeros(len(self.joints))

    def compute_jacobian(self, configuration: Any) -> FloatArray:
        """Return the rows (k, nv) that select the velocities of the frozen joints of a ``Configuration`` of mink or pink.

        Raises:
            InputError: The model has no joint of this name.
        """
        model = configuration.model
        rows = np.zeros((len(self.joints), model.nv))
        for row, name in zip(rows, self.joints, strict=True):
            row[_velocity_index(model, name)] = 1.0
        return rows


def _velocity_index(model: Any, joint: str) -> int:
    """Return the index of a joint in the velocities of a ``mujoco.MjModel`` or ``pinocchio.Model``."""
    is_pinocchio = hasattr(model, "idx_vs")
    names = list(model.names)[1:] if is_pinocchio else [model.joint(index).name for index in range(model.njnt)]
    if joint not in names:
        raise InputError(f"the model has no joint '{joint}' to freeze; its joints are {list_names(names)}")
    return int(model.idx_vs[model.getJointId(joint)] if is_pinocchio else model.joint(joint).dofadr[0])
