"""The motion over the nodes of a path that gathers most: dynamic programming."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.endurance.grid import Nodes, squared_distances
from holdfast.notice import each
from holdfast.solvers import joint_space

Array = NDArray[np.float64]
Index = NDArray[np.int64]

_ALIKE = 1e-12  # of all that can be gathered: less is rounding
_DENSE = 1 << 20  # moves between the nodes of two poses that are all looked at; of more, those nearby are found by a tree


@dataclass(frozen=True, eq=False)
class Moves:
    """The M moves from the nodes of a pose to those of the next that are short enough, in order of where they lead.

    Attributes:
        to, source: (M,) nodes.
        far: (M,) squared distances.
        beyond: (M,) how much farther than allowed a joint goes, rad and m; below 0 where none does.
    """

    to: Index
    source: Index
    far: Array
    beyond: Array


class Front:
    """The best motions up to a pose, one to each of its nodes; of equals the shortest, by its squared steps.

    Attributes:
        gains: (P,) what each node of each pose is worth.
        extra: How much farther than allowed a joint may go from pose to pose, rad and m.
        ended: The last pose to which any motion leads, if it is not the last of all.
    """

    def __init__(self, gains: list[Array], extra: float = 0.0) -> None:
        self.gains, self.extra = gains, extra
        self.ended: int | None = None
        self._alike = _ALIKE * sum(float(g.max()) for g in gains)
        self._total, self._way = gains[0], np.zeros(len(gains[0]))
        self._came: list[Index] = []

    def advance(self, moves: Moves) -> None:
        """To the next pose."""
        if self.ended is not None:
            return
        gain = self.gains[len(self._came) + 1]
        kept = (moves.beyond <= self.extra) & np.isfinite(self._total[moves.source])
        to, source = moves.to[kept], moves.source[kept]
        if not to.size:
            self.ended = len(self._came)
            return
        gathered = self._total[source]
        most = _largest(gathered, to, len(gain))
        good = gathered >= most[to] - self._alike
        to, source = to[good], source[good]
        price = self._way[source] + moves.far[kept][good]
        least = -_largest(-price, to, len(gain))
        came = np.zeros(len(gain), dtype=np.int64)
        cheapest = np.flatnonzero(price == least[to])[::-1]
        came[to[cheapest]] = source[cheapest]  # what is written last stays: the first
        self._total, self._way = most + gain, least
        self._came.append(came)

    @property
    def most(self) -> float:
        """What the best motion gathers; NaN if none leads to the last pose."""
        return float(self._total.max()) if self.ended is None else float("nan")

    def motion(self) -> Index:
        """The node of every pose (T,)."""
        best = np.flatnonzero(self._total >= self._total.max() - self._alike)
        chosen = [int(best[self._way[best].argmin()])]
        for source in reversed(self._came):
            chosen.append(int(source[chosen[-1]]))
        return np.array(chosen[::-1])


def advanced(arm: Arm, nodes: list[Nodes], limit: Array, fronts: Sequence[Front]) -> None:
    """Brings fronts from the first pose to the last.

    Args:
        arm: The arm.
        nodes: Of each pose.
        limit: (n,) largest motion of each joint from pose to pose, rad and m; infinite where none is known.
        fronts: At the first pose.
    """
    extra = max(front.extra for front in fronts)
    for a, b in each("poses", list(pairwise(nodes)), whole=True):
        moves = _moves(arm, b, a, limit, extra)
        for front in fronts:
            front.advance(moves)


def _largest(values: Array, group: Index, groups: int) -> Array:
    """(G,) the largest value of each group (M,), which come in order; -inf of one without any."""
    most = np.full(groups, -np.inf)
    if group.size:
        first = np.flatnonzero(np.diff(group, prepend=-1))
        most[group[first]] = np.maximum.reduceat(values, first)
    return most


def _moves(arm: Arm, b: Nodes, a: Nodes, limit: Array, extra: float) -> Moves:
    """Those from a to b that go no farther than that beyond the limits; of joints without one the whole move must be short."""
    if len(a.q) * len(b.q) <= _DENSE:
        squares = squared_distances(b.flat, a.flat)
        most = _short(a, np.sqrt(squares.min(axis=0)), limit)
        to, source = (x.ravel() for x in np.indices(squares.shape))
        far, beyond = squares.ravel(), _beyond(arm, b.q[:, None], a.q[None], limit).ravel()
    else:
        from scipy.spatial import KDTree

        most = _short(a, np.asarray(KDTree(b.flat).query(a.flat)[0]), limit)
        to, source = _within(arm, b.q, a.q, np.where(np.isfinite(limit), limit + extra, np.pi / 2 * most))
        far, beyond = ((b.flat[to] - a.flat[source]) ** 2).sum(axis=1), _beyond(arm, b.q[to], a.q[source], limit)
    some = (beyond <= extra) & (far <= most**2)
    return Moves(to[some], source[some], far[some], beyond[some])


def _short(a: Nodes, nearest: Array, limit: Array) -> float:
    """How long a move may be where a joint has no limit; ``nearest`` (P,) is how far the next pose is from each node."""
    return np.inf if np.isfinite(limit).all() else 3 * a.span + 2 * float(np.median(nearest))


def _beyond(arm: Arm, q: Array, before: Array, limit: Array) -> Array:
    """(...) how much farther than allowed a joint goes, at most, from ``before`` to q (..., n)."""
    beyond = np.full(np.broadcast_shapes(q.shape, before.shape)[:-1], -np.inf)
    for k in np.flatnonzero(np.isfinite(limit)):
        moved = np.abs(q[..., k] - before[..., k])
        if joint_space.turning(arm)[k]:
            moved = np.abs(np.remainder(moved + np.pi, 2 * np.pi) - np.pi)
        np.maximum(beyond, moved - limit[k], out=beyond)
    return beyond


def _within(arm: Arm, b: Array, a: Array, reach: Array) -> tuple[Index, Index]:
    """Which of b (Q, n) and a (P, n) are apart by no more than ``reach`` (n,) in any joint, in order."""
    from scipy.spatial import KDTree

    wide = reach * (1 + 1e-9)
    boxes = np.where(joint_space.turning(arm), 2 * np.pi * (1 + 1e-12) / wide, 0.0)  # rounding stays inside
    trees = [KDTree(joint_space.folded(arm, x) / wide, boxsize=boxes) for x in (b, a)]
    found = trees[0].sparse_distance_matrix(trees[1], 1.0, p=np.inf, output_type="ndarray")
    order = np.lexsort((found["j"], found["i"]))
    return found["i"][order], found["j"][order]
