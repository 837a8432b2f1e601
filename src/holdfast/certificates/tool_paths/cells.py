"""Slabs of lock instants, cells of the path that follows them, and the enclosures in these cells."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from holdfast.certificates.tree import RowBatch
from holdfast.core.typing import BoolArray, FloatArray, IndexArray

SEGMENT_INSTANTS = 1 << 20  # instants in a segment
PATH_CENTER_UNIT = 2.0**-28  # rad: unit of stored centres, fine enough that little is lost near singularities
_MIN_CELL_INSTANTS = SEGMENT_INSTANTS >> 7  # least length of a cell, or a quarter of its slab if that is shorter


@dataclass(frozen=True, eq=False)
class PathCellBatch:
    """Batch of N cells of slabs, with lock instants and path intervals in instants of a segment.

    Attributes:
        begin, stop: (N,) ends of the slab of lock instants, in one segment.
        start, end: (N,) ends of the cell of the path, in one segment; for a turned cell both are its middle.
        width: (N,) half widths of turned cells along the tangent of the motion, in units of the file; 0 for other cells.
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
class PathFormBatch(RowBatch):
    """Batch of enclosures in N cells, with columns for the coordinates lock, path, tube, and section.

    Attributes:
        q: (N, n) centers, rad.
        place: (N,) middles on the path, in segments.
        turned: (N,) True if the path coordinate follows the tangent of the motion.
        own: (N, m + 1, columns) derivatives of the free joints, then of the path position, by the coordinates.
        half: (N, columns) half widths of the coordinates, for the section as small as possible.
        only: (N, m) half widths of the section box that contains a single solution.
        good: (N,) True if this is proved, and the motion is within the limits.
    """

    q: FloatArray
    place: FloatArray
    turned: BoolArray
    own: FloatArray
    half: FloatArray
    only: FloatArray
    good: BoolArray

    @classmethod
    def make_zero_form(cls, n: int, m: int, coordinate_count: int) -> PathFormBatch:
        """Make the form of one cell, filled with zeros."""
        flags, response = np.zeros(1, dtype=bool), np.zeros((1, m + 1, coordinate_count))
        return cls(np.zeros((1, n)), np.zeros(1), flags, response, response[:, 0], np.zeros((1, m)), flags)

    def replace_rows(self, rows: IndexArray, others: PathFormBatch) -> PathFormBatch:
        """Return the forms with some rows replaced by other forms."""
        order = np.arange(len(self.q))
        order[rows] = len(self.q) + np.arange(len(rows))
        return PathFormBatch.concatenate([self, others]).select(order)


@dataclass
class LockSlab:
    """Slab of lock instants from ``begin`` to ``stop``, with the cells found for them.

    Attributes:
        begin, stop: Instants in one segment.
        halvings: Number of bisections that produced the slab.
        ends: Ends of its cells in order; minus the half width, in units of the file, for a turned cell.
        centers: (n,) center of each cell, in units of the file; 0 for joints that are not free. For a turned cell and the next
            one, the entry of the locked joint is the path position, in instants from the last knot.
        step: Step of the next cell.
        last_form: Form of its last cell, while the slab waits.
    """

    begin: int
    stop: int
    halvings: int = 0
    ends: list[int] = field(default_factory=list)
    centers: list[IndexArray] = field(default_factory=list)
    step: int = 0
    last_form: PathFormBatch | None = None

    @property
    def restarted_slab(self) -> LockSlab:
        """Slab without cells, whose first cell is as long as the slab."""
        return LockSlab(self.begin, self.stop, self.halvings, step=self.stop - self.begin)

    @property
    def halves(self) -> list[LockSlab]:
        """Two halves of the slab."""
        middle = (self.begin + self.stop) // 2
        return [
            LockSlab(begin, stop, self.halvings + 1).restarted_slab
            for begin, stop in ((self.begin, middle), (middle, self.stop))
        ]

    @property
    def at(self) -> int:
        """Instant up to which the path is proved."""
        return self.ends[-1] if self.ends else self.begin

    @property
    def next(self) -> int:
        """Instant at which the next cell ends."""
        return self.at + self.step

    @property
    def has_shortest_step(self) -> bool:
        """True if the next cell may not be shorter."""
        return not self.ends or self.step <= max(1, min(_MIN_CELL_INSTANTS, (self.stop - self.begin) // 4))

    def lengthen_step(self) -> None:
        """Lengthen the next step, at most to twice its length, such that cells are binary fractions of a segment."""
        self.step = min(2 * self.step, self.at & -self.at, SEGMENT_INSTANTS)
