"""Cells of lock instants and path, and the enclosures in them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray

SEGMENT_INSTANTS = 1 << 20  # instants to a segment
PATH_CENTER_UNIT = 2.0**-28  # rad: centres are written in multiples of it, so that near singularities little is lost


@dataclass(frozen=True, eq=False)
class PathCellBatch:
    """N cells of slabs: lock instants and path intervals, in instants of a segment.

    Attributes:
        begin, stop: (N,) the slab of lock instants, in one segment.
        start, end: (N,) the cell of the path, in one segment; of one that is turned its middle, twice.
        width: (N,) half widths of those along the tangent of the motion, in units of the file; 0: not turned.
    """

    begin: IndexArray
    stop: IndexArray
    start: IndexArray
    end: IndexArray
    width: IndexArray

    @property
    def half_widths(self) -> FloatArray:
        """(N, 2) half widths of both intervals, in segments."""
        half = np.stack([self.stop - self.begin, self.end - self.start], axis=1) / (2 * SEGMENT_INSTANTS)
        half[:, 1] += self.width * PATH_CENTER_UNIT
        return half


@dataclass(frozen=True, eq=False)
class PathFormBatch:
    """Enclosures in N cells, each with one column for each coordinate: lock, path, tube, section.

    Attributes:
        q: (N, n) centres, rad.
        place: (N,) middles on the path, in segments.
        turned: (N,) whether the path is that along the tangent of the motion.
        own: (N, m + 1, columns) how free joints, then the place on the path, follow the coordinates.
        half: (N, columns) half widths of these, the section's as small as it may be.
        only: (N, m) of the section box in which there is one solution.
        good: (N,) whether that is shown, and within the limits.
    """

    q: FloatArray
    place: FloatArray
    turned: BoolArray
    own: FloatArray
    half: FloatArray
    only: FloatArray
    good: BoolArray

    def select(self, rows: IndexArray) -> PathFormBatch:
        """Return the forms of some rows."""
        return PathFormBatch(*(getattr(self, field.name)[rows] for field in fields(self)))

    @classmethod
    def make_zero_form(cls, n: int, m: int, coordinate_count: int) -> PathFormBatch:
        """Make the empty form of one cell."""
        response, half = np.zeros((1, m + 1, coordinate_count)), np.zeros((1, coordinate_count))
        flags = np.zeros(1, dtype=bool)
        return cls(np.zeros((1, n)), np.zeros(1), flags, response, half, np.zeros((1, m)), flags)

    @classmethod
    def concatenate(cls, parts: Sequence[PathFormBatch]) -> PathFormBatch:
        """Concatenate batches of forms."""
        return cls(*(np.concatenate([getattr(part, field.name) for part in parts]) for field in fields(cls)))

    def append(self, others: PathFormBatch) -> PathFormBatch:
        """Return these forms followed by others."""
        return PathFormBatch.concatenate([self, others])

    def replace_rows(self, rows: IndexArray, others: PathFormBatch) -> PathFormBatch:
        """Return the forms with other forms in place of some rows."""
        order = np.arange(len(self.q))
        order[rows] = len(self.q) + np.arange(len(rows))
        return self.append(others).select(order)
