"""Model of healthy joints that follow their references, and statistics of its residuals.

The model predicts positions from earlier references only, because a model that uses earlier positions would follow a fault and
forget it. In units of one degree, with reference r, frame k, half a second of L frames, and ``v = r[k-1] - r[k-5]``::

    y[k] = r[k-1] + sum over i = 2..L of h[i] (r[k-i] - r[k-1]) + a tanh(v) + c . sag + b

``sag`` are sines and cosines of partial sums of the joints after the first one, in place of gravity torques.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray

STATISTIC_NAMES = ("fast", "slow", "lean", "rough", "leap", "pulse", "frozen", "hold", "drop")
_MEMORY_S = 0.5
_DIRECTION_FRAMES = 4  # over which the direction of motion is computed
_RIDGE_PENALTY = 1e-3
_RESOLUTION_FACTOR = 1.2  # ticks: a smaller change is no motion
_TICK_QUANTILE = 0.05  # the smallest change of a reading with noise would be accidental
_RELATIVE_TICK = 1e-5  # of the range of a joint: smaller changes are rounding
_LEAN_LIMIT_DEG = 8.0
_LONGEST_PULSE = 3  # frames
_MIN_SPREAD = 0.3  # of the logarithm of a statistic


class Frames(NamedTuple):
    """References and positions (T, n) of one episode, without NaN."""

    reference: FloatArray
    position: FloatArray


@dataclass(frozen=True, eq=False, kw_only=True)
class HealthyBehaviour:
    """Model of the healthy joints of a robot, and the distribution of nine statistics of its residuals.

    Attributes:
        fps: Frames per second.
        degree: One degree in the unit of the recording.
        ticks: (n,) resolution of the positions.
        weights: (features, n) coefficients of the model.
        level: (9, n) means of the logarithm of the largest value of each statistic in an episode.
        spread: (9,) standard deviations of this logarithm, pooled over the joints. A joint that no fitting episode disturbed
            would otherwise have a spread close to 0.
    """

    fps: float
    degree: float
    ticks: FloatArray
    weights: FloatArray
    level: FloatArray | float = 0.0
    spread: FloatArray | float = 1.0

    @classmethod
    def fit(cls, episodes: Sequence[Frames], fps: float, degree: float) -> HealthyBehaviour:
        """Fit the model to healthy episodes with a ridge penalty, and compute the distribution of the statistics."""
        weights, start = [], _count_frames(_MEMORY_S, fps)
        for joint in range(episodes[0].position.shape[1]):
            features = np.concatenate([_features(each.reference, joint, fps, degree)[start:] for each in episodes])
            steps = [(each.position - _delay(each.reference, 1))[start:, joint] for each in episodes]
            normal = features.T @ features
            penalty = _RIDGE_PENALTY * normal.diagonal() * (np.arange(len(normal)) < len(normal) - 1)  # not of the constant
            weights.append(np.linalg.lstsq(normal + np.diag(penalty), features.T @ np.concatenate(steps), rcond=None)[0])
        model = cls(fps=fps, degree=degree, ticks=_resolutions(episodes), weights=np.stack(weights, axis=1))
        peaks = np.array([model.score(each).max(axis=0) for each in episodes])
        spread = np.sqrt(peaks.var(axis=0, ddof=1).mean(axis=1, keepdims=True))
        return replace(model, level=peaks.mean(axis=0), spread=np.maximum(spread, _MIN_SPREAD))

    def predict(self, reference: FloatArray) -> FloatArray:
        """Return the healthy positions (T, n) for references (T, n)."""
        features = [_features(reference, joint, self.fps, self.degree) for joint in range(reference.shape[1])]
        corrections = [part @ weights for part, weights in zip(features, self.weights.T, strict=True)]
        return np.asarray(_delay(reference, 1) + np.stack(corrections, axis=1))

    def score(self, frames: Frames) -> FloatArray:
        """Return the scores (T, 9, n) of the statistics: their logarithms relative to healthy episodes."""
        return np.asarray((np.log(np.maximum(self.statistics(frames), self.ticks)) - self.level) / self.spread)

    def statistics(self, frames: Frames) -> FloatArray:
        """Return the statistics (T, 9, n); ``hold`` and ``drop`` are of the whole arm, and the same for all joints.

        At frame k they depend on frames up to k only. They are 0 in the first half second.
        """
        predicted, start = self.predict(frames.reference), _count_frames(_MEMORY_S, self.fps)
        residual = frames.position - predicted
        residual[:start] = 0.0
        clipped = np.clip(residual, -_LEAN_LIMIT_DEG * self.degree, _LEAN_LIMIT_DEG * self.degree)
        repeats = (_step(frames.position) == 0).all(axis=1, keepdims=True)
        jumps = np.minimum(*(np.abs(_step(_step(values))) for values in frames))
        values = [
            np.abs(_moving_mean(residual, _count_frames(1 / 6, self.fps))),
            np.abs(_moving_mean(residual, _count_frames(1.0, self.fps))),
            np.abs(_moving_mean(clipped, _count_frames(4.0, self.fps))),
            np.sqrt(np.maximum(_moving_mean(residual**2, _count_frames(4.0, self.fps)), 0.0)),
            np.abs(_step(residual)),
            _pulses(residual),
            _ranges_since(_find_motion(frames.position, _RESOLUTION_FACTOR * self.ticks), predicted),
            np.broadcast_to(_ranges_since(~repeats, predicted).sum(axis=1, keepdims=True), residual.shape),
            np.broadcast_to(jumps.sum(axis=1, keepdims=True), residual.shape),
        ]
        series = np.stack(values, axis=1)
        series[: start + 1] = 0.0
        return series


def _count_frames(seconds: float, fps: float) -> int:
    return max(2, round(seconds * fps))


def _delay(values: FloatArray, frames: int) -> FloatArray:
    """Return values (T, ...) that are ``frames`` later; the first one is repeated before the beginning."""
    return np.concatenate([np.repeat(values[:1], min(frames, len(values)), axis=0), values[:-frames]])


def _step(values: FloatArray) -> FloatArray:
    return values - _delay(values, 1)


def _features(reference: FloatArray, joint: int, fps: float, degree: float) -> FloatArray:
    """Return the features (T, features) of one joint; the last one is constant."""
    last, own = _delay(reference, 1), reference[:, joint]
    history = [_delay(own, lag) - last[:, joint] for lag in range(2, _count_frames(_MEMORY_S, fps) + 1)]
    direction = np.tanh((last[:, joint] - _delay(own, 1 + _DIRECTION_FRAMES)) / degree)
    sums = np.cumsum(last[:, min(1, reference.shape[1] - 1) :], axis=1) / np.degrees(degree)
    return np.column_stack([*history, direction, np.sin(sums), np.cos(sums), np.ones(len(reference))])


def _resolutions(episodes: Sequence[Frames]) -> FloatArray:
    """Return the resolution (n,) of each position: the 5 % quantile of its changes, without those that are rounding."""
    ticks = []
    for columns in zip(*(each.position.T for each in episodes), strict=True):
        span = max(map(np.ptp, columns))
        changes = np.abs(np.concatenate(list(map(np.diff, columns))))
        changes = changes[changes > _RELATIVE_TICK * span]
        ticks.append(np.quantile(changes, _TICK_QUANTILE, method="lower") if changes.size else span or 1.0)
    return np.array(ticks)


def _moving_mean(values: FloatArray, frames: int) -> FloatArray:
    """Return the mean (T, n) of the last ``frames`` values; before the beginning, values are 0."""
    sums = np.concatenate([np.zeros((frames, values.shape[1])), np.cumsum(values, axis=0)])
    return np.asarray((sums[frames:] - sums[:-frames]) / frames)


def _pulses(residual: FloatArray) -> FloatArray:
    """Return the height (T, n) of the pulse of at most three frames that ended with each frame."""
    heights = np.zeros_like(residual)
    for length in range(1, _LONGEST_PULSE + 1):
        inside, before = [_delay(residual, lag) for lag in range(1, length + 1)], _delay(residual, length + 1)
        upward = np.min(inside, axis=0) - np.maximum(residual, before)
        heights = np.maximum(heights, np.maximum(upward, np.minimum(residual, before) - np.max(inside, axis=0)))
    return heights


def _find_motion(position: FloatArray, resolution: FloatArray) -> NDArray[np.bool_]:
    """Return where (T, n) each position left the one of its last motion by more than the resolution."""
    has_moved = np.ones(position.shape, dtype=bool)
    for joint, limit in enumerate(resolution.tolist()):
        anchor = np.inf
        for frame, value in enumerate(position[:, joint].tolist()):
            has_moved[frame, joint] = abs(value - anchor) > limit
            anchor = value if has_moved[frame, joint] else anchor
    return has_moved


def _ranges_since(restarts: NDArray[np.bool_], values: FloatArray) -> FloatArray:
    """Return the range (T, n) of values since the last restart, where ``restarts`` has shape (T, n) or (T, 1)."""
    ranges = np.zeros_like(values)
    for column, series, result in zip(np.broadcast_to(restarts, values.shape).T, values.T, ranges.T, strict=True):
        for first, last in pairwise([0, *(np.flatnonzero(column[1:]) + 1).tolist(), len(series)]):
            if last - first > 1:
                result[first:last] = np.maximum.accumulate(series[first:last]) - np.minimum.accumulate(series[first:last])
    return ranges
