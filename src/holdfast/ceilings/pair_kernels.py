"""Theorem R3: a kernel over pairs of joints that bounds what two failures leave, and its certificate, replayed in integers.

Let y be the squared length of a joint's column among the orthonormal rows of the Jacobian, so ``sum y = m`` and
``1 - y = rho^2``, and s the squared cosine between the columns of two joints. What both locks leave is
``(1-y)(1-z) - y z s``. The sum of a kernel ``f(y, z, s)`` of :func:`kernel` over all pairs and of its :func:`diagonal` over all
joints is not negative for any Jacobian. If f is negative for every pair that leaves ``t`` or more, and the diagonal too, no
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

Integers = NDArray[np.int64]
Exact = NDArray[np.object_]  # of fractions
Term = tuple[list[Exact], Exact, Exact]  # functions of one length, their weights, a polynomial in s
Boxes = tuple[Integers, Integers, Integers, Integers]  # coefficients of both polynomials, lower corners, edges

_LARGEST = 1 << 56  # coefficients as integers: sums of two stay below the 63 bits
_BATCH = 4000
_BOXES = 20_000_000
_FULL = 1 << 30  # an edge of the whole box; no box is halved more often
_GIVEN_UP = "the kernel is not proven negative where it has to be"


@dataclass(frozen=True, eq=False)
class PairCertificate:
    """A kernel that proves a bound of what is left after two failures.

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
    def longest(self) -> tuple[Fraction, Fraction]:
        """Least and largest y of a joint if every pair of locks leaves the bound: its n - 1 pairs sum to ``(p-1)(1-y)``."""
        largest = 1 - self.bound**2 * (self.n - 1) / (self.n - self.m - 1)
        return max(Fraction(0), self.m - (self.n - 1) * largest), largest

    def proven(self) -> float:
        """The bound, rounded up, after every claim was proven in integers.

        Raises:
            ValueError: The kernel proves nothing.
        """
        least, largest = self.longest
        if not 0 <= least < largest < 1:
            raise ValueError("the bound leaves no room for lengths of columns")
        corners = [[least, largest]] * 2 + [[Fraction(0), Fraction(1)]]
        left = [[[(1 - y) * (1 - z) - y * z * s - self.bound**2 for s in corners[2]] for z in corners[1]] for y in corners[0]]
        _negative(_bernstein(diagonal(self))[:, None, None])
        _negative(_bernstein(kernel(self)), np.array(left))
        rounded = float(self.bound)
        return rounded if Fraction(rounded) >= self.bound else float(np.nextafter(rounded, 1))


@cache
def certificates() -> dict[tuple[int, int], PairCertificate]:
    """The stored certificates, by joints and rows."""
    text = (Path(__file__).parent / "pair_certificates.json").read_text(encoding="utf-8")
    found = [
        PairCertificate(
            n=int(c["joints"]),
            m=int(c["rows"]),
            bound=c["bound"],
            row=tuple(map(np.array, c["row"])),
            null=tuple(map(np.array, c["null"])),
            linear=(np.array(c["linear"][0]), np.array(c["linear"][1]), np.array(c["linear"][2])),
        )
        for c in json.loads(text, parse_float=Fraction, parse_int=Fraction)
    ]
    return {(c.n, c.m): c for c in found}


def kernel(c: PairCertificate) -> Exact:
    """``f`` as a polynomial in u, v and s, coefficients (U, U, S); u and v go from 0 to 1 as y and z from least to largest.

    Positive definite kernels of the angles on both sides, Gegenbauer polynomials of degree ``2 l`` in the cosine with weights
    that depend on the lengths, and three identities: the squared entries of a row of the projector sum to its diagonal
    entry, its diagonal sums to m, and there are n joints.
    """
    y, rest, powers = _lengths(c)
    terms: list[Term] = [(powers, r @ r.T, _gegenbauer(degree, c.m)) for degree, r in enumerate(c.row)]
    for degree, r in enumerate(c.null, start=1):
        for j, g in enumerate(_gegenbauer(degree, c.n - c.m)):
            both = _product(*[y] * j, *[rest] * (degree - j))
            terms.append(([_product(both, x) for x in powers], r @ r.T, np.array([Fraction(0)] * j + [g])))
    swapped = np.array([[0, Fraction(1, 2)], [Fraction(1, 2), 0]])
    for h, with_, s in zip(_free(c), (y, y, np.array([Fraction(1)])), ((0, 1), (1,), (1,)), strict=True):
        terms.append(([h, with_], swapped, np.array(s, dtype=object)))
    width = max(len(p) for functions, _, _ in terms for p in functions)
    found = np.full((width, width, max(len(p) for _, _, p in terms)), Fraction(0))
    for functions, weights, angles in terms:
        sides = np.array([_wide(p, width) for p in functions])
        found[:, :, : len(angles)] += (sides.T @ weights @ sides)[:, :, None] * angles
    return found


def diagonal(c: PairCertificate) -> Exact:
    """What the kernel's sum takes from each joint, a polynomial in u, coefficients (U,)."""
    y, rest, powers = _lengths(c)
    terms = []
    for degree, r in [*((0, r) for r in c.row), *enumerate(c.null, start=1)]:
        weight = _product(*[rest] * (2 * degree))
        terms += [_product(weight, powers[a], powers[b]) * (r @ r.T)[a, b] for a in range(len(r)) for b in range(len(r))]
    squares, lengths, ones = _free(c)
    longer = y - np.array([Fraction(c.m), Fraction(0)])
    terms += [-_product(squares, rest), _product(lengths, longer), -(c.n - 1) * ones]
    width = max(map(len, terms))
    return np.asarray(sum(_wide(p, width) for p in terms))


def _lengths(c: PairCertificate) -> tuple[Exact, Exact, list[Exact]]:
    """y, 1 - y and the powers 0, 1, ... of ``4 (y - m/n)``, polynomials in u."""
    least, largest = c.longest
    y = np.array([least, largest - least])
    centred = 4 * (y - np.array([Fraction(c.m, c.n), Fraction(0)]))
    powers = [_product(*[centred] * a) for a in range(max(len(c.row[0]), *map(len, c.linear)))]
    return y, np.array([Fraction(1), Fraction(0)]) - y, powers[: len(c.row[0])]


def _free(c: PairCertificate) -> list[Exact]:
    """The free functions of one joint as polynomials in u."""
    least, largest = c.longest
    centred = 4 * np.array([least - Fraction(c.m, c.n), largest - least])
    found = []
    for h in c.linear:
        powers = [_product(*[centred] * a) for a in range(len(h))]
        found.append(np.asarray(sum(x * _wide(p, len(h)) for x, p in zip(h, powers, strict=True))))
    return found


def _product(*polynomials: Exact) -> Exact:
    found = np.array([Fraction(1)])
    for p in polynomials:
        found = np.convolve(found, p)
    return found


def _wide(p: Exact, width: int) -> Exact:
    return np.array([*p, *[Fraction(0)] * (width - len(p))])


def _gegenbauer(degree: int, dimension: int) -> Exact:
    """Coefficients of s, the squared cosine, in the Gegenbauer polynomial of degree ``2 degree`` that is 1 at 1."""
    found, factor = np.full(degree + 1, Fraction(0)), Fraction(1)
    for k in range(degree + 1):  # a hypergeometric series in 1 - s
        for j in range(k + 1):
            found[j] += factor * comb(k, j) * (-1) ** j
        factor *= (k - degree) * (degree + k + Fraction(dimension, 2) - 1) / ((Fraction(dimension - 1, 2) + k) * (k + 1))
    return found


def _bernstein(polynomial: Exact) -> Exact:
    """Its coefficients in the Bernstein basis over the unit box: their largest is no less than any value there."""
    for axis, width in enumerate(polynomial.shape):
        change = np.array([[Fraction(comb(i, j), comb(width - 1, j)) for j in range(width)] for i in range(width)])
        polynomial = np.moveaxis(np.tensordot(change, polynomial, (1, axis)), 0, axis)
    return polynomial


def _rounded_up(coefficients: Exact) -> Integers:
    """A positive multiple, rounded upwards to integers."""
    scale = _LARGEST / max(abs(x) for x in coefficients.ravel())
    return np.array([-((-x * scale).__floor__()) for x in coefficients.ravel()], dtype=np.int64).reshape(coefficients.shape)


def _negative(coefficients: Exact, inside: Exact | None = None) -> int:
    """Prove a polynomial negative on the unit box wherever another one is not, and ``u <= v``: both are halved, rounding up.

    Args:
        coefficients: (U, V, S) of the Bernstein basis; symmetric in u and v where ``inside`` is given.
        inside: (2, 2, 2) of a polynomial that is linear in each direction.

    Returns:
        Boxes that were looked at.

    Raises:
        ValueError: It is not proven.
    """
    start = _rounded_up(coefficients)[None]
    region = np.ones((1, 2, 2, 2), dtype=np.int64) if inside is None else _rounded_up(inside)[None]
    place, edge = np.zeros((1, 3), dtype=np.int64), np.full((1, 3), _FULL)
    waiting: list[Boxes] = [(start, region, place, edge)]
    looked_at = 0
    while waiting:
        values, region, place, edge = waiting.pop()
        looked_at += len(values)
        open_ = (values.max(axis=(1, 2, 3)) >= 0) & (region[:, 0, 0, 0] >= 0)  # the region's polynomial falls in each direction
        if inside is not None:
            open_ &= place[:, 0] < place[:, 1] + edge[:, 1]
        values, region, place, edge = values[open_], region[open_], place[open_], edge[open_]
        if not len(values):
            continue
        if looked_at > _BOXES or (edge.min() <= 1) or ((values[:, 0, 0, 0] >= 0) & (region[:, 0, 0, 0] >= 0)).any():
            raise ValueError(_GIVEN_UP)
        spread = np.stack([abs(np.diff(values, axis=a)).max(axis=(1, 2, 3), initial=0) for a in (1, 2, 3)], axis=1)
        longest = spread.argmax(axis=1)
        for axis in range(3):
            some = longest == axis
            if some.any():
                waiting += _halves((values[some], region[some], place[some], edge[some]), axis)
    return looked_at


def _halves(boxes: Boxes, axis: int) -> list[Boxes]:
    """Both halves of some boxes along an axis, in batches."""
    values, region, place, edge = boxes
    edge = edge.copy()
    edge[:, axis] //= 2
    beyond = place.copy()
    beyond[:, axis] += edge[:, axis]
    (low, high), (near, far) = _halved(values, axis + 1), _halved(region, axis + 1)
    pairs = ((low, high), (near, far), (place, beyond), (edge, edge))
    both = [np.concatenate(x) for x in pairs]
    return [(both[0][i], both[1][i], both[2][i], both[3][i]) for i in _batches(len(both[0]))]


def _batches(count: int) -> list[slice]:
    return [slice(i, i + _BATCH) for i in range(0, count, _BATCH)]


def _halved(coefficients: Integers, axis: int) -> tuple[Integers, Integers]:
    """The coefficients on both halves of a direction, each rounded upwards."""
    last = np.moveaxis(coefficients, axis, 0).copy()
    low, high = np.empty_like(last), np.empty_like(last)
    degree = len(last) - 1
    for i in range(degree + 1):
        low[i], high[degree - i] = last[0], last[-1]
        last = (last[:-1] + last[1:] + 1) >> 1
    return np.moveaxis(low, 0, axis), np.moveaxis(high, 0, axis)
