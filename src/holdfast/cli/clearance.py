"""--capsules, --radius, --margin, --clearance: the shape of an arm, so that it is kept from colliding with itself."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from holdfast.errors import InputError

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.clearance.clearance import Clearance

CapsulesOption = Annotated[
    Path | None, typer.Option("--capsules", help="Capsule file (YAML): the shape of the arm's links.", show_default=False)
]
RadiusOption = Annotated[
    float | None,
    typer.Option(
        "--radius",
        help="Radius, m, of capsules along the links. Default: 1/20 of the sum of the link lengths, an assumption.",
        show_default=False,
    ),
]
MarginOption = Annotated[
    float | None,
    typer.Option("--margin", help="Smallest clearance, m, of the best configurations. Default: 0.", show_default=False),
]
ClearanceOption = Annotated[
    bool | None,
    typer.Option(
        "--clearance/--no-clearance",
        help="Keep the arm from colliding with itself, or let it. Default: keep it when configurations are chosen, but for "
        "an arm that moves in a plane.",
        show_default=False,
    ),
]


def check_clearance(wanted: bool | None, capsules: Path | None, radius: float | None, margin: float | None) -> None:
    """Refuse options that contradict each other, before any work is done.

    Raises:
        InputError: Which ones, or an invalid radius or margin.
    """
    given = [name for name, x in (("--capsules", capsules), ("--radius", radius), ("--margin", margin)) if x is not None]
    if wanted is False and given:
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
    arm: Arm, wanted: bool | None, capsules: Path | None, radius: float | None, margin: float | None, chooses: bool
) -> Clearance | None:
    """The clearance of an arm that the options ask for, or None.

    Args:
        arm: The arm.
        wanted: ``--clearance`` or ``--no-clearance``.
        capsules: ``--capsules``.
        radius: ``--radius``, m.
        margin: ``--margin``, m.
        chooses: The command chooses configurations, so that a clearance can be kept.

    Raises:
        InputError: A margin where nothing keeps it.
        ArmError: A capsule file or radius that does not fit the arm.
    """
    from holdfast.clearance.capsules import Capsules
    from holdfast.clearance.clearance import Clearance

    if margin is not None and not chooses:
        raise InputError("--margin is kept by the best configurations and none are asked for; add --optimise")
    if capsules is not None:
        return Clearance(arm, Capsules.load(capsules, arm))
    if radius is not None:
        return Clearance(arm, Capsules.along(arm, radius))
    if wanted:
        return Clearance(arm)
    found = Clearance.by_default(arm) if wanted is None and chooses else None
    if margin is not None and found is None:
        raise InputError(
            f"--margin has no effect: the links of '{arm.name}' lie beside each other, so its clearance is not checked "
            f"unless you ask for it; add --clearance or --capsules"
        )
    return found
