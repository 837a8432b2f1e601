"""Step kernel repeated until each row is finished, the only iteration over a batch in holdfast."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.core.progress import ProgressCount, ignore_count
from holdfast.core.typing import FloatArray
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.threads import in_pool, shared_pool, thread_count

Tell = Callable[[int], None]

_WORKER_BYTES = 1 << 19  # of the state, parameters and results that one worker iterates on: they stay in its cache
_MAX_WORKER_ROWS = 4096  # rows of that
_MIN_WORKER_ROWS = 256  # no result depends on it
_STEPS_PER_REPORT = 1000  # steps after which somebody is told of them
_UNREACHED_STEP = 1 << 62  # when a row comes that is not there


@dataclass(frozen=True, kw_only=True)
class LoopResult:
    """Final states of the rows of a loop.

    Attributes:
        state: (N, s) the state at which the residual was last measured.
        residual: (N,) that residual; at most the tolerance where ``done``.
        done: (N,) the tolerance was reached.
        steps: (N,) number of steps taken.
    """

    state: FloatArray
    residual: FloatArray
    done: NDArray[np.bool_]
    steps: NDArray[np.int64]


class Loop:
    """Step ``state -> next state`` with a residual, repeated row by row until the residual is small.

    Rows that are done leave the batch and others take their place, and each row's result is the one it had at that moment:
    results do not depend on the other rows, on their order or on threads.

    Args:
        name: For messages.
        state: (s,) symbol.
        parameters: Symbols that stay constant while a row iterates.
        next_state: (s,) expression.
        residual: Scalar expression of the present state, not negative; NaN never ends a row.
        backend: As for :class:`Kernel`.
        ahead: The residual is that of the next state, so that a row which converges needs no further step to notice.
        times: How many steps of the caller's one step of the loop takes; only kept for the caller.

    Attributes:
        size: Numbers in a state.
        step: The kernel ``(state, parameters) -> (next state, residual)``.
    """

    def __init__(
        self,
        name: str,
        state: SX,
        parameters: Sequence[SX],
        *,
        next_state: SX,
        residual: SX,
        backend: str | None = None,
        ahead: bool = False,
        times: int = 1,
    ) -> None:
        self._set_step(Kernel(name, [state, *parameters], [ca.vertcat(next_state, residual)], backend=backend), ahead, times)

    @classmethod
    def from_step(cls, step: Kernel, ahead: bool, times: int) -> Loop:
        """Return the loop of a step kernel that another loop had."""
        loop = cls.__new__(cls)
        loop._set_step(step, ahead, times)
        return loop

    def _set_step(self, step: Kernel, ahead: bool, times: int) -> None:
        self.step, self.ahead, self.times = step, ahead, times
        self.size = step.program.n_out - 1
        program, lanes = step.program, step.lanes
        rows_in_cache = min(_MAX_WORKER_ROWS, max(_MIN_WORKER_ROWS, _WORKER_BYTES // (8 * (program.n_in + program.n_out))))
        # Columns a power of two apart would fall on the same places of the cache.
        self._width = (rows_in_cache // lanes | 1) * lanes

    @property
    def source_digest(self) -> str | None:
        """Digest of the sources of the loop, where known; see :func:`holdfast.kernels.cached_kernel`."""
        return self.step.source_digest

    def run(
        self, state: FloatArray, parameters: FloatArray, tolerance: float, most_steps: int, *, report: Tell = ignore_count
    ) -> LoopResult:
        """Iterate.

        Args:
            state: (N, s) where to start.
            parameters: (N, p) all parameters of a row one after the other, matrices row by row.
            tolerance: A row is done when its residual is at most this.
            most_steps: Give up after this many steps.
            report: Is told of how many rows more have come within the tolerance, from any thread.
        """
        rows = len(state)
        on_device = self.step.current()._on_device
        if on_device is not None:
            with ProgressCount(f"starts of {self.step.name}", rows) as row_counter:

                def report_ended(all_of: int, within: int) -> None:
                    row_counter(all_of)
                    report(within)

                result = on_device.run_loop(
                    state, parameters, tolerance, max_steps=most_steps, ahead=self.ahead, ended=report_ended
                )
            return LoopResult(state=result[0], residual=result[1], done=result[2], steps=result[3])
        workers = min(thread_count(), -(-rows // _MIN_WORKER_ROWS))
        batch = _RowQueue(state, parameters, tolerance, most_steps)
        counters = ProgressCount(f"starts of {self.step.name}", rows)
        steps = ProgressCount("steps", most_steps * self.times, most=True)
        with counters as batch.ended, steps as stepped:
            batch.over = report
            if rows <= _MIN_WORKER_ROWS:  # they begin together, and all may be on their way to the last step
                batch.stepped = stepped

            def iterate_batch(_: int) -> None:
                self._iterate_rows(batch, min(self._width, -(-rows // workers)))

            if workers <= 1 or in_pool():
                workers = 1
                if rows:
                    iterate_batch(0)
            else:
                list(shared_pool().map(iterate_batch, range(workers)))
        return batch.result

    def _iterate_rows(self, batch: _RowQueue, max_rows: int) -> None:
        """Take rows, step them all, return the finished rows and replace them by others until none are left."""
        result, size, ahead, tolerance = batch.result, self.size, self.ahead, batch.tolerance
        active_rows = batch.take_rows(max_rows)
        if not active_rows.size:
            return
        columns, outputs, step = self._bind_step_columns(*batch.row_inputs(active_rows))
        state, after, residual = (
            columns[:size],
            outputs[:size],
            outputs[-1, : active_rows.size],
        )  # views are made once, not in each step
        begun, wanted = (
            np.zeros(active_rows.size, dtype=np.int64),
            np.full(active_rows.size, tolerance),
        )  # when rows came; NaN: gone
        # Steps taken where a residual is measured, and of how many was told; when a row gives up, or this is to be told.
        now, last, told = int(ahead), min(batch.most_steps, _STEPS_PER_REPORT), 0
        while True:
            step()
            small = residual <= wanted
            if now < last and not np.count_nonzero(small):  # a few rows may take many steps: nothing else is done for them
                state[...] = after
                now += 1
                continue
            over = small if now < last else small | (now - begun >= batch.most_steps)
            done = over.nonzero()[0]
            rows = active_rows[done]
            result.state[rows] = (after if ahead else state)[:, done].T
            result.residual[rows] = residual[done]
            result.done[rows] = small[done]
            result.steps[rows] = now - begun[done]
            batch.ended(done.size)
            if batch.stepped is not ignore_count:
                batch.stepped((now - told) * self.times)
            if batch.over is not ignore_count:
                batch.over(int(np.count_nonzero(small[done])))
            told = now
            state[...] = after
            fresh = batch.take_rows(done.size)
            places, gone = done[: fresh.size], done[fresh.size :]
            if fresh.size:
                columns[:, places] = np.concatenate(batch.row_inputs(fresh))
                active_rows[places], begun[places] = fresh, now + (not ahead)
            if gone.size:
                wanted[gone], begun[gone] = np.nan, _UNREACHED_STEP
                still = (begun < _UNREACHED_STEP).nonzero()[0]
                if not still.size:
                    return
                if 4 * still.size <= 3 * active_rows.size:
                    # No rows are left to take: a batch that shrinks is cheaper.
                    columns, outputs, step = self._bind_step_columns(columns.take(still, axis=1))
                    active_rows, begun, wanted = active_rows[still], begun[still], wanted[still]
                    state, after, residual = columns[:size], outputs[:size], outputs[-1, : active_rows.size]
            now += 1
            last = min(int(begun.min()) + batch.most_steps, told + _STEPS_PER_REPORT)

    def trace_states(self, state: FloatArray, parameters: FloatArray, steps: int) -> FloatArray:
        """Return the states (steps + 1, N, s) of every row, ``state`` first, without checking the residual."""
        states = np.empty((steps + 1, *state.shape))
        states[0] = state
        columns, outputs, step = self._bind_step_columns(state.T, parameters.T)
        before, after, rows = columns[: self.size], outputs[: self.size], outputs[: self.size, : len(state)].T
        for k in range(1, steps + 1):
            step()
            states[k], before[...] = rows, after
        return states

    def _bind_step_columns(self, *values: FloatArray) -> tuple[FloatArray, FloatArray, Callable[[], None]]:
        """Return the columns of states and parameters, the columns of the results, and the step between them.

        The SIMD width divides their number: the last of the columns is repeated.
        """
        used_width = values[0].shape[1]
        width = -(-used_width // self.step.lanes) * self.step.lanes
        columns, outputs = np.empty((self.step.program.n_in, width)), np.empty((self.size + 1, width))
        np.concatenate(values, out=columns[:, :used_width])
        columns[:, used_width:] = columns[:, used_width - 1 : used_width]
        return columns, outputs, self.step.bind_arrays(columns, outputs)


class _RowQueue:
    """Rows that wait for a worker, with counters of finished rows, steps taken, and rows within the tolerance."""

    ended: Tell = staticmethod(ignore_count)
    stepped: Tell = staticmethod(ignore_count)
    over: Tell = staticmethod(ignore_count)

    def __init__(self, state: FloatArray, parameters: FloatArray, tolerance: float, most_steps: int) -> None:
        rows = len(state)
        self.tolerance, self.most_steps = tolerance, most_steps
        self.result = LoopResult(
            state=np.array(state, dtype=np.float64),
            residual=np.full(rows, np.nan),
            done=np.zeros(rows, dtype=bool),
            steps=np.zeros(rows, dtype=np.int64),
        )
        self._parameters, self._next, self._lock = parameters, 0, threading.Lock()

    def take_rows(self, count: int) -> NDArray[np.int64]:
        """Return up to ``count`` rows that no worker has had."""
        with self._lock:
            start = self._next
            self._next = min(start + count, len(self._parameters))
            return np.arange(start, self._next)

    def row_inputs(self, rows: NDArray[np.int64]) -> tuple[FloatArray, FloatArray]:
        """Return the start states (s, R) of these consecutive rows and their parameters (p, R)."""
        selection = slice(rows[0], rows[-1] + 1)
        return self.result.state[selection].T, self._parameters[selection].T
