"""A distribution as counts, in bins that depend on the index alone, so that parts of it can be added."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.indices.index import Index
from holdfast.probability.distribution import Distribution

Array = NDArray[np.float64]

BOUNDED = 4096  # bins of equal width up to the bound of the index
_PER_OCTAVE, _OCTAVES = 64, 40  # without a bound: 1.1 % wide, from 2^-40 to 2^40
FACTS = ("unreached", "reached", "singular", "infinite", "total", "lowest", "highest")


def edges(index: Index) -> Array:
    """(B + 1,) edges of the bins of an index; the last is infinity, and the one before beyond its bound."""
    if index.bound is not None:
        return np.concatenate([np.arange(BOUNDED + 2) * (index.bound / BOUNDED), [np.inf]])
    found: Array = np.r_[0.0, 2.0 ** (np.arange(-_PER_OCTAVE * _OCTAVES, _PER_OCTAVE * _OCTAVES + 1) / _PER_OCTAVE), np.inf]
    return found


class Counts:
    """Values of an index, counted.

    Attributes:
        bins: (B,) values in each bin.
        facts: (7,) as :data:`FACTS` names them.
    """

    def __init__(self, index: Index) -> None:
        self._index, self._edges = index, edges(index)
        self.bins = np.zeros(len(self._edges) - 1, dtype=np.int64)
        self.facts = np.array([0, 0, 0, 0, 0.0, np.inf, -np.inf])

    def add(self, values: Array, unreached: int, singular: int) -> None:
        """Values at reached poses, number of the others, and how many of the values are singular."""
        last = len(self.bins) - 1
        if self._index.bound is not None:
            place = np.minimum(values / (self._index.bound / BOUNDED), last).astype(np.int64)
        else:
            place = np.searchsorted(self._edges, values, side="right") - 1
        known = np.isfinite(values)
        finite = values if known.all() else values[known]  # numpy picks rows, and counts them, with Python held
        low, high = (float(finite.min()), float(finite.max())) if finite.size else (np.inf, -np.inf)
        facts = np.array([unreached, len(values), singular, len(values) - len(finite), finite.sum(), low, high])
        self.join(np.bincount(place.clip(0, last), minlength=last + 1), facts)

    def join(self, bins: NDArray[Any], facts: Array) -> None:
        """Another part, as counted elsewhere."""
        self.bins += bins
        self.facts[:5] += facts[:5]
        self.facts[5:] = min(self.facts[5], facts[5]), max(self.facts[6], facts[6])

    def finish(self) -> Distribution:
        """The distribution of everything added."""
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


def add_chunks(
    index: Index, optimised: bool, chunks: Iterable[Mapping[str, NDArray[Any]]]
) -> list[tuple[Counts, NDArray[np.int64]]]:
    """Add up chunks that hold counts: values and worst failures as found and, if ``optimised``, at the best configurations."""
    befores = ["", *["optimised_"] * optimised]
    parts = [(Counts(index), np.zeros(len(index.failures), dtype=np.int64)) for _ in befores]
    for rows in chunks:
        for before, (counts, worst) in zip(befores, parts, strict=True):
            counts.join(rows[f"{before}bins"][0], rows[f"{before}facts"][0])
            worst += rows[f"{before}worst_counts"][0]
    return parts
