"""``holdfast follow``."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from holdfast.cli.measure_options import OBJECTIVES
from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    GravityOption,
    HoldOption,
    JsonOption,
    MountOption,
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
from holdfast.files.output import made
from holdfast.present.printing import console, number, print_json, print_written

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.motion.slowness import SlowMotion
    from holdfast.motion.trajectory import Trajectory
    from holdfast.paths.timed_path import TimedPath


def command(
    arm: ArmArgument,
    path: Annotated[
        Path, typer.Argument(metavar="PATH", help="Path file of the hand (YAML): line, arc or poses.", show_default=False)
    ],
    minimise: Annotated[
        str | None,
        typer.Option(
            "--minimise",
            help=f"What the self-motion makes small: {OBJECTIVES}; or a sum: '0.5*torque:effort + 0.1*acceleration'.",
            show_default=False,
        ),
    ] = None,
    maximise: Annotated[
        str | None, typer.Option("--maximise", help="What it makes large; the same words.", show_default=False)
    ] = None,
    method: Annotated[
        str,
        typer.Option(
            "--method",
            help="gradient-projection, extended-jacobian, augmented-jacobian or none (least-norm rates, to compare).",
        ),
    ] = "gradient-projection",
    task: Annotated[
        str | None,
        typer.Option(
            "--task",
            help="pose, pointing, position, planar, planar-pose, or rows such as vx,vy,wz. Default: position for a path of "
            "positions (planar if the arm moves in a plane), else pose.",
            show_default=False,
        ),
    ] = None,
    q: Annotated[
        str | None,
        typer.Option("--q", help="Where to start, rad and m. Default: the best configuration.", show_default=False),
    ] = None,
    degrees: Annotated[bool, typer.Option("--degrees", help="--q is in degrees (sliding joints stay in m).")] = False,
    gain: Annotated[
        float | None, typer.Option("--gain", help="Of the law. Default: so that it hardly lags.", show_default=False)
    ] = None,
    wanted: Annotated[
        float | None,
        typer.Option("--wanted", help="Value the augmented Jacobian keeps. Default: that of the start.", show_default=False),
    ] = None,
    rate_cap: Annotated[
        float | None,
        typer.Option("--rate-cap", help="Largest norm of the joint rates, rad/s; slows self-motion only.", show_default=False),
    ] = None,
    samples: Annotated[int, typer.Option("--samples", help="Samples over the duration.")] = 501,
    duration: Annotated[
        float | None,
        typer.Option("--duration", help="s; instead of the file's, needed if it has no timing.", show_default=False),
    ] = None,
    best: Annotated[
        bool, typer.Option("--best", help="Also the best of each pose over its whole self-motion (one or two joints to spare).")
    ] = False,
    torque_bound: Annotated[
        float | None,
        typer.Option(
            "--torque-bound",
            help="N m: how slow must the motion be for torques to stay this close to gravity's?",
            show_default=False,
        ),
    ] = None,
    no_limits: Annotated[bool, typer.Option("--no-limits", help="Ignore joint limits while moving.")] = False,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Of the search for a start.")] = 0,
    mount: MountOption = "floor",
    gravity: GravityOption = None,
    payload: PayloadOption = None,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder for trajectory.csv and report.html.", show_default=False)
    ] = None,
    csv: Annotated[Path | None, typer.Option("--csv", help="Write the motion to this file.", show_default=False)] = None,
    parquet: Annotated[
        Path | None, typer.Option("--parquet", help="The same as Parquet (needs holdfast[parquet]).", show_default=False)
    ] = None,
    json_: JsonOption = False,
) -> None:
    """Follow a path with the hand while the self-motion prepares the arm for a joint failure.

    Example: holdfast follow panda path.yaml --minimise torque:effort --out motion
    """
    from holdfast.motion import tracking

    if (minimise is None) == (maximise is None):
        raise InputError("give one of --minimise and --maximise, for example --minimise torque:effort")
    for option, file, ending in (("--csv", csv, ".csv"), ("--parquet", parquet, ".parquet")):
        if file is not None and file.suffix.lower() != ending:
            raise InputError(f"{option}: '{file}' does not end in {ending}; give it that ending")
    model = placed(read_arm(arm, base, tip, hold), mount, gravity, payload)
    timed = _timed(path, duration)
    check_unit_of_places(model, timed.path.pose(np.linspace(0, 1, 21))[:, :3, 3], f"path '{path}'")
    chosen = read_task(_task(task, timed, model), arm, model)
    wish = ("--minimise", minimise) if minimise is not None else ("--maximise", maximise or "")
    objective = read_objective(model, *wish, chosen)  # the other way round already, if that is meant
    start = None if q is None else read_configuration(model, q, degrees)
    result = tracking.follow(
        model,
        timed,
        minimise=objective if objective.better == "smaller" else None,
        maximise=objective if objective.better == "larger" else None,
        method=method,  # type: ignore[arg-type]
        q=start,
        gain=gain,
        wanted=wanted,
        rate_cap=rate_cap,
        task=chosen,
        samples=samples,
        limits=not no_limits,
        seed=seed,
        best=best,
    )
    slowness = None if torque_bound is None else result.slowness(torque_bound)
    files = [result.save(file) for file in (csv, parquet) if file is not None]
    if out is not None:
        files += _folder(result, out, torque_bound)
    if json_:
        print_json(_data(result, torque_bound, slowness))
    else:
        _print(result, torque_bound, slowness, files)


def _timed(file: Path, duration: float | None) -> TimedPath:
    """The path of a file with its timing, or with that of --duration."""
    from holdfast.paths.path import in_file
    from holdfast.paths.timed_path import TimedPath
    from holdfast.paths.timing import Trapezoid

    path, timing, stop = in_file(file)
    if duration is None:
        if timing is None:
            raise InputError(
                f"path file '{file}' has no timing; give --duration 10, or write 'timing: {{duration: 10}}' into it"
            )
        return TimedPath(path, timing, stop)
    if timing is None:
        return TimedPath(path, Trapezoid(duration), stop)
    return TimedPath(path, Trapezoid(duration, timing.accelerate, timing.decelerate), stop)


def _task(given: str | None, path: TimedPath, arm: Arm) -> str:
    from holdfast.arm.task import plane_normal

    if given is not None:
        return given
    flat = plane_normal(arm) is not None
    if path.path.oriented:
        return "planar-pose" if flat else "pose"
    return "planar" if flat else "position"


def _folder(result: Trajectory, out: Path, torque_bound: float | None) -> list[Path]:
    made(out)
    command = f"holdfast {shlex.join(sys.argv[1:])}"
    return [result.save(out / "trajectory.csv"), result.report(out / "report.html", command, torque_bound)]


def _facts(values: Any) -> dict[str, float]:
    found = np.asarray(values)
    return {
        "start": found[0],
        "end": found[-1],
        "mean": float(np.nanmean(found)),
        "smallest": float(np.nanmin(found)),
        "largest": float(np.nanmax(found)),
    }


def _data(result: Trajectory, bound: float | None, slowness: list[SlowMotion] | None) -> dict[str, Any]:
    names = result.arm.joint_names
    data: dict[str, Any] = {
        **result.arm.entry(),
        "objective": result.objective.name,
        "better": result.objective.better,
        "unit": result.objective.unit,
        "task": result.task.name,
        "method": result.method,
        "gain": result.gain,
        "seed": result.seed,
        "duration_s": result.time[-1],
        "samples": len(result.time),
        "hand_on_path": result.on_path,
        "position_error_m": np.nanmax(result.position_error),
        "rotation_error_rad": np.nanmax(result.rotation_error),
        "value": _facts(result.value),
        "best_value": None if result.best_value is None else _facts(result.best_value),
        "largest_rate_norm_per_s": result.peak_rate,
        "largest_rate_norm_at_s": result.peak_time,
        "q_start": dict(zip(names, result.q[0].tolist(), strict=True)),
        "q_end": dict(zip(names, result.q[-1].tolist(), strict=True)),
        "events": [{"kind": e.kind, "start_s": e.start, "end_s": e.end, "text": e.text} for e in result.events],
    }
    if slowness is not None:
        data["torque_bound"] = bound
        data["time_scale"] = max(s.time_scale for s in slowness)
        data["time_scale_by_joint"] = {name: s.time_scale for name, s in zip(names, slowness, strict=True)}
    return data


def _print(result: Trajectory, bound: float | None, slowness: list[SlowMotion] | None, files: list[Path]) -> None:
    from rich.markup import escape
    from rich.table import Table

    out = console()
    first, *rest = result.describe()
    look = "bold" if result.on_path else "bold red"
    out.print(f"[{look}]{escape(first[:1].upper() + first[1:])}[/]", soft_wrap=True)
    facts = _facts(result.value)
    table = Table(escape(result.objective.name), *facts, box=None, pad_edge=False)
    unit = "" if result.objective.unit in ("1", "mixed") else f", {result.objective.unit}"
    table.add_row(escape(f"{result.method}{unit}"), *[number(x) for x in facts.values()])
    if result.best_value is not None:
        table.add_row("best of each pose", *[number(x) for x in _facts(result.best_value).values()])
    out.print(table)
    for line in rest[1:]:
        out.print(escape(line[:1].upper() + line[1:]), soft_wrap=True)
    if slowness is not None:
        _print_slowness(result, bound or 0.0, slowness)
    print_written(out, files)


def _print_slowness(result: Trajectory, bound: float, slowness: list[SlowMotion]) -> None:
    from rich.markup import escape
    from rich.table import Table

    out = console()
    worst = max(slowness, key=lambda s: s.time_scale)
    joint = escape(result.arm.joint_names[slowness.index(worst)])
    verdict = (
        f"slow enough: it could take {number(worst.time_scale)} of its time"
        if worst.satisfied
        else f"too fast: it must take {number(worst.time_scale)} times as long ({number(worst.time_scale * result.time[-1])} s)"
    )
    out.print(f"For torques within {bound:g} N m of gravity's the motion is {verdict}; '{joint}' decides.", soft_wrap=True)
    table = Table("joint", "time scale", "decided at", box=None, pad_edge=False)
    for name, s in zip(result.arm.joint_names, slowness, strict=True):
        table.add_row(
            escape(name), number(s.time_scale), f"{result.time[s.worst_time_index]:.4g} s" if s.time_scale > 0 else ""
        )
    out.print(table)


def add(app: typer.Typer) -> None:
    """Register the command."""
    app.command("follow")(command)
