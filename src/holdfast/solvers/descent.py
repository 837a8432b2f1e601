"""A minimiser for a few variables under constraints, where importing an optimiser would take longer."""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_STEPS, _HALVINGS = 60, 12
_ENOUGH = 1e-9  # a shorter step ends it
_QUIET = {"print_iter": False, "print_header": False, "print_info": False, "error_on_fail": False}


def descend(look: Callable[[Array], tuple[float, Array, Array, Array]], x: Array, low: Array, high: Array, equal: int) -> Array:
    """From x (n,) to a local minimum of a cost where its constraints hold; x, or where it got to, if that fails.

    Sequential quadratic programming with damped BFGS updates, and a search on the sum of the cost and what the constraints
    miss, along an arc that bends with them.

    Args:
        look: Of x: the cost, its slope (n,), the constraints (m,) and their slopes (m, n).
        x: The start.
        low: (n,) lower limits of x.
        high: (n,) upper limits.
        equal: So many of the constraints, the first, must be 0; the others at least 0.

    Source: Nocedal and Wright 2006, algorithm 18.3 and procedure 18.2.
    """
    n = len(x)
    cost, slope, kept, slopes = look(x)
    program = ca.conic("step", "qrqp", {"h": ca.Sparsity.dense(n, n), "a": ca.Sparsity.dense(*slopes.shape)}, _QUIET)
    curvature, fixed, price = np.eye(n), np.arange(len(kept)) < equal, np.zeros(len(kept))

    def solved(values: Array) -> tuple[Array, Array] | None:
        """The step to where the constraints, linearised with these values, hold, and its forces."""
        upper = np.where(fixed, -values, np.inf)
        try:
            found = program(h=curvature, g=slope, a=slopes, lba=-values, uba=upper, lbx=low - x, ubx=high - x)
        except RuntimeError:  # it refuses NaN
            return None
        step, forces = (np.asarray(found[name]).ravel() for name in ("x", "lam_a"))
        return (np.clip(step, low - x, high - x), forces) if program.stats()["success"] and np.isfinite(step).all() else None

    def missed(values: Array) -> Array:
        return np.abs(np.where(fixed, values, np.minimum(values, 0)))

    for _ in range(_STEPS):
        if (first := solved(kept)) is None or np.abs(first[0]).max() < _ENOUGH:
            break
        step, forces = first
        price = np.maximum(np.abs(forces), (np.abs(forces) + price) / 2)
        merit, falling = cost + price @ missed(kept), slope @ step - price @ missed(kept)
        bow = np.zeros(n)  # towards where the constraints hold that bend away from the step
        for share in (1.0, *0.5 ** np.arange(_HALVINGS)):
            new = np.clip(x + share * step + share**2 * bow, low, high)
            there = look(new)
            if there[0] + price @ missed(there[2]) <= merit + 1e-4 * share * falling:
                break
            if share == 1 and (second := solved(there[2] - slopes @ step)) is not None:
                bow = second[0] - step
                bow = bow if np.abs(bow).max() < np.abs(step).max() else np.zeros(n)
        else:
            break
        s, y = new - x, there[1] - slope + forces @ (there[3] - slopes)
        bent = curvature @ s
        if s @ y < 0.2 * (s @ bent):
            share = 0.8 * (s @ bent) / (s @ bent - s @ y)
            y = share * y + (1 - share) * bent
        if s @ y > 0:
            curvature = curvature - np.outer(bent, bent) / (s @ bent) + np.outer(y, y) / (s @ y)
        x, (cost, slope, kept, slopes) = new, there
    return x
