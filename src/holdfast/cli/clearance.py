"""--capsules, --radius, --meshes, --margin, --clearance, --cell: what an arm is kept clear of, itself and what is around it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from holdfast.errors import InputError

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.clearance.clearance import Clearance

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
