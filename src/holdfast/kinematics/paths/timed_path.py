"""Path with its timing, for a controller to follow."""

from __future__ import annotations

import pathlib
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.result import Presentable
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, check_constructor, require_real_numbers
from holdfast.kinematics.paths.path import Path, load_path_file
from holdfast.kinematics.paths.timing import Timing, Trapezoid


@dataclass(frozen=True)
class _SlowedTiming:
    timing: Timing
    factor: float

    @property
    def duration(self) -> float:
        return self.timing.duration * self.factor

    def s(self, t: FloatArray) -> FloatArray:
        return self.timing.s(t / self.factor)

    def rate(self, t: FloatArray) -> FloatArray:
        return self.timing.rate(t / self.factor) / self.factor

    def acceleration(self, t: FloatArray) -> FloatArray:
        return self.timing.acceleration(t / self.factor) / self.factor**2


@dataclass(frozen=True, eq=False)
class _StoppingTiming:
    """Timing that applies another timing to each part between corners; durations are proportional to lengths."""

    timing: Timing
    stops: FloatArray  # (K + 1,) values of s, from 0 to 1

    @property
    def duration(self) -> float:
        return self.timing.duration

    def _locate_between_stops(self, t: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the last stop (a value of s), the fraction of the current part, and the time in the timing's own scale."""
        index = np.clip(np.searchsorted(self.stops, t / self.duration, side="right") - 1, 0, self.stops.size - 2)
        part_start, fraction = self.stops[index], np.diff(self.stops)[index]
        return part_start, fraction, (t - part_start * self.duration) / fraction

    def s(self, t: FloatArray) -> FloatArray:
        part_start, fraction, local_time = self._locate_between_stops(t)
        return part_start + fraction * self.timing.s(local_time)

    def rate(self, t: FloatArray) -> FloatArray:
        return self.timing.rate(self._locate_between_stops(t)[2])

    def acceleration(self, t: FloatArray) -> FloatArray:
        _, fraction, local_time = self._locate_between_stops(t)
        return self.timing.acceleration(local_time) / fraction


@check_constructor
@dataclass(frozen=True, eq=False)
class TimedPath(Presentable):
    """Path with its timing, for a controller to follow.

    Attributes:
        path: Geometry of the path.
        timing: :class:`Trapezoid`, :class:`Constant`, or any object with the members of :class:`Timing`.
        stop: Apply the timing to each part between corners (a trapezoid then stops there). The parts share the duration in
            proportion to their lengths.
    """

    path: Path
    timing: Timing
    stop: bool = False

    @cached_property
    def _timing_with_stops(self) -> Timing:
        if not self.stop or not self.path.corners.size:
            return self.timing
        return _StoppingTiming(self.timing, np.concatenate([[0.0], self.path.corners, [1.0]]))

    @property
    def duration(self) -> float:
        """Duration in seconds."""
        return float(self.timing.duration)

    def pose(self, t: ArrayLike) -> FloatArray:
        """Return the tool pose in the world at time ``t``, s: (4, 4), or (N, 4, 4) for (N,), constant outside the path."""
        return self.path.pose(self._path_parameters(_check_times(t)))

    def twist(self, t: ArrayLike) -> FloatArray:
        """Return the twist at time ``t``, s, (6,) or (N, 6): linear, m/s, then angular, rad/s, in the world; 0 outside."""
        times = _check_times(t)
        return self.path.twist(self._path_parameters(times)) * self._evaluate_column(self._timing_with_stops.rate, times)

    def twist_rate(self, t: ArrayLike) -> FloatArray:
        """Return the derivative of the twist at time ``t``, s, (6,) or (N, 6), m/s^2 and rad/s^2, without jumps at corners."""
        times = _check_times(t)
        parameters = self._path_parameters(times)
        rate = self._evaluate_column(self._timing_with_stops.rate, times)
        acceleration = self._evaluate_column(self._timing_with_stops.acceleration, times)
        return self.path.twist_slope(parameters) * rate**2 + self.path.twist(parameters) * acceleration

    def stretch(self, factor: float) -> TimedPath:
        """Return the same motion ``factor`` times as long: twists are divided by the factor, their rates by its square.

        Raises:
            InputError: The factor is not above 0.
        """
        if not (np.isfinite(factor) and factor > 0):
            raise InputError(f"factor is {factor:g}; it must be above 0 (2: half as fast)")
        return TimedPath(self.path, _SlowedTiming(self.timing, float(factor)), self.stop)

    def describe(self) -> str:
        """Describe the path and its timing in one sentence."""
        return f"{self.path.describe()}, in {self.duration:.4g} s{', with a stop at each corner' if self.stop else ''}"

    @classmethod
    @check_arguments
    def load(cls, file: str | pathlib.Path, duration: float | None = None) -> TimedPath:
        """Return a path with its timing from a YAML file; the format is in :mod:`holdfast.kinematics.paths.path_file`.

        Args:
            file: Path file.
            duration: Duration, s; default: that of the file.

        Raises:
            InputError: The file cannot be read, has no timing, or a key is unknown, missing or wrong; the message names it.
        """
        path, timing, stop = load_path_file(file)
        if duration is not None:
            timing = Trapezoid(duration) if timing is None else replace(timing, duration=duration)
        if timing is None:
            raise InputError(
                f"path file '{file}' has no timing; write 'timing: {{duration: 10}}' into it, or give --duration 10 "
                "(in Python, duration=10)"
            )
        return cls(path, timing, stop)

    def _path_parameters(self, t: FloatArray) -> FloatArray:
        return np.asarray(self._timing_with_stops.s(np.atleast_1d(t))).reshape(t.shape)

    def _evaluate_column(self, function: Callable[[FloatArray], FloatArray], t: FloatArray) -> FloatArray:
        return np.asarray(function(np.atleast_1d(t))).reshape((*t.shape, 1))


def _check_times(t: ArrayLike) -> FloatArray:
    array = require_real_numbers(t, "t")
    if array.ndim > 1:
        raise InputError(f"t has shape {array.shape}; it must be one time or (N,), s")
    return array
