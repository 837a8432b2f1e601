"""How long a study would take and how large it would be, from trying a little of each cell."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.engine.job import Cell
from holdfast.engine.store import Store
from holdfast.kernels.threads import pool

_ENOUGH_S = 0.2  # of processor time: what whole chunks are tried for, so that one slow chunk does not decide
_CHUNKS_WRITTEN = 8  # chunks written to a folder for a while, to know what that takes


@dataclass(frozen=True)
class Estimate:
    """Of one cell.

    Attributes:
        cell: The cell.
        seconds: Processor time of all of it.
        size: Bytes, before compression.
        tried: Rows that were computed to know.
    """

    cell: Cell
    seconds: float
    size: int
    tried: int


def estimates(cells: Sequence[Cell], seed: int, most: float = 3.0) -> Iterator[Estimate]:
    """Try each cell: few rows, more of them while that takes less than ``most`` seconds, and whole chunks if it does.

    The first rows pay once for compilation, which does not count; writing a chunk counts. Times are processor time, which
    other programs do not lengthen.

    Raises:
        HoldfastError: A cell cannot be computed; the message says why.
    """
    for cell in cells:
        cell.job.prepare(alone=False)
        rows, last = min(8, cell.chunk, cell.rows), min(cell.chunk, cell.rows)
        _try(cell, min(1, rows), seed)
        _try(cell, rows, seed)
        tried = [(rows, _try(cell, rows, seed)[0])]
        columns: Mapping[str, NDArray[Any]] = {}
        while rows < last and 4 * tried[-1][1] <= most:
            rows = min(4 * rows, last)
            seconds, columns = _try(cell, rows, seed)
            tried.append((rows, seconds))
        if rows == last:
            tried[-1] = rows, _seconds_of_a_chunk(cell, seed, tried[-1][1])
        compute = _extended(tried, cell)
        each = sum(np.dtype(c.dtype).itemsize * math.prod(n for _, n in c.dims) for c in cell.job.columns())
        yield Estimate(cell, compute + cell.count * _seconds_of_a_write(cell, columns), each * cell.stored[0], rows)


def _try(cell: Cell, rows: int, seed: int, number: int = 0) -> tuple[float, Mapping[str, NDArray[Any]]]:
    """Compute a number of rows and return the processor time in seconds, and the columns."""
    chunk = cell.smaller(rows).part(0, seed) if number == 0 else cell.part(number, seed)

    def run_timed() -> tuple[float, Mapping[str, NDArray[Any]]]:
        begin = time.thread_time()
        columns = cell.job.run(chunk)
        return time.thread_time() - begin, columns

    # In one thread of the pool, as when the study runs: what is compiled in the background meanwhile does not count.
    return pool().submit(run_timed).result()


def _seconds_of_a_chunk(cell: Cell, seed: int, first: float) -> float:
    """Compute whole chunks until the median of their processor times can be trusted."""
    times, full = [first], cell.rows // cell.chunk
    while len(times) < full and (len(times) < 3 or sum(times) < _ENOUGH_S):
        times.append(_try(cell, cell.chunk, seed, len(times))[0])
    return float(np.median(times))  # the first one may have waited for what is compiled


def _seconds_of_a_write(cell: Cell, columns: Mapping[str, NDArray[Any]]) -> float:
    """Write a chunk several times into a folder that is removed, and return the processor time of one."""
    if not columns:
        return 0.0
    size = len(next(iter(columns.values())))
    with TemporaryDirectory() as folder:
        store = Store.create(Path(folder) / "tried", {}, cell.job.columns(), rows=_CHUNKS_WRITTEN * size, chunk=size)
        with store.writing():
            clock = [time.process_time()]
            for k in range(_CHUNKS_WRITTEN):
                store.write(k, columns)
                clock.append(time.process_time())
            return float(np.median(np.diff(clock)))


def _extended(tried: Sequence[tuple[int, float]], cell: Cell) -> float:
    """Seconds of all chunks of a cell, from rows and seconds of the tries: so much for a chunk, and so much for each row."""
    (first, least), (rows, seconds) = tried[0], tried[-1]
    if rows == first:
        return seconds * cell.rows / rows
    a_row = max(seconds - least, 0.0) / (rows - first)
    a_chunk = max(seconds - a_row * rows, 0.0)
    return a_chunk * cell.count + a_row * cell.rows
