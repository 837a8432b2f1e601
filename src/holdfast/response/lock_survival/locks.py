"""Pose-following steps of an arm with one locked joint, for many locks at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.paths.timed_path import TimedPath
from holdfast.kinematics.solvers.curve_tracing import ManifoldTracer
from holdfast.model.arm.model import Arm

_MAX_NEWTON_STEPS = 10
_POSE_TOLERANCE = 1e-8  # rad, and lengths in units of the arm's length
_MAX_JOINT_STEP = 0.35  # rad or m of one joint from pose to pose, and in a Newton step; a larger step may change the branch
_ZERO_NULL_ENTRY = 1e-7  # entry of a unit null vector below which a self-motion does not move the joint
_MIN_NULL_COSINE = 0.3  # smallest cosine between the null vectors at the two ends of a step
_SUBSTEPS = 8  # steps that replace one step that seems to leave its branch


@dataclass(frozen=True, eq=False)
class LockedFollower:
    """Follower of a path with one locked joint per row; with one degree of redundancy no freedom is left.

    A Newton step of the locked arm is the least-norm step of the whole arm, shifted along the null vector until the locked
    joint does not move, so that one kernel serves every lock. A branch ends where the Jacobian without the locked column is
    singular. Its determinant equals the locked joint's entry of the null vector except for a positive factor (Cramer's rule),
    so this entry changes its sign there and nowhere else.

    Attributes:
        arm: The arm.
        tracer: Tracer of the arm and task.
        poses: (T, 4, 4) poses of the path.
        intermediate_poses: (T - 1, K, 4, 4) evenly spaced poses after each pose, up to and including the next one.
        conditions_met: Function that returns True for configurations (N, n) that meet the other conditions.
    """

    arm: Arm
    tracer: ManifoldTracer
    poses: FloatArray
    intermediate_poses: FloatArray
    conditions_met: Callable[[FloatArray], BoolArray]

    @classmethod
    def on_path(
        cls,
        arm: Arm,
        tracer: ManifoldTracer,
        path: TimedPath,
        times: FloatArray,
        conditions_met: Callable[[FloatArray], BoolArray],
    ) -> LockedFollower:
        """Return the follower of a path at times (T,), s."""
        fractions = np.arange(1, _SUBSTEPS + 1) / _SUBSTEPS
        fine_times = times[:-1, None] + fractions * np.diff(times)[:, None]
        return cls(
            arm, tracer, path.pose(times), path.pose(fine_times.ravel()).reshape(*fine_times.shape, 4, 4), conditions_met
        )

    def step(self, q: FloatArray, locked_joints: IndexArray, pose_index: int | IndexArray) -> tuple[FloatArray, BoolArray]:
        """Step from q (N, n) on pose t, one or (N,), with joint (N,) locked, to the next pose; return the result and success.

        The step fails if the branch ends on the way, or leaves the joint limits or another condition.
        """
        targets = np.broadcast_to(self.poses[np.asarray(pose_index) + 1], (len(q), 4, 4))
        return self._step_with_retries(
            q,
            locked_joints,
            np.broadcast_to(pose_index, len(q)),
            targets,
            self.tracer.newton_step_and_error(q, *_positions_and_rotations(targets)),
        )

    def solve_poses(self, q: FloatArray, locked_joints: IndexArray, poses: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Solve poses (N, 4, 4) near configurations (N, n) without moving joint (N,); return the result and its success."""
        residuals = self.tracer.newton_step_and_error(q, *_positions_and_rotations(poses))
        return self._solve_newton(q, locked_joints, poses, residuals)

    def step_with_each_lock(self, q: FloatArray, pose_indices: IndexArray) -> tuple[FloatArray, BoolArray]:
        """Step with every joint locked from every q (N, n) on pose t (N,): (N, n, n), that joint second, and success (N, n)."""
        n = self.arm.n
        next_poses = self.poses[pose_indices + 1]
        evaluation = self.tracer.newton_step_and_error(q, *_positions_and_rotations(next_poses))
        repeated_q, targets, steps_back, errors, null_vectors = (
            np.repeat(values, n, axis=0) for values in (q, next_poses, *evaluation)
        )
        locked_joints = np.tile(np.arange(n), len(q))
        next_q, has_arrived = self._step_with_retries(
            repeated_q, locked_joints, np.repeat(pose_indices, n), targets, (steps_back, errors, null_vectors)
        )
        return next_q.reshape(len(q), n, n), has_arrived.reshape(len(q), n)

    def _step_with_retries(
        self,
        q: FloatArray,
        locked_joints: IndexArray,
        pose_indices: IndexArray,
        targets: FloatArray,
        evaluation: tuple[FloatArray, FloatArray, FloatArray],
    ) -> tuple[FloatArray, BoolArray]:
        """Take the step at once, and in smaller steps if it seems to leave the branch."""
        next_q, has_arrived = self._solve_newton(q, locked_joints, targets, evaluation)
        retried = np.flatnonzero(~has_arrived & (np.abs(evaluation[2][np.arange(len(q)), locked_joints]) > _ZERO_NULL_ENTRY))
        current_q = q[retried]
        for substep in range(_SUBSTEPS):
            if not retried.size:
                break
            substep_poses = self.intermediate_poses[pose_indices[retried], substep]
            current_q, is_on_pose = self._solve_newton(
                current_q,
                locked_joints[retried],
                substep_poses,
                self.tracer.newton_step_and_error(current_q, *_positions_and_rotations(substep_poses)),
            )
            retried, current_q = retried[is_on_pose], current_q[is_on_pose]
        next_q[retried], has_arrived[retried] = current_q, True
        has_arrived &= ((next_q >= self.arm.lower) & (next_q <= self.arm.upper)).all(axis=1)
        has_arrived[has_arrived] = self.conditions_met(next_q[has_arrived])
        return next_q, has_arrived

    def _solve_newton(
        self,
        q: FloatArray,
        locked_joints: IndexArray,
        targets: FloatArray,
        evaluation: tuple[FloatArray, FloatArray, FloatArray],
    ) -> tuple[FloatArray, BoolArray]:
        """Continue Newton's method from its first evaluation; return the result and whether it stayed on the branch."""
        steps_back, errors, null_vectors = evaluation
        next_q, final_null_vectors = q.copy(), null_vectors.copy()
        is_on_pose = errors <= _POSE_TOLERANCE
        active = np.flatnonzero(~is_on_pose)
        steps_back, current_null = steps_back[active], null_vectors[active]
        for _ in range(_MAX_NEWTON_STEPS):
            if not active.size:
                break
            rows, active_joints = np.arange(active.size), locked_joints[active]
            entry = current_null[rows, active_joints]
            change = (
                steps_back
                - (steps_back[rows, active_joints] * entry / (entry**2 + _ZERO_NULL_ENTRY**2))[:, None] * current_null
            )
            change[rows, active_joints] = 0.0
            change *= (_MAX_JOINT_STEP / np.maximum(np.abs(change).max(axis=1), _MAX_JOINT_STEP))[:, None]
            next_q[active] += change
            steps_back, errors, current_null = self.tracer.newton_step_and_error(
                next_q[active], *_positions_and_rotations(targets[active])
            )
            has_converged = errors <= _POSE_TOLERANCE
            is_on_pose[active[has_converged]] = True
            final_null_vectors[active[has_converged]] = current_null[has_converged]
            # A row that has diverged is on another branch and is not evaluated again.
            is_active = ~has_converged & (np.abs(next_q[active] - q[active]).max(axis=1) <= 3 * _MAX_JOINT_STEP)
            active, steps_back, current_null = active[is_active], steps_back[is_active], current_null[is_active]
        rows = np.arange(len(q))
        cosines = np.einsum("ij,ij->i", null_vectors, final_null_vectors)
        first_entries, last_entries = null_vectors[rows, locked_joints], final_null_vectors[rows, locked_joints]
        same_branch = (first_entries * last_entries * cosines > 0) & (np.abs(cosines) >= _MIN_NULL_COSINE)
        # The self-motion never moves this joint.
        is_unaffected = (np.abs(first_entries) <= _ZERO_NULL_ENTRY) & (np.abs(last_entries) <= _ZERO_NULL_ENTRY)
        return next_q, np.asarray(
            is_on_pose & (same_branch | is_unaffected) & (np.abs(next_q - q).max(axis=1) <= _MAX_JOINT_STEP)
        )


def _positions_and_rotations(poses: FloatArray) -> tuple[FloatArray, FloatArray]:
    return np.ascontiguousarray(poses[:, :3, 3]), np.ascontiguousarray(poses[:, :3, :3])
