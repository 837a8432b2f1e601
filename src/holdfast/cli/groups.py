"""Options that go together: a command has one parameter for all of them, and they are declared and read in one place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np

from holdfast.arms.spec import each_arm, read_hold
from holdfast.cli.options import JsonOption, OutOption, PlotOption
from holdfast.cli.values import read_numbers
from holdfast.errors import InputError
from holdfast.present.results import drawn, printed

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.arms.spec import ArmSpec
    from holdfast.result import Result

_PER_ARM = "once for all arms, or once for each in order ('-' for none)."


@dataclass(frozen=True)
class Chain:
    """What of a file the arm is."""

    base: Annotated[str | None, "URDF, MJCF: base link or body. Default: the root."] = None
    tip: Annotated[str | None, "URDF, MJCF: tip link, body or site. Default: the only end, no gripper's finger."] = None
    hold: Annotated[
        list[str] | None,
        "URDF, MJCF: JOINT=value, rad or m, at which a joint is held for good: a gripper's, or an external axis. May be given "
        "again.",
    ] = None

    def arm(self, spec: str) -> Arm:
        """The arm that ``spec`` and these options name."""
        from holdfast import arms

        return arms.resolve(spec, self.base, self.tip, hold=read_hold(",".join(self.hold)) if self.hold else None)


@dataclass(frozen=True)
class Chains:
    """The same of several arms, and what each is called."""

    base: Annotated[list[str] | None, f"URDF, MJCF: base link or body, {_PER_ARM} Default: the root."] = None
    tip: Annotated[list[str] | None, f"URDF, MJCF: tip link, body or site, {_PER_ARM} Default: the only end."] = None
    hold: Annotated[
        list[str] | None,
        f"URDF, MJCF: JOINT=value, rad or m, at which joints are held for good, separated by commas, {_PER_ARM}",
    ] = None
    name: Annotated[list[str] | None, "What an arm is called, once for each in order ('-' for its own)."] = None

    def arms(self, specs: Sequence[str]) -> list[ArmSpec]:
        """The arms that ``specs`` and these options name; see :func:`holdfast.arms.spec.each_arm` for the errors."""
        return each_arm(specs, self.base, self.tip, self.hold, self.name)


@dataclass(frozen=True)
class Output:
    """How a result is shown."""

    plot: PlotOption = None
    out: OutOption = None
    json_: JsonOption = False

    def printed(self, result: Result, files: Sequence[Path] = ()) -> None:
        """Print it and where it is: in ``files``, and in the picture and the folder that are asked for."""
        printed(result, self.json_, [*files, *drawn(result, self.plot, self.out)])


_MOUNTS = {"floor": np.eye(3), "wall": np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]]), "ceiling": np.diag([1.0, -1, -1])}


@dataclass(frozen=True)
class Placement:
    """How an arm is mounted, and what it carries."""

    mount: Annotated[str, "floor (as described), wall (turned 90 deg about y) or ceiling (180 deg about x)."] = "floor"
    gravity: Annotated[str | None, "Gravity acceleration in the world, m/s^2, as 0,0,-9.81. Default: the arm's."] = None
    payload: Annotated[
        str | None, "A point mass at the end effector: kg, then x,y,z of its place in the last link's frame, m (default 0,0,0)."
    ] = None

    def of(self, arm: Arm) -> Arm:
        """The arm placed so.

        Raises:
            InputError: A mount that is not known, or numbers that are too many or too few.
        """
        from holdfast.arm.machine import Link

        if self.mount not in _MOUNTS:
            raise InputError(f"--mount '{self.mount}' is not known; use one of {', '.join(_MOUNTS)}")
        turn = np.eye(4)
        turn[:3, :3] = _MOUNTS[self.mount]
        arm = arm.with_base(turn @ arm.base)
        if self.gravity is not None:
            arm = replace(arm, gravity=read_numbers("--gravity", self.gravity, "3 numbers"))
        if self.payload is not None:
            numbers = read_numbers("--payload", self.payload, "1 or 4 numbers")
            if numbers.size not in (1, 4):
                raise InputError(f"--payload has {numbers.size} numbers; give the mass, kg, or the mass and x, y, z, m")
            place = numbers[1:] if numbers.size == 4 else np.zeros(3)
            arm = arm.with_payload(Link(float(numbers[0]), place, np.zeros((3, 3)), name="payload"))
        return arm
