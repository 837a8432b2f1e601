"""``holdfast self-motion``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer
from numpy.typing import NDArray

import holdfast as hf
from holdfast.cli import clearance as apart
from holdfast.cli.options import (
    TARGET_HELP,
    ArmArgument,
    BaseOption,
    HoldOption,
    JsonOption,
    OutOption,
    PlotOption,
    SeedOption,
    TaskOption,
    TipOption,
    read_arm,
    read_pose,
    read_target,
    read_task,
)
from holdfast.errors import InputError
from holdfast.present.results import drawn, printed

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.arm.task import Task

PoseOption = Annotated[
    str | None, typer.Option("--pose", help="The target as x,y,z,roll,pitch,yaw of the tool, m and degrees.")
]
TargetOption = Annotated[str | None, typer.Option("--target", help=TARGET_HELP)]


def command(
    arm: ArmArgument,
    target: TargetOption = None,
    pose: PoseOption = None,
    task: TaskOption = None,
    bounds: Annotated[
        bool, typer.Option("--bounds", help="Also report where each joint may lock without losing the target.")
    ] = False,
    degrees: Annotated[bool, typer.Option("--degrees", help="--csv in degrees (prismatic joints stay in m).")] = False,
    spacing: Annotated[float, typer.Option("--spacing", help="Spacing of the points, rad.")] = 0.05,
    seed: SeedOption = 0,
    clearance: apart.ClearanceOption = None,
    capsules: apart.CapsulesOption = None,
    radius: apart.RadiusOption = None,
    meshes: apart.MeshesOption = None,
    margin: apart.MarginOption = None,
    cell: apart.CellOption = None,
    base: BaseOption = None,
    tip: TipOption = None,
    hold: HoldOption = None,
    csv: Annotated[Path | None, typer.Option("--csv", help="Write all points to this file.")] = None,
    plot: PlotOption = None,
    out: OutOption = None,
    json_: JsonOption = False,
) -> None:
    """Find all configurations for one target, and the values at which each joint may lock without losing it.

    With one degree of redundancy they are curves, closed or ended by a joint limit; with more they are sampled. A lock keeps
    the target within reach if and only if it lies in the range of its joint.

    Example: holdfast self-motion planar-3r --target 1.5,1.5 --bounds --plot self-motion.png
    """
    from holdfast.arm.task import as_task

    apart.check_clearance(clearance, capsules, radius, margin, cell)
    model = read_arm(arm, base, tip, hold)
    rows = as_task(model, read_task(task, arm, model))
    if (target is None) == (pose is None):
        raise InputError("give the target by --target or by --pose, one of them")
    wanted = read_target(model, rows, target) if target is not None else _pose(model, rows, str(pose))
    asked = margin is not None or cell is not None
    kept = apart.read_clearance(model, clearance, capsules, radius, margin, chooses=asked, cell=cell, meshes=meshes)
    motion = hf.self_motion(model, wanted, rows, spacing=spacing, seed=seed, clearance=kept, margin=margin or 0.0)
    if kept is not None and (bounds or motion.redundancy == 1):
        motion = replace(motion, bounds=motion.arcs())
    elif kept is None and (bounds or plot is not None or out is not None):
        motion = replace(motion, bounds=hf.joint_bounds(model, wanted, rows, seed=seed))
    printed(motion, json_, ([] if csv is None else [motion.to_csv(csv, degrees)]) + drawn(motion, plot, out))


def _pose(arm: Arm, task: Task, text: str) -> NDArray[np.float64]:
    values = read_pose(arm, "--pose", text)
    if values.shape == (4, 4):
        return values
    if task.angular:
        raise InputError(f"--pose has 3 numbers; task '{task.name}' needs 6, x,y,z in m and roll,pitch,yaw in degrees")
    made = np.eye(4)
    made[:3, 3] = values
    return made
