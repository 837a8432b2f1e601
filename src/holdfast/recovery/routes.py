"""The shortest route found through joint space: straight if nothing is in between, else two growing trees, then cut short."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.clearance.clearance import Clearance
from holdfast.errors import InputError
from holdfast.notice import each
from holdfast.solvers import joint_space

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
MetricName = Literal["travel", "time"]

FINEST = 5e-4  # m of possible motion between what could collide: what cannot be told clear at this is taken as blocked
_BATCH = 48  # samples a round
_ROUNDS = 200
_NODES = 12_000  # of both trees together
_REACH = 0.15  # of the diagonal of the box: length of one step of a tree
_CUTS = 64  # shortcuts tried a round
_IDLE = 8  # rounds without a gain before the way counts as short


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
    """

    def __init__(self, arm: Arm, free: Flags, clearance: Clearance | None, margin: float, around: Array) -> None:
        self.arm, self.free, self.margin = arm, free, margin
        self._until = np.inf
        self.clearance = clearance if clearance is not None and clearance.pair_names else None
        low, high = finite_limits(arm)
        self.low = np.where(free, np.minimum(low, around.min(axis=0)), around[0])
        self.high = np.where(free, np.maximum(high, around.max(axis=0)), around[0])
        # Joints that turn may wind beyond the box, no bound below depends on their values; slides may not.
        self._lower = np.where(arm.prismatic, self.low, arm.lower)
        self._upper = np.where(arm.prismatic, self.high, arm.upper)
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
        """(N,) True where configurations (N, n) keep limits and clearance."""
        if self.clearance is None:
            return self.inside(q)
        return np.asarray(self.inside(q) & (self._gaps(q).min(axis=1) >= 0))

    def edges(self, a: Array, b: Array) -> Flags:
        """(E,) True where the whole straight piece from a to b (E, n) is proved to keep limits and clearance.

        Between two configurations at which a pair is d_1 and d_2 away, it comes no closer than ``(d_1 + d_2 - L) / 2``, L the
        most that its distance can change on the way (:meth:`Clearance.changes`). Pieces for which that does not do are
        halved, until it does or L is below half a millimetre: such a piece counts as blocked.
        """
        if self.clearance is None or not len(a):
            return np.asarray(self.inside(a) & self.inside(b))
        assert self._slopes is not None
        free: Flags = self.inside(a) & self.inside(b)
        change = np.abs(b - a) @ self._slopes.T
        edge = np.arange(len(a))
        start, end = np.zeros(len(a)), np.ones(len(a))
        first, last = self._gaps(a), self._gaps(b)
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
            gaps = self._gaps(a[edge] + middle[:, None] * (b - a)[edge])
            free[edge[gaps.min(axis=1) < 0]] = False
            edge = np.concatenate([edge, edge])
            start, end = np.concatenate([start, middle]), np.concatenate([middle, end])
            first, last = np.concatenate([first, gaps]), np.concatenate([gaps, last])

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

    def difference(self, a: Array, b: Array) -> Array:
        """``a - b`` of the joints that move, the short way round where they turn without limits."""
        return np.where(self.free, joint_space.difference(self.arm, a, b), 0.0)

    def sample(self, count: int, rng: np.random.Generator) -> Array:
        """Random configurations (count, n) of the box."""
        return rng.uniform(self.low, self.high, (count, self.arm.n))


@dataclass(frozen=True)
class Route:
    """A route from a configuration to one of several goals, straight in joint space from waypoint to waypoint.

    Attributes:
        q: (K, n) waypoints, rad and m.
        length: Of the metric, its unit ``s`` or ``rad``.
        lower_bound: No route to any of the goals is shorter: the straight line to the nearest of them.
        goal: Which goal it leads to.
        straight: It is one straight line.
    """

    q: Array
    length: float
    lower_bound: float
    goal: int
    straight: bool


def find_route(space: Space, metric: Metric, start: Array, goals: Array, tries: int, rng: np.random.Generator) -> Route | None:
    """The shortest route found from start (n,) to any of the goals (G, n), or None; all of them must be clear.

    Straight lines to all goals first. Goals that could be nearer than the nearest one with a free line are then tried by
    trees that grow from both sides (RRT-Connect, Kuffner and LaValle 2000, here in batches), several times, and
    what is found is cut short. No more is tried once a quarter of the searches found nothing.
    """
    goals = start + space.difference(goals, start)
    direct = metric.length(goals - start)
    bound = float(direct.min())
    order = np.argsort(direct, kind="stable")
    open_ = np.flatnonzero(space.edges(np.repeat(start[None], len(goals), axis=0), goals)[order])
    best: Route | None = None
    vain = 0
    if open_.size:
        k = int(order[open_[0]])
        best = Route(np.stack([start, goals[k]]), float(direct[k]), bound, k, True)
    for _ in each("searches for a route", range(tries), most=True):
        length = np.inf if best is None else best.length
        some = np.flatnonzero(direct < length * (1 - 1e-9))
        if not some.size or space.spent or vain >= in_vain(tries):
            break
        found = _connect(space, metric, start, goals[some], rng)
        if found is None:
            vain += 1
            continue
        q, goal = found
        q = shortened(space, metric, q, rng)
        total = float(metric.along(q)[-1])
        if total < length:
            best = Route(q, total, bound, int(some[goal]), len(q) == 2)
    return best


def in_vain(tries: int) -> int:
    """After how many searches without a route, of so many tries, no more are made.

    Of 385 searches (planar-3r among four spheres, the Panda at a bench) that found a route in one of six tries, all found it in
    the first: what is not found then is most often not there.
    """
    return max(1, tries // 4)


class _Tree:
    """Configurations that can be reached from the roots, and from which one each."""

    def __init__(self, space: Space, metric: Metric, roots: Array) -> None:
        self._space, self._metric = space, metric
        self._turning = joint_space.turning(space.arm) & space.free
        self.nodes = roots.copy()
        self.parent = np.full(len(roots), -1)
        self._points = self._embedded(roots)

    def _embedded(self, q: Array) -> Array:
        """Points (N, e) whose distances order configurations as the metric does, nearly: a revolute joint is a circle."""
        flat = (q * self._metric.scale)[:, self._space.free & ~self._turning]
        scale = self._metric.scale[self._turning]
        turned = q[:, self._turning]
        return np.concatenate([flat, scale * np.cos(turned), scale * np.sin(turned)], axis=1)

    def add(self, nodes: Array, parents: NDArray[np.intp]) -> NDArray[np.intp]:
        first = len(self.nodes)
        self.nodes = np.concatenate([self.nodes, nodes])
        self.parent = np.concatenate([self.parent, parents])
        self._points = np.concatenate([self._points, self._embedded(nodes)])
        return np.arange(first, len(self.nodes))

    def nearest(self, q: Array) -> tuple[NDArray[np.intp], Array]:
        """Which node is nearest to each q (N, n), and ``q`` less that node (N, n)."""
        to, own = self._embedded(q), self._points
        index = ((own**2).sum(axis=1) - 2 * to @ own.T).argmin(axis=1)
        return index, self._space.difference(q, self.nodes[index])

    def way(self, k: int) -> list[int]:
        """Nodes from k to its root."""
        out = [k]
        while self.parent[out[-1]] >= 0:
            out.append(int(self.parent[out[-1]]))
        return out


def _connect(space: Space, metric: Metric, start: Array, goals: Array, rng: np.random.Generator) -> tuple[Array, int] | None:
    """A route from start (n,) to one of the goals (G, n) and which, or None after the last round."""
    here, there = _Tree(space, metric, start[None]), _Tree(space, metric, goals)
    reach = _REACH * float(metric.length(np.where(space.free, space.high - space.low, 0.0)))
    forward = True
    for _ in each("rounds of a search for a route", range(_ROUNDS), most=True):
        if len(here.nodes) + len(there.nodes) > _NODES or space.spent:
            break
        grown, other = (here, there) if forward else (there, here)
        index, away = grown.nearest(space.sample(_BATCH, rng))
        step = _shortened_step(metric, away, reach)
        made = grown.nodes[index] + step
        good = space.edges(grown.nodes[index], made)
        new = grown.add(made[good], index[good])
        met = _meet(space, metric, grown, other, new, reach)
        if met is not None:
            return _joined(space, here, there, met if forward else met[::-1])
        forward = not forward
    return None


def _shortened_step(metric: Metric, away: Array, reach: float) -> Array:
    length = metric.length(away)
    return np.asarray(away * np.minimum(1.0, reach / np.maximum(length, 1e-12))[:, None])


def _meet(
    space: Space, metric: Metric, grown: _Tree, other: _Tree, new: NDArray[np.intp], reach: float
) -> tuple[int, int] | None:
    """Grows the other tree towards new nodes step by step until one gets there: the two nodes that meet."""
    target = new
    while target.size:
        index, away = other.nearest(grown.nodes[target])
        step = _shortened_step(metric, away, reach)
        made = other.nodes[index] + step
        good = space.edges(other.nodes[index], made)
        arrived = good & (metric.length(away) <= reach)
        if arrived.any():
            k = int(np.flatnonzero(arrived)[0])
            return int(target[k]), int(index[k])
        other.add(made[good], index[good])
        target = target[good]
    return None


def _joined(space: Space, here: _Tree, there: _Tree, met: tuple[int, int]) -> tuple[Array, int]:
    a, b = met
    first, second = here.way(a)[::-1], there.way(b)
    last = here.nodes[a]
    # The trees may meet a turn apart: the rest of the way is moved by whole turns.
    shift = last + space.difference(there.nodes[b], last) - there.nodes[b]
    return np.concatenate([here.nodes[first], there.nodes[second] + shift]), second[-1]


def shortened(space: Space, metric: Metric, q: Array, rng: np.random.Generator) -> Array:
    """The way q (K, n) cut short: straight pieces between random points of it, as long as that gains."""
    idle = 0
    while len(q) > 2 and idle < _IDLE and not space.spent:
        at = metric.along(q)
        ends = np.sort(rng.uniform(0, at[-1], (_CUTS, 2)), axis=1)
        # Some whole pieces too: from waypoint to waypoint.
        ends[: _CUTS // 4] = np.sort(rng.choice(at, (_CUTS // 4, 2)), axis=1)
        a, b = (_point(q, at, s) for s in ends.T)
        gain = ends[:, 1] - ends[:, 0] - metric.length(b - a)
        some = np.flatnonzero(gain > 1e-6 * at[-1])
        some = some[space.edges(a[some], b[some])]
        if not some.size:
            idle += 1
            continue
        k = some[gain[some].argmax()]
        idle = idle + 1 if gain[k] < 1e-4 * at[-1] else 0
        before, after = at < ends[k, 0] - 1e-12, at > ends[k, 1] + 1e-12
        q = np.concatenate([q[before], a[k][None], b[k][None], q[after]])
        q = q[np.concatenate([[True], metric.length(np.diff(q, axis=0)) > 1e-12])]
    return _without_needless(space, metric, q)


def _point(q: Array, at: Array, s: Array) -> Array:
    """Points (N, n) of the way at lengths s (N,)."""
    return np.stack([np.interp(s, at, column) for column in q.T], axis=1)


def _without_needless(space: Space, metric: Metric, q: Array) -> Array:
    """Waypoints left out that make the way no shorter."""
    k = 1
    while k < len(q) - 1:
        around = metric.length(q[k + 1] - q[k - 1])
        through = metric.length(q[k] - q[k - 1]) + metric.length(q[k + 1] - q[k])
        if around <= through + 1e-12 and space.edges(q[k - 1][None], q[k + 1][None])[0]:
            q = np.delete(q, k, axis=0)
        else:
            k += 1
    return q
