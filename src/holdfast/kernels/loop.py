"""Step kernel repeated until each row is finished; it is the only iteration over batches in holdfast."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.core.progress import ProgressCount, ignore_count
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.kernels.kernel import Kernel, empty_columns
from holdfast.kernels.program import SX
from holdfast.kernels.threads import in_pool, shared_pool, thread_count

Tell = Callable[[int], None]
Inspect = tuple[int, Callable[[IndexArray, FloatArray, FloatArray], NDArray[np.bool_]]]

_WORKER_BYTES = 1 << 19  # bytes of state, parameters and results of one worker, so that they stay in its cache
_MAX_WORKER_ROWS = 4096  # largest number of these rows
_MIN_WORKER_ROWS = 256  # smallest number; no result depends on it
_STEPS_PER_REPORT = 1000  # steps between two reports of progress
_UNREACHED_STEP = 1 << 62  # start step of a row that does not exist


@dataclass(frozen=True, kw_only=True)
class LoopResult:
    """Final states of the rows of a loop.

    Attributes:
        state: (N, s) state at which the residual was last measured.
        residual: (N,) that residual; at most the tolerance where ``done``.
        done: (N,) True if the tolerance was reached.
        steps: (N,) number of steps taken.
    """

    state: FloatArray
    residual: FloatArray
    done: NDArray[np.bool_]
    steps: NDArray[np.int64]


class Loop:
    """Step ``state -> next state`` with a residual, repeated row by row until the residual is small.

    Finished rows leave the batch and others take their place. The result of a row is its state when it finished, so results do
    not depend on the other rows, their order or the number of threads.

    Args:
        name: Name for messages.
        state: Symbol (s,).
        parameters: Symbols that stay constant while a row iterates.
        next_state: Expression (s,).
        residual: Scalar expression of the present state, not negative; NaN never ends a row.
        backend: Name as for :class:`Kernel`.
        ahead: The residual is that of the next state, so that a converged row needs no further step to detect it.
        times: Number of the caller's steps in one step of the loop; only stored for the caller.

    Attributes:
        size: Numbers in a state.
        step: Kernel ``(state, parameters) -> (next state, residual)``.
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
        """Return a loop with a ``step`` kernel of another loop, and that loop's ``ahead`` and ``times``."""
        loop = cls.__new__(cls)
        loop._set_step(step, ahead, times)
        return loop

    def _set_step(self, step: Kernel, ahead: bool, times: int) -> None:
        self.step, self.ahead, self.times = step, ahead, times
        self.size = step.program.n_out - 1
        program, lanes = step.program, step.lanes
        rows_in_cache = min(_MAX_WORKER_ROWS, max(_MIN_WORKER_ROWS, _WORKER_BYTES // (8 * (program.n_in + program.n_out))))
        # Columns a power of two apart would map to the same cache lines.
        self._width = (rows_in_cache // lanes | 1) * lanes

    @property
    def source_digest(self) -> str | None:
        """Digest of the sources of the loop if known, else None; see :func:`holdfast.kernels.cached_kernel`."""
        return self.step.source_digest

    def run(
        self, state: FloatArray, parameters: FloatArray, tolerance: float, most_steps: int, *, report: Tell = ignore_count
    ) -> LoopResult:
        """Iterate the rows until each reaches the tolerance or the maximum number of steps.

        Args:
            state: (N, s) initial states.
            parameters: (N, p) all parameters of a row one after the other, matrices row by row.
            tolerance: Largest residual of a finished row, in the unit of the residual.
            most_steps: Maximum number of steps of a row.
            report: Called with the number of rows that newly reached the tolerance, from any thread.
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
            if rows <= _MIN_WORKER_ROWS:  # they begin together, and all may run to the last step
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
        """Step all rows, collect the finished rows and replace them by waiting rows until none are left."""
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
        )  # steps at which rows came; NaN: the row has left
        # Steps taken when a residual is measured, and at the last report; the step at which a row gives up or a report is due.
        now, last, told = int(ahead), min(batch.most_steps, _STEPS_PER_REPORT), 0
        while True:
            step()
            small = residual <= wanted
            if now < last and not np.count_nonzero(small):  # a few rows may take many steps, and need no further work here
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
                    # If no rows wait, a smaller batch is cheaper.
                    columns, outputs, step = self._bind_step_columns(columns.take(still, axis=1))
                    active_rows, begun, wanted = active_rows[still], begun[still], wanted[still]
                    state, after, residual = columns[:size], outputs[:size], outputs[-1, : active_rows.size]
            now += 1
            last = min(int(begun.min()) + batch.most_steps, told + _STEPS_PER_REPORT)

    def run_in_spans(
        self, state: FloatArray, parameters: FloatArray, rows: IndexArray, tolerance: float, most_steps: int, inspect: Inspect
    ) -> NDArray[np.bool_]:
        """Iterate rows as :meth:`run` does, inspect them at regular intervals, and return (N,) which reached the tolerance.

        Args:
            state: (N, s) states, of which those of the rows are replaced.
            parameters: (N, p) all parameters of a row one after the other, matrices row by row; p is above 0.
            rows: (R,) rows to iterate.
            tolerance: Largest residual of a finished row, in the unit of the residual.
            most_steps: Maximum number of steps of a row, rounded up to whole spans.
            inspect: Number of steps of a span, and a function that is called after each span with the row numbers (W,) and the
                columns (s, W or more) before and after it. It returns (W,) True for rows that end.
        """
        (steps, find_ended), size, width = inspect, self.size, 2 * self._width  # the inspection pays for a larger width
        active, waiting, done = rows[:width].copy(), rows[width:], np.zeros(len(state), dtype=np.bool_)
        begun, now, current = np.zeros(active.size, dtype=np.int64), 0, 0
        buffers, step = self._bind_three_columns(state[active].T, parameters[active].T)
        with ProgressCount(f"starts of {self.step.name}", rows.size) as report:
            while active.size:
                start = current
                for number in range(steps):
                    before, current = current, (start + 1 + number % 2) % 3
                    step[before, current]()
                    is_done = buffers[current][size, : active.size] <= tolerance
                    buffers[current][size] = buffers[start][size]  # the residual is where the first parameter was
                columns, now = buffers[current], now + steps
                is_over = is_done | find_ended(active, buffers[start][:size], columns[:size]) | (now - begun >= most_steps)
                places = is_over.nonzero()[0]
                if not places.size:
                    continue
                state[active[places]], done[active[places]] = columns[:size, places].T, is_done[places]
                report(places.size)
                fresh, waiting = waiting[: places.size], waiting[places.size :]
                places, gone = places[: fresh.size], places[fresh.size :]
                columns[:size, places], active[places], begun[places] = state[fresh].T, fresh, now
                for buffer in buffers:
                    buffer[size:, places] = parameters[fresh].T
                if gone.size:
                    active, begun, still = (np.delete(x, gone) for x in (active, begun, np.arange(active.size)))
                    if still.size:
                        (buffers, step), current = self._bind_three_columns(columns.take(still, axis=1)), 0
        return done

    def _bind_three_columns(self, *values: FloatArray) -> tuple[list[FloatArray], dict[tuple[int, int], Callable[[], None]]]:
        """Return the columns of states and parameters three times, and the steps from each of them to the others."""
        first = self._bind_step_columns(*values)[0]
        buffers = [first, empty_columns(*first.shape), empty_columns(*first.shape)]
        buffers[1][:] = buffers[2][:] = first
        pairs = [(k, m) for k in range(3) for m in range(3) if k != m]
        return buffers, {(k, m): self.step.bind_arrays(buffers[k], buffers[m][: self.size + 1]) for k, m in pairs}

    def trace_states(self, state: FloatArray, parameters: FloatArray, steps: int) -> FloatArray:
        """Return the states (steps + 1, N, s) from ``state`` (N, s) on, for ``parameters`` (N, p) and ``steps`` steps."""
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

        Their number is a multiple of the SIMD width; the last column is repeated.
        """
        used_width = values[0].shape[1]
        width = -(-used_width // self.step.lanes) * self.step.lanes
        columns, outputs = empty_columns(self.step.program.n_in, width), empty_columns(self.size + 1, width)
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
        """Return up to ``count`` rows that no worker has taken."""
        with self._lock:
            start = self._next
            self._next = min(start + count, len(self._parameters))
            return np.arange(start, self._next)

    def row_inputs(self, rows: NDArray[np.int64]) -> tuple[FloatArray, FloatArray]:
        """Return the start states (s, R) and the parameters (p, R) of these consecutive rows."""
        selection = slice(rows[0], rows[-1] + 1)
        return self.result.state[selection].T, self._parameters[selection].T
