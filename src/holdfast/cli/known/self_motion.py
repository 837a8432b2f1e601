"""``holdfast self-motion`` and ``holdfast tolerant-workspace``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from numpy.typing import NDArray

from holdfast.cli.options import (
    TARGET_HELP,
    ArmArgument,
    BaseOption,
    HoldOption,
    JsonOption,
    PlotOption,
    SeedOption,
    TaskOption,
    TipOption,
    read_arm,
    read_joint,
    read_numbers,
    read_pose,
    read_target,
    read_task,
)
from holdfast.errors import InputError
from holdfast.files.output import writing
from holdfast.present.printing import console, number, print_json, print_written

if TYPE_CHECKING:
    from holdfast.arm.machine import Joint
    from holdfast.arm.model import Arm
    from holdfast.arm.task import Task
    from holdfast.reach.bounds import Arcs
    from holdfast.reach.tolerance import TolerantWorkspace
    from holdfast.solvers.self_motions import SelfMotion

PoseOption = Annotated[
    str | None,
    typer.Option("--pose", help="The target as x,y,z,roll,pitch,yaw of the tool, m and degrees.", show_default=False),
]
TargetOption = Annotated[
    str | None,
    typer.Option("--target", help=TARGET_HELP, show_default=False),
]


def command(
    arm: ArmArgument,
    target: TargetOption = None,
    pose: PoseOption = None,
    task: TaskOption = None,
    bounds: Annotated[bool, typer.Option("--bounds", help="Also where each joint may lock without losing the target.")] = False,
    degrees: Annotated[bool, typer.Option("--degrees", help="--csv in degrees (sliding joints stay in m).")] = False,
    spacing: Annotated[float, typer.Option("--spacing", help="Of the points, rad.")] = 0.05,
    seed: SeedOption = 0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    csv: Annotated[Path | None, typer.Option("--csv", help="Write all points to this file.", show_default=False)] = None,
    plot: PlotOption = None,
    json_: JsonOption = False,
) -> None:
    """All configurations of one target, and the values at which each joint may lock without losing it.

    With one redundant joint they are curves, closed or ended by a joint limit; with more a sample. A lock keeps the target
    within reach if and only if it lies in the range of its joint.

    Example: holdfast self-motion planar-3r --target 1.5,1.5 --bounds --plot self-motion.png
    """
    from holdfast.arm.task import as_task
    from holdfast.reach.bounds import joint_bounds
    from holdfast.solvers.self_motions import self_motion as trace

    model = read_arm(arm, base, tip, hold)
    rows = as_task(model, read_task(task, arm, model))
    if (target is None) == (pose is None):
        raise InputError("give the target by --target or by --pose, one of them")
    wanted = read_target(model, rows, target) if target is not None else _pose(model, rows, str(pose))
    motion = trace(model, wanted, rows, spacing, seed)
    arcs = joint_bounds(model, wanted, rows, seed) if bounds or plot is not None else None
    if csv is not None:
        _write(model, motion, degrees, csv)
    if plot is not None and arcs is not None:
        _draw(model, motion, arcs, plot)
    if json_:
        print_json(_data(model, motion, arcs))
    else:
        _print(model, motion, arcs, [file for file in (csv, plot) if file is not None])


def _pose(arm: Arm, task: Task, text: str) -> NDArray[np.float64]:
    values = read_pose(arm, "--pose", text)
    if values.shape == (4, 4):
        return values
    if task.angular:
        raise InputError(f"--pose has 3 numbers; task '{task.name}' needs 6, x,y,z in m and roll,pitch,yaw in degrees")
    made = np.eye(4)
    made[:3, 3] = values
    return made


def _component(arm: Arm, motion: SelfMotion, k: int) -> str:
    c = motion.components[k]
    if c.closed:
        return "closed"
    ends = [f"limit of {arm.joint_names[i]}" if i is not None else "singular configuration" for i in c.bounded_by]
    return " to ".join(ends)


def _data(arm: Arm, motion: SelfMotion, arcs: list[Arcs] | None) -> dict[str, Any]:
    data: dict[str, Any] = {
        **arm.entry(),
        "task": motion.task.name,
        "status": motion.status.name.lower(),
        "redundancy": motion.redundancy,
        "spacing_rad": motion.spacing,
        "points": len(motion.q),
        "components": [
            {
                "closed": c.closed,
                "length_rad": c.length,
                "bounded_by": [None if i is None else arm.joint_names[i] for i in c.bounded_by],
                "points": len(c.q),
            }
            for c in motion.components
        ],
    }
    if arcs is not None:
        data["bounds"] = dict(zip(arm.joint_names, arcs, strict=True))
    return data


def _print(arm: Arm, motion: SelfMotion, arcs: list[Arcs] | None, files: list[Path]) -> None:
    from rich.markup import escape
    from rich.table import Table

    out = console()
    out.print(f"[bold]{escape(arm.title)}[/bold], task {escape(motion.task.name)}: {motion.describe()}", soft_wrap=True)
    if motion.components:
        table = Table("curve", "length", "points", "", box=None, pad_edge=False)
        for k, c in enumerate(motion.components):
            table.add_row(str(k + 1), f"{number(c.length)} rad", str(len(c.q)), escape(_component(arm, motion, k)))
        out.print(table)
    if arcs is not None:
        table = Table("joint", "may lock at", "", box=None, pad_edge=False)
        for joint, found, turns in zip(arm.joints, arcs, _turning(arm), strict=True):
            free = turns and found == [(-np.pi, np.pi)]
            whole = free or found == [(joint.lower, joint.upper)]
            table.add_row(escape(joint.name), _arcs(found, joint), "anywhere" if whole else "" if found else "nowhere")
        out.print(table)
    print_written(out, files)


def _turning(arm: Arm) -> list[bool]:
    from holdfast.solvers.joint_space import turning

    return [bool(x) for x in turning(arm)]


def _arcs(arcs: Arcs, joint: Joint) -> str:
    if not arcs:
        return "-"
    factor, unit = joint.shown
    return ", ".join(f"{_short(factor * a)} to {_short(factor * b)}" for a, b in arcs) + f" {unit}"


def _short(value: float) -> str:
    return f"{value:.2f}" if abs(value) >= 0.005 else "0.00"


def _write(arm: Arm, motion: SelfMotion, degrees: bool, file: Path) -> None:
    turning = degrees & ~arm.prismatic
    units = ["deg" if t else j.unit for t, j in zip(turning, arm.joints, strict=True)]
    sizes = [len(c.q) for c in motion.components] or [len(motion.q)]
    curve = np.repeat(np.arange(1, len(sizes) + 1), sizes)
    rows = np.column_stack([curve, np.where(turning, np.rad2deg(motion.q), motion.q)])
    header = ",".join(["curve", *(f"{j.name}_{u}" for j, u in zip(arm.joints, units, strict=True))])
    with writing(file, "points") as stream:
        np.savetxt(stream, rows, fmt=["%d", *["%.12g"] * arm.n], delimiter=",", header=header, comments="")


def _draw(arm: Arm, motion: SelfMotion, arcs: list[Arcs], file: Path) -> None:
    from holdfast.present.reach.figures import self_motion_picture
    from holdfast.report.figures import save_png

    save_png(self_motion_picture(arm, motion, arcs), file)


# ---- the failure-tolerant workspace ------------------------------------------------------------------------------


def tolerant_workspace(
    arm: ArmArgument,
    task: Annotated[
        str | None,
        typer.Option("--task", help="planar, position, or with turns (see --rotation). Default: planar or position."),
    ] = None,
    limit: Annotated[
        list[str] | None,
        typer.Option(
            "--limit",
            help="JOINT=LOW,HIGH: artificial limits, deg (sliding: m). May be given again. Default: the arm's own.",
            show_default=False,
        ),
    ] = None,
    optimise: Annotated[
        bool, typer.Option("--optimise", help="Look for the artificial limits that make the region largest.")
    ] = False,
    rotation: Annotated[
        str | None,
        typer.Option("--rotation", help="Of the hand, for tasks with turns: roll,pitch,yaw, deg.", show_default=False),
    ] = None,
    points: Annotated[int, typer.Option("--points", help="In the sample (not for planar arms of three joints).")] = 1000,
    angles: Annotated[int, typer.Option("--angles", help="Locked values per joint that are tried.")] = 24,
    seed: SeedOption = 0,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    plot: PlotOption = None,
    json_: JsonOption = False,
) -> None:
    """Every point that the arm reaches before and after any single joint locks, under artificial joint limits.

    Example: holdfast tolerant-workspace planar-3r --optimise --plot region.png
    """
    from holdfast.arm.task import plane_normal
    from holdfast.reach.tolerance import tolerant_workspace as compute

    model = read_arm(arm, base, tip, hold)
    rows = read_task(task, arm, model) if task else "planar" if plane_normal(model) is not None else "position"
    limits = {read_joint(model, text.partition("=")[0]): _limit(model, text) for text in limit or []}
    turn = None
    if rotation is not None:
        from scipy.spatial.transform import Rotation

        values = read_numbers("--rotation", rotation, "roll,pitch,yaw (degrees)")
        if values.size != 3 or not np.isfinite(values).all():
            raise InputError(f"--rotation has {values.size} numbers; give roll,pitch,yaw in degrees")
        turn = Rotation.from_euler("xyz", values, degrees=True).as_matrix()
    region = compute(model, rows, limits or None, optimise=optimise, rotation=turn, points=points, angles=angles, seed=seed)
    if plot is not None:
        from holdfast.present.reach.figures import region_picture
        from holdfast.report.figures import save_png

        save_png(region_picture(region), plot)
    if json_:
        print_json(_region_data(region))
    else:
        _print_region(region, plot)


def _limit(arm: Arm, text: str) -> tuple[float, float]:
    joint, _, values = text.partition("=")
    numbers = read_numbers(f"--limit '{text}'", values, "JOINT=LOW,HIGH")
    if numbers.size != 2:
        raise InputError(f"--limit '{text}' has {numbers.size} numbers after =; give the lower and the upper limit")
    factor = arm.joints[read_joint(arm, joint)].shown[0]
    return float(numbers[0] / factor), float(numbers[1] / factor)


def _region_data(region: TolerantWorkspace) -> dict[str, Any]:
    names = region.arm.joint_names
    unit = region.unit.replace("^", "")
    return {
        **region.arm.entry(),
        "task": region.task.name,
        "exact": region.exact,
        "optimised": region.optimised,
        "limits": dict(zip(names, region.limits.tolist(), strict=True)),
        f"size_{unit}": region.size,
        f"size_interval_{unit}": list(region.size_interval),
        "confidence": None if region.exact else region.confidence,
        f"healthy_size_{unit}": region.healthy_size,
        "share": region.share,
        "points": None if region.exact else len(region.points),
        "locked_values_per_joint": None if region.exact else region.angles,
        "lost_to": dict(zip(names, region.lost_to.tolist(), strict=True)),
    }


def _print_region(region: TolerantWorkspace, plot: Path | None) -> None:
    from rich.markup import escape
    from rich.table import Table

    out = console()
    out.print(f"[bold]{escape(region.arm.title)}[/bold], task {escape(region.task.name)}: {region.describe()}", soft_wrap=True)
    table = Table("joint", "artificial limits", "points its locks lose", box=None, pad_edge=False)
    for joint, (low, high), lost in zip(region.arm.joints, region.limits, region.lost_to, strict=True):
        table.add_row(escape(joint.name), _arcs([(low, high)], joint), f"{lost:.1%}")
    out.print(table)
    if not region.exact:
        out.print("values between the tried ones, and configurations that were not found, are not in the interval")
    print_written(out, [plot])
