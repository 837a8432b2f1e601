"""``holdfast plan-motion``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions, ClearanceOptions, OutputOptions, PathOptions
from holdfast.interface.cli.measure_options import OBJECTIVES_HELP
from holdfast.interface.cli.options import ArmArgument, KeepOption, MotionCsvOption, SeedOption, StartDegreesOption
from holdfast.interface.cli.values import read_configuration, read_objective


def command(
    arm: ArmArgument,
    tracked: PathOptions,
    rates: Annotated[Path | None, "Failure-rate file (YAML): how often each joint locks. Default: all equal."] = None,
    mode: Annotated[str, "Mode: on-path, or detour (after a lock, the tool may leave its path and come back)."] = "on-path",
    start: Annotated[str | None, "Start configuration in rad and m. Default: any configuration of the first pose."] = None,
    degrees: StartDegreesOption = False,
    samples: Annotated[int, "Number of poses, evenly spaced in time."] = 101,
    spacing: Annotated[float, "Distance between neighbouring configurations of a pose in rad."] = 0.05,
    compare: Annotated[
        list[str] | None,
        f"Motion to compare with: least-norm, or by gradient projection for an objective: {OBJECTIVES_HELP}. Repeatable.",
    ] = None,
    test_locks: Annotated[
        int, typer.Option("--test-locks", min=0, help="Number of random locks that test the motion; 0 skips it.")
    ] = 0,
    keep: KeepOption = None,
    apart: ClearanceOptions = ClearanceOptions(),
    seed: SeedOption = 0,
    chain: ArmSourceOptions = ArmSourceOptions(),
    csv: MotionCsvOption = None,
    output: OutputOptions = OutputOptions(),
) -> None:
    """Plan the motion along a path that tolerates the most single-joint locks.

    Example: holdfast plan-motion panda line.yaml --out endured
    """
    from holdfast.response.lock_survival.given_motion import LEAST_NORM

    apart.check_consistency()
    model = chain.resolve_arm(arm)
    timed, path_task = tracked.load_path(arm, model)
    result = hf.plan_motion(
        model,
        timed,
        rates=None if rates is None else hf.FailureRates.load(model, rates),
        mode=mode,  # type: ignore[arg-type]
        task=path_task,
        samples=samples,
        spacing=spacing,
        start=None if start is None else read_configuration(model, start, degrees),
        seed=seed,
        clearance=apart.build_if_requested(model),
        margin=apart.margin or 0.0,
        keep=keep,
        compare=[
            label if label == LEAST_NORM else read_objective(model, "--compare", label, path_task) for label in compare or []
        ],
    )
    if test_locks:
        result = replace(result, injected=result.test_locks(test_locks, seed=seed))
    output.print_result(result, [] if csv is None else [result.to_csv(csv)])
