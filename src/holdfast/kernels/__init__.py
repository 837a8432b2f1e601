"""Expression graph to batched function. The only package that knows heyoka and the CasADi virtual machine; knows no robots."""

from holdfast.kernels.kernel import BACKENDS, Kernel, default_backend
from holdfast.kernels.loop import Loop, LoopResult
from holdfast.kernels.program import SX, Program
from holdfast.kernels.threads import in_pool, pool, set_threads, thread_count

__all__ = [
    "BACKENDS",
    "SX",
    "Kernel",
    "Loop",
    "LoopResult",
    "Program",
    "default_backend",
    "in_pool",
    "pool",
    "set_threads",
    "thread_count",
]
