"""How near a motion is to what it keeps clear of: limits of the rates at every step, and what is nearest along the whole."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.objects.one_row import OneRow

Array = NDArray[np.float64]

ROWS = 2  # that a step keeps: what is nearest, and what was a moment ago
_NEVER = -1e9  # m/s: less than any rate makes of a distance
_FAR = 0.05  # rad and m: so far a slope is taken to hold
_ALIKE = 0.05  # of a slope: nearer ones are of one thing
_KEPT = 6  # slopes that are remembered
_SLACK = 2e-5  # m: a step along something round is off by its square, and the next one makes up for it
_PARTS = (1.0, 0.5)  # of a step that are tried before none of it


@dataclass(frozen=True, eq=False)
class Near:
    """What a motion keeps clear of, at N instants.

    Attributes:
        room: (N,) smallest distance beyond what is to be kept, the margin included, m.
        pair: (N,) position in ``names`` of the pair that has it.
        names: Of the pairs, ``joint3 & table``.
        kept: (P,) what is kept of each pair, m.
    """

    room: Array
    pair: NDArray[np.int64]
    names: list[str]
    kept: Array


class Room:
    """The room that a motion has beyond what it keeps, and how fast it may shrink.

    One pair is the nearest, and its slope jumps where another gets nearer: in a corner the motion would go to and fro between
    the two. So the slopes of the last moments are remembered, and each is a limit of its own as long as the arm is near by.

    Args:
        clearance: What is looked at.
        margin: Kept beyond its own margins, m.
        rate: The room may shrink by this share of itself in a second, 1/s.
    """

    def __init__(self, clearance: Clearance, margin: float, rate: float) -> None:
        self.clearance, self.margin, self.rate = clearance, margin, rate
        self._nearest = OneRow(clearance)
        self._steepest = clearance.changes(*finite_limits(clearance.arm)).max(axis=0, initial=0.0)
        self._seen: list[tuple[Array, float, Array]] = []

    def _look(self, q: Array) -> tuple[Array, float, Array]:
        """The configuration (n,), its room and the slope of that (n,); remembered, the latest first."""
        if self._seen and np.array_equal(self._seen[0][0], q):
            return self._seen[0]
        room, slope = self._nearest(q)
        found = (q.copy(), room - self.margin, slope)
        others = [x for x in self._seen if np.abs(x[0] - q).max() < _FAR and not _alike(x[2], found[2])]
        self._seen = [found, *others[: _KEPT - 1]]
        return found

    def idle(self, q: Array, rates: Array) -> bool:
        """Whether nothing that was seen last can be near enough to limit these rates (n,): then nothing is looked at."""
        if not self._seen:
            return False
        where, room, _ = self._seen[0]
        least = room - float(self._steepest @ np.abs(q - where))
        return float(self._steepest @ np.abs(rates)) < self.rate * least

    def limits(self, q: Array) -> Array:
        """(K, n + 1) the limits at a configuration (n,): slopes, and after each the least that the rates may make of it, m/s.

        The first is what is nearest, the second what is nearest of the things that were seen a moment ago; one at least is
        of something, and slopes of 0 limit nothing.
        """
        first = self._look(q)
        around = sorted(((room + float(slope @ (q - where)), slope) for where, room, slope in self._seen[1:]), key=_room)
        seen = [(first[1], first[2]), *around, (np.inf, np.zeros(len(q)))]
        return np.array([np.append(slope, max(-self.rate * room, _NEVER)) for room, slope in seen])

    def part(self, q: Array, moved: Array) -> float:
        """How much of a step from one configuration (n,) to another the room allows: all, unless it is used up on the way."""
        before = self._look(q)
        for part in _PARTS:
            if self._look(q + part * (moved - q))[1] >= min(before[1], -_SLACK):
                return part
        self._seen = [before, *self._seen[: _KEPT - 1]]
        return 0.0

    def along(self, q: Array) -> Near:
        """What is nearest at configurations (N, n)."""
        clearance = self.clearance
        return Near(
            clearance.room(q) - self.margin, clearance.closest_pair(q), clearance.pair_names, clearance.margins + self.margin
        )


def _room(seen: tuple[float, Array]) -> float:
    return seen[0]


def _alike(one: Array, other: Array) -> bool:
    return float(np.linalg.norm(one - other)) <= _ALIKE * float(np.linalg.norm(other))
