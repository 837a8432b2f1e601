"""Failure modes: which joints may fail, each alone or several together.

A locked joint stays where it was when it failed. A free-swinging joint or a failed sensor that brakes turn into a lock
is a locked joint as well.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from holdfast.errors import InputError, TaskError
from holdfast.grammar import FAILURES, TASKS, is_count
from holdfast.notice import aside

if TYPE_CHECKING:
    from holdfast.arm.model import Arm

FailureSets = tuple[tuple[int, ...], ...]
FailureSpec = str | int | Iterable[str | int | Iterable[str | int]]

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
        k = arm.joint_index(text)
        if is_count(text) and 1 <= int(text) <= arm.n and int(text) != k + 1:
            other = arm.joint_names[int(text) - 1]
            aside(f"'{text}' is taken as the name of joint {k + 1}, not as number {text}, which is joint '{other}'")
        return k
    if is_count(text):
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
    if is_count(text):
        return int(text)
    return [[read_joint(arm, j) for j in part.split("+")] for part in text.split(";") if part.strip()]
