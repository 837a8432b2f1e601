"""Acceleration limits, which arm descriptions do not contain and which the user gives."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import require_real_numbers
from holdfast.model.arm.model import Arm

AccelerationsLike = ArrayLike | Mapping[str, float] | Mapping[int, float]
"""rad/s^2 and m/s^2: a number, (n,) numbers, or by joint, by name or index from 0."""


def parse_acceleration_limits(arm: Arm, accelerations: AccelerationsLike, is_moving: BoolArray) -> FloatArray:
    """Return the acceleration limits (n,) of the joints that move (n,), rad/s^2 and m/s^2; 0 for the others.

    Raises:
        InputError: A joint is unknown or moves without a limit, the shape is wrong, or a number is not above 0.
    """
    expected_text = f"one number, {arm.n} numbers, or {{joint: number}}, rad/s^2 and m/s^2"
    if isinstance(accelerations, Mapping):
        limits = np.full(arm.n, np.nan)
        joint: Any
        for joint, value in accelerations.items():
            number = require_real_numbers(value, f"the acceleration of '{joint}'", "a number, rad/s^2 or m/s^2")
            if number.ndim:
                raise InputError(f"the acceleration of '{joint}' is {value!r}; give a number, rad/s^2 or m/s^2")
            limits[arm.joint_index(joint)] = number
        missing = [arm.joint_names[joint_index] for joint_index in np.flatnonzero(np.isnan(limits) & is_moving)]
        if missing:
            raise InputError(f"accelerations have no limit for '{missing[0]}'; give one for every joint that moves")
    else:
        values = require_real_numbers(accelerations, "accelerations", expected_text)
        if values.shape not in ((), (arm.n,)):
            raise InputError(f"accelerations have shape {values.shape}; give {expected_text}")
        limits = np.broadcast_to(values, arm.n)
    for joint_index in np.flatnonzero(is_moving & ~((limits > 0) & np.isfinite(limits))):
        raise InputError(
            f"the acceleration of '{arm.joint_names[joint_index]}' is {limits[joint_index]:g}; give a finite number above 0"
        )
    return np.where(is_moving, limits, 0.0)
