"""Machine code of a program: first code that compiles quickly, then faster code once enough rows make it worthwhile.

Both compute the same bits, so a result does not depend on which of them computed a row.
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

from holdfast.core import progress
from holdfast.core.caching import cached_property
from holdfast.core.typing import FloatArray
from holdfast.kernels import cache
from holdfast.kernels.llvm import machine_code
from holdfast.kernels.llvm.arithmetic import TargetMachine
from holdfast.kernels.program import Program
from holdfast.kernels.threads import in_pool

MAX_IMMEDIATE_OPERATIONS = 100  # operations that level 1 compiles in about 15 ms, hardly longer than level 0
MAX_TWO_REGISTER_OPERATIONS = 6000  # operations up to which level 1 handles two registers of rows; larger programs do not fit
MAX_WAITED_OPERATIONS = 40_000  # operations up to which a caller waits for level 1
MAX_COMPILED_OPERATIONS = (
    100_000  # operations: larger programs take minutes on level 1 (measured: 6 s of 74,000, not done after 250 s of 582,000)
)
# Rows after which level 1 is compiled. Its compilation pays after 1,200,000 to 5,000,000 rows (measured: steps of an ascent, of
# a closed loop, of a control cycle). With this lower limit a long batch takes little longer than with code compiled in advance,
# and a short one wastes nothing. Short programs need more (1,700 operations: 7,000,000 rows; 900: 10,000,000) if it ever pays.
REPAYING_WORK = 750_000
SHORT_PROGRAM_OPERATIONS = 2000
REPAYING_WORK_OF_SHORT = 5_000_000

_coming: ContextVar[int] = ContextVar("coming", default=0)


@contextlib.contextmanager
def expect_row_count(rows: int) -> Iterator[None]:
    """Context in which new kernels of this thread expect this number of rows; if level 1 pays, it is compiled at once."""
    before = _coming.set(rows)
    try:
        yield
    finally:
        _coming.reset(before)


class CompiledProgram:
    """Program as a compiled function over columns.

    Args:
        program: Program to compile.

    Attributes:
        level: Optimisation level of the code in use.
        lanes: Column widths are multiples of this number.
    """

    def __init__(self, program: Program) -> None:
        self._program, self._rows = program, 0
        self.lanes = self._lanes_of_level(1)
        stored_code = self._load_code(1)
        if stored_code is None and (
            program.size <= MAX_IMMEDIATE_OPERATIONS
            or os.environ.get("HOLDFAST_LEVEL") == "1"
            or self._is_compilation_worthwhile(_coming.get())
        ):
            stored_code = self._compile_code(1)
        self.level = 0 if stored_code is None else 1
        self._code = stored_code or self._load_code(0) or self._compile_code(0)

    def bind_arrays(self, inputs: FloatArray, outputs: FloatArray, used_width: int | None = None) -> Callable[[], None]:
        """Return a function that evaluates ``inputs (n_in, W)`` into ``outputs (n_out, W)``, both contiguous, W a multiple of
        lanes.

        Args:
            inputs: Array that each call reads.
            outputs: Array that each call overwrites.
            used_width: Number of leading columns to evaluate, a multiple of the lanes; default: all.
        """
        width = inputs.shape[1] if used_width is None else used_width
        # Made once, because ctypes takes longer to convert four numbers than a step of few rows takes.
        addresses = c_void_p(inputs.ctypes.data), c_void_p(outputs.ctypes.data)
        arguments: tuple[Any, ...] = (*addresses, c_int64(inputs.shape[1]), c_int64(width))

        def evaluate_bound(arrays: tuple[FloatArray, FloatArray] = (inputs, outputs)) -> None:
            code = self._code  # may be replaced meanwhile, and lives as long as it is referenced
            code.call(*arguments)
            if not self.level:
                self._count_evaluated_rows(width)

        return evaluate_bound

    @cached_property
    def single_row_code(self) -> machine_code.MachineCode:
        """Code for a single row, for control loops; it computes the same bits."""
        level = int(self._program.size <= MAX_WAITED_OPERATIONS)
        return self._load_code(level, 1) or self._compile_code(level, 1)

    # ---- levels ------------------------------------------------------------------------------------------------

    def _count_evaluated_rows(self, rows: int) -> None:
        self._rows += rows
        if self._is_compilation_worthwhile(self._rows):
            self._rows = -(1 << 62)  # so that the compilation is requested only once
            if in_pool() and _busy.acquire(blocking=False):
                # While every processor is busy, a compiling thread would only delay the others, which run on level 0.
                try:
                    self._replace_by_optimized_code()
                finally:
                    _busy.release()
            else:
                _submit_job(self._replace_by_optimized_code)

    def _is_compilation_worthwhile(self, rows: int) -> bool:
        return (
            rows >= (REPAYING_WORK_OF_SHORT if self._program.size < SHORT_PROGRAM_OPERATIONS else REPAYING_WORK)
            and self._program.size <= MAX_COMPILED_OPERATIONS
        )

    def _replace_by_optimized_code(self) -> None:
        self._code, self.level = self._load_code(1) or self._compile_code(1, in_background=True), 1

    def _lanes_of_level(self, level: int) -> int:
        lanes = machine_code.detect_processor().machine.lanes
        return lanes if level and self._program.size <= MAX_TWO_REGISTER_OPERATIONS else min(lanes, 8)

    def _code_key(self, level: int, lanes: int) -> str:
        return cache.cache_key(self._program.digest, level, lanes)

    def _load_code(self, level: int, lanes: int | None = None) -> machine_code.MachineCode | None:
        data = cache.load_entry(self._code_key(level, lanes or self._lanes_of_level(level)))
        return None if data is None else machine_code.MachineCode(data)

    def _compile_code(self, level: int, lanes: int | None = None, in_background: bool = False) -> machine_code.MachineCode:
        lanes = lanes or self._lanes_of_level(level)
        program, machine = self._program, TargetMachine(lanes, machine_code.detect_processor().machine.fused)
        with progress.long_task(
            f"compiling '{program.name}'",
            0 if in_background else program.size * machine_code.COMPILE_SECONDS_PER_OPERATION[level],
        ):
            data = machine_code.compile_program(program, level, machine)
        cache.store_entry(self._code_key(level, lanes), data)
        return machine_code.MachineCode(data)


_jobs: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
_worker: threading.Thread | None = None
_busy = threading.RLock()  # held during compilation, during a fork, and from the end of the program, when it may still fork
_fork = contextlib.ExitStack()  # locks of LLVM that the current fork holds


def _submit_job(task: Callable[[], None]) -> None:
    global _worker
    _jobs.put(task)
    if _worker is None or not _worker.is_alive():
        _worker = threading.Thread(target=_run_jobs, name="holdfast-compiler", daemon=True)
        _worker.start()


def _run_jobs() -> None:
    while True:
        task = _jobs.get()
        with _busy:
            try:
                task()
            except Exception:  # reported as threads report errors; then the next job runs, and waiting callers return
                args = (*sys.exc_info(), threading.current_thread())
                threading.excepthook(threading.ExceptHookArgs(args))


def wait_for_compiler() -> None:
    """Wait until no program is being compiled in the background, for measurements."""
    done = threading.Event()
    if _worker is not None and _worker.is_alive():
        _jobs.put(done.set)
        done.wait()


def _lock_compiler_before_fork() -> None:
    """Wait before a fork, because a child process cannot release the locks of CasADi and LLVM.

    The order matters, because a running job needs LLVM until it ends.
    """
    _busy.acquire()
    _fork.enter_context(machine_code.llvm_lock())


def _unlock_compiler_after_fork() -> None:
    _fork.close()
    _busy.release()


def _after_fork_in_child() -> None:
    """Reset the compiler in a child process, which has no compiler thread; waiting programs stay on level 0."""
    global _worker, _jobs, _busy
    _fork.close()
    _worker, _jobs, _busy = None, queue.SimpleQueue(), threading.RLock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(
        before=_lock_compiler_before_fork, after_in_parent=_unlock_compiler_after_fork, after_in_child=_after_fork_in_child
    )


@atexit.register
def _stop_compiler() -> None:
    """Stop the compiler before the interpreter ends and drop waiting programs."""
    with contextlib.suppress(KeyboardInterrupt):
        _busy.acquire()
