"""Sets of joints that may fail, each alone or several together.

A locked joint keeps the position at which it failed. A free-swinging joint, or a joint with a failed sensor, counts as locked
once its brake has closed.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from holdfast.core.errors import InputError, TaskError
from holdfast.core.labels import FAILURE_SET_SIZES, TASK_SIZES, is_count
from holdfast.core.progress import print_warning

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm

FailureSets = tuple[tuple[int, ...], ...]
FailureSpec = str | int | Iterable[str | int | Iterable[str | int]]
JointSet = str | Sequence[str | int] | None

_MAX_FAILURE_SETS = 5000


def failure_sets(arm: Arm, failures: FailureSpec = "single") -> FailureSets:
    """Return the sets of joints that fail together, as indices from 0.

    Args:
        arm: Arm model.
        failures: ``"single"`` (each joint), ``"pairs"`` (every two joints), an int k (every k joints), or a list of sets, each
            a joint or several joints by name or index from 0.

    Raises:
        TaskError: There is no failure, a set is empty or repeated, or there are too many sets.
        InputError: There is no such joint.
    """
    if isinstance(failures, str):
        failures = FAILURE_SET_SIZES.get(failures, failures)
    if isinstance(failures, str):
        raise TaskError(
            f"failures '{failures}' is not known; use {', '.join(map(repr, FAILURE_SET_SIZES))}, a number of joints, or a "
            f"list of sets"
        )
    if isinstance(failures, (int, np.integer)):
        if not 1 <= failures < arm.n:
            raise TaskError(f"{failures} of the {arm.n} joints of '{arm.name}' cannot fail together; use 1 to {arm.n - 1}")
        sets: Sequence[tuple[int, ...]] = list(combinations(range(arm.n), failures))
    else:
        try:
            sets = [
                arm.joint_indices([failed] if isinstance(failed, (str, int, np.integer)) else failed) for failed in failures
            ]
        except TypeError as error:
            raise TaskError(f"failures are {failures!r}; give a list of sets, each a joint or several joints") from error
    if not sets or any(not s or len(set(s)) != len(s) for s in sets):
        raise TaskError("each failure must name at least one joint, and each of its joints once")
    if len(set(sets)) != len(sets):
        raise TaskError("a set of joints is listed twice among the failures; list each once")
    if len(sets) > _MAX_FAILURE_SETS:
        raise TaskError(f"{len(sets)} failure sets are too many for one kernel; give {_MAX_FAILURE_SETS} or fewer")
    return tuple(sets)


def require_redundant(arm: Arm, rows: int, task: str, sets: FailureSets) -> None:
    """Raise :class:`TaskError` unless every failed arm still has at least as many joints as the task has rows."""
    if arm.n <= rows:
        fewer = [f"{name} ({m})" for name, m in TASK_SIZES.items() if m < min(rows, arm.n)]
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
    """Return names of the ``sets`` (indices from 0) of ``arm`` for users and files: joint names, joined by ``+``."""
    return ["+".join(arm.joint_names[k] for k in s) for s in sets]


def single_joints(arm: Arm, failures: FailureSpec | None) -> list[int]:
    """Return the joints of :func:`failure_sets` (``arm``, ``failures``) for single locks; an empty list for None.

    Raises:
        TaskError: As for :func:`failure_sets`; a set has several joints.
        InputError: There is no such joint.
    """
    sets = () if failures is None else failure_sets(arm, failures)
    for s, name in zip(sets, failure_names(arm, sets), strict=True):
        if len(s) > 1:
            raise TaskError(f"failure '{name}' locks several joints at once; give joints that lock one at a time")
    return [s[0] for s in sets]


def read_joint(arm: Arm, text: str) -> int:
    """Return the index from 0 of the joint of ``arm`` that ``text`` gives by name or number from 1."""
    text = text.strip()
    if text in arm.joint_names:
        k = arm.joint_index(text)
        if is_count(text) and 1 <= int(text) <= arm.n and int(text) != k + 1:
            other = arm.joint_names[int(text) - 1]
            print_warning(f"'{text}' is taken as the name of joint {k + 1}, not as number {text}, which is joint '{other}'")
        return k
    if is_count(text):
        if 1 <= int(text) <= arm.n:
            return int(text) - 1
        raise InputError(f"joint {text} is out of range; '{arm.name}' has joints 1 to {arm.n}")
    return arm.joint_index(text)


def read_joint_set(arm: Arm, joints: JointSet, boards: Mapping[str, Sequence[str | int]] | None = None) -> tuple[int, ...]:
    """Return the sorted indices from 0 of several joints.

    Args:
        arm: Arm model.
        joints: Names and indices from 0, or one text with names and numbers from 1 between commas; None for all joints.
            ``board:NAME`` are all joints of a board.
        boards: Joints of each board, by name or index from 0.

    Raises:
        InputError: There is no such joint or board, or none is given.
    """
    if joints is None:
        return tuple(range(arm.n))
    if isinstance(joints, str):
        texts = [text.strip() for text in joints.replace(";", ",").split(",") if text.strip()]
        joints = [text if _is_board(arm, text) else read_joint(arm, text) for text in texts]
    named: list[str | int] = []
    for part in joints:
        if not _is_board(arm, part):
            named.append(part)
            continue
        board = str(part).removeprefix("board:").strip()
        if boards is None or board not in boards:
            raise InputError(f"board '{board}' is unknown; the boards of the friction are {', '.join(boards or ()) or 'none'}")
        named += boards[board]
    indices = sorted(set(arm.joint_indices(named)))
    if not indices:
        raise InputError(f"no joint of '{arm.name}' is named; name at least one, or leave the joints out for all")
    return tuple(indices)


def _is_board(arm: Arm, name: str | int) -> bool:
    return isinstance(name, str) and name.startswith("board:") and name not in arm.joint_names


def read_failures(arm: Arm, text: str) -> FailureSpec:
    """Return the failures in ``text`` as users write them for ``arm``: ``single``, ``2``, ``joint2; joint1+joint4``."""
    text = text.strip()
    if text in FAILURE_SET_SIZES:
        return text
    # A single number could be a joint or a count; it is the count, as --help states.
    if is_count(text):
        return int(text)
    return [[read_joint(arm, j) for j in part.split("+")] for part in text.split(";") if part.strip()]
