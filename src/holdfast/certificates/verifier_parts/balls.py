"""Arrays of balls, which enclose true numbers by doubles with error radii."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

try:
    import flint as flint
except ImportError:  # reported when a file is checked; the sentence of a claim needs no balls
    flint = None

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

# A sum of hundreds of products of non-negative doubles, times ROUND_UP plus MIN_ROUNDING, is an upper bound.
ROUND_UP = 1 + 1e-12
MIN_ROUNDING = 1e-300


class BallArray:
    """Array of true numbers, each within ``radius`` of ``center``."""

    def __init__(self, center: Any, radius: Any = 0.0) -> None:
        self.center: Array = np.asarray(center, dtype=np.float64)
        self.radius: Array = np.broadcast_to(np.asarray(radius, dtype=np.float64), self.center.shape)

    def __getitem__(self, key: Any) -> BallArray:
        return BallArray(self.center[key], self.radius[key])

    def __neg__(self) -> BallArray:
        return BallArray(-self.center, self.radius)

    def __add__(self, other: BallArray | Array) -> BallArray:
        other = as_balls(other)
        center = self.center + other.center
        return BallArray(center, (self.radius + other.radius + 2.0**-52 * abs(center)) * ROUND_UP + MIN_ROUNDING)

    def transpose(self, *axes: int) -> BallArray:
        """Permute the axes into this order."""
        return BallArray(self.center.transpose(axes), self.radius.transpose(axes))

    def multiply_signs(self, signs: Any) -> BallArray:
        """Multiply by an array of -1, 0 and 1, which causes no rounding."""
        return BallArray(self.center * signs, self.radius * abs(signs))

    def mirror_upper_triangle(self) -> BallArray:
        """Copy the part of square matrices above the diagonal to the part below it."""
        upper = np.triu(np.ones(self.center.shape[-2:]))
        half, strict_upper = self.multiply_signs(upper), self.multiply_signs(np.triu(upper, 1))
        return BallArray(half.center + strict_upper.center.swapaxes(-1, -2), half.radius + strict_upper.radius.swapaxes(-1, -2))

    @property
    def magnitude(self) -> Array:
        """Upper bounds of the absolute values."""
        return (abs(self.center) + self.radius) * ROUND_UP

    @property
    def lower(self) -> Array:
        """Lower bounds of the numbers."""
        return np.nextafter(self.center - self.radius, -np.inf)


def as_balls(x: BallArray | Array) -> BallArray:
    """Convert doubles, which are exact numbers, to an array of balls."""
    return x if isinstance(x, BallArray) else BallArray(x)


def einsum(subscripts: str, a: BallArray | Array, b: BallArray | Array) -> BallArray:
    """Multiply arrays like ``numpy.einsum``, with sums of at most 64 terms, so that the error is below 65 roundings."""
    a, b = as_balls(a), as_balls(b)
    radius = np.einsum(subscripts, abs(a.center), b.radius * ROUND_UP + 2.0**-46 * abs(b.center))
    if a.radius.any():
        radius += np.einsum(subscripts, a.radius, b.magnitude)
    return BallArray(np.einsum(subscripts, a.center, b.center), radius * ROUND_UP + MIN_ROUNDING)


def cross_matrix(a: BallArray) -> BallArray:
    """Return the matrices (..., 3, 3) that map b to a x b."""
    arrays = [np.zeros((*a.center.shape, 3)) for _ in range(2)]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        for matrix, vector, sign in ((arrays[0], a.center, -1.0), (arrays[1], a.radius, 1.0)):
            matrix[..., i, j], matrix[..., j, i] = sign * vector[..., k], vector[..., k]
    return BallArray(*arrays)


def bound_length(x: Array, axis: int = 1) -> Array:
    """Return upper bounds of the lengths of vectors."""
    return np.asarray(np.sqrt((x**2).sum(axis=axis)) * ROUND_UP + 1e-160)


def solve_or_nan(a: Array, b: Array) -> Array:
    """Solve linear systems (N, k, k) approximately; the solution of a singular system is NaN, which proves nothing."""
    regular = abs(np.linalg.slogdet(a)[0])[:, None, None] > 0
    return np.where(regular, np.linalg.solve(np.where(regular, a, np.eye(a.shape[-1])), b), np.nan)


def concatenate(axis: int, *parts: BallArray) -> BallArray:
    """Concatenate arrays along an axis."""
    return BallArray(np.concatenate([x.center for x in parts], axis), np.concatenate([x.radius for x in parts], axis))


def stack_second(parts: list[BallArray]) -> BallArray:
    """Stack arrays along a new second axis."""
    return concatenate(1, *(part[:, None] for part in parts))


def select_rows(use_first: Flags, a: BallArray, b: BallArray) -> BallArray:
    """Select rows of the first array where ``use_first`` (N,) is true, and of the second elsewhere."""
    mask = use_first.reshape(-1, *[1] * (a.center.ndim - 1))
    return BallArray(np.where(mask, a.center, b.center), np.where(mask, a.radius, b.radius))


def round_up(arb_ball: Any) -> float:
    """Return a double above an Arb ball."""
    return math.nextafter(float(arb_ball.upper()), math.inf)
