"""Boxes of joints in which the arm certainly is within an object: of a proof that a pose has no clear configuration."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.clearance.capsules import BASE
from holdfast.clearance.clearance import Clearance

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_SLACK = 1e-9  # m: rounding
_WIDEST = 0.08  # rad and m: where half of the joints move more, hardly a link is deeper in an object than it moves


class WithinObjects:
    """Which boxes are blocked: a ball within a link, at the middle, is deeper in an object than the link can move.

    From the link inwards: a point of it is no farther from axis k than the link's origin is, and the ball about that holds the
    link, and what joints beyond k move it. That the arm blocks itself is left aside.

    Args:
        clearance: Of an arm in a cell.
        margin: m, kept beyond what the cell keeps from its objects.
    """

    def __init__(self, clearance: Clearance, margin: float) -> None:
        seen, (self._inner, solids) = clearance.obstacles, clearance.exactness.inner
        self._arm, self._names, self._met = clearance.arm, [solid.name for solid in solids], set[int]()
        self._margins = np.array([margin + seen.cell.margin_of(solid) for solid in solids]) if seen else np.zeros(0)
        balls = self._inner.balls
        self._links = np.unique(balls.link[balls.link > BASE])
        away = np.linalg.norm(balls.centre, axis=1) + balls.radius
        self._size = np.array([away[balls.link == link].max() for link in self._links])
        self._axes = np.array([joint.axis for joint in self._arm.joints])

    def __call__(self, q: Array, half: Array) -> Flags:
        """(N,) True where everything within ``half`` (N, n) of q (N, n) is blocked."""
        found = np.zeros(len(q), dtype=bool)
        if not self._links.size or not self._margins.size:
            return found
        some = np.flatnonzero(np.sort(half, axis=1)[:, half.shape[1] // 2] < _WIDEST)
        every = self._inner.distances(q[some]) - self._margins
        deep = (every < -_SLACK).any(axis=(1, 2))
        some, every = some[deep], every[deep]
        nearest, room = every.argmin(axis=2), every.min(axis=2)
        half, frames = half[some], self._arm.frames(q[some])
        origins, turns = frames[:, 1:-1, :3, 3], np.einsum("nkij,kj->nki", frames[:, 1:-1, :3, :3], self._axes)
        places, moved = frames[:, self._links + 1][:, :, :3, 3], np.zeros_like(room)
        for k in range(self._arm.n - 1, -1, -1):
            far = np.ones_like(moved)
            if not self._arm.prismatic[k]:
                far = np.linalg.norm(np.cross(places - origins[:, k, None], turns[:, k, None]), axis=2) + self._size + moved
            moved += np.where(self._links >= k, far * half[:, k, None], 0.0)
        deep = room + moved < -_SLACK
        found[some] = deep.any(axis=1)
        self._met |= set(nearest[deep].tolist())
        return found

    @property
    def objects(self) -> str:
        """Those that blocked a box so far, by name."""
        return ", ".join(dict.fromkeys(self._names[k] for k in sorted(self._met)))
