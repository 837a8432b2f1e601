"""How long a study would take and how large it would be, from trying a little of each cell."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from holdfast.study import Cell

ROWS = 64  # tried of a cell, at most


@dataclass(frozen=True)
class Estimate:
    """Of one cell.

    Attributes:
        cell: The cell.
        seconds: Of one thread, for all of it.
        size: Bytes, before compression.
        tried: Rows that were computed to know.
    """

    cell: Cell
    seconds: float
    size: int
    tried: int


def estimates(cells: Sequence[Cell], seed: int, most: float = 3.0) -> Iterator[Estimate]:
    """Try each cell: few rows, and more of them while that takes less than ``most`` seconds.

    Raises:
        HoldfastError: A cell cannot be computed; the message says why.
    """
    for cell in cells:
        cell.job.prepare(alone=False)
        rows = min(8, cell.chunk, cell.rows)
        while True:
            begin = time.perf_counter()
            cell.job.run(cell.smaller(rows).part(0, seed))
            seconds = time.perf_counter() - begin
            if rows >= min(ROWS, cell.chunk, cell.rows) or seconds * 4 > most:
                break
            rows = min(4 * rows, ROWS, cell.chunk, cell.rows)
        each = sum(np.dtype(c.dtype).itemsize * math.prod(n for _, n in c.dims) for c in cell.job.columns())
        yield Estimate(cell, seconds * cell.rows / rows, each * cell.stored[0], rows)
