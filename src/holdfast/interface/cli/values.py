"""Conversion of the text of an option to a value."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.files import reading
from holdfast.core.formatting import format_count
from holdfast.core.labels import is_number
from holdfast.model.arms.spec import default_task as default_task
from holdfast.model.arms.spec import read_task as read_task
from holdfast.model.failure_modes import read_failures as read_failures
from holdfast.model.failure_modes import read_joint as read_joint

if TYPE_CHECKING:
    from collections.abc import Sequence

    from holdfast.kinematics.indices.objective import Objective
    from holdfast.kinematics.paths import Path as ToolPath
    from holdfast.model.arm.machine import Joint
    from holdfast.model.arm.model import Arm
    from holdfast.model.arm.task import Task
    from holdfast.model.failure_modes import Degraded, FailureSpec


def read_numbers_by_joint(
    arm: Arm, texts: list[str] | None, option: str, degrees: bool = False, optional_value: bool = False
) -> dict[str | int, Any]:
    """Read the ``joint=number`` pairs of a repeatable option, by joint name; joints are given by name or number from 1.

    With ``degrees`` the numbers of revolute joints are in degrees; with ``optional_value`` a joint may be given without a
    number and gets None.
    """
    values: dict[str | int, Any] = {}
    for text in texts or []:
        joint, equals, value = text.rpartition("=")
        if (equals or not optional_value) and not (equals and is_number(value)):
            raise InputError(f"{option} '{text}' is not joint=number; write for example {option} {arm.joint_names[0]}=0.3")
        index = read_joint(arm, joint if equals else text)
        name = arm.joint_names[index]
        if name in values:
            raise InputError(f"{option} gives joint '{name}' twice; give each joint once")
        factor = np.pi / 180 if degrees and not arm.prismatic[index] else 1.0
        values[name] = factor * float(value) if equals else None
    return values


def read_locks(
    arm: Arm, texts: list[str] | None, degrees: bool, optional_value: bool = False, failure: Path | None = None
) -> dict[str | int, Any] | Degraded:
    """Read ``--lock`` of a command that has --degrees, see :func:`read_numbers_by_joint`, or the file of --failure."""
    if failure is not None:
        from holdfast.model.failure_modes import Degraded

        if texts:
            raise InputError("--failure and --lock both define the failure; give one of them")
        return Degraded.load(failure, arm)
    if not texts:
        raise InputError(f"no joint is locked; give --lock JOINT, for example --lock {arm.joint_names[0]}, or --failure")
    locked_values = read_numbers_by_joint(arm, texts, "--lock", degrees, optional_value)
    known_values = {name: value for name, value in locked_values.items() if value is not None}
    check_joint_units(
        [arm.joints[arm.joint_index(name)] for name in known_values], list(known_values.values()), "--lock", degrees
    )
    return locked_values


def read_numbers(option: str, text: str, expected: str) -> NDArray[np.float64]:
    """Read numbers separated by commas or spaces; in an error ``expected`` describes the option's value."""
    parts = [part for part in re.split(r"[,\s]+", text.strip()) if part]
    try:
        return np.array([float(part) for part in parts])
    except ValueError as error:
        invalid = next(part for part in parts if not is_number(part))
        raise InputError(f"{option}: '{invalid}' is not a number; give {expected} separated by commas or spaces") from error


def read_episode_numbers(option: str, text: str, count: int) -> list[int]:
    """Read numbers and ranges such as ``0:50,60``, in which the end of a range is excluded, for ``count`` episodes."""
    numbers: list[int] = []
    for part in text.split(","):
        try:
            ends = [int(end) if end.strip() else None for end in part.split(":")]
            numbers += range(count)[slice(*ends)] if len(ends) == 2 else [int(part)]
        except ValueError as error:
            raise InputError(f"{option} is '{text}'; give episodes such as 0:50 or 0:40,45") from error
    return numbers


def read_fraction(option: str, text: str) -> float:
    """Read a fraction, such as ``35%`` or ``0.35``."""
    number = text.strip().removesuffix("%")
    if not is_number(number):
        raise InputError(f"{option}: '{text}' is not a fraction; write for example 35% or 0.35")
    return float(number) / (100 if text.strip().endswith("%") else 1)


def check_joint_units(joints: Sequence[Joint], values: Sequence[float], option: str, degrees: bool = False) -> None:
    """Raise for joint values, rad and m, so far beyond the limits that they must be degrees or millimetres.

    Raises:
        InputError: A joint is more than a turn, or ten times its range, beyond its limits.
    """
    unit = "degrees" if degrees else "radians, or degrees with --degrees"
    for joint, value in zip(joints, values, strict=True):
        factor, unit_name = joint.display_unit if degrees else (1.0, joint.unit)
        bounded = np.isfinite(joint.upper - joint.lower)
        tolerance = 10 * (joint.upper - joint.lower) if joint.prismatic else 2 * np.pi
        lower, upper = (joint.lower, joint.upper) if bounded else (-2 * np.pi, 2 * np.pi)
        if (bounded or not joint.prismatic) and not lower - tolerance <= value <= upper + tolerance:
            limits = f"its limits, {factor * lower:.4g} to {factor * upper:.4g} {unit_name}" if bounded else "a turn"
            raise InputError(
                f"{option}: joint '{joint.name}' is at {factor * value:.6g} {unit_name}, far beyond {limits}; give "
                f"{'metres' if joint.prismatic else unit}"
            )


def check_position_units(arm: Arm, positions: NDArray[np.float64], option: str) -> None:
    """Raise for positions (3,) or (N, 3), m, so far from an arm that they must be millimetres.

    Raises:
        InputError: A position is more than ten times as far from the base as the stretched arm can reach.
    """
    strokes = sum(max(abs(joint.lower), abs(joint.upper)) for joint in arm.joints if joint.prismatic)
    transforms = [*(joint.origin for joint in arm.joints), arm.tool]
    longest = sum(float(np.linalg.norm(transform[:3, 3])) for transform in transforms) + strokes
    distance = float(np.linalg.norm(np.atleast_2d(positions) - arm.base[:3, 3], axis=1).max(initial=0.0))
    if np.isfinite(longest) and distance > 10 * longest:
        raise InputError(
            f"{option}: a position is {distance:.4g} m from the base of '{arm.name}', which is at most {longest:.4g} m long; "
            "give metres"
        )


def check_path_units(arm: Arm, path: ToolPath, option: str) -> None:
    """Raise for a path, m, so far from an arm that it must be in millimetres."""
    check_position_units(arm, path.pose(np.linspace(0, 1, 21))[:, :3, 3], option)


def read_configuration(arm: Arm, text: str, degrees: bool, option: str = "--q") -> NDArray[np.float64]:
    """Read joint values separated by commas or spaces; ``degrees`` applies to revolute joints, prismatic ones stay in m."""
    q = read_numbers(option, text, f"{arm.n} numbers")
    q = arm.check_configurations(q)
    if not np.isfinite(q).all():
        raise InputError(f"{option} contains NaN or infinity; give {arm.n} finite numbers")
    q = np.where(arm.prismatic, q, np.deg2rad(q)) if degrees else q
    check_joint_units(arm.joints, q.tolist(), option, degrees)
    return q


def read_weights(option: str, text: str) -> Any:
    """Read joint weights as an argument of the library: a word, numbers, or the numbers of a CSV file."""
    if text in ("effort", "worst-case"):
        return text
    file = Path(text)
    if file.suffix.lower() != ".csv":
        return read_numbers(option, text, "effort, worst-case, a .csv file, or one number per joint")
    try:
        with reading.guard_reading(f"{option}: '{file}'"):
            lines = reading.read_text(file).splitlines()
    except UnicodeDecodeError as error:
        raise InputError(f"{option}: {file} is not text; give numbers separated by commas") from error
    rows = [read_numbers(f"{option} {file}", line, "numbers") for line in lines if line.strip()]
    if len({len(row) for row in rows}) != 1:
        raise InputError(f"{option}: {file} must contain lines with equally many numbers: one per joint, or a square matrix")
    table = np.array(rows)
    return table.ravel() if 1 in table.shape else table


def read_objective(arm: Arm, option: str, text: str, task: str | Task, failures: FailureSpec = "single") -> Objective:
    """Read ``--minimise`` or ``--maximise``, such as ``0.5*torque:effort + 0.1*acceleration``, as an argument of the library.

    A summand is the label of an index or a susceptibility; a susceptibility may have a single joint after the colon.
    """
    from holdfast.kinematics.indices.objective import NegatedObjective, WeightedSum

    summands: list[tuple[float, Objective]] = []
    position = 0
    while position < len(text) or not summands:
        match = _SUMMAND_PATTERN.match(text, position)
        if match is None or (summands and not match["sign"]):
            raise InputError(
                f"{option}: '{text[position:].strip()}' cannot be read; write torque, torque:effort, torque:joint2, or a sum "
                "such as '0.5*torque:effort + 0.1*acceleration'"
            )
        factor = float(match["factor"] or 1) * (-1 if match["sign"] == "-" else 1)
        summands.append((factor, _make_objective_term(arm, option, match["name"], match["weights"], task, failures)))
        position = match.end()
    is_single = len(summands) == 1 and summands[0][0] == 1
    objective = summands[0][1] if is_single else WeightedSum(summands)
    better = {"--minimise": "smaller", "--maximise": "larger"}.get(option, objective.better)
    return objective if objective.better == better else NegatedObjective(objective)


_SUMMAND_PATTERN = re.compile(
    r"\s*(?P<sign>[+-])?\s*(?:(?P<factor>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*\*\s*)?"
    r"(?P<name>[A-Za-z_]\w*(?:[-.][A-Za-z_]\w*)*)(?:\s*:\s*(?P<weights>[^\s+,]+(?:\s*,\s*[^\s+,]+)*))?\s*"
)


def _make_objective_term(
    arm: Arm, option: str, name: str, weights: str | None, task: str | Task, failures: FailureSpec
) -> Objective:
    from holdfast.core.registry import INDEX_REGISTRY, SUSCEPTIBILITY_REGISTRY, unknown_name_message

    objective: Objective
    if name in SUSCEPTIBILITY_REGISTRY:
        if failures != "single":
            raise InputError(f"--failures is for an index, not for {name}; give one joint as {name}:joint2, or leave it out")
        options: dict[str, Any] = {}
        if weights is not None and SUSCEPTIBILITY_REGISTRY[name].parameters[0].kind == "JointSet":
            options["free"] = [_read_numbered_joint(arm, joint) for joint in weights.split(",")]
        elif weights is not None:
            options["weights"] = _read_joint_weights(arm, option, name, weights)
        objective = SUSCEPTIBILITY_REGISTRY.make(name, arm, option=option, **options)
    elif INDEX_REGISTRY.covers(label := name if weights is None else f"{name}:{weights}"):
        objective = INDEX_REGISTRY.make(label, arm, option=option, task=task, failures=failures)
    else:
        raise InputError(f"{option}: {unknown_name_message('objective', name, SUSCEPTIBILITY_REGISTRY, INDEX_REGISTRY)}")
    return objective


def _read_numbered_joint(arm: Arm, text: str) -> int:
    """Return the index from 0 of a joint given by name, by number from 1, or by number as joint2."""
    return read_joint(arm, text if text.strip() in arm.joint_names else text.strip().removeprefix("joint"))


def _read_joint_weights(arm: Arm, option: str, name: str, text: str) -> Any:
    """Read the weights after a colon: one joint by name or as joint2, or any text of :func:`read_weights`."""
    if text in arm.joint_names or (text.startswith("joint") and text.removeprefix("joint").isdecimal()):
        return np.eye(arm.n)[_read_numbered_joint(arm, text)]
    if text in ("effort", "worst-case") or text.lower().endswith(".csv"):
        return read_weights(option, text)
    if not all(is_number(part) for part in text.split(",")):
        raise InputError(
            f"{option}: weights '{text}' of {name} are not known; use effort, worst-case, a joint by name or as joint2, "
            f"{arm.n} numbers separated by commas, or a .csv file of them"
        )
    numbers = read_numbers(option, text, f"{arm.n} numbers")
    if numbers.size != arm.n:
        raise InputError(
            f"{option}: {name} has {numbers.size} weights and '{arm.name}' has {arm.n} joints; give one each, or one joint "
            "alone as joint2"
        )
    return numbers


def read_pose(arm: Arm, option: str, text: str) -> NDArray[np.float64]:
    """Read ``x,y,z,roll,pitch,yaw`` in m and degrees as (4, 4), or ``x,y,z`` alone as (3,)."""
    from holdfast.model.arm.formats.urdf import rpy_rotation

    numbers = read_numbers(option, text, "x,y,z,roll,pitch,yaw (m and degrees)")
    if numbers.size not in (3, 6):
        raise InputError(f"{option} has {format_count(numbers.size, 'number')}; give x,y,z,roll,pitch,yaw (m, deg) or x,y,z")
    if not np.isfinite(numbers).all():
        raise InputError(f"{option} contains NaN or infinity; give finite numbers")
    check_position_units(arm, numbers[:3], option)
    if numbers.size == 3:
        return numbers
    pose = np.eye(4)
    pose[:3, 3] = numbers[:3]
    pose[:3, :3] = rpy_rotation(np.deg2rad(numbers[3:]).tolist())
    return pose


def read_target(arm: Arm, task: Task, text: str) -> NDArray[np.float64]:
    """Read ``--target`` as an argument of the library: one value per task component, or a pose (4, 4)."""
    values = read_numbers("--target", text, "numbers")
    if not np.isfinite(values).all():
        raise InputError("--target contains NaN or infinity; give finite numbers")
    if values.size == 6:
        return read_pose(arm, "--target", text)
    if values.size == 7:
        from holdfast.model.arm.poses import pose_from_quaternion

        check_position_units(arm, values[:3], "--target")
        if not np.linalg.norm(values[3:]) > 1e-9:
            raise InputError("--target: the last four numbers are a quaternion x,y,z,w and must not all be 0")
        return pose_from_quaternion(values[:3], values[3:])
    if task.angular or task.frame != "base":
        raise InputError(
            f"--target has {format_count(values.size, 'number')}; task '{task.name}' needs x,y,z,roll,pitch,yaw in m and "
            "degrees, or x,y,z in m and a quaternion x,y,z,w"
        )
    if values.size != task.m:
        raise InputError(f"--target has {format_count(values.size, 'number')}; task '{task.name}' needs {task.m}, in m")
    check_position_units(arm, values @ task.rows[:, :3], "--target")
    return values
