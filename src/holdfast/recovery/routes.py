"""The shortest route found through joint space: straight if nothing is in between, else two growing trees, then cut short."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.notice import each
from holdfast.recovery.space import Metric, Space
from holdfast.solvers import joint_space

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.intp]

_BATCH = 48  # samples a round
_ROUNDS = 200
_NODES = 12_000  # of both trees together
_REACH = 0.15  # of the diagonal of the box: length of one step of a tree
_APART = 5  # pieces of a walk from one node to the next
_CUTS = 64  # shortcuts tried a round
_WALKS = 24  # the same where rows are kept exactly
_QUIET = 20  # rounds of a tree in which hardly a walk leads to where it is not yet: it fills all that it can get to
_FRESH = 0.2  # of the reach, how far from every node of its tree a walk must lead to count
_FEW = 4  # walks that do so in these rounds, of 960
_MAX_SEARCHED = 8  # goals that are searched for one by one
_IDLE = 8  # rounds without a gain before the way counts as short


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


def find_route(
    space: Space, metric: Metric, start: Array, goals: Array, tries: int, rng: np.random.Generator, *, vain: int | None = None
) -> Route | None:
    """The shortest route found from start (n,) to any of the goals (G, n), or None; all of them must be clear.

    Straight lines to all goals first. Goals that could be nearer than the nearest one with a free line are then tried by
    trees that grow from both sides (RRT-Connect, Kuffner and LaValle 2000, here in batches), several times, and
    what is found is cut short. Where rows are kept, every line is a walk along them (:meth:`Space.walk`), as in CBiRRT
    (Berenson, Srinivasa, Ferguson and Kuffner 2009). If none is found because one of the trees fills all that it can get to,
    twice, :attr:`Space.closed_in` says which. No more is tried once ``vain`` searches found nothing, if that is said.
    """
    goals = start + space.difference(goals, start)
    direct = metric.length(goals - start)
    bound = float(direct.min())
    order = np.argsort(direct, kind="stable")
    open_ = np.flatnonzero(space.edges(np.repeat(start[None], len(goals), axis=0), goals)[order])
    best: Route | None = None
    closed_in, lost = list[str](), 0
    if open_.size:
        k = int(order[open_[0]])
        best = Route(np.stack([start, goals[k]]), float(direct[k]), bound, k, True)
    elif space.manifold is not None:
        ways, whole = space.walk(metric, np.repeat(start[None], len(goals), axis=0), goals - start)
        walked = [(np.concatenate([start[None], ways[goal]]), goal) for goal in np.flatnonzero(whole).tolist()]
        if walked:
            q, goal = min(walked, key=lambda way: float(metric.along(way[0])[-1]))
            q = shortened(space, metric, q, rng)
            best = Route(q, float(metric.along(q)[-1]), bound, goal, False)
    for _ in each("searches for a route", range(tries), most=True):
        length = np.inf if best is None else best.length
        some = np.flatnonzero(direct < length * (1 - 1e-9))
        if not some.size or space.spent or (best is not None and space.manifold is not None):
            break  # along rows that are kept a search takes long, and the bound hardly tells how much shorter a way could be
        if space.manifold is None and lost == vain:
            break
        found = _connect(space, metric, start, goals[some], rng)
        closed_in.append(space.closed_in)
        if all(closed_in[-2:]) and len(closed_in) > 1:
            return None
        if found is None:
            lost += not space.closed_in
            continue
        q, goal = found
        q = shortened(space, metric, q, rng)
        total = float(metric.along(q)[-1])
        if total < length:
            best = Route(q, total, bound, int(some[goal]), len(q) == 2)
    space.closed_in = ""
    return best


def reachable_goals(space: Space, metric: Metric, start: Array, goals: Array, rng: np.random.Generator) -> Flags:
    """(G,) True for those goals (G, n) to which a motion from start (n,) was found, straight or by one search each."""
    goals = start + space.difference(goals, start)
    found = space.walk(metric, np.repeat(start[None], len(goals), axis=0), goals - start)[1]
    for _ in range(_MAX_SEARCHED):
        fresh = found.copy()
        while fresh.any() and not found.all():  # what can be got to from what was just found
            away = np.flatnonzero(~found)
            near = metric.length(goals[away, None] - goals[fresh][None]).argmin(axis=1)
            begin = goals[fresh][near]
            fresh = np.zeros_like(found)
            fresh[away] = space.walk(metric, begin, goals[away] - begin)[1]
            found |= fresh
        route = None if found.all() or space.spent else find_route(space, metric, start, goals[~found], 1, rng)
        if route is None:
            break
        found[np.flatnonzero(~found)[route.goal]] = True
    return found


class _Tree:
    """Configurations that can be reached from the roots, and from which one each."""

    def __init__(self, space: Space, metric: Metric, roots: Array) -> None:
        self._space, self._metric = space, metric
        self._turning = joint_space.turning(space.arm) & space.free
        self.nodes = roots.copy()
        self.parent = np.full(len(roots), -1)
        self._between: dict[int, Array] = {}
        self._points = self._embedded(roots)

    def _embedded(self, q: Array) -> Array:
        """Points (N, e) whose distances order configurations as the metric does, nearly: a revolute joint is a circle."""
        flat = (q * self._metric.scale)[:, self._space.free & ~self._turning]
        scale = self._metric.scale[self._turning]
        turned = q[:, self._turning]
        return np.concatenate([flat, scale * np.cos(turned), scale * np.sin(turned)], axis=1)

    def grow(self, ways: list[Array], parents: Indices) -> Indices:
        """Adds ways (k, n) from parents, those of no length left out; the last nodes of the others."""
        nodes, above, last = list[Array](), list[int](), list[int]()
        for way, parent in zip(ways, parents.tolist(), strict=True):
            for k in range(0, len(way), _APART):
                piece = way[k : k + _APART]
                new = len(self.nodes) + len(nodes)
                if len(piece) > 1:
                    self._between[new] = piece[:-1]
                nodes.append(piece[-1])
                above.append(parent)
                parent = new
            if len(way):
                last.append(parent)
        if nodes:
            self.nodes = np.concatenate([self.nodes, nodes])
            self.parent = np.concatenate([self.parent, above])
            self._points = np.concatenate([self._points, self._embedded(np.stack(nodes))])
        return np.array(last, dtype=np.intp)

    def nearest(self, q: Array) -> tuple[NDArray[np.intp], Array]:
        """Which node is nearest to each q (N, n), and ``q`` less that node (N, n)."""
        to, own = self._embedded(q), self._points
        index = ((own**2).sum(axis=1) - 2 * to @ own.T).argmin(axis=1)
        return index, self._space.difference(q, self.nodes[index])

    def way(self, k: int) -> tuple[Array, int]:
        """Configurations (K, n) from node k back to its root, and which root that is."""
        out, root = [], k
        while k >= 0:
            out += [self.nodes[k][None], self._between.get(k, self.nodes[:0])[::-1]]
            root, k = k, int(self.parent[k])
        return np.concatenate(out), root


def _connect(space: Space, metric: Metric, start: Array, goals: Array, rng: np.random.Generator) -> tuple[Array, int] | None:
    """A route from start (n,) to one of the goals (G, n) and which, or None after the last round."""
    here, there = _Tree(space, metric, start[None]), _Tree(space, metric, goals)
    reach = _REACH * float(metric.length(np.where(space.free, space.high - space.low, 0.0)))
    space.closed_in = ""
    forward, fresh = True, {id(here): list[int](), id(there): list[int]()}
    for _ in each("rounds of a search for a route", range(_ROUNDS), most=True):
        if len(here.nodes) + len(there.nodes) > _NODES or space.spent:
            break
        grown, other = (here, there) if forward else (there, here)
        index, away = grown.nearest(space.sample(_BATCH, rng))
        ways, _ = space.walk(metric, grown.nodes[index], _shortened_step(metric, away, reach))
        if space.manifold is not None:
            counts = fresh[id(grown)]
            counts.append(_fresh_ends(metric, grown, ways, reach))
            if len(counts) >= _QUIET and sum(counts[-_QUIET:]) <= _FEW:
                space.closed_in = "start" if forward else "goal"
                break
        new = grown.grow(ways, index)
        met = _meet(space, metric, grown, other, new, reach)
        if met is not None:
            return _joined(space, here, there, met if forward else met[::-1])
        forward = not forward
    return None


def _fresh_ends(metric: Metric, tree: _Tree, ways: list[Array], reach: float) -> int:
    """How many ways end far from everything that the tree holds."""
    ends = [way[-1] for way in ways if len(way)]
    return int((metric.length(tree.nearest(np.stack(ends))[1]) > _FRESH * reach).sum()) if ends else 0


def _shortened_step(metric: Metric, away: Array, reach: float) -> Array:
    length = metric.length(away)
    return np.asarray(away * np.minimum(1.0, reach / np.maximum(length, 1e-12))[:, None])


def _meet(space: Space, metric: Metric, grown: _Tree, other: _Tree, new: Indices, reach: float) -> tuple[int, int] | None:
    """Grows the other tree towards new nodes step by step until one gets there: the two nodes that meet."""
    target, walks = new, space.manifold is not None
    while target.size:
        index, away = other.nearest(grown.nodes[target])
        ways, whole = space.walk(metric, other.nodes[index], away if walks else _shortened_step(metric, away, reach))
        arrived = whole if walks else whole & (metric.length(away) <= reach)
        if arrived.any():
            k = int(np.flatnonzero(arrived)[0])
            last = other.grow([ways[k][:-1]], index[k : k + 1])
            return int(target[k]), int(last[0] if last.size else index[k])
        other.grow(ways, index)
        target = target[:0] if walks else target[whole]
    return None


def _joined(space: Space, here: _Tree, there: _Tree, met: tuple[int, int]) -> tuple[Array, int]:
    (first, _), (second, root) = here.way(met[0]), there.way(met[1])
    # The trees may meet a turn apart: the rest of the way is moved by whole turns.
    shift = first[0] + space.difference(second[0], first[0]) - second[0]
    return np.concatenate([first[::-1], second + shift]), root


def shortened(space: Space, metric: Metric, q: Array, rng: np.random.Generator) -> Array:
    """The way q (K, n) cut short: straight pieces between random points of it, as long as that gains."""
    if space.manifold is not None and space.manifold.thin:
        return _without_needless(space, _walked_shorter(space, metric, q, rng))
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
    return _without_needless(space, q)


def _walked_shorter(space: Space, metric: Metric, q: Array, rng: np.random.Generator) -> Array:
    """The same where rows are kept exactly: walks along them from waypoint to waypoint."""
    idle = 0
    while len(q) > 2 and idle < _IDLE and not space.spent:
        at = metric.along(q)
        first, last = np.sort(rng.integers(0, len(q), (_WALKS, 2)), axis=1).T
        ways, whole = space.walk(metric, q[first], q[last] - q[first])
        gain = np.zeros(_WALKS)
        for k in np.flatnonzero(whole).tolist():
            gain[k] = at[last[k]] - at[first[k]] - metric.along(np.concatenate([q[first[k]][None], ways[k]]))[-1]
        k = int(gain.argmax())
        idle = idle + 1 if gain[k] < 1e-3 * at[-1] else 0
        if gain[k] > 1e-6 * at[-1]:
            q = np.concatenate([q[: first[k] + 1], ways[k], q[last[k] + 1 :]])
    return q


def _point(q: Array, at: Array, s: Array) -> Array:
    """Points (N, n) of the way at lengths s (N,)."""
    return np.stack([np.interp(s, at, column) for column in q.T], axis=1)


def _without_needless(space: Space, q: Array) -> Array:
    """Waypoints left out that no proof needs: without one the way is no longer."""
    k = 1
    while k < len(q) - 1:
        if space.edges(q[k - 1][None], q[k + 1][None])[0]:
            q = np.delete(q, k, axis=0)
        else:
            k += 1
    return q
