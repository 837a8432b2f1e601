"""Failure modes: which joints may fail, and which are locked.

A locked joint stays where it was when it failed. A free-swinging joint or a failed sensor that brakes turn into a lock
is a locked joint as well.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import real_numbers
from holdfast.errors import InputError, TaskError
from holdfast.grammar import FAILURES, TASKS

if TYPE_CHECKING:
    from holdfast.arm.model import Arm

FailureSets = tuple[tuple[int, ...], ...]
FailureSpec = str | int | Iterable[str | int | Iterable[str | int]]

# {joint: value}, rad or m; {joint: None}, or the joints alone, for where they are. Joints by name or index from 0.
LockedAt = Mapping[str, float] | Mapping[int, float] | Mapping[str | int, float]
LockedValues = Mapping[str, ArrayLike] | Mapping[int, ArrayLike] | Mapping[str | int, ArrayLike]  # (N,) of each joint
LockedAnywhere = str | int | Sequence[str | int] | Mapping[str, None] | Mapping[int, None] | Mapping[str | int, None]
_Mapping = Mapping[str, float | None] | Mapping[int, float | None] | Mapping[str | int, float | None]
Locked = str | int | Sequence[str | int] | _Mapping

_MOST = 5000


def failure_sets(arm: Arm, failures: FailureSpec = "single") -> FailureSets:
    """The sets of joints that fail together, as indices from 0.

    Args:
        arm: The arm.
        failures: ``"single"`` (each joint alone), ``"pairs"`` (every two joints), an int k (every k joints), or a list
            of sets, each a joint or several joints by name or index from 0.

    Raises:
        TaskError: No failure, an empty or repeated set, more sets than can be handled.
        InputError: There is no such joint.
    """
    if isinstance(failures, str):
        failures = FAILURES.get(failures, failures)
    if isinstance(failures, str):
        raise TaskError(
            f"failures '{failures}' is not known; use {', '.join(map(repr, FAILURES))}, a number of joints, or a list of sets"
        )
    if isinstance(failures, (int, np.integer)):
        if not 1 <= failures < arm.n:
            raise TaskError(f"{failures} of the {arm.n} joints of '{arm.name}' cannot fail together; use 1 to {arm.n - 1}")
        sets: Sequence[tuple[int, ...]] = list(combinations(range(arm.n), failures))
    else:
        try:
            sets = [arm.joint_indices([f] if isinstance(f, (str, int, np.integer)) else f) for f in failures]
        except TypeError as error:
            raise TaskError(f"failures are {failures!r}; give a list of sets, each a joint or several joints") from error
    if not sets or any(not s or len(set(s)) != len(s) for s in sets):
        raise TaskError("each failure must name at least one joint, and each of its joints once")
    if len(set(sets)) != len(sets):
        raise TaskError("a set of joints is listed twice among the failures; list each once")
    if len(sets) > _MOST:
        raise TaskError(f"{len(sets)} failure sets are too many for one kernel; give {_MOST} or fewer")
    return tuple(sets)


def require_redundant(arm: Arm, rows: int, task: str, sets: FailureSets) -> None:
    """Raise :class:`TaskError` unless every failed arm still has at least as many joints as the task has rows."""
    if arm.n <= rows:
        fewer = [f"{name} ({m})" for name, m in TASKS.items() if m < min(rows, arm.n)]
        advice = f"choose a task with fewer rows, for example {fewer[0]}" if fewer else "no task of this arm is redundant"
        raise TaskError(
            f"'{arm.name}' is not redundant for task '{task}': {arm.n} joints for {rows} rows, "
            f"so any locked joint ends the task; {advice}"
        )
    most = max(len(s) for s in sets)
    if arm.n - most < rows:
        raise TaskError(
            f"locking {most} of the {arm.n} joints of '{arm.name}' leaves {arm.n - most} for the {rows} rows of '{task}'; "
            f"lock at most {arm.n - rows} joints together or choose a task with fewer rows"
        )


def failure_names(arm: Arm, sets: FailureSets) -> list[str]:
    """Names for people and files: joint names, joined by ``+``."""
    return ["+".join(arm.joint_names[k] for k in s) for s in sets]


def read_locks(arm: Arm, locked: Locked) -> dict[int, float | None]:
    """The locked joints by index, as given, each with its value, rad or m; None: where it is.

    Raises:
        InputError: No such joint, one given twice, or a value that is not a finite number.
    """
    if isinstance(locked, (str, int)) or getattr(locked, "ndim", 1) == 0:
        locked = [locked if isinstance(locked, str) else int(np.asarray(locked))]
    if not isinstance(locked, Iterable):
        raise InputError(f"locked is {locked!r}; it must be a joint, joints, or {{joint: value}}")
    given = list(locked.items()) if isinstance(locked, Mapping) else [(joint, None) for joint in locked]
    found: dict[int, float | None] = {}
    for joint, value in given:
        k = arm.joint_index(joint)
        name, unit = arm.joint_names[k], arm.joints[k].unit
        if k in found:
            raise InputError(f"joint '{name}' is locked twice; give each joint once")
        found[k] = None
        if value is not None:
            number = real_numbers(value, f"the lock of '{name}'", f"a number, {unit}")
            if number.ndim or not np.isfinite(number):
                raise InputError(f"joint '{name}' is locked at {value}; give a finite number, {unit}")
            found[k] = float(number)
    return found


def locks_at(arm: Arm, locked: Locked, at: NDArray[np.float64]) -> dict[int, float]:
    """What :func:`read_locks` reads, in the arm's order, with the values of ``at`` (n,) for joints locked where they are."""
    return {k: float(at[k]) if value is None else value for k, value in sorted(read_locks(arm, locked).items())}


def locks_given(arm: Arm, locked: Locked) -> tuple[tuple[int, ...], NDArray[np.float64]]:
    """The locked joints (k,) in the order given and their values (k,), for what needs a value of each and a joint left.

    Raises:
        InputError: As for :func:`read_locks`; a joint without a value; no joint, or all.
    """
    found = read_locks(arm, locked)
    if not 1 <= len(found) < arm.n:
        raise InputError(f"locked names {len(found)} joints of '{arm.name}'; give 1 to {arm.n - 1}")
    unknown = [repr(arm.joint_names[k]) for k, value in found.items() if value is None]
    if unknown:
        raise InputError(f"locked gives no value for {' and '.join(unknown)}; give {{joint: value}}, rad or m")
    return tuple(found), np.array(list(found.values()), dtype=np.float64)


def single_joints(arm: Arm, failures: FailureSpec | None) -> list[int]:
    """The joints of :func:`failure_sets`, for what locks one at a time; none for None.

    Raises:
        TaskError: As for :func:`failure_sets`; a set of several joints.
        InputError: There is no such joint.
    """
    sets = () if failures is None else failure_sets(arm, failures)
    for s, name in zip(sets, failure_names(arm, sets), strict=True):
        if len(s) > 1:
            raise TaskError(f"failure '{name}' is of several joints at once; give joints that lock one at a time")
    return [s[0] for s in sets]


def read_joint(arm: Arm, text: str) -> int:
    """A joint by name or number from 1, as an index from 0."""
    text = text.strip()
    if text in arm.joint_names:
        return arm.joint_index(text)
    if text.isdecimal():
        if 1 <= int(text) <= arm.n:
            return int(text) - 1
        raise InputError(f"joint {text} is out of range; '{arm.name}' has joints 1 to {arm.n}")
    return arm.joint_index(text)


def read_failures(arm: Arm, text: str) -> FailureSpec:
    """Failures as people write them, as the library takes them: ``single``, ``2``, ``joint2; joint1+joint4``."""
    text = text.strip()
    if text in FAILURES:
        return text
    # A lone number could be a joint or how many: it is how many, as --help says.
    if text.isdecimal():
        return int(text)
    return [[read_joint(arm, j) for j in part.split("+")] for part in text.split(";") if part.strip()]
