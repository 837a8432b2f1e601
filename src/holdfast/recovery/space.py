"""Joint space as a failed arm has it: how long a way through it is, where the arm may be, and which pieces are proved."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.clearance.clearance import Clearance
from holdfast.errors import InputError
from holdfast.keep.kept import Kept
from holdfast.keep.manifold import Manifold
from holdfast.solvers import joint_space

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
MetricName = Literal["travel", "time"]

FINEST = 5e-4  # m of possible motion between what could collide: what cannot be told clear at this is taken as blocked
_WALKED = 400  # pieces of one walk at most
_NEARER = 0.1  # of a piece, by which it must come nearer to where it goes


@dataclass(frozen=True)
class Metric:
    """How long a route through joint space is.

    Attributes:
        name: ``travel``: the Euclidean length of the joints' motion, each joint times its scale. ``time``: every straight
            piece at the velocity limit of its slowest joint, accelerations left aside.
        scale: (n,) of each joint: its weight (1 rad counts as 1 m), or 1 over its velocity limit.
    """

    name: MetricName
    scale: Array

    @classmethod
    def of(cls, arm: Arm, name: MetricName, weights: Array | None, free: Flags) -> Metric:
        """Of an arm with its healthy joints (n,).

        Raises:
            InputError: An unknown name, weights that are not n positive numbers, or time without velocity limits.
        """
        if name not in ("travel", "time"):
            raise InputError(f"metric '{name}' is not known; use 'travel' or 'time'")
        if name == "time":
            speed = np.array([j.velocity for j in arm.joints])
            lost = [arm.joint_names[k] for k in np.flatnonzero(free & ~(np.isfinite(speed) & (speed > 0)))]
            if lost:
                raise InputError(f"metric 'time' needs velocity limits, and joint '{lost[0]}' has none; use metric 'travel'")
            if weights is not None:
                raise InputError("weights go with metric 'travel'; for 'time' the velocity limits are the weights")
            return cls(name, np.where(free, 1.0 / np.where(free, speed, 1.0), 1.0))
        scale = np.ones(arm.n) if weights is None else np.asarray(weights, dtype=np.float64)
        if scale.shape != (arm.n,) or not (np.isfinite(scale).all() and (scale > 0).all()):
            raise InputError(f"weights must be {arm.n} finite numbers above 0, one per joint")
        return cls(name, scale)

    @property
    def unit(self) -> str:
        """``s``, or ``rad`` (1 m of a slide counts as 1 rad)."""
        return "s" if self.name == "time" else "rad"

    def length(self, d: Array) -> Array:
        """Of differences (..., n)."""
        scaled = d * self.scale
        return np.asarray(np.abs(scaled).max(axis=-1) if self.name == "time" else np.linalg.norm(scaled, axis=-1))

    def along(self, q: Array) -> Array:
        """(K,) length of the way q (K, n) up to each of its points."""
        return np.concatenate([[0.0], np.cumsum(self.length(np.diff(q, axis=0)))])


class Space:
    """Where the failed arm may be: within the limits, and no closer to itself and its cell than asked.

    Args:
        arm: The arm.
        free: (n,) joints that move.
        clearance: Whose room is kept at least at ``margin``, m; None: nothing is in the way but the limits.
        margin: m.
        around: (K, n) configurations that the box of samples must hold.
        keep: What is kept of the tool's pose, through the pose at the start.

    Attributes:
        manifold: Where that is kept; None if nothing is.
        closed_in: ``start`` or ``goal`` if what was searched from there could not grow; see :func:`find_route`.
    """

    def __init__(
        self, arm: Arm, free: Flags, clearance: Clearance | None, margin: float, around: Array, *, keep: Sequence[Kept] = ()
    ) -> None:
        self.arm, self.free, self.margin = arm, free, margin
        self._until = np.inf
        self.closed_in: Literal["", "start", "goal"] = ""
        self.clearance = clearance if clearance is not None and clearance.pair_names else None
        low, high = finite_limits(arm)
        self.low = np.where(free, np.minimum(low, around.min(axis=0)), around[0])
        self.high = np.where(free, np.maximum(high, around.max(axis=0)), around[0])
        # Joints that turn may wind beyond the box, no bound below depends on their values; slides may not.
        self._lower = np.where(arm.prismatic, self.low, arm.lower)
        self._upper = np.where(arm.prismatic, self.high, arm.upper)
        limits = np.where(free, self._lower, around[0]), np.where(free, self._upper, around[0])
        self.manifold = Manifold(arm, keep, free, limits) if keep else None
        self._slopes = None if self.clearance is None else self.clearance.changes(self.low, self.high)

    def stop_after(self, seconds: float) -> None:
        """From now on :attr:`spent` is true once so many seconds have gone."""
        self._until = time.monotonic() + seconds

    @property
    def seconds_left(self) -> float:
        """For searches; infinite without a limit."""
        return max(self._until - time.monotonic(), 0.0)

    @property
    def spent(self) -> bool:
        """The time for searches is over."""
        return self.seconds_left == 0

    def inside(self, q: Array) -> Flags:
        """(N,) True within the limits, locked joints left aside."""
        return np.asarray((((q >= self._lower) & (q <= self._upper)) | ~self.free).all(axis=-1))

    def clear(self, q: Array) -> Flags:
        """(N,) True where configurations (N, n) keep limits, rows and clearance."""
        good = self.inside(q)
        if self.manifold is not None and good.any():
            good[good] = self.manifold.holds(q[good])
        if self.clearance is not None and good.any():
            good[good] = self._gaps(q[good]).min(axis=1) >= 0
        return good

    def edges(self, a: Array, b: Array, away: Array | None = None) -> Flags:
        """(E,) True where the whole straight piece from a to b (E, n) is proved to keep limits, rows and clearance.

        With ``away`` (E, n) also everything whose joints are off it by no more, limits left aside.

        Between two configurations at which a pair is d_1 and d_2 away, it comes no closer than ``(d_1 + d_2 - L) / 2``, L the
        most that its distance can change on the way (:meth:`Clearance.changes`). Pieces for which that does not do are
        halved, until it does or L is below half a millimetre: such a piece counts as blocked.
        """
        free: Flags = self.inside(a) & self.inside(b)
        if self.manifold is not None and free.any():
            free[free] = self.manifold.edges(a[free], b[free], None if away is None else away[free])
        if self.clearance is None or not free.any():
            return free
        assert self._slopes is not None
        change = np.abs(b - a) @ self._slopes.T
        less = 0 * change if away is None else away @ self._slopes.T
        edge = np.arange(len(a))
        start, end = np.zeros(len(a)), np.ones(len(a))
        first, last = self._gaps(a) - less, self._gaps(b) - less
        free &= (first.min(axis=1) >= 0) & (last.min(axis=1) >= 0)
        while True:
            most = change[edge] * (end - start)[:, None]
            open_ = free[edge] & ((first + last - most).min(axis=1) < 0)
            hopeless = open_ & (most.max(axis=1) < FINEST)
            free[edge[hopeless]] = False
            keep = open_ & free[edge]
            if not keep.any():
                return free
            edge, start, end, first, last = (x[keep] for x in (edge, start, end, first, last))
            middle = (start + end) / 2
            gaps = self._gaps(a[edge] + middle[:, None] * (b - a)[edge]) - less[edge]
            free[edge[gaps.min(axis=1) < 0]] = False
            edge = np.concatenate([edge, edge])
            start, end = np.concatenate([start, middle]), np.concatenate([middle, end])
            first, last = np.concatenate([first, gaps]), np.concatenate([gaps, last])

    def walk(self, metric: Metric, start: Array, away: Array) -> tuple[list[Array], Flags]:
        """Ways from start (N, n) towards ``start + away``, as far as they get, and which of them get there.

        A way is one straight piece, or nothing; where rows are kept it goes in pieces, each brought back to the rows, as long
        as it comes nearer and is proved.
        """
        end = start + away
        if self.manifold is None:
            whole = self.edges(start, end)
            return [x[None] if good else start[:0] for x, good in zip(end, whole, strict=True)], whole
        pieces: list[list[Array]] = [[] for _ in start]
        kept = self.manifold.holds(end)
        here, whole, some = start.copy(), np.zeros(len(start), dtype=bool), np.arange(len(start))
        for _ in range(_WALKED):
            left = end[some] - here[some]
            far = metric.length(left)
            more = far > 0
            some, left, far = some[more], left[more], far[more]
            if not some.size or self.spent:
                break
            stride = self.manifold.stride(left)
            step = left * stride[:, None]
            there = (stride == 1) & kept[some]
            made = np.where(there[:, None], end[some], self.manifold.projected(here[some] + step))
            nearer = far - metric.length(end[some] - made) > _NEARER * metric.length(step)
            good = np.flatnonzero(nearer)
            good = good[self.edges(here[some[good]], made[good])]
            for k in good:
                pieces[some[k]].append(made[k])
            whole[some[good]] = there[good]
            here[some[good]] = made[good]
            some = some[good[~there[good]]]
        return [np.array(way) if way else start[:0] for way in pieces], whole

    def _gaps(self, q: Array) -> Array:
        """(N, P) distance of every pair beyond what must be kept, m."""
        assert self.clearance is not None
        return np.asarray(self.clearance.by_pair(q) - self.clearance.margins - self.margin)

    def nearest(self, q: Array) -> str:
        """The pair that most often is nearest, of those q (N, n) that are too close: ``panda_joint4 & table``, or nothing."""
        if self.clearance is None:
            return ""
        pairs = self.clearance.closest_pair(q[self.clearance.room(q) < self.margin])
        return self.clearance.pair_names[int(np.bincount(pairs).argmax())] if len(pairs) else ""

    def in_the_way(self, start: Array, goal: Array) -> str:
        """Name what a straight line from a start (n,) to a goal (n,) meets, a clause; empty if it meets nothing."""
        pair = self.nearest(start + np.linspace(0, 1, 201)[:, None] * self.difference(goal, start))
        return f"; in the way of the straight line: {pair}" if pair else ""

    def difference(self, a: Array, b: Array) -> Array:
        """``a - b`` of the joints that move, the short way round where they turn without limits."""
        return np.where(self.free, joint_space.difference(self.arm, a, b), 0.0)

    def sample(self, count: int, rng: np.random.Generator) -> Array:
        """Random configurations (count, n) of the box."""
        return rng.uniform(self.low, self.high, (count, self.arm.n))
