"""--capsules, --radius, --meshes, --margin, --clearance, --cell: what an arm is kept clear of, itself and what is around it."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from holdfast.errors import InputError

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.clearance.clearance import Clearance

CapsulesOption = Annotated[Path | None, typer.Option("--capsules", help="Capsule file (YAML): the shape of the arm's links.")]
RadiusOption = Annotated[
    float | None, typer.Option("--radius", help="Radius, m, along the links. Default: the collision shapes, else assumed.")
]
MeshesOption = Annotated[
    Path | None, typer.Option("--meshes", help="Folder in which meshes that the arm's file names are looked for first.")
]
MarginOption = Annotated[
    float | None, typer.Option("--margin", help="Smallest clearance kept, m; from objects beyond the cell's own. Default: 0.")
]
ClearanceOption = Annotated[
    bool | None,
    typer.Option(
        "--clearance/--no-clearance",
        help="Keep the arm from colliding with itself, or let it. Default: keep it when configurations are chosen, but for "
        "an arm that moves in a plane.",
    ),
]
CellOption = Annotated[
    Path | None, typer.Option("--cell", help="Cell file (YAML): objects around the arm, which it is kept clear of.")
]
TouchedCellOption = Annotated[
    Path | None, typer.Option("--cell", help="Cell file (YAML): objects around the arm; what it touches is said.")
]


def check_clearance(
    wanted: bool | None, capsules: Path | None, radius: float | None, margin: float | None, cell: Path | None = None
) -> None:
    """Refuse options that contradict each other, before any work is done.

    Raises:
        InputError: Which ones, or an invalid radius or margin.
    """
    given = [name for name, x in (("--capsules", capsules), ("--radius", radius), ("--margin", margin)) if x is not None]
    if wanted is False and given and cell is None:
        raise InputError(
            f"{given[0]} asks for a clearance of the arm from itself and --no-clearance asks for none; give one of them"
        )
    if capsules is not None and radius is not None:
        raise InputError("give one of --capsules and --radius; a capsule file may hold a radius")
    if radius is not None and not (math.isfinite(radius) and radius > 0):
        raise InputError(f"--radius is {radius:g}; it must be a finite number of metres above 0")
    if margin is not None and not math.isfinite(margin):
        raise InputError(f"--margin is {margin:g}; it must be a finite number of metres")


def read_clearance(
    arm: Arm,
    wanted: bool | None,
    capsules: Path | None,
    radius: float | None,
    margin: float | None,
    chooses: bool,
    cell: Path | None = None,
    meshes: Path | None = None,
) -> Clearance | None:
    """What the options ask an arm to be kept clear of, or None for nothing. With ``--no-clearance`` the cell alone counts.

    Args:
        arm: The arm.
        wanted: ``--clearance`` or ``--no-clearance``.
        capsules: ``--capsules``.
        radius: ``--radius``, m.
        margin: ``--margin``, m.
        chooses: The command chooses configurations, so that a clearance can be kept.
        cell: ``--cell``.
        meshes: ``--meshes``.

    Raises:
        InputError: A margin where nothing keeps it, or a cell that cannot be read or does not fit the arm.
        ArmError: A capsule file or radius that does not fit the arm.
    """
    from holdfast.clearance.capsules import Capsules
    from holdfast.clearance.choice import chosen_clearance
    from holdfast.clearance.clearance import Clearance
    from holdfast.shapes.reading import with_meshes

    if margin is not None and not chooses:
        raise InputError("--margin is kept by the best configurations and none are asked for; add --optimise")
    arm = arm if meshes is None else with_meshes(arm, meshes)
    if capsules is not None or radius is not None:
        shape = Capsules.load(capsules, arm) if capsules is not None else Capsules.along(arm, radius)
        return chosen_clearance(arm, Clearance(arm, shape, itself=wanted is not False), cell)
    found = chosen_clearance(arm, wanted, cell, looks=chooses)
    if margin is not None and found is None:
        raise InputError(
            f"--margin has no effect: the links of '{arm.name}' lie beside each other, so its clearance is not checked "
            f"unless you ask for it; add --clearance or --capsules"
        )
    return found


def read_kept(
    arm: Arm,
    wanted: bool | None,
    capsules: Path | None,
    radius: float | None,
    margin: float | None,
    cell: Path | None,
    meshes: Path | None,
) -> Clearance | None:
    """What a motion keeps clear of: nothing unless an option but --meshes asks for it."""
    if cell is None and not wanted and capsules is None and radius is None and margin is None:
        return None
    return read_clearance(arm, wanted, capsules, radius, margin, chooses=True, cell=cell, meshes=meshes)


def read_contact_shape(
    arm: Arm, capsules: Path | None, radius: float | None, cell: Path | None, meshes: Path | None
) -> Clearance | None:
    """What an arm may touch in a cell, where a command says what it does touch; None without a cell.

    Raises:
        InputError: A shape with nothing to touch, or a cell that cannot be read or does not fit the arm.
        ArmError: A capsule file or radius that does not fit the arm.
    """
    check_clearance(None, capsules, radius, None, cell)
    if cell is None:
        for name, given in (("--capsules", capsules), ("--radius", radius), ("--meshes", meshes)):
            if given is not None:
                raise InputError(f"{name} is the shape of the arm that may touch a cell, and there is none; add --cell")
        return None
    return read_clearance(arm, False, capsules, radius, None, chooses=False, cell=cell, meshes=meshes)
