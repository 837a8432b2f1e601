"""Configurations as arrays: what every entry point accepts, and where to draw them from."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.model import Arm
from holdfast.errors import InputError

Array = NDArray[np.float64]


def configurations(arm: Arm, q: ArrayLike) -> tuple[Array, bool]:
    """``q`` as (N, n), and whether it was a single configuration, which must then be finite.

    Raises:
        InputError: Wrong shape; NaN or infinity in a single configuration.
    """
    a = arm.check_configurations(q)
    single = a.ndim == 1
    if single and not np.isfinite(a).all():
        raise InputError(f"q for '{arm.name}' holds NaN or infinity; give {arm.n} finite numbers")
    return np.atleast_2d(a), single


def finite_limits(arm: Arm) -> tuple[Array, Array]:
    """(n,) lower and upper limits to draw between: where there is none, +-pi rad or +-1 m, or that far beyond the other."""
    free = np.where(arm.prismatic, 1.0, np.pi)
    low = np.where(np.isfinite(arm.lower), arm.lower, np.minimum(-free, arm.upper - free))
    high = np.where(np.isfinite(arm.upper), arm.upper, np.maximum(free, arm.lower + free))
    return low, high
