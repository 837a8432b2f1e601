"""Compile a program to machine code by LLVM for this processor.

Level 0 compiles about 4 times as fast as level 1, and its code takes about 1.8 times as long; both compute the same bits
(:mod:`holdfast.kernels.llvm.translation`).
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from holdfast.core.errors import KernelError
from holdfast.kernels.llvm.arithmetic import TargetMachine
from holdfast.kernels.llvm.translation import FUNCTION_NAME, emit_llvm_function
from holdfast.kernels.program import Program

COMPILE_LEVELS = (0, 1)
# Seconds per operation and level, measured, to predict the duration of a compilation and to decide whether a level pays.
COMPILE_SECONDS_PER_OPERATION = (11e-6, 43e-6)


@dataclass(frozen=True)
class HostProcessor:
    """Processor for which code is compiled.

    Attributes:
        cpu: LLVM's name of the processor.
        features: LLVM's list of its features.
        machine: Properties on which the text of a kernel depends.
    """

    cpu: str
    features: str
    machine: TargetMachine


@lru_cache(maxsize=1)
def detect_processor() -> HostProcessor:
    """Detect this machine; two registers of rows at once hide the latency of divisions and roots (measured: 18 % on AVX2)."""
    llvm = _llvm()
    features = llvm.get_host_cpu_features()
    lanes_per_register = 8 if features.get("avx512f") else 4 if features.get("avx") else 2
    has_fma = bool(features.get("fma")) or not any(name in features for name in ("sse2", "avx"))  # every 64-bit ARM has it
    return HostProcessor(llvm.get_host_cpu_name(), features.flatten(), TargetMachine(2 * lanes_per_register, has_fma))


@lru_cache(maxsize=1)
def _llvm() -> Any:
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    return binding


def llvm_lock() -> AbstractContextManager[Any]:
    """Return the lock of the only thread that uses LLVM, so that no fork happens during its work."""
    library = getattr(sys.modules.get("llvmlite.binding.ffi"), "lib", None)
    return nullcontext() if library is None else library._lock


def llvm_version() -> str:
    """Return the version of llvmlite."""
    from importlib.metadata import version

    return version("llvmlite")


def _target_machine(level: int) -> Any:
    llvm, processor = _llvm(), detect_processor()
    target = llvm.Target.from_default_triple()
    return target.create_target_machine(
        cpu=processor.cpu, features=processor.features, opt=level, jit=True, codemodel="jitdefault"
    )


def compile_program(program: Program, level: int, machine: TargetMachine | None = None) -> bytes:
    """Return object code of the function that :func:`holdfast.kernels.llvm.translation.emit_llvm_function` writes.

    Raises:
        KernelError: An operation has no translation.
    """
    return compile_llvm_text(emit_llvm_function(program, machine or detect_processor().machine), level)


def compile_llvm_text(text: str, level: int) -> bytes:
    """Return object code of a module in LLVM's language."""
    return bytes(_target_machine(level).emit_object(_llvm().parse_assembly(text)))


class LoadedCode:
    """Object code in memory."""

    def __init__(self, data: bytes) -> None:
        llvm = _llvm()
        try:
            self._engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), _target_machine(0))
            self._engine.add_object_file(llvm.object_file.ObjectFileRef.from_data(data))
            self._engine.finalize_object()
        except RuntimeError as error:
            raise KernelError(f"compiled code cannot be loaded: {error}") from error

    def find_function(self, name: str) -> int:
        """Return the address of a function, which is valid as long as this object exists."""
        address: int = self._engine.get_function_address(name)
        return address


class MachineCode(LoadedCode):
    """Object code of a program, ready to be called."""

    def __init__(self, data: bytes) -> None:
        super().__init__(data)
        self.address = self.find_function(FUNCTION_NAME)
        # Calls release the interpreter lock.
        kind = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64)
        self.call: Callable[[int, int, int, int], None] = kind(self.address)
