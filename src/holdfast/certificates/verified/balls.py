"""Arrays of balls: true numbers, and how far from them the doubles are at most."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

try:
    import flint as flint
except ImportError:  # told when a file is to be checked: the sentence of a claim needs no balls
    flint = None

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

UP, LEAST = 1 + 1e-12, 1e-300  # a sum of hundreds of products of non-negative doubles, times UP plus LEAST, is rounded up


class Balls:
    """An array of true numbers, each within ``off`` of ``at``."""

    def __init__(self, at: Any, off: Any = 0.0) -> None:
        self.at: Array = np.asarray(at, dtype=np.float64)
        self.off: Array = np.broadcast_to(np.asarray(off, dtype=np.float64), self.at.shape)

    def __getitem__(self, key: Any) -> Balls:
        return Balls(self.at[key], self.off[key])

    def __neg__(self) -> Balls:
        return Balls(-self.at, self.off)

    def __add__(self, other: Balls | Array) -> Balls:
        other = ball(other)
        at = self.at + other.at
        return Balls(at, (self.off + other.off + 2.0**-52 * abs(at)) * UP + LEAST)

    def transposed(self, *axes: int) -> Balls:
        """With the axes in this order."""
        return Balls(self.at.transpose(axes), self.off.transpose(axes))

    def signed(self, by: Any) -> Balls:
        """Times an array of -1, 0 and 1, which rounds nothing."""
        return Balls(self.at * by, self.off * abs(by))

    def mirrored(self) -> Balls:
        """Of square matrices, those with what is above the diagonal below it as well."""
        upper = np.triu(np.ones(self.at.shape[-2:]))
        half, above = self.signed(upper), self.signed(np.triu(upper, 1))
        return Balls(half.at + above.at.swapaxes(-1, -2), half.off + above.off.swapaxes(-1, -2))

    @property
    def size(self) -> Array:
        """Above the absolute values."""
        return (abs(self.at) + self.off) * UP

    @property
    def low(self) -> Array:
        """Below the numbers."""
        return np.nextafter(self.at - self.off, -np.inf)


def ball(x: Balls | Array) -> Balls:
    """Doubles are the numbers themselves."""
    return x if isinstance(x, Balls) else Balls(x)


def times(form: str, a: Balls | Array, b: Balls | Array) -> Balls:
    """A product of arrays, as of ``einsum``, whose sums have at most 64 terms: each is off by less than 65 roundings."""
    a, b = ball(a), ball(b)
    off = np.einsum(form, abs(a.at), b.off * UP + 2.0**-46 * abs(b.at))
    if a.off.any():
        off += np.einsum(form, a.off, b.size)
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


def solve_regular(a: Array, b: Array) -> Array:
    """Solve linear systems (N, k, k) approximately; the solution of a singular system is NaN, which proves nothing."""
    regular = abs(np.linalg.slogdet(a)[0])[:, None, None] > 0
    return np.where(regular, np.linalg.solve(np.where(regular, a, np.eye(a.shape[-1])), b), np.nan)


def joined(axis: int, *parts: Balls) -> Balls:
    """One after the other, along an axis."""
    return Balls(np.concatenate([x.at for x in parts], axis), np.concatenate([x.off for x in parts], axis))


def stacked(parts: list[Balls]) -> Balls:
    """Along a new axis, the second."""
    return joined(1, *(x[:, None] for x in parts))


def either(which: Flags, a: Balls, b: Balls) -> Balls:
    """Rows of the one where ``which`` (N,) says so, else of the other."""
    mask = which.reshape(-1, *[1] * (a.at.ndim - 1))
    return Balls(np.where(mask, a.at, b.at), np.where(mask, a.off, b.off))


def above(ball: Any) -> float:
    """A double above a ball of Arb's."""
    return math.nextafter(float(ball.upper()), math.inf)
