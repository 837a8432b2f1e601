"""PKE (8) as a function of the damping, in closed form for many rows at once, and the searches one would try on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

GOLDEN = (np.sqrt(5) - 1) / 2
NOISE = 1e-12  # relative: smaller steps of PKE are rounding


class PeakError:
    """``PKE^2 = s^2 |y|^2 + max_i (j_i'y)^2 (2 s + |j_i|^2)``, y = (J J' + s I)^-1 u, s = damping^2, of N rows.

    Args:
        j: (N, m, n) scaled Jacobians.
        u: (N, m) directions of norm 1.

    Attributes:
        largest: (N,) the largest damping with which the healthy arm's error is within the allowed one.
    """

    def __init__(self, j: Array, u: Array, allowed: float = 0.5) -> None:
        left, sigma, right = np.linalg.svd(j, full_matrices=False)
        self._squares = sigma**2
        self._c = np.einsum("rmk,rm->rk", left, u)
        self._products = (sigma * self._c)[:, :, None] * right  # (V' j_i)_k c_k
        self._columns = (j**2).sum(axis=1)
        self.largest = self._largest(allowed)

    def __call__(self, damping: Array, rows: slice = slice(None)) -> Array:
        """(N,) or (N, K) for dampings of that shape."""
        s = np.asarray(damping)[..., None] ** 2
        x, c, products, columns = (a[rows] for a in (self._squares, self._c, self._products, self._columns))
        if s.ndim == 3:
            x, c, columns = x[:, None], c[:, None], columns[:, None]
        y = 1 / (x + s)
        along = np.matmul(y if s.ndim == 3 else y[:, None], products)
        along = along if s.ndim == 3 else along[:, 0]
        return np.asarray(np.sqrt(((s * c * y) ** 2).sum(axis=-1) + (along**2 * (2 * s + columns)).max(axis=-1)))

    def _healthy(self, s: Array) -> Array:
        return np.asarray(np.linalg.norm(s[:, None] * self._c / (self._squares + s[:, None]), axis=1))

    def _largest(self, allowed: float) -> Array:
        """By bisection of log s."""
        ratio = allowed / (1 - allowed)
        low, high = np.log(self._squares[:, -1] * ratio), np.log(self._squares[:, 0] * ratio)
        for _ in range(80):
            middle = (low + high) / 2
            short = self._healthy(np.exp(middle)) < allowed
            low, high = np.where(short, middle, low), np.where(short, high, middle)
        return np.asarray(np.exp((low + high) / 4))

    def golden_section(self, steps: int = 80) -> Array:
        """(N,) dampings where a golden-section search of [0, largest] ends."""
        return golden(self, np.zeros_like(self.largest), self.largest, steps)

    def dense(self, points: int = 600, chunk: int = 250) -> tuple[Array, NDArray[np.int64]]:
        """(N,) least PKE and (N,) number of local minima on a grid of [0, largest], half even and half logarithmic.

        Each cell of a minimum is searched further by golden section. An end of the interval counts where PKE rises from it.
        """
        half = points // 2
        shape = np.unique(np.concatenate([np.linspace(0, 1, half), np.geomspace(1e-5, 1, points - half)]))
        least, count = np.empty(len(self.largest)), np.empty(len(self.largest), dtype=np.int64)
        for start in range(0, len(least), chunk):
            rows = slice(start, start + chunk)
            grid = self.largest[rows, None] * shape
            values = self(grid, rows)
            step = np.diff(values, axis=1)
            step[np.abs(step) < NOISE * values[:, 1:]] = 0
            count[rows] = [_minima(np.sign(x)) for x in step]
            best = values.argmin(axis=1)
            at = np.arange(len(grid))
            low, high = grid[at, np.maximum(best - 1, 0)], grid[at, np.minimum(best + 1, grid.shape[1] - 1)]
            found = golden(lambda x, r=rows: self(x, r), low, high, 60)  # type: ignore[misc]
            least[rows] = np.minimum(values.min(axis=1), self(found, rows))
        return least, count


@dataclass(frozen=True)
class TwoMinima:
    """The specification's counterexample: PKE, and where a golden section and the law end (damping and PKE)."""

    error: PeakError
    golden: tuple[float, float]
    law: tuple[float, float]


def golden(function: Callable[[Array], Array], low: Array, high: Array, steps: int) -> Array:
    """(N,) where a golden-section search for the minimum of each row ends."""
    a, b = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    fa, fb = function(a), function(b)
    for _ in range(steps):
        left = fa < fb
        low, high = np.where(left, low, a), np.where(left, b, high)
        new = np.where(left, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
        value = function(new)
        a, b = np.where(left, new, b), np.where(left, a, new)
        fa, fb = np.where(left, value, fb), np.where(left, fa, value)
    return np.asarray((low + high) / 2)


def _minima(sign: Array) -> int:
    """How often a row of steps turns from down to up, the ends included."""
    moves = sign[sign != 0]
    if not len(moves):
        return 1
    return int(((moves[:-1] < 0) & (moves[1:] > 0)).sum() + (moves[0] > 0) + (moves[-1] < 0))
