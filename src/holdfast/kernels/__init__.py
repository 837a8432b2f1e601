"""Expression graph to batched function. The only package that knows LLVM and the CasADi virtual machine; knows no robots."""

from holdfast._lazy import offer

offer(__name__)
