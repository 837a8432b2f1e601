"""What a number of a fault may be: fixed, or drawn from one uniform number by a law that every machine computes alike."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from holdfast.errors import InputError

LAWS = ("uniform", "loguniform", "exponential", "choice")
_FORMS = "a number, uniform: [a, b], loguniform: [a, b], exponential: MEAN or choice: [a, b, ...]"


@dataclass(frozen=True)
class Spread:
    """A number or the law that it is drawn by.

    Attributes:
        law: ``number`` or one of :data:`LAWS`.
        numbers: The number; both ends; the mean; what is chosen from.
    """

    law: str
    numbers: tuple[float, ...]

    @classmethod
    def of(cls, value: Any, what: str) -> Spread:
        """From a number, two numbers in a tuple (uniform), or ``{law: numbers}``.

        Args:
            value: From a caller or a file.
            what: What an error calls it.

        Raises:
            InputError: Another form, numbers that are not finite, ends upside down.
        """
        if isinstance(value, Spread):
            return value
        law, given = "number", value
        if isinstance(value, Mapping):
            if len(value) != 1 or next(iter(value)) not in LAWS:
                raise InputError(f"{what} has the keys {', '.join(map(str, value)) or 'of nothing'}; it must be {_FORMS}")
            ((law, given),) = value.items()
        elif isinstance(value, tuple):
            law = "uniform"
        single = law in ("number", "exponential")
        if not single and (not isinstance(given, Sequence) or isinstance(given, str)):
            raise InputError(f"{what} is {value!r}; it must be {_FORMS}")
        numbers = tuple(_number(x, what) for x in ([given] if single else given))
        if law in ("uniform", "loguniform"):
            if len(numbers) != 2:
                raise InputError(f"{what} has {len(numbers)} numbers for '{law}'; give both ends, the lower one first")
            if numbers[0] > numbers[1]:
                raise InputError(f"{what} is from {numbers[0]:g} to {numbers[1]:g}; give the lower end first")
            if law == "loguniform" and numbers[0] <= 0:
                raise InputError(f"{what} is loguniform from {numbers[0]:g}; both ends must be above 0")
        if law == "exponential" and numbers[0] <= 0:
            raise InputError(f"{what} has the mean {numbers[0]:g}; the mean of an exponential law must be above 0")
        if not numbers:
            raise InputError(f"{what} has nothing to choose from; give at least one number")
        return cls(law, numbers)

    @property
    def ends(self) -> tuple[float, float]:
        """Least and greatest of what may be drawn."""
        return (0.0, math.inf) if self.law == "exponential" else (min(self.numbers), max(self.numbers))

    def at(self, u: float) -> float:
        """What a uniform number of [0, 1) draws."""
        first, last = self.numbers[0], self.numbers[-1]
        match self.law:
            case "uniform":
                return first + (last - first) * u
            case "loguniform":
                return float(first * (last / first) ** u)
            case "exponential":
                return exponential(first, u)
            case _:
                return self.numbers[int(u * len(self.numbers))]

    def stored(self) -> Any:
        """As files have it."""
        if self.law == "number":
            return self.numbers[0]
        return {self.law: self.numbers[0] if self.law == "exponential" else list(self.numbers)}


def exponential(mean: float, u: float) -> float:
    """What a uniform number of [0, 1) draws from the exponential law."""
    return -mean * math.log1p(-u)


def _number(value: Any, what: str) -> float:
    try:
        if isinstance(value, bool):
            raise ValueError
        number = float(value)  # text too: YAML 1.1 reads 1e-3 as text
    except OverflowError as error:  # a whole number of Python may have any number of digits
        raise InputError(f"{what} is a whole number beyond 1e308; it must be finite") from error
    except (TypeError, ValueError) as error:
        raise InputError(f"{what} is {value!r}; it must be {_FORMS}") from error
    if not math.isfinite(number):
        raise InputError(f"{what} is {number:g}; it must be finite")
    return number
