"""Fixed or random number of a fault; a law computes it from one uniform number, identically on every machine."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from holdfast.core.errors import InputError

DISTRIBUTION_LAWS = ("uniform", "loguniform", "exponential", "choice")
_ACCEPTED_FORMS = "a number, uniform: [a, b], loguniform: [a, b], exponential: MEAN or choice: [a, b, ...]"


@dataclass(frozen=True)
class ParameterDistribution:
    """Number, or the law from which it is drawn.

    Attributes:
        law: ``number`` or one of :data:`DISTRIBUTION_LAWS`.
        numbers: The number; both ends; the mean; what is chosen from.
    """

    law: str
    numbers: tuple[float, ...]

    @classmethod
    def from_value(cls, value: Any, quantity_name: str) -> ParameterDistribution:
        """Return the distribution from a number, two numbers in a tuple (uniform), or ``{law: numbers}``.

        Args:
            value: From a caller or a file.
            quantity_name: What an error calls it.

        Raises:
            InputError: Another form, numbers that are not finite, ends upside down.
        """
        if isinstance(value, ParameterDistribution):
            return value
        law, content = "number", value
        if isinstance(value, Mapping):
            if len(value) != 1 or next(iter(value)) not in DISTRIBUTION_LAWS:
                raise InputError(
                    f"{quantity_name} has the keys {', '.join(map(str, value)) or 'of nothing'}; it must be {_ACCEPTED_FORMS}"
                )
            ((law, content),) = value.items()
        elif isinstance(value, tuple):
            law = "uniform"
        has_one_number = law in ("number", "exponential")
        if not has_one_number and (not isinstance(content, Sequence) or isinstance(content, str)):
            raise InputError(f"{quantity_name} is {value!r}; it must be {_ACCEPTED_FORMS}")
        numbers = tuple(_parse_number(item, quantity_name) for item in ([content] if has_one_number else content))
        if law in ("uniform", "loguniform"):
            if len(numbers) != 2:
                raise InputError(f"{quantity_name} has {len(numbers)} numbers for '{law}'; give both ends, the lower one first")
            if numbers[0] > numbers[1]:
                raise InputError(f"{quantity_name} is from {numbers[0]:g} to {numbers[1]:g}; give the lower end first")
            if law == "loguniform" and numbers[0] <= 0:
                raise InputError(f"{quantity_name} is loguniform from {numbers[0]:g}; both ends must be above 0")
        if law == "exponential" and numbers[0] <= 0:
            raise InputError(f"{quantity_name} has the mean {numbers[0]:g}; the mean of an exponential law must be above 0")
        if not numbers:
            raise InputError(f"{quantity_name} has nothing to choose from; give at least one number")
        return cls(law, numbers)

    @property
    def ends(self) -> tuple[float, float]:
        """Least and greatest number that may be drawn."""
        return (0.0, math.inf) if self.law == "exponential" else (min(self.numbers), max(self.numbers))

    def at(self, uniform_value: float) -> float:
        """Return the number that a uniform number of [0, 1) draws."""
        lower, upper = self.numbers[0], self.numbers[-1]
        match self.law:
            case "uniform":
                return lower + (upper - lower) * uniform_value
            case "loguniform":
                return float(lower * (upper / lower) ** uniform_value)
            case "exponential":
                return exponential_quantile(lower, uniform_value)
            case _:
                return self.numbers[int(uniform_value * len(self.numbers))]

    def stored(self) -> Any:
        """Return the distribution as files store it."""
        if self.law == "number":
            return self.numbers[0]
        return {self.law: self.numbers[0] if self.law == "exponential" else list(self.numbers)}


def exponential_quantile(mean: float, uniform_value: float) -> float:
    """Return the number that a uniform number of [0, 1) draws from the exponential law."""
    return -mean * math.log1p(-uniform_value)


def _parse_number(value: Any, quantity_name: str) -> float:
    try:
        if isinstance(value, bool):
            raise ValueError
        number = float(value)  # text too: YAML 1.1 reads 1e-3 as text
    except OverflowError as error:  # a whole number of Python may have any number of digits
        raise InputError(f"{quantity_name} is a whole number beyond 1e308; it must be finite") from error
    except (TypeError, ValueError) as error:
        raise InputError(f"{quantity_name} is {value!r}; it must be {_ACCEPTED_FORMS}") from error
    if not math.isfinite(number):
        raise InputError(f"{quantity_name} is {number:g}; it must be finite")
    return number
