"""Configurations as arrays: checked input, and limits to draw them between."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.machine import Machine
from holdfast.errors import InputError

Array = NDArray[np.float64]


def as_configurations(arm: Machine, q: ArrayLike) -> tuple[Array, bool]:
    """``q`` as (N, n), and whether it was a single configuration, which must then be finite.

    Raises:
        InputError: Wrong shape; NaN or infinity in a single configuration.
    """
    a = arm.check_configurations(q)
    single = a.ndim == 1
    if single and not np.isfinite(a).all():
        raise InputError(f"q for '{arm.name}' holds NaN or infinity; give {arm.n} finite numbers")
    return np.atleast_2d(a), single


def finite_limits(arm: Machine) -> tuple[Array, Array]:
    """(n,) lower and upper limits to draw between: where there is none, +-pi rad or +-1 m, or that far beyond the other."""
    return made_finite(arm.lower, arm.upper, arm.prismatic)


def made_finite(lower: Array, upper: Array, prismatic: NDArray[np.bool_]) -> tuple[Array, Array]:
    """As :func:`finite_limits` for limits (..., n) that are not those of one arm."""
    free = np.where(prismatic, 1.0, np.pi)
    low = np.where(np.isfinite(lower), lower, np.minimum(-free, upper - free))
    high = np.where(np.isfinite(upper), upper, np.maximum(free, lower + free))
    return low, high
