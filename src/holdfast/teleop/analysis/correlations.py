"""Correlation of two lists: Pearson's r with its confidence interval, and Spearman's rank correlation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError


@dataclass(frozen=True, kw_only=True)
class Correlation:
    """Correlation over tasks; values that cannot be computed are NaN.

    Attributes:
        first, second: Names of the two quantities.
        n: Number of pairs in which both values are finite.
        r: Pearson's correlation coefficient.
        low, high: Confidence interval of r, by Fisher's z; NaN for fewer than 4 pairs.
        p: Two-sided p-value of r.
        spearman: Spearman's rank correlation coefficient.
        p_spearman: Two-sided p-value of ``spearman``.
        left_out: Names of the pairs that were left out.
    """

    first: str
    second: str
    n: int
    r: float
    low: float
    high: float
    p: float
    spearman: float
    p_spearman: float
    left_out: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.first} and {self.second}: r = {self.r:.3f} ({self.low:.3f} to {self.high:.3f}), {self.n} tasks"


def correlate(
    first: ArrayLike,
    second: ArrayLike,
    names: tuple[str, str] = ("first", "second"),
    *,
    labels: list[str] | None = None,
    confidence: float = 0.95,
) -> Correlation:
    """Correlate two lists of values.

    Args:
        first: (n,) values.
        second: (n,) values. Pairs that are not finite are left out and listed.
        names: Names of the two quantities.
        labels: (n,) names of the pairs. Default: their numbers from 1.
        confidence: Confidence level of the interval.

    Raises:
        InputError: The two lists differ in length.

    Source: Goel et al. 2003, section 7 and fig. 3.
    """
    from scipy import stats

    x, y = np.asarray(first, dtype=np.float64), np.asarray(second, dtype=np.float64)
    if x.ndim != 1 or x.shape != y.shape:
        raise InputError(f"the values have shapes {x.shape} and {y.shape}; a correlation needs two lists of the same length")
    finite = np.isfinite(x) & np.isfinite(y)
    pair_labels = [str(index + 1) for index in range(len(x))] if labels is None else labels
    left_out = tuple(pair_labels[index] for index in np.flatnonzero(~finite))
    x, y = x[finite], y[finite]
    nan = float("nan")
    if len(x) < 3 or np.ptp(x) == 0 or np.ptp(y) == 0:
        return Correlation(
            first=names[0],
            second=names[1],
            n=len(x),
            **dict.fromkeys(("r", "low", "high", "p", "spearman", "p_spearman"), float("nan")),
            left_out=left_out,
        )
    pearson, spearman = stats.pearsonr(x, y), stats.spearmanr(x, y)
    lower, upper = pearson.confidence_interval(confidence) if len(x) > 3 else (nan, nan)
    return Correlation(
        first=names[0],
        second=names[1],
        n=len(x),
        r=float(pearson.statistic),
        low=float(lower),
        high=float(upper),
        p=float(pearson.pvalue),
        spearman=float(spearman.statistic),
        p_spearman=float(spearman.pvalue),
        left_out=left_out,
    )
