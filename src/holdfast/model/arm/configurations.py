"""Check configurations and finite joint limits to sample between."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.model.arm.machine import ArmData


def as_configurations(arm: ArmData, q: ArrayLike) -> tuple[FloatArray, bool]:
    """Return ``q`` as (N, n), and whether it was a single configuration, which must then be finite.

    Raises:
        InputError: Wrong shape; NaN or infinity in a single configuration.
    """
    checked_q = arm.check_configurations(q)
    single = checked_q.ndim == 1
    if single and not np.isfinite(checked_q).all():
        raise InputError(f"q for '{arm.name}' holds NaN or infinity; give {arm.n} finite numbers")
    return np.atleast_2d(checked_q), single


def sampling_limits(arm: ArmData) -> tuple[FloatArray, FloatArray]:
    """Return (n,) lower and upper limits to sample between; a missing limit is pi rad or 1 m from 0, or from the other."""
    return replace_infinite_limits(arm.lower, arm.upper, arm.prismatic)


def replace_infinite_limits(lower: FloatArray, upper: FloatArray, prismatic: BoolArray) -> tuple[FloatArray, FloatArray]:
    """Replace infinite limits (..., n), which need not belong to one arm, as :func:`sampling_limits` does."""
    default_bound = np.where(prismatic, 1.0, np.pi)
    finite_lower = np.where(np.isfinite(lower), lower, np.minimum(-default_bound, upper - default_bound))
    finite_upper = np.where(np.isfinite(upper), upper, np.maximum(default_bound, lower + default_bound))
    return finite_lower, finite_upper
