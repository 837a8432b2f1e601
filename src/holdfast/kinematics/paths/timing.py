"""Timing of a path, independent of its geometry."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor


@runtime_checkable
class Timing(Protocol):
    """Progress of s from 0 to 1. Any object with these members is accepted; each method takes t (N,), s, and returns (N,).

    For t below 0 or above the duration the end effector is at the start or at the end.
    """

    @property
    def duration(self) -> float:
        """Duration in seconds."""
        ...

    def s(self, t: FloatArray) -> FloatArray:
        """Return the fraction of the path (N,), 0 to 1, at times ``t`` (N,), s."""
        ...

    def rate(self, t: FloatArray) -> FloatArray:
        """Return ds/dt (N,), 1/s, at times ``t`` (N,), s."""
        ...

    def acceleration(self, t: FloatArray) -> FloatArray:
        """Return d2s/dt2 (N,), 1/s^2, at times ``t`` (N,), s; at a jump, the value after it."""
        ...


@check_constructor
@dataclass(frozen=True)
class Trapezoid:
    """Motion from rest to rest: the speed rises linearly, is constant, and falls linearly, by default for 20, 60, and 20 %.

    Attributes:
        duration: Duration, s, above 0.
        accelerate: Fraction of the duration in which the speed rises, 0 to 1.
        decelerate: Fraction of the duration in which the speed falls; both together at most 1.

    Source: English and Maciejewski 1998, the experiments with the hardware.
    """

    duration: float
    accelerate: float = 0.2
    decelerate: float = 0.2

    def __post_init__(self) -> None:
        if not (np.isfinite(self.duration) and self.duration > 0):
            raise InputError(f"timing: duration is {self.duration:g} s; it must be above 0")
        rise_fraction, fall_fraction = self.accelerate, self.decelerate
        if not (rise_fraction >= 0 and fall_fraction >= 0 and rise_fraction + fall_fraction <= 1 + 1e-12):
            raise InputError(
                f"timing: accelerate is {rise_fraction:g} and decelerate {fall_fraction:g}; they are fractions of time, "
                f"together 0 to 1"
            )

    @property
    def peak(self) -> float:
        """Largest ds/dt, 1/s."""
        return 1 / (self.duration * (1 - (self.accelerate + self.decelerate) / 2))

    def s(self, t: FloatArray) -> FloatArray:
        """Return the fraction of the path (N,) at times ``t`` (N,), s."""
        rise, fall_start, fall = self._phase_times()
        # The area of the full rectangle without the parts that the two ramps lack.
        elapsed = np.clip(t, 0.0, self.duration)
        rise_time, fall_time = np.minimum(elapsed, rise), np.maximum(elapsed - fall_start, 0.0)
        deficit = (rise_time - rise_time**2 / (2 * rise) if rise else 0.0) + (fall_time**2 / (2 * fall) if fall else 0.0)
        return np.where(t >= self.duration, 1.0, self.peak * (elapsed - deficit))

    def rate(self, t: FloatArray) -> FloatArray:
        """Return ds/dt (N,), 1/s, at times ``t`` (N,), s."""
        rise, _, fall = self._phase_times()
        rising = t / rise if rise else 1.0
        falling = (self.duration - t) / fall if fall else 1.0
        inside = (t >= 0) & (t <= self.duration)
        return _keep_nan(t, self.peak * np.where(inside, np.minimum(1.0, np.minimum(rising, falling)), 0.0))

    def acceleration(self, t: FloatArray) -> FloatArray:
        """Return d2s/dt2 (N,), 1/s^2, at times ``t`` (N,), s."""
        rise, fall_start, fall = self._phase_times()
        rising = np.where((t >= 0) & (t < rise), 1 / rise if rise else 0.0, 0.0)
        falling = np.where((t >= fall_start) & (t < self.duration), 1 / fall if fall else 0.0, 0.0)
        return _keep_nan(t, self.peak * (rising - falling))

    def _phase_times(self) -> tuple[float, float, float]:
        """Return the duration of the rise, the time at which the fall begins, and the duration of the fall, in seconds."""
        fall = self.decelerate * self.duration
        return self.accelerate * self.duration, self.duration - fall, fall


@check_constructor
@dataclass(frozen=True)
class Constant(Trapezoid):
    """Motion at constant speed from start to end; ``accelerate`` and ``decelerate`` are 0.

    Attributes:
        duration: Duration, s, above 0.
    """

    accelerate: float = field(default=0.0, init=False)
    decelerate: float = field(default=0.0, init=False)


def _keep_nan(t: FloatArray, value: FloatArray) -> FloatArray:
    """Return the values with NaN where t is NaN, because comparisons with NaN are False."""
    return np.where(np.isnan(t), np.nan, value)
