"""Jobs of a search, run in sequence or in several processes, with finished results stored on disk."""

from __future__ import annotations

import os
import signal
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, fields, replace
from functools import partial
from multiprocessing import get_context, parent_process
from multiprocessing.connection import wait as wait_for
from threading import Thread
from time import monotonic, perf_counter
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.tree import SearchState, StateCallback
from holdfast.core.errors import HoldfastError
from holdfast.core.progress import print_warning
from holdfast.core.sweeps.memory import Parts, SearchMemory

_START_TIME_DIVISOR = 4  # the setup of jobs may take the time limit divided by this
_TIME_SLICE_S = 2.0  # s for a part before the next one, so that a stopped search has results for each part
_POLL_INTERVAL_S = 0.2  # s between polls of messages from other processes
StopCheck = Callable[[], bool]


@dataclass(frozen=True, eq=False, kw_only=True)
class JobResult:
    """Result of a search job, whose fields the search memory stores.

    Attributes:
        state: Proved and undecided fractions of this job, in which parts deferred to child jobs count as neither.
        seconds: Measured time, s.
        finished: True if nothing is open except parts deferred to child jobs; only such results are stored.
    """

    state: SearchState
    seconds: float = 0.0
    finished: bool = False

    @property
    def nodes(self) -> int:
        """Number of examined cells."""
        return self.state.nodes

    def check_cell_limit(self) -> None:
        """Raise an error if the job would take too many cells."""

    def to_arrays(self) -> Parts:
        """Return the result as arrays for the search memory."""
        return {field.name: _to_array(getattr(self, field.name)) for field in fields(self) if field.type in _FROM_ARRAY}

    @classmethod
    def from_arrays(cls, arrays: Parts, **values: Any) -> Self:
        """Rebuild a finished result from its stored arrays, with ``values`` for fields of other types."""
        types = {field.name: str(field.type) for field in fields(cls) if field.type in _FROM_ARRAY}
        return cls(finished=True, **{name: _FROM_ARRAY[kind](arrays[name]) for name, kind in types.items()}, **values)

    def merge(self, results: Sequence[Self], **values: Any) -> Self:
        """Return this result combined with the results of the child jobs, and with some values replaced."""
        states = [self.state, *(result.state for result in results)]
        total = SearchState(**{key: sum(getattr(state, key) for state in states) for key in _STATE_KEYS})
        seconds = self.seconds + sum(result.seconds for result in results)
        finished = self.finished and all(result.finished for result in results)
        return replace(self, state=total, seconds=seconds, finished=finished, **values)


_STATE_KEYS = ("nodes", "proved", "refuted", "undecided", "open")
_FROM_ARRAY: dict[Any, Callable[[Any], Any]] = {
    "bytes": lambda values: values.tobytes(),
    "float": float,
    "IndexArray": lambda values: values.astype(np.int64),
    "tuple[int, ...]": lambda values: tuple(values.tolist()),
    "SearchState": lambda values: SearchState(**dict(zip(_STATE_KEYS, [int(values[0]), *values[1:].tolist()], strict=True))),
}  # by the type of a field


def _to_array(value: Any) -> NDArray[Any]:
    if isinstance(value, SearchState):
        return np.array([getattr(value, key) for key in _STATE_KEYS], dtype=np.float64)
    return np.frombuffer(value, dtype=np.uint8) if isinstance(value, bytes) else np.asarray(value)


class SearchJob(ABC):
    """Piece of a search, whose result depends only on the job, not on the number of processes or on earlier results."""

    name: str
    """Name in the search memory."""
    claim_fraction: float = 1.0
    """Fraction of its part of the claim to which the states of this job refer, which is the weight of its progress."""
    result_type: type[Any]
    """Class of its results."""

    @abstractmethod
    def make_search(self, deadline: float) -> Any:
        """Make the search, with time for the setup until the monotonic time ``deadline``."""

    def run_search(self, search: Any, deadline: float, should_stop: StopCheck, report_progress: Callable[[], None]) -> bool:
        """Continue a search, and return True if nothing is open except parts deferred to child jobs."""
        return bool(search.run(deadline, should_stop, report_progress))

    @abstractmethod
    def read_result(self, search: Any, **values: Any) -> Any:
        """Return the result of a search so far, with ``values`` for the common fields."""

    @abstractmethod
    def empty_result(self) -> Any:
        """Return the result of a job that never ran."""

    @abstractmethod
    def child_jobs(self, result: Any) -> Sequence[SearchJob]:
        """Return the child jobs to which a result defers open parts."""

    @abstractmethod
    def merge_child_results(self, result: Any, child_results: Sequence[Any]) -> Any:
        """Merge the results of the child jobs into this job's result."""


class RunningJob:
    """Search job that has been started.

    Attributes:
        job: The job that runs.
        finished: True if nothing is open except the parts deferred to child jobs.
    """

    def __init__(self, job: SearchJob, deadline: float) -> None:
        started = perf_counter()
        self.job, self._search = job, job.make_search(deadline)
        self.finished, self._seconds = bool(getattr(self._search, "is_settled", False)), perf_counter() - started

    def run(self, deadline: float, should_stop: StopCheck, report_progress: Callable[[], None]) -> None:
        """Continue the search until the monotonic time ``deadline``, or until ``should_stop()`` is true."""
        started = perf_counter()
        self.finished = self.job.run_search(self._search, deadline, should_stop, report_progress)
        self._seconds += perf_counter() - started

    @property
    def state(self) -> SearchState:
        """Current progress of the job."""
        state: SearchState = self._search.state
        return state

    def result(self) -> Any:
        """Return the result so far."""
        return self.job.read_result(self._search, state=self.state, seconds=self._seconds, finished=self.finished)


@dataclass(frozen=True, kw_only=True)
class SearchBudget:
    """Time limit, processes, callbacks and memory of a search.

    Attributes:
        deadline: Monotonic time at which the search ends, s.
        should_stop: Function that is called regularly; the search ends after it has returned True.
        report_state: Function that is called with the progress of the whole search.
        workers: Number of worker processes.
        memory: Search memory in a folder; None without one.
    """

    deadline: float = np.inf
    should_stop: StopCheck = lambda: False
    report_state: StateCallback = lambda now: None
    workers: int = 1
    memory: SearchMemory | None = None

    def run_jobs(self, jobs: Sequence[SearchJob], max_nodes: float = np.inf) -> list[Any]:
        """Run jobs and their child jobs and return one result each; stop after ``max_nodes`` examined cells."""
        search_pool = SearchPool(jobs, self)

        def is_exhausted() -> bool:
            return search_pool.nodes > max_nodes or self.should_stop()

        if self.workers == 1:
            search_pool.run_serial(self.deadline, is_exhausted)
        else:
            search_pool.run_parallel(self.workers, self.deadline, is_exhausted)
        return [search_pool.collect_result(job) for job in jobs]


class SearchPool:
    """Pool of the jobs of a search and their results.

    Args:
        jobs: One job for each part of the search, which can have child jobs.
        budget: Budget whose memory and callbacks are used.

    Attributes:
        nodes: Number of examined cells.
    """

    def __init__(self, jobs: Sequence[SearchJob], budget: SearchBudget) -> None:
        self._report_state, self._memory, self._job_count = budget.report_state, budget.memory, len(jobs)
        self._results, self._states = dict[str, JobResult](), dict[str, tuple[float, SearchState]]()
        self._open_jobs, self.nodes, self._shown_warnings = list[SearchJob](), 0, set[str]()
        for job in jobs:
            self._enqueue_job(job)

    def _enqueue_job(self, job: SearchJob) -> None:
        """Queue a job, or reuse its result from the memory."""
        stored = None if self._memory is None else self._memory.recall(job.name)
        if stored is None:
            self._open_jobs.append(job)
        else:
            self._record_result(job, job.result_type.from_arrays(stored))

    def _record_result(self, job: SearchJob, result: JobResult) -> None:
        """Record the result of a job and queue its child jobs."""
        self._results[job.name] = result
        if self._memory is not None and result.finished and self._memory.recall(job.name) is None:
            self._memory.store(job.name, result.to_arrays())
        self._update_state(job, result.state)
        for child in job.child_jobs(result):
            self._enqueue_job(child)

    def _update_running(self, running: RunningJob) -> None:
        self._update_state(running.job, running.state)

    def _update_state(self, job: SearchJob, state: SearchState) -> None:
        self._states[job.name] = job.claim_fraction, state
        if state.warning and state.warning not in self._shown_warnings:
            self._shown_warnings.add(state.warning)
            print_warning(state.warning)
        states = self._states.values()
        fractions = {
            key: sum(weight * getattr(job_state, key) for weight, job_state in states) / self._job_count
            for key in ("proved", "refuted", "undecided")
        }
        self.nodes = sum(job_state.nodes for _, job_state in states)
        self._report_state(SearchState(**fractions, open=max(1 - sum(fractions.values()), 0.0), nodes=self.nodes))

    def collect_result(self, job: SearchJob) -> Any:
        """Return the result of a job merged with its child jobs; parts that were never examined are undecided."""
        result = self._results.get(job.name)
        if result is None:
            return job.empty_result()
        return job.merge_child_results(result, [self.collect_result(child) for child in job.child_jobs(result)])

    def run_serial(self, deadline: float, should_stop: StopCheck) -> None:
        """Run the jobs in this process until a monotonic time or a stop request."""
        start_deadline, running = monotonic() + (deadline - monotonic()) / _START_TIME_DIVISOR, list[RunningJob]()
        jobs, self._open_jobs = self._open_jobs, []
        for remaining, job in zip(range(len(jobs), 0, -1), jobs, strict=True):
            now = monotonic()
            started = RunningJob(job, now if should_stop() else now + (start_deadline - now) / remaining)
            started.result().check_cell_limit()
            self._update_running(started)
            if started.finished:
                self._record_result(job, started.result())
            else:
                running.append(started)
        # With a memory, jobs run in sequence, so that a killed search has finished results to resume from.
        time_slice = np.inf if self._memory is not None and np.isinf(deadline) else _TIME_SLICE_S
        while (running or self._open_jobs) and monotonic() < deadline and not should_stop():
            waiting, self._open_jobs = self._open_jobs, []
            continuations: list[RunningJob | SearchJob] = [*running, *waiting]
            running = []
            for remaining, next_job in zip(range(len(continuations), 0, -1), continuations, strict=True):
                now = monotonic()
                duration = (deadline - now) / remaining
                # Setups are complete unless time is short, because their results count.
                work = next_job if isinstance(next_job, RunningJob) else RunningJob(next_job, now + duration / 2)
                work.run(min(now + duration, monotonic() + time_slice), should_stop, partial(self._update_running, work))
                if work.finished:
                    self._record_result(work.job, work.result())
                else:
                    running.append(work)
        for running_job in running:
            self._record_result(running_job.job, running_job.result())

    def run_parallel(self, workers: int, deadline: float, should_stop: StopCheck) -> None:
        """Run the jobs in ``workers`` other processes until a monotonic time or a stop request.

        Raises:
            InputError: A part would take too many cells.
            HoldfastError: A process ended, possibly because of a lack of memory.
        """
        context = get_context("spawn")
        messages, stop_event = context.SimpleQueue(), context.Event()
        jobs_by_name = dict[str, SearchJob]()
        with ProcessPoolExecutor(workers, context, _init_worker, (messages, stop_event)) as executor:
            futures = dict[Future[JobResult], SearchJob]()
            try:
                while self._open_jobs or futures:
                    while self._open_jobs and len(futures) < workers and not stop_event.is_set():
                        now, job = monotonic(), self._open_jobs.pop(0)
                        job_deadline = min(deadline, now + (deadline - now) * workers / (1 + len(self._open_jobs)))
                        jobs_by_name[job.name], futures[executor.submit(_run_job, job, job_deadline)] = job, job
                    if should_stop() or monotonic() > deadline:
                        stop_event.set()
                        self._open_jobs.clear()
                    for future in wait(futures, _POLL_INTERVAL_S, FIRST_COMPLETED).done:
                        result = future.result()
                        result.check_cell_limit()
                        self._record_result(futures.pop(future), result)
                    while not messages.empty():
                        name, state = messages.get()
                        if name not in self._results:
                            self._update_state(jobs_by_name[name], state)
            except BrokenProcessPool as error:
                reason = "possibly for lack of memory; a store keeps finished results, and fewer workers need less memory"
                raise HoldfastError(f"a process of the search ended, {reason}") from error
            finally:
                stop_event.set()


# ---- in the other processes ----------------------------------------------------------------------------------------------

_worker_state: dict[str, Any] = {}


def _init_worker(messages: Any, stop_event: Any) -> None:
    """Set up a worker process that ignores Ctrl-C and exits when its parent process exits."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _worker_state.update(news=messages, halt=stop_event)
    if (parent := parent_process()) is not None:
        Thread(target=lambda: (wait_for([parent.sentinel]), os._exit(1)), daemon=True).start()


def _run_job(job: SearchJob, deadline: float) -> JobResult:
    running, last_report = RunningJob(job, deadline), [monotonic()]

    def report_progress() -> None:
        if monotonic() > last_report[0] + _POLL_INTERVAL_S:
            last_report[0] = monotonic()
            _worker_state["news"].put((job.name, running.state))

    if not running.finished:
        running.run(deadline, _worker_state["halt"].is_set, report_progress)
    result: JobResult = running.result()
    return result
