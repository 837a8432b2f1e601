"""Threads for quick work, of which only the newest request is executed, and for long work, which newer requests cancel."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

Task = Callable[[], None]
Complain = Callable[[BaseException], None]
TICK_S = 1 / 30  # period of animations, s


class Cancelled(Exception):
    """Raised inside a request that a newer request has replaced."""


class LatestRequests:
    """Thread that executes the latest requests: of several requests with the same key only the newest is executed.

    An end effector that is dragged faster than pictures can be made is therefore shown at the present mouse position.

    Args:
        on_error: Function that is called with every exception of a request; the thread continues.
    """

    def __init__(self, on_error: Complain) -> None:
        self._on_error = on_error
        self._pending: dict[Any, Task] = {}
        self._changed = threading.Condition()
        self._busy = self._stopped = False
        self._thread = threading.Thread(target=self._run_requests, daemon=True, name="studio live")
        self._thread.start()

    def submit(self, key: Any, task: Task) -> None:
        """Submit a request; a waiting request with the same key is dropped."""
        with self._changed:
            self._pending.pop(key, None)
            self._pending[key] = task
            self._changed.notify_all()

    def wait_until_done(self, seconds: float) -> bool:
        """Wait until all work is done; return False if the time runs out."""
        with self._changed:
            return self._changed.wait_for(lambda: not self._pending and not self._busy, seconds)

    def stop(self) -> None:
        """Stop the thread after the present request."""
        with self._changed:
            self._stopped = True
            self._pending.clear()
            self._changed.notify_all()

    def _run_requests(self) -> None:
        while True:
            with self._changed:
                self._busy = False
                self._changed.notify_all()
                self._changed.wait_for(lambda: bool(self._pending) or self._stopped)
                if self._stopped:
                    return
                key = next(iter(self._pending))
                task, self._busy = self._pending.pop(key), True
            try:
                task()
            except BaseException as error:
                self._on_error(error)


class Clock:
    """Repeats one action on a :class:`LatestRequests` until it is stopped.

    Args:
        live: Thread that executes the action.
        period: Time between two executions, s.
    """

    def __init__(self, live: LatestRequests, period: float) -> None:
        self._live, self._period = live, period
        self._ended: threading.Event | None = None

    def start(self, action: Task) -> None:
        """Repeat this action from now on, instead of an earlier one."""
        self.stop()
        ended = self._ended = threading.Event()

        def submit_ticks() -> None:
            while not ended.wait(self._period):
                self._live.submit("tick", lambda: None if ended.is_set() else action())

        threading.Thread(target=submit_ticks, daemon=True, name="studio clock").start()

    def stop(self) -> None:
        """Stop the repetition."""
        if self._ended is not None:
            self._ended.set()
            self._ended = None


class LongJobWorker:
    """Thread for long computations; the newest request cancels the running one.

    Args:
        on_error: Function that is called with every exception of a request that was not cancelled.
    """

    def __init__(self, on_error: Complain) -> None:
        self._on_error = on_error
        self._changed = threading.Condition()
        self._next: tuple[int, Callable[[Callable[[], None]], None]] | None = None
        self._newest = 0
        self._running = False
        self._stopped = False
        self._thread = threading.Thread(target=self._run_jobs, daemon=True, name="studio work")
        self._thread.start()

    def submit(self, job: Callable[[Callable[[], None]], None]) -> None:
        """Start ``job(check)`` as soon as the running one stops; ``check()`` raises after a newer request."""
        with self._changed:
            self._newest += 1
            self._next = (self._newest, job)
            self._changed.notify_all()

    def cancel(self) -> None:
        """Cancel the running and the waiting request."""
        with self._changed:
            self._newest += 1
            self._next = None

    @property
    def is_busy(self) -> bool:
        """True while a request is running or waiting."""
        with self._changed:
            return self._running or self._next is not None

    def wait_until_done(self, seconds: float) -> bool:
        """Wait until all work is done; return False if the time runs out."""
        with self._changed:
            return self._changed.wait_for(lambda: self._next is None and not self._running, seconds)

    def stop(self) -> None:
        """Cancel all requests and stop the thread."""
        with self._changed:
            self._newest += 1
            self._next, self._stopped = None, True
            self._changed.notify_all()

    def _run_jobs(self) -> None:
        while True:
            with self._changed:
                self._running = False
                self._changed.notify_all()
                self._changed.wait_for(lambda: self._next is not None or self._stopped)
                if self._stopped or self._next is None:
                    return
                (number, job), self._next, self._running = self._next, None, True

            def check_newest(number: int = number) -> None:
                if number != self._newest:
                    raise Cancelled

            try:
                job(check_newest)
            except Cancelled:
                pass
            except BaseException as error:
                if number == self._newest:
                    self._on_error(error)
