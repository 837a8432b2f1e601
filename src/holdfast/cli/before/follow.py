"""``holdfast follow``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

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
    DegreesOption,
    DurationOption,
    GravityOption,
    HoldOption,
    JsonOption,
    MotionCsvOption,
    MountOption,
    PathArgument,
    PathTaskOption,
    PayloadOption,
    TipOption,
    check_unit_of_places,
    placed,
    read_arm,
    read_configuration,
    read_objective,
    read_task,
)
from holdfast.errors import InputError
from holdfast.present.results import printed, said


def command(
    arm: ArmArgument,
    path: PathArgument,
    minimise: Annotated[
        str | None,
        typer.Option(
            "--minimise",
            help=f"What the self-motion makes small: {OBJECTIVES}; or a sum: '0.5*torque:effort + 0.1*acceleration'.",
        ),
    ] = None,
    maximise: Annotated[str | None, typer.Option("--maximise", help="What it makes large: the same choices.")] = None,
    method: Annotated[
        str,
        typer.Option(
            "--method",
            help="gradient-projection, extended-jacobian, augmented-jacobian or none (least-norm rates, to compare).",
        ),
    ] = "gradient-projection",
    task: PathTaskOption = None,
    q: Annotated[str | None, typer.Option("--q", help="Where to start, rad and m. Default: the best configuration.")] = None,
    degrees: DegreesOption = False,
    gain: Annotated[float | None, typer.Option("--gain", help="Feedback gain. Default: high enough to hardly lag.")] = None,
    wanted: Annotated[
        float | None, typer.Option("--wanted", help="Value the augmented Jacobian keeps. Default: that of the start.")
    ] = None,
    rate_cap: Annotated[
        float | None, typer.Option("--rate-cap", help="Largest norm of the joint rates, rad/s; slows self-motion only.")
    ] = None,
    samples: Annotated[int, typer.Option("--samples", help="Samples over the duration.")] = 501,
    duration: DurationOption = None,
    best: Annotated[
        bool, typer.Option("--best", help="Also the best of each pose (one or two degrees of redundancy).")
    ] = False,
    torque_bound: Annotated[
        float | None,
        typer.Option(
            "--torque-bound", help="N m. How slow must the motion be for torques to stay this close to those of gravity?"
        ),
    ] = None,
    cell: CellOption = None,
    clearance: ClearanceOption = None,
    capsules: CapsulesOption = None,
    radius: RadiusOption = None,
    meshes: MeshesOption = None,
    margin: MarginOption = None,
    no_limits: Annotated[bool, typer.Option("--no-limits", help="Ignore joint limits while moving.")] = False,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of the search for a start.")] = 0,
    mount: MountOption = "floor",
    gravity: GravityOption = None,
    payload: PayloadOption = None,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    out: Annotated[Path | None, typer.Option("--out", help="Folder for trajectory.csv and report.html.")] = None,
    csv: MotionCsvOption = None,
    parquet: Annotated[Path | None, typer.Option("--parquet", help="The same as Parquet (needs holdfast[parquet]).")] = None,
    json_: JsonOption = False,
) -> None:
    """Follow a path with the end effector while the self-motion prepares the arm for a joint failure.

    Example: holdfast follow panda path.yaml --minimise torque:effort --out motion
    """
    from holdfast.arm.task import task_of_path

    if (minimise is None) == (maximise is None):
        raise InputError("give one of --minimise and --maximise, for example --minimise torque:effort")
    check_clearance(clearance, capsules, radius, margin, cell)
    model = placed(read_arm(arm, base, tip, hold), mount, gravity, payload)
    timed = hf.paths.TimedPath.load(path, duration)
    check_unit_of_places(model, timed.path.pose(np.linspace(0, 1, 21))[:, :3, 3], f"path '{path}'")
    chosen = read_task(task or task_of_path(model, timed.path.oriented), arm, model)
    wish = ("--minimise", minimise) if minimise is not None else ("--maximise", maximise or "")
    objective = read_objective(model, *wish, chosen)  # the other way round already, if that is meant
    aim: dict[str, Any] = {"minimise" if objective.better == "smaller" else "maximise": objective}
    result = hf.follow(
        model,
        timed,
        **aim,
        method=method,  # type: ignore[arg-type]
        q=None if q is None else read_configuration(model, q, degrees),
        gain=gain,
        wanted=wanted,
        rate_cap=rate_cap,
        task=chosen,
        samples=samples,
        limits=not no_limits,
        seed=seed,
        best=best,
        torque_bound=torque_bound,
        clearance=read_kept(model, clearance, capsules, radius, margin, cell, meshes),
        margin=margin or 0.0,
    )
    files = [] if csv is None else [result.to_csv(csv)]
    if parquet is not None:
        files.append(result.to_parquet(parquet))
    if out is not None:
        files += result.save(out, command=said())
    printed(result, json_, files)
