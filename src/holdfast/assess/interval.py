"""Probabilities with their confidence intervals, and the sums of weights that say how sure they are."""

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
        return cls(hits / size, float(limits.low), float(limits.high), confidence)

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
