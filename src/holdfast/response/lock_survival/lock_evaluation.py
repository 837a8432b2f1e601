"""Evaluate the single locks that a motion along a path survives."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.solvers.inverse_kinematics import solver
from holdfast.response.lock_survival import tables
from holdfast.response.lock_survival.problem import SurvivalProblem

PATH_TOLERANCE = 1e-3  # largest error of a given configuration on the path, m and rad
MAX_CHANGING_SETS = 8  # sets of fixed joints between which a failed arm may change along the path
_STANDSTILL_TOLERANCE = 1e-9  # largest motion of a joint that does not move, rad and m
_LOCKED_IK_RESTARTS = 30  # restarts of inverse kinematics with a joint locked
_LOCKED_IK_TOLERANCE = 1e-6  # rad, and lengths in units of the arm's length


def find_survived_locks(problem: SurvivalProblem, q: FloatArray) -> BoolArray:
    """Return (T, n) True for the locks of a motion (T, n) that are survived; False where the motion is NaN."""
    if problem.mode == "on-path":
        return find_path_survived_locks(problem, q)
    if problem.redundancy > 1:
        survives = np.isfinite(q).all(axis=1, keepdims=True).repeat(problem.arm.n, axis=1)
        samples, joints = np.nonzero(survives)
        survives[samples, joints] = can_reach_remaining_poses(problem, q[samples], samples + 1, joints)
        return survives
    return np.array(
        [
            tables.are_in_ranges(problem.arm, configuration[None], ranges)[0]
            for configuration, ranges in zip(q, problem.remaining_path_ranges, strict=True)
        ]
    )


def can_reach_remaining_poses(
    problem: SurvivalProblem, q: FloatArray, first_pose: IndexArray, locked_joints: IndexArray
) -> BoolArray:
    """Return (N,) True where inverse kinematics solves all poses from a pose on with one joint locked.

    Args:
        problem: The problem.
        q: (N, n) configurations at the time of the lock, rad and m.
        first_pose: (N,) index of the first pose to be solved.
        locked_joints: (N,) index of the joint that stays at its value in q.
    """
    pose_counts = len(problem.time) - first_pose
    lock_indices = np.repeat(np.arange(len(q)), pose_counts)
    pose_indices = np.concatenate([np.arange(pose, len(problem.time)) for pose in first_pose])
    accept = problem.conditions.are_met if problem.conditions.is_restrictive else None
    lock_values, seed = q[lock_indices, locked_joints[lock_indices]], np.random.SeedSequence(problem.seed)
    is_solved = solver(problem.arm, problem.task).is_reachable_with_lock(
        problem.lock.poses[pose_indices],
        locked_joints[lock_indices],
        lock_values,
        seed,
        _LOCKED_IK_RESTARTS,
        _LOCKED_IK_TOLERANCE,
        accept,
    )
    survived = np.ones(len(q), dtype=bool)
    survived[lock_indices[~is_solved]] = False
    return survived


def find_path_survived_locks(problem: SurvivalProblem, q: FloatArray) -> BoolArray:
    """Return (T, n) True for the locks of a motion (T, n) that are survived without leaving the path.

    With more than one degree of redundancy the failed arm continues with further joints fixed, either the same joints to the
    end or others from pose to pose, or with the tool axis fixed that a cone leaves free. A lock is survived if one of these
    motions leads to the end, or if the given motion no longer moves the joint.
    """
    if problem.redundancy == 1:
        return tables.follow_motion_locks(problem.lock, q)
    survives = has_joint_finished_moving(problem, q)
    for fixed_set in problem.fixed_joint_sets:
        is_undecided = ~survives
        is_undecided[:, list(fixed_set)] = False
        if is_undecided.any():
            fixed = problem.with_fixed_joints(dict.fromkeys(fixed_set, 0.0))
            survives |= tables.follow_motion_locks(fixed.lock, q, is_undecided)
    narrower = problem.with_axis_at(q[0]) if np.isfinite(q[0]).all() else None
    if narrower is not None:
        survives |= find_path_survived_locks(narrower, np.where(is_off_path(narrower, q)[:, None], np.nan, q))
    is_undecided = ~survives & np.isfinite(q).all(axis=1, keepdims=True)
    if is_undecided.any():
        followers = [
            problem.with_fixed_joints(dict.fromkeys(fixed_set, 0.0)).lock
            for fixed_set in problem.fixed_joint_sets[:MAX_CHANGING_SETS]
        ]
        survives |= tables.find_switching_survived_locks(followers, q, is_undecided)
    return survives


def has_joint_finished_moving(problem: SurvivalProblem, q: FloatArray) -> BoolArray:
    """Return (T, n) True where a motion (T, n) exists to its end and no longer moves the joint, and redundancy remains."""
    is_defined = np.isfinite(q).all(axis=1, keepdims=True)
    moves = np.abs(q - q[-1]) > _STANDSTILL_TOLERANCE
    is_lost = (~is_defined | moves | (problem.redundancy == 1))[::-1]
    return np.asarray(~np.logical_or.accumulate(is_lost)[::-1])


def is_off_path(problem: SurvivalProblem, q: FloatArray, poses: FloatArray | None = None) -> BoolArray:
    """Return (N,) True where q (N, n) is undefined, or off its pose by more than 1 mm or 1 mrad.

    Args:
        problem: The problem.
        q: Configurations in rad and m.
        poses: (N, 4, 4) or (1, 4, 4) poses of the tool in the world. Default: the poses of the problem's path.
    """
    poses = np.broadcast_to(problem.lock.poses if poses is None else poses, (len(q), 4, 4))
    position, rotation = solver(problem.arm, problem.task).position_and_rotation_errors(q, poses)
    return ~(np.maximum(position, rotation) <= PATH_TOLERANCE)
