"""A slab of lock instants, and the cells of the path that are found behind it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.tool_paths.cells import SEGMENT, Forms

Ints = NDArray[np.int64]

_SHORTEST = SEGMENT >> 7  # of cells, or a quarter of their slab


@dataclass
class Slab:
    """Lock instants from ``begin`` to ``stop``, and what is found behind them.

    Attributes:
        begin, stop: Instants in one segment.
        halvings: That made it.
        ends: Of its cells, in order; of one that is turned less its half width, in units of the file.
        centres: (n,) of each, in units of the file; 0 of joints that are not free. Of a cell that is turned, or the next
            one, that of the locked joint is the place on the path, in instants from the last knot.
        step: Of the next cell.
        found: In the last of its cells, while it waits.
    """

    begin: int
    stop: int
    halvings: int = 0
    ends: list[int] = field(default_factory=list)
    centres: list[Ints] = field(default_factory=list)
    step: int = 0
    found: Forms | None = None

    @property
    def anew(self) -> Slab:
        """Without what is found, the first cell as long as it."""
        return Slab(self.begin, self.stop, self.halvings, step=self.stop - self.begin)

    @property
    def halves(self) -> list[Slab]:
        """Two."""
        middle = (self.begin + self.stop) // 2
        return [Slab(a, b, self.halvings + 1).anew for a, b in ((self.begin, middle), (middle, self.stop))]

    @property
    def at(self) -> int:
        """How far it is proved."""
        return self.ends[-1] if self.ends else self.begin

    @property
    def next(self) -> int:
        """Where the next cell ends."""
        return self.at + self.step

    @property
    def shortest(self) -> bool:
        """Whether the next cell may not be shorter."""
        return not self.ends or self.step <= max(1, min(_SHORTEST, (self.stop - self.begin) // 4))

    def lengthened(self) -> None:
        """The next step: up to twice as long, but such that cells are halves of halves of a segment."""
        self.step = min(2 * self.step, self.at & -self.at, SEGMENT)
