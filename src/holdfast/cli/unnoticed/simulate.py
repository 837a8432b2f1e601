"""``holdfast simulate``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import holdfast as hf
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
from holdfast.errors import InputError
from holdfast.present.results import drawn, printed, said

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.result import Result


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
    model = read_arm(arm, base, tip, hold)
    options: dict[str, Any] = {"gain": gain, "speed_limit": speed_limit}
    made = read_law(law, model, read_task(task, arm, model), **options)
    goal = read_target(made.arm, made.task, target)
    joints, times = zip(*[_lock(model, text) for text in lock or []], strict=True) if lock else ((), ())
    q0 = read_configuration(model, start, degrees, "--start")
    runs = hf.simulate(made, q0, goal, joints, cycles, time_limit=time_limit, time=times or 0.0)
    result: Result = runs
    if physics:
        if cycles:
            raise InputError("--physics has a control rate of its own; leave out --cycles")
        servos = hf.Servos(bandwidth=servo_bandwidth)
        result = hf.simulate_physics(made, q0, goal, joints, servos, time_limit, time=times or 0.0)
    files = [] if out is None else result.save(out, command=said())
    if csv is not None:
        files.append(runs.to_csv(csv))
    if plot is not None:
        files.append(drawn(result, plot))
    printed(result, json_, files)


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
