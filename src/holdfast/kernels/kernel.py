"""Batched functions from rows to rows, on any backend."""

from __future__ import annotations

import math
import os
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError, KernelError
from holdfast.core.labels import is_count
from holdfast.core.typing import FloatArray
from holdfast.kernels import casadi_backend
from holdfast.kernels.compiled import CompiledProgram
from holdfast.kernels.llvm.translation import UnsupportedOperationError
from holdfast.kernels.program import SX, Program
from holdfast.kernels.threads import in_pool, shared_pool, thread_count

_SCRATCH_BYTES = 1 << 20  # bytes, so that inputs and outputs of one chunk stay in the second-level cache
BACKEND_NAMES = ("llvm", "casadi", "cuda")
_chosen: str | None = None


def default_backend() -> str:
    """Return the backend of :func:`set_backend`, else of ``HOLDFAST_BACKEND``, else ``llvm``."""
    return _check_backend(_chosen or os.environ.get("HOLDFAST_BACKEND") or "llvm")


def set_backend(name: str | None) -> None:
    """Use a backend for all kernels that are made from now on.

    A GPU backend also replaces the backend of existing kernels of arms, indices and laws, until another backend or None is set.
    With other backends existing kernels keep theirs.

    Args:
        name: ``"llvm"``, ``"casadi"``, ``"cuda"`` or ``"cuda:1"``, as for :class:`holdfast.kernels.Kernel`; None: the default.

    Raises:
        KernelError: The backend is not known, or the GPU does not exist.
    """
    global _chosen
    if name is not None and _check_backend(name).startswith("cuda"):
        from holdfast.kernels.gpu.driver import get_device

        get_device(_device_number(name))
    _chosen = name


def _check_backend(name: str) -> str:
    kind, has_number, number = name.partition(":")
    if kind not in BACKEND_NAMES or (has_number and (kind != "cuda" or not is_count(number))):
        raise KernelError(f"backend '{name}' is not known; use one of {', '.join(BACKEND_NAMES)}, cuda:1 for the second GPU")
    return name


def _device_number(name: str) -> int:
    return int(name.partition(":")[2] or 0)


class Kernel:
    """Batched function of CasADi expressions.

    Each input of shape ``(r, c)`` takes an array ``(N, r, c)``. Axes of length 1 are dropped, so a scalar takes ``(N,)`` or
    ``(N, 1)`` and a column ``(N, r)``. An input without the leading axis ``N`` is used for every row; if no input has it, the
    result has none either. Results follow the same rule.

    A row gives the same bits for any batch, chunk and number of threads, because every call, also for one row, is padded to the
    SIMD width. NaN or infinity in a row gives NaN in all results of that row, and in no other row.

    Args:
        name: Name for messages.
        inputs: CasADi ``SX`` symbols.
        outputs: CasADi ``SX`` expressions of the symbols.
        backend: ``"llvm"`` (machine code, SIMD, threads), ``"casadi"`` (virtual machine), ``"cuda"`` (the first NVIDIA GPU) or
            ``"cuda:1"`` (the second). Default: ``default_backend()``, or ``"casadi"`` for operations that ``"llvm"`` lacks.

    Attributes:
        lanes: Number of rows that are computed at once.

    Raises:
        KernelError: The backend is unknown or lacks an operation, or there is no GPU, no driver or only too old a GPU.
    """

    def __init__(self, name: str, inputs: Sequence[SX], outputs: Sequence[SX], *, backend: str | None = None) -> None:
        self._set_program(Program(name, inputs, outputs), backend)

    @classmethod
    def from_program(cls, program: Program) -> Kernel:
        """Return the kernel of ``program`` on the default backend."""
        kernel = cls.__new__(cls)
        kernel._set_program(program, None)
        return kernel

    def _set_program(self, program: Program, named_backend: str | None) -> None:
        self.program, self.name, self._fixed = program, program.name, named_backend is not None
        backend = _check_backend(named_backend or default_backend())
        try:
            self._compiled = CompiledProgram(program) if backend == "llvm" else None
        except UnsupportedOperationError:
            if self._fixed:
                raise
            self._compiled, backend = None, "casadi"
        self.backend = backend
        self._on_device = None
        if backend.startswith("cuda"):
            from holdfast.kernels.gpu.launch import DeviceProgram

            self._on_device = DeviceProgram(program, _device_number(backend))
        self.lanes = 1 if self._compiled is None else self._compiled.lanes
        rows = _SCRATCH_BYTES // (8 * (self.program.n_in + self.program.n_out))
        self._chunk = max(self.lanes * 4, 1 << (max(rows, 1).bit_length() - 1))
        self._scratch = threading.local()
        self._elsewhere: dict[str, Kernel] = {}
        self._in_dims = [_squeeze_shape(s) for s in self.program.input_shapes]
        self._out_dims = [_squeeze_shape(s) for s in self.program.output_shapes]

    def current(self) -> Kernel:
        """Return the kernel itself, or its copy on the GPU that :func:`set_backend` has set since it was made."""
        must_move = _chosen is not None and _chosen != self.backend and not self._fixed and _chosen.startswith("cuda")
        return self.on_backend(str(_chosen)) if must_move else self

    def on_backend(self, backend: str) -> Kernel:
        """Return the same kernel on ``backend`` (a name as for the constructor), made once."""
        moved = self._elsewhere.get(backend)
        if moved is None:
            moved = self._elsewhere[backend] = self.__class__.__new__(self.__class__)
            moved._set_program(self.program, backend)
        return moved

    @property
    def source_digest(self) -> str | None:
        """Digest of the sources of the kernel if known, else None; see :func:`holdfast.kernels.cached_kernel`."""
        return self.program.recipe

    def __call__(self, *inputs: ArrayLike) -> Any:
        """Evaluate ``inputs``, one array ``(N, r, c)`` or ``(r, c)`` per input, without axes of length 1.

        Returns:
            One array ``(N, ...)`` per output (a tuple if there are several), without ``N`` if no input has it.

        Raises:
            InputError: The number of inputs, a shape, or the number of rows of an input is wrong.
        """
        arrays, rows = self._check_inputs(inputs)
        single = rows is None
        outputs, _ = self._evaluate(arrays, rows)
        count = len(outputs)
        results, offset = [], 0
        for dims, shape in zip(self._out_dims, self.program.output_shapes, strict=True):
            size = shape[0] * shape[1]
            block = outputs if len(self._out_dims) == 1 else np.ascontiguousarray(outputs[:, offset : offset + size])
            results.append(block.reshape(dims if single else (count, *dims)))
            offset += size
        if single:
            results = [r[()] if r.ndim == 0 else r for r in results]
        return results[0] if len(results) == 1 else tuple(results)

    def rows(self, *inputs: ArrayLike, first: int | None = None) -> FloatArray:
        """Evaluate ``inputs`` as a call does; return (N, n_out), all outputs of a row in order, matrices row by row.

        ``first`` limits the results to (N, first), because small programs spend half the time on writing them.
        """
        return self._evaluate(*self._check_inputs(inputs), first)[0]

    def marked_rows(self, *inputs: ArrayLike) -> tuple[FloatArray, bool]:
        """Evaluate ``inputs`` as :meth:`rows` does, and return whether any first output is NaN, found in cache."""
        return self._evaluate(*self._check_inputs(inputs))

    def _evaluate(self, arrays: list[FloatArray], rows: int | None, first: int | None = None) -> tuple[FloatArray, bool]:
        count, on_device = 1 if rows is None else rows, self.current()._on_device
        if on_device is not None:
            outputs = on_device.evaluate_rows(arrays, count, self.program.n_out if first is None else first)
            return outputs, bool(np.isnan(outputs[:, 0]).any())
        outputs = np.empty((count, self.program.n_out if first is None else first))
        if 0 < count <= self._chunk:
            return outputs, self._run_chunk(arrays, outputs, 0, count, object())
        marks: list[bool] = []
        call = object()
        starts = iter(range(0, count, self._chunk))  # shared, so that each free worker takes the next chunk

        def evaluate_chunks(_: int) -> None:
            for start in starts:
                marks.append(self._run_chunk(arrays, outputs, start, min(start + self._chunk, count), call))

        if count <= 2 * self._chunk or thread_count() == 1 or in_pool():
            evaluate_chunks(0)
        else:
            list(shared_pool().map(evaluate_chunks, range(thread_count())))
        return outputs, any(marks)

    def _check_inputs(self, inputs: Sequence[ArrayLike]) -> tuple[list[FloatArray], int | None]:
        if len(inputs) != len(self._in_dims):
            raise InputError(f"kernel '{self.name}' takes {len(self._in_dims)} inputs, got {len(inputs)}")
        arrays: list[FloatArray] = []
        rows: int | None = None
        for k, (value, dims) in enumerate(zip(inputs, self._in_dims, strict=True)):
            a = np.asarray(value, dtype=np.float64)
            if a.shape == dims:
                arrays.append(a.reshape(1, -1))
                continue
            column = dims == () and a.ndim == 2 and a.shape[1] == 1  # a batch of vectors of one element
            if not column and (a.ndim != len(dims) + 1 or a.shape[1:] != dims):
                expected_shape = "(" + ", ".join(["N", *map(str, dims)]) + ")"
                raise InputError(f"kernel '{self.name}': input {k} has shape {a.shape}; it must be {expected_shape} or {dims}")
            if rows is not None and rows != a.shape[0]:
                raise InputError(f"kernel '{self.name}': input {k} has {a.shape[0]} rows, another has {rows}")
            rows = a.shape[0]
            arrays.append(a.reshape(a.shape[0], math.prod(dims)))
        return arrays, rows

    def evaluate_columns(self, inputs: FloatArray, outputs: FloatArray) -> None:
        """Evaluate in the backend's own layout, without padding, copies or threads.

        Args:
            inputs: (n_in, W) contiguous array, W a multiple of ``lanes``.
            outputs: (n_out, W) contiguous array that is overwritten.

        Raises:
            KernelError: An array has another shape, type or layout.
        """
        self.bind_arrays(inputs, outputs)()

    def bind_arrays(self, inputs: FloatArray, outputs: FloatArray, used_width: int | None = None) -> Callable[[], None]:
        """Return a function that repeats :meth:`evaluate_columns` for these arrays; their contents may change.

        Args:
            inputs: (n_in, W) contiguous array, W a multiple of ``lanes``.
            outputs: (n_out, W) contiguous array that is overwritten.
            used_width: Number of leading columns to evaluate, a multiple of ``lanes``; default: all.
        """
        if self.backend == "casadi":
            return lambda: casadi_backend.evaluate_columns(
                self.program.function, inputs[:, :used_width], outputs[:, :used_width]
            )
        for a, rows in ((inputs, self.program.n_in), (outputs, self.program.n_out)):
            if a.dtype.char != "d" or not a.flags.c_contiguous or a.shape != (rows, inputs.shape[1]) or a.shape[1] % self.lanes:
                raise KernelError(
                    f"kernel '{self.name}': columns have shape {a.shape} and type {a.dtype}; they must be contiguous doubles "
                    f"of shape ({rows}, W), W a multiple of {self.lanes}"
                )
        on_device = self.current()._on_device
        if on_device is not None:
            return lambda: on_device.evaluate_columns(inputs[:, :used_width], outputs[:, :used_width])
        assert self._compiled is not None
        return self._compiled.bind_arrays(inputs, outputs, used_width)

    def exchange(self, *inputs: Any, stream: int = 1) -> Any:
        """Evaluate arrays on the GPU without a copy; inputs and results are shared by DLPack.

        Args:
            inputs: Arrays of doubles, shaped as for a call, with ``__dlpack__`` on the kernel's GPU (PyTorch, CuPy, JAX, Warp).
            stream: Handle of the stream to use, for example ``torch.cuda.current_stream().cuda_stream``; 1 is the default
                stream.

        Returns:
            One array (N, ...) on the GPU per output (a tuple if there are several), for ``from_dlpack`` of any of these
            libraries.

        Raises:
            KernelError: The kernel is not on a GPU.
            InputError: An input is not such an array, or has a wrong shape.
        """
        on_device = self._require_gpu()
        if len(inputs) != len(self._in_dims):
            raise InputError(f"kernel '{self.name}' takes {len(self._in_dims)} inputs, got {len(inputs)}")
        return on_device.evaluate_device_arrays(inputs, (self._in_dims, self._out_dims), stream or 1)

    def upload(self, array: ArrayLike, stream: int = 1) -> Any:
        """Copy ``array``, of any shape, from the host to the kernel's GPU on ``stream`` (a handle), for :meth:`exchange`.

        Raises:
            KernelError: The kernel is not on a GPU.
        """
        from holdfast.kernels.gpu.arrays import DeviceArray

        return DeviceArray.upload(np.asarray(array, dtype=np.float64), self._require_gpu().device, stream or 1)

    def _require_gpu(self) -> Any:
        on_device = self.current()._on_device
        if on_device is None:
            raise KernelError(f"kernel '{self.name}' is on the processor; make it with backend='cuda' for arrays on a GPU")
        return on_device

    def single_row(self) -> SingleRowKernel:
        """Return the kernel for one row at a time with minimal overhead, for control loops."""
        return SingleRowKernel(self)

    def _thread_buffers(self, width: int) -> _Buffers:
        """Return the buffers of this thread."""
        buffers: dict[int, _Buffers] | None = getattr(self._scratch, "made", None)
        if buffers is None:
            buffers = self._scratch.made = {}
        if width not in buffers:
            # Columns a power of two apart would map to the same cache lines.
            apart = width if width == self.lanes else width + self.lanes
            inputs, outputs = empty_columns(self.program.n_in, apart), empty_columns(self.program.n_out, apart)
            buffers[width] = _Buffers(inputs[:, :width], outputs[:, :width], self.bind_arrays(inputs, outputs, width))
        return buffers[width]

    def _run_chunk(self, arrays: list[FloatArray], out: FloatArray, start: int, stop: int, call: object) -> bool:
        used_rows = stop - start
        # Few different widths (the chunk, or powers of two down to the SIMD width), so that few scratch arrays exist.
        width = self.lanes
        while width < used_rows:
            width *= 2
        scratch = self._thread_buffers(width)
        row = 0
        for a in arrays:
            rows = slice(row, row + a.shape[1])
            if a.shape[0] > 1:
                scratch.inputs[rows, :used_rows] = a[start:stop].T
            elif scratch.call is not call:
                scratch.inputs[rows] = a.T
            row += a.shape[1]
        scratch.call = call
        if used_rows < width:
            scratch.inputs[:, used_rows:] = scratch.inputs[:, used_rows - 1 : used_rows]
        scratch.compute()
        out[start:stop] = scratch.outputs[: out.shape[1], :used_rows].T
        return math.isnan(scratch.outputs[0, :used_rows].min())  # NaN if any is: one pass, one release of the lock

    def __repr__(self) -> str:
        p = self.program
        return f"Kernel({self.name!r}, {p.n_in} -> {p.n_out}, {p.size} operations, {self.backend})"


def empty_columns(rows: int, width: int) -> FloatArray:
    """Return an array whose rows begin with cache lines if the width is a multiple of 8 (measured: 10 % faster)."""
    numbers = np.empty(rows * width + 7)
    start = -numbers.ctypes.data // 8 % 8
    return numbers[start : start + rows * width].reshape(rows, width)


@dataclass
class _Buffers:
    """Columns of inputs and outputs, the function between them, and the call whose constant inputs they contain."""

    inputs: FloatArray
    outputs: FloatArray
    compute: Callable[[], None]
    call: object = None


class SingleRowKernel:
    """``kernel`` for one row at a time: ``single(row)``, (n_in,) to a new (n_out,), with the same bits as ``Kernel.rows``.

    Arguments are not checked, and only one thread may use it. Everything is compiled when it is made.

    Attributes:
        inputs: (n_in,) numbers of the next call, for callers that fill them and call :meth:`run`.
    """

    def __init__(self, kernel: Kernel) -> None:
        program, compiled = kernel.program, kernel._compiled
        if kernel._on_device is not None:
            compiled = CompiledProgram(program)  # a single row does not use a GPU; the processor computes the same bits
        self.inputs, self._outputs = np.zeros(program.n_in), np.zeros(program.n_out)
        self._kernel, self._compiled = kernel, compiled  # the code lives as long as its compiler object
        self._given = (self.inputs.ctypes.data, self._outputs.ctypes.data, 1, 1)
        self._call = None if compiled is None else compiled.single_row_code.call

    def run(self) -> FloatArray:
        """Return the results (n_out,) of ``inputs`` as a new array."""
        if self._call is None:
            casadi_backend.evaluate_columns(self._kernel.program.function, self.inputs[:, None], self._outputs[:, None])
        else:
            self._call(*self._given)
        return self._outputs.copy()

    def __call__(self, row: FloatArray) -> FloatArray:
        """Return the results (n_out,) of ``row`` (n_in,) as a new array."""
        self.inputs[:] = row
        return self.run()


def _squeeze_shape(shape: tuple[int, int]) -> tuple[int, ...]:
    rows, columns = shape
    if columns == 1:
        return () if rows == 1 else (rows,)
    return (rows, columns)
