"""Run of a study: compute the missing chunks and commit each as it finishes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Protocol

from numpy.typing import NDArray

from holdfast.core.errors import HoldfastError
from holdfast.core.sweeps.job import SweepCell
from holdfast.core.sweeps.journal import JournalEntry
from holdfast.core.sweeps.run_log import RunLog
from holdfast.core.sweeps.runner import ChunkTask, Runner, Stop
from holdfast.core.sweeps.store import Store

Progress = Callable[[int, int, float | None], None]
"""Called with the chunks done, the chunks in all, and the seconds that are probably left."""


class _StudyFolder(Protocol):
    """Interface of the folder that a run reads and writes; see :class:`holdfast.core.sweeps.Study`."""

    made: RunLog

    @property
    def seed(self) -> int: ...
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
        self._missing: dict[int, list[int]] = {}
        self._stores: dict[int, Store] = {}
        self._left: dict[int, int] = {}
        self._numbers: list[dict[str, Any]] = study.made.makers
        self._begun = set(study.begun_cells)
        self._problems: dict[str, HoldfastError] = {}

    def run(self, runner: Runner, stop: Stop, part: tuple[int, int]) -> dict[str, HoldfastError]:
        """See :meth:`Study.run`."""
        last_cell = -1
        for number, cell in enumerate(self._cells):
            done = self._intact_entries(number)
            own_chunks = []
            for chunk in range(cell.count):
                last_cell += 1
                if chunk not in done and last_cell % part[1] == part[0] - 1:
                    own_chunks.append(chunk)
            if own_chunks:
                self._missing[number] = own_chunks
                self._left[number] = len(own_chunks)
        total, done_before = last_cell + 1, last_cell + 1 - sum(self._left.values())
        committed, begin, started = 0, time.monotonic(), datetime.now(UTC)
        if self._progress is not None:
            self._progress(done_before, total, None)
        try:
            for result in runner.results(self._missing_chunk_tasks(), stop):
                cell = self._cells[result.task.cell]
                if result.columns is None:
                    assert result.problem is not None
                    self._problems.setdefault(cell.name, result.problem)
                    continue
                self._commit_result(result.task, result.columns, result.seconds, result.made)
                committed += 1
                if self._progress is not None:
                    remaining = total - done_before - committed
                    self._progress(done_before + committed, total, remaining * (time.monotonic() - begin) / committed)
        finally:
            if committed:
                self._log_run(runner.about, started, time.monotonic() - begin, committed)
        return self._problems

    def _intact_entries(self, cell_number: int) -> dict[int, JournalEntry]:
        """Return the finished chunks whose files have their recorded length, and drop the others."""
        if not self._study.cell_folder(cell_number).exists():
            return {}
        entries = self._study.cell_entries(cell_number)
        if not entries:
            return {}
        store = self._study.cell_store(cell_number)
        lost_chunks = [n for n, e in store.entries.items() if store.chunk_size(n) != e.size]
        if lost_chunks:
            store.drop_chunks(lost_chunks)
        return dict(store.entries)

    def _missing_chunk_tasks(self) -> Iterator[ChunkTask]:
        for number, numbers in self._missing.items():
            cell = self._cells[number]
            for chunk in numbers:
                if cell.name in self._problems:
                    break
                yield ChunkTask(number, cell.job, cell.chunk_at(chunk, self._study.seed))

    def _commit_result(
        self, task: ChunkTask, columns: Mapping[str, NDArray[Any]], seconds: float, made: dict[str, Any]
    ) -> None:
        number, cell = task.cell, self._cells[task.cell]
        if number not in self._stores:
            folder = self._study.cell_folder(number)
            self._stores[number] = Store.create(
                folder, cell.plan, cell.job.columns(), rows=cell.stored_shape[0], chunk=cell.stored_shape[1], journal=True
            )
        if made not in self._numbers:
            self._study.made.machine_number(made)
            self._numbers = self._study.made.makers
        self._stores[number].commit_chunk(task.chunk.number, columns, seconds, maker=self._numbers.index(made))
        if number not in self._begun:
            self._study.record_begun(number)
            self._begun.add(number)
        self._left[number] -= 1
        if not self._left[number]:
            del self._stores[number]

    def _log_run(self, runner: str, started: datetime, seconds: float, chunks: int) -> None:
        when = started.isoformat(timespec="seconds")
        self._study.made.add_runs([{"started": when, "seconds": round(seconds, 3), "on": runner, "chunks": chunks}])
