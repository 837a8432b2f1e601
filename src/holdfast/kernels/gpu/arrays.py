"""Arrays on a device in the exchange format of PyTorch, CuPy, JAX and Warp, in both directions without a copy.

Source: DLPack, https://dmlc.github.io/dlpack (``DLManagedTensor``; Python specification of streams and capsules).
"""

from __future__ import annotations

import ctypes
import math
import struct
from ctypes import c_char, c_int64, c_void_p, py_object, pythonapi
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError
from holdfast.kernels.gpu.driver import LEGACY_STREAM, Device, Memory

Array = NDArray[np.float64]

_CUDA = 2  # kDLCUDA
_NAME = b"dltensor"


# Of a tensor: data, kind and number of the device, axes, code, bits and lanes of the type, shape, strides, offset in bytes.
_TENSOR = struct.Struct("PiiiBBHPPQ")
_DEVICE = 8  # bytes before the kind of the device
_DOUBLE = [2, 64, 1]  # kDLFloat
_pointer = ctypes.PYFUNCTYPE(c_void_p, py_object, ctypes.c_char_p)(("PyCapsule_GetPointer", pythonapi))


class DeviceArray:
    """Results on a device: ``torch.from_dlpack(x)``, ``cupy.from_dlpack(x)``, ``jax.dlpack.from_dlpack(x)`` share its memory.

    Attributes:
        shape: Of the array.
        strides: Of the array, in elements.
        pointer: Address of its first element.
        stream: Handle of the stream that computes it.
    """

    def __init__(self, memory: Memory, offset: int, shape: tuple[int, ...], *, strides: tuple[int, ...], stream: int) -> None:
        self._memory, self._offset, self.shape, self.strides, self.stream = memory, offset, shape, strides, stream
        self.pointer = memory.pointer + 8 * offset

    @classmethod
    def of(cls, array: Array, device: Device, stream: int = LEGACY_STREAM) -> DeviceArray:
        """A copy of an array of the host."""
        made = cls(Memory(device, array.size), 0, array.shape, strides=_contiguous(array.shape), stream=stream)
        made._memory.put(np.ascontiguousarray(array), stream)
        return made

    def update(self, rows: NDArray[np.int64], array: Array) -> None:
        """Copy rows of the array again of which this is a copy; rows one after the other go at once."""
        for run in np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1):
            self._memory.put(array[run[0] : run[-1] + 1], self.stream, int(run[0]) * self.strides[0])

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Array:
        """A copy on the host, when it is computed."""
        flat = np.empty(math.prod(self.shape))
        self._memory.get(flat, self.stream, self._offset)
        found = np.lib.stride_tricks.as_strided(flat, self.shape, [8 * s for s in self.strides])
        return found if dtype is None else found.astype(dtype)

    def __dlpack_device__(self) -> tuple[int, int]:
        return _CUDA, self._memory.device.ordinal

    def __dlpack__(self, *, stream: int | None = None, **_: Any) -> Any:
        if stream not in (self.stream, -1):  # another stream must not begin before this one is done
            self._memory.device.wait(self.stream)
        # NumPy makes the capsule, which keeps the memory, and gives it back whatever becomes of it; it never looks at the data.
        strides = tuple(8 * step for step in self.strides)
        about = {"data": (self.pointer, False), "shape": self.shape, "strides": strides, "typestr": "=f8", "version": 3}
        capsule = np.asarray(SimpleNamespace(__array_interface__=about, memory=self._memory)).__dlpack__()
        struct.pack_into("ii", (c_char * 16).from_address(_pointer(capsule, _NAME)), _DEVICE, *self.__dlpack_device__())
        return capsule


class Lent:
    """An array of doubles that somebody else has on a device, as rows.

    Args:
        array: With ``__dlpack__``.
        device: Where it must be.
        stream: Handle of the stream that will read it.
        dims: Axes of a row.

    Attributes:
        pointer: Address of the first element.
        rows: Number of them; None without a leading axis.
        row, column: Distance of two rows and of two numbers of a row, in elements.

    Raises:
        InputError: Not an array of doubles of that shape on that device, or one whose rows are not evenly spaced.
    """

    def __init__(self, array: Any, device: Device, stream: int, *, dims: tuple[int, ...]) -> None:
        where = tuple(map(int, array.__dlpack_device__())) if hasattr(array, "__dlpack_device__") else None
        if where != (_CUDA, device.ordinal):
            raise InputError(f"an input is not an array on GPU {device.ordinal}: {type(array).__name__}, DLPack device {where}")
        self._capsule = array.__dlpack__(stream=stream)  # its end gives the array back
        tensor = ctypes.string_at(_pointer(self._capsule, _NAME), _TENSOR.size)
        data, _, _, axes, *kind, at, strides_at, offset = _TENSOR.unpack(tensor)
        if kind != _DOUBLE:
            raise InputError(f"an input on the GPU has {kind[1]} bits of DLPack type {kind[0]}; give doubles")
        shape = tuple((c_int64 * axes).from_address(at)) if axes else ()
        strides = tuple((c_int64 * axes).from_address(strides_at)) if strides_at else _contiguous(shape)
        batch = len(shape) - len(dims)
        if batch not in (0, 1) or shape[batch:] != dims:
            raise InputError(f"an input on the GPU has shape {shape}; it must be (N, {', '.join(map(str, dims))}) or {dims}")
        inner = [(size, stride) for size, stride in zip(dims, strides[batch:], strict=True) if size > 1]
        self.column = inner[-1][1] if inner else 1
        expected = [self.column * step for step in _contiguous(tuple(size for size, _ in inner))]
        if [stride for _, stride in inner] != expected:
            raise InputError(f"an input on the GPU has strides {strides}, whose rows have gaps; make it contiguous")
        self.pointer = data + offset
        self.rows: int | None = shape[0] if batch else None
        self.row: int = strides[0] if batch else 0


def _contiguous(shape: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(math.prod(shape[k + 1 :]) for k in range(len(shape)))
