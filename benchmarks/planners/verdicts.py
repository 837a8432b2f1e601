"""Evaluate whether a motion solves a case, in plain NumPy code that shares only the arm and the cell with the planners."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass

import numpy as np
from benchmarks.planners.cases import BenchmarkCase
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray
from holdfast.model.arm.poses import rotation_vectors
from holdfast.model.collision import Clearance

# POSITION_TOLERANCE_M and ORIENTATION_TOLERANCE_RAD: m and rad within which rows count as met
POSITION_TOLERANCE_M = 1e-3
ORIENTATION_TOLERANCE_RAD = np.deg2rad(0.5)
_CHECK_SPACING = 2e-3  # rad and m between configurations looked at
_ROUNDING_TOLERANCE = 1e-9  # of limits and of the start
_LOCK_TOLERANCE = 1e-12  # rad and m by which a lock may move


@dataclass(frozen=True, eq=False)
class BenchmarkMotion:
    """Motion that a planner returns.

    Attributes:
        q: (K, n) waypoints, joints moving in straight lines between them, rad and m.
        first: From which of them on the path is followed.
        share: (K - first,) where on the path each of these is, 0 to 1; empty where a pose is to be reached.
    """

    q: FloatArray
    _: KW_ONLY
    first: int = 0
    share: FloatArray


def find_violation(case: BenchmarkCase, motion: BenchmarkMotion | None, clearance: Clearance | None) -> str:
    """Return in one word why a motion does not solve a case; empty if it does.

    Looked at every 2 mrad or 2 mm of a joint: rows within 1 mm and 0.5 deg (of the goal, or of the path at every instant),
    what is kept all the way, limits, locks and start exact, and clear by the exact sign.

    Raises:
        HoldfastError: The extra ``cell`` is not installed, which the exact sign needs.
    """
    if motion is None or not len(motion.q):
        return "none"
    arm, degraded = case.degraded.arm, case.degraded
    waypoint_indices, q = _interpolate_waypoints(motion.q)
    if np.abs(q[0] - case.at).max() > _ROUNDING_TOLERANCE:
        return "start"
    is_movable = degraded.moves
    if (np.abs(q - case.at)[:, ~is_movable] > _LOCK_TOLERANCE).any():
        return "lock"
    if ((q < degraded.lo - _ROUNDING_TOLERANCE) | (q > degraded.hi + _ROUNDING_TOLERANCE))[:, is_movable].any():
        return "limits"
    poses = arm.forward_kinematics(q)
    if any(constraint.trouble(poses) for constraint in case.keep):
        return "kept"
    if case.goal is not None and not _is_within_tolerance(case, poses[-1:], case.goal[None])[0]:
        return "goal"
    if case.path is not None:
        if (
            motion.share[0] > _ROUNDING_TOLERANCE
            or motion.share[-1] < 1 - _ROUNDING_TOLERANCE
            or (np.diff(motion.share) < 0).any()
        ):
            return "path"
        on_path = waypoint_indices >= motion.first
        target_poses = case.path.pose(
            np.interp(waypoint_indices[on_path] - motion.first, np.arange(len(motion.share)), motion.share)
        )
        if not _is_within_tolerance(case, poses[on_path], target_poses).all():
            return "path"
    if clearance is not None and not clearance.sign(q).all():
        return "contact"
    return ""


def _is_within_tolerance(case: BenchmarkCase, poses: FloatArray, target_poses: FloatArray) -> NDArray[np.bool_]:
    """Return (N,) True where every row of the task is within tolerance."""
    rotations, rows = poses[:, :3, :3], case.rows.rows
    error = np.concatenate(
        [target_poses[:, :3, 3] - poses[:, :3, 3], rotation_vectors(target_poses[:, :3, :3] @ rotations.transpose(0, 2, 1))],
        axis=1,
    )
    if case.rows.frame == "tool":
        error = np.concatenate(
            [np.einsum("nji,nj->ni", rotations, error_part) for error_part in (error[:, :3], error[:, 3:])], axis=1
        )
    tolerance = np.where(np.abs(rows[:, :3]).max(axis=1) > 0, POSITION_TOLERANCE_M, ORIENTATION_TOLERANCE_RAD)
    return np.asarray((np.abs(error @ rows.T) <= tolerance).all(axis=1))


def _interpolate_waypoints(q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return configurations along a motion, and the fractional index of the waypoint at which each of them lies."""
    largest_steps = np.abs(np.diff(q, axis=0)).max(axis=1, initial=0.0)
    parts = [
        np.linspace(index, index + 1, max(int(np.ceil(step / _CHECK_SPACING)), 1), endpoint=False)
        for index, step in enumerate(largest_steps)
    ]
    waypoint_indices = np.concatenate([*parts, [len(q) - 1.0]])
    return waypoint_indices, np.stack([np.interp(waypoint_indices, np.arange(len(q)), column) for column in q.T], axis=1)
