"""``holdfast recover``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.labels import is_number, parse_quantities
from holdfast.interface.cli.declaration import FigurePath
from holdfast.interface.cli.groups import ArmSourceOptions, ClearanceOptions
from holdfast.interface.cli.options import (
    AT_HELP,
    NOT_MET_EXIT_CODE,
    TASK_NAMES_HELP,
    ArmArgument,
    FailureOption,
    JsonOption,
    KeepOption,
    RrdOption,
)
from holdfast.interface.cli.values import (
    check_path_units,
    read_configuration,
    read_locks,
    read_numbers,
    read_numbers_by_joint,
    read_pose,
    read_task,
)
from holdfast.interface.presentation.printing import make_console
from holdfast.interface.presentation.results import current_command, print_result

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm


def command(
    arm: ArmArgument,
    lock: Annotated[
        list[str] | None, "Locked joint, by name or number: JOINT=VALUE in rad or m, or JOINT for its --at value. Repeatable."
    ] = None,
    failure: FailureOption = None,
    at: Annotated[str | None, f"{AT_HELP} Required without --check."] = None,
    goal: Annotated[
        str | None,
        "Goal: home, 'q:' and joint values (rad, m), or 'pose:' and x,y,z,roll,pitch,yaw (m, degrees) or x,y,z; one of "
        "several poses separated by ';'. Default: home; with --path, the end of the path.",
    ] = None,
    within: Annotated[
        str | None,
        "Largest angle between the z axes of tool and goal, such as 30deg; rotation about the axis is free. Default: none.",
    ] = None,
    task: Annotated[
        str | None,
        f"{TASK_NAMES_HELP} With --task, the goals home and q: are tool poses, not joint values. Default: pose; "
        "position for a goal without orientation; planar for an arm that moves in a plane.",
    ] = None,
    path: Annotated[Path | None, "Path file (YAML): rest of the tool path, finished before moving to --goal."] = None,
    keep: KeepOption = None,
    degrees: Annotated[bool, "Read --at, --lock and q: in degrees (prismatic joints: m)."] = False,
    metric: Annotated[str, "Quantity to minimise: travel (length in joint space) or time (at the velocity limits)."] = "travel",
    region: Annotated[
        Path | None, "Region file (YAML) for the remaining workspace. Default: random poses of the healthy arm."
    ] = None,
    samples: Annotated[int, typer.Option("--samples", min=0, help="Poses for the remaining workspace; 0 skips it.")] = 1000,
    starts: Annotated[int, typer.Option("--starts", min=1, help="Random starts of the search for goal configurations.")] = 256,
    tries: Annotated[int, typer.Option("--tries", min=0, help="Number of route searches if straight lines are blocked.")] = 4,
    relax: Annotated[bool, typer.Option("--relax/--no-relax", help="Search a motion with relaxed rows.")] = True,
    time_limit: Annotated[float | None, "Time limit of all searches in s. Default: none."] = None,
    tolerance: Annotated[str | None, "Allowed error of goal and path in infeasibility proofs: 1mm,0.5deg. Default: 0."] = None,
    accelerations: Annotated[
        str | None,
        "Acceleration limits of the motion in rad/s^2 and m/s^2: one number, one per joint, or JOINT=NUMBER,... Default: none.",
    ] = None,
    period: Annotated[float, "Sampling period in s of a motion that is timed with --accelerations."] = 0.01,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of all random numbers.")] = 0,
    apart: ClearanceOptions = ClearanceOptions(),
    check: Annotated[Path | None, "CSV file of waypoints to check by a replay, instead of planning."] = None,
    out: Annotated[FigurePath, "Folder for report.html, recovery.json, waypoints.csv and figures."] = None,
    certificate: Annotated[
        Path | None, "File for the proof that no configuration meets the goal. Default: not written."
    ] = None,
    csv: Annotated[Path | None, "CSV file for the waypoints."] = None,
    rrd: RrdOption = None,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Plan a motion that finishes the task after a known failure, or prove that none exists.

    Exit code: 0 if the whole request is met, else 3, for example if the goal needs another value of a locked joint.

    Example: holdfast recover panda --lock 4=-2 --at "2 0.6 0 -2 0 2.5 0.8" --task position --out home
    """
    apart.check_consistency()
    model = chain.resolve_arm(arm)
    clearance = apart.build_clearance(model)
    max_accelerations = None if accelerations is None else _read_accelerations(model, accelerations)
    if check is not None:
        locked = read_locks(model, lock, degrees, optional_value=True, failure=failure) if lock or failure else ()
        replay = hf.recovery.check_waypoints(
            model,
            hf.recovery.read_waypoints(model, check),
            locked,
            clearance=clearance,
            margin=apart.margin or 0.0,
            keep=keep,
            time=hf.recovery.read_times(model, check),
            accelerations=max_accelerations,
        )
        print_result(replay, json_)
        if not replay.ok:
            raise typer.Exit(NOT_MET_EXIT_CODE)
        return
    if at is None:
        raise InputError("give --at, the current joint values, for example --at " + ",".join("0" * model.n))
    target_goal, positions = _read_goal(model, goal or ("home" if path is None else ""), degrees)
    if positions and within is not None:
        raise InputError("--within refers to the z axis of the goal, and --goal has no orientation; give x,y,z,roll,pitch,yaw")
    known_task = None if task is None else read_task(task, arm, model)
    tool_path = None if path is None else hf.paths.Path.load(path)
    if tool_path is not None:
        check_path_units(model, tool_path, "--path")
    result = hf.recover(
        model,
        read_locks(model, lock, degrees, optional_value=True, failure=failure),
        read_configuration(model, at, degrees, "--at"),
        goal=target_goal,
        task=_choose_position_task(model, known_task) if positions else known_task,
        within=None if within is None else _read_axis_tolerance(within),
        path=tool_path,
        clearance=clearance or False,
        margin=apart.margin or 0.0,
        keep=keep,
        metric=metric,  # type: ignore[arg-type]
        region=None if region is None else hf.Region.load(region),
        samples=samples,
        starts=starts,
        tries=tries,
        relax=relax,
        time_limit=time_limit,
        tolerance=None if tolerance is None else tuple(parse_quantities("--tolerance", tolerance)),  # type: ignore[arg-type]
        accelerations=max_accelerations,
        period=period,
        seed=seed,
    )
    files = [result.to_csv(csv)] if csv is not None and len(result.q) else []
    if rrd is not None and len(result.q):
        files.append(result.to_rrd(rrd))
    if certificate is not None and not result.ok:
        files.append(result.certificate().write(certificate))
    if out is not None:
        files += result.save(out, command=current_command())
    print_result(result, json_, files)
    for file in (csv, rrd):
        if file is not None and not len(result.q) and not json_:
            make_console(stderr=True).print(
                f"holdfast: no motion was found, so '{file}' is not written", markup=False, soft_wrap=True
            )
    if not result.ok:
        raise typer.Exit(NOT_MET_EXIT_CODE)


def _read_accelerations(arm: Arm, text: str) -> Any:
    """Read ``--accelerations`` as an argument of the library."""
    if "=" in text:
        return read_numbers_by_joint(arm, text.replace(",", " ").split(), "--accelerations")
    numbers = read_numbers("--accelerations", text, "a number, one per joint, or JOINT=NUMBER")
    return numbers if len(numbers) > 1 else float(numbers[0])


def _read_axis_tolerance(text: str) -> float:
    """Read ``--within`` in rad."""
    if not text.strip().endswith(("deg", "rad")):
        raise InputError(f"--within '{text}' has no unit; write it as 30deg or 0.5rad")
    angles = parse_quantities("--within", text)
    if len(angles) != 1:
        raise InputError(f"--within '{text}' has {len(angles)} numbers; give one angle, for example 30deg")
    return angles[0]


def _read_goal(arm: Arm, text: str, degrees: bool) -> tuple[Any, bool]:
    """Read ``--goal`` as an argument of the library; return it and whether it is a position without orientation."""
    if text in ("", "home") or text in arm.states:
        return text or None, False
    kind, colon, numbers = text.partition(":")
    words = text.replace(",", " ").split()
    if not colon and words and is_number(words[0]):
        count = len(words)
        if arm.n in (3, 6) and count in (3, 6):
            raise InputError(f"--goal '{text}' could be joint values or a pose; write 'q:{text}' or 'pose:{text}'")
        kind, numbers = ("q" if count == arm.n else "pose"), text
    if kind == "q":
        return read_configuration(arm, numbers, degrees, "--goal"), False
    if kind != "pose":
        raise InputError(
            f"--goal '{text}' is not known; write {', '.join({'home': 0, **arm.states})}, "
            f"'q:...' with {arm.n} joint values, or 'pose:...'"
        )
    poses = [read_pose(arm, "--goal", pose_text) for pose_text in numbers.split(";")]
    goal_poses = np.repeat(np.eye(4)[None], len(poses), axis=0)
    for goal_pose, pose in zip(goal_poses, poses, strict=True):
        goal_pose[: len(pose), 3 if pose.ndim == 1 else slice(None)] = pose
    return goal_poses, any(pose.ndim == 1 for pose in poses)


def _choose_position_task(arm: Arm, task: Any) -> Any:
    """Return the task of a goal without orientation."""
    from holdfast.model.arm.task import as_task, plane_normal

    if task is None:
        return "planar" if plane_normal(arm) is not None else "position"
    position_task = as_task(arm, task)
    if position_task.angular:
        raise InputError(
            f"--goal has no orientation and task '{position_task.name}' needs one; give x,y,z,roll,pitch,yaw or --task position"
        )
    return position_task
