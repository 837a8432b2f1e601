"""Slabs of lock instants, cells of the path behind them, and the enclosures in these cells."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from holdfast.certificates.tree import RowBatch
from holdfast.core.typing import BoolArray, FloatArray, IndexArray

SEGMENT_INSTANTS = 1 << 20  # instants to a segment
PATH_CENTER_UNIT = 2.0**-28  # rad: centres are written in multiples of it, so that near singularities little is lost
_MIN_CELL_INSTANTS = SEGMENT_INSTANTS >> 7  # of cells, or a quarter of their slab


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
class PathFormBatch(RowBatch):
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

    @classmethod
    def make_zero_form(cls, n: int, m: int, coordinate_count: int) -> PathFormBatch:
        """Make the empty form of one cell."""
        flags, response = np.zeros(1, dtype=bool), np.zeros((1, m + 1, coordinate_count))
        return cls(np.zeros((1, n)), np.zeros(1), flags, response, response[:, 0], np.zeros((1, m)), flags)

    def replace_rows(self, rows: IndexArray, others: PathFormBatch) -> PathFormBatch:
        """Return the forms with other forms in place of some rows."""
        order = np.arange(len(self.q))
        order[rows] = len(self.q) + np.arange(len(rows))
        return PathFormBatch.concatenate([self, others]).select(order)


@dataclass
class LockSlab:
    """Lock instants from ``begin`` to ``stop``, with the cells found for them.

    Attributes:
        begin, stop: Instants in one segment.
        halvings: That made it.
        ends: Of its cells, in order; of one that is turned less its half width, in units of the file.
        centers: (n,) of each, in units of the file; 0 of joints that are not free. Of a cell that is turned, or the next
            one, that of the locked joint is the place on the path, in instants from the last knot.
        step: Of the next cell.
        last_form: In the last of its cells, while it waits.
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
        """The slab without cells, whose first cell is as long as the slab."""
        return LockSlab(self.begin, self.stop, self.halvings, step=self.stop - self.begin)

    @property
    def halves(self) -> list[LockSlab]:
        """The two halves of the slab."""
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
        """Lengthen the next step, at most to twice its length, so that cells are binary fractions of a segment."""
        self.step = min(2 * self.step, self.at & -self.at, SEGMENT_INSTANTS)
