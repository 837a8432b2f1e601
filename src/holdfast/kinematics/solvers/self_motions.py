"""All configurations of a pose: the self-motion manifold, traced if it consists of curves, sampled in higher dimension.

Source: Goel, Maciejewski, Balakrishnan 2005, section on self-motion manifolds: follow the null vector of the Jacobian
(predictor) and return to the pose with Newton steps (corrector), from configurations that inverse kinematics found.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError, TaskError
from holdfast.core.files.output import write_table
from holdfast.core.progress import reports_progress, track
from holdfast.core.result import Result
from holdfast.core.status import Status
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.clear_parts import CurveConstraint
from holdfast.kinematics.solvers.curve_tracing import Component, ManifoldTracer
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import check_poses
from holdfast.model.arm.task import Task, as_task, target_pose
from holdfast.model.cell.cell import Cell
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance

TRACING_STARTS = 128


@dataclass(frozen=True, eq=False, kw_only=True)
class SelfMotion(Result):
    """Configurations found for one pose.

    Attributes:
        arm: Arm model.
        pose: (4, 4) pose in the world, m.
        task: Rows of the pose that are met.
        redundancy: Dimension of the manifold, n - m.
        components: Curves of the manifold, for redundancy 1; empty otherwise.
        q: (N, n) all points, rad and m: those of all components one after the other, or the sample.
        spacing: Distance of the points, rad (and m).
        status: ``OK``, ``NOT_FOUND`` (no configuration was found, which is no proof), ``INFEASIBLE`` (no configuration found is
            collision-free) or ``BAD_INPUT``.
        clearance: Collision model of the arm and its cell, or None.
        margin: Smallest clearance, m.
        bounds: Values at which each joint may lock without losing the pose, rad or m, as ``(low, high)`` pairs, if they were
            computed by :func:`holdfast.joint_bounds`.
    """

    arm: Arm
    pose: FloatArray
    task: Task
    redundancy: int
    components: tuple[Component, ...]
    q: FloatArray
    spacing: float
    status: Status
    clearance: Clearance | None = None
    margin: float = 0.0
    bounds: Sequence[Sequence[tuple[float, float]]] | None = None

    @property
    def cell(self) -> Cell | None:
        """Environment of the arm."""
        return None if self.clearance is None else self.clearance.cell

    @property
    def summary(self) -> str:
        """Phrase with the number of curves and their lengths, or the reason why there is none."""
        if self.status == Status.INFEASIBLE and self.clearance is not None:
            return f"at every configuration found the arm {self.clearance.too_close(self.margin)}"
        if self.status != Status.OK:
            return self.status.sentence
        if self.redundancy > 1:
            return f"{len(self.q)} configurations of a manifold of dimension {self.redundancy}, {self.spacing:.3g} rad apart"
        closed = sum(curve.closed for curve in self.components)
        lengths = ", ".join(f"{curve.length:.3g}" for curve in self.components)
        plural = "s" if len(self.components) != 1 else ""
        return f"{len(self.components)} curve{plural} of configurations, {closed} closed, lengths {lengths} rad"

    @property
    def size(self) -> float:
        """Largest sum, over the revolute joints, of the measure of the angles that each takes on one curve; 0 without curves.

        For n revolute joints it is at most 2 pi n. At this value the pose stays within reach for any locked joint and angle,
        and all these configurations lie on one curve.

        Raises:
            TaskError: The manifold is sampled and does not consist of curves.

        Source: Almarkhi, Maciejewski 2020 (abstract); the measure by winding numbers is derived here.
        """
        if self.redundancy > 1:
            raise TaskError(f"with a redundancy of {self.redundancy} self-motions are no curves, and their size is not defined")
        turning = ~self.arm.prismatic
        curve_sizes = [np.minimum(curve.ranges[turning], 2 * np.pi).sum() for curve in self.components]
        return float(max(curve_sizes, default=0.0))

    @property
    def full(self) -> bool:
        """True if every revolute joint takes every angle on one curve."""
        return bool(self.size >= 2 * np.pi * np.count_nonzero(~self.arm.prismatic) * (1 - 1e-12))

    def ends(self, k: int) -> str:
        """Return a phrase on the ends of curve number ``k``, from 0."""
        curve = self.components[k]
        if curve.closed:
            return "closed"
        names = self.arm.joint_names
        limits = ["singular configuration" if joint is None else f"limit of {names[joint]}" for joint in curve.bounded_by]
        return " to ".join(pair or limit for pair, limit in zip(curve.barred_by, limits, strict=True))

    def arcs(self) -> list[list[tuple[float, float]]]:
        """Return the values of each joint on the curves, as ``(low, high)`` pairs, rad or m, at which it may lock.

        Curves that no start found are missing. For joints without limits intervals begin within -pi to pi.

        Raises:
            InputError: The manifold is sampled and does not consist of curves.
        """
        if self.redundancy > 1:
            raise InputError(
                f"with a redundancy of {self.redundancy} configurations are samples, which do not say where a joint may lock; "
                "leave the clearance and the cell out"
            )
        turning = joint_space.is_unlimited(self.arm)
        return [
            _join_intervals(
                [(float(curve.q[:, joint].min()), float(curve.q[:, joint].max())) for curve in self.components],
                bool(turning[joint]),
            )
            for joint in range(self.arm.n)
        ]

    def to_csv(self, file: str | Path, degrees: bool = False) -> Path:
        """Write all points as rows to the CSV ``file``, with the number of their curve; revolute joints in rad or ``degrees``.

        Raises:
            StoreError: The file cannot be written.
        """
        turning = degrees & ~self.arm.prismatic
        units = ["deg" if is_angle else joint.unit for is_angle, joint in zip(turning, self.arm.joints, strict=True)]
        sizes = [len(component.q) for component in self.components] or [len(self.q)]
        curve = np.repeat(np.arange(1, len(sizes) + 1), sizes)
        rows = np.column_stack([curve, np.where(turning, np.rad2deg(self.q), self.q)])
        header = ["curve", *(f"{name}_{unit}" for name, unit in zip(self.arm.joint_names, units, strict=True))]
        return write_table(file, "points", header, rows, ["%d", *["%.12g"] * self.arm.n])


@check_arguments
def self_motion(
    arm: Arm,
    target: ArrayLike,
    task: str | Task | Sequence[str] = "pose",
    *,
    spacing: float = 0.05,
    seed: int = 0,
    starts: int = TRACING_STARTS,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    margin: float = 0.0,
) -> SelfMotion:
    """Find all configurations of a target within the joint limits.

    :func:`holdfast.kinematics.solvers.fibres` takes many poses.

    Args:
        arm: Arm model.
        target: (m,) rows of the target tool point, m, for tasks without angular rows; or, for any task, a (4, 4) tool pose in
            the world.
        task: Rows of the pose that must be met.
        spacing: Distance of neighbouring points in joint space, rad; see :func:`holdfast.kinematics.solvers.fibres`.
        seed: Seed of the starts.
        starts: Number of random starts of inverse kinematics; more starts find shorter curves.
        clearance: Collision model; default: not checked. See :func:`holdfast.kinematics.solvers.fibres`.
        cell: Environment, or its file.
        margin: Smallest clearance, m, in addition to the distances that the cell requires.

    Raises:
        InputError: The target has another shape or NaN, an option is out of range, or the cell cannot be read or does not fit.
        TaskError: The arm has no redundancy for the task.

    Source: Goel et al. 2005.
    """
    resolved_task = as_task(arm, task)
    options: dict[str, Any] = {"clearance": clearance, "cell": cell, "margin": margin}
    pose = target_pose(resolved_task, target)
    return fibres(arm, pose, resolved_task, spacing=spacing, seed=seed, starts=starts, **options)[0]


def fibres(
    arm: Arm,
    poses: ArrayLike,
    task: str | Task | Sequence[str] = "pose",
    *,
    spacing: float = 0.05,
    seed: int = 0,
    starts: int = TRACING_STARTS,
    follow: bool = False,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    margin: float = 0.0,
) -> list[SelfMotion]:
    """Find the self-motion manifold of each pose, within the joint limits.

    With one degree of redundancy every curve on which a start of inverse kinematics converges is traced in both directions,
    until it closes or a joint reaches its limit. A curve to which no start converges is missed; more starts find shorter
    curves. With more redundancy the manifold is sampled: neighbours of known points are added until no configuration is farther
    than about the spacing from the points (or until there are 4000).

    Args:
        arm: Arm model.
        poses: (4, 4) or (N, 4, 4) poses in the world, m; only the rows of the task must be met.
        task: Rows of the pose that must be met.
        spacing: Distance of neighbouring points in joint space, rad (a prismatic joint counts 1 m as 1 rad). Steps are shorter
            where the curve bends.
        seed: Seed of the starts; start k of pose i does not depend on the number of following poses.
        starts: Number of random starts of inverse kinematics per pose.
        follow: The poses follow each other along a path, so each curve of a pose is also searched at the previous and the next
            pose. Only with one degree of redundancy.
        clearance: Collision model; default: not checked. True: capsules with an assumed radius. Curves are cut where less than
            the margin remains, and the remaining parts are proved collision-free also between their points.
        cell: Environment, or its file. The links are then kept apart as well, except for a planar arm and with
            ``clearance=False``.
        margin: Smallest clearance, m, in addition to the distances that the cell requires.

    Returns:
        One :class:`SelfMotion` per pose; every point meets its pose to 1e-9 rad, and m for an arm of 1 m.

    Raises:
        InputError: Poses are not 4x4 transforms, an option is out of range, or the cell cannot be read or does not fit.
        TaskError: The arm has no redundancy for the task.

    Source: Goel et al. 2005.
    """
    targets = check_poses(poses)
    resolved_task = as_task(arm, task)
    if arm.n <= resolved_task.m:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task '{resolved_task.name}' {resolved_task.m} rows: without redundancy a "
            "pose has no self-motion; choose a task with fewer rows"
        )
    if not np.isfinite(margin):
        raise InputError(f"margin is {margin:g}; it must be a finite number of metres")
    resolved_clearance = chosen_clearance(arm, clearance, cell, looks=False)
    engine = make_tracer(arm, resolved_task)
    options = {"spacing": spacing, "seed": seed, "starts": starts, "follow": follow, "clearance": resolved_clearance}
    return trace_self_motions(engine, resolved_task, targets, **options, margin=margin)  # type: ignore[arg-type]


@reports_progress("tracing self-motions")
def trace_self_motions(
    engine: ManifoldTracer,
    task: Task,
    targets: FloatArray,
    *,
    spacing: float,
    seed: int,
    starts: int,
    follow: bool,
    clearance: Clearance | None,
    margin: float,
) -> list[SelfMotion]:
    """Trace as :func:`fibres` does, with arguments that are already checked; fixed joints of the tracer stay fixed."""
    if not (np.isfinite(spacing) and 0 < spacing <= 0.5):
        raise InputError(f"spacing is {spacing:g}; it must be above 0 and at most 0.5 rad")
    if starts < 1:
        raise InputError(f"starts is {starts}; it must be 1 or more")
    arm = engine.arm
    constraint = None if clearance is None or not clearance.pair_names else CurveConstraint.from_clearance(clearance, margin)
    finite: BoolArray = np.asarray(np.isfinite(targets).all(axis=(1, 2)))
    owner, q = engine.find_seeds(targets, np.flatnonzero(finite), seed, starts)
    components: list[list[Component]] = [[] for _ in targets]
    if engine.dimension == 1:
        engine.trace_curves(targets, owner, q, spacing, components)
        if follow:
            engine.propagate_curves_between_poses(targets, spacing, components)
        was_found = [bool(pose_curves) for pose_curves in components]
        if constraint is not None:
            components = [
                [part for curve in pose_curves for part in constraint.find_feasible_parts(engine, target, curve)]
                for target, pose_curves in zip(targets, components, strict=True)
            ]
        points = [np.concatenate([curve.q for curve in curves]) if curves else np.empty((0, arm.n)) for curves in components]
    else:
        points = [
            engine.sample_manifold(target, q[owner == index], spacing)
            for index, target in enumerate(track("poses", targets, whole=True))
        ]
        was_found = [bool(len(pose_points)) for pose_points in points]
        points = points if constraint is None else [pose_points[constraint.is_satisfied(pose_points)] for pose_points in points]
    status = np.where([len(pose_points) > 0 for pose_points in points], Status.OK, Status.INFEASIBLE)
    status[~np.array(was_found, dtype=bool)] = Status.NOT_FOUND
    status[~finite] = Status.BAD_INPUT
    common = {"arm": arm, "task": task, "redundancy": engine.dimension, "spacing": spacing}
    common |= {"clearance": clearance, "margin": margin}
    return [
        SelfMotion(pose=target, components=tuple(curve), q=pose_points, status=Status(pose_status), **common)  # type: ignore[arg-type]
        for target, curve, pose_points, pose_status in zip(targets, components, points, status, strict=True)
    ]


def make_tracer(arm: Arm, task: Task, fixed_joints: Mapping[int, float] | None = None) -> ManifoldTracer:
    """Return the predictor and corrector of an arm and task, compiled once for each number of fixed joints."""
    engine = _cached_tracer(arm, tuple(map(tuple, task.rows.tolist())), task.frame, len(fixed_joints or {}))
    return engine.with_fixed_joints(fixed_joints) if fixed_joints else engine


def _join_intervals(spans: list[tuple[float, float]], is_periodic: bool) -> list[tuple[float, float]]:
    """Join intervals that overlap; on a circle intervals that begin outside -pi to pi are shifted by full turns."""
    period = 2 * np.pi
    if is_periodic:
        if any(upper - lower >= period for lower, upper in spans):
            return [(-np.pi, np.pi)]
        spans = [
            (lower - np.floor((lower + np.pi) / period) * period, upper - np.floor((lower + np.pi) / period) * period)
            for lower, upper in spans
        ]
        spans += [(-np.pi, upper - period) for _, upper in spans if upper > np.pi]
    joined = joint_space.join_intervals(spans, period=period if is_periodic else None)
    if is_periodic and len(joined) == 1 and joined[0][1] - joined[0][0] >= period:
        return [(-np.pi, np.pi)]
    return joined


@lru_cache(maxsize=16)
def _cached_tracer(
    arm: Arm, rows: tuple[tuple[float, ...], ...], frame: Literal["base", "tool"], fixed_count: int
) -> ManifoldTracer:
    return ManifoldTracer(arm, Task("task", np.array(rows), frame), fixed_count)
