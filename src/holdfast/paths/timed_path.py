"""A path with its timing: what a controller follows."""

from __future__ import annotations

import pathlib
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, checked_class, real_numbers
from holdfast.caching import cached_property
from holdfast.errors import InputError
from holdfast.paths.path import Path, in_file
from holdfast.paths.timing import Timing, Trapezoid
from holdfast.result import Shown

Array = NDArray[np.float64]


@dataclass(frozen=True)
class _Slowed:
    timing: Timing
    factor: float

    @property
    def duration(self) -> float:
        return self.timing.duration * self.factor

    def s(self, t: Array) -> Array:
        return self.timing.s(t / self.factor)

    def rate(self, t: Array) -> Array:
        return self.timing.rate(t / self.factor) / self.factor

    def acceleration(self, t: Array) -> Array:
        return self.timing.acceleration(t / self.factor) / self.factor**2


@dataclass(frozen=True, eq=False)
class _Stopping:
    """A timing for each part between corners: times in proportion to the ways."""

    timing: Timing
    stops: Array  # (K + 1,) values of s, from 0 to 1

    @property
    def duration(self) -> float:
        return self.timing.duration

    def _part(self, t: Array) -> tuple[Array, Array, Array]:
        """Last stop (a value of s), share of the part that runs, and time in the timing's own scale."""
        part = np.clip(np.searchsorted(self.stops, t / self.duration, side="right") - 1, 0, self.stops.size - 2)
        begin, share = self.stops[part], np.diff(self.stops)[part]
        return begin, share, (t - begin * self.duration) / share

    def s(self, t: Array) -> Array:
        begin, share, local = self._part(t)
        return begin + share * self.timing.s(local)

    def rate(self, t: Array) -> Array:
        return self.timing.rate(self._part(t)[2])

    def acceleration(self, t: Array) -> Array:
        _, share, local = self._part(t)
        return self.timing.acceleration(local) / share


@checked_class
@dataclass(frozen=True, eq=False)
class TimedPath(Shown):
    """A path and how it is run through: what a controller follows.

    Attributes:
        path: The path.
        timing: :class:`Trapezoid`, :class:`Constant`, or any object with the members of :class:`Timing`.
        stop: Use the timing's own beginning and end at each corner of the path (with a trapezoid: to rest). The parts
            share the duration in proportion to their lengths.
    """

    path: Path
    timing: Timing
    stop: bool = False

    @cached_property
    def _timing(self) -> Timing:
        if not self.stop or not self.path.corners.size:
            return self.timing
        return _Stopping(self.timing, np.concatenate([[0.0], self.path.corners, [1.0]]))

    @property
    def duration(self) -> float:
        """Seconds."""
        return float(self.timing.duration)

    def pose(self, t: ArrayLike) -> Array:
        """Tool pose in the world at time t, s: (4, 4), or (N, 4, 4) for t (N,). Before 0 and after the end it is still."""
        return self.path.pose(self._shares(_times(t)))

    def twist(self, t: ArrayLike) -> Array:
        """Twist (6,) or (N, 6): linear, m/s, then angular, rad/s, both in the world frame; 0 before 0 and after the end."""
        at = _times(t)
        return self.path.twist(self._shares(at)) * self._column(self._timing.rate, at)

    def twist_rate(self, t: ArrayLike) -> Array:
        """Derivative of the twist (6,) or (N, 6), m/s^2 and rad/s^2; nothing of the jumps at corners."""
        at = _times(t)
        s, rate, acceleration = (
            self._shares(at),
            self._column(self._timing.rate, at),
            self._column(self._timing.acceleration, at),
        )
        return self.path.twist_slope(s) * rate**2 + self.path.twist(s) * acceleration

    def slowed(self, factor: float) -> TimedPath:
        """The same motion ``factor`` times as long: twists are divided by it, their rates by its square.

        Raises:
            InputError: A factor that is not above 0.
        """
        if not (np.isfinite(factor) and factor > 0):
            raise InputError(f"factor is {factor:g}; it must be above 0 (2: half as fast)")
        return TimedPath(self.path, _Slowed(self.timing, float(factor)), self.stop)

    def describe(self) -> str:
        """One sentence for people."""
        return f"{self.path.describe()}, in {self.duration:.4g} s{', with a stop at each corner' if self.stop else ''}"

    @classmethod
    @checked
    def load(cls, file: str | pathlib.Path, duration: float | None = None) -> TimedPath:
        """A path with its timing from a YAML file; the format is in :mod:`holdfast.paths.path_file`.

        Args:
            file: The file.
            duration: s, in place of the file's.

        Raises:
            InputError: Unreadable, without timing, or a key that is unknown, missing or wrong; the message names it.
        """
        path, timing, stop = in_file(file)
        if duration is not None:
            timing = Trapezoid(duration) if timing is None else replace(timing, duration=duration)
        if timing is None:
            raise InputError(
                f"path file '{file}' has no timing; write 'timing: {{duration: 10}}' into it, or give --duration 10 "
                "(in Python, duration=10)"
            )
        return cls(path, timing, stop)

    def _shares(self, t: Array) -> Array:
        return np.asarray(self._timing.s(np.atleast_1d(t))).reshape(t.shape)

    def _column(self, of: Callable[[Array], Array], t: Array) -> Array:
        return np.asarray(of(np.atleast_1d(t))).reshape((*t.shape, 1))


def _times(t: ArrayLike) -> Array:
    a = real_numbers(t, "t")
    if a.ndim > 1:
        raise InputError(f"t has shape {a.shape}; it must be one time or (N,), s")
    return a
