"""Jobs of a search, one after the other or in several processes, with what is done kept on the disk."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from functools import partial
from multiprocessing import get_context, parent_process
from multiprocessing.connection import wait as wait_for
from threading import Thread
from time import monotonic
from typing import Any

import numpy as np

from holdfast.certificates.claims import ReachClaim
from holdfast.certificates.target_boxes.jobs import Found, Job, Running, joined
from holdfast.certificates.tree import SearchState, Tell
from holdfast.engine.memory import Memory
from holdfast.errors import HoldfastError

_BEGIN = 4  # of the time limit, to begin with
_SLICE = 2.0  # s on a part, then on the next, so that a search that is stopped has something of each
_OFTEN = 0.2  # s between looks at what other processes tell
Stop = Callable[[], bool]


class Crew:
    """The jobs of some claims, and what is known of them.

    Args:
        claims: The parts.
        halvings: Of each axis, at most.
        seed: Of all random draws.
        memory: Of a folder, or None.
        tell: Is told how far all is.
    """

    def __init__(
        self, claims: Sequence[ReachClaim], halvings: int, seed: int, *, memory: Memory | None = None, tell: Tell
    ) -> None:
        self._tell, self._memory = tell, memory
        self._whole = [Job(claim, halvings, seed, part) for part, claim in enumerate(claims)]
        self._found, self._states = dict[str, Found](), dict[str, tuple[float, SearchState]]()
        self._open = list[Job]()
        for job in self._whole:
            self._take(job)

    def _take(self, job: Job) -> None:
        """To be done, unless it is remembered."""
        known = None if self._memory is None else self._memory.known(job.name)
        if known is None:
            self._open.append(job)
        else:
            self._keep(job, Found.read(known))

    def _keep(self, job: Job, found: Found) -> None:
        """What a job has come to; one that was cut makes others."""
        self._found[job.name] = found
        if self._memory is not None and found.finished and self._memory.known(job.name) is None:
            self._memory.keep(job.name, found.stored())
        if found.cut:
            for one in job.parted(found.cut):
                self._take(one)
        else:
            self._hear(job, found.state)

    def _hear_of(self, running: Running) -> None:
        self._hear(running.job, running.state)

    def _hear(self, job: Job, state: SearchState) -> None:
        self._states[job.name] = job.share, state
        shares = np.array([[share * s.proved, share * s.undecided, s.nodes] for share, s in self._states.values()])
        proved, undecided, nodes = shares.sum(axis=0)
        parts = len(self._whole)
        left = max(1 - (proved + undecided) / parts, 0.0)
        self._tell(SearchState(proved=proved / parts, undecided=undecided / parts, open=left, nodes=int(nodes)))

    def found(self) -> list[Found]:
        """Of each part; what was not looked at is undecided."""
        parts = list[Found]()
        for job in self._whole:
            one = self._found.get(job.name, _nothing(job))
            boxes = job.parted(one.cut) if one.cut else [job]
            parts.append(joined([self._found.get(box.name, _nothing(job)) for box in boxes], one.cut))
        return parts

    def alone(self, end: float, stop: Stop) -> None:
        """In this process, until a time (``monotonic``) or ``stop``."""
        ready, running = monotonic() + (end - monotonic()) / _BEGIN, list[Running]()
        jobs, self._open = self._open, []
        for left, job in zip(range(len(jobs), 0, -1), jobs, strict=True):
            now = monotonic()
            begun = job.begun(now if stop() else now + (ready - now) / left)
            begun.found().need_room()
            if begun.finished:
                self._keep(job, begun.found())
            else:
                running.append(begun)
        # What is remembered is done one after the other, so that a search that is killed has something to resume from.
        turn = np.inf if self._memory is not None and np.isinf(end) else _SLICE
        while (running or self._open) and monotonic() < end and not stop():
            waiting, self._open = self._open, []
            turns: list[Running | Job] = [*running, *waiting]
            for left, one in zip(range(len(turns), 0, -1), turns, strict=True):
                now = monotonic()
                until = now + min((end - now) / left, turn)
                work = one.begun(until) if isinstance(one, Job) else one
                work.run(until, stop, partial(self._hear_of, work))
                if isinstance(one, Job):
                    running.append(work)
                if work.finished:
                    self._keep(work.job, work.found())
            running = [one for one in running if not one.finished]
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


def _nothing(job: Job) -> Found:
    return Found(b"\2", np.empty((0, job.claim.arm.n), dtype=np.int64), 0, False, 0.0)


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

    if not running.finished and not running.found().too_many:
        running.run(until, _here["halt"].is_set, tell)
    return running.found()
