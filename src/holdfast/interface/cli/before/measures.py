"""``holdfast index``, ``susceptibility`` and ``trade-off``."""

from __future__ import annotations

from typing import Annotated

import typer

import holdfast as hf
from holdfast.core.registry import SUSCEPTIBILITY_REGISTRY
from holdfast.interface.cli.groups import ArmSourceOptions, MountingOptions, OutputOptions, TaskOptions
from holdfast.interface.cli.measure_options import IndexOption
from holdfast.interface.cli.options import ArmArgument, DegreesOption, JsonOption, QOption, TaskOption
from holdfast.interface.cli.values import read_configuration, read_failures, read_numbers, read_task, read_weights
from holdfast.interface.presentation.printing import print_evaluations

ALLOWED_ERRORS = "0 0.05 0.1 0.15 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9"


def index(
    arm: ArmArgument,
    q: QOption,
    index: IndexOption = "relative-manipulability",
    considered: TaskOptions = TaskOptions(),
    degrees: DegreesOption = False,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Compute a fault-tolerance index and its gradient at one configuration.

    Example: holdfast index pa10-9dof --index relative-manipulability --q "0 30 0 90 0 18 0 36 0" --degrees
    """
    from holdfast.interface.presentation.indices.console import index_values, show_index
    from holdfast.kinematics.indices.index import by_name

    model = chain.resolve_arm(arm)
    configurations = [read_configuration(model, text, degrees) for text in q]
    task, failures = read_task(considered.task, arm, model), read_failures(model, considered.failures)
    measure = by_name(index, model, task, failures=failures, length=considered.length)
    print_evaluations(measure, configurations, json_, index_values, show_index)


def susceptibility(
    arm: ArmArgument,
    q: QOption,
    measure: Annotated[str, f"Susceptibility: {SUSCEPTIBILITY_REGISTRY.usage}."] = "torque",
    weights: Annotated[
        str | None,
        "Joint weights: effort, worst-case, one number per joint (1,2,3), or a CSV file with one number per joint or a square "
        "matrix. Default: equal weights.",
    ] = None,
    placement: MountingOptions = MountingOptions(),
    degrees: DegreesOption = False,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Compute how strongly each joint would react to losing its torque.

    Example: holdfast susceptibility panda --measure swing-angle --q "0 -45 0 -135 0 90 45" --degrees --mount wall
    """
    from holdfast.interface.presentation.indices.console import show_susceptibility, susceptibility_values
    from holdfast.kinematics.indices.susceptibility.measure import by_name

    model = placement.mount_arm(chain.resolve_arm(arm))
    configurations = [read_configuration(model, text, degrees) for text in q]
    chosen = by_name(measure, model, None if weights is None else read_weights("--weights", weights))
    print_evaluations(chosen, configurations, json_, susceptibility_values, show_susceptibility)


def trade_off(
    arm: ArmArgument,
    task: TaskOption = None,
    samples: Annotated[int, "Number of random configurations and directions."] = 2000,
    allowed: Annotated[str, "Allowed errors of the healthy arm: fractions of the speed from 0 to below 1."] = ALLOWED_ERRORS,
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
