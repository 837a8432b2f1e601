"""Failure rates of the joints, as relative weights or per second, also from a file.

.. code-block:: yaml

    unit: relative            # or 1/s; default: relative
    rates:                    # by joint; missing joints never lock
      panda_joint2: 2.0
      panda_joint4: 1.0
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike
from pydantic import Field, ValidationError

from holdfast.core.errors import InputError
from holdfast.core.files.yaml import Number, Strict, describe_validation_error, read_mapping
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor, require_real_numbers
from holdfast.model.arm.model import Arm

RatesLike = Mapping[str, float] | Mapping[int, float] | ArrayLike


class _RatesFile(Strict):
    unit: Literal["relative", "1/s"] = "relative"
    rates: dict[str, Number] = Field(min_length=1)


@check_constructor
@dataclass(frozen=True, eq=False)
class FailureRates:
    """Failure rates of the n joints of an arm.

    Attributes:
        each: (n,) failure rates, 0 or more and not all 0.
        per_second: True if the rates are in 1/s; False if they are relative weights.

    Source: a constant rate gives exponentially distributed failure times.
    """

    each: FloatArray
    per_second: bool = False

    @classmethod
    def for_arm(cls, arm: Arm, rates: RatesLike | FailureRates | None = None, *, per_second: bool = False) -> FailureRates:
        """Return the failure rates of an arm.

        Args:
            arm: The arm.
            rates: (n,) rates, or rates by joint name, 0 for missing joints. None: all equal.
            per_second: True if the rates are in 1/s, else they are relative.

        Raises:
            InputError: A joint is unknown, the shape is wrong, a rate is below 0 or not finite, or all rates are 0.
        """
        if isinstance(rates, FailureRates):
            values, per_second = rates.each, rates.per_second
        elif rates is None:
            if per_second:
                raise InputError("rates per second need rates; give one number for each joint, 1/s")
            values = np.ones(arm.n)
        elif isinstance(rates, Mapping):
            values = np.zeros(arm.n)
            for joint, rate in rates.items():
                values[arm.joint_index(joint)] = require_real_numbers(rate, f"the rate of '{joint}'", "a number")
        else:
            values = require_real_numbers(rates, "rates", f"{arm.n} numbers, one for each joint")
        if values.shape != (arm.n,):
            raise InputError(f"rates have shape {values.shape}; '{arm.name}' takes {arm.n}, one for each joint")
        if not (np.isfinite(values) & (values >= 0)).all() or not values.any():
            raise InputError(f"rates are {values.tolist()}; each must be 0 or more, and one must be above 0")
        return cls(values, per_second)

    @classmethod
    def load(cls, arm: Arm, file: str | Path) -> FailureRates:
        """Load rates of an ``arm`` from the YAML file with the path ``file``.

        :mod:`holdfast.response.lock_survival.rates` describes its format.

        Raises:
            InputError: The file cannot be read, or a key or joint is unknown, missing or wrong; the message names it.
        """
        try:
            model = _RatesFile.model_validate(
                read_mapping(Path(file), "holdfast.response.lock_survival.rates", "rates by joint")
            )
            return cls.for_arm(arm, model.rates, per_second=model.unit == "1/s")
        except ValidationError as error:
            raise InputError(f"rates file '{file}': {describe_validation_error(error, _RatesFile)}") from error
        except InputError as error:
            raise InputError(f"rates file '{file}': {error}") from error

    @property
    def total(self) -> float:
        """Sum of the rates of all joints."""
        return float(self.each.sum())

    def weights(self, time: FloatArray) -> FloatArray:
        """Return the weights (T,) of ``time`` (T,), s: the trapezoidal rule, times the probability of no earlier failure."""
        weight = np.zeros(len(time))
        half_steps = np.diff(time) / 2
        weight[:-1] += half_steps
        weight[1:] += half_steps
        return np.asarray(weight * np.exp(-self.total * time) if self.per_second else weight)
