"""Configurations as arrays: what every entry point accepts, and where to draw them from."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.model import Arm
from holdfast.errors import InputError

Array = NDArray[np.float64]


def as_configurations(arm: Arm, q: ArrayLike) -> tuple[Array, bool]:
    """``q`` as (N, n), and whether it was a single configuration, which must then be finite.

    Raises:
        InputError: Wrong shape; NaN or infinity in a single configuration.
    """
    a = arm.check_configurations(q)
    single = a.ndim == 1
    if single and not np.isfinite(a).all():
        raise InputError(f"q for '{arm.name}' holds NaN or infinity; give {arm.n} finite numbers")
    return np.atleast_2d(a), single


def with_limits(arm: Arm, lower: Array, upper: Array) -> Arm:
    """The arm with other limits (n,) of its joints."""
    limits = zip(arm.joints, lower.tolist(), upper.tolist(), strict=True)
    return replace(arm, joints=tuple(replace(j, lower=low, upper=high) for j, low, high in limits))


@lru_cache(maxsize=32)
def without_limits(arm: Arm) -> Arm:
    """The arm as a law sees it: every turning joint comes round after 2 pi."""
    return with_limits(arm, np.full(arm.n, -np.inf), np.full(arm.n, np.inf))


@lru_cache(maxsize=32)
def without_idle_limits(arm: Arm) -> Arm:
    """The arm, without the limits of joints that may make a whole turn: those exclude no posture."""
    idle = ~arm.prismatic & (arm.upper - arm.lower >= 2 * np.pi - 1e-6)
    return with_limits(arm, np.where(idle, -np.inf, arm.lower), np.where(idle, np.inf, arm.upper)) if idle.any() else arm


def finite_limits(arm: Arm) -> tuple[Array, Array]:
    """(n,) lower and upper limits to draw between: where there is none, +-pi rad or +-1 m, or that far beyond the other."""
    return made_finite(arm.lower, arm.upper, arm.prismatic)


def made_finite(lower: Array, upper: Array, prismatic: NDArray[np.bool_]) -> tuple[Array, Array]:
    """As :func:`finite_limits` for limits (..., n) that are not those of one arm."""
    free = np.where(prismatic, 1.0, np.pi)
    low = np.where(np.isfinite(lower), lower, np.minimum(-free, upper - free))
    high = np.where(np.isfinite(upper), upper, np.maximum(free, lower + free))
    return low, high
