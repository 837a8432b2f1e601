"""A way through waypoints with its corners rounded: straight lines, and parabolas that touch them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.intp]

_HALVED = 9  # times a corner is, until what is cut off it is allowed; then the way stops there
_STEPS = 12  # chords of a parabola that is looked at


@dataclass(frozen=True)
class Pieces:
    """A way in P pieces, each ``start + slope s + bend s^2 / 2`` for s from 0 to its length.

    Attributes:
        start, slope, bend: (P, c); what counts are the joints, other columns go along.
        length: (P,) of the joints' motion, rad (1 m as 1 rad), between corners that are rounded.
        stops: (P,) True where the way must stop as a piece begins.
    """

    start: Array
    slope: Array
    bend: Array
    length: Array
    stops: Flags

    def at(self, piece: Indices, s: Array) -> tuple[Array, Array, Array]:
        """Where the way is, its slope and its bend (N, c), in pieces (N,) at s (N,)."""
        s = s[:, None]
        slope, bend = self.slope[piece], self.bend[piece]
        return self.start[piece] + s * (slope + s * bend / 2), slope + s * bend, bend


@dataclass(frozen=True)
class Corners:
    """The chords of parabolas at corners, to be looked at.

    Attributes:
        corner: (E,) which corner.
        first, last: (E, n) the ends of a chord, on the parabola.
        away: (E, n) the most by which each joint is off the chord in between.
        cut: (E, n) the place between waypoints that ``last`` takes.
    """

    corner: Indices
    first: Array
    last: Array
    away: Array
    cut: Array


def cuts_of(q: Array, exact: Flags, allowed: Callable[[Corners], Flags]) -> Array:
    """(K,) how far before and after each waypoint of q (K, n), none twice, its corner may be cut off; 0: the way stops there.

    Half of the shorter line beside it, or a half, a quarter, ... of that.

    Args:
        q: (K, n), rad and m.
        exact: (K,) True for waypoints that must be met themselves.
        allowed: (E,) which chords, and all between them and the parabola, may be on the way.
    """
    lengths = np.linalg.norm(np.diff(q, axis=0), axis=1)
    cut = np.zeros(len(q))
    cut[1:-1] = np.minimum(lengths[:-1], lengths[1:]) / 2
    cut[exact] = 0.0
    open_ = np.flatnonzero(cut)
    for _ in range(_HALVED):
        if not open_.size:
            return cut
        chords = _chords(q, open_, cut[open_])
        refused = np.unique(chords.corner[~allowed(chords)])
        cut[refused] /= 2
        open_ = refused
    cut[open_] = 0.0
    return cut


def _chords(q: Array, corners: Indices, cut: Array) -> Corners:
    towards, onwards = _directions(q)
    u, v = towards[corners][:, None], onwards[corners][:, None]
    s = np.linspace(0, 2, _STEPS + 1)[None, :, None] * cut[:, None, None]
    far = cut[:, None, None]
    middle = q[corners][:, None]
    curve = middle + (s - far) * u + s**2 * (v - u) / (4 * far)
    line = middle + np.where(s < far, (s - far) * u, (s - far) * v)
    away = np.abs(v - u)[:, 0] * ((2 * cut / _STEPS) ** 2 / (2 * cut) / 8)[:, None]
    n = q.shape[1]
    return Corners(
        np.repeat(corners, _STEPS),
        curve[:, :-1].reshape(-1, n),
        curve[:, 1:].reshape(-1, n),
        np.repeat(away, _STEPS, axis=0),
        line[:, 1:].reshape(-1, n),
    )


def _directions(q: Array) -> tuple[Array, Array]:
    """(K, n) unit vectors towards each waypoint and onwards from it; at the ends one of them is the other."""
    d = np.diff(q, axis=0)
    d /= np.linalg.norm(d, axis=1, keepdims=True)
    return np.concatenate([d[:1], d]), np.concatenate([d, d[-1:]])


def rounded(q: Array, cut: Array, beside: Array) -> Pieces:
    """The pieces of the way through q (K, n), no waypoint twice, with corners cut (K,); columns beside it (K, c) go along."""
    both, d = np.column_stack([q, beside]), np.diff(q, axis=0)
    lengths = np.linalg.norm(d, axis=1)
    slopes = np.diff(both, axis=0) / lengths[:, None]
    start, slope, bend, length, stops = [], [], [], [], []
    for k, far in enumerate(lengths):
        straight = far - cut[k] - cut[k + 1]
        if cut[k] > 0:
            start.append(both[k] - cut[k] * slopes[k - 1])
            slope.append(slopes[k - 1])
            bend.append((slopes[k] - slopes[k - 1]) / (2 * cut[k]))
            length.append(2 * cut[k])
            stops.append(False)
        if straight > 1e-15 * far:
            start.append(both[k] + cut[k] * slopes[k])
            slope.append(slopes[k])
            bend.append(0 * slopes[k])
            length.append(straight)
            stops.append(bool(cut[k] == 0))
    return Pieces(np.array(start), np.array(slope), np.array(bend), np.array(length), np.array(stops))
