"""The machine code of a program: quickly made code at once, better code once enough rows have come to repay it.

Both give the same bits, so that nobody needs to know which of them computed a row.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import queue
import sys
import threading
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from ctypes import c_int64, c_void_p
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast import notice
from holdfast.caching import cached_property
from holdfast.kernels import cache
from holdfast.kernels.llvm import machine_code
from holdfast.kernels.llvm.arithmetic import Machine
from holdfast.kernels.program import Program
from holdfast.kernels.threads import in_pool

Array = NDArray[np.float64]

AT_ONCE = 100  # operations that level 1 compiles in some 15 ms, hardly longer than level 0
WIDE = 5000  # operations up to which level 1 handles two registers of rows; more of them do not fit
LONG = 40_000  # operations: nobody waits for level 1 of more
VAST = 100_000  # operations: level 1 of more takes minutes (measured: 6 s of 74,000, not done after 250 s of 582,000)
# Rows after which level 1 is compiled. It repays that after 1,200,000 to 5,000,000 (measured: steps of an ascent, of a closed
# loop, of a control cycle); well below, a long batch takes little longer than if it had been compiled beforehand, and a short
# one wastes nothing. Of short programs it repays later (1,700 operations: after 7,000,000; 900: after 10,000,000), if ever.
WORTH, SHORT, WORTH_SHORT = 750_000, 2000, 5_000_000

_coming: ContextVar[int] = ContextVar("coming", default=0)


@contextlib.contextmanager
def expecting(rows: int) -> Iterator[None]:
    """Kernels that this thread makes inside will be given about so many rows: where better code repays, it is made at once."""
    before = _coming.set(rows)
    try:
        yield
    finally:
        _coming.reset(before)


class Compiled:
    """A program as a function over columns.

    Args:
        program: What to compute.

    Attributes:
        level: Of the code in use.
        lanes: Widths of columns are multiples of this.
    """

    def __init__(self, program: Program) -> None:
        self._program, self._rows = program, 0
        self.lanes = self._lanes(1)
        best = self._stored(1)
        if best is None and (program.size <= AT_ONCE or os.environ.get("HOLDFAST_LEVEL") == "1" or self._repays(_coming.get())):
            best = self._make(1)
        self.level = 0 if best is None else 1
        self._code = best or self._stored(0) or self._make(0)

    def bound(self, inputs: Array, outputs: Array, used: int | None = None) -> Callable[[], None]:
        """What evaluates ``inputs (n_in, W)`` into ``outputs (n_out, W)``: contiguous, W a multiple of the lanes.

        Args:
            inputs: Read at each call.
            outputs: Overwritten.
            used: A multiple of the lanes: only so many of the columns, the first ones.
        """
        width = inputs.shape[1] if used is None else used
        # Made once: a step of few rows takes less than ctypes takes to convert four numbers.
        at = c_void_p(inputs.ctypes.data), c_void_p(outputs.ctypes.data)
        given: tuple[Any, ...] = (*at, c_int64(inputs.shape[1]), c_int64(width))

        def call(kept: tuple[Array, Array] = (inputs, outputs)) -> None:
            code = self._code  # it may be replaced meanwhile, and lives as long as somebody has it
            code.call(*given)
            if not self.level:
                self._count(width)

        return call

    @cached_property
    def one(self) -> machine_code.Code:
        """The code for a single row: for loops that control. The same bits again."""
        level = int(self._program.size <= LONG)
        return self._stored(level, 1) or self._make(level, 1)

    # ---- levels ------------------------------------------------------------------------------------------------

    def _count(self, rows: int) -> None:
        self._rows += rows
        if self._repays(self._rows):
            self._rows = -(1 << 62)  # asked once
            if in_pool() and _busy.acquire(blocking=False):
                # Every processor is busy: beside one thread more, the others would only be longer on level 0.
                try:
                    self._improve()
                finally:
                    _busy.release()
            else:
                _in_background(self._improve)

    def _repays(self, rows: int) -> bool:
        return rows >= (WORTH_SHORT if self._program.size < SHORT else WORTH) and self._program.size <= VAST

    def _improve(self) -> None:
        self._code, self.level = self._stored(1) or self._make(1, aside=True), 1

    def _lanes(self, level: int) -> int:
        lanes = machine_code.host().machine.lanes
        return lanes if level and self._program.size <= WIDE else min(lanes, 8)

    def _key(self, level: int, lanes: int) -> str:
        return cache.key(self._program.digest, level, lanes)

    def _stored(self, level: int, lanes: int | None = None) -> machine_code.Code | None:
        data = cache.load(self._key(level, lanes or self._lanes(level)))
        return None if data is None else machine_code.Code(data)

    def _make(self, level: int, lanes: int | None = None, aside: bool = False) -> machine_code.Code:
        lanes = lanes or self._lanes(level)
        program, machine = self._program, Machine(lanes, machine_code.host().machine.fused)
        with notice.long(f"compiling '{program.name}'", 0 if aside else program.size * machine_code.COMPILING[level]):
            data = machine_code.compile_program(program, level, machine)
        cache.store(self._key(level, lanes), data)
        return machine_code.Code(data)


_jobs: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
_worker: threading.Thread | None = None
_busy = threading.RLock()  # held while code improves, in a fork, and from the end of the program on, when it may still fork
_fork = contextlib.ExitStack()  # what the fork under way holds of LLVM


def _in_background(job: Callable[[], None]) -> None:
    global _worker
    _jobs.put(job)
    if _worker is None or not _worker.is_alive():
        _worker = threading.Thread(target=_work, name="holdfast-compiler", daemon=True)
        _worker.start()


def _work() -> None:
    while True:
        job = _jobs.get()
        with _busy:
            try:
                job()
            except Exception:  # said as threads say it; the next job is done, and who waits for all of them is told
                args = (*sys.exc_info(), threading.current_thread())
                threading.excepthook(threading.ExceptHookArgs(args))


def settle() -> None:
    """Wait until nothing is being compiled in the background: for measurements."""
    done = threading.Event()
    if _worker is not None and _worker.is_alive():
        _jobs.put(done.set)
        done.wait()


def _hold() -> None:
    """Before a fork: CasADi, which a job may use, has locks that a child process cannot open, as has LLVM.

    In this order: a job that runs needs LLVM to end.
    """
    _busy.acquire()
    _fork.enter_context(machine_code.lock())


def _go_on() -> None:
    _fork.close()
    _busy.release()


def _forget() -> None:
    """In a child process: its compiler thread is gone, and what waited for it stays at level 0."""
    global _worker, _jobs, _busy
    _fork.close()
    _worker, _jobs, _busy = None, queue.SimpleQueue(), threading.RLock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(before=_hold, after_in_parent=_go_on, after_in_child=_forget)


@atexit.register
def _stop() -> None:
    """LLVM must not be taken down while it compiles; what only waits is dropped."""
    with contextlib.suppress(KeyboardInterrupt):
        _busy.acquire()
