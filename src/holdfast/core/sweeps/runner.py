"""Runners that compute the chunks of a study: threads of this process or a Dask cluster; no value depends on the choice."""

from __future__ import annotations

import platform
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from numpy.typing import NDArray

from holdfast.core.errors import HoldfastError
from holdfast.core.progress import ignore_progress, report_work
from holdfast.core.provenance import versions
from holdfast.core.sweeps.job import Chunk, SweepJob

Stop = Callable[[], bool]
_RECORDED_PACKAGES = ("holdfast", "numpy", "scipy", "casadi", "llvmlite", "zarr", "mujoco")


@dataclass(frozen=True, slots=True)
class ChunkTask:
    """Task to compute the rows of ``chunk`` with ``job``, for the cell with number ``cell`` (from 0)."""

    cell: int
    job: SweepJob
    chunk: Chunk


@dataclass(frozen=True, slots=True, kw_only=True)
class ChunkResult:
    """Result of a task.

    Attributes:
        task: The task.
        columns: Values by column, or None if the job raised an error.
        seconds: Processor time of the thread that computed it, s.
        made: Versions and processor that computed the values.
        problem: Error of the job, or None.
    """

    task: ChunkTask
    columns: Mapping[str, NDArray[Any]] | None
    seconds: float
    made: dict[str, Any]
    problem: HoldfastError | None = None


@runtime_checkable
class Runner(Protocol):
    """Interface that computes tasks in parallel."""

    @property
    def about(self) -> str:
        """Description of the runner for people."""

    def results(self, tasks: Iterator[ChunkTask], stop: Stop) -> Iterator[ChunkResult]:
        """Yield results of ``tasks`` as they finish, a bounded number at once; after ``stop()``, only of those in progress."""


def compute_chunk(task: ChunkTask, alone: bool = True) -> ChunkResult:
    """Compute a task in this thread."""
    begin = time.thread_time()
    try:
        task.job.prepare(alone)
        begin = time.thread_time()
        with report_work("a chunk", ignore_progress):  # the study reports the progress
            columns = task.job.run(task.chunk)
    except HoldfastError as error:
        return ChunkResult(task=task, columns=None, seconds=time.thread_time() - begin, made=describe_machine(), problem=error)
    return ChunkResult(task=task, columns=columns, seconds=time.thread_time() - begin, made=describe_machine())


@lru_cache(maxsize=1)
def describe_machine() -> dict[str, Any]:
    """Return versions and processor of this process; equal ones compute equal bits."""
    return {"processor": _processor_name(), "python": platform.python_version(), "versions": versions(*_RECORDED_PACKAGES)}


def _processor_name() -> str:
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return " ".join(line.partition(":")[2].split())
    except OSError:
        pass
    return platform.processor() or platform.machine()


class ThreadRunner:
    """Threads of this process.

    Args:
        count: Number of threads.
        pool: Threads to use instead of new ones; they are not shut down.
    """

    def __init__(self, count: int, pool: Executor | None = None) -> None:
        self.count = count
        self._pool = pool

    @property
    def about(self) -> str:
        """Number of threads."""
        return f"{self.count} thread{'' if self.count == 1 else 's'}"

    def results(self, tasks: Iterator[ChunkTask], stop: Stop) -> Iterator[ChunkResult]:
        """Yield the results of ``tasks`` until ``stop()``; see :meth:`Runner.results`."""
        pool = ThreadPoolExecutor(self.count) if self._pool is None else self._pool
        waiting: set[Future[ChunkResult]] = set()

        def submit_next() -> None:
            task = None if stop() else next(tasks, None)
            if task is not None:
                waiting.add(pool.submit(compute_chunk, task, False))

        try:
            for _ in range(self.count + 1):  # one more than there are threads, so that no thread waits for the disk
                submit_next()
            while waiting:
                done, _ = wait(waiting, return_when=FIRST_COMPLETED)
                waiting -= done
                if stop():
                    waiting = {finished for finished in waiting if not finished.cancel()}
                for future in done:
                    submit_next()
                    yield future.result()
        finally:
            for future in waiting:
                future.cancel()
            if self._pool is None:
                pool.shutdown(wait=True, cancel_futures=True)
