"""``holdfast faults``: draw."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.groups import Chain
from holdfast.cli.options import JsonOption
from holdfast.present.results import printed

command = typer.Typer(name="faults", help="Generate timed joint faults for simulators.", no_args_is_help=True)


@command.callback()
def _group() -> None:
    """Typer makes a command of a group with one command alone."""


@command.command()
def draw(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Faults file (YAML).")],
    arm: Annotated[str, "Built-in name, URDF or MJCF file, or DH table (YAML)."],
    episodes: Annotated[int, "So many, from number 0 on."] = 1,
    horizon: Annotated[float | None, "Length of an episode, s. Default: endless."] = None,
    seed: Annotated[int | None, "In place of the file's."] = None,
    chain: Chain = Chain(),
    json_: JsonOption = False,
) -> None:
    """Draw the fault events of some episodes.

    Example: holdfast faults draw faults.yaml --arm panda --episodes 5 --seed 7
    """
    faults = hf.faults.load(file).seeded(seed)
    model = chain.arm(arm)
    printed(faults.batch(model, episodes=episodes, horizon=horizon or float("inf")), json_)
