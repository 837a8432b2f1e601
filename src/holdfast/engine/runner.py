"""Who computes the chunks of a study: threads of this process, or a Dask cluster. No value depends on it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import Any, Protocol

from numpy.typing import NDArray

from holdfast.engine.hardware import machine
from holdfast.engine.job import Chunk, Job
from holdfast.errors import HoldfastError
from holdfast.notice import told, working

Stop = Callable[[], bool]


@dataclass(frozen=True, slots=True)
class Task:
    """A chunk of the cell with number ``cell``."""

    cell: int
    job: Job
    chunk: Chunk


@dataclass(frozen=True, slots=True, kw_only=True)
class Result:
    """What became of a task.

    Attributes:
        task: The task.
        columns: Its values, or None if the job refused.
        seconds: Processor time of the thread that computed it.
        made: Versions and processor.
        problem: Why the job refused.
    """

    task: Task
    columns: Mapping[str, NDArray[Any]] | None
    seconds: float
    made: dict[str, Any]
    problem: HoldfastError | None = None


class Runner(Protocol):
    """Computes tasks side by side."""

    @property
    def about(self) -> str:
        """What it is, for people."""

    def results(self, tasks: Iterator[Task], stop: Stop) -> Iterator[Result]:
        """Results as they come, a bounded number of tasks in hand; once ``stop()``, only of those that are at work."""


def compute(task: Task, alone: bool = True) -> Result:
    """Carry out a task in this thread."""
    begin = time.thread_time()
    try:
        task.job.prepare(alone)
        begin = time.thread_time()
        with working("a chunk", told):  # who runs the study tells of it
            columns = task.job.run(task.chunk)
    except HoldfastError as error:
        return Result(task=task, columns=None, seconds=time.thread_time() - begin, made=machine(), problem=error)
    return Result(task=task, columns=columns, seconds=time.thread_time() - begin, made=machine())


class Threads:
    """Threads of this process.

    Args:
        count: How many.
        pool: Threads to use, in place of new ones; not shut down.
    """

    def __init__(self, count: int, pool: Executor | None = None) -> None:
        self.count = count
        self._pool = pool

    @property
    def about(self) -> str:
        """How many."""
        return f"{self.count} thread{'' if self.count == 1 else 's'}"

    def results(self, tasks: Iterator[Task], stop: Stop) -> Iterator[Result]:
        """See :class:`Runner`."""
        pool = ThreadPoolExecutor(self.count) if self._pool is None else self._pool
        waiting: set[Future[Result]] = set()

        def more() -> None:
            task = None if stop() else next(tasks, None)
            if task is not None:
                waiting.add(pool.submit(compute, task, False))

        try:
            for _ in range(self.count + 1):  # one more than at work, so that no thread waits for the disk
                more()
            while waiting:
                done, _ = wait(waiting, return_when=FIRST_COMPLETED)
                waiting -= done
                if stop():
                    waiting = {f for f in waiting if not f.cancel()}
                for future in done:
                    more()
                    yield future.result()
        finally:
            for future in waiting:
                future.cancel()
            if self._pool is None:
                pool.shutdown(wait=True, cancel_futures=True)
