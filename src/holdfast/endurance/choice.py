"""The motion over the nodes of a path that gathers most: dynamic programming."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.endurance.grid import Nodes, squared_distances
from holdfast.notice import each
from holdfast.solvers import joint_space

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.int64]

_ALIKE = 1e-12  # of all that can be gathered: less is rounding


class Front:
    """The best motions up to a pose, one to each of its nodes; of equals the shortest, by its squared steps.

    Attributes:
        extra: How much farther than allowed a joint may go from pose to pose, rad and m.
        ended: The last pose to which any motion leads, if it is not the last of all.
    """

    def __init__(self, gain: Array, extra: float, alike: float) -> None:
        self.extra, self._alike = extra, alike
        self.ended: int | None = None
        self._total, self._way = gain, np.zeros(len(gain))
        self._came: list[Index] = []
        self._moves: list[Flags] = []
        self._reached = [np.ones(len(gain), dtype=bool)]

    def advance(self, far: Array, beyond: Array, gain: Array) -> None:
        """To the next pose: squared distances of its nodes (Q, P), how far beyond what is allowed these are, and gains (Q,)."""
        if self.ended is not None:
            return
        allowed = beyond <= self.extra
        gathered = np.where(allowed, self._total, -np.inf)
        most = gathered.max(axis=1)
        if not np.isfinite(most).any():
            self.ended = len(self._came)
            return
        price = np.where(gathered >= most[:, None] - self._alike, self._way + far, np.inf)
        source = price.argmin(axis=1)
        self._total, self._way = most + gain, price[np.arange(len(gain)), source]
        self._came.append(source)
        self._moves.append(allowed)
        self._reached.append(np.isfinite(most))

    def on_motions(self) -> list[Flags]:
        """(P,) for each pose: which of its nodes lie on a motion through all poses."""
        alive = [self._reached[-1]]
        for moves, reached in zip(reversed(self._moves), reversed(self._reached[:-1]), strict=True):
            alive.append(reached & moves[alive[-1]].any(axis=0))
        return alive[::-1]

    def motion(self) -> Index:
        """The node of every pose (T,)."""
        best = np.flatnonzero(self._total >= self._total.max() - self._alike)
        chosen = [int(best[self._way[best].argmin()])]
        for source in reversed(self._came):
            chosen.append(int(source[chosen[-1]]))
        return np.array(chosen[::-1])


def best_motions(arm: Arm, nodes: list[Nodes], gains: list[Array], limit: Array, extras: Sequence[float]) -> list[Front]:
    """Motions through all poses that gather most.

    Args:
        arm: The arm.
        nodes: Of each pose.
        gains: (P,) what each node of each pose is worth.
        limit: (n,) largest motion of each joint from pose to pose, rad and m; infinite where none is known.
        extras: Each on top of it.
    """
    alike = _ALIKE * sum(float(g.max()) for g in gains)
    fronts = [Front(gains[0], extra, alike) for extra in extras]
    for a, b, gain in each("poses", list(zip(nodes[:-1], nodes[1:], gains[1:], strict=True)), whole=True):
        far = squared_distances(b.flat, a.flat)
        beyond = _beyond(arm, b, a, far, limit)
        for front in fronts:
            front.advance(far, beyond, gain)
    return fronts


def _beyond(arm: Arm, b: Nodes, a: Nodes, far: Array, limit: Array) -> Array:
    """(Q, P) how much farther than allowed a joint goes; of joints whose limit nobody knows the whole move must be short."""
    beyond = np.full(far.shape, -np.inf)
    for x, y, most, turns in zip(b.q.T, a.q.T, limit, joint_space.turning(arm), strict=True):
        if np.isfinite(most):
            moved = np.abs(x[:, None] - y)
            moved = np.abs(np.remainder(moved + np.pi, 2 * np.pi) - np.pi) if turns else moved
            np.maximum(beyond, moved - most, out=beyond)
    if not np.isfinite(limit).all():
        nearest = np.sqrt(far.min(axis=0))
        beyond[far > (3 * a.span + 2 * float(np.median(nearest))) ** 2] = np.inf
    return beyond
