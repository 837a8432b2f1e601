"""A program on a device: rows in and out, on the host or on the device, and steps repeated until each row is done."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.caching import cached_property
from holdfast.errors import InputError
from holdfast.kernels.gpu.arrays import DeviceArray, Lent
from holdfast.kernels.gpu.driver import LEGACY_STREAM, Device, Double, Memory, Pointer, Whole, device
from holdfast.kernels.gpu.ptx import ptx_text
from holdfast.kernels.llvm.translation import NAME
from holdfast.kernels.program import Program

Array = NDArray[np.float64]

_MOST_BYTES = 1 << 30  # of inputs and results on the device at once, for arrays that come from the host
_STRETCH = 1000  # steps of a launch: between two of them Ctrl-C is heard and progress told


class OnDevice:
    """A program on one GPU.

    Args:
        program: What to compute.
        ordinal: Of the device.

    Raises:
        KernelError: See :class:`holdfast.kernels.gpu.driver.Device` and :func:`holdfast.kernels.gpu.ptx.ptx_text`.
    """

    def __init__(self, program: Program, ordinal: int) -> None:
        self.program, self.device = program, device(ordinal)
        self._function = self.device.function(ptx_text(program, self.device.capability), NAME)
        self._sizes = [rows * columns for rows, columns in program.input_shapes]

    # ---- arrays of the host ------------------------------------------------------------------------------------

    def rows(self, arrays: list[Array], count: int, first: int) -> Array:
        """Results (count, first) of inputs (count, size) or (1, size) each."""
        out = np.empty((count, first))
        width = self._fits(count, self.program.n_in + self.program.n_out)
        result = self.device.memory(self.program.n_out * width)
        # What is the same for every row is copied once.
        room = [_put(self.device, a) if len(a) == 1 else self.device.memory(a.shape[1] * width) for a in arrays]
        for start in range(0, count, width):
            stop = min(start + width, count)
            given: list[Any] = []
            for a, memory in zip(arrays, room, strict=True):
                if len(a) > 1:
                    memory.put(np.ascontiguousarray(a[start:stop]), LEGACY_STREAM)
                given += [Pointer(memory.pointer), Whole(a.shape[1] if len(a) > 1 else 0), Whole(1)]
            out[start:stop] = self._columns(self._function, given, result, self.program.n_out, stop - start)[:first].T
        return out

    def columns(self, inputs: Array, outputs: Array) -> None:
        """Results of columns (n_in, W) into columns (n_out, W): what :meth:`holdfast.kernels.Kernel.bound` does."""
        width, given, at = inputs.shape[1], [], 0
        memory = _put(self.device, np.ascontiguousarray(inputs))
        for size in self._sizes:
            given += [Pointer(memory.pointer + 8 * at * width), Whole(1), Whole(width)]
            at += size
        result = self.device.memory(outputs.size)
        outputs[:] = self._columns(self._function, given, result, len(outputs), width)

    def _columns(self, function: Any, given: list[Any], result: Memory, size: int, rows: int, *more: Any) -> Array:
        arguments = [*given, Pointer(result.pointer), Whole(1), Whole(rows), *more, Whole(rows)]
        self.device.launch(function, arguments, rows, LEGACY_STREAM)
        found = np.empty((size, rows))
        result.get(found, LEGACY_STREAM)
        return found

    def _fits(self, count: int, numbers: int) -> int:
        return max(1, min(count, _MOST_BYTES // (8 * numbers)))

    # ---- arrays of the device ----------------------------------------------------------------------------------

    def exchange(self, inputs: tuple[Any, ...], dims: tuple[list[tuple[int, ...]], list[tuple[int, ...]]], stream: int) -> Any:
        """One :class:`DeviceArray` per result, of inputs with ``__dlpack__``, computed on a stream; nothing is waited for."""
        lent = [Lent(a, self.device, stream, dims=d) for a, d in zip(inputs, dims[0], strict=True)]
        counts = {x.rows for x in lent if x.rows is not None}
        if len(counts) > 1:
            raise InputError(f"inputs on the GPU have {' and '.join(map(str, sorted(counts)))} rows; give one number of rows")
        rows = counts.pop() if counts else 1
        result = self.device.memory(self.program.n_out * rows)
        if rows:
            given = [number for x in lent for number in (Pointer(x.pointer), Whole(x.row), Whole(x.column))]
            given += [Pointer(result.pointer), Whole(1), Whole(rows), Whole(rows)]
            self.device.launch(self._function, given, rows, stream)
        made, at = [], 0
        for d, (r, c) in zip(dims[1], self.program.output_shapes, strict=True):
            inner = {0: (), 1: (rows,), 2: (c * rows, rows)}[len(d)]
            made.append(DeviceArray(result, at * rows, (rows, *d), strides=(1, *inner), stream=stream))
            at += r * c
        return made[0] if len(made) == 1 else tuple(made)

    # ---- steps -------------------------------------------------------------------------------------------------

    @cached_property
    def _steps(self) -> Any:
        return self.device.function(ptx_text(self.program, self.device.capability, state=self.program.n_out - 1), NAME)

    def iterate(
        self, state: Array, parameters: Array, tolerance: float, *, most: int, ahead: bool, ended: Callable[[int, int], None]
    ) -> tuple[Array, Array, NDArray[np.bool_], NDArray[np.int64]]:
        """State, residual, done and steps of each row: :meth:`holdfast.kernels.Loop.run`, a thread for each row.

        ``ended`` is told how many rows more have ended, and how many of them within the tolerance.
        """
        count, size = state.shape
        found = np.full((size + 3, count), np.nan)
        found[:size], found[size + 1 :] = state.T, 0.0
        width = self._fits(count, self.program.n_in + size + 3)
        for start in range(0, count, width):
            left, taken = np.arange(start, min(start + width, count)), 0
            while left.size:
                stretch = min(_STRETCH, most - taken)
                given: list[Any] = []
                kept = []
                for a in (found[:size, left].T, parameters[left]):
                    kept.append(_put(self.device, np.ascontiguousarray(a)))
                    given += [Pointer(kept[-1].pointer), Whole(a.shape[1]), Whole(1)]
                result = self.device.memory(len(found) * left.size)
                how = Double(tolerance), Whole(ahead), Whole(stretch)
                out = self._columns(self._steps, given, result, len(found), left.size, *how)
                out[-1] += taken
                found[:, left], taken = out, taken + stretch
                done = out[-2] > 0
                over = done if taken < most else np.ones_like(done)
                ended(int(np.count_nonzero(over)), int(np.count_nonzero(done)))
                left = left[~over]
        return found[:size].T.copy(), found[size], found[size + 1] > 0, found[size + 2].astype(np.int64)


def _put(where: Device, array: Array) -> Memory:
    memory = where.memory(array.size)
    memory.put(array, LEGACY_STREAM)
    return memory
