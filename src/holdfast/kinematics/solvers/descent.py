"""A minimiser for a few variables under constraints, where importing an optimiser would take longer."""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
import numpy as np

from holdfast.core.typing import FloatArray

_MAX_STEPS = 60
_MAX_HALVINGS = 12
_STEP_TOLERANCE = 1e-9  # a shorter step ends it
_QUIET_OPTIONS = {"print_iter": False, "print_header": False, "print_info": False, "error_on_fail": False}


def minimise_constrained(
    evaluate: Callable[[FloatArray], tuple[float, FloatArray, FloatArray, FloatArray]],
    x: FloatArray,
    low: FloatArray,
    high: FloatArray,
    equality_count: int,
) -> FloatArray:
    """Descend from x (n,) to a local minimum of a cost where its constraints hold; return the last point if that fails.

    Sequential quadratic programming with damped BFGS updates, and a search on the sum of the cost and what the constraints
    miss, along an arc that bends with them.

    Args:
        evaluate: Of x: the cost, its slope (n,), the constraints (m,) and their slopes (m, n).
        x: The start.
        low: (n,) lower limits of x.
        high: (n,) upper limits.
        equality_count: So many of the constraints, the first, must be 0; the others at least 0.

    Source: Nocedal and Wright 2006, algorithm 18.3 and procedure 18.2.
    """
    n = len(x)
    cost, gradient, constraints, jacobian = evaluate(x)
    program = ca.conic("step", "qrqp", {"h": ca.Sparsity.dense(n, n), "a": ca.Sparsity.dense(*jacobian.shape)}, _QUIET_OPTIONS)
    curvature, is_equality, penalties = np.eye(n), np.arange(len(constraints)) < equality_count, np.zeros(len(constraints))

    def solve_subproblem(values: FloatArray) -> tuple[FloatArray, FloatArray] | None:
        """Return the step to where the constraints, linearised with these values, hold, and its multipliers; None if none."""
        upper = np.where(is_equality, -values, np.inf)
        try:
            found = program(h=curvature, g=gradient, a=jacobian, lba=-values, uba=upper, lbx=low - x, ubx=high - x)
        except RuntimeError:  # it refuses NaN
            return None
        step, multipliers = (np.asarray(found[name]).ravel() for name in ("x", "lam_a"))
        return (
            (np.clip(step, low - x, high - x), multipliers) if program.stats()["success"] and np.isfinite(step).all() else None
        )

    def violation(values: FloatArray) -> FloatArray:
        return np.abs(np.where(is_equality, values, np.minimum(values, 0)))

    for _ in range(_MAX_STEPS):
        if (first := solve_subproblem(constraints)) is None or np.abs(first[0]).max() < _STEP_TOLERANCE:
            break
        step, multipliers = first
        penalties = np.maximum(np.abs(multipliers), (np.abs(multipliers) + penalties) / 2)
        merit = cost + penalties @ violation(constraints)
        directional_derivative = gradient @ step - penalties @ violation(constraints)
        correction = np.zeros(n)  # towards where the constraints hold that bend away from the step
        for fraction in (1.0, *0.5 ** np.arange(_MAX_HALVINGS)):
            candidate = np.clip(x + fraction * step + fraction**2 * correction, low, high)
            evaluation = evaluate(candidate)
            if evaluation[0] + penalties @ violation(evaluation[2]) <= merit + 1e-4 * fraction * directional_derivative:
                break
            if fraction == 1 and (second := solve_subproblem(evaluation[2] - jacobian @ step)) is not None:
                correction = second[0] - step
                correction = correction if np.abs(correction).max() < np.abs(step).max() else np.zeros(n)
        else:
            break
        displacement, gradient_change = candidate - x, evaluation[1] - gradient + multipliers @ (evaluation[3] - jacobian)
        curved_step = curvature @ displacement
        if displacement @ gradient_change < 0.2 * (displacement @ curved_step):
            fraction = 0.8 * (displacement @ curved_step) / (displacement @ curved_step - displacement @ gradient_change)
            gradient_change = fraction * gradient_change + (1 - fraction) * curved_step
        if displacement @ gradient_change > 0:
            curvature = (
                curvature
                - np.outer(curved_step, curved_step) / (displacement @ curved_step)
                + np.outer(gradient_change, gradient_change) / (displacement @ gradient_change)
            )
        x, (cost, gradient, constraints, jacobian) = candidate, evaluation
    return x
