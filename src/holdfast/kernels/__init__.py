"""Expression graph to batched function. The only package that knows LLVM and the CasADi virtual machine; knows no robots."""

from holdfast.kernels.compiled import settle
from holdfast.kernels.kernel import BACKENDS, Kernel, Single, default_backend
from holdfast.kernels.loop import Loop, LoopResult
from holdfast.kernels.program import SX, Program
from holdfast.kernels.recalled import recalled, recalled_data
from holdfast.kernels.threads import in_pool, pool, set_threads, thread_count

__all__ = [
    "BACKENDS",
    "SX",
    "Kernel",
    "Loop",
    "LoopResult",
    "Program",
    "Single",
    "default_backend",
    "in_pool",
    "pool",
    "recalled",
    "recalled_data",
    "set_threads",
    "settle",
    "thread_count",
]
