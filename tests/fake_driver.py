"""A driver of GPUs that are none: memory is the host's, and a launch runs the kernel's text as machine code, row by row."""

from __future__ import annotations

import ctypes
import types

import numpy as np

from holdfast.kernels.gpu import arrays
from holdfast.kernels.gpu.ptx import DeviceLoop, DeviceRows
from holdfast.kernels.llvm import machine_code
from holdfast.kernels.llvm.arithmetic import TargetMachine
from holdfast.kernels.llvm.machine_code import MachineCode, compile_llvm_text


class Status(int):
    """A status of the driver."""


class FakeDriver:
    """What :mod:`holdfast.kernels.gpu.driver` calls, each call written down.

    Attributes:
        calls: Names and arguments.
        launched: Names of the programs that were launched.
        fails: Name of a function -> its status.
        live: Bytes of each address that was given out and not taken back.
    """

    def __init__(self, capability=90, devices=2):
        self.capability, self.devices = capability, devices
        self.calls, self.fails, self.live, self.loaded, self.current, self.codes = [], {}, {}, {}, [], {}
        self.launched = set()
        self.CUdevice_attribute = types.SimpleNamespace(
            CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MAJOR="major", CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MINOR="minor"
        )
        self.CUstream = lambda handle: ("stream", handle)

    def ptx(self, program, capability, *, state=None):
        """In place of the PTX: a name by which the text for the processor is found again."""
        name = f"{program.digest} {state} sm_{capability}".encode()
        self.loaded[name] = program, state
        return name

    def answer(self, name, *values):
        def call(*arguments):
            self.calls.append((name, *arguments))
            if name in self.fails:
                return (Status(self.fails[name]),)
            return (Status(0), *(v(*arguments) if callable(v) else v for v in values))

        return call

    def cuGetErrorName(self, status):
        return 0, {2: b"CUDA_ERROR_OUT_OF_MEMORY", 100: b"CUDA_ERROR_NO_DEVICE"}.get(int(status), b"CUDA_ERROR_UNKNOWN")

    def allocate(self, size):
        block = (ctypes.c_char * (size + 256))()
        address = -(-ctypes.addressof(block) // 256) * 256  # as a GPU's memory begins
        self.live[address] = block
        return address

    def read(self, target, source, size):
        assert any(a <= source and source + size <= a + len(b) for a, b in self.live.items())
        ctypes.memmove(target, source, size)

    def write(self, target, source, size):
        assert any(a <= target and target + size <= a + len(b) for a, b in self.live.items())
        ctypes.memmove(target, source, size)

    def launch(self, function, *rest):
        assert self.current, "no context is current"
        program, state = function
        self.launched.add(program.name)
        values, kinds = rest[-2]
        name = program.digest, state
        if name not in self.codes:
            machine = TargetMachine(1, machine_code.detect_processor().machine.fused)
            text = DeviceRows(program, machine, on_device=False).module_text()
            if state is not None:
                text = DeviceLoop(program, state, machine, on_device=False).module_text()
            self.codes[name] = MachineCode(compile_llvm_text(text, 0))
        row = ctypes.CFUNCTYPE(None, *kinds, ctypes.c_int64)(self.codes[name].address)
        for thread in range(rest[0] * rest[3]):
            row(*values, thread)

    def __getattr__(self, name):
        known = {
            "cuInit": (),
            "cuDeviceGetCount": (self.devices,),
            "cuDeviceGet": (lambda k: ("device", k),),
            "cuDeviceGetAttribute": (lambda kind, _: {"major": self.capability // 10, "minor": self.capability % 10}[kind],),
            "cuDevicePrimaryCtxRetain": (lambda d: ("context", d[1]),),
            "cuCtxPushCurrent": (lambda c: self.current.append(c),),
            "cuCtxPopCurrent": (lambda: self.current.pop(),),
            "cuModuleLoadData": (lambda image: self.loaded[image.rstrip(b"\0")],),
            "cuModuleGetFunction": (lambda module, name: module,),
            "cuMemAlloc": (self.allocate,),
            "cuMemFree": (lambda pointer: self.live.pop(pointer) and None,),
            "cuMemcpyHtoDAsync": (lambda target, source, size, stream: self.write(target, source, size),),
            "cuMemcpyDtoHAsync": (lambda target, source, size, stream: self.read(target, source, size),),
            "cuStreamSynchronize": (lambda stream: None,),
            "cuLaunchKernel": (self.launch,),
        }
        if name not in known:
            raise AttributeError(name)
        # Functions that give back nothing answer with the status alone.
        gives = name.startswith(("cuDevice", "cuModule", "cuMemAlloc", "cuCtxPop"))
        made = self.answer(name, *known[name])
        return made if gives else (lambda *arguments: made(*arguments)[:1])

    def asked(self, name):
        """Arguments of the calls of a function."""
        return [call[1:] for call in self.calls if call[0] == name]


class Array:
    """An array of NumPy, or of a framework, that says it is on a GPU."""

    def __init__(self, values, device=0):
        self.values, self.device, self.streams = np.asarray(values, dtype=float), device, []
        self.shape, self.source = self.values.shape, values

    def __dlpack_device__(self):
        return 2, self.device

    def __dlpack__(self, *, stream=None):
        self.streams.append(stream)
        return (self.values if self.values.flags.writeable else self.source).__dlpack__()


class Reader:
    """Takes a capsule as a framework on the processor would, and says so."""

    def __init__(self, array, stream=1):
        self.array, self.stream = array, stream

    def __dlpack_device__(self):
        return 1, 0

    def __dlpack__(self, **_):
        capsule = self.array.__dlpack__(stream=self.stream)
        address = arrays._pointer(capsule, b"dltensor")
        kind = ctypes.c_int32.from_address(address + 8)
        assert kind.value == 2
        kind.value = 1
        return capsule


def read(array, stream=1):
    """A copy of what is on the device, after a look that it was shared."""
    view = np.from_dlpack(Reader(array, stream))
    assert view.ctypes.data == array.pointer  # shared
    return view.copy()
