"""Estimate of the duration and size of a study, by computing a small part of each cell."""

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

from holdfast.core.sweeps.job import SweepCell
from holdfast.core.sweeps.store import Store
from holdfast.kernels.threads import shared_pool

_MIN_TRIAL_S = 0.2  # s of processor time for which whole chunks are computed, so that one slow chunk does not decide
_TRIAL_WRITES = 8  # chunks that are written to a temporary folder to measure the time


@dataclass(frozen=True)
class CellEstimate:
    """Estimated cost of one cell.

    Attributes:
        cell: Cell of the study.
        seconds: Processor time of the whole cell, s.
        size: Size before compression, bytes.
        tried: Number of rows that were computed for the estimate.
    """

    cell: SweepCell
    seconds: float
    size: int
    tried: int


def estimate_cells(cells: Sequence[SweepCell], seed: int, max_seconds: float = 3.0) -> Iterator[CellEstimate]:
    """Estimate each cell from few rows, from more rows within ``max_seconds``, and from whole chunks if this is fast enough.

    The compilation in the first rows does not count, but the writing of a chunk does. Times are processor times, which do not
    depend on other programs.

    Raises:
        HoldfastError: A cell cannot be computed; the message states the reason.
    """
    for cell in cells:
        cell.job.prepare(alone=False)
        rows, most_rows = min(8, cell.chunk, cell.rows), min(cell.chunk, cell.rows)
        _time_rows(cell, min(1, rows), seed)
        _time_rows(cell, rows, seed)
        tried = [(rows, _time_rows(cell, rows, seed)[0])]
        columns: Mapping[str, NDArray[Any]] = {}
        while rows < most_rows and 4 * tried[-1][1] <= max_seconds:
            rows = min(4 * rows, most_rows)
            seconds, columns = _time_rows(cell, rows, seed)
            tried.append((rows, seconds))
        if rows == most_rows:
            tried[-1] = rows, _time_chunk(cell, seed, tried[-1][1])
        compute = _extrapolate_seconds(tried, cell)
        row_bytes = sum(
            np.dtype(column.dtype).itemsize * math.prod(length for _, length in column.dims) for column in cell.job.columns()
        )
        yield CellEstimate(cell, compute + cell.count * _time_write(cell, columns), row_bytes * cell.stored_shape[0], rows)


def _time_rows(cell: SweepCell, rows: int, seed: int, number: int = 0) -> tuple[float, Mapping[str, NDArray[Any]]]:
    """Compute a number of rows and return the processor time in seconds, and the columns."""
    chunk = cell.with_rows(rows).chunk_at(0, seed) if number == 0 else cell.chunk_at(number, seed)

    def run_timed() -> tuple[float, Mapping[str, NDArray[Any]]]:
        start_time = time.thread_time()
        columns = cell.job.run(chunk)
        return time.thread_time() - start_time, columns

    # In one thread of the pool, as in the study, so that compilation in the background does not count.
    return shared_pool().submit(run_timed).result()


def _time_chunk(cell: SweepCell, seed: int, first_seconds: float) -> float:
    """Return the median processor time of whole chunks, of which enough are computed for a reliable median."""
    times, full_chunks = [first_seconds], cell.rows // cell.chunk
    while len(times) < full_chunks and (len(times) < 3 or sum(times) < _MIN_TRIAL_S):
        times.append(_time_rows(cell, cell.chunk, seed, len(times))[0])
    return float(np.median(times))  # the first one may have waited for compilation


def _time_write(cell: SweepCell, columns: Mapping[str, NDArray[Any]]) -> float:
    """Write a chunk several times into a folder that is removed, and return the processor time of one."""
    if not columns:
        return 0.0
    size = len(next(iter(columns.values())))
    with TemporaryDirectory() as folder:
        store = Store.create(Path(folder) / "tried", {}, cell.job.columns(), rows=_TRIAL_WRITES * size, chunk=size)
        with store.lock_for_writing():
            clock_times = [time.process_time()]
            for number in range(_TRIAL_WRITES):
                store.commit_chunk(number, columns)
                clock_times.append(time.process_time())
            return float(np.median(np.diff(clock_times)))


def _extrapolate_seconds(tried: Sequence[tuple[int, float]], cell: SweepCell) -> float:
    """Return the seconds of all chunks of a cell, by a constant time per chunk and per row from the trials."""
    (first_rows, first_seconds), (rows, seconds) = tried[0], tried[-1]
    if rows == first_rows:
        return seconds * cell.rows / rows
    per_row = max(seconds - first_seconds, 0.0) / (rows - first_rows)
    per_chunk = max(seconds - per_row * rows, 0.0)
    return per_chunk * cell.count + per_row * cell.rows
