"""Compile expression graphs to batched functions; the only package that uses LLVM and the CasADi virtual machine, without
knowledge of robots.
"""

from holdfast.core._lazy import offer

offer(__name__)
