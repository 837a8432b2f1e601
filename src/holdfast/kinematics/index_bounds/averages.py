"""Largest mean of relative manipulability if joints fail at known rates (theorem R5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import require_real_numbers

_NEGLIGIBLE_EXCESS = 1e-15


@dataclass(frozen=True, kw_only=True, eq=False)
class AverageBound:
    """Upper bound of the mean relative manipulability of any arm.

    Attributes:
        value: Upper bound of the sum of rate times relative manipulability, 0 to 1.
        left: (n,) relative manipulability after the lock of each joint, of a Jacobian that attains the bound.
        null_space: (n, n - m) orthonormal columns whose rows have these lengths.
    """

    value: float
    left: FloatArray
    null_space: FloatArray


def bound_average(rates: ArrayLike, m: int) -> AverageBound:
    """Return the largest mean relative manipulability over single failures of n joints with probabilities proportional to
    rates.

    The squares of the relative manipulabilities sum to n - m and are at most 1. By Cauchy and Schwarz ``min(1, mu rate^2)`` is
    best, and by Schur and Horn some Jacobian attains it. Equal rates give theorem T1.

    Args:
        rates: (n,) positive failure rates; they are divided by their sum, so their unit does not matter.
        m: Number of rows of the task, 1 to n - 1.

    Raises:
        InputError: A rate is not positive, or m is out of range.

    Source: derived here.
    """
    failure_rates = require_real_numbers(rates, "the rates")
    if failure_rates.ndim != 1 or not (failure_rates > 0).all():
        raise InputError("rates are one positive number for each joint")
    n = len(failure_rates)
    if not 1 <= m < n:
        raise InputError(f"{n} joints for {m} rows of the task; m must be from 1 to {n - 1}")
    weight = failure_rates / failure_rates.sum()
    order = np.argsort(-weight, kind="stable")
    falling = weight[order] ** 2
    for full in range(n - m + 1):  # the number of most probable joints whose lock costs nothing
        scale = (n - m - full) / falling[full:].sum()
        if scale * falling[full] <= 1:
            break
    squares = np.empty(n)
    squares[order] = np.minimum(np.concatenate([np.ones(full), scale * falling[full:]]), 1.0)
    null = np.empty((n, n - m))
    null[order] = _frame_with_lengths(squares[order], n - m)
    root_lengths = np.sqrt(squares)
    return AverageBound(value=float(weight @ root_lengths), left=root_lengths, null_space=null)


def _frame_with_lengths(squares: FloatArray, p: int) -> FloatArray:
    """Return orthonormal columns (n, p) whose rows have falling squared lengths that sum to p; each rotation fixes one row."""
    rows = np.eye(len(squares), p)
    long, short = p - 1, p
    while long >= 0 and short < len(squares):
        excess, lack = rows[long] @ rows[long] - squares[long], squares[short] - rows[short] @ rows[short]
        part = min(excess, lack)
        if part > _NEGLIGIBLE_EXCESS:
            a, b, g = rows[long] @ rows[long], rows[short] @ rows[short], rows[long] @ rows[short]
            # Tangent of the angle after which the longer row has the required length.
            aim = a - part
            roots = np.roots([b - aim, -2 * g, a - aim])
            t = float(roots[np.argmin(abs(roots))].real)
            c = 1 / np.sqrt(1 + t * t)
            rows[[long, short]] = c * np.array([[1, -t], [t, 1]]) @ rows[[long, short]]
        long, short = (long - 1, short) if excess <= lack else (long, short + 1)
    return rows
