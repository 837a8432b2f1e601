"""Threads that own the records: one that writes, one that reads at leisure.

The writer collects the changes that came within a few milliseconds, applies each, by itself, inside one transaction, commits
once, and only then answers: what has been answered is on the disk, and one ``fsync`` serves all stations.
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
from typing import Any, TypeVar

from holdfast.errors import HoldfastError, StoreError
from holdfast.teleop.records.records import Records

_GATHER = 0.008  # s that the first change of a transaction waits for others
_MOST = 512  # changes in one transaction

_log = logging.getLogger(__name__)

T = TypeVar("T")
Job = tuple[Callable[[Records], Any], Callable[[Any], None]]


class Keeper:
    """A thread that owns the records of a folder, and does what it is given, in order.

    Answers are given in the event loop, and where a job failed the answer is the exception.

    Args:
        folder: Of the experiment.
        loop: The event loop.
        writes: Jobs change the records, and are committed together; else they only read, one by one.
        on_fault: Is told, in the event loop, when the records cannot be written any more, and why; None when they can again.

    Attributes:
        protocol: Of the experiment.
        fault: Why the records cannot be written; None if they can.

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
        self._thread = threading.Thread(target=self._live, name="holdfast-writer" if writes else "holdfast-reader", daemon=True)
        self._opened: Future[Records] = Future()
        self._thread.start()
        self.protocol = self._opened.result().protocol

    def put(self, job: Callable[[Records], Any], answer: Callable[[Any], None]) -> None:
        """Do a job when its turn comes; ``answer`` is called in the event loop with its result, or with its exception.

        A job that fails must leave nothing half done: jobs of several changes use
        :meth:`holdfast.teleop.Records.together`.
        """
        self._jobs.put((job, answer))

    async def do(self, job: Callable[[Records], T]) -> T:
        """The result of a job."""
        future: asyncio.Future[T] = self._loop.create_future()

        def answer(result: Any) -> None:
            if future.cancelled():
                return
            if isinstance(result, Exception):
                future.set_exception(result)
            else:
                future.set_result(result)

        self.put(_whole(job) if self._writes else job, answer)
        return await future

    def close(self) -> None:
        """Do what was given so far, and close the file."""
        self._jobs.put(None)
        self._thread.join()

    # ---- in the thread ---------------------------------------------------------------------------------------------

    def _live(self) -> None:
        try:
            records = Records.open(self._folder)
            if self._writes:
                records.prepare()
        except Exception as error:
            self._opened.set_exception(error)
            return
        with records:
            self._opened.set_result(records)
            while self._work(records):
                pass

    def _work(self, records: Records) -> bool:
        """One transaction; False when there will be no more."""
        jobs: list[Job] = []
        job = self._jobs.get()
        until = time.monotonic() + _GATHER
        while job is not None:
            jobs.append(job)
            left = until - time.monotonic()
            if not self._writes or len(jobs) == _MOST or left <= 0:
                break
            try:
                job = self._jobs.get(timeout=left)
            except queue.Empty:
                break
        if jobs:
            results = self._all(records, jobs)
            answers = [answer for _, answer in jobs]
            # The loop may have stopped: then nobody waits for an answer.
            if not self._loop.is_closed():
                self._loop.call_soon_threadsafe(_answer, answers, results)
        return job is not None

    def _all(self, records: Records, jobs: list[Job]) -> list[Any]:
        before = records.changes
        try:
            with records.together() if self._writes else nullcontext():
                results = [_result(job, records) for job, _ in jobs]
        # A full disk, a folder that was deleted, a lock that somebody else keeps: none of it happened.
        except (sqlite3.Error, StoreError) as error:
            self._turn(str(error))
            return [StoreError(f"the records cannot be written ({error}); nothing was recorded")] * len(jobs)
        if self.fault is not None and records.changes > before:
            self._turn(None)
        return results

    def _turn(self, fault: str | None) -> None:
        """Say it once, not for each message."""
        if (fault is None) != (self.fault is None):
            _log.error("the records can be written again" if fault is None else f"the records cannot be written: {fault}")
            if not self._loop.is_closed():
                self._loop.call_soon_threadsafe(self._on_fault, fault)
        self.fault = fault


def _whole(job: Callable[[Records], T]) -> Callable[[Records], T]:
    """A job of which all is done, or nothing."""

    def whole(records: Records) -> T:
        with records.together():
            return job(records)

    return whole


def _result(job: Callable[[Records], Any], records: Records) -> Any:
    try:
        return job(records)
    except HoldfastError as error:
        return error
    except (sqlite3.OperationalError, sqlite3.InternalError):  # a full disk takes the whole transaction with it
        raise
    except Exception as error:
        _log.exception("a job of the records failed")
        return error


def _answer(answers: list[Callable[[Any], None]], results: list[Any]) -> None:
    for answer, result in zip(answers, results, strict=True):
        answer(result)
