"""Measures of a fall by which configurations are compared."""

from __future__ import annotations

from typing import Literal

import numpy as np

from holdfast.control.falls.fall import PowerLoss
from holdfast.core.typing import FloatArray

FallMeasure = Literal["drop", "released", "impact_speed", "impact_energy"]
MEASURE_UNITS: dict[str, str] = {"drop": "m", "released": "J", "impact_speed": "m/s", "impact_energy": "J"}


def measure_fall(fall: PowerLoss, measure: FallMeasure) -> FloatArray:
    """Return a measure (N,) of each fall: its drop, its released energy, or the speed or energy of its first contact.

    Speed and energy are NaN for a fall without contact.
    """
    if measure in ("drop", "released"):
        return np.asarray(getattr(fall, measure))
    if fall.contacts is None:
        return np.full(np.shape(fall.drop), np.nan)
    return fall.contacts.normal_speed if measure == "impact_speed" else fall.contacts.energy_lost
