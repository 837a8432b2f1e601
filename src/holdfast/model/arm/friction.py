"""Friction of the joints of an arm without power."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Self

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.files.yaml import read_mapping
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor, require_real_numbers
from holdfast.model.arm.model import Arm

JointNumbers = float | Sequence[float] | FloatArray
"""One number for all joints, or one for each."""

_FILE_KEYS = ("coulomb", "stiction", "viscous", "load", "brake")


@dataclass(frozen=True, kw_only=True, eq=False)
class JointFriction:
    """Friction of each joint of an arm, at the joint (behind the gears).

    Attributes:
        coulomb: (n,) dry friction of the moving joint, N m or N.
        stiction: (n,) dry friction of the joint at rest, N m or N.
        viscous: (n,) friction per speed, N m s/rad or N s/m.
        load: (n,) additional dry friction as a fraction of the gravity torque of the joint.
    """

    coulomb: FloatArray
    stiction: FloatArray
    viscous: FloatArray
    load: FloatArray


@check_constructor
@dataclass(frozen=True, kw_only=True, eq=False)
class Friction:
    """Friction of the joints, at the joint (behind the gears); one number for all joints, or one for each.

    Attributes:
        coulomb: Dry friction of a moving joint, N m or N. None: as the arm states, or 0.
        stiction: Dry friction of a joint at rest, N m or N, at least ``coulomb``. None: the same as ``coulomb`` if it is given,
            otherwise as the arm states.
        viscous: Friction per speed, N m s/rad or N s/m. None: as the arm states.
        load: Additional dry friction as a fraction of the gravity torque of the joint, at least 0 and below 1. Gears that the
            load drives backwards have such friction.
        boards: Joints of each driver board, by name or index from 0. With them, ``board:NAME`` in ``free`` of
            :func:`holdfast.power_loss` and :func:`holdfast.holds` are all joints of a board, which fail together.
    """

    coulomb: JointNumbers | None = None
    stiction: JointNumbers | None = None
    viscous: JointNumbers | None = None
    load: JointNumbers = 0.0
    boards: Mapping[str, Sequence[str | int]] = field(default_factory=dict)

    @classmethod
    def from_file(cls, path: str | Path, arm: Arm) -> Self:
        """Read a YAML file with the friction of joints by name, for example ``elbow: {coulomb: 0.3, viscous: 0.1}``.

        The keys of a joint are ``coulomb``, ``stiction``, ``viscous``, ``load``, and ``brake``, which only
        :meth:`holdfast.Brakes.from_file` uses. The file may also contain ``boards: {NAME: [joints]}``. A joint or key that the
        file leaves out is as the arm states.

        Raises:
            InputError: The file cannot be read, or a joint, a key, a number, or a board is wrong.
        """
        entries, boards = read_friction_file(path, arm)
        values = {name: numbers.copy() for name, numbers in vars(cls().of_joints(arm)).items()}
        for index, entry in entries.items():
            for name in values.keys() & entry.keys():
                values[name][index] = entry[name]
            if "coulomb" in entry and "stiction" not in entry:
                values["stiction"][index] = entry["coulomb"]
        return cls(**values, boards=boards)

    def of_joints(self, arm: Arm) -> JointFriction:
        """Return the friction of each joint of an arm.

        Raises:
            InputError: A number is below 0 or not finite, there are not n of them, stiction is below Coulomb friction, or a
                load fraction is 1 or more.
        """

        def choose(given: JointNumbers | None, stated: list[float], label: str) -> FloatArray:
            return joint_numbers(arm, stated if given is None else given, label)

        coulomb = choose(self.coulomb, [joint.coulomb_friction for joint in arm.joints], "coulomb friction")
        stated_stiction = [joint.static_friction for joint in arm.joints] if self.coulomb is None else coulomb.tolist()
        stiction = choose(self.stiction, stated_stiction, "stiction")
        viscous = choose(self.viscous, [joint.friction for joint in arm.joints], "viscous friction")
        load = joint_numbers(arm, self.load, "load fraction of friction")
        for name, least, most, fraction in zip(arm.joint_names, coulomb, stiction, load, strict=True):
            if most < least:
                raise InputError(
                    f"stiction of joint '{name}' is {most:g}, below its coulomb friction {least:g}; give at least that much"
                )
            if fraction >= 1:
                raise InputError(
                    f"load fraction of friction of joint '{name}' is {fraction:g}; it must be below 1, because a joint with 1 "
                    "never moves"
                )
        return JointFriction(coulomb=coulomb, stiction=stiction, viscous=viscous, load=load)


def read_friction_file(path: str | Path, arm: Arm) -> tuple[dict[int, dict[str, float]], dict[str, tuple[int, ...]]]:
    """Return the numbers of each joint of a friction file, by its index, and the joints of each board."""
    data = read_mapping(Path(path), "holdfast.Friction", "joints by name")
    boards = {} if "boards" in arm.joint_names else data.pop("boards", {})
    if not isinstance(boards, dict) or not all(isinstance(joints, list) for joints in boards.values()):
        raise InputError(f"{path}: boards is {boards!r}; give a list of joints for each name of a board")
    entries: dict[int, dict[str, float]] = {}
    for joint, entry in data.items():
        index = arm.joint_index(joint)
        if not isinstance(entry, dict) or not set(entry) <= set(_FILE_KEYS):
            raise InputError(f"{path}: joint '{joint}' has {entry!r}; give it a mapping with keys from {', '.join(_FILE_KEYS)}")
        entries[index] = {
            name: float(joint_numbers(arm, number, f"{path}: {name} of joint '{joint}'")[index])
            for name, number in entry.items()
        }
    return entries, {str(name): arm.joint_indices(joints) for name, joints in boards.items()}


def joint_numbers(arm: Arm, value: Any, label: str) -> FloatArray:
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
