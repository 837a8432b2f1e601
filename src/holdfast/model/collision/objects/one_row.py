"""Clearance of an arm at one configuration after another, for loops that cannot wait for a batch."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.collision.clearance import Clearance


class SingleConfigurationClearance:
    """:meth:`Clearance.nearest` for one row, with the same bits in a fraction of the time; not thread-safe.

    Args:
        clearance: Collision model.
    """

    def __init__(self, clearance: Clearance) -> None:
        self._clearance, obstacles, self_clearance = clearance, clearance.obstacles, clearance.self_only
        self._self_kernels = (
            [kernel.single_row() for kernel in (self_clearance._value_kernel, self_clearance._gradient_kernel)]
            if clearance.pairs
            else []
        )
        self._blocks = [] if obstacles is None else obstacles.single_row_kernels()
        self._needs_batch = obstacles is not None and not self._blocks  # with grids, which NumPy reads
        self._n = clearance.arm.n

    def __call__(self, q: FloatArray) -> tuple[float, FloatArray]:
        """Return the margin, m, and its gradient (n,) at a finite configuration (n,)."""
        if self._needs_batch:
            margins, gradients = self._clearance.nearest(q[None])
            return float(margins[0]), gradients[0]
        margin, margin_gradient = np.inf, np.zeros(self._n)
        for block in self._blocks:
            block.inputs[: self._n] = q
            outputs = block.run()
            if outputs[0] < margin:
                margin, margin_gradient = float(outputs[0]), outputs[3:]
        if self._self_kernels:
            value, gradient = self._self_kernels
            self_distance = float(value(q)[0])
            if self_distance <= margin:
                margin, margin_gradient = self_distance, gradient(q)
        return margin, margin_gradient
