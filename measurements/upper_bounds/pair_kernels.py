"""Kernel over pairs of joints that bounds relative manipulability after two failures, with a certificate in integers (theorem
R3).

Let y be the squared length of a joint's column among the orthonormal rows of the Jacobian, so ``sum y = m`` and
``1 - y = rho^2``, and s the squared cosine between the columns of two joints. What both locks leave is
``(1-y)(1-z) - y z s``. The sum of a kernel ``f(y, z, s)`` of :func:`kernel_polynomial` over all pairs and of its
:func:`diagonal_term` over all joints is not negative for any Jacobian. If f is negative for every pair that leaves ``t`` or
more, and the diagonal too, no
Jacobian leaves t after every pair of locks. Numbers of a certificate are decimals, taken as fractions: nothing is rounded but
upwards. Derived here.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import comb
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import IndexArray

Exact = NDArray[np.object_]  # of fractions
Term = tuple[list[Exact], Exact, Exact]  # functions of one length, their weights, a polynomial in s
Boxes = tuple[IndexArray, IndexArray, IndexArray, IndexArray]  # coefficients of both polynomials, lower corners, edges

_LARGEST_COEFFICIENT = 1 << 56  # coefficients as integers: sums of two stay below the 63 bits
_BATCH_BOXES = 4000
_MAX_BOXES = 20_000_000
_FULL_EDGE = 1 << 30  # an edge of the whole box; no box is halved more often
_NOT_PROVED_MESSAGE = "the kernel is not proven negative where it has to be"


@dataclass(frozen=True, eq=False)
class PairCertificate:
    """Kernel that proves an upper bound after two failures.

    Attributes:
        n, m: Joints, rows of the task.
        bound: What it proves: no Jacobian keeps as much after every pair of locks.
        row: Factors R of the positive semidefinite ``R R'`` for each degree of the row side, 0 first.
        null: The same for the null side, degree 1 first.
        linear: Coefficients of the three free functions of one joint.
    """

    n: int
    m: int
    bound: Fraction
    row: tuple[Exact, ...]
    null: tuple[Exact, ...]
    linear: tuple[Exact, Exact, Exact]

    @property
    def squared_column_norm_range(self) -> tuple[Fraction, Fraction]:
        """Least and largest y of a joint if every pair of locks keeps the bound; its n - 1 pairs sum to ``(p-1)(1-y)``."""
        largest = 1 - self.bound**2 * (self.n - 1) / (self.n - self.m - 1)
        return max(Fraction(0), self.m - (self.n - 1) * largest), largest

    def proved_bound(self) -> float:
        """Bound, rounded up, after every claim was proved in integers.

        Raises:
            ValueError: The kernel proves nothing.
        """
        least, largest = self.squared_column_norm_range
        if not 0 <= least < largest < 1:
            raise ValueError("the bound leaves no room for lengths of columns")
        corners = [[least, largest]] * 2 + [[Fraction(0), Fraction(1)]]
        remaining = [
            [[(1 - y) * (1 - z) - y * z * s - self.bound**2 for s in corners[2]] for z in corners[1]] for y in corners[0]
        ]
        _prove_negative(_bernstein_coefficients(diagonal_term(self))[:, None, None])
        _prove_negative(_bernstein_coefficients(kernel_polynomial(self)), np.array(remaining))
        rounded = float(self.bound)
        return rounded if Fraction(rounded) >= self.bound else float(np.nextafter(rounded, 1))


@cache
def stored_certificates() -> dict[tuple[int, int], PairCertificate]:
    """Return the stored certificates by joints and rows."""
    text = (Path(__file__).parent / "pair_certificates.json").read_text(encoding="utf-8")
    stored = [
        PairCertificate(
            n=int(entry["joints"]),
            m=int(entry["rows"]),
            bound=entry["bound"],
            row=tuple(map(np.array, entry["row"])),
            null=tuple(map(np.array, entry["null"])),
            linear=(np.array(entry["linear"][0]), np.array(entry["linear"][1]), np.array(entry["linear"][2])),
        )
        for entry in json.loads(text, parse_float=Fraction, parse_int=Fraction)
    ]
    return {(entry.n, entry.m): entry for entry in stored}


def kernel_polynomial(c: PairCertificate) -> Exact:
    """Return ``f`` as a polynomial in u, v and s, coefficients (U, U, S); u and v run from 0 to 1 as y and z run from least to
    largest.

    Positive definite kernels of the angles on both sides, Gegenbauer polynomials of degree ``2 l`` in the cosine with weights
    that depend on the lengths, and three identities: the squared entries of a row of the projector sum to its diagonal
    entry, its diagonal sums to m, and there are n joints.
    """
    y, one_minus_y, powers = _length_polynomials(c)
    terms: list[Term] = [(powers, r @ r.T, _gegenbauer_coefficients(degree, c.m)) for degree, r in enumerate(c.row)]
    for degree, r in enumerate(c.null, start=1):
        for j, g in enumerate(_gegenbauer_coefficients(degree, c.n - c.m)):
            lengths = _multiply_polynomials(*[y] * j, *[one_minus_y] * (degree - j))
            terms.append(([_multiply_polynomials(lengths, x) for x in powers], r @ r.T, np.array([Fraction(0)] * j + [g])))
    swapped = np.array([[0, Fraction(1, 2)], [Fraction(1, 2), 0]])
    for h, with_, s in zip(_free_functions(c), (y, y, np.array([Fraction(1)])), ((0, 1), (1,), (1,)), strict=True):
        terms.append(([h, with_], swapped, np.array(s, dtype=object)))
    width = max(len(p) for functions, _, _ in terms for p in functions)
    coefficients = np.full((width, width, max(len(p) for _, _, p in terms)), Fraction(0))
    for functions, weights, angles in terms:
        sides = np.array([_pad_polynomial(p, width) for p in functions])
        coefficients[:, :, : len(angles)] += (sides.T @ weights @ sides)[:, :, None] * angles
    return coefficients


def diagonal_term(c: PairCertificate) -> Exact:
    """Return the amount that the kernel's sum takes from each joint, a polynomial in u, coefficients (U,)."""
    y, one_minus_y, powers = _length_polynomials(c)
    terms = []
    for degree, r in [*((0, r) for r in c.row), *enumerate(c.null, start=1)]:
        weight = _multiply_polynomials(*[one_minus_y] * (2 * degree))
        terms += [
            _multiply_polynomials(weight, powers[a], powers[b]) * (r @ r.T)[a, b] for a in range(len(r)) for b in range(len(r))
        ]
    squares, lengths, ones = _free_functions(c)
    longer = y - np.array([Fraction(c.m), Fraction(0)])
    terms += [-_multiply_polynomials(squares, one_minus_y), _multiply_polynomials(lengths, longer), -(c.n - 1) * ones]
    width = max(map(len, terms))
    return np.asarray(sum(_pad_polynomial(p, width) for p in terms))


def _length_polynomials(c: PairCertificate) -> tuple[Exact, Exact, list[Exact]]:
    """Return y, 1 - y, and the powers 0, 1, ... of ``4 (y - m/n)`` as polynomials in u."""
    least, largest = c.squared_column_norm_range
    y = np.array([least, largest - least])
    centred = 4 * (y - np.array([Fraction(c.m, c.n), Fraction(0)]))
    powers = [_multiply_polynomials(*[centred] * a) for a in range(max(len(c.row[0]), *map(len, c.linear)))]
    return y, np.array([Fraction(1), Fraction(0)]) - y, powers[: len(c.row[0])]


def _free_functions(c: PairCertificate) -> list[Exact]:
    """Return the free functions of one joint as polynomials in u."""
    least, largest = c.squared_column_norm_range
    centred = 4 * np.array([least - Fraction(c.m, c.n), largest - least])
    functions = []
    for h in c.linear:
        powers = [_multiply_polynomials(*[centred] * a) for a in range(len(h))]
        functions.append(np.asarray(sum(x * _pad_polynomial(p, len(h)) for x, p in zip(h, powers, strict=True))))
    return functions


def _multiply_polynomials(*polynomials: Exact) -> Exact:
    product = np.array([Fraction(1)])
    for p in polynomials:
        product = np.convolve(product, p)
    return product


def _pad_polynomial(p: Exact, width: int) -> Exact:
    return np.array([*p, *[Fraction(0)] * (width - len(p))])


def _gegenbauer_coefficients(degree: int, dimension: int) -> Exact:
    """Return the coefficients of s, the squared cosine, in the Gegenbauer polynomial of degree ``2 degree`` that is 1 at 1."""
    coefficients, factor = np.full(degree + 1, Fraction(0)), Fraction(1)
    for k in range(degree + 1):  # a hypergeometric series in 1 - s
        for j in range(k + 1):
            coefficients[j] += factor * comb(k, j) * (-1) ** j
        factor *= (k - degree) * (degree + k + Fraction(dimension, 2) - 1) / ((Fraction(dimension - 1, 2) + k) * (k + 1))
    return coefficients


def _bernstein_coefficients(polynomial: Exact) -> Exact:
    """Return the coefficients in the Bernstein basis over the unit box; the largest is an upper bound of the values there."""
    for axis, width in enumerate(polynomial.shape):
        change = np.array([[Fraction(comb(i, j), comb(width - 1, j)) for j in range(width)] for i in range(width)])
        polynomial = np.moveaxis(np.tensordot(change, polynomial, (1, axis)), 0, axis)
    return polynomial


def _round_up(coefficients: Exact) -> IndexArray:
    """Return a positive multiple, rounded upwards to integers."""
    scale = _LARGEST_COEFFICIENT / max(abs(x) for x in coefficients.ravel())
    return np.array([-((-x * scale).__floor__()) for x in coefficients.ravel()], dtype=np.int64).reshape(coefficients.shape)


def _prove_negative(coefficients: Exact, region_polynomial: Exact | None = None) -> int:
    """Prove a polynomial negative on the unit box wherever another one is not negative and ``u <= v``, by bisection with upward
    rounding.

    Args:
        coefficients: (U, V, S) of the Bernstein basis; symmetric in u and v where ``region_polynomial`` is given.
        region_polynomial: (2, 2, 2) of a polynomial that is linear in each direction.

    Returns:
        Boxes that were looked at.

    Raises:
        ValueError: It is not proven.
    """
    start = _round_up(coefficients)[None]
    region = np.ones((1, 2, 2, 2), dtype=np.int64) if region_polynomial is None else _round_up(region_polynomial)[None]
    corners, edges = np.zeros((1, 3), dtype=np.int64), np.full((1, 3), _FULL_EDGE)
    waiting: list[Boxes] = [(start, region, corners, edges)]
    looked_at = 0
    while waiting:
        values, region, corners, edges = waiting.pop()
        looked_at += len(values)
        undecided = (values.max(axis=(1, 2, 3)) >= 0) & (
            region[:, 0, 0, 0] >= 0
        )  # the region's polynomial falls in each direction
        if region_polynomial is not None:
            undecided &= corners[:, 0] < corners[:, 1] + edges[:, 1]
        values, region, corners, edges = values[undecided], region[undecided], corners[undecided], edges[undecided]
        if not len(values):
            continue
        if looked_at > _MAX_BOXES or (edges.min() <= 1) or ((values[:, 0, 0, 0] >= 0) & (region[:, 0, 0, 0] >= 0)).any():
            raise ValueError(_NOT_PROVED_MESSAGE)
        spread = np.stack([abs(np.diff(values, axis=a)).max(axis=(1, 2, 3), initial=0) for a in (1, 2, 3)], axis=1)
        longest = spread.argmax(axis=1)
        for axis in range(3):
            selected = longest == axis
            if selected.any():
                waiting += _bisect_boxes((values[selected], region[selected], corners[selected], edges[selected]), axis)
    return looked_at


def _bisect_boxes(boxes: Boxes, axis: int) -> list[Boxes]:
    """Return both halves of boxes along an axis, in batches."""
    values, region, corners, edges = boxes
    edges = edges.copy()
    edges[:, axis] //= 2
    beyond = corners.copy()
    beyond[:, axis] += edges[:, axis]
    (low, high), (near, far) = _bisect_coefficients(values, axis + 1), _bisect_coefficients(region, axis + 1)
    pairs = ((low, high), (near, far), (corners, beyond), (edges, edges))
    both = [np.concatenate(x) for x in pairs]
    return [(both[0][i], both[1][i], both[2][i], both[3][i]) for i in _batch_slices(len(both[0]))]


def _batch_slices(count: int) -> list[slice]:
    return [slice(i, i + _BATCH_BOXES) for i in range(0, count, _BATCH_BOXES)]


def _bisect_coefficients(coefficients: IndexArray, axis: int) -> tuple[IndexArray, IndexArray]:
    """Return the coefficients on both halves of a direction, each rounded upwards."""
    remaining = np.moveaxis(coefficients, axis, 0).copy()
    low, high = np.empty_like(remaining), np.empty_like(remaining)
    degree = len(remaining) - 1
    for i in range(degree + 1):
        low[i], high[degree - i] = remaining[0], remaining[-1]
        remaining = (remaining[:-1] + remaining[1:] + 1) >> 1
    return np.moveaxis(low, 0, axis), np.moveaxis(high, 0, axis)
