"""Cells of lock instants and path, and what is found in them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]

SEGMENT = 1 << 20  # instants to a segment
UNIT = 2.0**-28  # rad: centres are written in multiples of it, so that near singularities little is lost


@dataclass(frozen=True, eq=False)
class Cells:
    """Cells of slabs, N of them: instants, in parts of a segment.

    Attributes:
        begin, stop: (N,) the slab of lock instants, in one segment.
        start, end: (N,) the cell of the path, in one segment; of one that is turned its middle, twice.
        width: (N,) half widths of those along the tangent of the motion, in units of the file; 0: not turned.
    """

    begin: Ints
    stop: Ints
    start: Ints
    end: Ints
    width: Ints

    @property
    def half(self) -> Array:
        """(N, 2) half widths of both, in segments."""
        half = np.stack([self.stop - self.begin, self.end - self.start], axis=1) / (2 * SEGMENT)
        half[:, 1] += self.width * UNIT
        return half


@dataclass(frozen=True, eq=False)
class Forms:
    """What is found in cells, N of them, each with as many columns as coordinates: lock, path, tube, section.

    Attributes:
        q: (N, n) centres, rad.
        place: (N,) middles on the path, in segments.
        turned: (N,) whether the path is that along the tangent of the motion.
        own: (N, m + 1, columns) how free joints, then the place on the path, follow the coordinates.
        half: (N, columns) half widths of these, the section's as small as it may be.
        only: (N, m) of the section box in which there is one solution.
        good: (N,) whether that is shown, and within the limits.
    """

    q: Array
    place: Array
    turned: Flags
    own: Array
    half: Array
    only: Array
    good: Flags

    def take(self, which: Ints) -> Forms:
        """Of some of them."""
        return Forms(*(getattr(self, field.name)[which] for field in fields(self)))

    @classmethod
    def none(cls, n: int, m: int, columns: int) -> Forms:
        """In one cell, nothing."""
        own, half = np.zeros((1, m + 1, columns)), np.zeros((1, columns))
        flags = np.zeros(1, dtype=bool)
        return cls(np.zeros((1, n)), np.zeros(1), flags, own, half, np.zeros((1, m)), flags)

    @classmethod
    def stacked(cls, parts: Sequence[Forms]) -> Forms:
        """One behind the other."""
        return cls(*(np.concatenate([getattr(one, field.name) for one in parts]) for field in fields(cls)))

    def joined(self, others: Forms) -> Forms:
        """With others behind them."""
        return Forms.stacked([self, others])

    def put(self, which: Ints, others: Forms) -> Forms:
        """With others in place of some."""
        order = np.arange(len(self.q))
        order[which] = len(self.q) + np.arange(len(which))
        return self.joined(others).take(order)
