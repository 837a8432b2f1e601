"""Time-optimal path parametrisation through pieces, within speeds and accelerations, on a grid.

With ``x`` the square of the path speed and ``u = x' / 2`` its acceleration, constant in each interval of the grid, the joint
accelerations ``q' u + q'' x`` are linear in s within an interval of a parabola, so that limits that hold at both ends hold in
between. A backward pass computes the greatest ``x`` from which the rest can be completed, and a forward pass is as fast as that
allows (Pham and Pham 2018, TOPP-RA, with limits at both ends of every interval). A straight line is one interval with exact
acceleration, cruise, and deceleration.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray, IndexArray
from holdfast.response.recovery.timing.rounding import PathPieces

_MAX_INTERVALS_PER_PARABOLA = 32  # largest number of intervals of a parabola
_MIN_INTERVALS_PER_PARABOLA = 4  # smallest number of intervals of a parabola
_MAX_PARABOLA_INTERVALS = 1600  # intervals of all parabolas
_POLYGON_TOLERANCE = 1e-12  # of a bound, for corners of the feasible polygon


@dataclass(frozen=True)
class SpeedProfile:
    """Speed along a path: G intervals with constant acceleration.

    Attributes:
        pieces: (G,) index of the path piece of each interval.
        offsets: (G,) start of the interval within that piece.
        speed, acceleration: (G,) path speed at the start of the interval, and acceleration in it.
        time: (G + 1,) start times of the intervals, and the end, s.
    """

    pieces: IndexArray
    offsets: FloatArray
    speed: FloatArray
    acceleration: FloatArray
    time: FloatArray

    def sample(self, pieces: PathPieces, time: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return positions, speeds, and accelerations (N, c) at times (N,), s."""
        interval = np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.offsets) - 1)
        elapsed = time - self.time[interval]
        rate = self.speed[interval] + self.acceleration[interval] * elapsed
        q, direction, curvature = pieces.evaluate(
            self.pieces[interval], self.offsets[interval] + elapsed * (self.speed[interval] + rate) / 2
        )
        return q, direction * rate[:, None], curvature * rate[:, None] ** 2 + direction * self.acceleration[interval][:, None]


def compute_fastest_profile(pieces: PathPieces, max_speeds: FloatArray, max_accelerations: FloatArray) -> SpeedProfile:
    """Compute the profile between standstills within speeds v and accelerations a (n,) above 0, finite for moving joints."""
    grid = _PathGrid(pieces, max_speeds, max_accelerations)
    speed_limits = grid.compute_backward_speed_limits()
    return grid.make_profile(grid.limit_forward_speeds(speed_limits))


class _PathGrid:
    """Intervals of the path, with the limits in each."""

    def __init__(self, pieces: PathPieces, v: FloatArray, a: FloatArray) -> None:
        n = len(v)
        is_curved = np.abs(pieces.bend[:, :n]).max(axis=1) > 0
        count = np.where(
            is_curved,
            np.clip(
                _MAX_PARABOLA_INTERVALS // max(int(is_curved.sum()), 1),
                _MIN_INTERVALS_PER_PARABOLA,
                _MAX_INTERVALS_PER_PARABOLA,
            ),
            1,
        )
        self.pieces = np.repeat(np.arange(len(count)), count)
        interval_index = np.arange(len(self.pieces)) - np.repeat(np.cumsum(count) - count, count)
        self.lengths = (pieces.length / count)[self.pieces]
        self.offsets = interval_index * self.lengths
        self.is_straight = ~is_curved[self.pieces]
        _, first_directions, self._curvatures = (columns[:, :n] for columns in pieces.evaluate(self.pieces, self.offsets))
        self._first_directions = first_directions
        self._last_directions = first_directions + self.lengths[:, None] * self._curvatures
        with np.errstate(divide="ignore"):
            max_directions = np.maximum(np.abs(self._first_directions), np.abs(self._last_directions))
            self.squared_speed_limits = (
                np.where(max_directions > 0, v / np.where(max_directions > 0, max_directions, 1.0), np.inf).min(axis=1) ** 2
            )
            self.acceleration_limits = np.where(
                max_directions > 0, a / np.where(max_directions > 0, max_directions, 1.0), np.inf
            ).min(axis=1)
        stops = np.append(pieces.stops[self.pieces] & (interval_index == 0), True)
        self.squared_speed_caps = np.where(
            stops, 0.0, np.minimum(np.append(np.inf, self.squared_speed_limits), np.append(self.squared_speed_limits, np.inf))
        )
        self._accelerations = a

    def _constraint_rows(self, interval: int) -> FloatArray:
        """Return the constraints (R, 2) on squared speeds x and y at the ends of a curved interval: ``rows @ (x, y) <= 1``."""
        curvature, step = self._curvatures[interval] / self._accelerations, 1 / (2 * self.lengths[interval])
        first = step * self._first_directions[interval] / self._accelerations
        last = step * self._last_directions[interval] / self._accelerations
        start_rows, end_rows = np.column_stack([curvature - first, first]), np.column_stack([-last, curvature + last])
        rows = np.concatenate([start_rows, -start_rows, end_rows, -end_rows])
        return np.asarray(rows[np.abs(rows).max(axis=1) > 0])

    def compute_backward_speed_limits(self) -> FloatArray:
        """Return (G + 1,) the greatest squared speeds from which the rest of the path can be completed."""
        squared_speeds = self.squared_speed_caps.copy()
        for interval in range(len(self.offsets) - 1, -1, -1):
            if self.is_straight[interval]:
                squared_speeds[interval] = min(
                    squared_speeds[interval],
                    squared_speeds[interval + 1] + 2 * self.acceleration_limits[interval] * self.lengths[interval],
                )
            elif squared_speeds[interval] > 0:
                squared_speeds[interval] = _maximize_squared_speed(
                    self._constraint_rows(interval), float(squared_speeds[interval]), float(squared_speeds[interval + 1])
                )
        return squared_speeds

    def limit_forward_speeds(self, squared_limits: FloatArray) -> FloatArray:
        """Return (G + 1,) the squared speeds, each as great as the previous ones allow."""
        squared_speeds = squared_limits.copy()
        for interval in range(len(self.offsets)):
            if self.is_straight[interval]:
                squared_speeds[interval + 1] = min(
                    squared_speeds[interval + 1],
                    squared_speeds[interval] + 2 * self.acceleration_limits[interval] * self.lengths[interval],
                )
                continue
            rows = self._constraint_rows(interval)
            rising_rows = rows[rows[:, 1] > 0]
            squared_speeds[interval + 1] = max(
                min(
                    float(squared_speeds[interval + 1]),
                    float(((1 - rising_rows[:, 0] * squared_speeds[interval]) / rising_rows[:, 1]).min(initial=np.inf)),
                ),
                0.0,
            )
        return squared_speeds

    def make_profile(self, squared_speeds: FloatArray) -> SpeedProfile:
        """Return the profile with these squared speeds at interval ends, scaled down where rounding exceeded a limit."""
        excesses = [
            float((self._constraint_rows(interval) @ squared_speeds[interval : interval + 2]).max(initial=0.0))
            for interval in np.flatnonzero(~self.is_straight).tolist()
        ]
        squared_speeds = squared_speeds / max([1.0, *excesses])
        profile_pieces, starts, speed, acceleration, steps = [], [], [], [], []
        for interval, length in enumerate(self.lengths):
            first, last = float(squared_speeds[interval]), float(squared_speeds[interval + 1])
            parts = [(length, last, (last - first) / (2 * length))]
            if self.is_straight[interval]:
                parts = _split_trapezoid(
                    first,
                    last,
                    float(length),
                    float(self.acceleration_limits[interval]),
                    float(self.squared_speed_limits[interval]),
                )
            offset = float(self.offsets[interval])
            for part_length, end_squared, part_acceleration in parts:
                profile_pieces.append(self.pieces[interval])
                starts.append(offset)
                speed.append(np.sqrt(first))
                steps.append(2 * part_length / (np.sqrt(first) + np.sqrt(end_squared)))
                acceleration.append(part_acceleration)
                offset, first = offset + part_length, end_squared
        time = np.concatenate([[0.0], np.cumsum(steps)])
        return SpeedProfile(np.array(profile_pieces), np.array(starts), np.array(speed), np.array(acceleration), time)


def _split_trapezoid(
    first: float, last: float, length: float, max_acceleration: float, max_squared_speed: float
) -> list[tuple[float, float, float]]:
    """Return the parts of a straight line, each with its length, its final squared speed, and its acceleration."""
    peak_squared_speed = min((first + last) / 2 + max_acceleration * length, max_squared_speed)
    rise_length = (peak_squared_speed - first) / (2 * max_acceleration)
    fall_length = (peak_squared_speed - last) / (2 * max_acceleration)
    parts = [
        (rise_length, peak_squared_speed, max_acceleration),
        (length - rise_length - fall_length, peak_squared_speed, 0.0),
        (fall_length, last, -max_acceleration),
    ]
    return [part for part in parts if part[0] > 1e-15 * length]


def _maximize_squared_speed(constraint_rows: FloatArray, max_squared_speed: float, next_limit: float) -> float:
    """Maximize x up to ``max_squared_speed`` so that ``rows @ (x, y) <= 1``, with y from 0 to ``next_limit``."""
    # In units of the bounds, so that one rounding tolerance fits all.
    units = np.array([max_squared_speed, next_limit if next_limit > 0 else 1.0])
    if not np.isfinite(max_squared_speed):
        units[0] = 1 / np.abs(constraint_rows[:, 0]).max()
    bounds = np.array([[1.0 if np.isfinite(max_squared_speed) else 0.0, 0.0], [0.0, 1.0], [0.0, -1.0]])
    normals = np.concatenate([constraint_rows * units, bounds])
    offsets = np.concatenate([np.ones(len(constraint_rows) + 1), [1.0 if next_limit > 0 else 0.0, 0.0]])
    first, second = np.triu_indices(len(normals), 1)
    norms = np.linalg.norm(normals, axis=1)
    determinants = normals[first, 0] * normals[second, 1] - normals[second, 0] * normals[first, 1]
    is_regular = np.abs(determinants) > 1e-14 * norms[first] * norms[second]
    first, second, determinants = first[is_regular], second[is_regular], determinants[is_regular]
    corners = (
        np.stack(
            [
                offsets[first] * normals[second, 1] - offsets[second] * normals[first, 1],
                normals[first, 0] * offsets[second] - normals[second, 0] * offsets[first],
            ],
            axis=1,
        )
        / determinants[:, None]
    )
    allowed = ((normals @ corners.T) <= offsets[:, None] + _POLYGON_TOLERANCE * (1 + np.abs(offsets))[:, None]).all(axis=0)
    return max(float(corners[allowed, 0].max(initial=0.0) * units[0]), 0.0)
