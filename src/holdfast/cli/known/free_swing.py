"""``holdfast free-swing``."""

from __future__ import annotations

from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.clearance import CapsulesOption, MeshesOption, RadiusOption, TouchedCellOption, read_contact_shape
from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    DegreesOption,
    HoldOption,
    JsonOption,
    MotionCsvOption,
    OutOption,
    PlotOption,
    TipOption,
    read_arm,
    read_configuration,
    read_joint,
)
from holdfast.present.results import drawn, printed


def command(
    arm: ArmArgument,
    q: Annotated[str, typer.Option("--q", help="Joint values, rad and m, separated by commas or spaces.")],
    joint: Annotated[str, typer.Option("--joint", help="The joint that swings free, by name or number from 1.")],
    damping: Annotated[
        float | None,
        typer.Option(
            "--damping",
            help="Viscous friction, N m s/rad or N s/m. Default: the joint's own, or 10 % of critical if it has next to none.",
        ),
    ] = None,
    brake: Annotated[
        list[float] | None,
        typer.Option("--brake", help="Brakes engage after so many ms. May be given again.", show_default="50, 100 and 200"),
    ] = None,
    limits: Annotated[
        bool, typer.Option("--limits", help="The joint's limits stop it (those of prismatic joints always do).")
    ] = False,
    duration: Annotated[float | None, typer.Option("--duration", help="Longest time, s. Default: until it is at rest.")] = None,
    cell: TouchedCellOption = None,
    capsules: CapsulesOption = None,
    radius: RadiusOption = None,
    meshes: MeshesOption = None,
    degrees: DegreesOption = False,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    csv: MotionCsvOption = None,
    plot: PlotOption = None,
    out: OutOption = None,
    json_: JsonOption = False,
) -> None:
    """Simulate one joint swinging free under gravity, all others held (needs the extra 'physics').

    Brakes are assumed to stop the joint at once.

    Example: holdfast free-swing panda --q "0 -45 0 -135 0 90 45" --degrees --joint 4 --brake 50 --brake 100
    """
    from holdfast.physics.swing import BRAKES

    model = read_arm(arm, base, tip, hold)
    swing = hf.free_swing(
        model,
        read_configuration(model, q, degrees),
        read_joint(model, joint),
        damping=damping,
        duration=duration,
        brake_after=tuple(brake) if brake else BRAKES,
        limits=limits,
        clearance=read_contact_shape(model, capsules, radius, cell, meshes),
    )
    printed(swing, json_, ([] if csv is None else [swing.to_csv(csv)]) + drawn(swing, plot, out))
