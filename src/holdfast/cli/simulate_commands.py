"""``holdfast simulate``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from holdfast.cli.law_options import DampingOption, LawOption, PreFailureOption, WeightsOption, read_law
from holdfast.cli.options import (
    ArmArgument,
    BaseOption,
    JsonOption,
    TaskOption,
    TipOption,
    console,
    number,
    print_json,
    read_arm,
    read_configuration,
    read_joint,
    read_numbers,
    read_task,
)
from holdfast.cli.physics_output import physics_data, print_physics, run_physics
from holdfast.errors import InputError, StoreError

if TYPE_CHECKING:
    from holdfast.arm import Arm
    from holdfast.control import Law
    from holdfast.simulate import Path as MotionPath
    from holdfast.simulate import PhysicalRun, Runs

SHOWN = 200.0  # 1/Ke: a run that takes longer is drawn and written so far only
SAMPLES = 1000
ENDS = {
    "converged": "arrives",
    "stuck": "comes to rest elsewhere",
    "moving": "never comes to rest",
    "undecided": "is undecided",
}


def simulate(
    arm: ArmArgument,
    start: Annotated[
        str, typer.Option("--start", help="Joint values at the start, rad and m, by commas or spaces.", show_default=False)
    ],
    target: Annotated[
        str,
        typer.Option(
            "--target",
            help="Where the tool should go, m: as many numbers as the task has rows; with turns x,y,z and quaternion x,y,z,w.",
            show_default=False,
        ),
    ],
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
    weights: WeightsOption = None,
    damping: DampingOption = None,
    pre_failure_error: PreFailureOption = None,
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
    csv: Annotated[Path | None, typer.Option("--csv", help="Write the motion to this file.", show_default=False)] = None,
    plot: Annotated[Path | None, typer.Option("--plot", help="Draw the motion into this PNG file.", show_default=False)] = None,
    json_: JsonOption = False,
) -> None:
    """Simulate an arm whose controller does not know that joints have locked: does the hand still arrive?

    Example: holdfast simulate planar-3r --start "20 40 60" --degrees --target 1.5,1.5 --lock 2@0.5 --plot run.png
    """
    from holdfast.simulate import simulate as run

    model = read_arm(arm, base, tip)
    options: dict[str, Any] = {"gain": gain, "speed_limit": speed_limit}
    made = read_law(law, model, read_task(task, arm, model), weights, damping, pre_failure_error, **options)
    goal, locks = _target(made, target), [_lock(model, text) for text in lock or []]
    runs = run(made, read_configuration(model, start, degrees, "--start"), goal, locks, cycles, time_limit=time_limit)
    physical = run_physics(runs, goal, locks, servo_bandwidth, time_limit) if physics else None
    if csv is not None or plot is not None:
        longest = float(runs.time) if cycles else min(float(runs.time), SHOWN / gain)
        path = runs.path(0, SAMPLES + 1, until=longest or None)
        if csv is not None:
            _write(runs, path, csv)
        if plot is not None:
            _draw(runs, path, plot, physical)
    if json_:
        print_json(_data(runs) | ({} if physical is None else {"physics": physics_data(physical)}))
    else:
        _print(runs, [file for file in (csv, plot) if file is not None])
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


def _target(law: Law, text: str) -> np.ndarray[Any, np.dtype[np.float64]]:
    values = read_numbers("--target", text, "numbers")
    task = law.task
    if values.size == 7:
        from scipy.spatial.transform import Rotation

        if not (np.isfinite(values).all() and np.linalg.norm(values[3:]) > 1e-9):
            raise InputError("--target: the last four numbers are a quaternion x,y,z,w and must not all be 0")
        pose = np.eye(4)
        pose[:3, 3], pose[:3, :3] = values[:3], Rotation.from_quat(values[3:]).as_matrix()
        return pose
    if task.angular or task.frame != "base":
        raise InputError(
            f"--target has {values.size} numbers; task '{task.name}' needs 7, the position x,y,z in m and the quaternion "
            "x,y,z,w"
        )
    if values.size != task.m:
        raise InputError(f"--target has {values.size} numbers; task '{task.name}' needs {task.m}, in m")
    return values


def _data(runs: Runs) -> dict[str, Any]:
    from holdfast.simulate import Reason

    names = runs.law.arm.joint_names

    def by_name(values: Any) -> dict[str, Any]:
        return dict(zip(names, values.tolist(), strict=True))

    unit = "cycles" if runs.cycles else "s"
    return {
        "arm": runs.law.arm.name,
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
    }


def _print(runs: Runs, files: list[Path]) -> None:
    from rich.markup import escape
    from rich.table import Table

    from holdfast.simulate import Reason

    out, arm = console(), runs.law.arm
    unit = "cycles" if runs.cycles else "s"
    locked = [f"{name} at {t:g} {unit}" for name, t in zip(arm.joint_names, runs.lock_time, strict=True) if np.isfinite(t)]
    standing = f"locked: {', '.join(locked)}" if locked else "no joint locked"
    out.print(f"Arm {escape(arm.name)}, {escape(runs.law.describe())}; {escape(standing)}", soft_wrap=True)
    reason = f": {Reason(int(runs.reason)).sentence}" if runs.reason else ""
    out.print(f"The hand [bold]{ENDS[str(runs.outcome)]}[/]{escape(reason)}.", soft_wrap=True)
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
        factor, shown = (1.0, "m") if joint.prismatic else (180 / np.pi, "deg")
        cells = [f"{number(factor * x[k])} {shown}" for x in (runs.q0, runs.q_final, runs.q_low, runs.q_high)]
        notes = ["locked"] if np.isfinite(runs.lock_time[k]) else []
        notes += ["passes its limits"] if runs.limits_passed[k] else []
        table.add_row(escape(joint.name), *cells, ", ".join(notes))
    out.print(table)
    for file in files:
        out.print(f"written: {escape(str(file))}", soft_wrap=True)


def _write(runs: Runs, path: MotionPath, file: Path) -> None:
    joints = [f"{j.name}_{j.unit}" for j in runs.law.arm.joints]
    header = ",".join(["time_cycles" if runs.cycles else "time_s", *joints, "tool_x_m", "tool_y_m", "tool_z_m", "error"])
    rows = np.column_stack([path.time, path.q, path.x, path.error])
    try:
        with file.open("w", encoding="utf-8") as stream:
            np.savetxt(stream, rows, fmt="%.9g", delimiter=",", header=header, comments="")
    except OSError as error:
        raise StoreError(f"cannot write motion '{file}': {error.strerror or error}; choose another path") from error


def _draw(runs: Runs, path: MotionPath, file: Path, physical: PhysicalRun | None) -> None:
    from holdfast.report.figures import save_png
    from holdfast.report.motion import Panel, motion_figure

    if physical is not None:
        save_png(physical.figure(), file)
        return
    arm = runs.law.arm
    size = "m and rad" if runs.law.task.angular else "m"
    travelled = np.linalg.norm(path.x - path.x[0], axis=1)
    least = float(runs.least_error())
    panels = [
        Panel(
            path.time,
            path.error,
            f"error of the hand, {size}",
            f"Ends {runs.outcome}",
            (least, "least the failed arm can have"),
        ),
        Panel(path.time, travelled, "distance of the tool from its start, m", "Tool"),
    ]
    locked = [name for name, t in zip(arm.joint_names, runs.lock_time, strict=True) if np.isfinite(t)]
    caption = f"{arm.name}, {runs.law.name}, locked: {', '.join(locked) or 'none'}; the controller does not know; one run"
    save_png(motion_figure(panels, caption, "cycle" if runs.cycles else "time, s"), file)


def add(app: typer.Typer) -> None:
    """Register the command."""
    app.command()(simulate)
