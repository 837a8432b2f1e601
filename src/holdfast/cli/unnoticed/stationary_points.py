"""``holdfast stationary-points``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

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
from holdfast.errors import InputError
from holdfast.present.results import drawn, printed

if TYPE_CHECKING:
    from holdfast.result import Result


def command(
    arm: ArmArgument,
    target: TargetOption,
    lock: LockOption,
    at: Annotated[
        str | None,
        typer.Option("--at", help="Where each is locked, rad or m. Default: curves over all values.", show_default=False),
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
    """Find the stationary points at which an arm with locked joints can stop when its controller does not know.

    Example: holdfast stationary-points planar-3r --target 1.5,1.5 --lock 2 --at 140 --degrees
    """
    if at is not None and plot is not None:
        raise InputError("--plot draws curves over the locked value; leave out --at, or see 'holdfast basins --plot'")
    made = law_of(law, arm, task, base, tip, hold)
    goal = read_target(made.arm, made.task, target)
    locked, values = read_locked(made.arm, lock, at, degrees)
    result: Result = hf.stationary_points(made, goal, locked, at=values, seed=seed)
    printed(result, json_, [] if plot is None else [drawn(result, plot)])
