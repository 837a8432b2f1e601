"""NVIDIA's driver through ``cuda-bindings``: devices, memory, modules, launches. Nothing else of CUDA is needed."""

from __future__ import annotations

import weakref
from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import KernelError

LEGACY_STREAM = 1  # the stream that waits for all others: the handle of the driver, and the number in DLPack
_BLOCK = 128  # threads: enough blocks for every multiprocessor from some ten thousand rows on


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
        found = _checked("be found", driver.cuDeviceGet(ordinal))
        kinds = (f"CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_{part}" for part in ("MAJOR", "MINOR"))
        asked = [driver.cuDeviceGetAttribute(getattr(driver.CUdevice_attribute, kind), found) for kind in kinds]
        major, minor = (int(_checked("tell its capability", answer)) for answer in asked)
        self.capability = 10 * major + minor
        self._context = _checked("be used", driver.cuDevicePrimaryCtxRetain(found))

    def do(self, what: str, name: str, *arguments: Any) -> Any:
        """Call a function of the driver for this device; ``what`` it could not do is said where it fails.

        Raises:
            KernelError: It failed, or a kernel before it did.
        """
        driver = _bindings()
        _checked("be used", driver.cuCtxPushCurrent(self._context))
        try:
            return _checked(what, getattr(driver, name)(*arguments))
        finally:
            driver.cuCtxPopCurrent()

    def function(self, ptx: bytes, name: str) -> Any:
        """A kernel of a module; the driver translates it for the device and keeps that for the next time."""
        module = self.do("load a kernel", "cuModuleLoadData", ptx + b"\0")
        return self.do("find a kernel", "cuModuleGetFunction", module, name.encode())

    def launch(self, function: Any, arguments: Sequence[Any], rows: int, stream: int) -> None:
        """Start a kernel on a stream, a thread for each row.

        Args:
            function: See :meth:`function`.
            arguments: ctypes numbers.
            rows: At least 1.
            stream: Handle.
        """
        given = tuple(a.value for a in arguments), tuple(type(a) for a in arguments)
        grid = -(-rows // _BLOCK), 1, 1, _BLOCK, 1, 1
        self.do("start a kernel", "cuLaunchKernel", function, *grid, 0, _handle(stream), given, 0)

    def wait(self, stream: int) -> None:
        """Until all that was put on a stream is done; an error of a kernel shows here."""
        self.do("finish", "cuStreamSynchronize", _handle(stream))


def _handle(stream: int) -> Any:
    return _bindings().CUstream(stream)


class Memory:
    """Doubles on a device, given back when nobody has them any more.

    Args:
        device: Where.
        count: How many.

    Attributes:
        device: The same.
        pointer: Address there.
    """

    def __init__(self, device: Device, count: int) -> None:
        self.device, size = device, max(8 * count, 8)
        self.pointer = int(device.do(f"give {size / 2**20:.0f} MB", "cuMemAlloc", size))
        end = weakref.finalize(self, device.do, "give memory back", "cuMemFree", self.pointer)
        end.atexit = False  # the driver ends before Python does

    def put(self, array: NDArray[np.float64], stream: int, at: int = 0) -> None:
        """Copy a contiguous array there, from number ``at`` on."""
        start = self.pointer + 8 * at
        self.device.do("take data", "cuMemcpyHtoDAsync", start, array.ctypes.data, array.nbytes, _handle(stream))

    def get(self, array: NDArray[np.float64], stream: int, at: int = 0) -> None:
        """Copy what is there from number ``at`` on into a contiguous array, and wait for that."""
        start = self.pointer + 8 * at
        self.device.do("give data", "cuMemcpyDtoHAsync", array.ctypes.data, start, array.nbytes, _handle(stream))
        self.device.wait(stream)


@lru_cache
def device(ordinal: int) -> Device:
    """The device of a number, found once."""
    return Device(ordinal)
