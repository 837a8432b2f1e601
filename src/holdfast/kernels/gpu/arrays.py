"""Arrays on a device in the exchange format of PyTorch, CuPy, JAX, and Warp, in both directions without a copy.

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

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.kernels.gpu.driver import LEGACY_STREAM, Device, DeviceMemory

_CUDA_DEVICE_TYPE = 2  # kDLCUDA
_CAPSULE_NAME = b"dltensor"


# Layout of a tensor: data, device type and number, axes, code, bits and lanes of the type, shape, strides, offset in bytes.
_TENSOR_LAYOUT = struct.Struct("PiiiBBHPPQ")
_DEVICE_OFFSET = 8  # bytes before the device type
_DOUBLE_TYPE = [2, 64, 1]  # kDLFloat
_pointer = ctypes.PYFUNCTYPE(c_void_p, py_object, ctypes.c_char_p)(("PyCapsule_GetPointer", pythonapi))


class DeviceArray:
    """Array on a device; ``torch.from_dlpack``, ``cupy.from_dlpack`` and ``jax.dlpack.from_dlpack`` share its memory.

    Attributes:
        shape: Shape of the array.
        strides: Strides of the array, in elements.
        pointer: Address of the first element.
        stream: Handle of the stream that computes it.
    """

    def __init__(
        self, memory: DeviceMemory, offset: int, shape: tuple[int, ...], *, strides: tuple[int, ...], stream: int
    ) -> None:
        self._memory, self._offset, self.shape, self.strides, self.stream = memory, offset, shape, strides, stream
        self.pointer = memory.pointer + 8 * offset

    @classmethod
    def upload(cls, array: FloatArray, device: Device, stream: int = LEGACY_STREAM) -> DeviceArray:
        """Copy an array from the host to a device."""
        device_array = cls(
            DeviceMemory(device, array.size), 0, array.shape, strides=_contiguous_strides(array.shape), stream=stream
        )
        device_array._memory.copy_to_device(np.ascontiguousarray(array), stream)
        return device_array

    def upload_rows(self, rows: NDArray[np.int64], array: FloatArray) -> None:
        """Copy rows again from the host array; consecutive rows are copied together."""
        for run in np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1):
            self._memory.copy_to_device(array[run[0] : run[-1] + 1], self.stream, int(run[0]) * self.strides[0])

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> FloatArray:
        """Copy the array to the host after waiting for its computation."""
        flat = np.empty(math.prod(self.shape))
        self._memory.copy_to_host(flat, self.stream, self._offset)
        strided = np.lib.stride_tricks.as_strided(flat, self.shape, [8 * s for s in self.strides])
        return strided if dtype is None else strided.astype(dtype)

    def __dlpack_device__(self) -> tuple[int, int]:
        return _CUDA_DEVICE_TYPE, self._memory.device.ordinal

    def __dlpack__(self, *, stream: int | None = None, **_: Any) -> Any:
        if stream not in (self.stream, -1):  # another stream must wait for this one
            self._memory.device.wait_for_stream(self.stream)
        # NumPy makes the capsule, which keeps the memory alive and releases it at the end; NumPy never reads the data.
        strides = tuple(8 * step for step in self.strides)
        about = {"data": (self.pointer, False), "shape": self.shape, "strides": strides, "typestr": "=f8", "version": 3}
        capsule = np.asarray(SimpleNamespace(__array_interface__=about, memory=self._memory)).__dlpack__()
        struct.pack_into(
            "ii", (c_char * 16).from_address(_pointer(capsule, _CAPSULE_NAME)), _DEVICE_OFFSET, *self.__dlpack_device__()
        )
        return capsule


class BorrowedArray:
    """Array of doubles on a device that another library owns, seen as rows.

    Args:
        array: Array with ``__dlpack__``.
        device: Device on which the array must be.
        stream: Handle of the stream that will read the array.
        dims: Shape of a row.

    Attributes:
        pointer: Address of the first element.
        rows: Number of rows; None without a leading axis.
        row, column: Distance between two rows and between two numbers of a row, in elements.

    Raises:
        InputError: The array does not consist of doubles of this shape on this device, or its rows are not evenly spaced.
    """

    def __init__(self, array: Any, device: Device, stream: int, *, dims: tuple[int, ...]) -> None:
        device_pair = tuple(map(int, array.__dlpack_device__())) if hasattr(array, "__dlpack_device__") else None
        if device_pair != (_CUDA_DEVICE_TYPE, device.ordinal):
            raise InputError(
                f"an input is not an array on GPU {device.ordinal}: {type(array).__name__}, DLPack device {device_pair}"
            )
        self._capsule = array.__dlpack__(stream=stream)  # its release returns the array
        tensor = ctypes.string_at(_pointer(self._capsule, _CAPSULE_NAME), _TENSOR_LAYOUT.size)
        data, _, _, axes, *kind, address, strides_at, offset = _TENSOR_LAYOUT.unpack(tensor)
        if kind != _DOUBLE_TYPE:
            raise InputError(f"an input on the GPU has {kind[1]} bits of DLPack type {kind[0]}; give doubles")
        shape = tuple((c_int64 * axes).from_address(address)) if axes else ()
        strides = tuple((c_int64 * axes).from_address(strides_at)) if strides_at else _contiguous_strides(shape)
        batch = len(shape) - len(dims)
        if batch not in (0, 1) or shape[batch:] != dims:
            raise InputError(f"an input on the GPU has shape {shape}; it must be (N, {', '.join(map(str, dims))}) or {dims}")
        row_axes = [(size, stride) for size, stride in zip(dims, strides[batch:], strict=True) if size > 1]
        self.column = row_axes[-1][1] if row_axes else 1
        expected = [self.column * step for step in _contiguous_strides(tuple(size for size, _ in row_axes))]
        if [stride for _, stride in row_axes] != expected:
            raise InputError(f"an input on the GPU has strides {strides}, whose rows have gaps; make it contiguous")
        self.pointer = data + offset
        self.rows: int | None = shape[0] if batch else None
        self.row: int = strides[0] if batch else 0


def _contiguous_strides(shape: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(math.prod(shape[k + 1 :]) for k in range(len(shape)))
