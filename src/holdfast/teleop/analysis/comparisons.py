"""Paired comparisons: t-tests with Holm's correction, effect sizes with intervals, and rank tests."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray


@dataclass(frozen=True, kw_only=True)
class PairedComparison:
    """Two-sided paired comparison; values that cannot be computed are NaN.

    Attributes:
        n: Number of pairs.
        difference: Mean of first minus second.
        low, high: Confidence interval of the mean difference.
        t: Student's t.
        df: Degrees of freedom of t.
        p: p-value of t.
        dz: Cohen's dz, the mean of the differences over their standard deviation.
        dz_low, dz_high: Confidence interval of dz, by the noncentral t distribution.
        median_difference: Median of the differences.
        wilcoxon: p-value of Wilcoxon's signed-rank test, exact with ties too; pairs without a difference are left out.
        rank_biserial: Fraction of the rank sum in favour of the first minus that of the second, -1 to 1.
    """

    n: int
    difference: float
    low: float
    high: float
    t: float
    df: int
    p: float
    dz: float
    dz_low: float
    dz_high: float
    median_difference: float
    wilcoxon: float
    rank_biserial: float


def compare_pairs(first: ArrayLike, second: ArrayLike, confidence: float = 0.95) -> PairedComparison:
    """Compare pairs of values.

    Args:
        first: (n,) values.
        second: (n,) values of the same subjects, in the same order. Pairs with a NaN are left out; ``n`` counts the others.
        confidence: Confidence level of the intervals, between 0 and 1.

    Raises:
        InputError: The two lists differ in length, or the confidence is not between 0 and 1.

    Source: Goel et al. 2003, section 7, for the t-test; Cumming and Finch 2001 for the interval of dz; Kerby 2014.
    """
    from scipy import stats

    x, y = np.asarray(first, dtype=np.float64), np.asarray(second, dtype=np.float64)
    if x.ndim != 1 or x.shape != y.shape:
        raise InputError(f"the values have shapes {x.shape} and {y.shape}; pairs need two lists of the same length")
    if not 0 < confidence < 1:
        raise InputError(f"confidence is {confidence:g}; it must be between 0 and 1, for example 0.95")
    differences = (x - y)[np.isfinite(x) & np.isfinite(y)]
    n, nan = len(differences), float("nan")
    undefined = dict.fromkeys(("t", "p", "dz", "dz_low", "dz_high", "wilcoxon", "rank_biserial"), nan)
    if n < 2:
        difference = float(differences.mean()) if n else nan
        return PairedComparison(n=n, difference=difference, low=nan, high=nan, df=n - 1, median_difference=nan, **undefined)
    mean, deviation = float(differences.mean()), float(differences.std(ddof=1))
    median = float(np.median(differences))
    if deviation <= 1e-14 * np.abs(differences).max():
        return PairedComparison(n=n, difference=mean, low=mean, high=mean, df=n - 1, median_difference=median, **undefined)
    t = float(mean / (deviation / np.sqrt(n)))
    half_width = float(stats.t.ppf(0.5 + confidence / 2, n - 1) * deviation / np.sqrt(n))
    dz_limits = [noncentrality / float(np.sqrt(n)) for noncentrality in noncentrality_interval(t, n - 1, confidence)]
    ranks = stats.rankdata(np.abs(differences[differences != 0]))
    rank_biserial = float(np.sum(ranks * np.sign(differences[differences != 0])) / ranks.sum())
    p = float(2 * stats.t.sf(abs(t), n - 1))
    wilcoxon_p = signed_rank_p(ranks, differences[differences != 0] > 0)
    return PairedComparison(
        n=n,
        difference=mean,
        low=mean - half_width,
        high=mean + half_width,
        t=t,
        df=n - 1,
        p=p,
        dz=mean / deviation,
        dz_low=dz_limits[0],
        dz_high=dz_limits[1],
        median_difference=median,
        wilcoxon=wilcoxon_p,
        rank_biserial=rank_biserial,
    )


def signed_rank_p(ranks: NDArray[np.float64], positive: NDArray[np.bool_]) -> float:
    """Return the two-sided p of Wilcoxon's signed-rank test, exact for any ties, from all equally likely signs of the ranks.

    Args:
        ranks: (N,) ranks of the absolute differences that are not zero; ties have their mean rank.
        positive: (N,) True for differences above zero.
    """
    doubled_ranks = np.rint(2 * ranks).astype(np.int64)  # mean ranks are halves
    probabilities = np.zeros(int(doubled_ranks.sum()) + 1)  # of each possible sum of positive ranks
    probabilities[0] = 1.0
    for rank in doubled_ranks:
        shifted = np.zeros_like(probabilities)
        shifted[rank:] = probabilities[: len(probabilities) - rank]
        probabilities = (probabilities + shifted) / 2
    positive_sum = int(doubled_ranks[positive].sum())
    return float(min(2 * min(probabilities[: positive_sum + 1].sum(), probabilities[positive_sum:].sum()), 1.0))


def noncentrality_interval(t: float, df: int, confidence: float) -> tuple[float, float]:
    """Return the confidence interval of the noncentrality of an observed t."""
    from scipy import optimize, stats

    if t < 0:  # the far lower tail of scipy's noncentral t is NaN, so a positive t is used
        lower, upper = noncentrality_interval(-t, df, confidence)
        return -upper, -lower

    def solve_noncentrality(probability: float) -> float:
        def cdf_excess(noncentrality: float) -> float:
            return float(stats.nct.cdf(t, df, noncentrality)) - probability

        if stats.t.cdf(t, df) < probability:
            return float(optimize.brentq(cdf_excess, -10.0, 0.0, xtol=1e-10))
        return float(optimize.brentq(cdf_excess, 0.0, 4 * t + 10.0, xtol=1e-10))

    return solve_noncentrality(0.5 + confidence / 2), solve_noncentrality(0.5 - confidence / 2)


def correct_by_holm(p: ArrayLike) -> FloatArray:
    """Correct p-values ``p`` (k,) for multiple tests by Holm's step-down procedure; NaN stay NaN and do not count as tests.

    Source: Holm 1979.
    """
    values = np.asarray(p, dtype=np.float64)
    corrected = np.full(values.shape, np.nan)
    finite = np.flatnonzero(np.isfinite(values))
    order = finite[np.argsort(values[finite])]
    corrected[order] = np.minimum(1.0, np.maximum.accumulate(values[order] * np.arange(len(order), 0, -1)))
    return corrected
