"""Program -> machine code by LLVM, for the processor at hand.

Level 0 compiles some 4 times as fast as level 1 and its code takes some 1.8 times as long; both give the same bits
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

from holdfast.errors import KernelError
from holdfast.kernels.llvm.arithmetic import Machine
from holdfast.kernels.llvm.translation import NAME, emit
from holdfast.kernels.program import Program

LEVELS = (0, 1)
# Seconds per operation and level, measured; for telling how long something will take, and which level is worth it.
COMPILING = (11e-6, 43e-6)


@dataclass(frozen=True)
class Host:
    """The processor that code is made for.

    Attributes:
        cpu: LLVM's name of it.
        features: LLVM's list of what it has.
        machine: What the text of a kernel depends on.
    """

    cpu: str
    features: str
    machine: Machine


@lru_cache(maxsize=1)
def host() -> Host:
    """This machine. Two registers of rows at once hide the latency of divisions and roots (measured: 18 % on AVX2)."""
    llvm = _llvm()
    found = llvm.get_host_cpu_features()
    wide = 8 if found.get("avx512f") else 4 if found.get("avx") else 2
    fused = bool(found.get("fma")) or not any(name in found for name in ("sse2", "avx"))  # all 64-bit ARM has it
    return Host(llvm.get_host_cpu_name(), found.flatten(), Machine(2 * wide, fused))


@lru_cache(maxsize=1)
def _llvm() -> Any:
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    return binding


def lock() -> AbstractContextManager[Any]:
    """What the one thread that uses LLVM holds: in a fork none may be in the middle of it, as the child does not have it."""
    library = getattr(sys.modules.get("llvmlite.binding.ffi"), "lib", None)
    return nullcontext() if library is None else library._lock


def version() -> str:
    """Of llvmlite."""
    from importlib.metadata import version

    return version("llvmlite")


def _target(level: int) -> Any:
    llvm, here = _llvm(), host()
    target = llvm.Target.from_default_triple()
    return target.create_target_machine(cpu=here.cpu, features=here.features, opt=level, jit=True, codemodel="jitdefault")


def compile_program(program: Program, level: int, machine: Machine | None = None) -> bytes:
    """Object code of the function that :func:`holdfast.kernels.llvm.translation.emit` writes.

    Raises:
        KernelError: An operation without translation.
    """
    return object_code(emit(program, machine or host().machine), level)


def object_code(text: str, level: int) -> bytes:
    """Object code of a module in LLVM's language."""
    return bytes(_target(level).emit_object(_llvm().parse_assembly(text)))


class Code:
    """Object code in memory, ready to be called."""

    def __init__(self, data: bytes) -> None:
        llvm = _llvm()
        try:
            self._engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), _target(0))
            self._engine.add_object_file(llvm.object_file.ObjectFileRef.from_data(data))
            self._engine.finalize_object()
            self.address: int = self._engine.get_function_address(NAME)
        except RuntimeError as error:
            raise KernelError(f"compiled code cannot be loaded: {error}") from error
        # Calls release the interpreter lock.
        kind = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64)
        self.call: Callable[[int, int, int, int], None] = kind(self.address)
