"""Jobs of a search, one after the other or in several processes, with what is done kept on the disk."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context, parent_process
from multiprocessing.connection import wait as wait_for
from threading import Thread
from time import monotonic
from typing import Any, Protocol

import numpy as np

from holdfast.certificates.tree import SearchState, Tell
from holdfast.engine.memory import Memory, Parts
from holdfast.errors import HoldfastError
from holdfast.notice import aside

_BEGIN = 4  # of the time limit, to begin with
_SLICE = 2.0  # s on a part, then on the next, so that a search that is stopped has something of each
_OFTEN = 0.2  # s between looks at what other processes tell
Stop = Callable[[], bool]


class Found(Protocol):
    """What a job found."""

    @property
    def finished(self) -> bool:
        """Whether nothing is open, but for what is left to others."""

    @property
    def state(self) -> SearchState:
        """What of it is proved and undecided, itself: what it leaves to other jobs is neither."""

    def stored(self) -> Parts:
        """As a memory keeps it."""

    def need_room(self) -> None:
        """Refuse what would take too many cells."""


class Running(Protocol):
    """A job at work."""

    @property
    def job(self) -> Job:
        """Which."""

    @property
    def finished(self) -> bool:
        """Whether nothing is open, but for what is left to others."""

    @property
    def state(self) -> SearchState:
        """How far it is."""

    def run(self, until: float, stop: Stop, tell: Callable[[], None]) -> None:
        """On with it until it is time (``monotonic``), or to stop."""

    def found(self) -> Found:
        """What is found so far."""


class Job(Protocol):
    """A piece of a search. What it finds depends on it alone: not on processes, nor on what was found before."""

    @property
    def name(self) -> str:
        """For a memory."""

    @property
    def share(self) -> float:
        """Of its part, that its states are about."""

    def begun(self, until: float) -> Running:
        """At work, with time ``until`` (``monotonic``) to begin."""

    def nothing(self) -> Found:
        """What is found if nobody looks."""

    def read(self, stored: Parts) -> Found:
        """What was stored; only what is finished is."""

    def parted(self, found: Any) -> Sequence[Job]:
        """The jobs that it leaves to others."""

    def joined(self, found: Any, parts: Sequence[Any]) -> Any:
        """What it found, with what these found."""


@dataclass(frozen=True, kw_only=True)
class Effort:
    """How long, where and for whom one searches.

    Attributes:
        end: Until when (``monotonic``).
        stop: Asked now and then; once it says True the rest is left.
        tell: Is told how far all is.
        workers: Processes.
        memory: Of a folder, or None.
    """

    end: float = np.inf
    stop: Stop = lambda: False
    tell: Tell = lambda now: None
    workers: int = 1
    memory: Memory | None = None

    def found(self, jobs: Sequence[Job], most: float = np.inf) -> list[Any]:
        """Of each job, and those that it leaves to others, what is found; ends after so many cells that were looked at."""
        crew = Crew(jobs, memory=self.memory, tell=self.tell)

        def stop() -> bool:
            return crew.nodes > most or self.stop()

        if self.workers == 1:
            crew.alone(self.end, stop)
        else:
            crew.together(self.workers, self.end, stop)
        return [crew.found(job) for job in jobs]


class Crew:
    """The jobs of a search, and what is known of them.

    Args:
        jobs: One for each part of it; they may leave some of it to others.
        memory: Of a folder, or None.
        tell: Is told how far all is.

    Attributes:
        nodes: Cells that were looked at.
    """

    def __init__(self, jobs: Sequence[Job], *, memory: Memory | None = None, tell: Tell) -> None:
        self._tell, self._memory, self._count = tell, memory, len(jobs)
        self._found, self._states = dict[str, Found](), dict[str, tuple[float, SearchState]]()
        self._open, self.nodes, self._warned = list[Job](), 0, set[str]()
        for job in jobs:
            self._take(job)

    def _take(self, job: Job) -> None:
        """To be done, unless it is remembered."""
        known = None if self._memory is None else self._memory.known(job.name)
        if known is None:
            self._open.append(job)
        else:
            self._keep(job, job.read(known))

    def _keep(self, job: Job, found: Found) -> None:
        """What a job found, and the jobs that it leaves."""
        self._found[job.name] = found
        if self._memory is not None and found.finished and self._memory.known(job.name) is None:
            self._memory.keep(job.name, found.stored())
        self._hear(job, found.state)
        for one in job.parted(found):
            self._take(one)

    def _hear_of(self, running: Running) -> None:
        self._hear(running.job, running.state)

    def _hear(self, job: Job, state: SearchState) -> None:
        self._states[job.name] = job.share, state
        if state.warning and state.warning not in self._warned:
            self._warned.add(state.warning)
            aside(state.warning)
        parts = ("proved", "refuted", "undecided")
        states = self._states.values()
        shares = {key: sum(share * getattr(s, key) for share, s in states) / self._count for key in parts}
        self.nodes = sum(s.nodes for _, s in states)
        self._tell(SearchState(**shares, open=max(1 - sum(shares.values()), 0.0), nodes=self.nodes))

    def found(self, job: Job) -> Any:
        """Of a job and those that it leaves; what was not looked at is undecided."""
        one = self._found.get(job.name)
        return job.nothing() if one is None else job.joined(one, [self.found(part) for part in job.parted(one)])

    def alone(self, end: float, stop: Stop) -> None:
        """In this process, until a time (``monotonic``) or ``stop``."""
        ready, running = monotonic() + (end - monotonic()) / _BEGIN, list[Running]()
        jobs, self._open = self._open, []
        for left, job in zip(range(len(jobs), 0, -1), jobs, strict=True):
            now = monotonic()
            begun = job.begun(now if stop() else now + (ready - now) / left)
            begun.found().need_room()
            self._hear_of(begun)
            if begun.finished:
                self._keep(job, begun.found())
            else:
                running.append(begun)
        # What is remembered is done one after the other, so that a search that is killed has something to resume from.
        turn = np.inf if self._memory is not None and np.isinf(end) else _SLICE
        while (running or self._open) and monotonic() < end and not stop():
            waiting, self._open = self._open, []
            turns: list[Callable[[float], Running]] = [
                *(partial(_same, one) for one in running),
                *(job.begun for job in waiting),
            ]
            running = []
            for left, given in zip(range(len(turns), 0, -1), turns, strict=True):
                now = monotonic()
                share = (end - now) / left
                work = given(now + share / 2)  # beginnings are whole unless time is short: what they find counts
                work.run(min(now + share, monotonic() + turn), stop, partial(self._hear_of, work))
                if work.finished:
                    self._keep(work.job, work.found())
                else:
                    running.append(work)
        for one in running:
            self._keep(one.job, one.found())

    def together(self, workers: int, end: float, stop: Stop) -> None:
        """In so many other processes, likewise.

        Raises:
            InputError: A part would take too many cells.
            HoldfastError: A process ended, perhaps for want of memory.
        """
        context = get_context("spawn")
        news, halt = context.SimpleQueue(), context.Event()
        names = dict[str, Job]()
        with ProcessPoolExecutor(workers, context, _begin, (news, halt)) as pool:
            working = dict[Future[Found], Job]()
            try:
                while self._open or working:
                    while self._open and len(working) < workers and not halt.is_set():
                        now, job = monotonic(), self._open.pop(0)
                        until = min(end, now + (end - now) * workers / (1 + len(self._open)))
                        names[job.name], working[pool.submit(_done, job, until)] = job, job
                    if stop() or monotonic() > end:
                        halt.set()
                        self._open.clear()
                    for done in wait(working, _OFTEN, FIRST_COMPLETED).done:
                        found = done.result()
                        found.need_room()
                        self._keep(working.pop(done), found)
                    while not news.empty():
                        name, state = news.get()
                        if name not in self._found:
                            self._hear(names[name], state)
            except BrokenProcessPool as error:
                raise HoldfastError(
                    "a process of the search ended, perhaps for want of memory; what is done is kept with a store, and fewer "
                    "workers need less"
                ) from error
            finally:
                halt.set()


def _same(running: Running, until: float) -> Running:
    return running


# ---- in the other processes ----------------------------------------------------------------------------------------------

_here: dict[str, Any] = {}


def _begin(news: Any, halt: Any) -> None:
    """A process that leaves Ctrl-C to the one that began it, and ends with that one, however it ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _here.update(news=news, halt=halt)
    above = parent_process()
    if above is not None:

        def follow() -> None:
            wait_for([above.sentinel])
            os._exit(1)

        Thread(target=follow, daemon=True).start()


def _done(job: Job, until: float) -> Found:
    running, told = job.begun(until), [monotonic()]

    def tell() -> None:
        if monotonic() > told[0] + _OFTEN:
            told[0] = monotonic()
            _here["news"].put((job.name, running.state))

    if not running.finished:
        running.run(until, _here["halt"].is_set, tell)
    return running.found()
