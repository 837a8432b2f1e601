"""Problem of finding the locks that a motion along a path survives, which ``lock_evaluation`` evaluates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Literal

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError, TaskError
from holdfast.core.typing import FloatArray
from holdfast.kinematics.paths.timed_path import TimedPath
from holdfast.kinematics.solvers.self_motions import SelfMotion, make_tracer, trace_self_motions
from holdfast.kinematics.tool_constraints.constraint import ToolConstraint
from holdfast.kinematics.tool_constraints.labels import KeepLike, read_constraints
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task, default_path_task
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance
from holdfast.response.lock_survival import tables
from holdfast.response.lock_survival.conditions import MotionConditions, fix_tool_axis
from holdfast.response.lock_survival.locks import LockedFollower
from holdfast.response.lock_survival.rates import FailureRates, RatesLike

Mode = Literal["on-path", "detour"]
Kind = Literal["exact", "upper bound", "lower bound"]

_IMMOBILE_RANGE = 1e-9  # distance of the limits of a joint that does not move, rad and m
_MAX_FIXED_SETS = 24  # sets of joints that a failed arm may fix
_COARSE_SPACING_RAD = 0.15  # spacing of the nodes of a coarse trial problem
_MIN_COARSE_POSES = 11  # smallest number of poses of a coarse trial problem


@dataclass(frozen=True, eq=False, kw_only=True)
class SurvivalProblem:
    """Arm, path, conditions, and failure rates for which locks are evaluated.

    Attributes:
        arm, task: Arm, and the rows of the path that it keeps.
        path: Pose of the tool as a function of time.
        mode: ``on-path`` or ``detour``.
        rates: Failure rates of the joints.
        time: (T,) samples of the path, s.
        lock: Follower of the poses at these samples with a locked joint.
        conditions: Clearance and tool constraints.
        spacing: Distance of the nodes on self-motion curves, rad.
        seed: Seed of the searches.
        starts: Random starts of inverse kinematics per pose.
        redundancy: Degrees of redundancy, without the joints that cannot move.
        kind: Kind of a survival value: exact, up to the grid; an upper bound, because detours among obstacles or with tool
            constraints are not searched for; or a lower bound, because with more than one degree of redundancy not every motion
            of the failed arm is evaluated.
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

    def with_axis_at(self, q: FloatArray) -> SurvivalProblem | None:
        """Return the problem with the tool axis that a cone leaves free fixed in its direction at q (n,).

        The task has two rows more, so the search is smaller, and every motion of the new problem is also one of this problem.
        None without such a cone, with a path that prescribes rotations, or without remaining redundancy.
        """
        if not self.conditions.left_to_arm or self.redundancy < 3:
            return None
        axis = self.conditions.left_to_arm[0].axis
        fixed_task = fix_tool_axis(self.task, self.path, axis, self.arm.forward_kinematics(q)[:3, :3] @ axis)
        if fixed_task is None:
            return None
        task, path = fixed_task
        conditions = MotionConditions.for_task(self.arm, task, self.conditions.required_clearance, self.conditions.constraints)
        tracer = make_tracer(self.arm, task, self.immobile_joints)
        lock = LockedFollower.on_path(self.arm, tracer, path, self.time, conditions.are_met)
        return replace(self, path=path, task=task, conditions=conditions, lock=lock)

    def with_coarse_grid(self) -> SurvivalProblem:
        """Return the problem on fewer poses and nodes, for quick trials."""
        times = np.linspace(0.0, self.path.duration, max(len(self.time) // 4, _MIN_COARSE_POSES))
        lock = LockedFollower.on_path(self.arm, self.lock.tracer, self.path, times, self.conditions.are_met)
        return replace(self, time=times, lock=lock, spacing=max(self.spacing, _COARSE_SPACING_RAD))

    @cached_property
    def self_motions(self) -> list[SelfMotion]:
        """Self-motion curves of every pose."""
        clearance, margin = self.conditions.required_clearance or (None, 0.0)
        options = {"spacing": self.spacing, "seed": self.seed, "starts": self.starts, "clearance": clearance, "margin": margin}
        traced_curves = trace_self_motions(self.lock.tracer, self.task, self.lock.poses, follow=True, **options)  # type: ignore[arg-type]
        return [self.conditions.restrict_curves(self.lock.tracer, each_pose) for each_pose in traced_curves]

    @cached_property
    def remaining_path_ranges(self) -> list[list[tables.Spans]]:
        """Values of each joint (n,) that its self-motions take at every pose from each pose (T,) on."""
        return tables.compute_remaining_path_ranges(self.self_motions)


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
        InputError: An option is invalid, or an exact constraint is on a row that the path leaves free.
        TaskError: The arm is not redundant; or it has more than one degree of redundancy, and ``detour`` is combined with
            obstacles or constraints.
    """
    if mode not in ("on-path", "detour"):
        raise InputError(f"mode is '{mode}'; use 'on-path' or 'detour'")
    if samples < 3:
        raise InputError(f"samples is {samples}; it must be 3 or more")
    if not np.isfinite(margin):
        raise InputError(f"margin is {margin:g}; it must be a finite number, m")
    task_rows = as_task(arm, default_path_task(arm, path.path.oriented) if task is None else task)
    clearance_model = chosen_clearance(arm, clearance, cell, looks=False)
    if clearance_model is None and margin:
        raise InputError("margin has no effect, because collisions are not checked; give a cell, or a clearance")
    required_clearance = None if clearance_model is None else (clearance_model, margin)
    time = np.linspace(0.0, path.duration, samples)
    constraints = _anchor_constraints(keep, path)
    for constraint in constraints:
        if constraint.direction is not None and not constraint.angle:  # exact: becomes rows of the task where possible
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
            f"'{arm.name}' has {arm.n} joints{immobile_text} and the task '{task_rows.name}' {task_rows.m} rows; without "
            "redundancy almost every lock loses the path, so choose a task with fewer rows"
        )
    if problem.redundancy == 1:
        return problem.with_fixed_joints({}) if problem.immobile_joints else problem
    if mode == "detour" and conditions.is_restrictive:
        raise TaskError(
            f"'{arm.name}' has {problem.redundancy} degrees of redundancy for the task '{task_rows.name}', and detours among "
            "obstacles or with constraints need exactly one; use the mode on-path, or choose a task with more rows"
        )
    return problem


def _anchor_constraints(keep: KeepLike | None, path: TimedPath) -> tuple[ToolConstraint, ...]:
    """Anchor the tool constraints at the first pose of the path."""
    constraints = read_constraints(keep)
    for constraint in constraints:
        if constraint.frame == "tool" and not path.path.oriented:
            raise InputError(f"keep '{constraint}' uses the tool's axes at the start, and the path has only positions")
    return tuple(constraint.anchor(path.pose(0.0)) for constraint in constraints)
