"""Program -> CasADi virtual machine: slower, runs everywhere, and is the oracle of the tests."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.kernels.program import Program


def compile_program(program: Program) -> Any:
    """The CasADi function itself; nothing is compiled."""
    return program.function


def call(compiled: Any, inputs: NDArray[np.float64], outputs: NDArray[np.float64]) -> None:
    """Evaluate columns of ``inputs (n_in, W)`` into ``outputs (n_out, W)``."""
    width = inputs.shape[1]
    outputs[:] = np.asarray(compiled.map(width)(inputs)).reshape(outputs.shape)
    outputs[:, ~np.isfinite(inputs).all(axis=0)] = np.nan
