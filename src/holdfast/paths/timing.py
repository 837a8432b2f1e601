"""Timing: how a path is run through; knows no path."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from holdfast.arguments import checked_class
from holdfast.errors import InputError

Array = NDArray[np.float64]


class Timing(Protocol):
    """How s goes from 0 to 1. Any object with these members will do; each method takes t (N,), s, and gives (N,).

    At t below 0 or above the duration the end effector is at the start or the end.
    """

    @property
    def duration(self) -> float:
        """Seconds."""
        ...

    def s(self, t: Array) -> Array:
        """Share of the path, 0 to 1."""
        ...

    def rate(self, t: Array) -> Array:
        """ds/dt, 1/s."""
        ...

    def acceleration(self, t: Array) -> Array:
        """d2s/dt2, 1/s^2; at a jump, the value behind it."""
        ...


@checked_class
@dataclass(frozen=True)
class Trapezoid:
    """From rest to rest: the speed rises evenly, stays, and falls evenly. 20 %, 60 % and 20 % of the time by default.

    Attributes:
        duration: s, above 0.
        accelerate: Share of the time in which the speed rises, 0 to 1.
        decelerate: Share of the time in which it falls; both together at most 1.

    Source: English and Maciejewski 1998, the experiments with the hardware.
    """

    duration: float
    accelerate: float = 0.2
    decelerate: float = 0.2

    def __post_init__(self) -> None:
        if not (np.isfinite(self.duration) and self.duration > 0):
            raise InputError(f"timing: duration is {self.duration:g} s; it must be above 0")
        up, down = self.accelerate, self.decelerate
        if not (up >= 0 and down >= 0 and up + down <= 1 + 1e-12):
            raise InputError(
                f"timing: accelerate is {up:g} and decelerate {down:g}; they are shares of the time, together 0 to 1"
            )

    @property
    def peak(self) -> float:
        """Largest ds/dt, 1/s."""
        return 1 / (self.duration * (1 - (self.accelerate + self.decelerate) / 2))

    def s(self, t: Array) -> Array:
        """Share of the path (N,) at t (N,)."""
        rise, steady, fall = self._parts()
        # The area of the full rectangle, less what the two ramps lack of it.
        x = np.clip(t, 0.0, self.duration)
        first, last = np.minimum(x, rise), np.maximum(x - steady, 0.0)
        lost = (first - first**2 / (2 * rise) if rise else 0.0) + (last**2 / (2 * fall) if fall else 0.0)
        return np.where(t >= self.duration, 1.0, self.peak * (x - lost))

    def rate(self, t: Array) -> Array:
        """ds/dt (N,), 1/s."""
        rise, _, fall = self._parts()
        up = t / rise if rise else 1.0
        down = (self.duration - t) / fall if fall else 1.0
        inside = (t >= 0) & (t <= self.duration)
        return _kept(t, self.peak * np.where(inside, np.minimum(1.0, np.minimum(up, down)), 0.0))

    def acceleration(self, t: Array) -> Array:
        """d2s/dt2 (N,), 1/s^2."""
        rise, steady, fall = self._parts()
        up = np.where((t >= 0) & (t < rise), 1 / rise if rise else 0.0, 0.0)
        down = np.where((t >= steady) & (t < self.duration), 1 / fall if fall else 0.0, 0.0)
        return _kept(t, self.peak * (up - down))

    def _parts(self) -> tuple[float, float, float]:
        """Seconds of the rise, when the fall begins, seconds of the fall."""
        fall = self.decelerate * self.duration
        return self.accelerate * self.duration, self.duration - fall, fall


@checked_class
@dataclass(frozen=True)
class Constant(Trapezoid):
    """Constant speed from the first to the last moment.

    Attributes:
        duration: s, above 0.
    """

    accelerate: float = field(default=0.0, init=False)
    decelerate: float = field(default=0.0, init=False)


def _kept(t: Array, value: Array) -> Array:
    """NaN where t is: comparisons lose it."""
    return np.where(np.isnan(t), np.nan, value)
