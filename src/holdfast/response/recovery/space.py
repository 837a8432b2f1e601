"""Joint space of a failed arm: lengths of paths, valid configurations, and proofs that straight segments are valid."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.tool_constraints.constraint import ToolConstraint
from holdfast.kinematics.tool_constraints.manifold import ConstraintManifold
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.compiled.edges import EdgeChecker, RouteSearch
from holdfast.model.collision.exact.exact_clearance import ExactClearance

MetricName = Literal["travel", "time"]

# Possible motion in m between bodies that could collide: a segment that is still undecided at this size counts as blocked.
MIN_RESOLVED_MOTION_M = 5e-4
_END_ROOM_M = 1e-3  # room of a pair at the ends of a route with exact distances, in the search


@dataclass(frozen=True)
class JointMetric:
    """Length of a route through joint space.

    Attributes:
        name: ``travel``: Euclidean length of the joints' motion, each joint times its scale. ``time``: every straight piece at
            the velocity limit of its slowest joint, without acceleration limits.
        scale: (n,) scale of each joint: its weight (1 rad counts as 1 m), or 1 over its velocity limit.
    """

    name: MetricName
    scale: FloatArray

    @classmethod
    def for_arm(cls, arm: Arm, name: MetricName, weights: FloatArray | None, free: BoolArray) -> JointMetric:
        """Return the metric of an arm whose healthy joints are ``free`` (n,).

        Raises:
            InputError: The name is unknown, the weights are not n positive numbers, or ``time`` lacks velocity limits.
        """
        if name not in ("travel", "time"):
            raise InputError(f"metric '{name}' is not known; use 'travel' or 'time'")
        if name == "time":
            max_speeds = np.array([joint.velocity for joint in arm.joints])
            unlimited_joints = [
                arm.joint_names[index] for index in np.flatnonzero(free & ~(np.isfinite(max_speeds) & (max_speeds > 0)))
            ]
            if unlimited_joints:
                raise InputError(
                    f"metric 'time' needs velocity limits, and joint '{unlimited_joints[0]}' has none; use metric 'travel'"
                )
            if weights is not None:
                raise InputError("weights go with metric 'travel'; for 'time' the velocity limits are the weights")
            return cls(name, np.where(free, 1.0 / np.where(free, max_speeds, 1.0), 1.0))
        scale = np.ones(arm.n) if weights is None else np.asarray(weights, dtype=np.float64)
        if scale.shape != (arm.n,) or not (np.isfinite(scale).all() and (scale > 0).all()):
            raise InputError(f"weights must be {arm.n} finite numbers above 0, one per joint")
        return cls(name, scale)

    @property
    def unit(self) -> str:
        """Unit ``s``, or ``rad`` (1 m of a prismatic joint counts as 1 rad)."""
        return "s" if self.name == "time" else "rad"

    def measure_length(self, differences: FloatArray) -> FloatArray:
        """Return the length of differences (..., n)."""
        scaled = differences * self.scale
        return np.asarray(np.abs(scaled).max(axis=-1) if self.name == "time" else np.linalg.norm(scaled, axis=-1))

    def cumulative_length(self, q: FloatArray) -> FloatArray:
        """Return the length (K,) of the path q (K, n) up to each of its points."""
        return np.concatenate([[0.0], np.cumsum(self.measure_length(np.diff(q, axis=0)))])


class FreeSpace:
    """Valid configurations of the failed arm: within the limits, and no closer to itself and its cell than requested.

    Args:
        arm: The arm.
        free: (n,) mask of the joints that move.
        clearance: Collision model that keeps at least ``margin``, m. None: only the limits restrict the motion.
        margin: Smallest clearance, m.
        around: (K, n) configurations that the box of samples must contain.
        constraints: Tool constraints, anchored at the pose of the start.

    Attributes:
        manifold: Manifold of these constraints; None if there are none.
        edges: Compiled checks and proofs of edges; None if the clearance has meshes, scans, or exact distances.
        closed_in: ``start`` or ``goal`` if the search from this end was exhausted; see :func:`find_route`.
    """

    def __init__(
        self,
        arm: Arm,
        free: BoolArray,
        clearance: Clearance | None,
        margin: float,
        around: FloatArray,
        *,
        constraints: Sequence[ToolConstraint] = (),
    ) -> None:
        self.arm, self.free, self.margin = arm, free, margin
        self._deadline = np.inf
        self.closed_in: Literal["", "start", "goal"] = ""
        self.clearance = clearance if clearance is not None and clearance.pair_names else None
        lower, upper = sampling_limits(arm)
        self.low = np.where(free, np.minimum(lower, around.min(axis=0)), around[0])
        self.high = np.where(free, np.maximum(upper, around.max(axis=0)), around[0])
        # Revolute joints may rotate beyond the box, because no bound below depends on their values; prismatic joints may not.
        self._lower = np.where(arm.prismatic, self.low, arm.lower)
        self._upper = np.where(arm.prismatic, self.high, arm.upper)
        limits = np.where(free, self._lower, around[0]), np.where(free, self._upper, around[0])
        self.manifold = ConstraintManifold(arm, constraints, free, limits) if constraints else None
        self._lipschitz_bounds = None if self.clearance is None else self.clearance.lipschitz_bounds(self.low, self.high)
        self.edges: EdgeChecker | None = None
        if self.clearance is not None and self._lipschitz_bounds is not None and EdgeChecker.supports(self.clearance):
            self.edges = EdgeChecker(self.clearance, margin, self._lipschitz_bounds)

    def stop_after(self, seconds: float) -> None:
        """Set the time in seconds after which :attr:`is_time_over` is true."""
        self._deadline = time.monotonic() + seconds

    @property
    def seconds_left(self) -> float:
        """Remaining time for searches, s; infinite without a limit."""
        return max(self._deadline - time.monotonic(), 0.0)

    @property
    def is_time_over(self) -> bool:
        """True if the time for searches is over."""
        return self.seconds_left == 0

    def are_within_limits(self, q: FloatArray) -> BoolArray:
        """Return (N,) True within the limits; locked joints are ignored."""
        return np.asarray((((q >= self._lower) & (q <= self._upper)) | ~self.free).all(axis=-1))

    def clip_to_limits(self, q: FloatArray) -> FloatArray:
        """Return configurations (N, n) with every joint that moves clipped to its limits."""
        return np.where(self.free, np.clip(q, self._lower, self._upper), q)

    def are_valid(self, q: FloatArray) -> BoolArray:
        """Return (N,) True where configurations (N, n) respect limits, constraints, and clearance."""
        is_valid = self.are_within_limits(q)
        if self.manifold is not None and is_valid.any():
            is_valid[is_valid] = self.manifold.is_satisfied(q[is_valid])
        if self.clearance is not None and is_valid.any():
            is_valid[is_valid] = np.asarray(self.clearance.margin_left(q[is_valid])) >= self.margin
        return is_valid

    def are_segments_valid(self, a: FloatArray, b: FloatArray, deviations: FloatArray | None = None) -> BoolArray:
        """Return (E,) True where the straight segment from a to b (E, n) provably respects limits, constraints, and clearance.

        With ``deviations`` (E, n) this also holds for configurations that deviate by at most these, apart from the limits.

        If a pair is d_1 and d_2 apart at two configurations, it is never closer than ``(d_1 + d_2 - L) / 2`` in between, where
        L bounds the change of its distance along the segment (:meth:`Clearance.lipschitz_bounds`). Pieces for which this bound
        does not suffice are bisected, until it does or L is below half a millimetre: such a piece counts as blocked. Compiled
        code (:attr:`edges`) uses the distance d in the middle of a piece instead: a pair is never closer than ``d - L / 2``.
        """
        is_valid: BoolArray = self.are_within_limits(a) & self.are_within_limits(b)
        if self.manifold is not None and is_valid.any():
            is_valid[is_valid] = self.manifold.prove_edges(
                a[is_valid], b[is_valid], None if deviations is None else deviations[is_valid]
            )
        if self.clearance is None or not is_valid.any():
            return is_valid
        if self.edges is not None:
            is_valid[is_valid] = self.edges.prove_edges(
                a[is_valid],
                (b - a)[is_valid],
                None if deviations is None else deviations[is_valid],
                MIN_RESOLVED_MOTION_M,
            )
            return is_valid
        assert self._lipschitz_bounds is not None
        max_changes = np.abs(b - a) @ self._lipschitz_bounds.T
        deviation_changes = 0 * max_changes if deviations is None else deviations @ self._lipschitz_bounds.T
        segments = np.arange(len(a))
        start_fractions, end_fractions = np.zeros(len(a)), np.ones(len(a))
        first_margins = self._clearance_margins(a) - deviation_changes
        last_margins = self._clearance_margins(b) - deviation_changes
        is_valid &= (first_margins.min(axis=1) >= 0) & (last_margins.min(axis=1) >= 0)
        while True:
            changes = max_changes[segments] * (end_fractions - start_fractions)[:, None]
            is_open = is_valid[segments] & ((first_margins + last_margins - changes).min(axis=1) < 0)
            is_blocked = is_open & (changes.max(axis=1) < MIN_RESOLVED_MOTION_M)
            is_valid[segments[is_blocked]] = False
            is_retained = is_open & is_valid[segments]
            if not is_retained.any():
                return is_valid
            segments, start_fractions, end_fractions, first_margins, last_margins = (
                values[is_retained] for values in (segments, start_fractions, end_fractions, first_margins, last_margins)
            )
            middle = (start_fractions + end_fractions) / 2
            middle_margins = (
                self._clearance_margins(a[segments] + middle[:, None] * (b - a)[segments]) - deviation_changes[segments]
            )
            is_valid[segments[middle_margins.min(axis=1) < 0]] = False
            segments = np.concatenate([segments, segments])
            start_fractions, end_fractions = np.concatenate([start_fractions, middle]), np.concatenate([middle, end_fractions])
            first_margins = np.concatenate([first_margins, middle_margins])
            last_margins = np.concatenate([middle_margins, last_margins])

    def compiled_search(self, metric: JointMetric, ends: FloatArray) -> RouteSearch | None:
        """Return the compiled search for routes between ``ends`` (N, n) that are short in a metric, or None.

        With exact distances, the search uses their lower bounds. A pair whose bound is too small at one of the ends may be as
        close along the whole route. The result is None with constraints, meshes, or scans.
        """
        if self.manifold is not None:
            return None
        edges, clearance = self.edges, self.clearance
        if isinstance(clearance, ExactClearance) and EdgeChecker.supports(clearance.bound):
            assert self._lipschitz_bounds is not None
            lacking = clearance.margins + self.margin - clearance.bound.by_pair(ends).min(axis=0)
            overlaps = np.where(lacking > 0, lacking + _END_ROOM_M, 0.0)
            edges = EdgeChecker(clearance.bound, self.margin, self._lipschitz_bounds, overlaps)
        if edges is None:
            return None
        is_unlimited = joint_space.is_unlimited(self.arm) & self.free
        scale = np.where(self.free, metric.scale, 0.0)
        return RouteSearch(edges, self.low, self.high, scale, is_unlimited, metric.name == "time")

    def extend_paths(
        self, metric: JointMetric, start: FloatArray, directions: FloatArray
    ) -> tuple[list[FloatArray], BoolArray]:
        """Extend paths from start (N, n) towards ``start + directions`` as far as possible, and return which of them arrive.

        An extension is one straight segment, or nothing. With constraints it has several pieces, each projected to the
        constraints, as long as each comes nearer to the end and is proved valid.
        """
        targets = start + directions
        if self.manifold is None:
            has_arrived = self.are_segments_valid(start, targets)
            return [
                target[None] if indices else start[:0] for target, indices in zip(targets, has_arrived, strict=True)
            ], has_arrived
        extensions, has_arrived = self.manifold.extend_paths(
            start,
            targets,
            metric.scale,
            has_largest_joint_metric=metric.name == "time",
            edges=self.edges,
            resolution=MIN_RESOLVED_MOTION_M,
        )
        if self.clearance is not None and self.edges is None:
            self._cut_blocked_extensions(start, extensions, has_arrived)
        return extensions, has_arrived

    def _cut_blocked_extensions(self, start: FloatArray, extensions: list[FloatArray], has_arrived: BoolArray) -> None:
        """Cut extensions from start (N, n) before the first piece that is not proved free."""
        first_points = [np.concatenate([point[None], points])[:-1] for point, points in zip(start, extensions, strict=True)]
        is_free = self.are_segments_valid(np.concatenate(first_points), np.concatenate(extensions))
        for index, is_piece_free in enumerate(np.split(is_free, np.cumsum([len(points) for points in extensions])[:-1])):
            if not is_piece_free.all():
                extensions[index] = extensions[index][: int(is_piece_free.argmin())]
                has_arrived[index] = False

    def _clearance_margins(self, q: FloatArray) -> FloatArray:
        """Return (N, P) the distance of every pair beyond the required one, m."""
        assert self.clearance is not None
        return np.asarray(self.clearance.by_pair(q) - self.clearance.margins - self.margin)

    def name_closest_pair(self, q: FloatArray) -> str:
        """Return the pair most often closest among the q (N, n) that are too close, as ``panda_joint4 & table``, or nothing."""
        if self.clearance is None:
            return ""
        pairs = self.clearance.closest_pair(q[self.clearance.margin_left(q) < self.margin])
        return self.clearance.pair_names[int(np.bincount(pairs).argmax())] if len(pairs) else ""

    def describe_obstruction(self, start: FloatArray, goal: FloatArray) -> str:
        """Name the pair that collides between a start (n,) and a goal (n,), a clause; empty if there is none."""
        pair = self.name_closest_pair(start + np.linspace(0, 1, 201)[:, None] * self.shortest_difference(goal, start))
        return f"; in the way of the straight line: {pair}" if pair else ""

    def shortest_difference(self, a: FloatArray, b: FloatArray) -> FloatArray:
        """Return ``a - b`` of the joints that move, in the shorter direction for joints without limits."""
        return np.where(self.free, joint_space.joint_difference(self.arm, a, b), 0.0)

    def sample(self, count: int, rng: np.random.Generator) -> FloatArray:
        """Sample random configurations (count, n) of the box."""
        return rng.uniform(self.low, self.high, (count, self.arm.n))
