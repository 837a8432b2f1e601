"""Joint rate limits of the form ``g' qd >= b``, and the self-motion that respects them."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from holdfast.kernels.program import SX

Row = tuple[SX, SX]

# Relative to the square of a row: if less of it lies in the self-motion, the self-motion does not fully respect it.
_MIN_NULL_SPACE_FRACTION = 1e-4


def limit_self_motion(
    rows: Sequence[Row], particular: SX, desired: SX, projected: list[SX], rate_cap: float | None
) -> tuple[SX, SX, SX]:
    """Find the self-motion (n,) nearest to the desired one that respects the limits, by a quadratic program of two rows.

    Args:
        rows: One or two limits ``(g, b)``.
        particular: (n,) rates of the task.
        desired: (n,) desired self-motion.
        projected: Projection (n,) of each row g that does not affect the task.
        rate_cap: Largest norm of the rates, rad/s, or None.

    Returns:
        The self-motion, the fraction of it that the cap allows, and whether a row changed it.
    """
    square, missing = [], []
    for (gradient, bound), projection in zip(rows, projected, strict=True):
        min_square, own_square = _MIN_NULL_SPACE_FRACTION * ca.sumsqr(gradient) + 1e-30, ca.sumsqr(projection)
        square.append(ca.if_else(own_square > min_square, own_square, min_square))
        missing.append(bound - ca.dot(gradient, particular) - ca.dot(projection, desired))
    corrections = [
        projection * (shortfall / size) for projection, shortfall, size in zip(projected, missing, square, strict=True)
    ]
    if len(rows) == 1:
        correction = ca.if_else(missing[0] > 0, corrections[0], 0)
    else:
        first_row, second_row = projected
        product = ca.dot(first_row, second_row)
        determinant = square[0] * square[1] - product * product
        is_independent = determinant > _MIN_NULL_SPACE_FRACTION * square[0] * square[1]
        safe_determinant = ca.if_else(is_independent, determinant, 1)
        # If the self-motion cannot respect both, it takes half of each; the end effector is then slowed.
        correction = ca.if_else(
            is_independent,
            first_row * ((square[1] * missing[0] - product * missing[1]) / safe_determinant)
            + second_row * ((square[0] * missing[1] - product * missing[0]) / safe_determinant),
            (corrections[0] + corrections[1]) / 2,
        )
        for index in (1, 0):  # one alone, if that satisfies the other
            suffices = ca.dot(projected[1 - index], corrections[index]) >= missing[1 - index] - 1e-12
            correction = ca.if_else(ca.logic_and(missing[index] > 0, suffices), corrections[index], correction)
        correction = ca.if_else(ca.logic_and(missing[0] <= 0, missing[1] <= 0), 0, correction)
    self_motion, changed = desired + correction, ca.sumsqr(correction) > 0
    if rate_cap is None:
        return self_motion, ca.SX(1), changed
    square_limit, square_norm = rate_cap**2 - ca.sumsqr(particular), ca.sumsqr(self_motion)
    square_limit = ca.if_else(square_limit > 0, square_limit, 0)
    fraction = ca.if_else(
        square_norm > square_limit, ca.sqrt(square_limit / ca.if_else(square_norm > square_limit, square_norm, 1)), 1
    )
    return self_motion * fraction, fraction, changed
