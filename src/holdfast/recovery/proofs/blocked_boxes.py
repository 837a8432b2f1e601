"""Boxes of joints in which the arm certainly touches something: of a proof that a pose has no clear configuration."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.clearance.capsules import BASE
from holdfast.clearance.clearance import Clearance

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_SLACK = 1e-9  # m: rounding
_TOUCH = 2e-6  # m: what the exact sign may not see of two links
_WIDEST = 0.08  # rad and m: where half of the joints move more, hardly a link is deeper in anything than it moves


class BlockedBoxes:
    """Which boxes are blocked: something is deeper in something else, at the middle, than it can move.

    Objects: a ball within a link. From the link inwards: a point of it is no farther from axis k than the link's origin is, and
    the ball about that holds the link, and what joints beyond k move it. Links among themselves, where capsules are all that is
    known of them, so that nothing of a capsule is outside of its body: their depth, and the most by which any joint changes it
    (:meth:`Clearance.changes`). Where capsules cover bodies, that the arm blocks itself is left aside.

    Args:
        clearance: Of an arm, maybe in a cell.
        margin: m, kept beyond what the cell keeps from its objects.
        limits: (n,) and (n,), what all boxes lie within, rad and m; the arm's if not given.
    """

    def __init__(self, clearance: Clearance, margin: float, limits: tuple[Array, Array] | None = None) -> None:
        seen, (self._inner, solids) = clearance.obstacles, clearance.exactness.inner
        self._arm, self._names, self._met = clearance.arm, [solid.name for solid in solids], set[str]()
        self._margins = np.array([margin + seen.cell.margin_of(solid) for solid in solids]) if seen else np.zeros(0)
        balls = self._inner.balls
        self._links = np.unique(balls.link[balls.link > BASE])
        away = np.linalg.norm(balls.centre, axis=1) + balls.radius
        self._size = np.array([away[balls.link == link].max() for link in self._links])
        self._axes = np.array([joint.axis for joint in self._arm.joints])
        own = len(clearance.capsules) - clearance.capsules.held
        bare = clearance.capsules.shape is None
        self._alone, self._margin = clearance.alone, margin
        self._pairs = np.array([k for k, pair in enumerate(clearance.pairs) if bare and max(pair) < own], dtype=np.intp)
        self._slopes = self._alone.changes(*(limits or finite_limits(self._arm)))[self._pairs]

    def __call__(self, q: Array, half: Array) -> Flags:
        """(N,) True where everything within ``half`` (N, n) of q (N, n) is blocked."""
        found = np.zeros(len(q), dtype=bool)
        some = np.flatnonzero(np.sort(half, axis=1)[:, half.shape[1] // 2] < _WIDEST)
        if self._pairs.size:
            found[some] = self._by_itself(q[some], half[some])
        if self._links.size and self._margins.size:
            some = some[~found[some]]
            found[some] = self._within_objects(q[some], half[some])
        return found

    def _by_itself(self, q: Array, half: Array) -> Flags:
        least = self._alone.by_pair(q)[:, self._pairs] + half @ self._slopes.T
        deep = least.min(axis=1, initial=np.inf) < self._margin - _TOUCH
        self._met |= {self._alone.pair_names[self._pairs[k]] for k in np.unique(least[deep].argmin(axis=1))}
        return np.asarray(deep)

    def _within_objects(self, q: Array, half: Array) -> Flags:
        found = np.zeros(len(q), dtype=bool)
        every = self._inner.distances(q) - self._margins
        some = np.flatnonzero((every < -_SLACK).any(axis=(1, 2)))
        every = every[some]
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
        self._met |= {self._names[k] for k in np.unique(nearest[deep])}
        return found

    @property
    def what(self) -> str:
        """What blocked a box so far: objects, and pairs of links, by name."""
        return ", ".join(sorted(self._met))
