"""NVIDIA's driver through ``cuda-bindings``: devices, memory, modules, launches. Nothing else of CUDA is needed."""

from __future__ import annotations

import ctypes
import weakref
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import KernelError

LEGACY_STREAM = 1  # the stream that waits for all others: the handle of the driver, and the number in DLPack
_BLOCK = 128  # threads: enough blocks for every multiprocessor from some ten thousand rows on
_MOST_BLOCKS = 1 << 20  # beyond that a thread takes several rows


@lru_cache(maxsize=1)
def _bindings() -> Any:
    """The driver's functions, once it is started.

    Raises:
        KernelError: The bindings are not installed, or there is no driver.
    """
    try:
        from cuda.bindings import driver
    except ImportError as error:
        raise KernelError(
            "the cuda backend needs cuda-bindings; install holdfast[gpu] (pip install 'holdfast[gpu]')"
        ) from error
    try:
        started = driver.cuInit(0)
    except Exception as error:  # the bindings look for the driver's library at the first call only
        raise KernelError(f"there is no NVIDIA driver on this machine: {error}") from error
    if int(started[0]):
        raise KernelError(f"the NVIDIA driver does not start ({driver.cuGetErrorName(started[0])[1].decode()}): no GPU here?")
    return driver


def _checked(what: str, answer: tuple[Any, ...]) -> Any:
    status, *values = answer
    if int(status):
        name = _bindings().cuGetErrorName(status)[1]
        raise KernelError(f"the GPU could not {what}: {name.decode() if name else status}")
    return values[0] if len(values) == 1 else tuple(values)


class Device:
    """One GPU, by its primary context, which PyTorch, CuPy, JAX and Warp use too.

    Args:
        ordinal: Its number from 0, as the driver counts.

    Attributes:
        ordinal: The same.
        capability: Compute capability, 90 of 9.0.

    Raises:
        KernelError: No bindings, no driver, or no such device.
    """

    def __init__(self, ordinal: int) -> None:
        driver = _bindings()
        count = _checked("be counted", driver.cuDeviceGetCount())
        if not 0 <= ordinal < count:
            raise KernelError(f"there is no GPU {ordinal}: the driver has {count}, counted from 0")
        self.ordinal = ordinal
        self._device = _checked("be found", driver.cuDeviceGet(ordinal))
        self.capability = 10 * self._attribute("MAJOR") + self._attribute("MINOR")
        self._context = _checked("be used", driver.cuDevicePrimaryCtxRetain(self._device))

    def _attribute(self, which: str) -> int:
        driver = _bindings()
        kind = getattr(driver.CUdevice_attribute, f"CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_{which}")
        return int(_checked("tell its capability", driver.cuDeviceGetAttribute(kind, self._device)))

    @contextmanager
    def _current(self) -> Iterator[Any]:
        driver = _bindings()
        _checked("be used", driver.cuCtxPushCurrent(self._context))
        try:
            yield driver
        finally:
            driver.cuCtxPopCurrent()

    def memory(self, count: int) -> Memory:
        """Room for so many doubles."""
        return Memory(self, count)

    def function(self, ptx: bytes, name: str) -> Any:
        """A kernel of a module; the driver translates it for the device and keeps that for the next time."""
        with self._current() as driver:
            module = _checked("load a kernel", driver.cuModuleLoadData(ptx + b"\0"))
            return _checked("find a kernel", driver.cuModuleGetFunction(module, name.encode()))

    def launch(self, function: Any, arguments: Sequence[Any], rows: int, stream: int) -> None:
        """Start a kernel on a stream, a thread for each row.

        Args:
            function: See :meth:`function`.
            arguments: ctypes numbers.
            rows: At least 1.
            stream: Handle.
        """
        blocks = min(-(-rows // _BLOCK), _MOST_BLOCKS)
        given = tuple(a.value for a in arguments), tuple(type(a) for a in arguments)
        with self._current() as driver:
            handle = driver.CUstream(stream)
            _checked("start a kernel", driver.cuLaunchKernel(function, blocks, 1, 1, _BLOCK, 1, 1, 0, handle, given, 0))

    def wait(self, stream: int) -> None:
        """Until all that was put on a stream is done; an error of a kernel shows here."""
        with self._current() as driver:
            _checked("finish", driver.cuStreamSynchronize(driver.CUstream(stream)))


class Memory:
    """Doubles on a device, given back when nobody has them any more.

    Attributes:
        device: Where.
        pointer: Address there.
        count: Room.
    """

    def __init__(self, device: Device, count: int) -> None:
        self.device, self.count = device, count
        with device._current() as driver:
            self.pointer = int(_checked(f"give {8 * count / 2**20:.0f} MB", driver.cuMemAlloc(max(8 * count, 8))))
        weakref.finalize(self, _free, device, self.pointer).atexit = False  # the driver ends before Python does

    def put(self, array: NDArray[np.float64], stream: int) -> None:
        """Copy a contiguous array to the beginning."""
        with self.device._current() as driver:
            _checked(
                "take data", driver.cuMemcpyHtoDAsync(self.pointer, array.ctypes.data, array.nbytes, driver.CUstream(stream))
            )

    def get(self, array: NDArray[np.float64], stream: int) -> None:
        """Copy the beginning into a contiguous array, and wait for that."""
        with self.device._current() as driver:
            handle = driver.CUstream(stream)
            _checked("give data", driver.cuMemcpyDtoHAsync(array.ctypes.data, self.pointer, array.nbytes, handle))
            _checked("finish", driver.cuStreamSynchronize(handle))


def _free(device: Device, pointer: int) -> None:
    with device._current() as driver:
        driver.cuMemFree(pointer)


@lru_cache
def device(ordinal: int) -> Device:
    """The device of a number, found once."""
    return Device(ordinal)


Pointer, Whole, Double = ctypes.c_void_p, ctypes.c_int64, ctypes.c_double
