"""``holdfast trade-off``."""

from __future__ import annotations

from typing import Annotated

import typer

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions, OutputOptions
from holdfast.interface.cli.options import ArmArgument, TaskOption
from holdfast.interface.cli.values import read_numbers, read_task

ALLOWED_ERRORS = "0 0.05 0.1 0.15 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9"


def command(
    arm: ArmArgument,
    task: TaskOption = None,
    samples: Annotated[int, "Random configurations and directions."] = 2000,
    allowed: Annotated[str, "Pre-failure errors, from 0 to below 1, increasing."] = ALLOWED_ERRORS,
    seed: Annotated[int, typer.Option("--seed", help="Seed of the samples.", min=0)] = 0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    output: OutputOptions = OutputOptions(),
) -> None:
    """Compare accuracy before a failure with the error after an undetected lock.

    Example: holdfast trade-off panda --task position --samples 2000 --plot trade-off.png
    """
    model = chain.resolve_arm(arm)
    errors = read_numbers("--allowed", allowed, "numbers from 0 to below 1")
    curve = hf.control.trade_off(model, read_task(task, arm, model), samples, allowed=errors, seed=seed)
    output.print_result(curve)
