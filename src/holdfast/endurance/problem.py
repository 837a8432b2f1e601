"""Problem of the survivable locks of a motion along a path, shared by search, evaluation, and tests."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Literal

import numpy as np

from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, task_of_path
from holdfast.caching import cached_property
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.endurance import tables
from holdfast.endurance.conditions import MotionConditions, compute_task_jacobian, fix_tool_axis
from holdfast.endurance.locks import LockedFollower
from holdfast.endurance.rates import FailureRates, RatesLike
from holdfast.errors import InputError, TaskError
from holdfast.keep.kept import ToolConstraint
from holdfast.keep.labels import KeepLike, read_constraints
from holdfast.paths.timed_path import TimedPath
from holdfast.solvers import joint_space
from holdfast.solvers.inverse_kinematics import solver
from holdfast.solvers.self_motions import SelfMotion, make_tracer, trace_self_motions
from holdfast.typing import BoolArray, FloatArray, IndexArray

Mode = Literal["on-path", "detour"]
Kind = Literal["exact", "upper bound", "lower bound"]

PATH_TOLERANCE = 1e-3  # m and rad that a configuration given may be off the path
_IMMOBILE_RANGE = 1e-9  # rad and m between the limits of a joint that does not move, or in a motion
_MAX_FIXED_SETS = 24  # of joints that a failed arm may hold
MAX_CHANGING_SETS = 8  # of these, between which it may change on its way
# _FIRST_CONFIGURATIONS and _FIRST_POSE_STARTS: configurations of the first pose that are tried, of so many starts
_FIRST_CONFIGURATIONS = 3
_FIRST_POSE_STARTS = 64
_LOCKED_IK_RESTARTS = 30  # of inverse kinematics with a joint locked
_LOCKED_IK_TOLERANCE = 1e-6  # rad, and lengths in units of the arm's own
_RANK_TOLERANCE = 1e-6  # of the largest singular value
# _COARSE_SPACING_RAD and _MIN_COARSE_POSES: rad between nodes, and poses, of what is only tried
_COARSE_SPACING_RAD = 0.15
_MIN_COARSE_POSES = 11


@dataclass(frozen=True, eq=False, kw_only=True)
class SurvivalProblem:
    """Arm, path, conditions, and failure rates for which locks are evaluated.

    Attributes:
        redundancy: Degrees of redundancy, less the joints that cannot move.
        kind: What a verdict on a lock is: exact, up to the grid; an upper bound, of detours among obstacles or with something
            kept, which are not looked for; or a lower bound, where more than one degree of redundancy leaves a failed arm more
            ways than are looked at.
    """

    arm: Arm
    path: TimedPath
    task: Task
    mode: Mode
    rates: FailureRates
    time: FloatArray
    lock: LockedFollower
    conditions: MotionConditions
    spacing: float
    seed: int
    starts: int

    @property
    def kind(self) -> Kind:
        """Kind of a survival value: exact, upper bound, or lower bound."""
        if self.redundancy > 1:
            return "lower bound"
        return "upper bound" if self.mode == "detour" and self.conditions.is_restrictive else "exact"

    @property
    def redundancy(self) -> int:
        """Degrees of redundancy of the joints that can move."""
        return self.arm.n - self.task.m - len(self.immobile_joints)

    @cached_property
    def immobile_joints(self) -> dict[int, float]:
        """Joints that cannot move, and their values."""
        joints = np.flatnonzero(self.arm.upper - self.arm.lower <= _IMMOBILE_RANGE)
        return {int(joint): float(self.arm.lower[joint]) for joint in joints}

    def with_fixed_joints(self, fixed_values: Mapping[int, float]) -> SurvivalProblem:
        """Return the problem for motions along which other joints are fixed too, at values in rad and m."""
        return replace(
            self, lock=replace(self.lock, tracer=make_tracer(self.arm, self.task, {**self.immobile_joints, **fixed_values}))
        )

    @cached_property
    def fixed_joint_sets(self) -> list[tuple[int, ...]]:
        """Sets of joints that can be fixed so that one degree of redundancy remains; a random selection if there are many."""
        mobile = [index for index in range(self.arm.n) if index not in self.immobile_joints]
        all_sets = list(combinations(mobile, self.redundancy - 1))
        order = np.random.default_rng(np.random.SeedSequence(self.seed)).permutation(len(all_sets))
        return [all_sets[index] for index in order[:_MAX_FIXED_SETS]]

    def leaves_one_redundancy(self, q: FloatArray, fixed_joints: Sequence[int]) -> bool:
        """Return True if one degree of redundancy remains at q (n,) if other joints are fixed there.

        More are left where one of them could not move anyway, such as a roll joint that the tool's axis sets.
        """
        mobile = [joint for joint in range(self.arm.n) if joint not in self.immobile_joints and joint not in fixed_joints]
        singular_values = np.linalg.svd(compute_task_jacobian(self.arm, self.task, q[None])[0][:, mobile], compute_uv=False)
        return bool(singular_values[-1] > _RANK_TOLERANCE * singular_values[0])

    def with_fixed_axis(self, axis: FloatArray) -> SurvivalProblem | None:
        """Return the problem with the tool axis that a cone leaves free fixed along ``axis`` (3,), a unit vector in the world.

        Two rows more, so that less is looked at and what is found does more; every motion and every way on is one of this
        problem too. None where there is no such cone, the path prescribes turns, or no redundancy is left.
        """
        cone = next(iter(self.conditions.left_to_arm), None)
        fixed_task = None if cone is None or self.redundancy < 3 else fix_tool_axis(self.task, self.path, cone.axis, axis)
        if fixed_task is None:
            return None
        task, path = fixed_task
        conditions = MotionConditions.for_task(self.arm, task, self.conditions.required_clearance, self.conditions.constraints)
        lock = LockedFollower.on_path(
            self.arm, make_tracer(self.arm, task, self.immobile_joints), path, self.time, conditions.are_met
        )
        return replace(self, path=path, task=task, conditions=conditions, lock=lock)

    def with_axis_at(self, q: FloatArray) -> SurvivalProblem | None:
        """Return the problem of :meth:`with_fixed_axis` with the axis fixed in its direction at q (n,)."""
        if not self.conditions.left_to_arm:
            return None
        axis = self.arm.forward_kinematics(q)[:3, :3] @ self.conditions.left_to_arm[0].axis
        return self.with_fixed_axis(axis)

    def with_coarse_grid(self) -> SurvivalProblem:
        """Return the problem on fewer poses and nodes, for quick trials."""
        times = np.linspace(0.0, self.path.duration, max(len(self.time) // 4, _MIN_COARSE_POSES))
        lock = LockedFollower.on_path(self.arm, self.lock.tracer, self.path, times, self.conditions.are_met)
        return replace(self, time=times, lock=lock, spacing=max(self.spacing, _COARSE_SPACING_RAD))

    def find_first_configurations(self) -> FloatArray:
        """Return a few configurations (K, n) of the first pose, far apart."""
        q = self.lock.tracer.find_seeds(self.lock.poses[:1], np.zeros(1, dtype=np.intp), self.seed, _FIRST_POSE_STARTS)[1]
        q = self.conditions.project_configurations(q, np.broadcast_to(self.lock.poses[0], (len(q), 4, 4)))
        q = q[~self._is_off_poses(q, self.lock.poses[:1]) & self.conditions.are_met(q)]
        chosen = [0] * bool(len(q))
        while 0 < len(chosen) < min(_FIRST_CONFIGURATIONS, len(q)):
            distances = np.min(
                [np.linalg.norm(joint_space.joint_difference(self.arm, q, q[index]), axis=1) for index in chosen], axis=0
            )
            chosen.append(int(distances.argmax()))
        return np.asarray(q[chosen])

    def evaluate_locks(self, q: FloatArray) -> BoolArray:
        """Return (T, n) True for the locks of a motion (T, n) that are survived; False where it is NaN."""
        if self.mode == "on-path":
            return self.follow_locks(q)
        if self.redundancy > 1:
            survives = np.isfinite(q).all(axis=1, keepdims=True).repeat(self.arm.n, axis=1)
            samples, joints = np.nonzero(survives)
            survives[samples, joints] = self.can_regain_path(q[samples], samples + 1, joints)
            return survives
        return np.array(
            [
                tables.are_in_ranges(self.arm, configuration[None], ranges)[0]
                for configuration, ranges in zip(q, self._common_ranges, strict=True)
            ]
        )

    def can_regain_path(self, q: FloatArray, first_pose: IndexArray, locked_joints: IndexArray) -> BoolArray:
        """Return (N,) True where inverse kinematics solves all poses from ``first_pose`` (N,) on with joint (N,) as at q (N,
        n).
        """
        pose_counts = len(self.time) - first_pose
        lock_indices = np.repeat(np.arange(len(q)), pose_counts)
        pose_indices = np.concatenate([np.arange(pose, len(self.time)) for pose in first_pose])
        accept = self.conditions.are_met if self.conditions.is_restrictive else None
        lock_values, seed = q[lock_indices, locked_joints[lock_indices]], np.random.SeedSequence(self.seed)
        is_solved = solver(self.arm, self.task).reaches_locked(
            self.lock.poses[pose_indices],
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

    def follow_locks(self, q: FloatArray) -> BoolArray:
        """Return (T, n) the locks of a motion (T, n) that are survived without leaving the path.

        With more than one degree of redundancy the failed arm goes on with further joints held, the same all the way or others
        from pose to pose, or with the tool's axis held that a cone leaves free; a lock is survived if one such way leads to the
        end, or if the motion itself does not move the joint any more.
        """
        if self.redundancy == 1:
            return tables.follow_motion_locks(self.lock, q)
        survives = self.has_stopped_moving(q)
        for fixed_set in self.fixed_joint_sets:
            is_undecided = ~survives
            is_undecided[:, list(fixed_set)] = False
            if is_undecided.any():
                survives |= tables.follow_motion_locks(
                    self.with_fixed_joints(dict.fromkeys(fixed_set, 0.0)).lock, q, is_undecided
                )
        narrower = self.with_axis_at(q[0]) if np.isfinite(q[0]).all() else None
        if narrower is not None:
            survives |= narrower.follow_locks(np.where(narrower.is_off_path(q)[:, None], np.nan, q))
        is_undecided = ~survives & np.isfinite(q).all(axis=1, keepdims=True)
        if is_undecided.any():
            followers = [
                self.with_fixed_joints(dict.fromkeys(fixed_set, 0.0)).lock
                for fixed_set in self.fixed_joint_sets[:MAX_CHANGING_SETS]
            ]
            survives |= tables.follow_changing_locks(followers, q, is_undecided)
        return survives

    def has_stopped_moving(self, q: FloatArray) -> BoolArray:
        """Return (T, n) True where a motion (T, n) exists to its end and no longer moves the joint, and redundancy remains."""
        is_defined = np.isfinite(q).all(axis=1, keepdims=True)
        moves = np.abs(q - q[-1]) > _IMMOBILE_RANGE
        is_lost = (~is_defined | moves | (self.redundancy == 1))[::-1]
        return np.asarray(~np.logical_or.accumulate(is_lost)[::-1])

    @cached_property
    def self_motions(self) -> list[SelfMotion]:
        """Self-motion curves of every pose."""
        clearance, margin = self.conditions.required_clearance or (None, 0.0)
        options = {"spacing": self.spacing, "seed": self.seed, "starts": self.starts, "clearance": clearance, "margin": margin}
        traced_curves = trace_self_motions(self.lock.tracer, self.task, self.lock.poses, follow=True, **options)  # type: ignore[arg-type]
        return [self.conditions.restrict_curves(self.lock.tracer, each_pose) for each_pose in traced_curves]

    @cached_property
    def _common_ranges(self) -> list[list[tables.Spans]]:
        return tables.compute_common_ranges(self.self_motions)

    def is_off_path(self, q: FloatArray, times: FloatArray | None = None) -> BoolArray:
        """Return (T,) True where a motion (T, n), or q (N, n) at times, is undefined or off the path by more than 1 mm or 1
        mrad.
        """
        return self._is_off_poses(q, self.lock.poses if times is None else self.path.pose(times))

    def _is_off_poses(self, q: FloatArray, poses: FloatArray) -> BoolArray:
        position, rotation = solver(self.arm, self.task).task_errors(q, np.broadcast_to(poses, (len(q), 4, 4)))
        return ~(np.maximum(position, rotation) <= PATH_TOLERANCE)


def make_problem(
    arm: Arm,
    path: TimedPath,
    rates: RatesLike | FailureRates | None,
    per_second: bool,
    mode: Mode,
    task: str | Task | Sequence[str] | None,
    samples: int,
    clearance: Clearance | bool | None,
    cell: CellLike | None,
    margin: float,
    *,
    keep: KeepLike | None,
    spacing: float,
    seed: int,
    starts: int,
) -> SurvivalProblem:
    """Return the problem after a check of its options.

    Raises:
        InputError: Options that do not fit, or a row that is kept exactly and that the path leaves free.
        TaskError: No redundancy, or more than one degree of it and detours among obstacles or with something kept.
    """
    if mode not in ("on-path", "detour"):
        raise InputError(f"mode is '{mode}'; use 'on-path' or 'detour'")
    if samples < 3:
        raise InputError(f"samples is {samples}; it must be 3 or more")
    if not np.isfinite(margin):
        raise InputError(f"margin is {margin:g}; it must be a finite number of metres")
    task_rows = as_task(arm, task_of_path(arm, path.path.oriented) if task is None else task)
    clearance_model = chosen_clearance(arm, clearance, cell, looks=False)
    if clearance_model is None and margin:
        raise InputError("margin has nothing to keep: no clearance is looked at; give a cell, or a clearance")
    required_clearance = None if clearance_model is None else (clearance_model, margin)
    time = np.linspace(0.0, path.duration, samples)
    constraints = _anchor_constraints(keep, path)
    for constraint in constraints:
        if constraint.direction is not None and not constraint.angle:  # kept exactly: rows of the task, where they can be
            task_rows, path = fix_tool_axis(task_rows, path, constraint.axis, constraint.direction) or (task_rows, path)
    conditions = MotionConditions.for_task(arm, task_rows, required_clearance, constraints)
    problem = SurvivalProblem(
        arm=arm,
        path=path,
        task=task_rows,
        mode=mode,
        rates=FailureRates.for_arm(arm, rates, per_second=per_second),
        time=time,
        lock=LockedFollower.on_path(arm, make_tracer(arm, task_rows), path, time, conditions.are_met),
        conditions=conditions,
        spacing=spacing,
        seed=seed,
        starts=starts,
    )
    if problem.redundancy < 1:
        immobile_text = f", {len(problem.immobile_joints)} of which cannot move," if problem.immobile_joints else ""
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints{immobile_text} and the task '{task_rows.name}' {task_rows.m} rows: without "
            f"redundancy almost every "
            "lock loses the path; choose a task with fewer rows"
        )
    if problem.redundancy == 1:
        return problem.with_fixed_joints({}) if problem.immobile_joints else problem
    if mode == "detour" and conditions.is_restrictive:
        raise TaskError(
            f"'{arm.name}' has {problem.redundancy} degrees of redundancy for the task '{task_rows.name}'; detours among "
            f"obstacles or "
            "with something kept are looked at with one: use the mode on-path, or choose a task with more rows"
        )
    return problem


def _anchor_constraints(keep: KeepLike | None, path: TimedPath) -> tuple[ToolConstraint, ...]:
    """Anchor the tool constraints at the first pose of the path."""
    constraints = read_constraints(keep)
    for constraint in constraints:
        if constraint.frame == "tool" and not path.path.oriented:
            raise InputError(f"keep '{constraint}' goes by the tool's axes at the start, and the path has positions only")
    return tuple(constraint.anchor(path.pose(0.0)) for constraint in constraints)
