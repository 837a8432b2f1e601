"""Probabilities and their differences with confidence intervals, and the sums of weights that say how sure they are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Interval:
    """A probability with its confidence interval."""

    value: float
    low: float
    high: float
    confidence: float

    @classmethod
    def of(cls, hits: float, size: int, confidence: float = 0.95) -> Interval:
        """Share ``hits / size`` with its Wilson score interval."""
        from scipy import stats

        limits = stats.binomtest(round(hits), size).proportion_ci(confidence_level=confidence, method="wilson")
        return cls(float(hits / size), float(limits.low), float(limits.high), confidence)

    @classmethod
    def of_share(cls, share: float, effective: float, confidence: float = 0.95) -> Interval:
        """A share of weighted samples with the Wilson score interval of ``effective`` equal ones, which need not be whole.

        Source: Wilson 1927; for weights with the effective sample size of Kish 1965, so it is approximate.
        """
        from scipy.special import ndtri

        z2 = float(ndtri(0.5 + confidence / 2)) ** 2 / effective
        middle = (share + z2 / 2) / (1 + z2)
        half = float(np.sqrt(z2 * share * (1 - share) + z2 * z2 / 4)) / (1 + z2)
        low, high = 0.0 if share <= 0 else max(middle - half, 0.0), 1.0 if share >= 1 else min(middle + half, 1.0)
        return cls(share, low, high, confidence)

    def __str__(self) -> str:
        return f"{self.value:.4f} ({self.low:.4f} to {self.high:.4f}, {self.confidence:.0%})"


@dataclass(frozen=True)
class Difference:
    """A mean difference between two things that were tried on the same cases, with its confidence interval.

    Attributes:
        value: The second's mean minus the first's.
        low, high: Ends of the interval.
        confidence: Of the interval.
        p_value: Two-sided, of no difference at all.
    """

    value: float
    low: float
    high: float
    confidence: float
    p_value: float

    @classmethod
    def of_pairs(cls, first: NDArray[np.bool_], second: NDArray[np.bool_], confidence: float = 0.95) -> Difference:
        """Difference of two shares of the same N cases, (N,) each, one or more; only the cases that differ tell.

        Source: Newcombe 1998, method 10 (Wilson scores of both shares, and the correlation between them), for the interval;
        McNemar's exact test for the p value.
        """
        from scipy import stats

        size = len(first)
        one, two = (Interval.of(int(x.sum()), size, confidence) for x in (first, second))
        both, neither = float((first & second).sum()), float((~first & ~second).sum())
        lost, won = float((first & ~second).sum()), float((~first & second).sum())
        spread = np.sqrt((both + lost) * (won + neither) * (both + won) * (lost + neither))
        excess = both * neither - lost * won
        excess = max(excess - size / 2, 0.0) if excess > 0 else excess
        correlation = float(excess / spread) if spread > 0 else 0.0
        value = two.value - one.value
        low = value - _side(two.value - two.low, one.high - one.value, correlation)
        high = value + _side(two.high - two.value, one.value - one.low, correlation)
        p = stats.binomtest(round(won), round(won + lost)).pvalue if won + lost else 1.0
        return cls(value, max(low, -1.0), min(high, 1.0), confidence, float(p))

    @classmethod
    def of_means(cls, differences: Array, confidence: float = 0.95) -> Difference:
        """Mean of differences (N,), two or more, with the interval and the test of Student's t."""
        from scipy import stats

        value, error = float(np.mean(differences)), float(stats.sem(differences))
        if error == 0:
            return cls(value, value, value, confidence, 1.0 if value == 0 else 0.0)
        degrees = len(differences) - 1
        half = float(stats.t.ppf(0.5 + confidence / 2, degrees)) * error
        return cls(value, value - half, value + half, confidence, float(2 * stats.t.sf(abs(value) / error, degrees)))


def _side(a: float, b: float, correlation: float) -> float:
    return float(np.sqrt(max(a * a - 2 * correlation * a * b + b * b, 0.0)))


@dataclass
class Sums:
    """Of the weights w of some samples: ``sum w`` and ``sum w^2``."""

    weight: float = 0.0
    squares: float = 0.0

    def add(self, weights: Array) -> None:
        """Count more samples."""
        self.weight += float(weights.sum())
        self.squares += float(weights @ weights)


def check_confidence(confidence: float) -> None:
    """Refuse what is no confidence."""
    if not 0 < confidence < 1:
        raise InputError(f"confidence is {confidence:g}; it must be between 0 and 1, for example 0.95")
