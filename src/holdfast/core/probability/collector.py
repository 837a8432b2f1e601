"""Collect the distribution of values chunk by chunk in constant memory."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from holdfast.core.probability.distribution import Distribution
from holdfast.core.probability.intervals import WeightSums
from holdfast.core.typing import FloatArray

BIN_COUNT = 1 << 16


class DistributionCollector:
    """Collect values chunk by chunk; beyond ``most`` values, keep fine bins instead of the values, in constant memory."""

    def __init__(
        self, better: Literal["larger", "smaller"], bound: float | None, most: int = 4_000_000, heaviest: float = 0.0
    ) -> None:
        self._better, self._bound, self._most, self._heaviest = better, bound, most, heaviest
        self._parts: list[FloatArray] = []
        self._kept = 0
        self._edges: FloatArray | None = None
        self._counts: NDArray[Any] | None = None
        self._weights: list[FloatArray] = []
        self._sums: tuple[WeightSums, WeightSums, WeightSums] | None = None  # finite values, reached and unreached poses
        self._unreached = self._singular = self._infinite = self._reached = 0
        self._total, self._low, self._high = 0.0, np.inf, -np.inf

    def add(
        self,
        values: FloatArray,
        unreached: int,
        singular: int,
        weights: FloatArray | None = None,
        unreached_weights: FloatArray | None = None,
    ) -> None:
        """Add the values at reached poses, the number of unreached poses, and the number of singular configurations.

        Every chunk has weights, of the values and of the unreached poses, or none has.
        """
        self._unreached += unreached
        self._singular += singular
        self._reached += len(values)
        is_finite = np.isfinite(values)
        finite = values[is_finite]
        self._infinite += len(values) - len(finite)
        if weights is not None and unreached_weights is not None:
            if self._sums is None:
                self._sums = WeightSums(), WeightSums(), WeightSums(largest=self._heaviest)
            for sums, w in zip(self._sums, (weights[is_finite], weights, unreached_weights), strict=True):
                sums.add(w)
            self._total += float(finite @ weights[is_finite])
            finite = values[is_finite & (weights > 0)]
        elif finite.size:
            self._total += float(finite.sum())
        if finite.size:
            self._low, self._high = min(self._low, float(finite.min())), max(self._high, float(finite.max()))
        if self._edges is None:
            self._parts.append(values)
            if weights is not None:
                self._weights.append(weights)
            self._kept += len(values)
            if self._kept > self._most:
                self._switch_to_bins()
        else:
            self._count_in_bins(values, weights)

    def _switch_to_bins(self) -> None:
        collected = np.concatenate(self._parts)
        finite = collected[np.isfinite(collected)]
        if self._bound is not None:
            edges = np.linspace(0.0, self._bound, BIN_COUNT)
        else:
            # Half the edges are evenly spaced and half are quantiles, so that a heavy tail does not blur the rest.
            low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
            top = high + max(abs(high), high - low, 1e-300)
            even_edges = np.linspace(0.0 if low >= 0 else 2 * low, top, BIN_COUNT // 2)
            dense_edges = np.quantile(finite, np.linspace(0, 1, BIN_COUNT // 2)) if finite.size else np.zeros(0)
            edges = np.unique(np.r_[even_edges, dense_edges, np.finfo(np.float64).max])
        self._edges = np.r_[edges, np.inf]
        weights = np.concatenate(self._weights) if self._weights else None
        bins = len(self._edges) - 1
        self._counts = np.zeros(bins, dtype=np.int64) if weights is None else np.zeros(bins)
        self._parts, self._weights = [], []
        self._count_in_bins(collected, weights)

    def _count_in_bins(self, values: FloatArray, weights: FloatArray | None) -> None:
        assert self._edges is not None
        assert self._counts is not None
        last = len(self._counts) - 1
        if self._bound is not None:  # even bins need no search
            bin_index = np.minimum(values * ((BIN_COUNT - 1) / self._bound), last).astype(np.int64)
            bin_index[values >= self._bound] = last  # many values may equal the bound; the product may round below it
        else:
            bin_index = np.searchsorted(self._edges, values, side="right") - 1
        self._counts += np.bincount(bin_index.clip(0, last), weights, minlength=last + 1)

    def make_distribution(self) -> Distribution:
        """Return the distribution of all added values."""
        if self._edges is None:
            values = np.concatenate(self._parts) if self._parts else np.zeros(0)
            if self._sums is not None:
                weights = np.concatenate(self._weights)
                return Distribution._from_weighted(
                    values, weights, self._better, self._unreached, self._singular, self._sums[2]
                )
            return Distribution.from_values(values, self._better, self._unreached, singular=self._singular)
        finite, finite_sums, lost_sums = self._sums or (None, None, None)
        return Distribution(
            better=self._better,
            edges=self._edges,
            counts=self._counts,
            unreached=self._unreached,
            singular=self._singular,
            infinite=self._infinite,
            total=self._total,
            lowest=self._low,
            highest=self._high,
            _reached=self._reached,
            _finite=finite,
            _found=finite_sums,
            _lost=lost_sums,
        )
