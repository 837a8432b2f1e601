"""``holdfast faults``: draw."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.options import ArmOption, JsonOption
from holdfast.interface.presentation.results import print_result

command = typer.Typer(name="faults", help="Generate timed joint faults for simulators.", no_args_is_help=True)


@command.callback()
def _describe_group() -> None:
    """Force typer to keep a group, because it turns a group with a single command into that command."""


@command.command()
def draw(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Fault file (YAML).")],
    arm: ArmOption,
    episodes: Annotated[int, "Number of episodes, starting with episode 0."] = 1,
    horizon: Annotated[float | None, "Length of an episode in s; later faults are left out. Default: infinite."] = None,
    seed: Annotated[int | None, "Seed of the faults. Default: the seed of the fault file."] = None,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Draw the fault events of some episodes.

    Example: holdfast faults draw faults.yaml --arm panda --episodes 5 --seed 7
    """
    faults = hf.faults.load(file).with_seed(seed)
    model = chain.resolve_arm(arm)
    print_result(faults.batch(model, episodes=episodes, horizon=horizon or float("inf")), json_)
