"""``holdfast endure``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

import holdfast as hf
from holdfast.cli.clearance import (
    CapsulesOption,
    CellOption,
    ClearanceOption,
    MarginOption,
    MeshesOption,
    RadiusOption,
    check_clearance,
    read_kept,
)
from holdfast.cli.measure_options import OBJECTIVES
from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    DurationOption,
    HoldOption,
    JsonOption,
    KeepOption,
    MotionCsvOption,
    OutOption,
    PathArgument,
    PathTaskOption,
    PlotOption,
    SeedOption,
    StartDegreesOption,
    TipOption,
    check_unit_of_places,
    read_arm,
    read_configuration,
    read_objective,
    read_task,
)
from holdfast.present.results import drawn, printed


def command(
    arm: ArmArgument,
    path: PathArgument,
    rates: Annotated[
        Path | None, typer.Option("--rates", help="File with how often each joint locks (YAML). Default: all alike.")
    ] = None,
    mode: Annotated[
        str, typer.Option("--mode", help="on-path, or detour: after a lock the tool may leave its path and come back.")
    ] = "on-path",
    task: PathTaskOption = None,
    start: Annotated[str | None, typer.Option("--start", help="Where the motion begins, rad and m. Default: anywhere.")] = None,
    degrees: StartDegreesOption = False,
    samples: Annotated[int, typer.Option("--samples", help="Poses, evenly spaced in time.")] = 101,
    spacing: Annotated[float, typer.Option("--spacing", help="Of the configurations of a pose, rad.")] = 0.05,
    duration: DurationOption = None,
    compare: Annotated[
        list[str] | None,
        typer.Option(
            "--compare",
            help=f"Another motion beside it: least-norm, or what gradient projection serves: {OBJECTIVES}. May be given again.",
        ),
    ] = None,
    inject: Annotated[int, typer.Option("--inject", min=0, help="Try so many locks at random times.")] = 0,
    keep: KeepOption = None,
    cell: CellOption = None,
    clearance: ClearanceOption = None,
    capsules: CapsulesOption = None,
    radius: RadiusOption = None,
    meshes: MeshesOption = None,
    margin: MarginOption = None,
    seed: SeedOption = 0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    csv: MotionCsvOption = None,
    plot: PlotOption = None,
    out: OutOption = None,
    json_: JsonOption = False,
) -> None:
    """Find the motion along a path that survives most: the path can be finished whichever joint locks, whenever it does.

    Example: holdfast endure panda line.yaml --out endured
    """
    from holdfast.arm.task import task_of_path
    from holdfast.endurance.given import LEAST_NORM

    check_clearance(clearance, capsules, radius, margin, cell)
    model = read_arm(arm, base, tip, hold)
    timed = hf.paths.TimedPath.load(path, duration)
    check_unit_of_places(model, timed.path.pose(np.linspace(0, 1, 21))[:, :3, 3], f"path '{path}'")
    rows = read_task(task or task_of_path(model, timed.path.oriented), arm, model)
    result = hf.endure(
        model,
        timed,
        rates=None if rates is None else hf.FailureRates.load(model, rates),
        mode=mode,  # type: ignore[arg-type]
        task=rows,
        samples=samples,
        spacing=spacing,
        start=None if start is None else read_configuration(model, start, degrees),
        seed=seed,
        clearance=read_kept(model, clearance, capsules, radius, margin, cell, meshes),
        margin=margin or 0.0,
        keep=keep,
        compare=[other if other == LEAST_NORM else read_objective(model, "--compare", other, rows) for other in compare or []],
    )
    if inject:
        result = replace(result, injected=result.inject(inject, seed=seed))
    printed(result, json_, ([] if csv is None else [result.to_csv(csv)]) + drawn(result, plot, out))
