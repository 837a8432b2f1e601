"""Curves of configurations of a pose: a predictor along the null vector of the Jacobian, and a corrector back to the pose.

Source: Goel, Maciejewski, Balakrishnan 2005, section on self-motion manifolds; the samples of larger manifolds are ours.
"""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass

import casadi as ca
import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.progress import ProgressCount
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import damped_least_norm, factor_householder
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.inverse_kinematics import scaled_error_and_jacobian, solver
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task

CURVE_TOLERANCE = 1e-10  # rad, and lengths in units of the arm's own length: largest distance of a point from the pose
_CORRECTOR_STEPS = 5  # corrector steps before a step counts as too long
_MIN_STEP_FRACTION = 2.0**-10  # of the spacing: if a shorter step were needed, the curve ends
_MIN_TANGENT_COSINE = 0.9  # least cosine of the angle between the null vectors at both ends of a step
_ON_CURVE_FRACTION = 0.15  # of the spacing: a configuration closer than this to a traced curve lies on it
_MAX_CURVE_LENGTH = 400.0  # rad: longer curves are cut
_MAX_POINTS = 4000  # points of a sample
_SIMULTANEOUS_CURVES = 16  # curves traced at the same time; no result depends on it


@dataclass(frozen=True, eq=False, kw_only=True)
class Component:
    """Connected curve of configurations of a pose.

    Attributes:
        q: (K, n) points in order, rad and m, continuous: joints without limits may pass pi.
        closed: True if the curve returns to its first point (modulo 2 pi for joints without limits).
        bounded_by: Index from 0 of the joint whose limit ends the curve at its first and at its last point. None for a closed
            curve, and for an end at a singular configuration.
        length: Length of the polygon through the points, rad (and m for prismatic joints).
        barred_by: Pair of a clearance, ``panda_joint4 & table``, that ends the curve at its first and at its last point; empty
            if none does.
    """

    q: FloatArray
    closed: bool
    bounded_by: tuple[int | None, int | None]
    length: float
    barred_by: tuple[str, str] = ("", "")

    @property
    def winding(self) -> IndexArray:
        """Full revolutions (n,) of each joint along a closed curve; 0 on other curves.

        If it is not 0, the joint takes every angle, for any spacing of the points.
        """
        revolutions = np.rint((self.q[-1] - self.q[0]) / (2 * np.pi)) if self.closed else np.zeros(self.q.shape[1])
        return revolutions.astype(np.int64)

    @property
    def ranges(self) -> FloatArray:
        """Length (n,) of the interval of values of each joint on the curve, rad or m; 2 pi for a joint that winds.

        For a revolute joint 2 pi or more means every angle. The ends lie on parabolas through three points.
        """
        widths = np.array(
            [_interpolated_maximum(values, self.closed) + _interpolated_maximum(-values, self.closed) for values in self.q.T]
        )
        return np.where(self.winding != 0, 2 * np.pi, widths)


def _interpolated_maximum(x: FloatArray, closed: bool) -> float:
    """Return the largest value of a smooth curve with points x (K,), by a parabola at the largest point and its neighbors."""
    index, count = int(x.argmax()), len(x)
    if count < 3 or (not closed and index in (0, count - 1)):
        return float(x[index])
    left_drop, right_drop = x[index - 1] - x[index], x[(index + 1) % count] - x[index]
    curvature = left_drop + right_drop
    # If the curve winds or its ends are not neighbours, the parabola has no meaning, and its rise is at most the gap.
    rise = (left_drop - right_drop) ** 2 / (-8 * curvature) if curvature < 0 else 0.0
    return float(x[index] + min(rise, abs(left_drop), abs(right_drop)))


@dataclass
class _CurveRun:
    """Curves being traced, one per row: their current points, and the reason for their end."""

    q: FloatArray
    tangent: FloatArray
    points: list[FloatArray]
    closed: BoolArray
    limit: IndexArray  # index of the joint, or -1


class ManifoldTracer:
    """Compiled predictor and corrector of one arm and task.

    Attributes:
        arm, task: Arm model, and task that the self-motion keeps.
        dimension: Remaining degrees of redundancy.
        fixed_joints: Values, rad or m, of the fixed joints by index from 0.
    """

    def __init__(self, arm: Arm, task: Task, fixed_count: int = 0) -> None:
        """Compile for a number of fixed joints, which may be any joints; see :meth:`with_fixed_joints`."""
        self.arm = arm
        self.engine = solver(arm, task)
        self.task, self.dimension = task, arm.n - task.m - fixed_count
        self.fixed_joints: Mapping[int, float] = {}

    def with_fixed_joints(self, fixed_joints: Mapping[int, float]) -> ManifoldTracer:
        """Return the tracer with other fixed joints, of the number for which the tracer was made."""
        tracer_copy = copy(self)
        tracer_copy.fixed_joints = fixed_joints
        tracer_copy.__dict__["_step"] = self._step  # one kernel for all
        return tracer_copy

    @property
    def _fixed_inputs(self) -> list[FloatArray]:
        """Return the kernel inputs in addition to configurations and poses: the fixed joints, one in each row."""
        return [np.eye(self.arm.n)[list(self.fixed_joints)]] if self.fixed_joints else []

    @cached_property
    @cached_kernel
    def _step(self) -> Kernel:
        arm, task = self.engine.arm, self.task
        q = kinematics.joint_symbols(arm)
        position, rotation = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
        errors, jacobian = scaled_error_and_jacobian(arm, task, q, position, rotation)
        fixed_count = arm.n - task.m - self.dimension
        fixed_rows = [ca.SX.sym("held", fixed_count, arm.n)] if fixed_count else []
        errors, jacobian = ca.vertcat(errors, ca.SX.zeros(fixed_count, 1)), ca.vertcat(jacobian, *fixed_rows)
        is_moving = 1 - ca.sum1(fixed_rows[0]) if fixed_rows else ca.SX.ones(1, arm.n)
        basis = factor_householder(jacobian).null_space_basis()
        # Fixed joints do not move, not even by rounding.
        null_vectors = [basis[joint][column] * is_moving[joint] for column in range(self.dimension) for joint in range(arm.n)]
        correction = damped_least_norm(jacobian, errors, 1e-14) * is_moving.T
        # Basis and residual are those of q, so that a point without correction has its own.
        return Kernel(
            "self-motion", [q, position, rotation, *fixed_rows], [ca.vertcat(q + correction, ca.norm_2(errors), *null_vectors)]
        )

    def find_seeds(self, poses: FloatArray, pose_indices: IndexArray, seed: int, starts: int) -> tuple[IndexArray, FloatArray]:
        """Find configurations (S, n) of poses, and the pose of each, in order of starts."""
        generator = np.random.default_rng(np.random.SeedSequence(seed))
        random_starts = self.engine.sample_starts(len(poses) * starts, generator).reshape(len(poses), starts, self.arm.n)
        random_starts[..., list(self.fixed_joints)] = list(self.fixed_joints.values())
        owner = np.repeat(pose_indices, starts)
        q, converged = self._solve_from_starts(random_starts[pose_indices].reshape(-1, self.arm.n), poses[owner])
        return owner[converged], q[converged]

    def _solve_from_starts(self, q: FloatArray, poses: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Solve inverse kinematics from starts q (N, n); return the ends, and which are on the pose within the limits."""
        return self.engine.attempt(q, poses, CURVE_TOLERANCE, fixed_joints=list(self.fixed_joints))

    def project_onto_poses(self, q: FloatArray, poses: FloatArray) -> tuple[FloatArray, BoolArray, FloatArray]:
        """Project configurations (N, n) onto their poses; return them, where that succeeded, and null vectors (N, free, n)."""
        n = self.arm.n
        positions, rotations = np.ascontiguousarray(poses[:, :3, 3]), np.ascontiguousarray(poses[:, :3, :3])
        for steps_left in reversed(range(_CORRECTOR_STEPS)):
            outputs = self._step.rows(q, positions, rotations, *self._fixed_inputs)
            on_pose = outputs[:, n] <= CURVE_TOLERANCE
            if on_pose.all() or not steps_left:
                break
            q = np.where(on_pose[:, None], q, outputs[:, :n])
        return q, on_pose & np.isfinite(outputs).all(axis=1), outputs[:, n + 1 :].reshape(-1, self.dimension, n)

    def newton_step_and_error(self, q: FloatArray, p: FloatArray, r: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return one least-norm step (N, n) from q (N, n) to positions p (N, 3) and rotations r (N, 3, 3), the error (N,) of q,
        in units of the arm's own length, and the first null vector (N, n) at q.
        """
        n = self.arm.n
        outputs = self._step.rows(q, p, r, *self._fixed_inputs)
        return outputs[:, :n] - q, outputs[:, n], outputs[:, n + 1 :].reshape(-1, self.dimension, n)[:, 0]

    # ---- curves ----------------------------------------------------------------------------------------------------

    def trace_curves(
        self, poses: FloatArray, pose_of_seed: IndexArray, q: FloatArray, spacing: float, curves_by_pose: list[list[Component]]
    ) -> list[list[Component]]:
        """Add to ``curves_by_pose`` every other curve through a seed q (S, n) of pose ``pose_of_seed`` (S,)."""
        pending = np.ones(pose_of_seed.size, dtype=bool)
        for pose_index in np.unique(pose_of_seed):
            for component in curves_by_pose[pose_index]:
                self._drop_seeds(pending, component, pose_index, pose_of_seed, q, spacing)
        with ProgressCount("starts", pose_of_seed.size) as advance:
            while pending.any():
                advance(int(np.count_nonzero(~pending)))
                pose_of_seed, q = pose_of_seed[pending], q[pending]
                pending = np.ones(pose_of_seed.size, dtype=bool)
                # For few poses several seeds run at once, although some of them turn out to lie on the same curve.
                curves_per_pose = max(1, _SIMULTANEOUS_CURVES // np.unique(pose_of_seed).size)
                first = np.flatnonzero(_count_earlier_equals(pose_of_seed) < curves_per_pose)
                for index, component in zip(
                    first, self._trace_both_ways(q[first], poses[pose_of_seed[first]], spacing), strict=True
                ):
                    if component is not None and pending[index]:
                        curves_by_pose[pose_of_seed[index]].append(component)
                        self._drop_seeds(pending, component, pose_of_seed[index], pose_of_seed, q, spacing)
                    pending[index] = False
        return curves_by_pose

    def _drop_seeds(
        self, pending: BoolArray, component: Component, pose: np.intp, pose_of_seed: IndexArray, q: FloatArray, spacing: float
    ) -> None:
        """Remove the pending seeds of a pose that lie on a component."""
        own_seeds = np.flatnonzero((pose_of_seed == pose) & pending)
        if own_seeds.size:
            pending[own_seeds] = distance_to_curve(self.arm, component, q[own_seeds]) > _ON_CURVE_FRACTION * spacing

    def propagate_curves_between_poses(
        self, poses: FloatArray, spacing: float, curves_by_pose: list[list[Component]]
    ) -> list[list[Component]]:
        """Add the curves at which inverse kinematics converges from the middle of a curve of the previous or next pose."""
        new_curves = [(pose_index, curve) for pose_index, curves in enumerate(curves_by_pose) for curve in curves]
        while new_curves:
            starts = [
                (pose_index + offset, curve.q[len(curve.q) // 2])
                for pose_index, curve in new_curves
                for offset in (-1, 1)
                if 0 <= pose_index + offset < len(poses)
            ]
            if not starts:
                break
            owner = np.array([pose_index for pose_index, _ in starts])
            q, converged = self._solve_from_starts(np.array([start for _, start in starts]), poses[owner])
            known_counts = [len(curves) for curves in curves_by_pose]
            self.trace_curves(poses, owner[converged], q[converged], spacing, curves_by_pose)
            new_curves = [(k, curve) for k, curves in enumerate(curves_by_pose) for curve in curves[known_counts[k] :]]
        return curves_by_pose

    def _trace_both_ways(self, q: FloatArray, poses: FloatArray, spacing: float) -> list[Component | None]:
        q, sound, null_vectors = self.project_onto_poses(q, poses)
        tangent = null_vectors[:, 0]
        rows = np.flatnonzero(sound)
        ahead = self._trace_one_direction(q[rows], tangent[rows], poses[rows], spacing)
        open_curves = np.flatnonzero(~ahead.closed)
        behind = self._trace_one_direction(q[rows[open_curves]], -tangent[rows[open_curves]], poses[rows[open_curves]], spacing)
        backward_index = {int(forward): backward for backward, forward in enumerate(open_curves)}
        components: list[Component | None] = [None] * len(q)
        end_joints = [*range(self.arm.n), None]  # by the joint of a limit; -1: none
        for forward, row in enumerate(rows):
            points = ahead.points[forward]
            bounds: tuple[int | None, int | None] = (None, None)
            if forward in backward_index:
                backward = backward_index[forward]
                points = np.concatenate([behind.points[backward][:0:-1], points])
                bounds = end_joints[behind.limit[backward]], end_joints[ahead.limit[forward]]
            closed = bool(ahead.closed[forward])
            length = np.linalg.norm(_curve_segments(self.arm, points, closed), axis=1).sum()
            components[row] = Component(q=points, closed=closed, bounded_by=bounds, length=float(length))
        return components

    def _trace_one_direction(self, q: FloatArray, tangent: FloatArray, poses: FloatArray, spacing: float) -> _CurveRun:
        """Follow the curve through each start q (N, n) in the direction of its tangent (N, n)."""
        run = _CurveRun(q.copy(), tangent.copy(), [], np.zeros(len(q), dtype=bool), np.full(len(q), -1))
        taken_rows, taken_points = [np.arange(len(q))], [q]
        step = np.full(len(q), spacing)
        travelled = np.zeros(len(q))
        active = np.arange(len(q))
        while active.size:
            current, direction = run.q[active], run.tangent[active]
            predicted, on_pose, null_vectors = self.project_onto_poses(current + step[active, None] * direction, poses[active])
            next_tangent = (
                null_vectors[:, 0] * np.where(np.einsum("ij,ij->i", null_vectors[:, 0], direction) < 0, -1.0, 1.0)[:, None]
            )
            distance = np.linalg.norm(predicted - current, axis=1)
            is_accepted = (
                on_pose
                & (np.einsum("ij,ij->i", next_tangent, direction) >= _MIN_TANGENT_COSINE)
                & (distance <= 1.5 * step[active])
            )
            # At a limit the step is shortened in proportion so that it ends there.
            fraction, joint = self._fraction_within_limits(current, predicted)
            beyond_limit = is_accepted & (fraction < 1)
            at_limit = beyond_limit & (fraction * distance <= 1e-12)
            run.limit[active[at_limit]] = joint[at_limit]
            is_shortened = is_accepted & beyond_limit & ~at_limit
            step[active[is_shortened]] *= fraction[is_shortened]
            is_taken = is_accepted & ~beyond_limit
            rows = active[is_taken]
            is_closed = self._closes_curve(run.q[rows], predicted[is_taken], q[rows], tangent[rows])
            run.closed[rows[is_closed]] = True
            taken_rows.append(rows[~is_closed])
            taken_points.append(predicted[is_taken][~is_closed])
            run.q[rows], run.tangent[rows] = predicted[is_taken], next_tangent[is_taken]
            travelled[rows] += distance[is_taken]
            step[rows] = np.minimum(2 * step[rows], spacing)
            step[active[~is_accepted]] *= 0.5
            is_too_short = ~is_accepted & (step[active] < _MIN_STEP_FRACTION * spacing)
            has_ended = at_limit | is_too_short | (travelled[active] > _MAX_CURVE_LENGTH)
            has_ended |= np.isin(active, rows[is_closed])
            active = active[~has_ended]
        all_rows = np.concatenate(taken_rows)
        order = np.argsort(all_rows, kind="stable")
        run.points = np.split(np.concatenate(taken_points)[order], np.searchsorted(all_rows[order], np.arange(1, len(q))))
        return run

    def _fraction_within_limits(self, q: FloatArray, new: FloatArray) -> tuple[FloatArray, IndexArray]:
        """Return the fraction (N,) of the step from q to new within the limits, and the joint that ends it."""
        displacement = new - q
        distance_to_limit = np.where(displacement > 0, self.arm.upper - q, self.arm.lower - q)
        outside = (new > self.arm.upper) | (new < self.arm.lower)
        with np.errstate(divide="ignore", invalid="ignore"):
            fraction = np.where(outside, np.maximum(distance_to_limit / displacement, 0.0), 1.0)
        return fraction.min(axis=1), fraction.argmin(axis=1)

    def _closes_curve(self, q: FloatArray, new: FloatArray, first: FloatArray, direction: FloatArray) -> BoolArray:
        """Return True where the step from q to new (N, n) passes the curve's first point, in the direction of its start."""
        before, after = (joint_space.joint_difference(self.arm, point, first) for point in (q, new))
        crosses = (np.einsum("ij,ij->i", before, direction) < 0) & (np.einsum("ij,ij->i", after, direction) >= 0)
        step_length = np.linalg.norm(new - q, axis=1)
        is_near = _distance_to_segment(-before, new - q) <= _ON_CURVE_FRACTION * step_length
        return np.asarray(crosses & is_near & (np.linalg.norm(before, axis=1) <= 2 * step_length))

    # ---- samples ---------------------------------------------------------------------------------------------------

    def sample_manifold(self, pose: FloatArray, q: FloatArray, spacing: float) -> FloatArray:
        """Sample points (N, n) of a manifold of dimension 2 or more, from seeds q (S, n), by a growing front of neighbors."""
        points = front = self._select_spaced_points(np.empty((0, self.arm.n)), q, spacing)
        angles = np.linspace(0, 2 * np.pi, 6, endpoint=False)
        planes = [(first, second) for first in range(self.dimension) for second in range(first + 1, self.dimension)]
        directions = np.zeros((len(planes) * angles.size, self.dimension))
        for index, (first, second) in enumerate(planes):
            directions[index * angles.size : (index + 1) * angles.size, [first, second]] = np.stack(
                [np.cos(angles), np.sin(angles)], axis=1
            )
        while len(front) and len(points) < _MAX_POINTS:
            _, _, null_vectors = self.project_onto_poses(front, np.broadcast_to(pose, (len(front), 4, 4)))
            predicted = front[:, None] + spacing * np.einsum("df,nfj->ndj", directions, null_vectors)
            predicted = predicted.reshape(-1, self.arm.n)
            corrected, on_pose, _ = self.project_onto_poses(predicted, np.broadcast_to(pose, (len(predicted), 4, 4)))
            inside = ((corrected >= self.arm.lower) & (corrected <= self.arm.upper)).all(axis=1)
            is_near = np.linalg.norm(corrected - predicted, axis=1) <= spacing
            front = self._select_spaced_points(points, corrected[on_pose & inside & is_near], 0.9 * spacing)
            points = np.concatenate([points, front])
        return points[:_MAX_POINTS]

    def _select_spaced_points(self, points: FloatArray, q: FloatArray, spacing: float) -> FloatArray:
        """Return those of q (N, n), in order, that are ``spacing`` away from the points and from those returned before."""
        if len(points) and len(q):
            q = q[joint_space.find_nearest(self.arm, points, q)[0] >= spacing]
        if not len(q):
            return q
        is_retained = np.ones(len(q), dtype=bool)
        for first, second in joint_space.find_close_pairs(self.arm, q, spacing * (1 - 1e-12)):
            if is_retained[first]:
                is_retained[second] = False
        return q[is_retained]


def distance_to_curve(arm: Arm, component: Component, q: FloatArray) -> FloatArray:
    """Return the distance (N,) of configurations (N, n) from the polygon of a component, near it; rad (and m)."""
    points, segments = component.q, _curve_segments(arm, component.q, component.closed)
    _, nearest = joint_space.find_nearest(arm, points, q)
    displacement = joint_space.joint_difference(arm, q, points[nearest])
    previous_segment = segments[nearest - 1] if component.closed else np.where(nearest[:, None] > 0, segments[nearest - 1], 0.0)
    return np.minimum(
        _distance_to_segment(displacement, segments[nearest]), _distance_to_segment(displacement, -previous_segment)
    )


def _distance_to_segment(displacement: FloatArray, segment: FloatArray) -> FloatArray:
    """Return the distance (N,) of points ``displacement`` (N, n) from segments (N, n) that begin at the origin."""
    square_length = np.maximum(np.einsum("ij,ij->i", segment, segment), 1e-300)
    fraction = np.clip(np.einsum("ij,ij->i", displacement, segment) / square_length, 0.0, 1.0)
    return np.asarray(np.linalg.norm(displacement - fraction[:, None] * segment, axis=1))


def _curve_segments(arm: Arm, q: FloatArray, closed: bool) -> FloatArray:
    """Return the vectors (K, n) from each point to the next; the last one to the first if closed, else 0."""
    segments = np.diff(q, axis=0, append=q[-1:])
    if closed:
        segments[-1] = joint_space.joint_difference(arm, q[0], q[-1])
    return segments


def _count_earlier_equals(owner: IndexArray) -> IndexArray:
    """Return (S,) the number of earlier entries equal to each entry."""
    order = np.argsort(owner, kind="stable")
    first = np.searchsorted(owner[order], owner[order])
    rank = np.empty(owner.size, dtype=np.intp)
    rank[order] = np.arange(owner.size) - first
    return rank
