"""``holdfast trade-off``."""

from __future__ import annotations

from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    HoldOption,
    JsonOption,
    OutOption,
    PlotOption,
    TaskOption,
    TipOption,
    read_arm,
    read_numbers,
    read_task,
)
from holdfast.present.results import drawn, printed

ALLOWED = "0 0.05 0.1 0.15 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9"


def command(
    arm: ArmArgument,
    task: TaskOption = None,
    samples: Annotated[int, typer.Option("--samples", help="Random configurations and directions.")] = 2000,
    allowed: Annotated[str, typer.Option("--allowed", help="Pre-failure errors, from 0 to below 1, increasing.")] = ALLOWED,
    seed: Annotated[int, typer.Option("--seed", help="Seed of the samples.", min=0)] = 0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    plot: PlotOption = None,
    out: OutOption = None,
    json_: JsonOption = False,
) -> None:
    """What a velocity error of the healthy arm gains after an unnoticed lock: which pre-failure error to choose.

    Example: holdfast trade-off panda --task position --samples 2000 --plot trade-off.png
    """
    model = read_arm(arm, base, tip, hold)
    errors = read_numbers("--allowed", allowed, "numbers from 0 to below 1")
    curve = hf.control.trade_off(model, read_task(task, arm, model), samples, allowed=errors, seed=seed)
    printed(curve, json_, drawn(curve, plot, out))
