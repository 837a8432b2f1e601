"""Values of each joint over all configurations of a target, at which the joint may lock without losing the target."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError, TaskError
from holdfast.core.progress import reports_progress, track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.workspace.extrema import CriticalPoints, critical_point_solver
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task, target_pose

Arcs = list[tuple[float, float]]

CRITICAL_POINT_STARTS = 256
LOCKED_RESTARTS = 60
_SCANNED_VALUES = 90  # values of each joint that are tried in addition to the critical ones
_TARGET_TOLERANCE = 1e-8  # rad, and lengths in units of the arm's own length
_BISECTION_STEPS = 18  # bisections of a gap of the scan: 5 deg becomes 3e-7 rad
_CRITICAL_VALUE_TOLERANCE = 1e-6  # rad and m: closer critical values are the same
_CUT_DISTANCE = 1e-4  # rad and m: values closer to a cut are ignored; at the edge of the workspace they may be wrong


@check_arguments
@reports_progress("looking for the ranges of the joints")
def joint_bounds(
    arm: Arm,
    target: ArrayLike,
    task: str | Task | Sequence[str] = "pose",
    *,
    seed: int = 0,
    starts: int = CRITICAL_POINT_STARTS,
) -> list[Arcs]:
    """Compute the values of each joint over all configurations of a target; a lock elsewhere makes the target unreachable.

    The ends are critical points of the joint on the self-motion manifold: equations (8) and (9), solved by Newton's method from
    many starts (with joint limits also on the faces where joints rest on theirs). These points and a scan of 90 values cut the
    range of the joint into segments. A segment is reached if it contains a known configuration of the target, or if inverse
    kinematics with the joint locked at its middle finds one. An end that Newton's method missed is found by bisection.

    Ends that are critical points are exact to 1e-9, and others to 1e-6 rad if inverse kinematics finds all solutions; at the
    edge of the workspace, where arcs shrink to points, to 1e-4. Gaps and arcs narrower than a 90th of the joint's range may be
    missed if Newton's method missed both their ends: what is not found is not proved absent.

    Args:
        arm: Arm model with any number of redundant joints.
        target: (m,) rows of the target tool point, m, for tasks without angular rows; or, for any task, a (4, 4) tool pose in
            the world.
        task: Rows of the pose that must be met.
        seed: Seed of the starts.
        starts: Number of starts of Newton's method per joint.

    Returns:
        For each joint a list of ``(lower, upper)``, rad (m for prismatic joints), in ascending order: ``[(-pi, pi)]`` if a
        joint without limits is free, ``[]`` if no configuration of the target was found. An arc of a joint without limits
        begins in -pi to pi and may end beyond pi. Arcs of a joint with limits lie within them. An arc of length 0 is a single
        value.

    Raises:
        InputError: The target has another shape or NaN, or an option is out of range.
        TaskError: The arm has no redundancy for the task.

    Source: Goel et al. 2005, eq. (8) and (9); the segment test, limits and the scan are ours.
    """
    resolved_task = as_task(arm, task)
    if arm.n <= resolved_task.m:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task '{resolved_task.name}' {resolved_task.m} rows: without redundancy "
            "every lock loses almost every target; choose a task with fewer rows"
        )
    if starts < 1:
        raise InputError(f"starts is {starts}; it must be 1 or more")
    pose = target_pose(resolved_task, target)
    solver = critical_point_solver(arm, resolved_task)
    generator = np.random.default_rng(np.random.SeedSequence(seed))
    seeds = solver.find_seeds(pose, max(starts, 128), generator)
    if not len(seeds):
        return [[] for _ in range(arm.n)]
    critical_joint, critical_q = _find_critical_values(solver, pose, seeds, starts, generator)
    segments = [_cut_joint_range(arm, index, critical_q[critical_joint == index, index]) for index in range(arm.n)]
    known_configurations = joint_space.wrap_joints_to_positive(arm, np.concatenate([seeds, critical_q]))
    _decide_segments(solver, pose, segments, known_configurations, seed)
    return [joint_segments.join_arcs() for joint_segments in segments]


def _find_critical_values(
    solver: CriticalPoints, pose: FloatArray, seeds: FloatArray, starts: int, generator: np.random.Generator
) -> tuple[IndexArray, FloatArray]:
    """Find critical points (C, n), and the joint (C,) for which each is critical."""
    arm = solver.arm
    joint = np.repeat(np.arange(arm.n), starts)
    q = seeds[generator.integers(0, len(seeds), joint.size)]
    at_limit = np.zeros(q.shape, dtype=bool)
    limits = np.stack([arm.lower, arm.upper])
    if np.isfinite(limits).any():
        # Every other start is on a face: some of the other joints, at most as many as are redundant, rest on a limit.
        order = generator.permuted(np.broadcast_to(np.arange(arm.n), q.shape), axis=1)
        limit_count = generator.integers(1, arm.n - solver.m + 1, joint.size)
        limit_values = limits[generator.integers(0, 2, q.shape), np.arange(arm.n)]
        at_limit = (order < limit_count[:, None]) & np.isfinite(limit_values) & (np.arange(arm.n) != joint[:, None])
        at_limit[::2] = False
        q = np.where(at_limit, limit_values, q)
    points, is_critical = solver.solve(pose, q, joint, at_limit)
    return joint[is_critical], np.clip(points[is_critical], arm.lower, arm.upper)


@dataclass
class _JointSegments:
    """Range of one joint, cut into segments.

    Attributes:
        joint: Index of the joint, from 0.
        cuts: (K,) ascending cuts. Segment k extends from cut k to the next; on a circle the last one extends to the first.
        is_critical: (K,) True if the cut is a critical value, which is therefore reached.
        is_periodic: True if the joint has no limits; values are in 0 to 2 pi.
        witnesses: (S, 2) lowest and highest known reached value in each segment, NaN if none is known.
    """

    joint: int
    cuts: FloatArray
    is_critical: BoolArray
    is_periodic: bool
    witnesses: FloatArray

    @property
    def is_reached(self) -> BoolArray:
        """Flags (S,) of the segments with a known reached value."""
        return np.asarray(~np.isnan(self.witnesses[:, 0]))

    @property
    def boundaries(self) -> FloatArray:
        """Boundaries (S + 1,) of the segments."""
        return np.append(self.cuts, self.cuts[0] + 2 * np.pi) if self.is_periodic else self.cuts

    @property
    def midpoints(self) -> FloatArray:
        """Midpoints (S,) of the segments."""
        return (self.boundaries[1:] + self.boundaries[:-1]) / 2

    def record_values(self, values: FloatArray) -> None:
        """Record reached values (V,) as witnesses of the segments in whose interior they lie."""
        if self.is_periodic:
            values = np.where(values < self.cuts[0], values + 2 * np.pi, values)
        segment = np.searchsorted(self.boundaries, values, side="right") - 1
        inside = (segment >= 0) & (segment < self.midpoints.size)
        segment, values = segment[inside], values[inside]
        well_inside = np.minimum(values - self.boundaries[segment], self.boundaries[segment + 1] - values) > _CUT_DISTANCE
        np.fmin.at(self.witnesses[:, 0], segment[well_inside], values[well_inside])
        np.fmax.at(self.witnesses[:, 1], segment[well_inside], values[well_inside])

    def find_transitions(self) -> list[tuple[int, float, float]]:
        """Find cuts between a reached and an unreached segment, with a value of each kind beside the cut."""
        transitions = []
        count = self.is_reached.size
        for index in range(0 if self.is_periodic else 1, count):
            reached_before, reached_after = self.is_reached[index - 1], self.is_reached[index]
            period = 2 * np.pi if index == 0 else 0.0  # the last segment of a circle precedes the first cut
            if reached_before and not reached_after:
                transitions.append((index, float(self.witnesses[index - 1, 1]) - period, float(self.midpoints[index])))
            elif reached_after and not reached_before:
                transitions.append((index, float(self.witnesses[index, 0]), float(self.midpoints[index - 1]) - period))
        return transitions

    def join_arcs(self) -> Arcs:
        """Join reached segments, and critical values without a reached neighbor, to intervals."""
        if self.is_reached.all():
            return [(-np.pi, np.pi)] if self.is_periodic else [(float(self.cuts[0]), float(self.cuts[-1]))]
        boundaries, count = self.boundaries, self.is_reached.size
        pieces = [(boundaries[index], boundaries[index + 1]) for index in range(count) if self.is_reached[index]]
        pieces += [(critical_value, critical_value) for critical_value in self.cuts[self.is_critical]]
        period = 2 * np.pi
        joined = joint_space.join_intervals(pieces, 10 * _CRITICAL_VALUE_TOLERANCE, period if self.is_periodic else None)
        if self.is_periodic:
            joined = [(low - period, high - period) if low >= np.pi else (low, high) for low, high in joined]
        return sorted((float(low), float(high)) for low, high in joined)


def _cut_joint_range(arm: Arm, joint: int, critical: FloatArray) -> _JointSegments:
    """Cut the range of a joint at a scan of values and at its critical values."""
    is_periodic = bool(joint_space.is_unlimited(arm)[joint])
    lower, upper = (0.0, 2 * np.pi) if is_periodic else (float(limits[joint]) for limits in sampling_limits(arm))
    values = np.sort(critical % (2 * np.pi)) if is_periodic else np.sort(critical)
    groups = np.split(values, np.flatnonzero(np.diff(values) > _CRITICAL_VALUE_TOLERANCE) + 1) if values.size else []
    critical_values = np.array([np.median(group) for group in groups])
    if (
        is_periodic
        and critical_values.size > 1
        and critical_values[0] + 2 * np.pi - critical_values[-1] <= _CRITICAL_VALUE_TOLERANCE
    ):
        critical_values = critical_values[:-1]
    # A joint that ends on its own limit needs no other cut there.
    scan = np.linspace(lower, upper, _SCANNED_VALUES + 1)[: _SCANNED_VALUES if is_periodic else None]
    if critical_values.size:
        distances = np.abs(scan[:, None] - critical_values)
        periodic_distances = np.minimum(distances, 2 * np.pi - distances) if is_periodic else distances
        scan = scan[periodic_distances.min(axis=1) > _CUT_DISTANCE]
    cuts = np.concatenate([critical_values, scan])
    order = np.argsort(cuts, kind="stable")
    cuts, is_critical = cuts[order], (np.arange(cuts.size) < critical_values.size)[order]
    if not is_periodic and (cuts[0] != lower or cuts[-1] != upper):
        cuts, is_critical = np.r_[lower, cuts, upper], np.r_[False, is_critical, False]
        is_unique = np.r_[True, np.diff(cuts) > 0]
        cuts, is_critical = cuts[is_unique], is_critical[is_unique]
    return _JointSegments(joint, cuts, is_critical, is_periodic, np.full((cuts.size - (0 if is_periodic else 1), 2), np.nan))


def _decide_segments(
    solver: CriticalPoints, pose: FloatArray, segments: list[_JointSegments], configurations: FloatArray, seed: int
) -> None:
    """Decide which segments are reached, then move the cuts that bound reached segments to the exact bounds."""

    def check_reached(joint: IndexArray, values: FloatArray) -> BoolArray:
        poses = np.broadcast_to(pose, (joint.size, 4, 4))
        return solver.engine.is_reachable_with_lock(
            poses, joint, values, np.random.SeedSequence(seed), LOCKED_RESTARTS, _TARGET_TOLERANCE
        )

    for joint_segments in segments:
        joint_segments.record_values(configurations[:, joint_segments.joint])
    unknown = [
        (joint_segments, segment) for joint_segments in segments for segment in np.flatnonzero(~joint_segments.is_reached)
    ]
    middle = np.array([joint_segments.midpoints[segment] for joint_segments, segment in unknown])
    is_reached = check_reached(np.array([joint_segments.joint for joint_segments, _ in unknown], dtype=np.int64), middle)
    for (joint_segments, segment), was_reached, value in zip(unknown, is_reached, middle, strict=True):
        if was_reached:
            joint_segments.witnesses[segment] = value
    edges = [(joint_segments, *change) for joint_segments in segments for change in joint_segments.find_transitions()]
    if not edges:
        return
    joint = np.array([joint_segments.joint for joint_segments, *_ in edges], dtype=np.int64)
    cut_values = np.array([joint_segments.cuts[segment] for joint_segments, segment, _, _ in edges])
    inner, outer = (np.array([edge[side] for edge in edges]) for side in (2, 3))
    # A critical value is the end if the values on both sides confirm it.
    is_critical = np.array([joint_segments.is_critical[segment] for joint_segments, segment, _, _ in edges])
    confirmed = (
        is_critical
        & check_reached(joint, _step_towards(cut_values, inner))
        & ~check_reached(joint, _step_towards(cut_values, outer))
    )
    inexact = np.flatnonzero(~confirmed)
    joint, inner, outer = joint[inexact], inner[inexact], outer[inexact]
    for _ in track("halvings", range(_BISECTION_STEPS)):
        midpoint = (inner + outer) / 2
        was_reached = check_reached(joint, midpoint)
        inner, outer = np.where(was_reached, midpoint, inner), np.where(was_reached, outer, midpoint)
    for index, value in zip(inexact, inner, strict=True):
        changed, position = edges[index][:2]
        changed.cuts[position], changed.is_critical[position] = value, False


def _step_towards(start: FloatArray, target: FloatArray) -> FloatArray:
    """Move values ``start`` (E,) a small step towards others (E,)."""
    return np.asarray(start + np.clip(target - start, -10 * _CUT_DISTANCE, 10 * _CUT_DISTANCE) / 2)
