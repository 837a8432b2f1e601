"""NVIDIA's driver through ``cuda-bindings``: devices, memory, modules, and launches; no other part of CUDA is needed."""

from __future__ import annotations

import weakref
from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import KernelError

LEGACY_STREAM = 1  # the stream that waits for all others: its handle for the driver, and its number in DLPack
_BLOCK_THREADS = 128  # threads; blocks for every multiprocessor from about ten thousand rows


@lru_cache(maxsize=1)
def _driver_functions() -> Any:
    """Return the driver's functions after starting the driver.

    Raises:
        KernelError: The bindings are not installed, or there is no driver.
    """
    try:
        from cuda.bindings import driver
    except ImportError as error:
        raise KernelError(
            "the cuda backend needs cuda-bindings; install holdfast-arms[gpu] (pip install 'holdfast-arms[gpu]')"
        ) from error
    try:
        started = driver.cuInit(0)
    except Exception as error:  # the bindings load the driver's library only at the first call
        raise KernelError(f"there is no NVIDIA driver on this machine: {error}") from error
    if int(started[0]):
        raise KernelError(f"the NVIDIA driver does not start ({driver.cuGetErrorName(started[0])[1].decode()}): no GPU here?")
    return driver


def _check_driver_result(action: str, answer: tuple[Any, ...]) -> Any:
    status, *values = answer
    if int(status):
        name = _driver_functions().cuGetErrorName(status)[1]
        raise KernelError(f"the GPU could not {action}: {name.decode() if name else status}")
    return values[0] if len(values) == 1 else tuple(values)


class Device:
    """GPU with its primary context, which PyTorch, CuPy, JAX, and Warp use too.

    Args:
        ordinal: Device number from 0, in the order of the driver.

    Attributes:
        ordinal: Device number.
        capability: Compute capability times 10, for example 90 for 9.0.

    Raises:
        KernelError: The bindings, the driver, or the device is missing.
    """

    def __init__(self, ordinal: int) -> None:
        driver = _driver_functions()
        count = _check_driver_result("be counted", driver.cuDeviceGetCount())
        if not 0 <= ordinal < count:
            raise KernelError(f"there is no GPU {ordinal}: the driver has {count}, counted from 0")
        self.ordinal = ordinal
        handle = _check_driver_result("be found", driver.cuDeviceGet(ordinal))
        kinds = (f"CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_{part}" for part in ("MAJOR", "MINOR"))
        answers = [driver.cuDeviceGetAttribute(getattr(driver.CUdevice_attribute, kind), handle) for kind in kinds]
        major, minor = (int(_check_driver_result("report its compute capability", answer)) for answer in answers)
        self.capability = 10 * major + minor
        self._context = _check_driver_result("be used", driver.cuDevicePrimaryCtxRetain(handle))

    def call_driver(self, action: str, name: str, *arguments: Any) -> Any:
        """Call a function of the driver for this device; the error message names the failed action.

        Raises:
            KernelError: The call failed, or an earlier kernel did.
        """
        driver = _driver_functions()
        _check_driver_result("be used", driver.cuCtxPushCurrent(self._context))
        try:
            return _check_driver_result(action, getattr(driver, name)(*arguments))
        finally:
            driver.cuCtxPopCurrent()

    def load_function(self, ptx: bytes, name: str) -> Any:
        """Return a kernel of a module; the driver translates the module for the device and caches the translation."""
        module = self.call_driver("load a kernel", "cuModuleLoadData", ptx + b"\0")
        return self.call_driver("find a kernel", "cuModuleGetFunction", module, name.encode())

    def launch(self, function: Any, arguments: Sequence[Any], rows: int, stream: int) -> None:
        """Start a kernel on a stream with one thread per row.

        Args:
            function: Kernel of :meth:`load_function`.
            arguments: Arguments of the kernel as ctypes numbers.
            rows: Number of rows, at least 1.
            stream: Handle of the stream.
        """
        values_and_types = tuple(a.value for a in arguments), tuple(type(a) for a in arguments)
        grid = -(-rows // _BLOCK_THREADS), 1, 1, _BLOCK_THREADS, 1, 1
        self.call_driver("start a kernel", "cuLaunchKernel", function, *grid, 0, _stream_handle(stream), values_and_types, 0)

    def wait_for_stream(self, stream: int) -> None:
        """Wait until the stream is empty; errors of its kernels are raised here."""
        self.call_driver("finish", "cuStreamSynchronize", _stream_handle(stream))


def _stream_handle(stream: int) -> Any:
    return _driver_functions().CUstream(stream)


class DeviceMemory:
    """Memory for doubles on a device, released when it is no longer referenced.

    Args:
        device: Device.
        count: Number of doubles.

    Attributes:
        device: Device.
        pointer: Address on the device.
    """

    def __init__(self, device: Device, count: int) -> None:
        self.device, size = device, max(8 * count, 8)
        self.pointer = int(device.call_driver(f"give {size / 2**20:.0f} MB", "cuMemAlloc", size))
        finalizer = weakref.finalize(self, device.call_driver, "give memory back", "cuMemFree", self.pointer)
        finalizer.atexit = False  # the driver ends before Python does

    def copy_to_device(self, array: NDArray[np.float64], stream: int, offset: int = 0) -> None:
        """Copy a contiguous array to the device, from element ``offset`` on."""
        start = self.pointer + 8 * offset
        self.device.call_driver(
            "take data", "cuMemcpyHtoDAsync", start, array.ctypes.data, array.nbytes, _stream_handle(stream)
        )

    def copy_to_host(self, array: NDArray[np.float64], stream: int, offset: int = 0) -> None:
        """Copy the content from element ``offset`` on into a contiguous array and wait for it."""
        start = self.pointer + 8 * offset
        self.device.call_driver(
            "give data", "cuMemcpyDtoHAsync", array.ctypes.data, start, array.nbytes, _stream_handle(stream)
        )
        self.device.wait_for_stream(stream)


@lru_cache
def get_device(ordinal: int) -> Device:
    """Return the device with a number; each device is opened once."""
    return Device(ordinal)
