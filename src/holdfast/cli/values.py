"""How the text of an option becomes a value."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arms.spec import default_task as default_task
from holdfast.arms.spec import read_task as read_task
from holdfast.errors import InputError
from holdfast.failures import read_failures as read_failures
from holdfast.failures import read_joint as read_joint
from holdfast.files import reading
from holdfast.grammar import is_number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from holdfast.arm.machine import Joint
    from holdfast.arm.model import Arm
    from holdfast.arm.task import Task
    from holdfast.failures import Degraded, FailureSpec
    from holdfast.indices.objective import Objective
    from holdfast.paths import Path as ToolPath


def read_by_joint(
    arm: Arm, texts: list[str] | None, option: str, degrees: bool = False, alone: bool = False
) -> dict[str | int, Any]:
    """``joint=number`` of an option that may be given again, by name; joints are given by name or number from 1.

    With ``degrees`` the numbers of revolute joints are in degrees; with ``alone`` a joint may be given without a number and
    gets None.
    """
    found: dict[str | int, Any] = {}
    for text in texts or []:
        joint, equals, value = text.rpartition("=")
        if (equals or not alone) and not (equals and is_number(value)):
            raise InputError(f"{option} '{text}' is not joint=number; write for example {option} {arm.joint_names[0]}=0.3")
        k = read_joint(arm, joint if equals else text)
        name = arm.joint_names[k]
        if name in found:
            raise InputError(f"{option} gives joint '{name}' twice; give each joint once")
        turned = np.pi / 180 if degrees and not arm.prismatic[k] else 1.0
        found[name] = turned * float(value) if equals else None
    return found


def read_locks(
    arm: Arm, texts: list[str] | None, degrees: bool, alone: bool = False, failure: Path | None = None
) -> dict[str | int, Any] | Degraded:
    """--lock of a command that has --degrees, see :func:`read_by_joint`, or what --failure names."""
    if failure is not None:
        from holdfast.failures import Degraded

        if texts:
            raise InputError("--failure and --lock both say what is locked; give one of them")
        return Degraded.load(failure, arm)
    if not texts:
        raise InputError(f"give --lock, the joint that is locked, for example --lock {arm.joint_names[0]}, or --failure")
    found = read_by_joint(arm, texts, "--lock", degrees, alone)
    given = {name: value for name, value in found.items() if value is not None}
    check_unit_of_joints([arm.joints[arm.joint_index(name)] for name in given], list(given.values()), "--lock", degrees)
    return found


def read_numbers(option: str, text: str, wanted: str) -> NDArray[np.float64]:
    """Numbers separated by commas or spaces; ``wanted`` says in an error what the option takes."""
    parts = [x for x in re.split(r"[,\s]+", text.strip()) if x]
    try:
        return np.array([float(x) for x in parts])
    except ValueError as error:
        wrong = next(x for x in parts if not is_number(x))
        raise InputError(f"{option}: '{wrong}' is not a number; give {wanted} separated by commas or spaces") from error


def check_unit_of_joints(joints: Sequence[Joint], values: Sequence[float], option: str, degrees: bool = False) -> None:
    """Refuse values of joints, rad and m, so far beyond the limits that they must be degrees, or millimetres.

    Raises:
        InputError: A joint is more than a turn, or ten times its range, beyond its limits.
    """
    unit = "degrees" if degrees else "radians, or degrees with --degrees"
    for joint, value in zip(joints, values, strict=True):
        factor, shown = joint.shown if degrees else (1.0, joint.unit)
        bounded = np.isfinite(joint.upper - joint.lower)
        room = 10 * (joint.upper - joint.lower) if joint.prismatic else 2 * np.pi
        low, high = (joint.lower, joint.upper) if bounded else (-2 * np.pi, 2 * np.pi)
        if (bounded or not joint.prismatic) and not low - room <= value <= high + room:
            limits = f"its limits, {factor * low:.4g} to {factor * high:.4g} {shown}" if bounded else "a turn"
            raise InputError(
                f"{option}: joint '{joint.name}' is at {factor * value:.6g} {shown}, far beyond {limits}; give "
                f"{'metres' if joint.prismatic else unit}"
            )


def check_unit_of_places(arm: Arm, places: NDArray[np.float64], option: str) -> None:
    """Refuse places (3,) or (N, 3), m, so far from an arm that they must be millimetres.

    Raises:
        InputError: A place is more than ten times as far from the base as the arm, stretched out, could be long.
    """
    strokes = sum(max(abs(j.lower), abs(j.upper)) for j in arm.joints if j.prismatic)
    parts = [*(j.origin for j in arm.joints), arm.tool]
    longest = sum(float(np.linalg.norm(part[:3, 3])) for part in parts) + strokes
    away = float(np.linalg.norm(np.atleast_2d(places) - arm.base[:3, 3], axis=1).max(initial=0.0))
    if np.isfinite(longest) and away > 10 * longest:
        raise InputError(
            f"{option}: a place is {away:.4g} m from the base of '{arm.name}', which is at most {longest:.4g} m long; "
            "give metres"
        )


def check_unit_of_path(arm: Arm, path: ToolPath, option: str) -> None:
    """The same of the places along a path."""
    check_unit_of_places(arm, path.pose(np.linspace(0, 1, 21))[:, :3, 3], option)


def read_configuration(arm: Arm, text: str, degrees: bool, option: str = "--q") -> NDArray[np.float64]:
    """Joint values separated by commas or spaces; with degrees, of the revolute joints (prismatic ones stay in m)."""
    q = read_numbers(option, text, f"{arm.n} numbers")
    q = arm.check_configurations(q)
    if not np.isfinite(q).all():
        raise InputError(f"{option} holds NaN or infinity; give {arm.n} finite numbers")
    q = np.where(arm.prismatic, q, np.deg2rad(q)) if degrees else q
    check_unit_of_joints(arm.joints, q.tolist(), option, degrees)
    return q


def read_weights(option: str, text: str) -> Any:
    """Weights of the joints as the library takes them: a word, numbers, or the numbers of a CSV file."""
    if text in ("effort", "worst-case"):
        return text
    file = Path(text)
    if file.suffix.lower() != ".csv":
        return read_numbers(option, text, "effort, worst-case, a .csv file, or one number per joint")
    try:
        with reading.guarded(f"{option}: '{file}'"):
            lines = reading.text(file).splitlines()
    except UnicodeDecodeError as error:
        raise InputError(f"{option}: {file} is not text; give numbers separated by commas") from error
    rows = [read_numbers(f"{option} {file}", line, "numbers") for line in lines if line.strip()]
    if len({len(row) for row in rows}) != 1:
        raise InputError(f"{option}: {file} must hold lines of equally many numbers: one per joint, or a square matrix")
    table = np.array(rows)
    return table.ravel() if 1 in table.shape else table


def read_objective(arm: Arm, option: str, text: str, task: str | Task, failures: FailureSpec = "single") -> Objective:
    """--minimise or --maximise as the library takes it: ``0.5*torque:effort + 0.1*acceleration``.

    A summand is the label of an index or a susceptibility; of this, after the colon may also be the one joint that counts.
    """
    from holdfast.indices.objective import Opposite, WeightedSum

    summands: list[tuple[float, Objective]] = []
    at = 0
    while at < len(text) or not summands:
        found = _SUMMAND.match(text, at)
        if found is None or (summands and not found["sign"]):
            raise InputError(
                f"{option}: '{text[at:].strip()}' cannot be read; write torque, torque:effort, torque:joint2, or a sum such as "
                "'0.5*torque:effort + 0.1*acceleration'"
            )
        factor = float(found["factor"] or 1) * (-1 if found["sign"] == "-" else 1)
        summands.append((factor, _summand(arm, option, found["name"], found["weights"], task, failures)))
        at = found.end()
    plain = len(summands) == 1 and summands[0][0] == 1
    objective = summands[0][1] if plain else WeightedSum(summands)
    wanted = {"--minimise": "smaller", "--maximise": "larger"}.get(option, objective.better)
    return objective if objective.better == wanted else Opposite(objective)


_SUMMAND = re.compile(
    r"\s*(?P<sign>[+-])?\s*(?:(?P<factor>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*\*\s*)?"
    r"(?P<name>[A-Za-z_]\w*(?:[-.][A-Za-z_]\w*)*)(?:\s*:\s*(?P<weights>[^\s+,]+(?:\s*,\s*[^\s+,]+)*))?\s*"
)


def _summand(arm: Arm, option: str, name: str, weights: str | None, task: str | Task, failures: FailureSpec) -> Objective:
    from holdfast.registry import INDICES, SUSCEPTIBILITIES, unknown

    found: Objective
    if name in SUSCEPTIBILITIES:
        if failures != "single":
            raise InputError(
                f"--failures is for an index, not for {name}; give one joint as {name}:joint2, or leave --failures out"
            )
        given = {} if weights is None else {"weights": _joint_weights(arm, option, name, weights)}
        found = SUSCEPTIBILITIES.make(name, arm, option=option, **given)
    elif INDICES.covers(label := name if weights is None else f"{name}:{weights}"):
        found = INDICES.make(label, arm, option=option, task=task, failures=failures)
    else:
        raise InputError(f"{option}: {unknown('objective', name, SUSCEPTIBILITIES, INDICES)}")
    return found


def _joint_weights(arm: Arm, option: str, name: str, text: str) -> Any:
    """Weights after a colon: one joint by name or as joint2, or what :func:`read_weights` takes."""
    number = text.removeprefix("joint")
    single = text in arm.joint_names or (number != text and number.isdecimal())
    if single:
        return np.eye(arm.n)[read_joint(arm, text if text in arm.joint_names else number)]
    if text in ("effort", "worst-case") or text.lower().endswith(".csv"):
        return read_weights(option, text)
    if not all(is_number(x) for x in text.split(",")):
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
    """``x,y,z,roll,pitch,yaw`` in m and degrees as (4, 4); ``x,y,z`` alone as (3,)."""
    from holdfast.arm.urdf import rpy_rotation

    numbers = read_numbers(option, text, "x,y,z,roll,pitch,yaw (m and degrees)")
    if numbers.size not in (3, 6):
        raise InputError(f"{option} has {numbers.size} numbers; give x,y,z,roll,pitch,yaw (m and degrees), or x,y,z alone")
    if not np.isfinite(numbers).all():
        raise InputError(f"{option} holds NaN or infinity; give finite numbers")
    check_unit_of_places(arm, numbers[:3], option)
    if numbers.size == 3:
        return numbers
    pose = np.eye(4)
    pose[:3, 3] = numbers[:3]
    pose[:3, :3] = rpy_rotation(np.deg2rad(numbers[3:]).tolist())
    return pose


def read_target(arm: Arm, task: Task, text: str) -> NDArray[np.float64]:
    """--target as the library takes it: the task's rows of the tool point, or a pose (4, 4) by angles or by a quaternion."""
    values = read_numbers("--target", text, "numbers")
    if not np.isfinite(values).all():
        raise InputError("--target holds NaN or infinity; give finite numbers")
    if values.size == 6:
        return read_pose(arm, "--target", text)
    if values.size == 7:
        from holdfast.arm.poses import pose_of

        check_unit_of_places(arm, values[:3], "--target")
        if not np.linalg.norm(values[3:]) > 1e-9:
            raise InputError("--target: the last four numbers are a quaternion x,y,z,w and must not all be 0")
        return pose_of(values[:3], values[3:])
    if task.angular or task.frame != "base":
        raise InputError(
            f"--target has {values.size} numbers; task '{task.name}' needs x,y,z,roll,pitch,yaw in m and degrees, or "
            "x,y,z in m and a quaternion x,y,z,w"
        )
    if values.size != task.m:
        raise InputError(f"--target has {values.size} numbers; task '{task.name}' needs {task.m}, in m")
    check_unit_of_places(arm, values @ task.rows[:, :3], "--target")
    return values
