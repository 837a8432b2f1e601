"""Friction and brakes of the joints of an arm without power."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor, require_real_numbers
from holdfast.model.arm.model import Arm

JointNumbers = float | Sequence[float] | FloatArray
"""One number for all joints, or one for each."""


@check_constructor
@dataclass(frozen=True, kw_only=True, eq=False)
class Friction:
    """Friction of the joints, at the joint (behind the gears); one number for all joints, or one for each.

    Attributes:
        coulomb: Dry friction of a moving joint, N m or N. None: as the arm states, or 0.
        stiction: Dry friction of a joint at rest, N m or N, at least ``coulomb``. None: as the arm states if ``coulomb`` is not
            given, otherwise the same as ``coulomb``.
        viscous: Friction per speed, N m s/rad or N s/m. None: as the arm states.
        load: Share of the gravity torque of a joint that is added to its dry friction, at least 0 and below 1. Gears that the
            load drives backwards have such friction.
    """

    coulomb: JointNumbers | None = None
    stiction: JointNumbers | None = None
    viscous: JointNumbers | None = None
    load: JointNumbers = 0.0

    def per_joint(self, arm: Arm) -> dict[str, FloatArray]:
        """Return ``coulomb``, ``stiction``, ``viscous`` and ``load``, each (n,), as numbers of an arm.

        Raises:
            InputError: A number is below 0 or not finite, there are not n of them, stiction is below Coulomb friction, or a
                load share is 1 or more.
        """
        stated = [getattr(joint, "coulomb_friction", 0.0) for joint in arm.joints]
        stated_stiction = [max(getattr(joint, "stiction", 0.0), value) for joint, value in zip(arm.joints, stated, strict=True)]
        coulomb = joint_numbers(arm, stated if self.coulomb is None else self.coulomb, "coulomb friction")
        stiction: JointNumbers = stated_stiction if self.coulomb is None else coulomb
        if self.stiction is not None:
            stiction = self.stiction
        viscous = [joint.friction for joint in arm.joints] if self.viscous is None else self.viscous
        numbers = {
            "coulomb": coulomb,
            "stiction": joint_numbers(arm, stiction, "stiction"),
            "viscous": joint_numbers(arm, viscous, "viscous friction"),
            "load": joint_numbers(arm, self.load, "load share of friction"),
        }
        for name, least, most in zip(arm.joint_names, coulomb, numbers["stiction"], strict=True):
            if most < least:
                raise InputError(
                    f"stiction of joint '{name}' is {most:g}, below its coulomb friction {least:g}; give at least that much"
                )
        for name, share in zip(arm.joint_names, numbers["load"], strict=True):
            if share >= 1:
                raise InputError(f"load share of friction of joint '{name}' is {share:g}; it must be at least 0 and below 1")
        return numbers


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

    def per_joint(self, arm: Arm) -> dict[str, FloatArray]:
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


def joint_numbers(arm: Arm, value: JointNumbers, label: str) -> FloatArray:
    """Return one number of 0 or more for each joint, (n,).

    Raises:
        InputError: A number is below 0 or not finite, or there are neither one nor n of them.
    """
    numbers = require_real_numbers(value, label)
    if numbers.shape not in ((), (arm.n,)):
        raise InputError(f"{label} has shape {numbers.shape}; give one number, or {arm.n}, one for each joint")
    numbers = np.broadcast_to(numbers, (arm.n,))
    for name, number in zip(arm.joint_names, numbers, strict=True):
        if not (np.isfinite(number) and number >= 0):
            raise InputError(f"{label} of joint '{name}' is {number:g}; it must be a finite number of 0 or more")
    return numbers
