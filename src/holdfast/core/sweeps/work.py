"""Run of a study: compute the missing chunks and commit each as it finishes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Protocol

from holdfast.core.errors import HoldfastError
from holdfast.core.sweeps.job import SweepCell
from holdfast.core.sweeps.journal import JournalEntry
from holdfast.core.sweeps.run_log import RunLog
from holdfast.core.sweeps.runner import ChunkResult, ChunkTask, Runner, Stop
from holdfast.core.sweeps.store import Store

Progress = Callable[[int, int, float | None], None]
"""Function that is called with the chunks done, the total number of chunks, and the estimated remaining seconds."""


class _StudyFolder(Protocol):
    """Interface of the folder that a run reads and writes; see :class:`holdfast.core.sweeps.Study`."""

    made: RunLog

    @property
    def seed(self) -> int: ...
    @property
    def makers(self) -> list[dict[str, Any]]: ...
    @property
    def begun_cells(self) -> frozenset[int]: ...
    def cell_folder(self, cell: int) -> Path: ...
    def cell_store(self, cell: int) -> Store: ...
    def cell_entries(self, cell: int) -> dict[int, JournalEntry]: ...
    def record_begun(self, cell: int) -> None: ...


class StudyRun:
    """Run of a study."""

    def __init__(self, study: _StudyFolder, cells: Sequence[SweepCell], progress: Progress | None) -> None:
        self._study, self._cells, self._progress = study, cells, progress
        self._stores: dict[int, Store] = {}
        self._remaining: dict[int, int] = {}  # chunks of each cell that this run computes
        self._makers = study.makers
        self._begun = set(study.begun_cells)
        self._problems: dict[str, HoldfastError] = {}

    def run(self, runner: Runner, stop: Stop, part: tuple[int, int]) -> dict[str, HoldfastError]:
        """Run the study; see :meth:`Study.run`."""
        missing, total = [], 0
        for number, cell in enumerate(self._cells):
            done = self._find_finished_chunks(number)
            own = [n for n in range(cell.count) if n not in done and (total + n) % part[1] == part[0] - 1]
            missing += [(number, chunk) for chunk in own]
            self._remaining[number] = len(own)
            total += cell.count
        finished, committed, begin, started = total - len(missing), 0, time.monotonic(), datetime.now(UTC)
        self._report(finished, total, None)
        try:
            for result in runner.results(self._make_tasks(missing), stop):
                if result.columns is None:
                    assert result.problem is not None
                    self._problems.setdefault(self._cells[result.task.cell].name, result.problem)
                    continue
                self._commit(result)
                committed += 1
                seconds_left = (len(missing) - committed) * (time.monotonic() - begin) / committed
                self._report(finished + committed, total, seconds_left)
        finally:
            if committed:
                run = {"started": started.isoformat(timespec="seconds"), "seconds": round(time.monotonic() - begin, 3)}
                self._study.made.add_runs([{**run, "on": runner.about, "chunks": committed}])
        return self._problems

    def _report(self, done: int, total: int, seconds_left: float | None) -> None:
        if self._progress is not None:
            self._progress(done, total, seconds_left)

    def _find_finished_chunks(self, number: int) -> set[int]:
        """Return the finished chunks whose files have their recorded length, and drop the others."""
        if not self._study.cell_entries(number):
            return set()
        store = self._study.cell_store(number)
        store.drop_incomplete_chunks()
        return set(store.entries)

    def _make_tasks(self, missing: Sequence[tuple[int, int]]) -> Iterator[ChunkTask]:
        for number, chunk in missing:
            cell = self._cells[number]
            if cell.name not in self._problems:
                yield ChunkTask(number, cell.job, cell.chunk_at(chunk, self._study.seed))

    def _commit(self, result: ChunkResult) -> None:
        assert result.columns is not None
        number, cell = result.task.cell, self._cells[result.task.cell]
        if number not in self._stores:
            rows, chunk = cell.stored_shape
            folder = self._study.cell_folder(number)
            self._stores[number] = Store.create(folder, cell.plan, cell.job.columns(), rows=rows, chunk=chunk)
        if result.made not in self._makers:
            self._study.made.machine_number(result.made)
            self._makers = self._study.makers
        maker = self._makers.index(result.made)
        self._stores[number].commit_chunk(result.task.chunk.number, result.columns, result.seconds, maker=maker)
        if number not in self._begun:
            self._study.record_begun(number)
            self._begun.add(number)
        self._remaining[number] -= 1
        if not self._remaining[number]:
            del self._stores[number]
