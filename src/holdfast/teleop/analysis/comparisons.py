"""Paired comparisons: t-tests with Holm's correction, effect sizes with intervals, and a test by ranks beside each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.errors import InputError

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Paired:
    """A paired comparison, two-sided; NaN where there is nothing to compute it from.

    Attributes:
        n: Pairs.
        difference: Mean of first minus second.
        low, high: Its confidence interval.
        t: Student's t.
        df: Its degrees of freedom.
        p: Of t.
        dz: Cohen's dz: the mean of the differences over their standard deviation.
        dz_low, dz_high: Its confidence interval, by the noncentral t distribution.
        median_difference: Of the pairs.
        wilcoxon: p of Wilcoxon's signed-rank test, exact with ties too; pairs without a difference are left out.
        rank_biserial: Share of the rank sum in favour of the first minus that of the second, -1 to 1.
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


def paired(first: ArrayLike, second: ArrayLike, confidence: float = 0.95) -> Paired:
    """Compare pairs of values.

    Args:
        first: (n,) values.
        second: (n,) of the same subjects, in the same order. Pairs with a NaN are left out: ``n`` tells.
        confidence: Of the intervals.

    Raises:
        InputError: Not two lists of the same length, or a confidence that is not between 0 and 1.

    Source: Goel et al. 2003, section 7, for the t-test; Cumming and Finch 2001 for the interval of dz; Kerby 2014.
    """
    from scipy import stats

    x, y = np.asarray(first, dtype=np.float64), np.asarray(second, dtype=np.float64)
    if x.ndim != 1 or x.shape != y.shape:
        raise InputError(f"the values have shapes {x.shape} and {y.shape}; pairs need two lists of the same length")
    if not 0 < confidence < 1:
        raise InputError(f"confidence is {confidence:g}; it must be between 0 and 1, for example 0.95")
    d = (x - y)[np.isfinite(x) & np.isfinite(y)]
    n, nan = len(d), float("nan")
    untold = dict.fromkeys(("t", "p", "dz", "dz_low", "dz_high", "wilcoxon", "rank_biserial"), nan)
    if n < 2:
        difference = float(d.mean()) if n else nan
        return Paired(n=n, difference=difference, low=nan, high=nan, df=n - 1, median_difference=nan, **untold)
    mean, spread = float(d.mean()), float(d.std(ddof=1))
    median = float(np.median(d))
    if spread <= 1e-14 * np.abs(d).max():
        return Paired(n=n, difference=mean, low=mean, high=mean, df=n - 1, median_difference=median, **untold)
    t = float(mean / (spread / np.sqrt(n)))
    half = float(stats.t.ppf(0.5 + confidence / 2, n - 1) * spread / np.sqrt(n))
    limits = [z / float(np.sqrt(n)) for z in noncentrality_interval(t, n - 1, confidence)]
    ranks = stats.rankdata(np.abs(d[d != 0]))
    favour = float(np.sum(ranks * np.sign(d[d != 0])) / ranks.sum())
    p = float(2 * stats.t.sf(abs(t), n - 1))
    by_rank = signed_rank_p(ranks, d[d != 0] > 0)
    return Paired(
        n=n,
        difference=mean,
        low=mean - half,
        high=mean + half,
        t=t,
        df=n - 1,
        p=p,
        dz=mean / spread,
        dz_low=limits[0],
        dz_high=limits[1],
        median_difference=median,
        wilcoxon=by_rank,
        rank_biserial=favour,
    )


def signed_rank_p(ranks: NDArray[np.float64], positive: NDArray[np.bool_]) -> float:
    """Two-sided p of Wilcoxon's signed-rank test, exact for any ties: every sign of every rank is as likely as the other.

    Args:
        ranks: (N,) of the absolute differences that are not zero, ties with their mean rank.
        positive: (N,) which of them are above zero.
    """
    whole = np.rint(2 * ranks).astype(np.int64)  # mean ranks are halves
    chance = np.zeros(int(whole.sum()) + 1)  # of each sum of positive ranks
    chance[0] = 1.0
    for rank in whole:
        moved = np.zeros_like(chance)
        moved[rank:] = chance[: len(chance) - rank]
        chance = (chance + moved) / 2
    found = int(whole[positive].sum())
    return float(min(2 * min(chance[: found + 1].sum(), chance[found:].sum()), 1.0))


def noncentrality_interval(t: float, df: int, confidence: float) -> tuple[float, float]:
    """The noncentralities under which the observed t is just not too large and just not too small."""
    from scipy import optimize, stats

    if t < 0:  # scipy's far lower tail of a noncentral t is NaN: stay with positive t
        low, high = noncentrality_interval(-t, df, confidence)
        return -high, -low

    def at(probability: float) -> float:
        def excess(z: float) -> float:
            return float(stats.nct.cdf(t, df, z)) - probability

        if stats.t.cdf(t, df) < probability:
            return float(optimize.brentq(excess, -10.0, 0.0, xtol=1e-10))
        return float(optimize.brentq(excess, 0.0, 4 * t + 10.0, xtol=1e-10))

    return at(0.5 + confidence / 2), at(0.5 - confidence / 2)


def holm(p: ArrayLike) -> Array:
    """Correct several p for their number by Holm's step-down; NaN stay, and are not counted.

    Source: Holm 1979.
    """
    values = np.asarray(p, dtype=np.float64)
    out = np.full(values.shape, np.nan)
    there = np.flatnonzero(np.isfinite(values))
    order = there[np.argsort(values[there])]
    out[order] = np.minimum(1.0, np.maximum.accumulate(values[order] * np.arange(len(order), 0, -1)))
    return out
