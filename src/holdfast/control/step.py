"""One control step at a time, as fast as Python can call it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.kernels import Kernel

Array = NDArray[np.float64]


class Step:
    """One control step ``(q, velocity) -> rates`` with buffers of its own: without any checks, not for several threads at once.

    Attributes:
        others: What the kernel tells besides the rates, of the last call.
    """

    def __init__(self, kernel: Kernel, n: int) -> None:
        self._call, self._n = kernel.evaluate_columns, n
        self._in = np.zeros((kernel.program.n_in, kernel.lanes))
        self._out = np.zeros((kernel.program.n_out, kernel.lanes))
        self._q, self._velocity = self._in[:n], self._in[n:]
        self._rates = self._out[:n, 0]
        self.others = self._out[n:, 0]

    def __call__(self, q: Array, velocity: Array) -> Array:
        """Rates (n,) of a configuration (n,) and a velocity of the hand."""
        self._q[:] = q[:, None]
        self._velocity[:] = velocity[:, None]
        self._call(self._in, self._out)
        return self._rates.copy()
