"""Confidence intervals of probabilities and their differences, and the sums of weights that determine their precision.

The coverage of each kind of interval was measured: benchmarks/interval_coverage.py and :doc:`/evidence/intervals`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray

BETTING_ORDERS = 16  # orders in which the bets meet the same values; the mean capital hardly depends on the original order
_MAX_BET_FRACTION = 0.75  # largest fraction of the capital that a single bet may lose


@dataclass(frozen=True, kw_only=True)
class Interval:
    """Probability or mean of values from 0 to 1 (``value``), with its interval ``low`` to ``high`` at level ``confidence``."""

    value: float
    low: float
    high: float
    confidence: float

    @classmethod
    def from_counts(cls, hits: float, size: float, confidence: float = 0.95) -> Interval:
        """Return the fraction ``hits`` / ``size`` of independent cases with its interval at the level ``confidence``.

        Weighted cases need not be whole numbers. For whole cases the coverage is at least ``confidence`` for any fraction.

        Source: Clopper and Pearson 1934.
        """
        from scipy.special import betaincinv

        rest, value = (1 - confidence) / 2, float(hits / size)
        low = float(betaincinv(hits, size - hits + 1, rest)) if hits > 0 else 0.0
        high = float(betaincinv(hits + 1, size - hits, 1 - rest)) if hits < size else 1.0
        # betaincinv ends at 1.8e-12; the limit for almost no hits is smaller
        return cls(value=value, low=min(low, value), high=max(high, value), confidence=confidence)

    @classmethod
    def of_share(cls, share: float, effective: float, confidence: float = 0.95) -> Interval:
        """Return a weighted fraction ``share`` with the ``confidence`` interval of ``effective`` equal samples."""
        low, high = _interval_ends(cls.from_counts(share * effective, effective, confidence))
        return cls(value=share, low=low, high=high, confidence=confidence)

    @classmethod
    def of_fractions(cls, values: FloatArray, confidence: float = 0.95) -> Interval:
        """Return the mean of independent ``values`` (N,), one or more, between 0 and 1, with an interval that always covers.

        For any distribution and any N the coverage is at least ``confidence``. The interval excludes a mean if a gambler who
        bets against that mean, on one value after another, would have multiplied the capital by ``2 / (1 - confidence)``. Its
        width is about 1.4 times that of Student's t for many values, and more for few.

        Source: Waudby-Smith and Ramdas 2024, hedged capital with predictable plug-in bets; averaging the capital over several
        orders is our addition (a mean of capitals is a capital as well).
        """
        low = _lower_mean_limit(values, confidence)
        high = 1 - _lower_mean_limit(1 - values, confidence)
        mean = float(np.mean(values))
        return cls(value=mean, low=min(low, mean), high=max(high, mean), confidence=confidence)

    def __str__(self) -> str:
        return f"{self.value:.4f} ({self.low:.4f} to {self.high:.4f}, {self.confidence:.0%})"


@dataclass(frozen=True, kw_only=True)
class Difference:
    """Mean difference between two methods on the same cases, with its confidence interval.

    Attributes:
        value: Mean of the second method minus mean of the first, in the unit of the cases.
        low, high: Limits of the interval, in the same unit.
        confidence: Confidence level of the interval, 0 to 1.
        p_value: Two-sided p value, 0 to 1, of the hypothesis of no difference.
    """

    value: float
    low: float
    high: float
    confidence: float
    p_value: float

    @classmethod
    def of_pairs(cls, first: NDArray[np.bool_], second: NDArray[np.bool_], confidence: float = 0.95) -> Difference:
        """Return the fraction of ``second`` minus that of ``first``, both (N,) booleans for the same N >= 1 cases.

        Only cases that differ are informative. The interval at the level ``confidence`` contains 0 unless the test rejects 0.
        Its coverage has no proof: of 700 random cases for each of N = 5 to 30 (measured) nearly all cover 0.95 or more, and the
        worst, in which the two nearly always differ, covers 0.91.

        Source: Newcombe 1998, method 10, with the Clopper-Pearson limits of both fractions (``Interval.from_counts``) instead
        of Wilson's, with which the worst case covers 0.82; McNemar's exact test for the p value.
        """
        from scipy import stats

        size = len(first)
        one, two = (Interval.from_counts(int(x.sum()), size, confidence) for x in (first, second))
        both, neither = float((first & second).sum()), float((~first & ~second).sum())
        lost, won = float((first & ~second).sum()), float((~first & second).sum())
        spread = np.sqrt((both + lost) * (won + neither) * (both + won) * (lost + neither))
        excess = both * neither - lost * won
        excess = max(excess - size / 2, 0.0) if excess > 0 else excess
        correlation = float(excess / spread) if spread > 0 else 0.0
        value = two.value - one.value
        low = value - _difference_half_width(two.value - two.low, one.high - one.value, correlation)
        high = value + _difference_half_width(two.high - two.value, one.value - one.low, correlation)
        p = float(stats.binomtest(round(won), round(won + lost)).pvalue) if won + lost else 1.0
        if p > 1 - confidence:
            low, high = min(low, 0.0), max(high, 0.0)
        return cls(value=value, low=max(low, -1.0), high=min(high, 1.0), confidence=confidence, p_value=p)

    @classmethod
    def of_fractions(cls, differences: FloatArray, confidence: float = 0.95) -> Difference:
        """Return the mean of independent ``differences`` (N,), N >= 1, from -1 to 1, with an interval that always covers.

        As ``Interval.of_fractions``, at the level ``confidence``. The p value is one over the capital of a gambler who bets
        against no difference, so the value 1 is common.
        """
        halves = (1 + differences) / 2
        mean = Interval.of_fractions(halves, confidence)
        capital = max(float(np.exp(_BettingCapital(x, confidence).log_capital(0.5))) for x in (halves, 1 - halves))
        low, high = 2 * mean.low - 1, 2 * mean.high - 1
        return cls(value=float(np.mean(differences)), low=low, high=high, confidence=confidence, p_value=min(2 / capital, 1.0))

    @classmethod
    def of_means(cls, differences: FloatArray, confidence: float = 0.95) -> Difference:
        """Return the mean of ``differences`` (N,), N >= 2, with Student's t interval at the level ``confidence`` and t test.

        Use it for unbounded quantities, such as errors in m. The coverage is as stated for normal differences and for many of
        them. For few skewed differences it may be far lower (:doc:`/evidence/intervals`); no method without bounds can do
        better.
        """
        from scipy import stats

        value, error = float(np.mean(differences)), float(stats.sem(differences))
        if error == 0:
            return cls(value=value, low=value, high=value, confidence=confidence, p_value=1.0 if value == 0 else 0.0)
        degrees = len(differences) - 1
        half = float(stats.t.ppf(0.5 + confidence / 2, degrees)) * error
        return cls(
            value=value,
            low=value - half,
            high=value + half,
            confidence=confidence,
            p_value=float(2 * stats.t.sf(abs(value) / error, degrees)),
        )


def _difference_half_width(a: float, b: float, correlation: float) -> float:
    return float(np.sqrt(max(a * a - 2 * correlation * a * b + b * b, 0.0)))


def _interval_ends(interval: Interval) -> tuple[float, float]:
    return interval.low, interval.high


class _BettingCapital:
    """Capital of bets that the mean of values (N,) is above m; each stake depends only on earlier values."""

    def __init__(self, values: FloatArray, confidence: float) -> None:
        size, shuffle = len(values), np.random.default_rng(0)
        self._values = np.stack([values, *(shuffle.permutation(values) for _ in range(BETTING_ORDERS - 1))])
        count = np.arange(2, size + 2)
        means = (0.5 + self._values.cumsum(axis=1)) / count
        squares = (0.25 + ((self._values - means) ** 2).cumsum(axis=1)) / count
        known = np.concatenate([np.full((BETTING_ORDERS, 1), 0.25), squares[:, :-1]], axis=1)
        self._stakes = np.sqrt(2 * np.log(2 / (1 - confidence)) / (size * known))

    def log_capital(self, m: float) -> float:
        """Return the mean over the orders of the logarithm of the final capital, which falls with m; on average at most 1 if m
        is the mean.
        """
        stakes = np.minimum(self._stakes, _MAX_BET_FRACTION / m)
        return float(np.logaddexp.reduce(np.log1p(stakes * (self._values - m)).sum(axis=1)) - np.log(BETTING_ORDERS))


def _lower_mean_limit(values: FloatArray, confidence: float) -> float:
    """Return the smallest mean that the bets cannot reject."""
    from scipy.optimize import brentq

    gambler, enough = _BettingCapital(values, confidence), float(np.log(2 / (1 - confidence)))
    if gambler.log_capital(1e-12) <= enough:
        return 0.0
    if gambler.log_capital(1.0) >= enough:
        return 1.0
    return float(brentq(lambda m: gambler.log_capital(m) - enough, 1e-12, 1.0, xtol=1e-9))


@dataclass
class WeightSums:
    """Sums of the weights w of samples: ``sum w`` and the largest weight that occurred or, if known, that is possible."""

    weight: float = 0.0
    largest: float = 0.0

    def add(self, weights: FloatArray) -> None:
        """Add the weights of more samples."""
        self.weight += float(weights.sum())
        self.largest = max(self.largest, float(weights.max(initial=0.0)))

    @property
    def effective_size(self) -> float:
        """Effective sample size ``sum w / max w``: the number of equally weighted samples with the same information.

        If each sample is kept with probability ``w / max w``, the kept samples have equal weights, and about this many
        remain. The variance of a weighted share is at most ``p (1 - p)`` divided by this size, so intervals and bands for
        this many equal samples are wide enough. The larger size ``(sum w)^2 / sum w^2`` does not guarantee that.
        A sample cannot reveal a rare, heavier weight that it does not contain.

        Source: Martino, Elvira, Louzada 2017 for this size; the coverage is measured (:doc:`/evidence/intervals`).
        """
        return self.weight / self.largest


def check_confidence(confidence: float) -> None:
    """Raise :class:`InputError` unless the confidence is between 0 and 1."""
    if not 0 < confidence < 1:
        raise InputError(f"confidence is {confidence:g}; it must be between 0 and 1, for example 0.95")
