"""Paths to a stow configuration on which a power loss drops the tool little."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from holdfast.control.falls.along import DropCurve, power_loss_along
from holdfast.control.falls.power_cut import power_loss
from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress, track
from holdfast.core.result import Result
from holdfast.core.status import Status
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.core.validation import check_arguments
from holdfast.response.recovery.space import FreeSpace, JointMetric
from holdfast.response.stowing.pose import StowPose, sample_with_stops

EDGE_SAMPLES = (10, 33)  # configurations of an edge whose falls are simulated: few at first, and more if these are admissible
NEIGHBOR_COUNT = 16
NEAR_LINE_RAD = 0.3  # rad or m: standard deviation of nodes about the straight line
SMALL_DROP_M = 1e-3  # added to every drop, so that a path without drops is short
CURVE_INSTANTS = 101
ROADMAP_STEP_S = 4e-3  # of the falls that rank nodes and edges
MOST_ROUNDS = 500
SPEED_FRACTIONS = (1.0, 0.5, 0.25, 0.125)


@dataclass(frozen=True, kw_only=True)
class StowPath(Result):
    """Path to a stow configuration, straight in joint space between waypoints, at the speed limits.

    That the drop stays below its bound was sampled, not proved. That the path is free of collisions is proved for the
    collision model.

    Attributes:
        stow: Stow configuration at the end.
        q: (K, n) waypoints, rad and m; (0, n) if no path was found.
        time: (K,) time at each waypoint, s.
        bound: Largest allowed drop, m: that from rest at the start, plus the tolerance.
        monotone: True if the drop exceeds no earlier drop by more than the tolerance.
        tolerance: Tolerance, m.
        curve: Drop for a power loss at instants of the motion along the path; None if no path was found.
        straight: The same for the straight line at full speed; None if the line is in collision.
        speed_fraction: Fraction of the speed limits at which the path was found: 1, 1/2, 1/4, or 1/8.
        nodes: Number of nodes of the roadmap.
        checked_edges: Number of checked edges of the roadmap.
    """

    stow: StowPose
    q: FloatArray
    time: FloatArray
    bound: float
    monotone: bool
    tolerance: float
    curve: DropCurve | None
    straight: DropCurve | None
    speed_fraction: float
    nodes: int
    checked_edges: int

    @property
    def is_found(self) -> bool:
        """True if a path was found."""
        return self.curve is not None


@check_arguments
@reports_progress("planning a path to the stow configuration")
def plan_stow_path(
    stow: StowPose,
    *,
    monotone: bool = False,
    tolerance: float = 0.01,
    nodes: int = 3000,
    duration: float = 2.0,
) -> StowPath:
    """Find the path from a start to a stow configuration with the smallest exposure in a roadmap.

    The exposure is the integral of the drop over time. Nowhere may the drop exceed that from rest at the start by more than
    the tolerance. The falls along the path begin with the joint rates of the motion, so a slower motion is searched if there is
    no path at full speed.

    Args:
        stow: Result of :func:`holdfast.stow` with a start.
        monotone: True to admit only paths on which the drop exceeds no earlier drop by more than the tolerance.
        tolerance: Tolerance of the drop, m.
        nodes: Number of nodes of the roadmap.
        duration: Duration of every simulated fall, s.

    Returns:
        A :class:`StowPath`, whose ``is_found`` is False if the roadmap contains no such path, which is no proof.

    Raises:
        InputError: A number is out of range, there is no start, or start or end is in collision.
    """
    start = stow.at
    if start is None or stow.speeds is None:
        raise InputError("the path needs a start; give it to stow as at (--start)")
    metric = JointMetric("time", 1 / stow.speeds)
    if not (np.isfinite(tolerance) and tolerance >= 0):
        raise InputError(f"tolerance is {tolerance:g} m; it must be a finite number of 0 or more")
    if nodes < 1:
        raise InputError(f"nodes is {nodes}; it must be 1 or more")
    if (start == stow.q).all():
        raise InputError("the arm is in its stow configuration already, so there is no path")
    roadmap = _Roadmap(stow, start, metric, tolerance, duration, monotone)
    if not roadmap.space.are_valid(np.stack([start, stow.q])).all():
        raise InputError("the start or the stow configuration is in collision; see the clearance")
    straight = roadmap.simulate_straight_line()
    roadmap.add_nodes(nodes)
    for speed_fraction in SPEED_FRACTIONS:
        roadmap.metric = JointMetric("time", metric.scale / speed_fraction)
        waypoints = roadmap.find_path()
        if len(waypoints):
            break
    return StowPath(
        stow=stow,
        q=waypoints,
        time=roadmap.metric.cumulative_length(waypoints) if len(waypoints) else np.zeros(0),
        bound=roadmap.bound,
        monotone=monotone,
        tolerance=float(tolerance),
        curve=roadmap.simulate_motion(waypoints) if len(waypoints) else None,
        straight=straight,
        speed_fraction=speed_fraction,
        nodes=len(roadmap.q),
        checked_edges=roadmap.checked_edges,
    )


class _Roadmap:
    """Configurations with their drops, and edges that are checked only if a shortest path contains them."""

    def __init__(
        self, stow: StowPose, start: FloatArray, metric: JointMetric, tolerance: float, duration: float, monotone: bool
    ) -> None:
        self.arm, self.metric, self.tolerance, self.monotone = stow.arm, metric, tolerance, monotone
        self.options: dict[str, Any] = {"friction": stow.friction, "clearance": stow.clearance, "duration": duration}
        self.q = np.stack([start, stow.q])  # the first two nodes are the ends of the path
        self.space = FreeSpace(stow.arm, np.ones(stow.arm.n, dtype=bool), stow.clearance, stow.margin, self.q)
        self.drop = self.simulate_drops(self.q)
        self.bound = float(self.drop[0]) + tolerance
        self.rng = np.random.default_rng(stow.seed)
        self.checked_edges = 0

    def simulate_drops(self, q: FloatArray, rates: FloatArray | None = None) -> FloatArray:
        """Return the drops (N,) after power losses in configurations (N, n), m; infinite if the simulation failed."""
        fall = power_loss(self.arm, q, rates, step=ROADMAP_STEP_S, **self.options)
        return np.where(fall.status == Status.OK, fall.drop, np.inf)

    def add_nodes(self, count: int) -> None:
        """Add random nodes whose drop respects the bound: anywhere, near the straight line, and in the box of both ends."""
        start, end = self.q[:2]
        fractions = self.rng.uniform(size=(count, self.arm.n))
        line = start + self.rng.uniform(size=(count, 1)) * (end - start)
        anywhere = sample_with_stops(self.rng, count, self.space.low, self.space.high)
        near_line = line + self.rng.normal(scale=NEAR_LINE_RAD, size=line.shape)
        staggered = np.where(fractions < 1 / 3, start, np.where(fractions < 2 / 3, end, line))
        kind = self.rng.integers(0, 3, (count, 1))
        q = np.clip(np.choose(kind, [anywhere, near_line, staggered]), self.space.low, self.space.high)
        q = np.unique(q[self.space.are_valid(q)], axis=0)
        q = q[(self.metric.measure_length(q[:, None] - self.q) > 0).all(axis=1)]
        drop = self.simulate_drops(q)
        is_low = drop <= self.bound
        self.q, self.drop = np.concatenate([self.q, q[is_low]]), np.concatenate([self.drop, drop[is_low]])

    def find_path(self) -> FloatArray:
        """Return the waypoints (K, n) of the path with the smallest exposure, or (0, n)."""
        first, second = self._edges
        edge_indices = {pair: index for index, pair in enumerate(zip(first.tolist(), second.tolist(), strict=True))}
        costs = self._estimate_costs(first, second)
        is_checked = np.zeros(len(first), dtype=bool)
        for _ in track("searches of the roadmap", range(MOST_ROUNDS), most=True):
            from scipy.sparse import csr_array
            from scipy.sparse.csgraph import dijkstra

            graph = csr_array((costs, (first, second)), shape=(len(self.q), len(self.q)))
            lengths, before = dijkstra(graph, indices=[0], return_predecessors=True)
            lengths, before = lengths[0], before[0]
            if not np.isfinite(lengths[1]):
                return self.q[:0]
            nodes = [1]
            while nodes[-1]:
                nodes.append(int(before[nodes[-1]]))
            nodes.reverse()
            edges = [edge_indices[pair] for pair in pairwise(nodes)]
            unchecked = np.array([edge for edge in edges if not is_checked[edge]], dtype=np.intp)
            if not unchecked.size:
                rising = self._find_rising_piece(self.q[nodes]) if self.monotone else None
                if rising is None:
                    return self.q[nodes] if self.monotone else self._shorten(self.q[nodes])
                costs[edges[rising]] = np.inf
                continue
            costs[unchecked] = self.check_edges(self.q[first[unchecked]], self.q[second[unchecked]])
            is_checked[unchecked] = True
        return self.q[:0]

    def _find_rising_piece(self, q: FloatArray) -> int | None:
        """Return the piece of a path (K, n) on which the drop first exceeds an earlier drop by more than the tolerance."""
        drops = self._simulate_samples(q[:-1], q[1:], EDGE_SAMPLES[-1])
        rises = drops.ravel() - np.minimum.accumulate(drops.ravel())
        return int(np.argmax(rises > self.tolerance)) // EDGE_SAMPLES[-1] if (rises > self.tolerance).any() else None

    @cached_property
    def _edges(self) -> tuple[IndexArray, IndexArray]:
        """First and second nodes (E,) of the collision-free edges between near nodes, which do not depend on the speed."""
        scaled = self.q * self.metric.scale
        from scipy.spatial import KDTree

        neighbors = KDTree(scaled).query(scaled, k=min(NEIGHBOR_COUNT, len(scaled)), p=np.inf)[1]
        first, second = np.repeat(np.arange(len(scaled)), neighbors.shape[1]), neighbors.ravel()
        pairs = np.unique(np.concatenate([[first, second], [second, first], [[0], [1]]], axis=1), axis=1)
        pairs = pairs[:, pairs[0] != pairs[1]]
        if self.monotone:
            pairs = pairs[:, self.drop[pairs[1]] <= self.drop[pairs[0]] + self.tolerance]
        pairs = pairs[:, self.space.are_segments_valid(self.q[pairs[0]], self.q[pairs[1]])]
        return pairs[0], pairs[1]

    def _estimate_costs(self, first: IndexArray, second: IndexArray) -> FloatArray:
        times = self.metric.measure_length(self.q[second] - self.q[first])
        return np.asarray(times * ((self.drop[first] + self.drop[second]) / 2 + SMALL_DROP_M))

    def check_edges(self, first: FloatArray, second: FloatArray) -> FloatArray:
        """Return the exposures (E,) of collision-free edges from and to (E, n), m s; infinite if a drop is too large."""
        self.checked_edges += len(first)
        costs, rows = np.full(len(first), np.inf), np.arange(len(first))
        for sample_count in EDGE_SAMPLES:
            exposures = self._sample_exposures(first[rows], second[rows], sample_count)
            rows, exposures = rows[np.isfinite(exposures)], exposures[np.isfinite(exposures)]
        costs[rows] = exposures
        return costs

    def _sample_exposures(self, first: FloatArray, second: FloatArray, sample_count: int) -> FloatArray:
        """Return the exposures (E,) from falls at samples of each edge; infinite if one of them exceeds its bound."""
        drops, times = self._simulate_samples(first, second, sample_count), self.metric.measure_length(second - first)
        is_low = drops.max(axis=1, initial=-np.inf) <= self.bound
        if self.monotone:
            is_low &= (drops - np.minimum.accumulate(drops, axis=1)).max(axis=1, initial=0) <= self.tolerance
        return np.where(is_low, times * (np.maximum(drops, 0).mean(axis=1) + SMALL_DROP_M), np.inf)

    def _simulate_samples(self, first: FloatArray, second: FloatArray, sample_count: int) -> FloatArray:
        """Return the drops (E, sample_count) on edges, after power losses during motions at the speed limits, m."""
        fractions = np.linspace(0, 1, sample_count)[:, None]
        samples = first[:, None] + fractions * (second - first)[:, None]
        samples = np.clip(samples, self.space.low, self.space.high)  # against rounding at a limit
        times = self.metric.measure_length(second - first)
        rates = np.broadcast_to(((second - first) / times[:, None])[:, None], samples.shape)
        return self.simulate_drops(samples.reshape(-1, self.arm.n), rates.reshape(-1, self.arm.n)).reshape(-1, sample_count)

    def _shorten(self, q: FloatArray) -> FloatArray:
        """Return the best path over a subset of the waypoints."""
        pairs = np.array([(i, k) for i in range(len(q)) for k in range(i + 1, len(q))])
        pairs = pairs[self.space.are_segments_valid(q[pairs[:, 0]], q[pairs[:, 1]])]
        costs = self.check_edges(q[pairs[:, 0]], q[pairs[:, 1]])
        best, before = np.full(len(q), np.inf), np.zeros(len(q), dtype=int)
        best[0] = 0
        for (i, k), cost in zip(pairs, costs, strict=True):  # sorted by i, so best[i] is final
            if best[i] + cost < best[k]:
                best[k], before[k] = best[i] + cost, i
        nodes = [len(q) - 1]
        while nodes[-1]:
            nodes.append(int(before[nodes[-1]]))
        return q[nodes[::-1]]

    def simulate_straight_line(self) -> DropCurve | None:
        """Simulate power losses along the straight line between both ends, or return None if it is in collision."""
        is_clear = self.space.are_segments_valid(self.q[:1], self.q[1:2])[0]
        return self.simulate_motion(self.q[:2]) if is_clear else None

    def simulate_motion(self, waypoints: FloatArray) -> DropCurve:
        """Simulate power losses along the motion through distinct waypoints (K, n) at the speed limits."""
        times = self.metric.cumulative_length(waypoints)
        instants = np.linspace(0, times[-1], CURVE_INSTANTS)
        piece = np.clip(np.searchsorted(times, instants, side="right") - 1, 0, len(times) - 2)
        rates = np.diff(waypoints, axis=0) / np.diff(times)[:, None]
        q = waypoints[piece] + (instants - times[piece])[:, None] * rates[piece]
        q = np.clip(q, self.space.low, self.space.high)
        return power_loss_along(self.arm, q, instants, rates=rates[piece], refine=False, **self.options)
