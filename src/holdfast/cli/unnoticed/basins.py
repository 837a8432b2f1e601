"""``holdfast basins``."""

from __future__ import annotations

from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.laws import AtDegreesOption, LawOption, LockOption, TargetOption, law_of, read_locked
from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    HoldOption,
    JsonOption,
    PlotOption,
    SeedOption,
    TaskOption,
    TipOption,
    read_target,
)
from holdfast.present.results import drawn, printed


def command(
    arm: ArmArgument,
    target: TargetOption,
    lock: LockOption,
    at: Annotated[str, typer.Option("--at", help="Where each joint is locked, rad or m.", show_default=False)],
    starts: Annotated[int, typer.Option("--starts", help="How many random starts.")] = 2000,
    grid: Annotated[
        int | None,
        typer.Option(
            "--grid", help="With two healthy joints, instead: a map of so many by so many starts.", show_default=False
        ),
    ] = None,
    degrees: AtDegreesOption = False,
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    seed: SeedOption = 0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    plot: PlotOption = None,
    json_: JsonOption = False,
) -> None:
    """Find the starts from which an arm with locked joints still reaches its target, and where it ends from the others.

    Example: holdfast basins planar-3r --target 1.5,1.5 --lock 2 --at 45 --degrees --grid 80 --plot basins.png
    """
    made = law_of(law, arm, task, base, tip, hold)
    joints, values = read_locked(made.arm, lock, at, degrees)
    result = hf.basins(made, read_target(made.arm, made.task, target), joints, at=values, starts=starts, grid=grid, seed=seed)
    printed(result, json_, [] if plot is None else [drawn(result, plot)])
