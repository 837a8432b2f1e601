"""Conditions of an arm on its path in addition to the task rows: clearance from its surroundings, and tool constraints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.status import Status
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.paths.timed_path import TimedPath
from holdfast.kinematics.solvers.clear_parts import CurveConstraint
from holdfast.kinematics.solvers.curve_tracing import ManifoldTracer
from holdfast.kinematics.solvers.self_motions import SelfMotion
from holdfast.kinematics.tool_constraints.constraint import ToolConstraint
from holdfast.kinematics.tool_constraints.manifold import ConstraintManifold
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import rotation_vectors
from holdfast.model.arm.task import Task
from holdfast.model.collision.clearance import Clearance

_SAMPLED_CONFIGURATIONS = 8  # random configurations at which the effect of self-motion on a constraint is tested
_UNCHANGED_TOLERANCE = 1e-9  # m and rad per rad
_STANDSTILL_TOLERANCE = 1e-9  # m and rad


@dataclass(frozen=True, eq=False, kw_only=True)
class MotionConditions:
    """Conditions on every configuration of a motion.

    Attributes:
        arm, task: Arm, and the rows that the path sets.
        required_clearance: Collision model and margin, m. None: collisions are not checked.
        constraints: Tool constraints, anchored at the first pose of the path.
        set_by_path: Parts of the constraints that the rows of the path alone decide.
        left_to_arm: Remaining parts, which the path leaves to the arm: cones that self-motion can leave.
    """

    arm: Arm
    task: Task
    required_clearance: tuple[Clearance, float] | None
    constraints: tuple[ToolConstraint, ...]
    set_by_path: tuple[ToolConstraint, ...]
    left_to_arm: tuple[ToolConstraint, ...]

    @classmethod
    def for_task(
        cls, arm: Arm, task: Task, required_clearance: tuple[Clearance, float] | None, constraints: Sequence[ToolConstraint]
    ) -> MotionConditions:
        """Return the conditions of an arm on a path whose rows are those of the task.

        Raises:
            InputError: An exact constraint is on a row that the path leaves free.
        """
        parts = [part for constraint in constraints for part in _split_constraint(constraint)]
        set_by_path = tuple(part for part in parts if _is_decided_by_path(arm, task, part))
        left_to_arm = tuple(part for part in parts if part not in set_by_path)
        exact_part = next((part for part in left_to_arm if len(part.normals) or part.turned or not part.angle), None)
        if exact_part is not None:
            raise InputError(
                f"the task '{task.name}' leaves an exact constraint free ({exact_part}); prescribe it by the path and a "
                "task with more rows, such as pointing or pose"
                + (", or give an angle" if exact_part.direction is not None else "")
            )
        return cls(
            arm=arm,
            task=task,
            required_clearance=required_clearance,
            constraints=tuple(constraints),
            set_by_path=set_by_path,
            left_to_arm=left_to_arm,
        )

    @property
    def is_restrictive(self) -> bool:
        """True if there is any condition."""
        return self.required_clearance is not None or bool(self.constraints)

    @cached_property
    def manifold(self) -> ConstraintManifold | None:
        """Manifold of the constraints that the path leaves to the arm; None if there are none."""
        if not self.left_to_arm:
            return None
        return ConstraintManifold(self.arm, self.left_to_arm, self.arm.upper > self.arm.lower, sampling_limits(self.arm))

    def are_met(self, q: FloatArray, slack: float = 0.0) -> BoolArray:
        """Return (N,) True where configurations (N, n) on the path meet the conditions, with a slack of the clearance in m."""
        is_met = np.ones(len(q), dtype=bool)
        if self.required_clearance is not None:
            is_met &= self.required_clearance[0].margin_left(q) >= self.required_clearance[1] - slack
        if self.manifold is not None:
            is_met[is_met] = self.manifold.is_satisfied(q[is_met])
        return is_met

    def find_violation(self, q: FloatArray) -> tuple[int, str] | None:
        """Return the first of configurations (N, n) that violates a constraint, and the violation as a phrase."""
        return _find_first_violation(self.constraints, self.arm.forward_kinematics(q))

    def are_constraints_met(self, q: FloatArray) -> BoolArray:
        """Return (N,) True where configurations (N, n) meet the tool constraints."""
        poses = self.arm.forward_kinematics(q)
        return np.array(
            [not any(constraint.trouble(pose[None]) for constraint in self.constraints) for pose in poses], dtype=bool
        )

    def find_path_violation(self, q: FloatArray) -> tuple[int, str] | None:
        """Return the first violation of the constraints that the path alone decides, for any configurations (T, n) on it."""
        return _find_first_violation(self.set_by_path, self.arm.forward_kinematics(q))

    def explain_infeasible(self, self_motion: SelfMotion) -> str:
        """Explain in a sentence why a pose has no configuration."""
        if self.manifold is None or self_motion.status != Status.INFEASIBLE:
            return self_motion.summary
        clearance_text = "" if self.required_clearance is None else "collision-free "
        return f"no {clearance_text}configuration that was found meets the constraint: {'; '.join(map(str, self.left_to_arm))}"

    def restrict_curves(self, tracer: ManifoldTracer, self_motion: SelfMotion) -> SelfMotion:
        """Restrict the curves of configurations to the parts that meet the constraints left to the arm."""
        if self.manifold is None:
            return self_motion
        names = [constraint.name for constraint in self.left_to_arm]
        feasible_intervals = CurveConstraint(
            self.manifold.constraint_margins, self.manifold.bound_changes(np.eye(self.arm.n)).T, names
        )
        parts = tuple(
            part
            for component in self_motion.components
            for part in feasible_intervals.find_feasible_parts(tracer, self_motion.pose, component)
        )
        q = np.concatenate([component.q for component in parts]) if parts else self_motion.q[:0]
        return replace(self_motion, components=parts, q=q, status=self_motion.status if parts else Status.INFEASIBLE)

    def project_configurations(self, q: FloatArray, poses: FloatArray) -> FloatArray:
        """Project q (N, n) towards the constraints left to the arm and the rows of poses (N, 4, 4); some may not converge."""
        if self.manifold is None:
            return q

        def evaluate_path_rows(trial: FloatArray, pose_indices: IndexArray) -> tuple[FloatArray, FloatArray]:
            current_poses = self.arm.forward_kinematics(trial)
            jacobian = self.arm.jacobian(trial)
            target_poses = poses[pose_indices]
            orientation_errors = rotation_vectors(target_poses[:, :3, :3] @ current_poses[:, :3, :3].transpose(0, 2, 1))
            error = np.concatenate([target_poses[:, :3, 3] - current_poses[:, :3, 3], orientation_errors], axis=1)
            rows = _world_task_rows(self.task, current_poses)
            return np.einsum("nmk,nk->nm", rows, error), rows @ jacobian

        return self.manifold.project(q, evaluate_path_rows)


def _find_first_violation(constraints: Sequence[ToolConstraint], poses: FloatArray) -> tuple[int, str] | None:
    for index, pose in enumerate(poses if constraints else []):
        violations = [violation for constraint in constraints if (violation := constraint.trouble(pose[None]))]
        if violations:
            return index, " and ".join(violations)
    return None


def _split_constraint(constraint: ToolConstraint) -> list[ToolConstraint]:
    """Split a tool constraint into its position and its orientation."""
    parts = []
    if len(constraint.normals):
        parts.append(replace(constraint, direction=None, turned=False))
    if constraint.turned or constraint.direction is not None:
        parts.append(replace(constraint, normals=constraint.normals[:0]))
    return parts


def _is_decided_by_path(arm: Arm, task: Task, constraint: ToolConstraint) -> bool:
    """Return True if no motion that meets the task rows changes the constraint, so that the path alone decides it."""
    lower, upper = sampling_limits(arm)
    q = np.random.default_rng(np.random.SeedSequence(0)).uniform(lower, upper, (_SAMPLED_CONFIGURATIONS, arm.n))
    poses, jacobian = arm.forward_kinematics(q), arm.jacobian(q) * (arm.upper > arm.lower)
    null_space = np.linalg.svd(_world_task_rows(task, poses) @ jacobian)[2][:, task.m :]
    change = jacobian @ null_space.transpose(0, 2, 1)
    if len(constraint.normals):
        return bool(np.abs(constraint.normals @ change[:, :3]).max(initial=0.0) <= _UNCHANGED_TOLERANCE)
    rotations = change[:, 3:]
    if not constraint.turned:
        axis = (poses[:, :3, :3] @ constraint.axis)[:, :, None]
        rotations = rotations - axis * (axis * rotations).sum(axis=1, keepdims=True)
    return bool(np.abs(rotations).max(initial=0.0) <= _UNCHANGED_TOLERANCE)


def _world_task_rows(task: Task, poses: FloatArray) -> FloatArray:
    """Return the rows (N, m, 6) of a task for twists in the world, with the tool at poses (N, 4, 4)."""
    rows = np.broadcast_to(task.rows, (len(poses), *task.rows.shape))
    if task.frame == "base":
        return rows
    inverse_rotations = poses[:, :3, :3].transpose(0, 2, 1)
    return np.concatenate([rows[..., :3] @ inverse_rotations, rows[..., 3:] @ inverse_rotations], axis=2)


def compute_task_jacobian(arm: Arm, task: Task, q: FloatArray) -> FloatArray:
    """Return the Jacobian (N, m, n) of the rows of a task, m and rad, at q (N, n)."""
    return np.asarray(_world_task_rows(task, arm.forward_kinematics(q)) @ arm.jacobian(q))


def fix_tool_axis(task: Task, path: TimedPath, axis: FloatArray, direction: FloatArray) -> tuple[Task, TimedPath] | None:
    """Return the task and path with an axis (3,) of the tool fixed along a direction (3,) in the world, unit vectors.

    None where the task prescribes other rows than the position, or the path waits or rotates in place.
    """
    legs = path.path
    is_stationary = np.linalg.norm(legs.shift, axis=1) + np.linalg.norm(legs.sweep, axis=1) <= _STANDSTILL_TOLERANCE
    if task.angular or task.m < 3 or is_stationary.any():
        return None
    normals = np.linalg.svd(axis[None])[2][1:]
    rows = np.block([[np.eye(3), np.zeros((3, 3))], [np.zeros((2, 3)), normals]])
    starts = legs.starts.copy()
    starts[:, :3, :3] = _complete_axes(direction) @ _complete_axes(axis).T
    oriented_path = replace(path, path=replace(legs, starts=starts, turn=0 * legs.turn, oriented=True))
    return Task(f"{task.name} with the axis held", rows, "tool", length=task.length), oriented_path


def _complete_axes(first: FloatArray) -> FloatArray:
    """Return right-handed axes (3, 3), in columns, from the first one."""
    second = np.linalg.svd(first[None])[2][1]
    return np.column_stack([first, second, np.cross(first, second)])
