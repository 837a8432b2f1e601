"""Which design is the best: guarantee first, and of guarantees that are the same the longer reach."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.words import number, percent

Array = NDArray[np.float64]

SAME = 1e-3  # of the greatest value: guarantees so near to one another print alike, and fresh poses hardly tell them apart
_NOTHING = 1e-6  # of the index: rounding
_NEAR = 0.05  # of the guarantee: what somebody might give up for reach
_WORTH = 0.02  # of the reach: what somebody might give it up for


def best_design(guaranteed: Array, reach: Array) -> int:
    """Number of the design with the greatest guaranteed value (D,); of several within 0.1 % of it the farthest-reaching one.

    The first, which is the given arm, is what is there already: it stays the best unless another one has more of either.
    """
    alike = guaranteed >= (1 - SAME) * guaranteed.max() - _NOTHING
    if alike[0] and reach[alike].max() <= (1 + SAME) * reach[0]:
        return 0
    some = np.flatnonzero(alike)
    return int(some[np.lexsort((guaranteed[some], reach[some]))[-1]]) if guaranteed.max() > _NOTHING else 0


def farther(guaranteed: Array, reach: Array, best: int) -> str:
    """A sentence on the design that reaches farthest for a little less than the best guarantee; empty if there is none."""
    there = (guaranteed >= (1 - _NEAR) * guaranteed[best]) & (reach >= (1 + _WORTH) * reach[best])
    if not guaranteed[best] > 0 or not there.any():
        return ""
    k = int(np.flatnonzero(there)[reach[there].argmax()])
    less = percent(1 - guaranteed[k] / guaranteed[best])
    return (
        f"For {less} less, {number(float(guaranteed[k]))} on the poses of the search, another design reaches {reach[k]:.3f} m, "
        f"{percent(reach[k] / reach[best] - 1)} farther."
    )
