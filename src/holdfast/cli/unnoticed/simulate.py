"""``holdfast simulate``."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from holdfast.cli.laws import LawOption, TargetOption, read_law
from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    HoldOption,
    JsonOption,
    TaskOption,
    TipOption,
    read_arm,
    read_configuration,
    read_joint,
    read_numbers,
    read_target,
    read_task,
)
from holdfast.errors import InputError, StoreError
from holdfast.files.output import writing
from holdfast.present.physics.console import physics_data, print_physics, run_physics
from holdfast.present.printing import console, number, print_json, print_written

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.physics.run import PhysicalRun
    from holdfast.simulation.runs import Path as MotionPath
    from holdfast.simulation.runs import Runs


def command(
    arm: ArmArgument,
    start: Annotated[
        str, typer.Option("--start", help="Joint values at the start, rad and m, by commas or spaces.", show_default=False)
    ],
    target: TargetOption,
    lock: Annotated[
        list[str] | None,
        typer.Option(
            "--lock",
            help="JOINT or JOINT@TIME: it locks at the start, or then (s or cycles). May be given again.",
            show_default=False,
        ),
    ] = None,
    law: LawOption = "pseudoinverse",
    task: TaskOption = None,
    gain: Annotated[float, typer.Option("--gain", help="Ke, per s or per cycle.")] = 1.0,
    speed_limit: Annotated[
        float | None,
        typer.Option("--speed-limit", help="Of the hand, m/s or m per cycle. Default: none.", show_default=False),
    ] = None,
    cycles: Annotated[bool, typer.Option("--cycles", help="Discrete control cycles in place of continuous time.")] = False,
    time_limit: Annotated[
        float | None,
        typer.Option("--time-limit", help="s or cycles.", show_default="3000/gain s, or 1000 cycles"),
    ] = None,
    physics: Annotated[
        bool, typer.Option("--physics", help="Also in MuJoCo, with bodies and joint servos (needs the extra 'physics').")
    ] = False,
    servo_bandwidth: Annotated[float, typer.Option("--servo-bandwidth", help="physics: of the joint servos, Hz.")] = 10.0,
    degrees: Annotated[bool, typer.Option("--degrees", help="--start is in degrees (sliding joints stay in m).")] = False,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    csv: Annotated[Path | None, typer.Option("--csv", help="Write the motion to this file.", show_default=False)] = None,
    plot: Annotated[Path | None, typer.Option("--plot", help="Draw the motion into this PNG file.", show_default=False)] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder for report.html with the arm moving, run.png and run.csv.", show_default=False),
    ] = None,
    json_: JsonOption = False,
) -> None:
    """Simulate an arm whose controller does not know that joints have locked: does the hand still arrive?

    Example: holdfast simulate planar-3r --start "20 40 60" --degrees --target 1.5,1.5 --lock 2@0.5 --plot run.png
    """
    from holdfast.simulation.closed_loop import simulate as run

    model = read_arm(arm, base, tip, hold)
    options: dict[str, Any] = {"gain": gain, "speed_limit": speed_limit}
    made = read_law(law, model, read_task(task, arm, model), **options)
    goal, locks = read_target(made.arm, made.task, target), [_lock(model, text) for text in lock or []]
    runs = run(made, read_configuration(model, start, degrees, "--start"), goal, locks, cycles, time_limit=time_limit)
    physical = run_physics(runs, goal, locks, servo_bandwidth, time_limit) if physics else None
    files: list[Path] = []
    if csv is not None or plot is not None or out is not None:
        files = _files(runs, csv, plot, out, physical)
    if json_:
        print_json(_data(runs) | ({} if physical is None else {"physics": physics_data(physical)}))
    else:
        _print(runs, files)
        if physical is not None:
            print_physics(physical)


def _lock(arm: Arm, text: str) -> tuple[int, float]:
    joint, at, time = text.rpartition("@")
    if not at:
        return read_joint(arm, text), 0.0
    return read_joint(arm, joint), float(_one(f"--lock '{text}'", time))


def _one(option: str, text: str) -> float:
    values = read_numbers(option, text, "one number after @")
    if values.size != 1:
        raise InputError(f"{option} has {values.size} numbers after @; give one time")
    return float(values[0])


def _data(runs: Runs) -> dict[str, Any]:
    from holdfast.simulation.runs import Reason

    names = runs.law.arm.joint_names

    def by_name(values: Any) -> dict[str, Any]:
        return dict(zip(names, values.tolist(), strict=True))

    unit = "cycles" if runs.cycles else "s"
    return {
        **runs.law.arm.entry(),
        "law": runs.law.slug,
        "task": runs.law.task.name,
        "locked": {name: t for name, t in by_name(runs.lock_time).items() if np.isfinite(t)},
        "outcome": str(runs.outcome),
        "reason": Reason(int(runs.reason)).name.lower(),
        f"time_{unit}": runs.time,
        "error": runs.error,
        "least_error": runs.least_error(),
        "closest": runs.closest,
        "path_length_m": runs.path_length,
        "x_final": runs.x_final.tolist(),
        "q_start": by_name(runs.q0),
        "q_final": by_name(runs.q_final),
        "q_low": by_name(runs.q_low),
        "q_high": by_name(runs.q_high),
        "limits_passed": [name for name, passed in by_name(runs.limits_passed).items() if passed],
        "limits": {j.name: [x if np.isfinite(x) else None for x in (j.lower, j.upper)] for j in runs.law.arm.joints},
    }


def _print(runs: Runs, files: list[Path]) -> None:
    from rich.markup import escape
    from rich.table import Table

    from holdfast.simulation.runs import ENDS, Reason

    out, arm = console(), runs.law.arm
    unit = "cycles" if runs.cycles else "s"
    locked = [f"{name} at {t:g} {unit}" for name, t in zip(arm.joint_names, runs.lock_time, strict=True) if np.isfinite(t)]
    standing = f"locked: {', '.join(locked)}" if locked else "no joint locked"
    out.print(f"Arm {escape(arm.title)}, {escape(runs.law.describe())}; {escape(standing)}", soft_wrap=True)
    reason = f": {Reason(int(runs.reason)).sentence}" if runs.reason else ""
    out.print(f"The hand [bold]{ENDS[str(runs.outcome)]}[/]{escape(reason)}.", soft_wrap=True)
    if limits := escape(runs.limits_sentence()):
        out.print(f"[yellow]{limits}[/]" if runs.limits_passed.any() else limits, soft_wrap=True)
    size = "m and rad" if runs.law.task.angular else "m"
    facts = Table.grid(padding=(0, 2))
    facts.add_row("error at the end", f"[bold]{number(float(runs.error))}[/] {size}")
    facts.add_row("least that the failed arm can have", f"{number(float(runs.least_error()))} {size}")
    facts.add_row("closest on the way", f"{number(float(runs.closest))} {size}")
    facts.add_row("path of the hand", f"{number(float(runs.path_length))} m")
    facts.add_row("took", f"{number(float(runs.time))} {unit}")
    out.print(facts)
    table = Table("joint", "start", "end", "least", "greatest", "", box=None, pad_edge=False)
    for k, joint in enumerate(arm.joints):
        factor, shown = joint.shown
        cells = [f"{number(factor * x[k])} {shown}" for x in (runs.q0, runs.q_final, runs.q_low, runs.q_high)]
        notes = ["locked"] if np.isfinite(runs.lock_time[k]) else []
        notes += ["passes its limits"] if runs.limits_passed[k] else []
        table.add_row(escape(joint.name), *cells, ", ".join(notes))
    out.print(table)
    print_written(out, files)


def _files(runs: Runs, csv: Path | None, plot: Path | None, out: Path | None, physical: PhysicalRun | None) -> list[Path]:
    from holdfast.present.simulation.run import RunReport
    from holdfast.report.figures import save_png

    report = RunReport(runs)
    files = []
    tables, pictures, overlays = [csv], [plot] if physical is None else [], [plot]
    if out is not None:
        try:
            out.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise StoreError(f"--out: folder '{out}' cannot be made: {error.strerror or error}; choose another") from error
        tables.append(out / "run.csv")
        pictures.append(out / "run.png")
        overlays.append(out / "physics.png")
    for file in tables:
        if file is not None:
            _write(runs, report.path, file)
            files.append(file)
    for file in pictures:
        if file is not None:
            files.append(save_png(report.figure(), file))
    if physical is not None:
        files += [save_png(physical.figure(), file) for file in overlays if file is not None]
    if out is not None:
        files.append(report.write(out / "report.html", f"holdfast {shlex.join(sys.argv[1:])}"))
    return files


def _write(runs: Runs, path: MotionPath, file: Path) -> None:
    from holdfast.paths.joint_table import joint_columns

    joints = joint_columns(runs.law.arm)
    header = ",".join(["time_cycles" if runs.cycles else "time_s", *joints, "tool_x_m", "tool_y_m", "tool_z_m", "error"])
    rows = np.column_stack([path.time, path.q, path.x, path.error])
    try:
        with writing(file) as stream:
            np.savetxt(stream, rows, fmt="%.9g", delimiter=",", header=header, comments="")
    except OSError as error:
        raise StoreError(f"cannot write motion '{file}': {error.strerror or error}; choose another path") from error


def add(app: typer.Typer) -> None:
    """Register the command."""
    app.command("simulate")(command)
