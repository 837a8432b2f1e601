"""How long a study would take and how large it would be, from trying a little of each cell."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from holdfast.engine.job import Cell

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

    What the first rows cost once, as what is compiled with them, does not count; what each chunk costs besides its rows does.

    Raises:
        HoldfastError: A cell cannot be computed; the message says why.
    """
    for cell in cells:
        cell.job.prepare(alone=False)
        rows, last = min(8, cell.chunk, cell.rows), min(ROWS, cell.chunk, cell.rows)
        _tried(cell, min(1, rows), seed)
        tried = [(rows, _tried(cell, rows, seed))]
        while rows < last and 4 * tried[-1][1] <= most:
            rows = min(4 * rows, last)
            tried.append((rows, _tried(cell, rows, seed)))
        each = sum(np.dtype(c.dtype).itemsize * math.prod(n for _, n in c.dims) for c in cell.job.columns())
        yield Estimate(cell, _extended(tried, cell), each * cell.stored[0], rows)


def _tried(cell: Cell, rows: int, seed: int) -> float:
    """Seconds of so many rows."""
    begin = time.perf_counter()
    cell.job.run(cell.smaller(rows).part(0, seed))
    return time.perf_counter() - begin


def _extended(tried: Sequence[tuple[int, float]], cell: Cell) -> float:
    """Seconds of all chunks of a cell, from rows and seconds of the tries: so much for a chunk, and so much for each row."""
    (first, least), (rows, seconds) = tried[0], tried[-1]
    if rows == first:
        return seconds * cell.rows / rows
    a_row = max(seconds - least, 0.0) / (rows - first)
    a_chunk = max(seconds - a_row * rows, 0.0)
    return a_chunk * cell.count + a_row * cell.rows
