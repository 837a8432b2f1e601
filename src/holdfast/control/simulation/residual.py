"""Damped least squares over the healthy joints of a failed arm, for configurations at a target and for the least error."""

from __future__ import annotations

from functools import lru_cache

import casadi as ca
import numpy as np

from holdfast.control.laws.law import Law
from holdfast.control.simulation.system import FailedArmSystem
from holdfast.core.caching import cached_property
from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import damped_least_norm
from holdfast.kernels.loop import Loop
from holdfast.model.arm.configurations import sampling_limits

_MAX_SOLUTION_STEPS = 60
_SOLUTION_ERROR = 1e-12
_MAX_DESCENT_STEPS = 200
_GRADIENT_TOLERANCE = 1e-9
_INITIAL_DAMPING = 1e-3
_DAMPING_DECREASE = 0.2
_DAMPING_INCREASE = 5.0
_MAX_DAMPING = 1e8


class ErrorMinimiser:
    """Compiled search for the least error of one arm and task.

    A Levenberg-Marquardt step is accepted if it reduces the error, so the search ends at a least error even if the target is
    out of reach.
    """

    def __init__(self, system: FailedArmSystem) -> None:
        self._system, self._arm = system, system.law.arm
        self.made_of = system

    @cached_property
    @cached_kernel
    def _search_loop(self) -> Loop:
        system, n = self._system, self._arm.n
        state = ca.SX.sym("state", n + 1)
        q, damping = state[:n], state[n]
        error, jacobian = system.error_and_jacobian(q)
        # The least sum of squares over metres and radians depends on the unit of length; that over lengths alone does not.
        length_unit = 1.0 if system.law.task.angular else self._arm.length_unit
        error, jacobian = error / length_unit, jacobian / length_unit
        healthy_jacobian = jacobian @ ca.diag(system.mask)
        trial = q + damped_least_norm(healthy_jacobian, error, damping)
        is_better = ca.sumsqr(system.error_and_jacobian(trial)[0] / length_unit) < ca.sumsqr(error)
        next_state = ca.if_else(
            is_better, ca.vertcat(trial, damping * _DAMPING_DECREASE + 1e-15), ca.vertcat(q, damping * _DAMPING_INCREASE)
        )
        gradient_norm = ca.sqrt(ca.sumsqr(healthy_jacobian.T @ error))
        return Loop(
            "nearest point",
            state,
            system.parameters,
            next_state=next_state,
            residual=ca.if_else(damping > _MAX_DAMPING, 0.0, gradient_norm),
        )

    @cached_property
    @cached_kernel
    def _error_kernel(self) -> Kernel:
        system = self._system
        return Kernel(
            "least error", [system.q, system.target, system.rotation], [ca.norm_2(system.error_and_jacobian(system.q)[0])]
        )

    def compute_error_norms(self, q: FloatArray, poses: FloatArray) -> FloatArray:
        """Return the norms (N,) of the task's error, m and rad."""
        return self._error_kernel.rows(q, poses[:, :3, 3], poses[:, :3, :3])[:, 0]

    def search(
        self, q: FloatArray, poses: FloatArray, healthy_mask: FloatArray, restarts: int, generator: np.random.Generator
    ) -> tuple[FloatArray, FloatArray]:
        """Find the least errors at poses (N, 4, 4) from q (N, n) and from random values of the healthy joints.

        Returns:
            Norms (N,) of the errors, m and rad, and configurations (N, n) with these errors.
        """
        run_count, n = q.shape
        parameters = np.concatenate([poses[:, :3, 3], poses[:, :3, :3].reshape(-1, 9), healthy_mask], axis=1)
        least_errors, nearest = self.compute_error_norms(q, poses), q.copy()
        lower, upper = sampling_limits(self._arm)
        for restart in track("starts of each run", range(restarts + 1)):
            start = q if restart == 0 else np.where(healthy_mask > 0, generator.uniform(lower, upper, (run_count, n)), q)
            solutions = self._search_loop.run(
                np.column_stack([start, np.full(run_count, _INITIAL_DAMPING)]),
                parameters,
                _GRADIENT_TOLERANCE,
                _MAX_DESCENT_STEPS,
            )
            errors = self.compute_error_norms(solutions.state[:, :n], poses)
            is_better = errors < least_errors
            least_errors[is_better], nearest[is_better] = errors[is_better], solutions.state[is_better, :n]
        return least_errors, nearest


class SolutionSearch:
    """Compiled search for configurations at a target by ``dq = J_H' (J_H J_H' + 1e-3 |e|^2 + 1e-14)^-1 e``."""

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
        result = self._search_loop.run(q, np.broadcast_to(inputs, (len(q), inputs.size)), _SOLUTION_ERROR, _MAX_SOLUTION_STEPS)
        return result.state, result.done


@lru_cache(maxsize=16)
def solution_search(law: Law) -> SolutionSearch:
    """Return the search for a law, which is compiled once and cached."""
    return SolutionSearch(law)
