"""A slab of lock instants with the cells of the path behind it."""

from __future__ import annotations

from dataclasses import dataclass, field

from holdfast.certificates.tool_paths.cells import SEGMENT_INSTANTS, PathFormBatch
from holdfast.core.typing import IndexArray

_MIN_CELL_INSTANTS = SEGMENT_INSTANTS >> 7  # of cells, or a quarter of their slab


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
