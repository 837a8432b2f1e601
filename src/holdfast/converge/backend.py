"""Which backend serves an expression that few rows will see."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from holdfast.kernels import SX

LARGE = 10_000  # operations: heyoka takes half a minute and more to compile as many, longer than the rows here take without it


def suitable(inputs: Sequence[SX], outputs: Sequence[SX]) -> str | None:
    """The CasADi virtual machine for a large program, which it runs without compiling it; else the default."""
    size = ca.Function("size", list(inputs), list(outputs), {"cse": True}).n_instructions()
    return "casadi" if size > LARGE else None
