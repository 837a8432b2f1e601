"""Options that go together: a command has one parameter for all of them, and they are declared and read in one place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from holdfast.arms.spec import each_arm, read_hold
from holdfast.cli.options import JsonOption, OutOption, PlotOption
from holdfast.cli.values import read_numbers
from holdfast.errors import InputError
from holdfast.present.results import drawn, printed

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.arms.spec import ArmSpec
    from holdfast.clearance.clearance import Clearance
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


CapsulesOption = Annotated[Path | None, "Capsule file (YAML): the shape of the arm's links."]
RadiusOption = Annotated[float | None, "Radius, m, along the links. Default: the collision shapes, else assumed."]
MeshesOption = Annotated[Path | None, "Folder in which meshes that the arm's file names are looked for first."]
CellOption = Annotated[Path | None, "Cell file (YAML): objects around the arm, which it is kept clear of."]


@dataclass(frozen=True)
class Apart:
    """What an arm is kept clear of. With ``--no-clearance`` the cell alone counts."""

    clearance: Annotated[
        bool | None,
        typer.Option(
            "--clearance/--no-clearance",
            help="Keep the arm from colliding with itself, or let it. Default: keep it when configurations are chosen, but for "
            "an arm that moves in a plane.",
        ),
    ] = None
    capsules: CapsulesOption = None
    radius: RadiusOption = None
    meshes: MeshesOption = None
    margin: Annotated[float | None, "Smallest clearance kept, m; from objects beyond the cell's own. Default: 0."] = None
    cell: CellOption = None

    def check(self) -> None:
        """Refuse options that contradict each other, before any work is done.

        Raises:
            InputError: Which ones, or an invalid radius or margin.
        """
        given = [f"--{name}" for name in ("capsules", "radius", "margin") if getattr(self, name) is not None]
        if self.clearance is False and given and self.cell is None:
            raise InputError(
                f"{given[0]} asks for a clearance of the arm from itself and --no-clearance asks for none; give one of them"
            )
        if self.capsules is not None and self.radius is not None:
            raise InputError("give one of --capsules and --radius; a capsule file may hold a radius")
        if self.radius is not None and not (math.isfinite(self.radius) and self.radius > 0):
            raise InputError(f"--radius is {self.radius:g}; it must be a finite number of metres above 0")
        if self.margin is not None and not math.isfinite(self.margin):
            raise InputError(f"--margin is {self.margin:g}; it must be a finite number of metres")

    def read(self, arm: Arm, chooses: bool = True) -> Clearance | None:
        """What the arm is kept clear of, or None for nothing; ``chooses``: by a choice of configurations.

        Raises:
            InputError: A margin where nothing keeps it, or a cell that cannot be read or does not fit the arm.
            ArmError: A capsule file or radius that does not fit the arm.
        """
        from holdfast.clearance.capsules import Capsules
        from holdfast.clearance.choice import chosen_clearance
        from holdfast.clearance.clearance import Clearance
        from holdfast.shapes.reading import with_meshes

        if self.margin is not None and not chooses:
            raise InputError("--margin is kept by the best configurations and none are asked for; add --optimise")
        arm = arm if self.meshes is None else with_meshes(arm, self.meshes)
        if self.capsules is not None or self.radius is not None:
            shape = Capsules.along(arm, self.radius) if self.capsules is None else Capsules.load(self.capsules, arm)
            return chosen_clearance(arm, Clearance(arm, shape, itself=self.clearance is not False), self.cell)
        found = chosen_clearance(arm, self.clearance, self.cell, looks=chooses)
        if self.margin is not None and found is None:
            raise InputError(
                f"--margin has no effect: the links of '{arm.name}' lie beside each other, so its clearance is not checked "
                f"unless you ask for it; add --clearance or --capsules"
            )
        return found

    def read_if_asked(self, arm: Arm) -> Clearance | None:
        """The same, but nothing unless an option other than --meshes asks for it."""
        asked = self.clearance or any(x is not None for x in (self.capsules, self.radius, self.margin, self.cell))
        return self.read(arm) if asked else None


@dataclass(frozen=True)
class Touched:
    """What an arm may touch, where a command says what it does touch."""

    cell: Annotated[Path | None, "Cell file (YAML): objects around the arm; what it touches is said."] = None
    capsules: CapsulesOption = None
    radius: RadiusOption = None
    meshes: MeshesOption = None

    def read(self, arm: Arm) -> Clearance | None:
        """The arm's shape and the cell; None without a cell.

        Raises:
            InputError: A shape with nothing to touch, or a cell that cannot be read or does not fit the arm.
            ArmError: A capsule file or radius that does not fit the arm.
        """
        apart = Apart(capsules=self.capsules, radius=self.radius, meshes=self.meshes, cell=self.cell)
        apart.check()
        if self.cell is None:
            for name in ("capsules", "radius", "meshes"):
                if getattr(self, name) is not None:
                    raise InputError(f"--{name} is the shape of the arm that may touch a cell, and there is none; add --cell")
            return None
        return replace(apart, clearance=False).read(arm, chooses=False)
