"""How often each joint locks: as relative weights, or per second. Also from a file.

.. code-block:: yaml

    unit: relative            # or 1/s; relative if not given
    rates:                    # by joint; those that are missing never lock
      panda_joint2: 2.0
      panda_joint4: 1.0
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, ValidationError

from holdfast.arguments import checked_class, real_numbers
from holdfast.arm.model import Arm
from holdfast.errors import InputError
from holdfast.files.yaml import Number, Strict, content, sentence

Array = NDArray[np.float64]
RatesLike = Mapping[str, float] | Mapping[int, float] | ArrayLike


class _File(Strict):
    unit: Literal["relative", "1/s"] = "relative"
    rates: dict[str, Number] = Field(min_length=1)


@checked_class
@dataclass(frozen=True, eq=False)
class FailureRates:
    """Failure rates of the n joints of an arm.

    Attributes:
        each: (n,) 0 or more, not all 0.
        per_second: True: 1/s; False: relative weights.

    Source: a constant rate gives exponential times of failure.
    """

    each: Array
    per_second: bool = False

    @classmethod
    def of(cls, arm: Arm, rates: RatesLike | FailureRates | None = None, *, per_second: bool = False) -> FailureRates:
        """Of an arm.

        Args:
            arm: The arm.
            rates: (n,), or by joint, those missing 0; None: all joints alike.
            per_second: They are in 1/s, else relative.

        Raises:
            InputError: No such joint, a wrong shape, rates below 0 or not finite, or all 0.
        """
        if isinstance(rates, FailureRates):
            each, per_second = rates.each, rates.per_second
        elif rates is None:
            if per_second:
                raise InputError("rates per second need rates; give one number for each joint, 1/s")
            each = np.ones(arm.n)
        elif isinstance(rates, Mapping):
            each = np.zeros(arm.n)
            for joint, rate in rates.items():
                each[arm.joint_index(joint)] = real_numbers(rate, f"the rate of '{joint}'", "a number")
        else:
            each = real_numbers(rates, "rates", f"{arm.n} numbers, one for each joint")
        if each.shape != (arm.n,):
            raise InputError(f"rates have shape {each.shape}; '{arm.name}' takes {arm.n}, one for each joint")
        if not (np.isfinite(each) & (each >= 0)).all() or not each.any():
            raise InputError(f"rates are {each.tolist()}; each must be 0 or more, and one above 0")
        return cls(each, per_second)

    @classmethod
    def load(cls, arm: Arm, file: str | Path) -> FailureRates:
        """From a YAML file; the format is in :mod:`holdfast.endurance.rates`.

        Raises:
            InputError: Unreadable, a key that is unknown, missing or wrong, or no such joint; the message names it.
        """
        try:
            model = _File.model_validate(content(Path(file), "holdfast.endurance.rates", "rates by joint"))
            return cls.of(arm, model.rates, per_second=model.unit == "1/s")
        except ValidationError as error:
            raise InputError(f"rates file '{file}': {sentence(error, _File)}") from error
        except InputError as error:
            raise InputError(f"rates file '{file}': {error}") from error

    @property
    def total(self) -> float:
        """Of all joints together."""
        return float(self.each.sum())

    def weights(self, time: Array) -> Array:
        """(T,) what an instant (T,), s, counts: the trapezoid rule, times the probability that nothing has failed before."""
        weight = np.zeros(len(time))
        half = np.diff(time) / 2
        weight[:-1] += half
        weight[1:] += half
        return np.asarray(weight * np.exp(-self.total * time) if self.per_second else weight)
