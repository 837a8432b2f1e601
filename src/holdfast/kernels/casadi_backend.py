"""Evaluate a program by the CasADi virtual machine, which is slower, runs everywhere, and is the reference of the tests."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def evaluate_columns(function: Any, inputs: NDArray[np.float64], outputs: NDArray[np.float64]) -> None:
    """Evaluate columns of ``inputs (n_in, W)`` into ``outputs (n_out, W)``."""
    width = inputs.shape[1]
    outputs[:] = np.asarray(function.map(width)(inputs)).reshape(outputs.shape)
    outputs[:, ~np.isfinite(inputs).all(axis=0)] = np.nan
