"""Boxes of joints in which the arm certainly touches something: of a proof that a pose has no clear configuration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.clearance.capsules import BASE, Capsule, Capsules
from holdfast.clearance.changes import changes_between
from holdfast.clearance.clearance import Clearance

if TYPE_CHECKING:
    from holdfast.clearance.exact.meetings import Part

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_SLACK = 1e-9  # m: rounding
_TOUCH = 2e-6  # m: what the exact sign may not see of two links
_WIDEST = 0.08  # rad and m: where half of the joints move more, hardly a link is deeper in anything than it moves


class BlockedBoxes:
    """Which boxes are blocked: something is deeper in something else, at the middle, than it can move.

    Objects: a ball within a link. From the link inwards: a point of it is no farther from axis k than the link's origin is, and
    the ball about that holds the link, and what joints beyond k move it. Links among themselves: two capsules where these are
    all that is known of them, else two balls within their bodies; and the most by which any joint changes their distance
    (:func:`holdfast.clearance.changes.changes_between`).

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
        self._alone, self._margin = clearance.alone, margin
        self._own = _own_pairs(clearance, limits or finite_limits(self._arm))

    def __call__(self, q: Array, half: Array) -> Flags:
        """(N,) True where everything within ``half`` (N, n) of q (N, n) is blocked."""
        found = np.zeros(len(q), dtype=bool)
        some = np.flatnonzero(np.sort(half, axis=1)[:, half.shape[1] // 2] < _WIDEST)
        if self._own:
            found[some] = self.by_itself(q[some], half[some])
        if self._links.size and self._margins.size:
            some = some[~found[some]]
            found[some] = self._within_objects(q[some], half[some])
        return found

    def by_itself(self, q: Array, half: Array) -> Flags:
        """(N,) True where everything within ``half`` (N, n) of q (N, n) is blocked by the arm alone."""
        found, every = np.zeros(len(q), dtype=bool), self._alone.by_pair(q)
        for own in self._own:
            some = np.flatnonzero(~found & (every[:, own.columns].min(axis=1) < self._margin))
            least = own.distances(self._arm, q[some], every[some]) + half[some] @ own.slopes.T
            deep = (least < self._margin - _TOUCH).any(axis=1)
            found[some] = deep
            if deep.any():
                self._met.add(own.name)
        return found

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


@dataclass(frozen=True, eq=False)
class _Own:
    """Two links.

    Attributes:
        name: Of their first pair.
        columns: Their pairs of the clearance.
        slopes: (K, n) most by which each of K distances changes per rad or m of each joint.
        balls: Links, (K, 3) centres in their frames, and (K,) radii, both together, of balls within them; none if the distances
            are those of the pairs.
    """

    name: str
    columns: list[int]
    slopes: Array
    balls: tuple[int, int, Array, Array, Array] | None = None

    def distances(self, arm: Arm, q: Array, every: Array) -> Array:
        """(N, K) at q (N, n), of all pairs ``every`` (N, P)."""
        if self.balls is None:
            return every[:, self.columns]
        a, b, one, other, radii = self.balls
        frames = arm.frames(q)
        (p, r), (s, t) = ((frames[:, k + 1, :3, 3], frames[:, k + 1, :3, :3]) for k in (a, b))
        away = (p - s)[:, None] + one @ r.transpose(0, 2, 1) - other @ t.transpose(0, 2, 1)
        return np.asarray(np.linalg.norm(away, axis=2) - radii)


def _own_pairs(clearance: Clearance, limits: tuple[Array, Array]) -> list[_Own]:
    """Links that may touch each other, and what is certainly within them."""
    found, arm, capsules = [], clearance.arm, clearance.capsules
    if capsules.shape is None:
        slopes, own = clearance.alone.changes(*limits), len(capsules) - capsules.held
        known = clearance.exactness.parts_known
        pairs = [k for k, pair in enumerate(clearance.pairs) if known and max(pair) < own]
        return [_Own(clearance.pair_names[k], [k], slopes[[k]]) for k in pairs]
    parts = clearance.exactness.parts
    for columns, bodies in clearance.exactness.own_bodies:
        balls = [
            (Capsule(parts[a].link, tuple(x), tuple(x), radius=r), Capsule(parts[b].link, tuple(y), tuple(y), radius=s))
            for a, b in bodies
            if columns and parts[a].known and parts[b].known and not (parts[a].held or parts[b].held)
            for x, r in _within(parts[a])
            for y, s in _within(parts[b])
        ]
        if balls:
            made = Capsules(tuple(ball for pair in balls for ball in pair))
            slopes = changes_between(arm, made, [(2 * k, 2 * k + 1) for k in range(len(balls))], *limits)
            one, other = (np.array([pair[k].start for pair in balls]) for k in (0, 1))
            radii = np.array([x.radius + y.radius for x, y in balls])
            ends = balls[0][0].link, balls[0][1].link
            found.append(_Own(clearance.pair_names[columns[0]], columns, slopes, (*ends, one, other, radii)))
    return found


def _within(part: Part) -> list[tuple[Array, float]]:
    """Centres (3,) in the frame of the link and radii, m, of balls within a body."""
    centres, radii = part.body.inside
    centres = centres @ part.body.pose[:3, :3].T + part.body.pose[:3, 3]
    return list(zip(centres, radii.tolist(), strict=True))
