"""Threads that own the records: one for writing, and one for reading.

The writer collects the changes of a few milliseconds, applies each of them separately inside one transaction, commits once, and
only then replies. Every confirmed change is therefore on the disk, and one ``fsync`` serves all stations.
"""

from __future__ import annotations

import asyncio
import logging
import queue
import sqlite3
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import nullcontext
from pathlib import Path
from typing import Any

from holdfast.core.errors import HoldfastError, StoreError
from holdfast.core.typing import T
from holdfast.teleop.records.records import Records

_GATHER_TIME_S = 0.008  # time for which the first change of a transaction waits for others, s
_MAX_TRANSACTION_JOBS = 512  # changes in one transaction

_log = logging.getLogger(__name__)

Job = tuple[Callable[[Records], Any], Callable[[Any], None]]


class RecordsThread:
    """Thread that owns the records of a folder and runs its jobs in order.

    Results are delivered in the event loop; if a job fails, the result is its exception.

    Args:
        folder: Folder of the experiment.
        loop: Event loop of the server.
        writes: True if jobs change the records and are committed together; False if they only read, one by one.
        on_fault: Function that is called in the event loop with the reason when the records cannot be written, and with None
            when they can be written again.

    Attributes:
        protocol: Protocol of the experiment.
        fault: Reason why the records cannot be written; None if they can.

    Raises:
        StoreError: The folder cannot be opened.
    """

    def __init__(
        self,
        folder: Path,
        loop: asyncio.AbstractEventLoop,
        writes: bool,
        on_fault: Callable[[str | None], None] = lambda fault: None,
    ) -> None:
        self._folder, self._loop, self._writes, self._on_fault = folder, loop, writes, on_fault
        self.fault: str | None = None
        self._jobs: queue.SimpleQueue[Job | None] = queue.SimpleQueue()
        self._thread = threading.Thread(
            target=self._run_thread, name="holdfast-writer" if writes else "holdfast-reader", daemon=True
        )
        self._opened: Future[Records] = Future()
        self._thread.start()
        self.protocol = self._opened.result().protocol

    def submit_job(self, job: Callable[[Records], Any], answer: Callable[[Any], None]) -> None:
        """Submit a job; ``answer`` is called in the event loop with its result, or with its exception.

        A job that fails must not leave a partial change; a job of several changes uses :meth:`Records.transaction`.
        """
        self._jobs.put((job, answer))

    async def run_job(self, job: Callable[[Records], T]) -> T:
        """Run a job, and return its result."""
        future: asyncio.Future[T] = self._loop.create_future()

        def set_outcome(result: Any) -> None:
            if future.cancelled():
                return
            if isinstance(result, Exception):
                future.set_exception(result)
            else:
                future.set_result(result)

        self.submit_job(_make_atomic(job) if self._writes else job, set_outcome)
        return await future

    def close(self) -> None:
        """Run the jobs submitted so far, and close the file."""
        self._jobs.put(None)
        self._thread.join()

    # ---- in the thread ---------------------------------------------------------------------------------------------

    def _run_thread(self) -> None:
        try:
            records = Records.open(self._folder)
            if self._writes:
                records.upgrade_tables()
        except Exception as error:
            self._opened.set_exception(error)
            return
        with records:
            self._opened.set_result(records)
            while self._run_transaction(records):
                pass

    def _run_transaction(self, records: Records) -> bool:
        """Run one transaction, and return False after the last one."""
        jobs: list[Job] = []
        job = self._jobs.get()
        deadline = time.monotonic() + _GATHER_TIME_S
        while job is not None:
            jobs.append(job)
            remaining = deadline - time.monotonic()
            if not self._writes or len(jobs) == _MAX_TRANSACTION_JOBS or remaining <= 0:
                break
            try:
                job = self._jobs.get(timeout=remaining)
            except queue.Empty:
                break
        if jobs:
            results = self._run_jobs(records, jobs)
            answers = [answer for _, answer in jobs]
            # The loop may have stopped, so that no reply is expected.
            if not self._loop.is_closed():
                self._loop.call_soon_threadsafe(_deliver_results, answers, results)
        return job is not None

    def _run_jobs(self, records: Records, jobs: list[Job]) -> list[Any]:
        changes_before = records.changes
        try:
            with records.transaction() if self._writes else nullcontext():
                results = [_call_job(job, records) for job, _ in jobs]
        # Full disk, deleted folder, or lock of another program: no change was applied.
        except (sqlite3.Error, StoreError) as error:
            self._set_record_error(str(error))
            return [StoreError(f"the records cannot be written ({error}); nothing was recorded")] * len(jobs)
        if self.fault is not None and records.changes > changes_before:
            self._set_record_error(None)
        return results

    def _set_record_error(self, fault: str | None) -> None:
        """Set the fault, and report a change once, not for each message."""
        if (fault is None) != (self.fault is None):
            _log.error("the records can be written again" if fault is None else f"the records cannot be written: {fault}")
            if not self._loop.is_closed():
                self._loop.call_soon_threadsafe(self._on_fault, fault)
        self.fault = fault


def _make_atomic(job: Callable[[Records], T]) -> Callable[[Records], T]:
    """Return a job that is applied completely or not at all."""

    def run_atomic(records: Records) -> T:
        with records.transaction():
            return job(records)

    return run_atomic


def _call_job(job: Callable[[Records], Any], records: Records) -> Any:
    try:
        return job(records)
    except HoldfastError as error:
        return error
    except (sqlite3.OperationalError, sqlite3.InternalError):  # a full disk cancels the whole transaction
        raise
    except Exception as error:
        _log.exception("a job of the records failed")
        return error


def _deliver_results(answers: list[Callable[[Any], None]], results: list[Any]) -> None:
    for answer, result in zip(answers, results, strict=True):
        answer(result)
