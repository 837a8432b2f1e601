"""Limits of accelerations, which no description of an arm holds, as they are given."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import real_numbers
from holdfast.arm.model import Arm
from holdfast.errors import InputError

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
AccelerationsLike = ArrayLike | Mapping[str, float] | Mapping[int, float]
"""rad/s^2 and m/s^2: a number, (n,) numbers, or by joint, by name or index from 0."""


def limits_by_joint(arm: Arm, given: AccelerationsLike, moves: Flags) -> Array:
    """(n,) of the joints that move (n,), rad/s^2 and m/s^2; 0 of others.

    Raises:
        InputError: No such joint, a joint that moves without a limit, a wrong shape, or a number that is not above 0.
    """
    wanted = f"one number, {arm.n} numbers, or {{joint: number}}, rad/s^2 and m/s^2"
    if isinstance(given, Mapping):
        each = np.full(arm.n, np.nan)
        joint: Any
        for joint, value in given.items():
            number = real_numbers(value, f"the acceleration of '{joint}'", "a number, rad/s^2 or m/s^2")
            if number.ndim:
                raise InputError(f"the acceleration of '{joint}' is {value!r}; give a number, rad/s^2 or m/s^2")
            each[arm.joint_index(joint)] = number
        missing = [arm.joint_names[k] for k in np.flatnonzero(np.isnan(each) & moves)]
        if missing:
            raise InputError(f"accelerations give no limit of '{missing[0]}'; give one of every joint that moves")
    else:
        read = real_numbers(given, "accelerations", wanted)
        if read.shape not in ((), (arm.n,)):
            raise InputError(f"accelerations have shape {read.shape}; give {wanted}")
        each = np.broadcast_to(read, arm.n)
    for k in np.flatnonzero(moves & ~((each > 0) & np.isfinite(each))):
        raise InputError(f"the acceleration of '{arm.joint_names[k]}' is {each[k]:g}; give a finite number above 0")
    return np.where(moves, each, 0.0)
