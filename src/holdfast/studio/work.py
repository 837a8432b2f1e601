"""Work beside the page: quick work, of which only the newest counts, and long work that newer requests cancel."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

Task = Callable[[], None]
Complain = Callable[[BaseException], None]
TICK = 1 / 30  # s between two pictures of what moves by itself


class Cancelled(Exception):
    """A newer request has come; raised inside the older one."""


class Latest:
    """One thread that does what was asked last: of requests with the same key only the newest is done.

    So that an end effector that is dragged faster than pictures can be made is always where the mouse is, and not where it was.

    Args:
        complain: Told of every exception of a request; the thread continues.
    """

    def __init__(self, complain: Complain) -> None:
        self._complain = complain
        self._waiting: dict[Any, Task] = {}
        self._changed = threading.Condition()
        self._busy = self._stopped = False
        self._thread = threading.Thread(target=self._run, daemon=True, name="studio live")
        self._thread.start()

    def put(self, key: Any, task: Task) -> None:
        """Ask for something; a request with the same key that still waits is forgotten."""
        with self._changed:
            self._waiting.pop(key, None)
            self._waiting[key] = task
            self._changed.notify_all()

    def settle(self, seconds: float) -> bool:
        """Wait until all work is done; False if that took too long."""
        with self._changed:
            return self._changed.wait_for(lambda: not self._waiting and not self._busy, seconds)

    def stop(self) -> None:
        """End the thread after the present request."""
        with self._changed:
            self._stopped = True
            self._waiting.clear()
            self._changed.notify_all()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._busy = False
                self._changed.notify_all()
                self._changed.wait_for(lambda: bool(self._waiting) or self._stopped)
                if self._stopped:
                    return
                key = next(iter(self._waiting))
                task, self._busy = self._waiting.pop(key), True
            try:
                task()
            except BaseException as error:
                self._complain(error)


class Clock:
    """Repeats one thing on a :class:`Latest`, until it is stopped.

    Args:
        live: Where it is done.
        period: s from one time to the next.
    """

    def __init__(self, live: Latest, period: float) -> None:
        self._live, self._period = live, period
        self._ended: threading.Event | None = None

    def start(self, action: Task) -> None:
        """Do this from now on, and nothing else."""
        self.stop()
        ended = self._ended = threading.Event()

        def beat() -> None:
            while not ended.wait(self._period):
                self._live.put("tick", lambda: None if ended.is_set() else action())

        threading.Thread(target=beat, daemon=True, name="studio clock").start()

    def stop(self) -> None:
        """Do nothing more."""
        if self._ended is not None:
            self._ended.set()
            self._ended = None


class Worker:
    """One thread for long computations: the newest request cancels the one that is under way.

    Args:
        complain: Told of every exception of a request that was not cancelled.
    """

    def __init__(self, complain: Complain) -> None:
        self._complain = complain
        self._changed = threading.Condition()
        self._next: tuple[int, Callable[[Callable[[], None]], None]] | None = None
        self._newest = 0
        self._running = False
        self._stopped = False
        self._thread = threading.Thread(target=self._run, daemon=True, name="studio work")
        self._thread.start()

    def ask(self, job: Callable[[Callable[[], None]], None]) -> None:
        """Start ``job(check)`` as soon as the one under way gives up; ``check()`` raises once a newer one is asked for."""
        with self._changed:
            self._newest += 1
            self._next = (self._newest, job)
            self._changed.notify_all()

    def cancel(self) -> None:
        """Give up what is under way or waits."""
        with self._changed:
            self._newest += 1
            self._next = None

    @property
    def busy(self) -> bool:
        """True while a request is under way or waits."""
        with self._changed:
            return self._running or self._next is not None

    def settle(self, seconds: float) -> bool:
        """Wait until all work is done; False if that took too long."""
        with self._changed:
            return self._changed.wait_for(lambda: self._next is None and not self._running, seconds)

    def stop(self) -> None:
        """Give up everything and end the thread."""
        with self._changed:
            self._newest += 1
            self._next, self._stopped = None, True
            self._changed.notify_all()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._running = False
                self._changed.notify_all()
                self._changed.wait_for(lambda: self._next is not None or self._stopped)
                if self._stopped or self._next is None:
                    return
                (number, job), self._next, self._running = self._next, None, True

            def check(number: int = number) -> None:
                if number != self._newest:
                    raise Cancelled

            try:
                job(check)
            except Cancelled:
                pass
            except BaseException as error:
                if number == self._newest:
                    self._complain(error)
