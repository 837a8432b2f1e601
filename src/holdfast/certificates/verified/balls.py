"""Arrays of balls: true numbers, and how far from them the doubles are at most."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .forms import need, real

try:
    import flint as flint
except ImportError:  # told when a file is to be checked: the sentence of a claim needs no balls
    flint = None

Array = NDArray[np.float64]

UP, LEAST = 1 + 1e-12, 1e-300  # a sum of hundreds of products of non-negative doubles, times UP plus LEAST, is rounded up


def above(ball: Any) -> float:
    """A double above a ball."""
    return math.nextafter(float(ball.upper()), math.inf)


def defect(numbers: list[str]) -> float:
    """Above |R'R - I| (Frobenius): the nearest rotation is nearer than that."""
    matrix = flint.arb_mat(3, 3, [real(x) for x in numbers])
    gram = (matrix.transpose() * matrix - flint.arb_mat([[1, 0, 0], [0, 1, 0], [0, 0, 1]])).entries()
    off = math.hypot(*(above(abs(x)) for x in gram)) * UP
    good = off < 1e-12 and matrix.det() > 0
    need(good, "a rotation of the file is none: its columns must be orthonormal to 1e-12 and right-handed")
    return off


class Balls:
    """An array of true numbers, each within ``off`` of ``at``."""

    def __init__(self, at: Any, off: Any = 0.0) -> None:
        self.at: Array = np.asarray(at, dtype=np.float64)
        self.off: Array = np.broadcast_to(np.asarray(off, dtype=np.float64), self.at.shape)

    def __getitem__(self, key: Any) -> Balls:
        return Balls(self.at[key], self.off[key])

    def __neg__(self) -> Balls:
        return Balls(-self.at, self.off)

    def __add__(self, other: Balls) -> Balls:
        at = self.at + other.at
        return Balls(at, (self.off + other.off + 2.0**-52 * abs(at)) * UP + LEAST)

    def transposed(self, *axes: int) -> Balls:
        """With the axes in this order."""
        return Balls(self.at.transpose(axes), self.off.transpose(axes))

    def signed(self, by: Any) -> Balls:
        """Times an array of -1, 0 and 1, which rounds nothing."""
        return Balls(self.at * by, self.off * abs(by))

    @property
    def size(self) -> Array:
        """Above the absolute values."""
        return (abs(self.at) + self.off) * UP

    @property
    def low(self) -> Array:
        """Below the numbers."""
        return np.nextafter(self.at - self.off, -np.inf)


def times(form: str, a: Balls, b: Balls) -> Balls:
    """A product of arrays, as of ``einsum``, whose sums have at most 64 terms: each is off by less than 65 roundings."""
    off = sum(np.einsum(form, x, y) for x, y in ((abs(a.at), b.off), (a.off, b.size), (2.0**-46 * abs(a.at), abs(b.at))))
    return Balls(np.einsum(form, a.at, b.at), off * UP + LEAST)


def crossed(a: Balls) -> Balls:
    """The matrices (..., 3, 3) that take b to a x b."""
    made = [np.zeros((*a.at.shape, 3)) for _ in range(2)]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        for x, given, sign in ((made[0], a.at, -1.0), (made[1], a.off, 1.0)):
            x[..., i, j], x[..., j, i] = sign * given[..., k], given[..., k]
    return Balls(*made)


def length(x: Array, axis: int = 1) -> Array:
    """Above the lengths of vectors."""
    return np.asarray(np.sqrt((x**2).sum(axis=axis)) * UP + 1e-160)


def joined(a: Balls, b: Balls) -> Balls:
    """Along the last axis."""
    return Balls(np.concatenate([a.at, b.at], -1), np.concatenate([a.off, b.off], -1))


def either(which: NDArray[np.bool_], a: Balls, b: Balls) -> Balls:
    """Rows of the one where ``which`` (N,) says so, else of the other."""
    mask = which.reshape(-1, *[1] * (a.at.ndim - 1))
    return Balls(np.where(mask, a.at, b.at), np.where(mask, a.off, b.off))


def stacked(parts: list[Balls], axis: int) -> Balls:
    """Along a new axis."""
    return Balls(np.stack([x.at for x in parts], axis), np.stack([x.off for x in parts], axis))
