"""Brakes of the joints of an arm without power."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor
from holdfast.model.arm.friction import JointNumbers, joint_numbers, read_friction_file
from holdfast.model.arm.model import Arm


@check_constructor
@dataclass(frozen=True, kw_only=True, eq=False)
class Brakes:
    """Brakes that act some time after the power went.

    Attributes:
        after: Time from the power loss until the brakes act, s.
        torque: Brake torque, N m or N; one number for all joints, or one for each.
        damping: Viscous friction that the brakes add, N m s/rad or N s/m, for example by short-circuited motor windings; one
            number for all joints, or one for each.
    """

    after: float
    torque: JointNumbers
    damping: JointNumbers = 0.0

    @classmethod
    def from_file(cls, path: str | Path, arm: Arm, after: float) -> Self:
        """Read the torque ``brake`` of each joint, N m or N, from a friction file; see :meth:`holdfast.Friction.from_file`.

        Args:
            path: The file; a joint without ``brake`` has no brake.
            arm: The arm.
            after: Time from the power loss until the brakes act, s.

        Raises:
            InputError: The file is wrong, or no joint in it has a brake.
        """
        entries, _ = read_friction_file(path, arm)
        if not any("brake" in entry for entry in entries.values()):
            raise InputError(f"{path}: no joint has a brake; give its torque in N m as the key brake of a joint")
        return cls(after=after, torque=[entries.get(k, {}).get("brake", 0.0) for k in range(arm.n)])

    def of_joints(self, arm: Arm) -> dict[str, FloatArray]:
        """Return ``brake_torque`` and ``brake_damping``, each (n,).

        Raises:
            InputError: A number is below 0 or not finite, or there are not n of them.
        """
        if not (np.isfinite(self.after) and self.after >= 0):
            raise InputError(f"after is {self.after:g} s; brakes act at a finite time of 0 or more")
        return {
            "brake_torque": joint_numbers(arm, self.torque, "brake torque"),
            "brake_damping": joint_numbers(arm, self.damping, "brake damping"),
        }
