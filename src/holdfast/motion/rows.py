"""Limits of joint rates that are rows, ``g' qd >= b``: the self-motion that keeps them."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from holdfast.kernels.program import SX

Row = tuple[SX, SX]

_STEEP = 1e-4  # of the square of a row: where less than that of it lies in the self-motion, it is not fully kept by that


def turned_away(rows: Sequence[Row], particular: SX, wanted: SX, across: list[SX], rate_cap: float | None) -> tuple[SX, SX, SX]:
    """The self-motion (n,) nearest to the one wanted that keeps the rows, where one does: a quadratic program of two rows.

    Args:
        rows: One or two ``(g, b)``.
        particular: (n,) rates of the task.
        wanted: (n,) self-motion wanted beside it.
        across: Of each row g less what the task would feel of it, (n,).
        rate_cap: Largest norm of the rates, rad/s, or None.

    Returns:
        The self-motion, the share of it that the cap lets pass, and whether a row changed it.
    """
    square, missing = [], []
    for (g, b), a in zip(rows, across, strict=True):
        floor, own = _STEEP * ca.sumsqr(g) + 1e-30, ca.sumsqr(a)
        square.append(ca.if_else(own > floor, own, floor))
        missing.append(b - ca.dot(g, particular) - ca.dot(a, wanted))
    pushes = [a * (lack / size) for a, lack, size in zip(across, missing, square, strict=True)]
    if len(rows) == 1:
        turned = ca.if_else(missing[0] > 0, pushes[0], 0)
    else:
        one, other = across
        both = ca.dot(one, other)
        determinant = square[0] * square[1] - both * both
        apart = determinant > _STEEP * square[0] * square[1]
        safe = ca.if_else(apart, determinant, 1)
        # Where the self-motion cannot keep both, half of what either asks for: the end effector is slowed then.
        turned = ca.if_else(
            apart,
            one * ((square[1] * missing[0] - both * missing[1]) / safe)
            + other * ((square[0] * missing[1] - both * missing[0]) / safe),
            (pushes[0] + pushes[1]) / 2,
        )
        for k in (1, 0):  # one alone, if that is enough for the other
            enough = ca.dot(across[1 - k], pushes[k]) >= missing[1 - k] - 1e-12
            turned = ca.if_else(ca.logic_and(missing[k] > 0, enough), pushes[k], turned)
        turned = ca.if_else(ca.logic_and(missing[0] <= 0, missing[1] <= 0), 0, turned)
    chosen, changed = wanted + turned, ca.sumsqr(turned) > 0
    if rate_cap is None:
        return chosen, ca.SX(1), changed
    room, length = rate_cap**2 - ca.sumsqr(particular), ca.sumsqr(chosen)
    room = ca.if_else(room > 0, room, 0)
    share = ca.if_else(length > room, ca.sqrt(room / ca.if_else(length > room, length, 1)), 1)
    return chosen * share, share, changed
