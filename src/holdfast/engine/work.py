"""One run of a study: what is missing is computed, and committed as it comes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Protocol

from numpy.typing import NDArray

from holdfast.engine.job import Cell
from holdfast.engine.journal import Entry
from holdfast.engine.makers import Made
from holdfast.engine.runner import Runner, Stop, Task
from holdfast.engine.store import Store
from holdfast.errors import HoldfastError

Progress = Callable[[int, int, float | None], None]
"""Called with the chunks done, the chunks in all, and the seconds that are probably left."""


class _Study(Protocol):
    """The folder that a run reads and writes; see :class:`holdfast.engine.Study`."""

    made: Made

    @property
    def seed(self) -> int: ...
    @property
    def begun(self) -> frozenset[int]: ...
    def folder(self, cell: int) -> Path: ...
    def store(self, cell: int) -> Store: ...
    def entries(self, cell: int) -> dict[int, Entry]: ...
    def note_begun(self, cell: int) -> None: ...


class Work:
    """One run of a study."""

    def __init__(self, study: _Study, cells: Sequence[Cell], progress: Progress | None) -> None:
        self._study, self._cells, self._progress = study, cells, progress
        self._missing: dict[int, list[int]] = {}
        self._stores: dict[int, Store] = {}
        self._left: dict[int, int] = {}
        self._numbers: list[dict[str, Any]] = study.made.makers
        self._begun = set(study.begun)
        self._problems: dict[str, HoldfastError] = {}

    def run(self, runner: Runner, stop: Stop, part: tuple[int, int]) -> dict[str, HoldfastError]:
        """See :meth:`Study.run`."""
        at = -1
        for k, cell in enumerate(self._cells):
            done = self._sound(k)
            mine = []
            for n in range(cell.count):
                at += 1
                if n not in done and at % part[1] == part[0] - 1:
                    mine.append(n)
            if mine:
                self._missing[k] = mine
                self._left[k] = len(mine)
        total, done_before = at + 1, at + 1 - sum(self._left.values())
        committed, begin, started = 0, time.monotonic(), datetime.now(UTC)
        if self._progress is not None:
            self._progress(done_before, total, None)
        try:
            for result in runner.results(self._tasks(), stop):
                cell = self._cells[result.task.cell]
                if result.columns is None:
                    assert result.problem is not None
                    self._problems.setdefault(cell.name, result.problem)
                    continue
                self._commit(result.task, result.columns, result.seconds, result.made)
                committed += 1
                if self._progress is not None:
                    rest = total - done_before - committed
                    self._progress(done_before + committed, total, rest * (time.monotonic() - begin) / committed)
        finally:
            if committed:
                self._note(runner.about, started, time.monotonic() - begin, committed)
        return self._problems

    def _sound(self, k: int) -> dict[int, Entry]:
        """Chunks that are done and whose files are as long as they were; the others are dropped."""
        if not self._study.folder(k).exists():
            return {}
        entries = self._study.entries(k)
        if not entries:
            return {}
        store = self._study.store(k)
        lost = [n for n, e in store.entries.items() if store.size(n) != e.size]
        if lost:
            store.drop(lost)
        return dict(store.entries)

    def _tasks(self) -> Iterator[Task]:
        for k, numbers in self._missing.items():
            cell = self._cells[k]
            for n in numbers:
                if cell.name in self._problems:
                    break
                yield Task(k, cell.job, cell.part(n, self._study.seed))

    def _commit(self, task: Task, columns: Mapping[str, NDArray[Any]], seconds: float, made: dict[str, Any]) -> None:
        k, cell = task.cell, self._cells[task.cell]
        if k not in self._stores:
            folder = self._study.folder(k)
            self._stores[k] = Store.create(
                folder, cell.plan, cell.job.columns(), rows=cell.stored[0], chunk=cell.stored[1], journal=True
            )
        if made not in self._numbers:
            self._study.made.number(made)
            self._numbers = self._study.made.makers
        self._stores[k].write(task.chunk.number, columns, seconds, maker=self._numbers.index(made))
        if k not in self._begun:
            self._study.note_begun(k)
            self._begun.add(k)
        self._left[k] -= 1
        if not self._left[k]:
            del self._stores[k]

    def _note(self, runner: str, started: datetime, seconds: float, chunks: int) -> None:
        when = started.isoformat(timespec="seconds")
        self._study.made.add([{"started": when, "seconds": round(seconds, 3), "on": runner, "chunks": chunks}])
