"""The fastest way through pieces within speeds and accelerations: time-optimal path parametrisation on a grid.

With ``x`` the square of the path's speed and ``u = x' / 2`` its acceleration, constant in each interval of the grid, the
joints' accelerations ``q' u + q'' x`` are linear in s within an interval of a parabola: what holds at both ends holds between
them. Backwards, the greatest ``x`` from which the rest can be done; forwards, as fast as that allows (Pham and Pham 2018,
TOPP-RA, with both ends of every interval kept). A straight line is one interval: accelerate, cruise, decelerate, exactly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.recovery.timing.rounding import Pieces

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.intp]

_FINE, _COARSE, _ALL = 32, 4, 1600  # intervals of a parabola, at least, and of all of them
_ROUND = 1e-12  # of a bound, for corners of the polygon of what is allowed


@dataclass(frozen=True)
class Profile:
    """How fast a way is passed through: G intervals, in each of which its acceleration is constant.

    Attributes:
        piece: (G,) of the way.
        s: (G,) where in that piece an interval begins.
        speed, acceleration: (G,) of the way as it begins, and all through it.
        time: (G + 1,) s, when they begin, and the end.
    """

    piece: Indices
    s: Array
    speed: Array
    acceleration: Array
    time: Array

    def at(self, pieces: Pieces, time: Array) -> tuple[Array, Array, Array]:
        """Places, speeds and accelerations (N, c) at times (N,), s."""
        k = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.s) - 1)
        t = time - self.time[k]
        rate = self.speed[k] + self.acceleration[k] * t
        q, slope, bend = pieces.at(self.piece[k], self.s[k] + t * (self.speed[k] + rate) / 2)
        return q, slope * rate[:, None], bend * rate[:, None] ** 2 + slope * self.acceleration[k][:, None]


def fastest(pieces: Pieces, v: Array, a: Array) -> Profile:
    """From standstill to standstill, within speeds v and accelerations a (n,) above 0, these finite of joints that move."""
    grid = _Grid(pieces, v, a)
    most = grid.backwards()
    return grid.profile(grid.forwards(most))


class _Grid:
    """Intervals of the way, with what is allowed in each."""

    def __init__(self, pieces: Pieces, v: Array, a: Array) -> None:
        n = len(v)
        bent = np.abs(pieces.bend[:, :n]).max(axis=1) > 0
        count = np.where(bent, np.clip(_ALL // max(int(bent.sum()), 1), _COARSE, _FINE), 1)
        self.piece = np.repeat(np.arange(len(count)), count)
        k = np.arange(len(self.piece)) - np.repeat(np.cumsum(count) - count, count)
        self.length = (pieces.length / count)[self.piece]
        self.s = k * self.length
        self.straight = ~bent[self.piece]
        _, first, self._bend = (x[:, :n] for x in pieces.at(self.piece, self.s))
        self._first, self._last = first, first + self.length[:, None] * self._bend
        with np.errstate(divide="ignore"):
            slope = np.maximum(np.abs(self._first), np.abs(self._last))
            self.cap = np.where(slope > 0, v / np.where(slope > 0, slope, 1.0), np.inf).min(axis=1) ** 2
            self.most = np.where(slope > 0, a / np.where(slope > 0, slope, 1.0), np.inf).min(axis=1)
        stops = np.append(pieces.stops[self.piece] & (k == 0), True)
        self.caps = np.where(stops, 0.0, np.minimum(np.append(np.inf, self.cap), np.append(self.cap, np.inf)))
        self._a = a

    def _rows(self, k: int) -> Array:
        """(R, 2) of what is allowed at the ends x and y of a bent interval: ``rows @ (x, y) <= 1``."""
        bend, step = self._bend[k] / self._a, 1 / (2 * self.length[k])
        first, last = step * self._first[k] / self._a, step * self._last[k] / self._a
        begin, end = np.column_stack([bend - first, first]), np.column_stack([-last, bend + last])
        rows = np.concatenate([begin, -begin, end, -end])
        return np.asarray(rows[np.abs(rows).max(axis=1) > 0])

    def backwards(self) -> Array:
        """(G + 1,) the greatest squares of the speed from which the rest of the way can be done."""
        most = self.caps.copy()
        for k in range(len(self.s) - 1, -1, -1):
            if self.straight[k]:
                most[k] = min(most[k], most[k + 1] + 2 * self.most[k] * self.length[k])
            elif most[k] > 0:
                most[k] = _greatest(self._rows(k), float(most[k]), float(most[k + 1]))
        return most

    def forwards(self, most: Array) -> Array:
        """(G + 1,) the squares of the speed, each as great as those before it allow."""
        x = most.copy()
        for k in range(len(self.s)):
            if self.straight[k]:
                x[k + 1] = min(x[k + 1], x[k] + 2 * self.most[k] * self.length[k])
                continue
            rows = self._rows(k)
            up = rows[rows[:, 1] > 0]
            x[k + 1] = max(min(float(x[k + 1]), float(((1 - up[:, 0] * x[k]) / up[:, 1]).min(initial=np.inf))), 0.0)
        return x

    def profile(self, x: Array) -> Profile:
        """With these squares of the speed at the ends of the intervals, slowed by what rounding took too much of."""
        over = [float((self._rows(k) @ x[k : k + 2]).max(initial=0.0)) for k in np.flatnonzero(~self.straight).tolist()]
        x = x / max([1.0, *over])
        piece, s, speed, acceleration, steps = [], [], [], [], []
        for k, length in enumerate(self.length):
            first, last = float(x[k]), float(x[k + 1])
            parts = [(length, last, (last - first) / (2 * length))]
            if self.straight[k]:
                parts = _trapezoid(first, last, float(length), float(self.most[k]), float(self.cap[k]))
            at = float(self.s[k])
            for part, end, rate in parts:
                piece.append(self.piece[k])
                s.append(at)
                speed.append(np.sqrt(first))
                steps.append(2 * part / (np.sqrt(first) + np.sqrt(end)))
                acceleration.append(rate)
                at, first = at + part, end
        time = np.concatenate([[0.0], np.cumsum(steps)])
        return Profile(np.array(piece), np.array(s), np.array(speed), np.array(acceleration), time)


def _trapezoid(first: float, last: float, length: float, most: float, cap: float) -> list[tuple[float, float, float]]:
    """Parts of a straight line, each with its length, the square of the speed as it ends, and the acceleration."""
    top = min((first + last) / 2 + most * length, cap)
    rise, fall = (top - first) / (2 * most), (top - last) / (2 * most)
    parts = [(rise, top, most), (length - rise - fall, top, 0.0), (fall, last, -most)]
    return [part for part in parts if part[0] > 1e-15 * length]


def _greatest(rows: Array, cap: float, after: float) -> float:
    """The greatest x up to ``cap`` for which some y from 0 to ``after`` has ``rows @ (x, y) <= 1``; (0, 0) is allowed."""
    # In units of the bounds, so that one rounding fits all.
    unit = np.array([cap, after if after > 0 else 1.0])
    if not np.isfinite(cap):
        unit[0] = 1 / np.abs(rows[:, 0]).max()
    bounds = np.array([[1.0 if np.isfinite(cap) else 0.0, 0.0], [0.0, 1.0], [0.0, -1.0]])
    a = np.concatenate([rows * unit, bounds])
    b = np.concatenate([np.ones(len(rows) + 1), [1.0 if after > 0 else 0.0, 0.0]])
    i, j = np.triu_indices(len(a), 1)
    size = np.linalg.norm(a, axis=1)
    across = a[i, 0] * a[j, 1] - a[j, 0] * a[i, 1]
    some = np.abs(across) > 1e-14 * size[i] * size[j]
    i, j, across = i[some], j[some], across[some]
    corners = np.stack([b[i] * a[j, 1] - b[j] * a[i, 1], a[i, 0] * b[j] - a[j, 0] * b[i]], axis=1) / across[:, None]
    allowed = ((a @ corners.T) <= b[:, None] + _ROUND * (1 + np.abs(b))[:, None]).all(axis=0)
    return max(float(corners[allowed, 0].max(initial=0.0) * unit[0]), 0.0)
