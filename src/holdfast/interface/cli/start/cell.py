"""``holdfast cell``: check."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.options import NOT_MET_EXIT_CODE, JsonOption, PageOption
from holdfast.interface.presentation.results import print_result, write_outputs

command = typer.Typer(name="cell", help="Inspect the environment around an arm.", no_args_is_help=True)


@command.command()
def check(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Environment file (YAML), URDF or MJCF file.")],
    arm: Annotated[str | None, "Arm whose contacts are checked: built-in name or arm file. Default: none."] = None,
    chain: ArmSourceOptions = ArmSourceOptions(),
    out: PageOption = None,
    json_: JsonOption = False,
) -> None:
    """Check an environment file: unreadable shapes, permanent contacts, grid resolution.

    Exit code: 3 if an object touches the base, or the arm in every configuration; else 0.

    Example: holdfast cell check bench.yaml --arm panda
    """
    cell_check = hf.check_cell(file, None if arm is None else chain.resolve_arm(arm))
    print_result(cell_check, json_, write_outputs(cell_check, None, out))
    if not cell_check.ok:
        raise typer.Exit(NOT_MET_EXIT_CODE)
