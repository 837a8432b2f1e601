"""That no motion leads to the goal, or to the beginning of a tool path, and how exactly that is known."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.recovery.proofs.flood import Flood, confined, disconnected, holds_configuration, may_meet
from holdfast.recovery.proofs.reach import EXACT, Tolerance, blocked_in, listed
from holdfast.recovery.recovery import Recovery
from holdfast.recovery.rows import Rows
from holdfast.recovery.space import Space

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def separated(
    made: Recovery, rows: Rows, space: Space, *, start: Array, known: Array, poses: Array, q: Array | None = None
) -> tuple[str, bool] | None:
    """A sentence that proves it, and whether it holds within the tolerance asked for; None if it could not be proved.

    Args:
        made: The recovery, as far as it is known.
        rows: That count.
        space: Where the arm may be.
        start: (n,) where it is.
        known: (K, n) configurations that were found and cannot be got to.
        poses: (G, 4, 4) to any of which no motion leads.
        q: (n,) the configuration instead, if one is asked for.
    """
    allowed = made.tolerance or EXACT
    proof = disconnected(space, start, may_meet(space, rows, poses, allowed) if q is None else holds_configuration(space, q))
    if proof is not None:
        return proof, True
    for flood in confined(space, start, known):
        for tolerance in dict.fromkeys((allowed, EXACT)):
            if q is not None or all(_nothing_in(flood, made, pose, space, tolerance) for pose in poses):
                return flood.sentence, tolerance == allowed
    return None


def _nothing_in(flood: Flood, made: Recovery, pose: Array, space: Space, tolerance: Tolerance) -> bool:
    """Whether it is proved that no clear configuration of a pose (4, 4) is where a flood got to; in half of the time left."""
    touching = blocked_in(space)

    def left_out(middle: Array, half: Array) -> Flags:
        found = flood.misses(middle, half)
        if touching is not None and not found.all():
            found[~found] = touching(middle[~found], half[~found])
        return found

    every = listed(made.degraded, made.task, pose, space.seconds_left / 2, left_out, tolerance)
    return every is not None and every.none
