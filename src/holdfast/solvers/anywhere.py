"""The best configuration of an arm at all: no pose is kept, only the limits.

Many optima are kinks where several failures are equally bad, each with a small basin. So very many starts, the best of still
more random configurations, go a few steps of the linearised problem side by side, and the best of them many.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import HoldfastError
from holdfast.solvers import joint_space
from holdfast.solvers.optimum import Ascent, Optimum
from holdfast.status import Status

Array = NDArray[np.float64]

STARTS = 10_000
_DRAWN = 20  # random configurations for each start
_LOOKED_AT = 8  # of them, for each start, are looked at for collisions
_FIRST, _LAST = 8, 80  # steps of all starts, and of those that are followed to the end
_FOLLOWED = 0.05  # of the starts
_FLAT = 1e-7  # values that differ by less are all the same: nothing to climb, and nothing is compiled


def best_of_all(ascent: Ascent, seed: np.random.SeedSequence, starts: int) -> Optimum:
    """The best configuration found, as the optimum of the one pose that it happens to have.

    Its ``start_q`` is the best of the random configurations; ``starts`` are those that were climbed from.

    Args:
        ascent: A free one.
        seed: Of the draws.
        starts: How many of the random configurations are climbed from.

    Raises:
        HoldfastError: None of the random configurations has a value, or none is clear.
    """
    engine = ascent.engine
    q = engine.starts(_DRAWN * starts, np.random.default_rng(seed))
    value = ascent.oriented(q)
    value = np.where(np.isfinite(value), value, -np.inf)
    order = np.argsort(-value, kind="stable")[: _LOOKED_AT * starts]
    if ascent.clearance is not None:
        order = order[ascent.is_clear(q[order])]
    order = order[value[order] > -np.inf][:starts]
    if not order.size:
        raise HoldfastError(
            f"none of {len(q)} random configurations has a value of {ascent.objective.name}"
            + ("" if ascent.clearance is None else f" and is clear: the arm {ascent.clearance.too_close(ascent.margin)} in all")
        )
    first, start_value = q[order[0]], value[order[0]]
    ends, end_values = q[order], value[order]
    if np.ptp(value[np.isfinite(value)]) > _FLAT:
        ends, end_values = _climbed(ascent, ends, max(1, round(_FOLLOWED * starts)))
    top = int(end_values.argmax())
    best, best_value = (ends[top], end_values[top]) if end_values[top] > start_value else (first, start_value)
    close = end_values >= best_value - max(1e-3 * abs(best_value), _FLAT)
    sign = 1.0 if ascent.objective.better == "larger" else -1.0
    status = ascent.objective.statuses(best[None])
    return Optimum(
        q=best[None],
        value=np.array([sign * best_value]),
        start_value=np.array([sign * start_value]),
        start_q=first[None],
        status=np.where(np.isin(status, (Status.SINGULAR, Status.UNDEFINED)), status, Status.OK).astype(np.uint8),
        position_error=np.zeros(1),
        rotation_error=np.zeros(1),
        starts=np.array([len(order)]),
        agreeing=np.array([close.mean()]),
        blocked=np.zeros(1, dtype=bool),
        blocked_by=np.full(1, -1),
    )


def _climbed(ascent: Ascent, q: Array, kept: int) -> tuple[Array, Array]:
    """Where the best of the starts q (N, n) end, (kept, n), and what that is worth; -inf where it is not clear."""
    clear = ascent.clearance is not None

    def worth(q: Array) -> Array:
        value = ascent.oriented(q)
        return np.where(np.isfinite(value) & (ascent.is_clear(q) if clear else True), value, -np.inf)

    nowhere = np.broadcast_to(np.eye(4), (len(q), 4, 4))
    q, radius = ascent.climb(clear, q, nowhere, _FIRST)
    best = np.argsort(-worth(q), kind="stable")[:kept]
    q, _ = ascent.climb(clear, q[best], nowhere[best], _LAST, radius[best])
    q = joint_space.wrapped(ascent.arm, q)
    return q, worth(q)
