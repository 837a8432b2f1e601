"""Run a program on a device: rows from and to the host or the device, and steps repeated until each row is finished."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from ctypes import c_double, c_int64, c_void_p
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.kernels.gpu.arrays import BorrowedArray, DeviceArray
from holdfast.kernels.gpu.driver import LEGACY_STREAM, DeviceMemory, get_device
from holdfast.kernels.gpu.ptx import make_ptx
from holdfast.kernels.llvm.translation import FUNCTION_NAME
from holdfast.kernels.program import Program

_MAX_BATCH_BYTES = 1 << 30  # bytes of inputs and results on the device at once, for arrays of the host
_STEPS_PER_LAUNCH = 1000  # steps of one launch; Ctrl-C and progress are handled between launches


class DeviceProgram:
    """Program on one GPU.

    Args:
        program: Program to run.
        ordinal: Number of the device, from 0.

    Raises:
        KernelError: See :class:`holdfast.kernels.gpu.driver.Device` and :func:`holdfast.kernels.gpu.ptx.make_ptx`.
    """

    def __init__(self, program: Program, ordinal: int) -> None:
        self.program, self.device = program, get_device(ordinal)
        self._function = self.device.load_function(make_ptx(program, self.device.capability), FUNCTION_NAME)

    def _launch_kernel(
        self, function: Any, addresses: Sequence[tuple[int, ...]], size: int, *, rows: int, stream: int, more_arguments: Any
    ) -> DeviceMemory:
        """Launch ``size`` results of each row, column by column; inputs are given by address and strides of rows
        and columns.
        """
        result = DeviceMemory(self.device, size * rows)
        if rows:
            arguments = [number for at, *stride in addresses for number in (c_void_p(at), *map(c_int64, stride))]
            arguments += [c_void_p(result.pointer), c_int64(1), c_int64(rows), *more_arguments, c_int64(rows)]
            self.device.launch(function, arguments, rows, stream)
        return result

    # ---- arrays of the host ------------------------------------------------------------------------------------

    def evaluate_rows(self, arrays: list[FloatArray], count: int, output_count: int) -> FloatArray:
        """Return results (count, first) of inputs (count, size) or (1, size) each."""
        outputs, size = np.empty((count, output_count)), self.program.n_out
        for part in self._split_into_batches(count, self.program.n_in + size):
            outputs[part] = self._evaluate_host_arrays(self._function, [a if len(a) == 1 else a[part] for a in arrays], size)[
                :output_count
            ].T
        return outputs

    def evaluate_columns(self, inputs: FloatArray, outputs: FloatArray) -> None:
        """Evaluate columns (n_in, W) into columns (n_out, W), as :meth:`holdfast.kernels.Kernel.bind_arrays` does."""
        ends = np.cumsum([rows * columns for rows, columns in self.program.input_shapes])
        outputs[:] = self._evaluate_host_arrays(self._function, np.split(inputs.T, ends[:-1], axis=1), len(outputs))

    def _evaluate_host_arrays(self, function: Any, arrays: list[FloatArray], size: int, *more_arguments: Any) -> FloatArray:
        """Return results (size, N) of inputs (N, ...), or (1, ...) for all rows, copied to the device and back."""
        device_arrays, rows = [DeviceArray.upload(a, self.device) for a in arrays], max(map(len, arrays))
        addresses = [(x.pointer, a.shape[1] if len(a) > 1 else 0, 1) for x, a in zip(device_arrays, arrays, strict=True)]
        results = np.empty((size, rows))
        self._launch_kernel(
            function, addresses, size, rows=rows, stream=LEGACY_STREAM, more_arguments=more_arguments
        ).copy_to_host(results, LEGACY_STREAM)
        return results

    def _split_into_batches(self, count: int, numbers: int) -> list[slice]:
        width = max(1, min(count, _MAX_BATCH_BYTES // (8 * numbers)))
        return [slice(start, min(start + width, count)) for start in range(0, count, width)]

    # ---- arrays of the device ----------------------------------------------------------------------------------

    def evaluate_device_arrays(
        self, inputs: tuple[Any, ...], dims: tuple[list[tuple[int, ...]], list[tuple[int, ...]]], stream: int
    ) -> Any:
        """Return one :class:`DeviceArray` per result of inputs with ``__dlpack__``, computed on a stream without waiting."""
        borrowed = [BorrowedArray(a, self.device, stream, dims=d) for a, d in zip(inputs, dims[0], strict=True)]
        counts = {x.rows for x in borrowed if x.rows is not None}
        if len(counts) > 1:
            raise InputError(f"inputs on the GPU have {' and '.join(map(str, sorted(counts)))} rows; give one number of rows")
        rows = counts.pop() if counts else 1
        addresses = [(x.pointer, x.row, x.column) for x in borrowed]
        result = self._launch_kernel(self._function, addresses, self.program.n_out, rows=rows, stream=stream, more_arguments=())
        results, offset = [], 0
        for d, (r, c) in zip(dims[1], self.program.output_shapes, strict=True):
            inner = {0: (), 1: (rows,), 2: (c * rows, rows)}[len(d)]
            results.append(DeviceArray(result, offset * rows, (rows, *d), strides=(1, *inner), stream=stream))
            offset += r * c
        return results[0] if len(results) == 1 else tuple(results)

    # ---- steps -------------------------------------------------------------------------------------------------

    @cached_property
    def _loop_function(self) -> Any:
        return self.device.load_function(
            make_ptx(self.program, self.device.capability, state=self.program.n_out - 1), FUNCTION_NAME
        )

    def run_loop(
        self,
        state: FloatArray,
        parameters: FloatArray,
        tolerance: float,
        *,
        max_steps: int,
        ahead: bool,
        ended: Callable[[int, int], None],
    ) -> tuple[FloatArray, FloatArray, NDArray[np.bool_], NDArray[np.int64]]:
        """Return state, residual, done, and steps of each row as :meth:`holdfast.kernels.Loop.run` does, one thread per row.

        ``ended`` is called with the number of newly finished rows, and the number of these within the tolerance.
        """
        count, size = state.shape
        results = np.full((size + 3, count), np.nan)
        results[:size], results[size + 1 :] = state.T, 0.0
        for part in self._split_into_batches(count, self.program.n_in + size + 3):
            unfinished, steps_taken = np.arange(count)[part], 0
            while unfinished.size:
                stretch = min(_STEPS_PER_LAUNCH, max_steps - steps_taken)
                more_arguments = c_double(tolerance), c_int64(ahead), c_int64(stretch)
                outputs = self._evaluate_host_arrays(
                    self._loop_function, [results[:size, unfinished].T, parameters[unfinished]], len(results), *more_arguments
                )
                outputs[-1] += steps_taken
                results[:, unfinished], steps_taken = outputs, steps_taken + stretch
                done = outputs[-2] > 0
                over = done if steps_taken < max_steps else np.ones_like(done)
                ended(int(np.count_nonzero(over)), int(np.count_nonzero(done)))
                unfinished = unfinished[~over]
        return results[:size].T.copy(), results[size], results[size + 1] > 0, results[size + 2].astype(np.int64)
