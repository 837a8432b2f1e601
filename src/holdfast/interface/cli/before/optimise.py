"""``holdfast optimise``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.interface.cli.groups import ArmSourceOptions, ClearanceOptions, MountingOptions
from holdfast.interface.cli.measure_options import MaximiseOption, MinimiseOption
from holdfast.interface.cli.options import ArmArgument, AtDegreesOption, FailuresOption, JsonOption, PageOption, TaskOption
from holdfast.interface.cli.values import (
    check_position_units,
    read_configuration,
    read_failures,
    read_objective,
    read_pose,
    read_task,
)
from holdfast.interface.presentation.results import print_result, write_outputs

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm
    from holdfast.model.arm.task import Task


def command(
    arm: ArmArgument,
    minimise: MinimiseOption = None,
    maximise: MaximiseOption = None,
    pose: Annotated[
        list[str] | None,
        "Tool pose in the world frame: x,y,z,roll,pitch,yaw in m and degrees (URDF: Rz(yaw) Ry(pitch) Rx(roll)), or x,y,z for "
        "a task without orientation. Repeatable.",
    ] = None,
    poses: Annotated[Path | None, "CSV file of tool poses in m; first line x,y,z,qx,qy,qz,qw (or x,y,z)."] = None,
    at: Annotated[list[str] | None, "Configuration that defines the tool pose: joint values in rad and m. Repeatable."] = None,
    any_pose: Annotated[bool, "Search all configurations within the joint limits instead of those of one pose."] = False,
    degrees: AtDegreesOption = False,
    task: TaskOption = None,
    failures: FailuresOption = "single",
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of all random numbers.")] = 0,
    starts: Annotated[
        int | None,
        "Number of random starts per pose. Default: 128, or 32 for a redundancy of 2 or more; 10,000 with --any-pose.",
    ] = None,
    apart: ClearanceOptions = ClearanceOptions(),
    placement: MountingOptions = MountingOptions(),
    chain: ArmSourceOptions = ArmSourceOptions(),
    out: PageOption = None,
    csv: Annotated[Path | None, "CSV file for the configurations."] = None,
    json_: JsonOption = False,
) -> None:
    """Find the most fault-tolerant configuration of a tool pose, or of all poses (--any-pose).

    Example: holdfast optimise panda --at "0 -45 0 -135 0 90 45" --degrees --minimise torque:effort
    """
    from holdfast.kinematics.solvers.optima import optimise
    from holdfast.model.arm.task import as_task

    apart.check_consistency()
    model = placement.mount_arm(chain.resolve_arm(arm))
    pose_task = as_task(model, read_task(task, arm, model))
    if (minimise is None) == (maximise is None):
        raise InputError("give one of --minimise and --maximise, for example --minimise torque:effort")
    option_and_text = ("--minimise", minimise) if minimise is not None else ("--maximise", maximise or "")
    objective = read_objective(model, *option_and_text, pose_task, read_failures(model, failures))
    if [pose is not None, poses is not None, at is not None, any_pose].count(True) != 1:
        raise InputError('give one of --pose "x,y,z,roll,pitch,yaw", --poses FILE.csv, --at "joint values" and --any-pose')
    initial = None if at is None else np.array([read_configuration(model, numbers, degrees, "--at") for numbers in at])
    targets = None
    if not any_pose:
        targets = (
            _read_target_poses(model, pose_task, pose or [], poses) if initial is None else model.forward_kinematics(initial)
        )
    optima = optimise(
        model,
        targets,
        objective,
        seed=seed,
        starts=starts,
        task=pose_task,
        clearance=apart.build_clearance(model),
        margin=apart.margin or 0.0,
        initial=initial,
    ).require_any()
    files = write_outputs(optima, None, out) + ([] if csv is None else [optima.to_csv(csv)])
    print_result(optima, json_, files, asked=" ".join(option_and_text).removeprefix("--"))


def _read_target_poses(arm: Arm, task: Task, texts: Sequence[str], file: Path | None) -> FloatArray:
    if file is None:
        option, given_poses = "--pose", [read_pose(arm, "--pose", text) for text in texts]
    else:
        from holdfast.kinematics.paths.path_file import read_pose_table

        option, given_poses = "--poses", read_pose_table(file, "--poses")
    if not given_poses:
        raise InputError(f"{option}: '{file}' contains no poses; give at least one row")
    check_position_units(arm, np.array([pose[:3, 3] if pose.shape == (4, 4) else pose for pose in given_poses]), option)
    targets = np.tile(np.eye(4), (len(given_poses), 1, 1))
    for target, given_pose in zip(targets, given_poses, strict=True):
        if given_pose.shape == (4, 4):
            target[:] = given_pose
        elif task.angular:
            raise InputError(
                f"{option}: a pose is given as x,y,z without orientation, and task '{task.name}' needs one; give the "
                "orientation as well, or --task position"
            )
        else:
            target[:3, 3] = given_pose
    return targets
