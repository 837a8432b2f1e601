"""Singular values of J without one column from those of J, as straight-line code for optimisation.

Rotated into its left singular vectors, ``J J'`` is ``D = diag(d)``, column k is w, and the reduced Jacobian has the Gram
matrix ``G = D - w w'``. Its eigenvalues are the roots of the secular equation ``sum w_i^2 / (d_i - x) = 1``, one below each
d_i. Every function here returns a value and its derivative by G, computed in a fixed number of steps.

Source of the secular equation: Golub 1973; of the quadrature: Hale, Higham, Trefethen 2008, method 3.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import casadi as ca
import numpy as np

from holdfast.kernels.linalg import Vector, dot_product
from holdfast.kernels.program import SX

Matrix = list[Vector]

_SECULAR_NEWTON_STEPS = 9
_ZERO_ENTRY = 1e-10  # relative to the Frobenius norm: smaller entries of w are replaced, because they would divide 0 by 0
_QUADRATURE_NODES = 18
_QUADRATURE_RANGE = 1e-4  # relative to the Frobenius norm: smaller singular values enter the mean only approximately


def smallest_singular_value(d: Vector, w: Vector) -> tuple[SX, Matrix]:
    """Return the smallest singular value and its derivative."""
    x, square = _smallest_eigenpair(d, _replace_tiny_entries(d, w))
    sigma = ca.sqrt(square)
    return sigma, _scaled_outer(x, 0.5 / sigma)


def inverse_condition(d: Vector, w: Vector) -> tuple[SX, Matrix]:
    """Return the ratio of the smallest to the largest singular value and its derivative."""
    w = _replace_tiny_entries(d, w)
    x, low_square = _smallest_eigenpair(d, w)
    y, high_square = _largest_eigenpair(d, w)
    low, high = ca.sqrt(low_square), ca.sqrt(high_square)
    raised, lowered = _scaled_outer(x, 0.5 / (low * high)), _scaled_outer(y, 0.5 * low / (high * high_square))
    return low / high, [[a - b for a, b in zip(*rows, strict=True)] for rows in zip(raised, lowered, strict=True)]


def mean_singular_value(d: Vector, w: Vector) -> tuple[SX, Matrix]:
    """Return the mean singular value, ``tr sqrt(G) / m``, with the derivative ``G^(-1/2) / (2 m)`` by quadrature."""
    m = len(d)
    total = _sum_terms(d)
    size = ca.sqrt(total)
    shares, v = [x / total for x in d], [x / size for x in w]
    root: Matrix = [[ca.SX(0)] * m for _ in range(m)]
    for square, weight in _inverse_root_quadrature():
        inverse = [1 / (x + square) for x in shares]
        u = [e * x for e, x in zip(inverse, v, strict=True)]
        factor = weight / (1 - dot_product(u, v))
        for i in range(m):
            root[i][i] = root[i][i] + weight * inverse[i]
            for k in range(i + 1):
                root[i][k] = root[i][k] + factor * u[i] * u[k]
    root = [[root[max(i, k)][min(i, k)] for k in range(m)] for i in range(m)]
    trace = dot_product(shares, [root[i][i] for i in range(m)]) - dot_product(v, [dot_product(row, v) for row in root])
    return size * trace / m, [[x / (2 * m * size) for x in row] for row in root]


def _smallest_eigenpair(d: Vector, w: Vector) -> tuple[Vector, SX]:
    """Return the unit eigenvector of the smallest eigenvalue, and that eigenvalue.

    ``1 / sum w_i^2 / (d_i - x)`` is concave (a harmonic mean of straight lines), so Newton's method from the right never
    passes the root. The unknown is the distance ``t = min d - x``, which keeps small distances exact.
    """
    low, squares = d[0], [x * x for x in w]
    low_square = squares[0]
    for x, s in zip(d[1:], squares[1:], strict=True):
        low_square = ca.if_else(x < low, s, low_square)
        low = ca.if_else(x < low, x, low)
    gaps = [x - low for x in d]
    # Every other term is at least w_i^2 / d_i, which bounds the distance from below.
    remainder = 1 - _sum_terms([s / x for s, x in zip(squares, d, strict=True)])
    t = low_square / (_at_least(remainder, 0.0) + low_square / low)
    for _ in range(_SECULAR_NEWTON_STEPS):
        inverse = [1 / (g + t) for g in gaps]
        terms = [s * e for s, e in zip(squares, inverse, strict=True)]
        total = _sum_terms(terms)
        t = t + total * (total - 1) / dot_product(terms, inverse)
    floor = _ZERO_ENTRY**2 * _sum_terms(d)
    return _normalise([x / (g + t) for x, g in zip(w, gaps, strict=True)]), _at_least(low - t, floor)


def _largest_eigenpair(d: Vector, w: Vector) -> tuple[Vector, SX]:
    """Return the unit eigenvector of the largest eigenvalue, and that eigenvalue.

    With the largest d_i on one side, ``w_1^2 / (d_1 - x) = 1 + N(x)``, the function ``w_1^2 / (1 + N(x)) - (d_1 - x)`` is
    concave, and Newton's method from the left never passes the root. The unknown is the distance from the second largest.
    """
    m = len(d)
    top, second = d[0], ca.SX(0)
    at_top, at_second = _one_hot(m, 0), [ca.SX(0)] * m
    for k in range(1, m):
        is_top = _one_hot(m, k)
        first, next_best = d[k] > top, d[k] > second
        second = ca.if_else(first, top, ca.if_else(next_best, d[k], second))
        places = zip(at_top, at_second, is_top, strict=True)
        at_second = [ca.if_else(first, a, ca.if_else(next_best, e, b)) for a, b, e in places]
        at_top = [ca.if_else(first, e, a) for a, e in zip(at_top, is_top, strict=True)]
        top = ca.if_else(first, d[k], top)
    squares = [x * x for x in w]
    top_square, second_square = dot_product(at_top, squares), dot_product(at_second, squares)
    others = [s * (1 - a) for s, a in zip(squares, at_top, strict=True)]
    gaps = [ca.if_else(a > 0, top, second - x) for x, a in zip(d, at_top, strict=True)]
    width = top - second + _ZERO_ENTRY**2 * top
    t = width * second_square / (top_square + second_square)
    for _ in range(_SECULAR_NEWTON_STEPS):
        inverse = [1 / (g + t) for g in gaps]
        terms = [s * e for s, e in zip(others, inverse, strict=True)]
        n = 1 + _sum_terms(terms)
        slope = 1 + top_square * dot_product(terms, inverse) / (n * n)
        t = t - (top_square / n - (width - t)) / slope
    w_top = dot_product(at_top, w)
    x = [a * n - (1 - a) * w_top * y / (g + t) for a, y, g in zip(at_top, w, gaps, strict=True)]
    return _normalise(x), second + t


@cache
def _inverse_root_quadrature() -> list[tuple[float, float]]:
    """Return pairs (t^2, weight) with ``1 / sqrt(x) = sum weight / (x + t^2)`` for x from ``_QUADRATURE_RANGE^2`` to 1."""
    from scipy.special import ellipj, ellipkm1

    period = float(ellipkm1(_QUADRATURE_RANGE**2))
    u = (np.arange(_QUADRATURE_NODES) + 0.5) * period / _QUADRATURE_NODES
    sn, cn, dn, _ = ellipj(u, 1 - _QUADRATURE_RANGE**2)
    squares = (_QUADRATURE_RANGE * sn / cn) ** 2
    weights = 2 / np.pi * period / _QUADRATURE_NODES * _QUADRATURE_RANGE * dn / cn**2
    return list(zip(squares.tolist(), weights.tolist(), strict=True))


def _replace_tiny_entries(d: Vector, w: Vector) -> Vector:
    smallest = _ZERO_ENTRY * ca.sqrt(_sum_terms(d))
    return [ca.if_else(ca.fabs(x) < smallest, smallest, x) for x in w]


def _one_hot(m: int, k: int) -> Vector:
    return [ca.SX(float(i == k)) for i in range(m)]


def _sum_terms(x: Sequence[SX]) -> SX:
    return ca.sum1(ca.vertcat(*x))


def _at_least(x: SX, floor: SX | float) -> SX:
    return ca.if_else(x < floor, floor, x)


def _normalise(x: Vector) -> Vector:
    length = ca.sqrt(dot_product(x, x))
    return [y / length for y in x]


def _scaled_outer(x: Vector, factor: SX) -> Matrix:
    return [[factor * a * b for b in x] for a in x]
