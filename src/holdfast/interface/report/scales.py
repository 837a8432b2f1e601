"""Axes of figures that are drawn without matplotlib: round tick values, and positions of values on an axis."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Literal

import numpy as np

from holdfast.core.typing import FloatArray

Kind = Literal["linear", "log", "symlog"]

_ROUND_STEPS = (1.0, 2.0, 2.5, 5.0)
_FLAT_RANGE_FRACTION = 1e-6  # relative range of values below which a curve is drawn as constant
_SUPERSCRIPT_DIGITS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_SYMLOG_LINEAR_DECADES = 10 / 9  # length in decades of half the linear part of a symlog axis


def choose_round_numbers(lower: float, upper: float, max_spaces: int) -> list[float]:
    """Choose at least two evenly spaced round numbers from lower to upper, with at most ``max_spaces`` spaces if possible."""
    min_step = (upper - lower) / max_spaces * (1 - 1e-10)
    decade_size = 10.0 ** math.floor(math.log10(min_step))
    steps = [mantissa * decade_size * decade for decade in (0.1, 1.0, 10.0) for mantissa in _ROUND_STEPS]
    for step_index in range(next(step_index for step_index, step in enumerate(steps) if step >= min_step), -1, -1):
        step = steps[step_index]
        first, last = math.ceil(lower / step - 1e-9), math.floor(upper / step + 1e-9)
        if last > first or not step_index:
            break
    digits = 12 - math.floor(math.log10(max(abs(lower), abs(upper), step)))
    return [round(multiple * step, digits) + 0.0 for multiple in range(first, last + 1)]


def format_tick_labels(numbers: Sequence[float]) -> list[str]:
    """Format evenly spaced numbers with the number of decimals that their spacing requires."""
    step, largest = numbers[1] - numbers[0], max(abs(number) for number in numbers)
    exponent = 0 if step >= 1e-4 and largest < 1e6 else math.floor(math.log10(largest))
    mantissa = step / 10.0**exponent
    digits = next(decimals for decimals in itertools.count() if abs(round(mantissa, decimals) - mantissa) < 1e-5 * mantissa)
    if not exponent:
        return [f"{number:.{digits}f}".replace("-", "−") for number in numbers]
    return [f"{number / 10.0**exponent:.{digits}f}e{exponent}".replace("-", "−") if number else "0" for number in numbers]


def _format_power_of_ten(exponent: int) -> str:
    return {0: "1", 1: "10"}.get(exponent, "10" + str(exponent).translate(_SUPERSCRIPT_DIGITS))


class AxisScale:
    """Map from values to fractions of an axis, 0 at its low end and 1 at its high end.

    Args:
        values: Values that the axis must contain; values that are not finite, or not above 0 on a log axis, are ignored.
        kind: ``linear``, ``log`` (linear if no value is above 0), or ``symlog``, linear between ``-small`` and ``small``.
        small: Half width of the linear part of a ``symlog`` axis.
        margin: Space beyond the values at each end, as a fraction of their range.
        max_spaces: Maximum number of spaces between ticks.

    Attributes:
        ticks: Axis fraction and label of each tick.
    """

    def __init__(
        self, values: FloatArray, kind: Kind = "linear", small: float = 1.0, margin: float = 0.0, max_spaces: int = 6
    ) -> None:
        self._kind: Kind = "linear" if kind == "log" and not (values > 0).any() else kind
        self._small = small
        transformed = self._transform_values(values)
        transformed = transformed[np.isfinite(transformed)]
        lower, upper = (float(transformed.min()), float(transformed.max())) if transformed.size else (0.0, 1.0)
        largest = max(abs(lower), abs(upper))
        if upper - lower <= _FLAT_RANGE_FRACTION * largest:
            lower, upper = lower - (0.05 * largest or 0.05), upper + (0.05 * largest or 0.05)
        self._low, self._high = lower - margin * (upper - lower), upper + margin * (upper - lower)
        self.ticks = [(float(self.to_fraction(np.array([value]))[0]), text) for value, text in self._choose_ticks(max_spaces)]

    def to_fraction(self, values: FloatArray) -> FloatArray:
        """Return the axis fractions of values (N,); NaN for values that are not on the axis."""
        return (self._transform_values(values) - self._low) / (self._high - self._low)

    def _transform_values(self, values: FloatArray) -> FloatArray:
        if self._kind == "linear":
            return values
        with np.errstate(divide="ignore", invalid="ignore"):
            if self._kind == "log":
                return np.log10(np.where(values > 0, values, np.nan))
            relative_size = np.abs(values) / self._small
            return np.sign(values) * np.where(
                relative_size <= 1,
                _SYMLOG_LINEAR_DECADES * relative_size,
                _SYMLOG_LINEAR_DECADES + np.log10(np.maximum(relative_size, 1)),
            )

    def _invert_transform(self, transformed: float) -> float:
        """Return the value whose :meth:`_transform_values` result is ``transformed``."""
        if self._kind == "linear":
            return transformed
        if self._kind == "log":
            return float(10.0**transformed)
        magnitude = abs(transformed)
        return math.copysign(
            self._small
            * (
                magnitude / _SYMLOG_LINEAR_DECADES
                if magnitude <= _SYMLOG_LINEAR_DECADES
                else 10.0 ** (magnitude - _SYMLOG_LINEAR_DECADES)
            ),
            transformed,
        )

    def _choose_ticks(self, max_spaces: int) -> list[tuple[float, str]]:
        lower, upper = self._invert_transform(self._low), self._invert_transform(self._high)
        ticks: list[tuple[float, str]] = []
        if self._kind == "log":
            first, last = math.ceil(self._low), math.floor(self._high)
            ticks = [
                (10.0**exponent, _format_power_of_ten(exponent))
                for exponent in range(first, last + 1, max(1, -(-(last - first) // max_spaces)))
            ]
        elif self._kind == "symlog":
            first, last = math.ceil(math.log10(self._small)), math.floor(math.log10(max(abs(lower), abs(upper))))
            exponents = range(first, last + 1, max(1, -(-2 * (last - first + 1) // max_spaces)))
            ticks = [
                (0.0, "0"),
                *(
                    (sign * 10.0**exponent, minus + _format_power_of_ten(exponent))
                    for sign, minus in ((1, ""), (-1, "−"))
                    for exponent in exponents
                ),
            ]
            ticks = [(value, text) for value, text in ticks if lower <= value <= upper]
        if len(ticks) > 1:
            return ticks
        numbers = choose_round_numbers(lower, upper, max_spaces)
        return list(zip(numbers, format_tick_labels(numbers), strict=True))
