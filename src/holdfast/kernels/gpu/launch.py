"""A program on a device: rows in and out, on the host or on the device, and steps repeated until each row is done."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from ctypes import c_double, c_int64, c_void_p
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.caching import cached_property
from holdfast.errors import InputError
from holdfast.kernels.gpu.arrays import DeviceArray, Lent
from holdfast.kernels.gpu.driver import LEGACY_STREAM, Memory, device
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

    def _start(self, function: Any, given: Sequence[tuple[int, ...]], size: int, *, rows: int, stream: int, how: Any) -> Memory:
        """``size`` results of each row, column by column; inputs by address, and how far apart rows and columns are."""
        result = Memory(self.device, size * rows)
        if rows:
            arguments = [number for at, *apart in given for number in (c_void_p(at), *map(c_int64, apart))]
            arguments += [c_void_p(result.pointer), c_int64(1), c_int64(rows), *how, c_int64(rows)]
            self.device.launch(function, arguments, rows, stream)
        return result

    # ---- arrays of the host ------------------------------------------------------------------------------------

    def rows(self, arrays: list[Array], count: int, first: int) -> Array:
        """Results (count, first) of inputs (count, size) or (1, size) each."""
        out, size = np.empty((count, first)), self.program.n_out
        for part in self._parts(count, self.program.n_in + size):
            out[part] = self._copied(self._function, [a if len(a) == 1 else a[part] for a in arrays], size)[:first].T
        return out

    def columns(self, inputs: Array, outputs: Array) -> None:
        """Results of columns (n_in, W) into columns (n_out, W): what :meth:`holdfast.kernels.Kernel.bound` does."""
        ends = np.cumsum([rows * columns for rows, columns in self.program.input_shapes])
        outputs[:] = self._copied(self._function, np.split(inputs.T, ends[:-1], axis=1), len(outputs))

    def _copied(self, function: Any, arrays: list[Array], size: int, *how: Any) -> Array:
        """(size, N) of inputs (N, ...), or (1, ...) for all rows: there and back."""
        there, rows = [DeviceArray.of(a, self.device) for a in arrays], max(map(len, arrays))
        given = [(x.pointer, a.shape[1] if len(a) > 1 else 0, 1) for x, a in zip(there, arrays, strict=True)]
        found = np.empty((size, rows))
        self._start(function, given, size, rows=rows, stream=LEGACY_STREAM, how=how).get(found, LEGACY_STREAM)
        return found

    def _parts(self, count: int, numbers: int) -> list[slice]:
        width = max(1, min(count, _MOST_BYTES // (8 * numbers)))
        return [slice(start, min(start + width, count)) for start in range(0, count, width)]

    # ---- arrays of the device ----------------------------------------------------------------------------------

    def exchange(self, inputs: tuple[Any, ...], dims: tuple[list[tuple[int, ...]], list[tuple[int, ...]]], stream: int) -> Any:
        """One :class:`DeviceArray` per result, of inputs with ``__dlpack__``, computed on a stream; nothing is waited for."""
        lent = [Lent(a, self.device, stream, dims=d) for a, d in zip(inputs, dims[0], strict=True)]
        counts = {x.rows for x in lent if x.rows is not None}
        if len(counts) > 1:
            raise InputError(f"inputs on the GPU have {' and '.join(map(str, sorted(counts)))} rows; give one number of rows")
        rows = counts.pop() if counts else 1
        given = [(x.pointer, x.row, x.column) for x in lent]
        result = self._start(self._function, given, self.program.n_out, rows=rows, stream=stream, how=())
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
        for part in self._parts(count, self.program.n_in + size + 3):
            left, taken = np.arange(count)[part], 0
            while left.size:
                stretch = min(_STRETCH, most - taken)
                how = c_double(tolerance), c_int64(ahead), c_int64(stretch)
                out = self._copied(self._steps, [found[:size, left].T, parameters[left]], len(found), *how)
                out[-1] += taken
                found[:, left], taken = out, taken + stretch
                done = out[-2] > 0
                over = done if taken < most else np.ones_like(done)
                ended(int(np.count_nonzero(over)), int(np.count_nonzero(done)))
                left = left[~over]
        return found[:size].T.copy(), found[size], found[size + 1] > 0, found[size + 2].astype(np.int64)
