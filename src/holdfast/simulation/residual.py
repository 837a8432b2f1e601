"""How close a failed arm can still get to a target: damped least squares over its healthy joints."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.caching import cached_property
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.recall import recalled
from holdfast.linalg import damped_least_norm
from holdfast.notice import each
from holdfast.simulation.system import System

Array = NDArray[np.float64]

_STEPS, _FLAT = 200, 1e-9
_FIRST, _EASIER, _HARDER, _HOPELESS = 1e-3, 0.2, 5.0, 1e8


class Nearest:
    """The compiled search of one arm and task.

    A step is tried with the damping of Levenberg and Marquardt and kept if it lowers the error, so that the search ends at a
    least error also where the target is out of reach.
    """

    def __init__(self, system: System) -> None:
        self._system, self._arm = system, system.law.arm
        self.made_of = system

    @cached_property
    @recalled
    def _loop(self) -> Loop:
        system, n = self._system, self._arm.n
        state = ca.SX.sym("state", n + 1)
        q, damping = state[:n], state[n]
        e, j = system.error(q)
        # The least sum of squares of metres and radians is wanted; of lengths alone, in any unit.
        unit = 1.0 if system.law.task.angular else self._arm.length_unit
        e, j = e / unit, j / unit
        healthy = j @ ca.diag(system.mask)
        trial = q + damped_least_norm(healthy, e, damping)
        better = ca.sumsqr(system.error(trial)[0] / unit) < ca.sumsqr(e)
        after = ca.if_else(better, ca.vertcat(trial, damping * _EASIER + 1e-15), ca.vertcat(q, damping * _HARDER))
        slope = ca.sqrt(ca.sumsqr(healthy.T @ e))
        return Loop(
            "nearest point", state, system.parameters, next_state=after, residual=ca.if_else(damping > _HOPELESS, 0.0, slope)
        )

    @cached_property
    @recalled
    def _error(self) -> Kernel:
        s = self._system
        return Kernel("least error", [s.q, s.target, s.rotation], [ca.norm_2(s.error(s.q)[0])])

    def errors(self, q: Array, poses: Array) -> Array:
        """(N,) norms of the task's error, m and rad."""
        return self._error.rows(q, poses[:, :3, 3], poses[:, :3, :3])[:, 0]

    def search(self, q: Array, parameters: Array, restarts: int, generator: np.random.Generator) -> tuple[Array, Array]:
        """Find the least norms of the error (N,) from q (N, n) and from random values of the healthy joints.

        Returns:
            The norms, and (N, n) configurations that have them.
        """
        rows, n = q.shape
        position, rotation, mask = parameters[:, :3], parameters[:, 3:12].reshape(rows, 3, 3), parameters[:, 12:]
        least, nearest = self._error.rows(q, position, rotation)[:, 0], q.copy()
        low, high = finite_limits(self._arm)
        for k in each("starts of each run", range(restarts + 1)):
            start = q if k == 0 else np.where(mask > 0, generator.uniform(low, high, (rows, n)), q)
            found = self._loop.run(np.column_stack([start, np.full(rows, _FIRST)]), parameters, _FLAT, _STEPS)
            error = self._error.rows(found.state[:, :n], position, rotation)[:, 0]
            better = error < least
            least[better], nearest[better] = error[better], found.state[better, :n]
        return least, nearest
