"""Configurations that reach a target with locked joints, joint limits left aside."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.caching import cached_property
from holdfast.control.law import Law
from holdfast.kernels.loop import Loop
from holdfast.kernels.recall import recalled
from holdfast.linalg import damped_least_norm
from holdfast.simulation.system import System

Array = NDArray[np.float64]

_TOLERANCE, _STEPS = 1e-12, 60


class Solutions:
    """Damped least squares over the healthy joints, ``dq = J_H' (J_H J_H' + 1e-3 |e|^2 + 1e-14)^-1 e``."""

    def __init__(self, law: Law) -> None:
        self._system = System(law)
        self.made_of = law

    @cached_property
    @recalled
    def _loop(self) -> Loop:
        q = self._system.q
        e, j = self._system.scaled_error(q)
        size = ca.sumsqr(e)
        step = damped_least_norm(j @ ca.diag(self._system.mask), e, 1e-3 * size + 1e-14)
        return Loop("solutions", q, self._system.parameters, next_state=q + step, residual=ca.sqrt(size))

    def search(self, q: Array, pose: Array, mask: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Configurations (N, n) from starts q (N, n), and whether they reach the target."""
        row = np.concatenate([pose[:3, 3], pose[:3, :3].ravel(), mask])
        found = self._loop.run(q, np.broadcast_to(row, (len(q), row.size)), _TOLERANCE, _STEPS)
        return found.state, found.done
