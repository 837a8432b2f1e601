"""Path through waypoints with rounded corners: straight lines, and parabolas that touch them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray

_MAX_BISECTIONS = 9  # bisections of a corner cut until it is allowed; after these the motion stops there
_CHORDS_PER_PARABOLA = 12  # chords of a parabola that are checked


@dataclass(frozen=True)
class PathPieces:
    """Path of P pieces, each ``start + slope s + bend s^2 / 2`` for s from 0 to its length.

    Attributes:
        start, slope, bend: (P, c) coefficients of the joints, and of further columns.
        length: (P,) length of the joints' motion between rounded corners, rad (1 m as 1 rad).
        stops: (P,) True where the motion must stop at the start of a piece.
    """

    start: FloatArray
    slope: FloatArray
    bend: FloatArray
    length: FloatArray
    stops: BoolArray

    def evaluate(self, piece: IndexArray, s: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return position, slope, and bend (N, c) in pieces (N,) at s (N,)."""
        s = s[:, None]
        slope, bend = self.slope[piece], self.bend[piece]
        return self.start[piece] + s * (slope + s * bend / 2), slope + s * bend, bend


@dataclass(frozen=True)
class CornerChords:
    """Chords of the parabolas at corners, to be checked.

    Attributes:
        corner: (E,) index of the corner.
        first, last: (E, n) ends of a chord, on the parabola.
        deviations: (E, n) largest deviation of each joint from the chord.
        line_points: (E, n) points on the original lines that ``last`` replaces.
    """

    corner: IndexArray
    first: FloatArray
    last: FloatArray
    deviations: FloatArray
    line_points: FloatArray


def find_corner_cuts(q: FloatArray, must_meet: BoolArray, is_allowed: Callable[[CornerChords], BoolArray]) -> FloatArray:
    """Return (K,) how far before and after each waypoint of q (K, n), all distinct, its corner may be cut; 0: a stop there.

    The cut is half of the shorter neighbouring line, or a half, a quarter, ... of that.

    Args:
        q: (K, n) waypoints, rad and m.
        must_meet: (K,) True for waypoints that the motion must pass.
        is_allowed: Function that returns (E,) True for chords that are valid together with their deviations.
    """
    lengths = np.linalg.norm(np.diff(q, axis=0), axis=1)
    cut_lengths = np.zeros(len(q))
    cut_lengths[1:-1] = np.minimum(lengths[:-1], lengths[1:]) / 2
    cut_lengths[must_meet] = 0.0
    undecided = np.flatnonzero(cut_lengths)
    for _ in range(_MAX_BISECTIONS):
        if not undecided.size:
            return cut_lengths
        chords = _make_chords(q, undecided, cut_lengths[undecided])
        rejected = np.unique(chords.corner[~is_allowed(chords)])
        cut_lengths[rejected] /= 2
        undecided = rejected
    cut_lengths[undecided] = 0.0
    return cut_lengths


def _make_chords(q: FloatArray, corners: IndexArray, cut_lengths: FloatArray) -> CornerChords:
    incoming, outgoing = _arrival_and_departure_directions(q)
    u, v = incoming[corners][:, None], outgoing[corners][:, None]
    s = np.linspace(0, 2, _CHORDS_PER_PARABOLA + 1)[None, :, None] * cut_lengths[:, None, None]
    corner_distance = cut_lengths[:, None, None]
    middle = q[corners][:, None]
    curve = middle + (s - corner_distance) * u + s**2 * (v - u) / (4 * corner_distance)
    line = middle + np.where(s < corner_distance, (s - corner_distance) * u, (s - corner_distance) * v)
    deviations = np.abs(v - u)[:, 0] * ((2 * cut_lengths / _CHORDS_PER_PARABOLA) ** 2 / (2 * cut_lengths) / 8)[:, None]
    n = q.shape[1]
    return CornerChords(
        np.repeat(corners, _CHORDS_PER_PARABOLA),
        curve[:, :-1].reshape(-1, n),
        curve[:, 1:].reshape(-1, n),
        np.repeat(deviations, _CHORDS_PER_PARABOLA, axis=0),
        line[:, 1:].reshape(-1, n),
    )


def _arrival_and_departure_directions(q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return (K, n) unit vectors towards each waypoint and onwards from it; at the ends both are equal."""
    steps = np.diff(q, axis=0)
    steps /= np.linalg.norm(steps, axis=1, keepdims=True)
    return np.concatenate([steps[:1], steps]), np.concatenate([steps, steps[-1:]])


def round_corners(q: FloatArray, cut_lengths: FloatArray, further_columns: FloatArray) -> PathPieces:
    """Return the pieces of the path through q (K, n), all distinct, with corner cuts (K,); columns (K, c) follow along."""
    all_columns, steps = np.column_stack([q, further_columns]), np.diff(q, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    slopes = np.diff(all_columns, axis=0) / lengths[:, None]
    start, slope, bend, length, stops = [], [], [], [], []
    for index, distance in enumerate(lengths):
        straight = distance - cut_lengths[index] - cut_lengths[index + 1]
        if cut_lengths[index] > 0:
            start.append(all_columns[index] - cut_lengths[index] * slopes[index - 1])
            slope.append(slopes[index - 1])
            bend.append((slopes[index] - slopes[index - 1]) / (2 * cut_lengths[index]))
            length.append(2 * cut_lengths[index])
            stops.append(False)
        if straight > 1e-15 * distance:
            start.append(all_columns[index] + cut_lengths[index] * slopes[index])
            slope.append(slopes[index])
            bend.append(0 * slopes[index])
            length.append(straight)
            stops.append(bool(cut_lengths[index] == 0))
    return PathPieces(np.array(start), np.array(slope), np.array(bend), np.array(length), np.array(stops))
