"""Measures of the paper over the configurations of a start, and which points of a motion are looked at.

Source: Goel, Maciejewski, Balakrishnan 2005, section on the analysis of a workspace.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.intp]

ARC = 1e-9  # rad: this far outside an arc still counts as inside
Arcs = Sequence[tuple[float, float]]

REACH, FINISH = ("R100", "Ravg", "Rsens"), ("F100", "Favg", "Fsens")
NAMES = (*REACH, *FINISH)


@dataclass(frozen=True, eq=False)
class Measures:
    """Of a share of each motion, over the configurations of a start, in percent.

    Attributes:
        full: (P, ...) share of the configurations of which the whole motion counts: R100, F100.
        average: (P, ...) Ravg, Favg.
        spread: (P, ...) greatest minus least: Rsens, Fsens.
    """

    full: Array
    average: Array
    spread: Array

    @property
    def parts(self) -> tuple[Array, Array, Array]:
        """Full, average and spread: in the order of the names ``REACH`` and ``FINISH``."""
        return self.full, self.average, self.spread

    @classmethod
    def of(cls, shares: Array, owner: Index, starts: int) -> Measures:
        """From shares (R, k) of the motions of starts ``owner`` (R,); NaN shares are left out, starts without any are NaN."""
        whole, average, spread = (np.full((starts, shares.shape[1]), np.nan) for _ in range(3))
        for j, column in enumerate(shares.T):
            known = ~np.isnan(column)
            value, mine = column[known], owner[known]
            count = np.bincount(mine, minlength=starts)
            there = count > 0
            low, high = np.full(starts, np.inf), np.full(starts, -np.inf)
            np.minimum.at(low, mine, value)
            np.maximum.at(high, mine, value)
            sums = np.bincount(mine, value, starts), np.bincount(mine, value >= 1 - 1e-12, starts)
            average[there, j] = 100 * sums[0][there] / count[there]
            whole[there, j] = 100 * sums[1][there] / count[there]
            spread[there, j] = 100 * (high - low)[there]
        return cls(whole, average, spread)


def within(values: Array, arcs: Arcs, turns: bool) -> Flags:
    """True where values lie in one of the arcs (lower, upper); modulo 2 pi for a joint that turns."""
    inside = np.zeros(values.shape, dtype=bool)
    for lower, upper in arcs:
        if turns and upper - lower >= 2 * np.pi - ARC:
            return np.ones(values.shape, dtype=bool)
        if turns:
            inside |= (values - lower + ARC) % (2 * np.pi) <= upper - lower + 2 * ARC
        else:
            inside |= (values >= lower - ARC) & (values <= upper + ARC)
    return inside


def spaced(flags: Flags, count: NDArray[np.int64]) -> tuple[Index, Index]:
    """Of the cells (K, R) flagged in each row, ``count`` (R,) equally spaced ones: rows and cells, each pair once."""
    passed = np.cumsum(flags, axis=0)
    total = passed[-1]
    most = int(count.max(initial=0))
    rows, cells = [np.empty(0, dtype=np.intp)], [np.empty(0, dtype=np.intp)]
    for j in range(most):
        asked = np.flatnonzero((j < count) & (total > 0))
        rank = np.floor((j + 0.5) / count[asked] * total[asked])
        rows.append(asked)
        cells.append((passed[:, asked] > rank).argmax(axis=0))
    row, cell = np.concatenate(rows), np.concatenate(cells)
    pairs = np.unique(row * len(flags) + cell)
    return np.asarray(pairs // len(flags)), np.asarray(pairs % len(flags))


def averaged(values: Array, row: Index, rows: int) -> Array:
    """(R,) mean of the values of each row that are not NaN; NaN where there is none."""
    known = ~np.isnan(values)
    count = np.bincount(row[known], minlength=rows)
    with np.errstate(invalid="ignore"):
        return np.asarray(np.bincount(row[known], values[known], rows) / np.where(count > 0, count, np.nan))
