"""A step kernel repeated until each row is done: the only way holdfast iterates over a batch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.threads import in_pool, pool, thread_count

Array = NDArray[np.float64]

_MOST, _LEAST = 8192, 512  # rows that one worker iterates on; no result depends on it


@dataclass(frozen=True)
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
    """``state -> next state`` with a residual of the state, repeated row by row until the residual is small.

    Rows that are done leave the batch, and each row's result is the one it had at that moment: results do not depend on
    the other rows, on chunks or on threads.

    Args:
        name: For messages.
        state: (s,) symbol.
        parameters: Symbols that stay constant while a row iterates.
        next_state: (s,) expression.
        residual: Scalar expression of the present state, not negative; NaN never ends a row.
        backend: As for :class:`Kernel`.
    """

    def __init__(
        self, name: str, state: SX, parameters: Sequence[SX], next_state: SX, residual: SX, backend: str | None = None
    ) -> None:
        self._size = int(state.numel())
        self._parameters = sum(int(p.numel()) for p in parameters)
        self._step = Kernel(name, [state, *parameters], [ca.vertcat(next_state, residual)], backend)

    def run(self, state: Array, parameters: Array, tolerance: float, most_steps: int) -> LoopResult:
        """Iterate.

        Args:
            state: (N, s) where to start.
            parameters: (N, p) all parameters of a row one after the other, matrices row by row.
            tolerance: A row is done when its residual is at most this.
            most_steps: Give up after this many steps.
        """
        rows = len(state)
        result = LoopResult(
            np.array(state, dtype=np.float64), np.full(rows, np.nan), np.zeros(rows, dtype=bool), np.zeros(rows, dtype=np.int64)
        )
        chunk = min(_MOST, max(_LEAST, -(-rows // thread_count())))
        starts = range(0, rows, chunk)

        def work(start: int) -> None:
            self._iterate(result, parameters, start, min(start + chunk, rows), tolerance, most_steps)

        if len(starts) <= 1 or in_pool() or thread_count() == 1:
            for start in starts:
                work(start)
        else:
            list(pool().map(work, starts))
        return result

    def _iterate(self, result: LoopResult, parameters: Array, start: int, stop: int, tolerance: float, most_steps: int) -> None:
        left = np.arange(start, stop)
        columns = self._columns(np.concatenate([result.state[left].T, parameters[left].T]))
        out = np.empty((self._size + 1, columns.shape[1]))
        finished = np.zeros(left.size, dtype=bool)
        for step in range(most_steps + 1):
            self._step.evaluate_columns(columns, out)
            residual = out[-1, : left.size]
            now = (residual <= tolerance) & ~finished
            last = step == most_steps
            if last:
                now = ~finished
            if now.any():
                rows = left[now]
                result.state[rows] = columns[: self._size, : left.size][:, now].T
                result.residual[rows] = residual[now]
                result.done[rows] = residual[now] <= tolerance
                result.steps[rows] = step
                finished |= now
                if last or finished.all():
                    return
                if 4 * int(finished.sum()) >= left.size:
                    keep = ~finished
                    columns[: self._size] = out[: self._size]
                    columns = self._columns(columns[:, : left.size][:, keep])
                    left, finished = left[keep], finished[keep]
                    out = np.empty((self._size + 1, columns.shape[1]))
                    continue
            columns[: self._size] = out[: self._size]

    def _columns(self, values: Array) -> Array:
        """Contiguous (s + p, W) with W a multiple of the SIMD width, padded with the last column."""
        used = values.shape[1]
        width = -(-used // self._step.lanes) * self._step.lanes
        padded = np.empty((values.shape[0], width))
        padded[:, :used] = values
        padded[:, used:] = values[:, used - 1 :]
        return padded
