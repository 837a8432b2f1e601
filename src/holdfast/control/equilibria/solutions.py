"""Configurations that reach a target with locked joints, without joint limits."""

from __future__ import annotations

import casadi as ca
import numpy as np

from holdfast.control.laws.law import Law
from holdfast.control.simulation.system import FailedArmSystem
from holdfast.core.caching import cached_property
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.linalg import damped_least_norm
from holdfast.kernels.loop import Loop

_ERROR_TOLERANCE = 1e-12
_MAX_STEPS = 60


class SolutionSearch:
    """Damped least squares over the healthy joints, ``dq = J_H' (J_H J_H' + 1e-3 |e|^2 + 1e-14)^-1 e``."""

    def __init__(self, law: Law) -> None:
        self._system = FailedArmSystem(law)
        self.made_of = law

    @cached_property
    @cached_kernel
    def _search_loop(self) -> Loop:
        q = self._system.q
        error, jacobian = self._system.scaled_error_and_jacobian(q)
        squared_error = ca.sumsqr(error)
        step = damped_least_norm(jacobian @ ca.diag(self._system.mask), error, 1e-3 * squared_error + 1e-14)
        return Loop("solutions", q, self._system.parameters, next_state=q + step, residual=ca.sqrt(squared_error))

    def search(self, q: FloatArray, pose: FloatArray, mask: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Search for configurations (N, n) from starts q (N, n), and return whether they reach the target."""
        inputs = np.concatenate([pose[:3, 3], pose[:3, :3].ravel(), mask])
        result = self._search_loop.run(q, np.broadcast_to(inputs, (len(q), inputs.size)), _ERROR_TOLERANCE, _MAX_STEPS)
        return result.state, result.done
