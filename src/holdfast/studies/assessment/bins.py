"""Distribution of an index as counts in bins that depend only on the index, so that partial counts can be added."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.probability.distribution import Distribution
from holdfast.core.typing import FloatArray
from holdfast.kinematics.indices.index import Index

BOUNDED_BINS = 4096  # bins of equal width up to the bound of the index
# Without a bound, the bins are 1.1 % wide, from 2^-40 to 2^40.
_BINS_PER_OCTAVE = 64
_OCTAVE_COUNT = 40
FACT_NAMES = ("unreached", "reached", "singular", "infinite", "total", "lowest", "highest")


def compute_bin_edges(index: Index) -> FloatArray:
    """Return the edges (B + 1,) of the bins of an index; the last is infinity, and the one before is beyond its bound."""
    if index.bound is not None:
        return np.concatenate([np.arange(BOUNDED_BINS + 2) * (index.bound / BOUNDED_BINS), [np.inf]])
    octave_edges: FloatArray = np.r_[
        0.0,
        2.0 ** (np.arange(-_BINS_PER_OCTAVE * _OCTAVE_COUNT, _BINS_PER_OCTAVE * _OCTAVE_COUNT + 1) / _BINS_PER_OCTAVE),
        np.inf,
    ]
    return octave_edges


class IndexCounts:
    """Counted values of an index.

    Attributes:
        bins: (B,) number of values in each bin.
        facts: (7,) further numbers, with the names :data:`FACT_NAMES`.
    """

    def __init__(self, index: Index) -> None:
        self._index, self._edges = index, compute_bin_edges(index)
        self.bins = np.zeros(len(self._edges) - 1, dtype=np.int64)
        self.facts = np.array([0, 0, 0, 0, 0.0, np.inf, -np.inf])

    def add(self, values: FloatArray, unreached: int, singular: int) -> None:
        """Add values at reached poses, the number of unreached poses, and the number of singular values."""
        last = len(self.bins) - 1
        if self._index.bound is not None:
            bin_numbers = np.minimum(values / (self._index.bound / BOUNDED_BINS), last).astype(np.int64)
        else:
            bin_numbers = np.searchsorted(self._edges, values, side="right") - 1
        is_finite = np.isfinite(values)
        finite = values if is_finite.all() else values[is_finite]  # numpy would hold Python's lock to select rows
        lowest, highest = (float(finite.min()), float(finite.max())) if finite.size else (np.inf, -np.inf)
        facts = np.array([unreached, len(values), singular, len(values) - len(finite), finite.sum(), lowest, highest])
        self.merge_counts(np.bincount(bin_numbers.clip(0, last), minlength=last + 1), facts)

    def merge_counts(self, bins: NDArray[Any], facts: FloatArray) -> None:
        """Add the counts of another part."""
        self.bins += bins
        self.facts[:5] += facts[:5]
        self.facts[5:] = min(self.facts[5], facts[5]), max(self.facts[6], facts[6])

    def finish(self) -> Distribution:
        """Return the distribution of everything added."""
        unreached, reached, singular, infinite = (int(x) for x in self.facts[:4])
        total, lowest, highest = self.facts[4:].tolist()
        return Distribution(
            better=self._index.better,
            edges=self._edges,
            counts=self.bins,
            unreached=unreached,
            singular=singular,
            infinite=infinite,
            total=total,
            lowest=lowest,
            highest=highest,
            _reached=reached,
        )


def merge_chunk_counts(
    index: Index, optimised: bool, chunks: Iterable[Mapping[str, NDArray[Any]]]
) -> list[tuple[IndexCounts, NDArray[np.int64]]]:
    """Sum chunks of counts of values and worst failures, as found and, if ``optimised``, at the best configurations."""
    prefixes = ["", *["optimised_"] * optimised]
    parts = [(IndexCounts(index), np.zeros(len(index.failures), dtype=np.int64)) for _ in prefixes]
    for rows in chunks:
        for prefix, (counts, worst_counts) in zip(prefixes, parts, strict=True):
            counts.merge_counts(rows[f"{prefix}bins"][0], rows[f"{prefix}facts"][0])
            worst_counts += rows[f"{prefix}worst_counts"][0]
    return parts
