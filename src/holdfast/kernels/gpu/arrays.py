"""Arrays on a device in the exchange format of PyTorch, CuPy, JAX and Warp, in both directions without a copy.

Source: DLPack, https://dmlc.github.io/dlpack (``DLManagedTensor``; Python specification of streams and capsules).
"""

from __future__ import annotations

import ctypes
import math
from ctypes import POINTER, Structure, c_int32, c_int64, c_uint8, c_uint16, c_uint64, c_void_p, py_object, pythonapi
from typing import Any

from holdfast.errors import InputError
from holdfast.kernels.gpu.driver import Device, Memory

_CUDA = 2  # kDLCUDA
_NAME = b"dltensor"


class _Tensor(Structure):
    _fields_ = [
        ("data", c_void_p),
        ("device_type", c_int32),
        ("device_id", c_int32),
        ("ndim", c_int32),
        ("code", c_uint8),
        ("bits", c_uint8),
        ("lanes", c_uint16),
        ("shape", POINTER(c_int64)),
        ("strides", POINTER(c_int64)),
        ("byte_offset", c_uint64),
    ]


class _Managed(Structure):
    _fields_ = [("tensor", _Tensor), ("context", c_void_p), ("deleter", c_void_p)]


_new = ctypes.PYFUNCTYPE(py_object, c_void_p, ctypes.c_char_p, c_void_p)(("PyCapsule_New", pythonapi))
_pointer = ctypes.PYFUNCTYPE(c_void_p, py_object, ctypes.c_char_p)(("PyCapsule_GetPointer", pythonapi))
_is_valid = ctypes.PYFUNCTYPE(ctypes.c_int, c_void_p, ctypes.c_char_p)(("PyCapsule_IsValid", pythonapi))
_pointer_of = ctypes.PYFUNCTYPE(c_void_p, c_void_p, ctypes.c_char_p)(("PyCapsule_GetPointer", pythonapi))
_lent: dict[int, tuple[Any, ...]] = {}  # what others hold, by the address of its description


def _forget(address: int) -> None:
    _lent.pop(address, None)


def _forget_untaken(capsule: int) -> None:
    if _is_valid(capsule, _NAME):
        _lent.pop(_pointer_of(capsule, _NAME), None)


_release, _capsule_ends = ctypes.CFUNCTYPE(None, c_void_p)(_forget), ctypes.PYFUNCTYPE(None, c_void_p)(_forget_untaken)


class DeviceArray:
    """Results on a device: ``torch.from_dlpack(x)``, ``cupy.from_dlpack(x)``, ``jax.dlpack.from_dlpack(x)`` share its memory.

    Attributes:
        shape: Of the array.
        strides: Of the array, in elements.
        pointer: Address of its first element.
        stream: Handle of the stream that computes it.
    """

    def __init__(self, memory: Memory, offset: int, shape: tuple[int, ...], *, strides: tuple[int, ...], stream: int) -> None:
        self._memory, self.shape, self.strides, self.stream = memory, shape, strides, stream
        self.pointer = memory.pointer + 8 * offset

    def __dlpack_device__(self) -> tuple[int, int]:
        return _CUDA, self._memory.device.ordinal

    def __dlpack__(self, *, stream: int | None = None, **_: Any) -> Any:
        if stream not in (self.stream, -1):  # another stream must not begin before this one is done
            self._memory.device.wait(self.stream)
        axes = len(self.shape)
        shape, strides = (c_int64 * axes)(*self.shape), (c_int64 * axes)(*self.strides)
        tensor = _Tensor(self.pointer, _CUDA, self._memory.device.ordinal, axes, 2, 64, 1, shape, strides, 0)
        managed = _Managed(tensor, None, ctypes.cast(_release, c_void_p))
        address = ctypes.addressof(managed)
        _lent[address] = managed, shape, strides, self._memory
        return _new(address, _NAME, ctypes.cast(_capsule_ends, c_void_p))


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
        tensor = _Managed.from_address(_pointer(self._capsule, _NAME)).tensor
        if (tensor.code, tensor.bits, tensor.lanes) != (2, 64, 1):
            raise InputError(f"an input on the GPU has {tensor.bits} bits of DLPack type {tensor.code}; give doubles")
        shape = tuple(tensor.shape[: tensor.ndim])
        strides = tuple(tensor.strides[: tensor.ndim]) if tensor.strides else _contiguous(shape)
        batch = len(shape) - len(dims)
        if batch not in (0, 1) or shape[batch:] != dims:
            raise InputError(f"an input on the GPU has shape {shape}; it must be (N, {', '.join(map(str, dims))}) or {dims}")
        inner = [(size, stride) for size, stride in zip(dims, strides[batch:], strict=True) if size > 1]
        self.column = inner[-1][1] if inner else 1
        expected = [self.column * step for step in _contiguous(tuple(size for size, _ in inner))]
        if [stride for _, stride in inner] != expected:
            raise InputError(f"an input on the GPU has strides {strides}, whose rows have gaps; make it contiguous")
        self.pointer = tensor.data + tensor.byte_offset
        self.rows: int | None = shape[0] if batch else None
        self.row: int = strides[0] if batch else 0


def _contiguous(shape: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(math.prod(shape[k + 1 :]) for k in range(len(shape)))
