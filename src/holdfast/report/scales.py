"""Axes of drawings that are written without matplotlib: round numbers along them, and where a value lies."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Kind = Literal["linear", "log", "symlog"]

_STEPS = (1.0, 2.0, 2.5, 5.0)
_FLAT = 1e-6  # a fraction of the size of the values that is no change to look at
_RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_LINEAR = 10 / 9  # decades that half of the linear part of a symlog axis takes


def round_numbers(low: float, high: float, most: int) -> list[float]:
    """Two or more round numbers from low to high, evenly spaced, so that ``most`` spaces or fewer cover the way if they can."""
    wanted = (high - low) / most * (1 - 1e-10)
    size = 10.0 ** math.floor(math.log10(wanted))
    steps = [s * size * decade for decade in (0.1, 1.0, 10.0) for s in _STEPS]
    for k in range(next(k for k, step in enumerate(steps) if step >= wanted), -1, -1):
        step = steps[k]
        first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
        if last > first or not k:
            break
    digits = 12 - math.floor(math.log10(max(abs(low), abs(high), step)))
    return [round(i * step, digits) + 0.0 for i in range(first, last + 1)]


def labels(numbers: Sequence[float]) -> list[str]:
    """Evenly spaced numbers as text, all with as many decimals as their spacing needs."""
    step, size = numbers[1] - numbers[0], max(abs(x) for x in numbers)
    exponent = 0 if step >= 1e-4 and size < 1e6 else math.floor(math.log10(size))
    shown = step / 10.0**exponent
    digits = next(d for d in itertools.count() if abs(round(shown, d) - shown) < 1e-5 * shown)
    if not exponent:
        return [f"{x:.{digits}f}".replace("-", "−") for x in numbers]
    return [f"{x / 10.0**exponent:.{digits}f}e{exponent}".replace("-", "−") if x else "0" for x in numbers]


def _power(exponent: int) -> str:
    return {0: "1", 1: "10"}.get(exponent, "10" + str(exponent).translate(_RAISED))


class AxisScale:
    """From values to shares of an axis, 0 at its low end and 1 at its high end.

    Args:
        values: What it is to show; what is not finite, or on a log axis not above 0, has no place.
        kind: ``linear``, ``log`` (linear if nothing is above 0), or ``symlog``, linear between ``-small`` and ``small``.
        small: See kind.
        margin: Room beyond the values, a fraction of what they take.
        most: Spaces between ticks.

    Attributes:
        ticks: Where they are, and what they say.
    """

    def __init__(self, values: Array, kind: Kind = "linear", small: float = 1.0, margin: float = 0.0, most: int = 6) -> None:
        self._kind: Kind = "linear" if kind == "log" and not (values > 0).any() else kind
        self._small = small
        there = self._bent(values)
        there = there[np.isfinite(there)]
        low, high = (float(there.min()), float(there.max())) if there.size else (0.0, 1.0)
        size = max(abs(low), abs(high))
        if high - low <= _FLAT * size:
            low, high = low - (0.05 * size or 0.05), high + (0.05 * size or 0.05)
        self._low, self._high = low - margin * (high - low), high + margin * (high - low)
        self.ticks = [(float(self.place(np.array([x]))[0]), text) for x, text in self._ticks(most)]

    def place(self, values: Array) -> Array:
        """Shares of values (N,); NaN where they have no place."""
        return (self._bent(values) - self._low) / (self._high - self._low)

    def _bent(self, values: Array) -> Array:
        if self._kind == "linear":
            return values
        with np.errstate(divide="ignore", invalid="ignore"):
            if self._kind == "log":
                return np.log10(np.where(values > 0, values, np.nan))
            size = np.abs(values) / self._small
            return np.sign(values) * np.where(size <= 1, _LINEAR * size, _LINEAR + np.log10(np.maximum(size, 1)))

    def _straight(self, bent: float) -> float:
        """The value that :meth:`_bent` was given."""
        if self._kind == "linear":
            return bent
        if self._kind == "log":
            return float(10.0**bent)
        size = abs(bent)
        return math.copysign(self._small * (size / _LINEAR if size <= _LINEAR else 10.0 ** (size - _LINEAR)), bent)

    def _ticks(self, most: int) -> list[tuple[float, str]]:
        low, high = self._straight(self._low), self._straight(self._high)
        found: list[tuple[float, str]] = []
        if self._kind == "log":
            first, last = math.ceil(self._low), math.floor(self._high)
            found = [(10.0**k, _power(k)) for k in range(first, last + 1, max(1, -(-(last - first) // most)))]
        elif self._kind == "symlog":
            first, last = math.ceil(math.log10(self._small)), math.floor(math.log10(max(abs(low), abs(high))))
            every = range(first, last + 1, max(1, -(-2 * (last - first + 1) // most)))
            found = [(0.0, "0"), *((s * 10.0**k, minus + _power(k)) for s, minus in ((1, ""), (-1, "−")) for k in every)]
            found = [(x, text) for x, text in found if low <= x <= high]
        if len(found) > 1:
            return found
        numbers = round_numbers(low, high, most)
        return list(zip(numbers, labels(numbers), strict=True))
