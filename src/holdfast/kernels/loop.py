"""A step kernel repeated until each row is done: the only way holdfast iterates over a batch."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.threads import in_pool, pool, thread_count
from holdfast.notice import Count, unheard

Array = NDArray[np.float64]
Tell = Callable[[int], None]

_BYTES = 1 << 19  # of the state, parameters and results that one worker iterates on: they stay in its cache
_MOST, _LEAST = 4096, 256  # rows of that; no result depends on it
_STRETCH = 1000  # steps after which somebody is told of them
_NEVER = 1 << 62  # when a row comes that is not there


@dataclass(frozen=True, kw_only=True)
class LoopResult:
    """Where the rows ended.

    Attributes:
        state: (N, s) the state at which the residual was last measured.
        residual: (N,) that residual; at most the tolerance where ``done``.
        done: (N,) the tolerance was reached.
        steps: (N,) number of steps taken.
    """

    state: Array
    residual: Array
    done: NDArray[np.bool_]
    steps: NDArray[np.int64]


class Loop:
    """``state -> next state`` with a residual, repeated row by row until the residual is small.

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
        self._take(Kernel(name, [state, *parameters], [ca.vertcat(next_state, residual)], backend=backend), ahead, times)

    @classmethod
    def of(cls, step: Kernel, ahead: bool, times: int) -> Loop:
        """The loop of a step kernel that another loop had."""
        loop = cls.__new__(cls)
        loop._take(step, ahead, times)
        return loop

    def _take(self, step: Kernel, ahead: bool, times: int) -> None:
        self.step, self.ahead, self.times = step, ahead, times
        self.size = step.program.n_out - 1
        program, lanes = step.program, step.lanes
        fits = min(_MOST, max(_LEAST, _BYTES // (8 * (program.n_in + program.n_out))))
        # Columns a power of two apart would fall on the same places of the cache.
        self._width = (fits // lanes | 1) * lanes

    @property
    def made_of(self) -> str | None:
        """Digest of what it was made of, where it is known; see :func:`holdfast.kernels.recalled`."""
        return self.step.made_of

    def run(self, state: Array, parameters: Array, tolerance: float, most_steps: int, *, over: Tell = unheard) -> LoopResult:
        """Iterate.

        Args:
            state: (N, s) where to start.
            parameters: (N, p) all parameters of a row one after the other, matrices row by row.
            tolerance: A row is done when its residual is at most this.
            most_steps: Give up after this many steps.
            over: Is told of how many rows more have come within the tolerance, from any thread.
        """
        rows = len(state)
        on_device = self.step.now()._on_device
        if on_device is not None:
            with Count(f"starts of {self.step.name}", rows) as told:

                def ended(all_of: int, within: int) -> None:
                    told(all_of)
                    over(within)

                found = on_device.iterate(state, parameters, tolerance, most=most_steps, ahead=self.ahead, ended=ended)
            return LoopResult(state=found[0], residual=found[1], done=found[2], steps=found[3])
        workers = min(thread_count(), -(-rows // _LEAST))
        batch = _Batch(state, parameters, tolerance, most_steps)
        ends, steps = Count(f"starts of {self.step.name}", rows), Count("steps", most_steps * self.times, most=True)
        with ends as batch.ended, steps as stepped:
            batch.over = over
            if rows <= _LEAST:  # they begin together, and all may be on their way to the last step
                batch.stepped = stepped

            def work(_: int) -> None:
                self._iterate(batch, min(self._width, -(-rows // workers)))

            if workers <= 1 or in_pool():
                workers = 1
                if rows:
                    work(0)
            else:
                list(pool().map(work, range(workers)))
        return batch.result

    def _iterate(self, batch: _Batch, most: int) -> None:
        """Take rows, step them all, put those that are done back and others in their place, until there are none."""
        result, size, ahead, tolerance = batch.result, self.size, self.ahead, batch.tolerance
        left = batch.take(most)
        if not left.size:
            return
        columns, out, step = self._stage(*batch.inputs(left))
        state, after, residual = columns[:size], out[:size], out[-1, : left.size]  # views are made once, not in each step
        begun, wanted = np.zeros(left.size, dtype=np.int64), np.full(left.size, tolerance)  # when rows came; NaN: gone
        # Steps taken where a residual is measured, and of how many was told; when a row gives up, or this is to be told.
        now, last, told = int(ahead), min(batch.most_steps, _STRETCH), 0
        while True:
            step()
            small = residual <= wanted
            if now < last and not np.count_nonzero(small):  # a few rows may take many steps: nothing else is done for them
                state[...] = after
                now += 1
                continue
            over = small if now < last else small | (now - begun >= batch.most_steps)
            done = over.nonzero()[0]
            rows = left[done]
            result.state[rows] = (after if ahead else state)[:, done].T
            result.residual[rows] = residual[done]
            result.done[rows] = small[done]
            result.steps[rows] = now - begun[done]
            batch.ended(done.size)
            if batch.stepped is not unheard:
                batch.stepped((now - told) * self.times)
            if batch.over is not unheard:
                batch.over(int(np.count_nonzero(small[done])))
            told = now
            state[...] = after
            fresh = batch.take(done.size)
            places, gone = done[: fresh.size], done[fresh.size :]
            if fresh.size:
                columns[:, places] = np.concatenate(batch.inputs(fresh))
                left[places], begun[places] = fresh, now + (not ahead)
            if gone.size:
                wanted[gone], begun[gone] = np.nan, _NEVER
                still = (begun < _NEVER).nonzero()[0]
                if not still.size:
                    return
                if 4 * still.size <= 3 * left.size:
                    # No rows are left to take: a batch that shrinks is cheaper.
                    columns, out, step = self._stage(columns.take(still, axis=1))
                    left, begun, wanted = left[still], begun[still], wanted[still]
                    state, after, residual = columns[:size], out[:size], out[-1, : left.size]
            now += 1
            last = min(int(begun.min()) + batch.most_steps, told + _STRETCH)

    def walk(self, state: Array, parameters: Array, steps: int) -> Array:
        """The states (steps + 1, N, s) of every row on its way, ``state`` first; the residual is not looked at."""
        way = np.empty((steps + 1, *state.shape))
        way[0] = state
        columns, out, step = self._stage(state.T, parameters.T)
        before, after, rows = columns[: self.size], out[: self.size], out[: self.size, : len(state)].T
        for k in range(1, steps + 1):
            step()
            way[k], before[...] = rows, after
        return way

    def _stage(self, *values: Array) -> tuple[Array, Array, Callable[[], None]]:
        """Columns of states and parameters, those of the results, and the step from these to those.

        The SIMD width divides their number: the last of the columns is repeated.
        """
        used = values[0].shape[1]
        width = -(-used // self.step.lanes) * self.step.lanes
        columns, out = np.empty((self.step.program.n_in, width)), np.empty((self.size + 1, width))
        np.concatenate(values, out=columns[:, :used])
        columns[:, used:] = columns[:, used - 1 : used]
        return columns, out, self.step.bound(columns, out)


class _Batch:
    """Rows that wait for a worker, and who is told of rows that ended, steps taken, and rows within the tolerance."""

    ended: Tell = staticmethod(unheard)
    stepped: Tell = staticmethod(unheard)
    over: Tell = staticmethod(unheard)

    def __init__(self, state: Array, parameters: Array, tolerance: float, most_steps: int) -> None:
        rows = len(state)
        self.tolerance, self.most_steps = tolerance, most_steps
        self.result = LoopResult(
            state=np.array(state, dtype=np.float64),
            residual=np.full(rows, np.nan),
            done=np.zeros(rows, dtype=bool),
            steps=np.zeros(rows, dtype=np.int64),
        )
        self._parameters, self._next, self._lock = parameters, 0, threading.Lock()

    def take(self, count: int) -> NDArray[np.int64]:
        """Up to so many rows that nobody has had."""
        with self._lock:
            start = self._next
            self._next = min(start + count, len(self._parameters))
            return np.arange(start, self._next)

    def inputs(self, rows: NDArray[np.int64]) -> tuple[Array, Array]:
        """(s, R) where these consecutive rows start, and (p, R) their parameters."""
        some = slice(rows[0], rows[-1] + 1)
        return self.result.state[some].T, self._parameters[some].T
