"""``holdfast holds``."""

from __future__ import annotations

from typing import Annotated

import numpy as np
import typer

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions, FrictionOptions, MountingOptions
from holdfast.interface.cli.options import (
    NOT_MET_EXIT_CODE,
    ArmArgument,
    DegreesOption,
    FreeOption,
    JsonOption,
    OutOption,
    QOption,
)
from holdfast.interface.cli.values import read_configuration, read_fraction
from holdfast.interface.presentation.results import print_result, write_outputs


def command(
    arm: ArmArgument,
    q: QOption,
    free: FreeOption = None,
    effort: Annotated[str, "Fraction of the effort limits that the motors still provide, for example 35% or 0.35."] = "0",
    stops: Annotated[
        bool, typer.Option("--stops/--no-stops", help="Let joint limits carry the joints that gravity pushes against them.")
    ] = True,
    friction: FrictionOptions = FrictionOptions(),
    placement: MountingOptions = MountingOptions(),
    degrees: DegreesOption = False,
    chain: ArmSourceOptions = ArmSourceOptions(),
    out: OutOption = None,
    json_: JsonOption = False,
) -> None:
    """Check whether the arm stays where it is without motor torque.

    The command compares the gravity torque of every joint with dry friction and stops. It also prints the least effort of the
    motors that would hold the arm. Exit code: 0 if the arm holds every configuration, else 3.

    Example: holdfast holds panda --q "0 -45 0 -135 0 90 45" --degrees --effort 35%
    """
    model = placement.mount_arm(chain.resolve_arm(arm))
    fraction = read_fraction("--effort", effort)
    configurations = [read_configuration(model, text, degrees) for text in q]
    rows = configurations[0] if len(configurations) == 1 else np.array(configurations)
    check = hf.holds(model, rows, free=free, effort=fraction, stops=stops, friction=friction.read_friction(model))
    print_result(check, json_, write_outputs(check, None, out))
    if not np.all(check.holds):
        raise typer.Exit(NOT_MET_EXIT_CODE)
