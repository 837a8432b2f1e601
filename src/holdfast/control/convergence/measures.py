"""Measures of the paper over the configurations of a start, and the points of a motion that are evaluated.

Source: Goel, Maciejewski, Balakrishnan 2005, section on the analysis of a workspace.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray

ARC_TOLERANCE_RAD = 1e-9  # rad: a value this far outside an arc still counts as inside
Arcs = Sequence[tuple[float, float]]

REACH_NAMES = ("R100", "Ravg", "Rsens")
FINISH_NAMES = ("F100", "Favg", "Fsens")
MEASURE_NAMES = (*REACH_NAMES, *FINISH_NAMES)


@dataclass(frozen=True, eq=False)
class Measures:
    """Statistics of a fraction of each motion over the configurations of P starts, percent.

    Attributes:
        full: (P, ...) percentage of the configurations whose fraction is 1: R100, F100.
        average: (P, ...) mean fraction over the configurations: Ravg, Favg.
        spread: (P, ...) largest minus smallest fraction: Rsens, Fsens.
    """

    full: FloatArray
    average: FloatArray
    spread: FloatArray

    @property
    def parts(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Full, average and spread, in the order of ``REACH_NAMES`` and ``FINISH_NAMES``."""
        return self.full, self.average, self.spread

    @classmethod
    def from_fractions(cls, shares: FloatArray, owner: IndexArray, starts: int) -> Measures:
        """Compute the measures for ``starts`` starts.

        ``shares`` (R, k) are fractions of motions between 0 and 1, NaN excluded, and ``owner`` (R,) the start of each motion.
        """
        full, average, spread = (np.full((starts, shares.shape[1]), np.nan) for _ in range(3))
        for column_index, column in enumerate(shares.T):
            is_known = ~np.isnan(column)
            value, owners = column[is_known], owner[is_known]
            count = np.bincount(owners, minlength=starts)
            has_motions = count > 0
            lowest, highest = np.full(starts, np.inf), np.full(starts, -np.inf)
            np.minimum.at(lowest, owners, value)
            np.maximum.at(highest, owners, value)
            sums = np.bincount(owners, value, starts), np.bincount(owners, value >= 1 - 1e-12, starts)
            average[has_motions, column_index] = 100 * sums[0][has_motions] / count[has_motions]
            full[has_motions, column_index] = 100 * sums[1][has_motions] / count[has_motions]
            spread[has_motions, column_index] = 100 * (highest - lowest)[has_motions]
        return cls(full, average, spread)


def is_in_arcs(values: FloatArray, arcs: Arcs, is_revolute: bool) -> BoolArray:
    """Return True for values that lie in one of the arcs (lower, upper), modulo 2 pi for a revolute joint."""
    inside = np.zeros(values.shape, dtype=bool)
    for lower, upper in arcs:
        if is_revolute and upper - lower >= 2 * np.pi - ARC_TOLERANCE_RAD:
            return np.ones(values.shape, dtype=bool)
        if is_revolute:
            inside |= (values - lower + ARC_TOLERANCE_RAD) % (2 * np.pi) <= upper - lower + 2 * ARC_TOLERANCE_RAD
        else:
            inside |= (values >= lower - ARC_TOLERANCE_RAD) & (values <= upper + ARC_TOLERANCE_RAD)
    return inside


def select_spaced(flags: BoolArray, count: IndexArray) -> tuple[IndexArray, IndexArray]:
    """Return rows and cells of ``count`` (R,) equally spaced cells among those flagged in each row (K, R), without repeats."""
    passed = np.cumsum(flags, axis=0)
    total = passed[-1]
    max_count = int(count.max(initial=0))
    rows, cells = [np.empty(0, dtype=np.intp)], [np.empty(0, dtype=np.intp)]
    for number in range(max_count):
        open_rows = np.flatnonzero((number < count) & (total > 0))
        rank = np.floor((number + 0.5) / count[open_rows] * total[open_rows])
        rows.append(open_rows)
        cells.append((passed[:, open_rows] > rank).argmax(axis=0))
    all_rows, all_cells = np.concatenate(rows), np.concatenate(cells)
    pairs = np.unique(all_rows * len(flags) + all_cells)
    return np.asarray(pairs // len(flags)), np.asarray(pairs % len(flags))


def mean_by_row(values: FloatArray, row: IndexArray, rows: int) -> FloatArray:
    """Return the mean (R,) of the values of each row that are not NaN; NaN if a row has none."""
    is_known = ~np.isnan(values)
    count = np.bincount(row[is_known], minlength=rows)
    with np.errstate(invalid="ignore"):
        return np.asarray(np.bincount(row[is_known], values[is_known], rows) / np.where(count > 0, count, np.nan))
