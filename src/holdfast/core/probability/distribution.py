"""Distribution of an index over a region, with confidence intervals."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.probability.intervals import Interval, WeightSums, check_confidence
from holdfast.core.typing import FloatArray

__all__ = ["Distribution", "Interval"]


_SMALLEST_BIN_WIDTH = 1e-300  # a density over a narrower bin overflows


@dataclass(kw_only=True)
class Distribution:
    """Distribution of an index over the samples of a region, with exact values or, for very large runs, in fine bins.

    A pose without a configuration counts as the worst possible value (0 if larger is better, infinity otherwise), except with
    ``reachable_only=True``. Samples may have weights. Fractions, quantiles, mean and density are then weighted, and error bars
    are those of :meth:`effective` equally weighted samples.

    Attributes:
        better: ``"larger"`` or ``"smaller"``, the better direction of the index.
        values: (N,) sorted values at the poses with a configuration; None if only bins are kept.
        edges, counts: (B + 1,) edges and (B,) contents of the bins, if binned; a probability is then exact at the edges.
        unreached: Number of poses without a configuration.
        singular: Number of singular configurations (they count with the value of the convention).
        infinite: Number of infinite values.
        total: Sum of the finite values times their weights, in the unit of the index.
        lowest, highest: Smallest and largest finite value with a weight above 0.
        weights: (N,) weights of ``values``, or None for equal weights. In bins, ``counts`` are sums of weights.
    """

    better: Literal["larger", "smaller"]
    values: FloatArray | None = None
    edges: FloatArray | None = None
    counts: NDArray[Any] | None = None
    unreached: int = 0
    singular: int = 0
    infinite: int = 0
    total: float = 0.0
    lowest: float = np.inf
    highest: float = -np.inf
    weights: FloatArray | None = None
    _reached: int = field(default=0, repr=False)
    _finite: WeightSums | None = field(default=None, repr=False)
    _found: WeightSums | None = field(default=None, repr=False)
    _lost: WeightSums | None = field(default=None, repr=False)

    @classmethod
    def from_values(
        cls,
        values: ArrayLike,
        better: Literal["larger", "smaller"],
        unreached: int = 0,
        *,
        singular: int = 0,
        weights: ArrayLike | None = None,
        unreached_weights: ArrayLike = (),
        heaviest: float = 0.0,
    ) -> Distribution:
        """Return the distribution of given values.

        Args:
            values: (N,) index values at the poses with a configuration.
            better: ``"larger"`` or ``"smaller"``, the better direction of the index.
            unreached: Number of poses without a configuration.
            singular: Number of values at singular configurations.
            weights: (N,) weights of the values, 0 or more; default: equal weights.
            unreached_weights: (unreached,) weights of the poses without a configuration, if ``weights`` are given.
            heaviest: Largest possible weight of a sample, if known; see :meth:`effective`.
        """
        if weights is not None:
            lost = WeightSums(largest=heaviest)
            lost.add(np.asarray(unreached_weights, dtype=np.float64))
            v, w = np.asarray(values, dtype=np.float64), np.asarray(weights, dtype=np.float64)
            return cls._from_weighted(v, w, better, unreached, singular, lost)
        sorted_values = np.sort(np.asarray(values, dtype=np.float64))
        finite = sorted_values[np.isfinite(sorted_values)]
        return cls(
            better=better,
            values=sorted_values,
            unreached=unreached,
            singular=singular,
            infinite=len(sorted_values) - len(finite),
            total=float(finite.sum()),
            lowest=float(finite[0]) if finite.size else np.nan,
            highest=float(finite[-1]) if finite.size else np.nan,
            _reached=len(sorted_values),
        )

    @classmethod
    def _from_weighted(
        cls,
        values: FloatArray,
        weights: FloatArray,
        better: Literal["larger", "smaller"],
        unreached: int,
        singular: int,
        lost: WeightSums,
    ) -> Distribution:
        order = np.argsort(values, kind="stable")
        v, w = values[order], weights[order]
        finite, found = WeightSums(), WeightSums()
        some = np.isfinite(v)
        finite.add(w[some])
        found.add(w)
        counting = v[some & (w > 0)]
        return cls(
            better=better,
            values=v,
            unreached=unreached,
            singular=singular,
            infinite=int((~some).sum()),
            total=float(v[some] @ w[some]),
            lowest=float(counting[0]) if counting.size else np.nan,
            highest=float(counting[-1]) if counting.size else np.nan,
            weights=w,
            _reached=len(v),
            _finite=finite,
            _found=found,
            _lost=lost,
        )

    @property
    def has_weights(self) -> bool:
        """True if samples have weights."""
        return self._found is not None

    @property
    def reached(self) -> int:
        """Number of poses with a configuration."""
        return self._reached

    @property
    def samples(self) -> int:
        """Number of all sampled poses."""
        return self._reached + self.unreached

    @property
    def mean(self) -> float:
        """Mean of the finite values at the poses with a configuration."""
        finite = self._finite_weight
        return self.total / finite if finite else np.nan

    @property
    def unreached_share(self) -> float:
        """Fraction of the samples without a configuration, by weight."""
        return self._unreached_weight / self._total_size(False)

    def effective(self, reachable_only: bool = False) -> float:
        """Return the effective sample size ``sum w / max w``: the number of equally weighted samples with the same information.

        ``max w`` is the largest possible weight if it is known (densities of a region), else the largest sampled weight; error
        bars are then too narrow if rare samples are heavier. With ``reachable_only``, unreached poses do not count.

        Source: Martino, Elvira, Louzada 2017; ``(sum w)^2 / sum w^2`` of Kish is larger, and
        its intervals need not cover (:doc:`/evidence/intervals`).
        """
        size = self._total_size(reachable_only)
        if self._found is None or self._lost is None:
            return float(size)
        return WeightSums(size, max(self._found.largest, self._lost.largest)).effective_size

    def total_weight(self, reachable_only: bool = False) -> float:
        """Return the sum of the sample weights (their number if unweighted), without unreached poses if ``reachable_only``."""
        return self._total_size(reachable_only)

    @cached_property
    def _cumulative_weight(self) -> FloatArray:
        """Total weight of the first k values, or of the first k bins."""
        parts = self.counts if self.values is None else self.weights
        assert parts is not None
        return np.asarray(np.r_[0, np.cumsum(parts)])

    @property
    def _bin_ends(self) -> FloatArray:
        """Upper ends of the bins, none of them beyond the highest value, because the last bin has no upper end."""
        assert self.edges is not None
        return np.minimum(self.edges[1:], self.highest)

    @property
    def _finite_weight(self) -> float:
        return self._reached - self.infinite if self._finite is None else self._finite.weight

    @property
    def _unreached_weight(self) -> float:
        return self.unreached if self._lost is None else self._lost.weight

    def _total_size(self, reachable_only: bool) -> float:
        """Return the total weight; the number of samples if they have no weights."""
        size: float = self.reached if reachable_only else self.samples
        if not self.samples:
            raise InputError("this distribution has no samples: nothing is computed yet")
        if not size:
            raise InputError(
                "this distribution has no samples; no pose was reached: use reachable_only=False or another region"
            )
        if self.has_weights:
            size = float(self._cumulative_weight[-1])  # not the sum over chunks, because F must end at 1
            size = size if reachable_only else size + self._unreached_weight
            if not size > 0:
                raise InputError("the weights of these samples are all 0; give at least one a weight above 0")
        return size

    def _weight_below(self, h: FloatArray, reachable_only: bool) -> FloatArray:
        """Return the weight of the samples with a value below h; their number if they have no weights."""
        if self.values is not None:
            place = np.searchsorted(self.values, h, side="left")
            count = place.astype(np.float64) if self.weights is None else self._cumulative_weight[place]
        else:
            assert self.edges is not None
            count = np.interp(h, self.edges, self._cumulative_weight[: len(self.edges)])
            count = np.where(h > self.highest, min(self._finite_weight, self._cumulative_weight[-1]), count)
        if not reachable_only and self.better == "larger":
            count = count + np.where(h > 0, self._unreached_weight, 0)
        return np.asarray(count)

    def cdf(self, h: ArrayLike, reachable_only: bool = False) -> FloatArray:
        """Return ``F(h)``, the fraction of samples with a value below ``h``, an array of any shape; F(0) = 0.

        With ``reachable_only``, poses without a configuration do not count.

        Source: Abdi et al. 2012, section IV; strict ``<``, so that the probability of at least 0 is 1.
        """
        h_ = np.asarray(h, dtype=np.float64)
        return np.asarray(self._weight_below(h_, reachable_only) / self._total_size(reachable_only))

    def probability(self, at_least: float | None = None, at_most: float | None = None, reachable_only: bool = False) -> float:
        """Return the fraction of values ``at_least`` or ``at_most`` a threshold, the paper's global index ``1 - F(h)``.

        Thresholds have the unit of the index. With ``reachable_only``, poses without a configuration do not count.

        Raises:
            InputError: Not exactly one threshold is given.
        """
        return self.interval(at_least, at_most, reachable_only).value

    def interval(
        self,
        at_least: float | None = None,
        at_most: float | None = None,
        reachable_only: bool = False,
        *,
        confidence: float = 0.95,
    ) -> Interval:
        """Return :meth:`probability` of ``at_least``, ``at_most`` and ``reachable_only`` with its interval at ``confidence``.

        The interval is Clopper and Pearson's; for weighted samples, that of :meth:`effective` equally weighted ones.

        Raises:
            InputError: Not exactly one threshold is given, or the confidence is outside (0, 1).
        """
        if (at_least is None) == (at_most is None):
            raise InputError("give exactly one of at_least and at_most")
        check_confidence(confidence)
        if any(h is not None and np.isnan(h) for h in (at_least, at_most)):
            raise InputError("a threshold is NaN; give a number")
        size = self._total_size(reachable_only)
        if at_least is not None:
            hits = size - float(self._weight_below(np.asarray(at_least), reachable_only))
        else:
            assert at_most is not None
            up = np.nextafter(float(at_most), np.inf)
            hits = size if np.isposinf(at_most) else float(self._weight_below(np.asarray(up), reachable_only))
        if self.has_weights:
            return Interval.of_share(float(np.clip(hits / size, 0, 1)), self.effective(reachable_only), confidence)
        return Interval.from_counts(hits, int(size), confidence)

    def band(self, confidence: float = 0.95, reachable_only: bool = False) -> float:
        """Return the half width of the band that contains the whole true CDF with probability ``confidence`` (0 to 1).

        Source: Dvoretzky, Kiefer, Wolfowitz 1956 with the constant of Massart 1990: ``sqrt(ln(2/delta)/(2N))``.
        It assumes independent samples. For scrambled Sobol points it is conservative in practice, but not by theorem. With
        weights, N is the :meth:`effective` sample size: a fair thinning to equal weights keeps about N samples, for which the
        theorem holds and whose mean CDF is the weighted CDF. That the band covers is therefore measured, not proved. With
        ``reachable_only``, poses without a configuration do not count.
        """
        check_confidence(confidence)
        return float(min(np.sqrt(np.log(2 / (1 - confidence)) / (2 * self.effective(reachable_only))), 1.0))

    def quantile(self, p: ArrayLike, reachable_only: bool = True) -> FloatArray:
        """Return the least v with ``fraction(value <= v) >= p``, ``p`` of any shape; ``reachable_only`` as in :meth:`cdf`."""
        p_ = np.asarray(p, dtype=np.float64)
        if not ((p_ >= 0) & (p_ <= 1)).all():
            raise InputError("a quantile is asked for a share outside 0 to 1")
        size = self._total_size(reachable_only)
        if self.has_weights:
            return self._weighted_quantile(p_, size, 0.0 if reachable_only else self._unreached_weight)
        lost = 0 if reachable_only else self.unreached
        rank = np.maximum(np.ceil(p_ * size) - 1, 0)  # counted from 0
        rank -= (rank >= 1) & (rank / size >= p_)  # p * size may round up past a whole number
        worst_first = self.better == "larger"
        offset = lost if worst_first else 0
        if self.values is not None:
            inner = np.clip(rank - offset, 0, max(self.reached - 1, 0)).astype(np.int64)
            found = self.values[inner] if self.reached else np.full(p_.shape, np.nan)
        else:
            place = np.searchsorted(self._cumulative_weight[1:], np.maximum(rank - offset, 0), side="right")
            found = self._bin_ends[place.clip(max=len(self._bin_ends) - 1)]
            found = np.where(rank - offset < self.reached - self.infinite, found, np.inf)
        outside = rank < offset if worst_first else rank >= self.reached
        return np.where(outside, 0.0 if worst_first else np.inf, found)

    def _weighted_quantile(self, p: FloatArray, size: float, lost: float) -> FloatArray:
        # Sums of weights have rounding errors, and a fraction of 0 still needs a weight above 0.
        least = np.maximum(p * (1 - 1e-12), np.finfo(np.float64).tiny)
        offset = lost if self.better == "larger" else 0.0
        place = np.searchsorted((offset + self._cumulative_weight[1:]) / size, least, side="left")
        beyond = place == len(self._cumulative_weight) - 1
        held = self._bin_ends if self.values is None else self.values
        found = held[np.minimum(place, len(held) - 1)] if held.size else np.full(p.shape, np.nan)
        if self.values is None:
            found = np.where(least * size - offset <= self._finite_weight * (1 + 1e-12), found, np.inf)
        if self.better == "larger":
            return np.where((lost > 0) & (least <= offset / size), 0.0, found)
        return np.where(beyond, np.inf, found)

    def density(self, bins: int = 40) -> tuple[FloatArray, FloatArray]:
        """Return edges (bins + 1,) and density (bins,) of the finite values at reached poses, in ``bins`` equal bins.

        The density integrates to the fraction of these values.

        Source: Abdi et al. 2012, section IV: counts / (N width).
        """
        size = self._total_size(True)
        low, high = self.lowest, self.highest
        middle = low if np.isfinite(low) else 0.0
        if not high - low > max(1e-12 * abs(middle), _SMALLEST_BIN_WIDTH):
            half = max(0.5, 0.5e-3 * abs(middle))
            low, high = middle - half, middle + half
        edges = np.linspace(low, high, bins + 1)
        if self.values is not None:
            some = np.isfinite(self.values)
            weights = None if self.weights is None else self.weights[some]
            counts = np.histogram(self.values[some], edges, weights=weights)[0].astype(np.float64)
        else:
            below = self._weight_below(edges, True)
            below[-1] = self._finite_weight
            counts = np.maximum(np.diff(below), 0.0)
        return edges, counts / (size * np.diff(edges))
