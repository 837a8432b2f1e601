"""Model of healthy joints that follow their references, and statistics of the residuals.

The model has static gain 1 and predicts each position from earlier references only, because a model that uses earlier positions
would follow a fault and forget it. In units of one degree, with reference r, frame k, half a second of L frames, and
``v = r[k-1] - r[k-5]``::

    y[k] = r[k-1] + sum over i = 2..L of h[i] (r[k-i] - r[k-1]) + a tanh(v) + c . sag + b

``sag`` are sines and cosines of partial sums of the joints after the first one, which represent the effect of gravity without a
model of the arm.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray

_MEMORY_S = 0.5
_DIRECTION_FRAMES = 4  # over which the direction of motion is computed
_RIDGE = 1e-3
_RESOLUTION_FACTOR = 1.2  # ticks: a smaller change is no motion
_TICK_QUANTILE = 0.05  # the smallest change of a reading with noise would be accidental
_RELATIVE_TICK = 1e-5  # of the range of a joint: smaller differences are rounding
_LEAN_LIMIT_DEG = 8.0
_LONGEST_PULSE = 3  # frames
JOINT_STATISTICS = ("fast", "slow", "lean", "rough", "leap", "pulse", "frozen")
ARM_STATISTICS = ("hold", "drop")


class Frames(NamedTuple):
    """References and positions (T, n) of one episode, without NaN."""

    reference: FloatArray
    position: FloatArray


@dataclass(frozen=True, eq=False)
class FollowingModel:
    """Prediction of healthy positions from references.

    Attributes:
        fps: Frames per second.
        degree: One degree in the unit of the recording.
        angle: One radian in the unit of the recording.
        ticks: (n,) resolution of the positions.
        weights: (features, n) coefficients, fitted to healthy episodes.
    """

    fps: float
    degree: float
    ticks: FloatArray
    weights: FloatArray

    @classmethod
    def fit(cls, episodes: Sequence[Frames], fps: float, degree: float) -> FollowingModel:
        """Fit the model to healthy episodes, with a small ridge penalty on all coefficients but the constant one."""
        joint_count = episodes[0].position.shape[1]
        start = _count_frames(_MEMORY_S, fps)
        weights = []
        for joint in range(joint_count):
            normal: FloatArray | float = 0.0
            product: FloatArray | float = 0.0
            for reference, position in episodes:
                features = _features(reference, joint, fps, degree)[start:]
                residual = position[start:, joint] - _delay(reference, 1)[start:, joint]
                normal, product = normal + features.T @ features, product + features.T @ residual
            penalty = _RIDGE * np.diag(normal).copy()
            penalty[-1] = 0.0
            weights.append(np.linalg.lstsq(normal + np.diag(penalty), product, rcond=None)[0])
        return cls(fps, degree, _resolutions(episodes), np.stack(weights, axis=1))

    @property
    def start(self) -> int:
        """First frame with a prediction from recorded references alone."""
        return _count_frames(_MEMORY_S, self.fps)

    def predict(self, reference: FloatArray) -> FloatArray:
        """Return the healthy positions (T, n) for references (T, n)."""
        corrections = [
            _features(reference, joint, self.fps, self.degree) @ self.weights[:, joint] for joint in range(reference.shape[1])
        ]
        return np.asarray(_delay(reference, 1) + np.stack(corrections, axis=1))

    def statistics(self, frames: Frames) -> tuple[FloatArray, FloatArray]:
        """Return the statistics of joints (T, 7, n) and of the arm (T, 2), in the unit of the recording.

        They are 0 in the first half second, and at frame k they depend on frames up to k only.
        """
        predicted = self.predict(frames.reference)
        residual = frames.position - predicted
        residual[: self.start] = 0.0
        clipped = np.clip(residual, -_LEAN_LIMIT_DEG * self.degree, _LEAN_LIMIT_DEG * self.degree)
        of_joints = [
            np.abs(_moving_mean(residual, _count_frames(1 / 6, self.fps))),
            np.abs(_moving_mean(residual, _count_frames(1.0, self.fps))),
            np.abs(_moving_mean(clipped, _count_frames(4.0, self.fps))),
            np.sqrt(np.maximum(_moving_mean(residual**2, _count_frames(4.0, self.fps)), 0.0)),
            np.abs(_step(residual, 1)),
            _pulses(residual),
            _frozen_ranges(frames.position, predicted, self.ticks),
        ]
        repeats = (_step(frames.position, 1) == 0).all(axis=1)
        repeats[0] = False
        jumps = np.minimum(*(np.abs(_step(_step(values, 1), 1)) for values in frames))
        of_arm = [_ranges_since(~repeats[:, None], predicted).sum(axis=1), jumps.sum(axis=1)]
        joints, arm = np.stack(of_joints, axis=1), np.stack(of_arm, axis=1)
        # The first frames include the padded references of the time before the episode.
        joints[: self.start + 1], arm[:3] = 0.0, 0.0
        return joints, arm


def _count_frames(seconds: float, fps: float) -> int:
    return max(2, round(seconds * fps))


def _delay(values: FloatArray, frames: int) -> FloatArray:
    """Return values (T, ...) that are ``frames`` later; the first one is repeated before the beginning."""
    return np.concatenate([np.repeat(values[:1], min(frames, len(values)), axis=0), values[:-frames]])


def _step(values: FloatArray, frames: int) -> FloatArray:
    return values - _delay(values, frames)


def _features(reference: FloatArray, joint: int, fps: float, degree: float) -> FloatArray:
    """Return the features (T, features) of one joint; the last one is constant."""
    last = _delay(reference, 1)
    own = last[:, joint]
    history = [_delay(reference[:, joint], lag) - own for lag in range(2, _count_frames(_MEMORY_S, fps) + 1)]
    direction = np.tanh((own - _delay(reference[:, joint], 1 + _DIRECTION_FRAMES)) / degree)
    sums = np.cumsum(last[:, min(1, reference.shape[1] - 1) :], axis=1) / np.degrees(degree)
    return np.column_stack([*history, direction, np.sin(sums), np.cos(sums), np.ones(len(reference))])


def _resolutions(episodes: Sequence[Frames]) -> FloatArray:
    """Return the resolution (n,) of each position: the 5 % quantile of its changes, without those that are rounding."""
    ticks = []
    for joint in range(episodes[0].position.shape[1]):
        changes = np.concatenate([np.abs(np.diff(frames.position[:, joint])) for frames in episodes])
        span = max(np.ptp(frames.position[:, joint]) for frames in episodes)
        changes = changes[changes > _RELATIVE_TICK * span]
        ticks.append(np.quantile(changes, _TICK_QUANTILE, method="lower") if changes.size else span or 1.0)
    return np.array(ticks)


def _moving_mean(values: FloatArray, frames: int) -> FloatArray:
    """Return the mean (T, n) of the last ``frames`` values; before the beginning, values are 0."""
    sums = np.cumsum(values, axis=0)
    earlier = np.concatenate([np.zeros((min(frames, len(sums)), values.shape[1])), sums[:-frames]])
    return np.asarray((sums - earlier) / frames)


def _pulses(residual: FloatArray) -> FloatArray:
    """Return the height (T, n) of the pulse of at most three frames that ended with each frame."""
    heights = np.zeros_like(residual)
    for length in range(1, _LONGEST_PULSE + 1):
        inside = [_delay(residual, lag) for lag in range(1, length + 1)]
        for sign in (1, -1):
            lowest = np.min([sign * values for values in inside], axis=0)
            edges = np.maximum(sign * residual, sign * _delay(residual, length + 1))
            heights = np.maximum(heights, lowest - edges)
    return heights


def _frozen_ranges(position: FloatArray, predicted: FloatArray, ticks: FloatArray) -> FloatArray:
    """Return the range (T, n) of the prediction since each position last changed by more than 1.2 ticks."""
    has_moved = np.ones(position.shape, dtype=bool)
    for joint, tick in enumerate((_RESOLUTION_FACTOR * ticks).tolist()):
        anchor = np.inf
        for frame, value in enumerate(position[:, joint].tolist()):
            has_moved[frame, joint] = abs(value - anchor) > tick
            anchor = value if has_moved[frame, joint] else anchor
    return _ranges_since(has_moved, predicted)


def _ranges_since(restarts: NDArray[np.bool_], values: FloatArray) -> FloatArray:
    """Return the range (T, n) of values since the last restart, where ``restarts`` has shape (T, n) or (T, 1)."""
    ranges = np.zeros_like(values)
    for joint in range(values.shape[1]):
        column = restarts[:, min(joint, restarts.shape[1] - 1)]
        edges = np.flatnonzero(np.concatenate([[True], column[1:], [True]]))
        for first, last in pairwise(edges.tolist()):
            if last - first > 1:
                run = values[first:last, joint]
                ranges[first:last, joint] = np.maximum.accumulate(run) - np.minimum.accumulate(run)
    return ranges
