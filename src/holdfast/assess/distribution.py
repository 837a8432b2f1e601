"""The distribution of an index over a region: probabilities with honest error bars."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.errors import InputError

Array = NDArray[np.float64]

BINS = 1 << 16


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

    def __str__(self) -> str:
        return f"{self.value:.4f} ({self.low:.4f} to {self.high:.4f}, {self.confidence:.0%})"


@dataclass
class Distribution:
    """Values of an index at the samples of a region, exact or, for very large runs, in fine bins.

    A pose for which no configuration was found counts as the worst possible value (0 if larger is better, infinity
    otherwise), unless ``reachable_only``.

    Attributes:
        better: ``"larger"`` or ``"smaller"``.
        values: Sorted values at the poses that have a configuration; None once they are only kept in bins.
        edges, counts: Bins and their contents, if binned: a probability is then exact at the edges.
        unreached: Poses without a configuration.
        singular: Configurations that are singular (they count with the value of the convention).
        total: Sum of the finite values.
        lowest, highest: Over the finite values.
    """

    better: Literal["larger", "smaller"]
    values: Array | None = None
    edges: Array | None = None
    counts: NDArray[np.int64] | None = None
    unreached: int = 0
    singular: int = 0
    infinite: int = 0
    total: float = 0.0
    lowest: float = np.inf
    highest: float = -np.inf
    _reached: int = field(default=0, repr=False)

    @classmethod
    def of(cls, values: ArrayLike, better: Literal["larger", "smaller"], unreached: int = 0, singular: int = 0) -> Distribution:
        """The distribution of values at hand."""
        sorted_values = np.sort(np.asarray(values, dtype=np.float64))
        finite = sorted_values[np.isfinite(sorted_values)]
        return cls(
            better,
            values=sorted_values,
            unreached=unreached,
            singular=singular,
            infinite=len(sorted_values) - len(finite),
            total=float(finite.sum()),
            lowest=float(finite[0]) if finite.size else np.nan,
            highest=float(finite[-1]) if finite.size else np.nan,
            _reached=len(sorted_values),
        )

    @property
    def reached(self) -> int:
        """Poses with a configuration."""
        return self._reached

    @property
    def samples(self) -> int:
        """All poses drawn."""
        return self._reached + self.unreached

    @property
    def mean(self) -> float:
        """Mean of the finite values at the poses that have a configuration."""
        finite = self._reached - self.infinite
        return self.total / finite if finite else np.nan

    def _size(self, reachable_only: bool) -> int:
        size = self.reached if reachable_only else self.samples
        if not self.samples:
            raise InputError("this distribution has no samples: nothing is computed yet")
        if not size:
            raise InputError(
                "this distribution has no samples; no pose was reached: use reachable_only=False or another region"
            )
        return size

    def _below(self, h: Array, reachable_only: bool) -> Array:
        """Number of samples whose value is less than h."""
        if self.values is not None:
            count = np.searchsorted(self.values, h, side="left").astype(np.float64)
        else:
            assert self.edges is not None
            assert self.counts is not None
            cumulative = np.r_[0, np.cumsum(self.counts)]
            count = np.interp(h, self.edges, cumulative[: len(self.edges)])
            count = np.where(np.isposinf(h), self.reached - self.infinite, count)
        if not reachable_only and self.better == "larger":
            count = count + np.where(h > 0, self.unreached, 0)
        return np.asarray(count)

    def cdf(self, h: ArrayLike, reachable_only: bool = False) -> Array:
        """``F(h)``, the share of samples with a value less than h; F(0) = 0.

        Source: Abdi et al. 2012, section IV; strict ``<``, so that the probability of at least 0 is 1.
        """
        h_ = np.asarray(h, dtype=np.float64)
        return np.asarray(self._below(h_, reachable_only) / self._size(reachable_only))

    def probability(self, at_least: float | None = None, at_most: float | None = None, reachable_only: bool = False) -> float:
        """Share of samples with a value of at least (or at most) a threshold: the paper's global index ``1 - F(h)``.

        Raises:
            InputError: Not exactly one threshold.
        """
        return self.interval(at_least, at_most, reachable_only).value

    def interval(
        self,
        at_least: float | None = None,
        at_most: float | None = None,
        reachable_only: bool = False,
        confidence: float = 0.95,
    ) -> Interval:
        """The probability with its Wilson score interval.

        Raises:
            InputError: Not exactly one threshold, or a confidence outside (0, 1).
        """
        if (at_least is None) == (at_most is None):
            raise InputError("give exactly one of at_least and at_most")
        _check_confidence(confidence)
        if any(h is not None and np.isnan(h) for h in (at_least, at_most)):
            raise InputError("a threshold is NaN; give a number")
        size = self._size(reachable_only)
        if at_least is not None:
            hits = size - float(self._below(np.asarray(at_least), reachable_only))
        else:
            assert at_most is not None
            up = np.nextafter(float(at_most), np.inf)
            hits = size if np.isposinf(at_most) else float(self._below(np.asarray(up), reachable_only))
        return Interval.of(hits, size, confidence)

    def band(self, confidence: float = 0.95, reachable_only: bool = False) -> float:
        """Half width of the band that holds the whole true CDF with the given confidence.

        Source: Dvoretzky, Kiefer, Wolfowitz 1956 with the constant of Massart 1990: ``sqrt(ln(2/delta)/(2N))``.
        It assumes independent samples; for scrambled Sobol points it is conservative in practice, not by theorem.
        """
        _check_confidence(confidence)
        return float(np.sqrt(np.log(2 / (1 - confidence)) / (2 * self._size(reachable_only))))

    def quantile(self, p: ArrayLike, reachable_only: bool = True) -> Array:
        """Smallest value v with ``share(value <= v) >= p``."""
        p_ = np.asarray(p, dtype=np.float64)
        if not ((p_ >= 0) & (p_ <= 1)).all():
            raise InputError("a quantile is asked for a share outside 0 to 1")
        size = self._size(reachable_only)
        lost = 0 if reachable_only else self.unreached
        rank = np.maximum(np.ceil(p_ * size) - 1, 0)  # from 0
        rank -= (rank >= 1) & (rank / size >= p_)  # p * size may round up past a whole number
        worst_first = self.better == "larger"
        offset = lost if worst_first else 0
        if self.values is not None:
            inner = np.clip(rank - offset, 0, max(self.reached - 1, 0)).astype(np.int64)
            found = self.values[inner] if self.reached else np.full(p_.shape, np.nan)
        else:
            assert self.edges is not None
            assert self.counts is not None
            cumulative = np.cumsum(self.counts)
            found = self.edges[1:][
                np.searchsorted(cumulative, np.maximum(rank - offset, 0), side="right").clip(max=len(self.counts) - 1)
            ]
        outside = rank < offset if worst_first else rank >= self.reached
        return np.where(outside, 0.0 if worst_first else np.inf, found)

    def density(self, bins: int = 40) -> tuple[Array, Array]:
        """Edges (bins + 1,) and probability density (bins,) of the finite values at reached poses; integrates to their share.

        Source: Abdi et al. 2012, section IV: counts / (N width).
        """
        size = self._size(True)
        low, high = self.lowest, self.highest
        middle = low if np.isfinite(low) else 0.0
        if not high - low > 1e-12 * abs(middle):
            half = max(0.5, 0.5e-3 * abs(middle))
            low, high = middle - half, middle + half
        edges = np.linspace(low, high, bins + 1)
        if self.values is not None:
            counts = np.histogram(self.values[np.isfinite(self.values)], edges)[0].astype(np.float64)
        else:
            below = self._below(edges, True)
            below[-1] = size - self.infinite
            counts = np.diff(below)
        return edges, counts / (size * np.diff(edges))


class Collector:
    """Gathers values chunk by chunk; beyond ``most`` of them keeps fine bins instead, in constant memory."""

    def __init__(self, better: Literal["larger", "smaller"], bound: float | None, most: int = 4_000_000) -> None:
        self._better, self._bound, self._most = better, bound, most
        self._parts: list[Array] = []
        self._kept = 0
        self._edges: Array | None = None
        self._counts: NDArray[np.int64] | None = None
        self._unreached = self._singular = self._infinite = self._reached = 0
        self._total, self._low, self._high = 0.0, np.inf, -np.inf

    def add(self, values: Array, unreached: int, singular: int) -> None:
        """Values at reached poses, number of the others, and how many of the values are singular."""
        self._unreached += unreached
        self._singular += singular
        self._reached += len(values)
        finite = values[np.isfinite(values)]
        self._infinite += len(values) - len(finite)
        if finite.size:
            self._total += float(finite.sum())
            self._low, self._high = min(self._low, float(finite.min())), max(self._high, float(finite.max()))
        if self._edges is None:
            self._parts.append(values)
            self._kept += len(values)
            if self._kept > self._most:
                self._start_bins()
        else:
            self._count(values)

    def _start_bins(self) -> None:
        seen = np.concatenate(self._parts)
        finite = seen[np.isfinite(seen)]
        if self._bound is not None:
            edges = np.linspace(0.0, self._bound, BINS)
        else:
            # Half the edges evenly spaced, half at quantiles: a heavy tail must not blur the rest.
            low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
            top = high + max(abs(high), high - low, 1e-300)
            even = np.linspace(0.0 if low >= 0 else 2 * low, top, BINS // 2)
            dense = np.quantile(finite, np.linspace(0, 1, BINS // 2)) if finite.size else np.zeros(0)
            edges = np.unique(np.r_[even, dense, np.finfo(np.float64).max])
        self._edges = np.r_[edges, np.inf]
        self._counts = np.zeros(len(self._edges) - 1, dtype=np.int64)
        self._parts = []
        self._count(seen)

    def _count(self, values: Array) -> None:
        assert self._edges is not None
        assert self._counts is not None
        last = len(self._counts) - 1
        if self._bound is not None:  # even bins need no search
            place = np.minimum(values * ((BINS - 1) / self._bound), last).astype(np.int64)
        else:
            place = np.searchsorted(self._edges, values, side="right") - 1
        self._counts += np.bincount(place.clip(0, last), minlength=last + 1)

    def finish(self) -> Distribution:
        """The distribution of everything added."""
        if self._edges is None:
            values = np.concatenate(self._parts) if self._parts else np.zeros(0)
            return Distribution.of(values, self._better, self._unreached, self._singular)
        return Distribution(
            self._better,
            edges=self._edges,
            counts=self._counts,
            unreached=self._unreached,
            singular=self._singular,
            infinite=self._infinite,
            total=self._total,
            lowest=self._low,
            highest=self._high,
            _reached=self._reached,
        )


def _check_confidence(confidence: float) -> None:
    if not 0 < confidence < 1:
        raise InputError(f"confidence is {confidence:g}; it must be between 0 and 1, for example 0.95")
