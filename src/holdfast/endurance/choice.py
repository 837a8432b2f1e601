"""The motion over the nodes of a path that gathers most: dynamic programming."""

from __future__ import annotations

from collections.abc import Sequence
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

    def advance(self, far: Array, beyond: Array) -> None:
        """To the next pose: squared distances of its nodes (Q, P), and how far beyond what is allowed these are."""
        if self.ended is not None:
            return
        gain = self.gains[len(self._came) + 1]
        gathered = np.where(beyond <= self.extra, self._total, -np.inf)
        most = gathered.max(axis=1)
        if not np.isfinite(most).any():
            self.ended = len(self._came)
            return
        price = np.where(gathered >= most[:, None] - self._alike, self._way + far, np.inf)
        source = price.argmin(axis=1)
        self._total, self._way = most + gain, price[np.arange(len(gain)), source]
        self._came.append(source)

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
    for a, b in each("poses", list(pairwise(nodes)), whole=True):
        far = squared_distances(b.flat, a.flat)
        beyond = _beyond(arm, b, a, far, limit)
        for front in fronts:
            front.advance(far, beyond)


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
