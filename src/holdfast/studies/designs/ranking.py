"""Choose the best design: the greatest guaranteed value first, and the longer reach among equal ones."""

from __future__ import annotations

import numpy as np

from holdfast.core.formatting import format_number, format_percent
from holdfast.core.typing import FloatArray

SAME_VALUE_TOLERANCE = (
    1e-3  # of the greatest value: guarantees so near to one another print alike, and fresh poses hardly tell them apart
)
_ZERO_INDEX = 1e-6  # of the index: rounding
_ACCEPTABLE_LOSS = 0.05  # of the guarantee: what somebody might give up for reach
_WORTHWHILE_GAIN = 0.02  # of the reach: what somebody might give it up for


def choose_best_design(guaranteed: FloatArray, reach: FloatArray) -> int:
    """Return the number of the design with the greatest guaranteed value (D,), or of the farthest-reaching one of several
    within 0.1 % of it.

    The first, which is the given arm, is what is there already: it stays the best unless another one has more of either.
    """
    is_equal = guaranteed >= (1 - SAME_VALUE_TOLERANCE) * guaranteed.max() - _ZERO_INDEX
    if is_equal[0] and reach[is_equal].max() <= (1 + SAME_VALUE_TOLERANCE) * reach[0]:
        return 0
    candidates = np.flatnonzero(is_equal)
    return int(candidates[np.lexsort((guaranteed[candidates], reach[candidates]))[-1]]) if guaranteed.max() > _ZERO_INDEX else 0


def describe_farther_design(guaranteed: FloatArray, reach: FloatArray, best: int) -> str:
    """Describe the design that reaches farthest for a little less than the best guarantee; the text is empty if
    there is none.
    """
    is_candidate = (guaranteed >= (1 - _ACCEPTABLE_LOSS) * guaranteed[best]) & (reach >= (1 + _WORTHWHILE_GAIN) * reach[best])
    if not guaranteed[best] > 0 or not is_candidate.any():
        return ""
    design = int(np.flatnonzero(is_candidate)[reach[is_candidate].argmax()])
    loss_text = format_percent(1 - guaranteed[design] / guaranteed[best])
    return (
        f"For {loss_text} less, {format_number(float(guaranteed[design]))} on the poses of the search, another design "
        f"reaches {reach[design]:.3f} m, "
        f"{format_percent(reach[design] / reach[best] - 1)} farther."
    )
