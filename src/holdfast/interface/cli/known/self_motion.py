"""``holdfast self-motion``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer
from numpy.typing import NDArray

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.cli.groups import ArmSourceOptions, ClearanceOptions, OutputOptions
from holdfast.interface.cli.laws import OptionalTargetOption
from holdfast.interface.cli.options import NOT_MET_EXIT_CODE, ArmArgument, SeedOption, TaskOption
from holdfast.interface.cli.values import read_pose, read_target, read_task

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm
    from holdfast.model.arm.task import Task

PoseOption = Annotated[str | None, "Target pose of the tool: x,y,z,roll,pitch,yaw in m and degrees; replaces --target."]


def command(
    arm: ArmArgument,
    target: OptionalTargetOption = None,
    pose: PoseOption = None,
    task: TaskOption = None,
    bounds: Annotated[bool, "Also find the values at which each joint may lock without losing the target."] = False,
    explain: Annotated[
        bool, "Instead, find out whether the pose is unreachable or a solver failed. Exit code: 0 if it is reachable, else 3."
    ] = False,
    degrees: Annotated[bool, "Write --csv in degrees (prismatic joints: m)."] = False,
    spacing: Annotated[float, "Distance between neighbouring configurations in rad."] = 0.05,
    seed: SeedOption = 0,
    apart: ClearanceOptions = ClearanceOptions(),
    chain: ArmSourceOptions = ArmSourceOptions(),
    csv: Annotated[Path | None, "CSV file for all configurations."] = None,
    output: OutputOptions = OutputOptions(),
) -> None:
    """Trace all configurations of a tool pose and the joint values at which a lock is harmless.

    With one degree of redundancy, the configurations form curves that are closed or end at a joint limit; with more, they are
    sampled. The target stays reachable after a lock if and only if the locked value lies in the range of its joint.

    Example: holdfast self-motion planar-3r --target 1.5,1.5 --bounds --plot self-motion.png
    """
    from holdfast.model.arm.task import as_task
    from holdfast.response.recovery import PoseVerdict

    apart.check_consistency()
    model = chain.resolve_arm(arm)
    rows = as_task(model, read_task(task, arm, model))
    if (target is None) == (pose is None):
        raise InputError("give the target by either --target or --pose")
    target_value = read_target(model, rows, target) if target is not None else _read_task_pose(model, rows, str(pose))
    chooses = apart.margin is not None or apart.cell is not None
    clearance = apart.build_clearance(model, chooses_configurations=chooses)
    if explain:
        explanation = hf.explain_ik(
            model, target_value, task=rows, clearance=clearance or False, margin=apart.margin or 0.0, seed=seed
        )
        if output.plot is not None:
            raise InputError("--explain draws no figure; leave --plot out, or use --out for a report")
        output.print_result(explanation)
        raise typer.Exit(0 if explanation.verdict == PoseVerdict.REACHABLE else NOT_MET_EXIT_CODE)
    motion = hf.self_motion(
        model, target_value, rows, spacing=spacing, seed=seed, clearance=clearance, margin=apart.margin or 0.0
    )
    if clearance is not None and (bounds or motion.redundancy == 1):
        motion = replace(motion, bounds=motion.arcs())
    elif clearance is None and (bounds or output.plot is not None or output.out is not None):
        motion = replace(motion, bounds=hf.joint_bounds(model, target_value, rows, seed=seed))
    output.print_result(motion, [] if csv is None else [motion.to_csv(csv, degrees)])


def _read_task_pose(arm: Arm, task: Task, text: str) -> NDArray[np.float64]:
    values = read_pose(arm, "--pose", text)
    if values.shape == (4, 4):
        return values
    if task.angular:
        raise InputError(f"--pose has 3 numbers; task '{task.name}' needs 6, x,y,z in m and roll,pitch,yaw in degrees")
    position_pose = np.eye(4)
    position_pose[:3, 3] = values
    return position_pose
