"""Targets of a task as arrays: poses, or the task's rows of the wanted tool point where no row is a turn."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.poses import check_poses
from holdfast.arm.task import Task
from holdfast.errors import InputError

Array = NDArray[np.float64]


def target_poses(task: Task, target: ArrayLike) -> tuple[Array, Array | None]:
    """Targets as poses (M, 4, 4), and as the task's rows (M, m) where they were given so.

    Args:
        task: What must be met.
        target: (m,) or (M, m), m, for tasks without angular rows; for any task (4, 4) or (M, 4, 4) poses in the world.

    Raises:
        InputError: Another shape, poses that are none, or rows for a task with turns.
    """
    given = np.asarray(target, dtype=np.float64)
    if given.ndim in (2, 3) and given.shape[-2:] == (4, 4):
        return check_poses(given), None
    if task.angular or task.frame != "base":
        raise InputError(f"the target has shape {given.shape}; task '{task.name}' needs tool poses, (4, 4) or (N, 4, 4) arrays")
    if given.ndim not in (1, 2) or given.shape[-1] != task.m:
        raise InputError(
            f"the target has shape {given.shape}; task '{task.name}' takes ({task.m},) or (N, {task.m}), the wanted tool "
            "point in m, or tool poses (4, 4)"
        )
    rows = np.atleast_2d(given)
    poses = np.tile(np.eye(4), (len(rows), 1, 1))
    poses[:, :3, 3] = rows @ task.rows[:, :3]
    return poses, rows


def target_pose(task: Task, target: ArrayLike) -> Array:
    """One target, (m,) or (4, 4), as a pose (4, 4); see :func:`target_poses`.

    Raises:
        InputError: More than one target, NaN or infinity, or as :func:`target_poses`.
    """
    poses, rows = target_poses(task, target)
    if np.ndim(target) != (2 if rows is None else 1):
        raise InputError(f"the target has shape {np.shape(target)}; give one target, ({task.m},) or (4, 4)")
    if not np.isfinite(poses).all():
        raise InputError("the target holds NaN or infinity; give finite numbers")
    return np.asarray(poses[0])
