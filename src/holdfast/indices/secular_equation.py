"""Singular values of J without one column from those of J, as straight-line code: for optimisation.

Rotated into its left singular vectors, ``J J'`` is ``D = diag(d)``, column k is w, and the reduced Jacobian has the Gram
matrix ``G = D - w w'``. Its eigenvalues are the roots of the secular equation ``sum w_i^2 / (d_i - x) = 1``, one below each
d_i. Every function here returns a value and its derivative by G; a fixed number of steps finds them, whatever the numbers.

Source of the secular equation: Golub 1973; of the quadrature: Hale, Higham, Trefethen 2008, method 3.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import casadi as ca
import numpy as np

from holdfast.kernels.program import SX
from holdfast.linalg import Vector, dot

Matrix = list[Vector]

_STEPS = 9
_TINY = 1e-10  # of the Frobenius norm: entries of w below it stand for 0, which would divide 0 by 0
_NODES = 18
_RANGE = 1e-4  # of the Frobenius norm: smaller singular values count as this far only roughly, in the mean


def minimum(d: Vector, w: Vector) -> tuple[SX, Matrix]:
    """Smallest singular value."""
    x, square = _smallest(d, _away_from_zero(d, w))
    low = ca.sqrt(square)
    return low, _outer(x, 0.5 / low)


def inverse_condition(d: Vector, w: Vector) -> tuple[SX, Matrix]:
    """Smallest singular value by the largest."""
    w = _away_from_zero(d, w)
    x, low_square = _smallest(d, w)
    y, high_square = _largest(d, w)
    low, high = ca.sqrt(low_square), ca.sqrt(high_square)
    raised, lowered = _outer(x, 0.5 / (low * high)), _outer(y, 0.5 * low / (high * high_square))
    return low / high, [[a - b for a, b in zip(*rows, strict=True)] for rows in zip(raised, lowered, strict=True)]


def mean(d: Vector, w: Vector) -> tuple[SX, Matrix]:
    """Mean singular value: ``tr sqrt(G) / m``, with the derivative ``G^(-1/2) / (2 m)`` by quadrature."""
    m = len(d)
    total = _sum(d)
    size = ca.sqrt(total)
    shares, v = [x / total for x in d], [x / size for x in w]
    root: Matrix = [[ca.SX(0)] * m for _ in range(m)]
    for square, weight in _quadrature():
        inverse = [1 / (x + square) for x in shares]
        u = [e * x for e, x in zip(inverse, v, strict=True)]
        factor = weight / (1 - dot(u, v))
        for i in range(m):
            root[i][i] = root[i][i] + weight * inverse[i]
            for k in range(i + 1):
                root[i][k] = root[i][k] + factor * u[i] * u[k]
    root = [[root[max(i, k)][min(i, k)] for k in range(m)] for i in range(m)]
    trace = dot(shares, [root[i][i] for i in range(m)]) - dot(v, [dot(row, v) for row in root])
    return size * trace / m, [[x / (2 * m * size) for x in row] for row in root]


def _smallest(d: Vector, w: Vector) -> tuple[Vector, SX]:
    """Unit eigenvector of the smallest eigenvalue, and that eigenvalue.

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
    rest = 1 - _sum([s / x for s, x in zip(squares, d, strict=True)])
    t = low_square / (_at_least(rest, 0.0) + low_square / low)
    for _ in range(_STEPS):
        inverse = [1 / (g + t) for g in gaps]
        terms = [s * e for s, e in zip(squares, inverse, strict=True)]
        total = _sum(terms)
        t = t + total * (total - 1) / dot(terms, inverse)
    floor = _TINY**2 * _sum(d)
    return _unit([x / (g + t) for x, g in zip(w, gaps, strict=True)]), _at_least(low - t, floor)


def _largest(d: Vector, w: Vector) -> tuple[Vector, SX]:
    """Unit eigenvector of the largest eigenvalue, and that eigenvalue.

    With the largest d_i on one side, ``w_1^2 / (d_1 - x) = 1 + N(x)``, the function ``w_1^2 / (1 + N(x)) - (d_1 - x)`` is
    concave, and Newton's method from the left never passes the root. The unknown is the distance from the second largest.
    """
    m = len(d)
    top, second = d[0], ca.SX(0)
    at_top, at_second = _one_hot(m, 0), [ca.SX(0)] * m
    for k in range(1, m):
        here = _one_hot(m, k)
        first, next_best = d[k] > top, d[k] > second
        second = ca.if_else(first, top, ca.if_else(next_best, d[k], second))
        places = zip(at_top, at_second, here, strict=True)
        at_second = [ca.if_else(first, a, ca.if_else(next_best, e, b)) for a, b, e in places]
        at_top = [ca.if_else(first, e, a) for a, e in zip(at_top, here, strict=True)]
        top = ca.if_else(first, d[k], top)
    squares = [x * x for x in w]
    top_square, second_square = dot(at_top, squares), dot(at_second, squares)
    others = [s * (1 - a) for s, a in zip(squares, at_top, strict=True)]
    gaps = [ca.if_else(a > 0, top, second - x) for x, a in zip(d, at_top, strict=True)]
    width = top - second + _TINY**2 * top
    t = width * second_square / (top_square + second_square)
    for _ in range(_STEPS):
        inverse = [1 / (g + t) for g in gaps]
        terms = [s * e for s, e in zip(others, inverse, strict=True)]
        n = 1 + _sum(terms)
        slope = 1 + top_square * dot(terms, inverse) / (n * n)
        t = t - (top_square / n - (width - t)) / slope
    w_top = dot(at_top, w)
    x = [a * n - (1 - a) * w_top * y / (g + t) for a, y, g in zip(at_top, w, gaps, strict=True)]
    return _unit(x), second + t


@cache
def _quadrature() -> list[tuple[float, float]]:
    """Pairs (t^2, weight) with ``1 / sqrt(x) = sum weight / (x + t^2)`` for x from ``_RANGE^2`` to 1."""
    from scipy.special import ellipj, ellipkm1

    period = float(ellipkm1(_RANGE**2))
    u = (np.arange(_NODES) + 0.5) * period / _NODES
    sn, cn, dn, _ = ellipj(u, 1 - _RANGE**2)
    squares, weights = (_RANGE * sn / cn) ** 2, 2 / np.pi * period / _NODES * _RANGE * dn / cn**2
    return list(zip(squares.tolist(), weights.tolist(), strict=True))


def _away_from_zero(d: Vector, w: Vector) -> Vector:
    least = _TINY * ca.sqrt(_sum(d))
    return [ca.if_else(ca.fabs(x) < least, least, x) for x in w]


def _one_hot(m: int, k: int) -> Vector:
    return [ca.SX(float(i == k)) for i in range(m)]


def _sum(x: Sequence[SX]) -> SX:
    return ca.sum1(ca.vertcat(*x))


def _at_least(x: SX, floor: SX | float) -> SX:
    return ca.if_else(x < floor, floor, x)


def _unit(x: Vector) -> Vector:
    length = ca.sqrt(dot(x, x))
    return [y / length for y in x]


def _outer(x: Vector, factor: SX) -> Matrix:
    return [[factor * a * b for b in x] for a in x]
