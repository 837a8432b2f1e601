"""Linearisation of the failed closed loop near a stationary point, its eigenvalues, and the kind of the point.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (22). The signs of real parts change not only where the determinant vanishes,
because complex pairs can cross the imaginary axis, too. Eigenvalues are therefore evaluated at every point.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import IntEnum
from functools import lru_cache

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.control.laws.law import Law
from holdfast.control.simulation.system import FailedArmSystem
from holdfast.core.caching import cached_property
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel

Kinds = NDArray[np.uint8]

REACHED_ERROR = 1e-6  # rad, and lengths in the arm's unit: a smaller error counts as 0
ZERO_BAND = 1e-6  # fraction of the linearisation's norm, or of 1: smaller real parts count as 0


class Kind(IntEnum):
    """Kind of a stationary point.

    At a ``SOLUTION`` the target is reached. The other kinds are erroneous: ``SINK`` (attracts), ``SADDLE``, ``SOURCE``
    (repels), and ``DEGENERATE``, where a real part is zero, so that the linearisation does not decide the stability.
    """

    SOLUTION = 0
    SINK = 1
    SADDLE = 2
    SOURCE = 3
    DEGENERATE = 4

    @property
    def word(self) -> str:
        """The kind in lower case, for text."""
        return self.name.lower()


def is_attracting(eigenvalues: NDArray[np.complex128]) -> BoolArray:
    """Return a mask (N,) of the points whose eigenvalues have no real part above 0; NaN does not attract."""
    band = ZERO_BAND * np.maximum(1.0, np.abs(eigenvalues).max(axis=1, initial=0.0))[:, None]
    return np.asarray((eigenvalues.real < band).all(axis=1))


def classify_kinds(eigenvalues: NDArray[np.complex128], scaled_errors: FloatArray) -> Kinds:
    """Return the :class:`Kind` (N,) for complex eigenvalues (N, h) and scaled errors (N,); NaN is degenerate."""
    real_parts = np.real(eigenvalues)
    band = ZERO_BAND * np.maximum(1.0, np.abs(eigenvalues).max(axis=1, initial=0.0))[:, None]
    conditions = [
        scaled_errors < REACHED_ERROR,
        (real_parts < -band).all(axis=1),
        (real_parts > band).all(axis=1),
        (np.abs(real_parts) > band).all(axis=1),
    ]
    chosen = np.select(conditions, [Kind.SOLUTION, Kind.SINK, Kind.SOURCE, Kind.SADDLE], Kind.DEGENERATE)
    return chosen.astype(np.uint8)


class Linearisation:
    """Rates and linearisation of the failed arm under one ``law``, without its speed limit, with time in units of ``1/Ke``.

    The methods take configurations ``q`` (N, n), rad and m, the ``pose`` (4, 4) of the target, and the mask ``healthy`` (n,) of
    the h healthy joints.
    """

    def __init__(self, law: Law) -> None:
        self.law, self._system = law, FailedArmSystem(law)

    @cached_property
    @cached_kernel
    def _rates_kernel(self) -> Kernel:
        system = self._system
        error, _ = system.error_and_jacobian(system.q)
        error_norms = ca.norm_2(error), ca.norm_2(system.scaled_error_and_jacobian(system.q)[0])
        rates = ca.vertcat(self.law.rates(system.q, error), *error_norms)
        return Kernel("rest rates", [system.q, system.target, system.rotation], [rates])

    @cached_property
    @cached_kernel
    def _jacobian_kernel(self) -> Kernel:
        system = self._system
        error, jacobian = system.error_and_jacobian(system.q)
        inputs = [system.q, system.target, system.rotation]
        rate_jacobian = self.law.with_slopes(system.q, error, system.q)[1]
        scaled_error = system.scaled_error_and_jacobian(system.q)[0]
        outputs = [rate_jacobian, jacobian, ca.norm_2(scaled_error)]
        return Kernel("linearisation", inputs, outputs)

    def rates(self, q: FloatArray, pose: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return commanded rates (N, n) of all joints at ``q`` for ``pose``, and errors (N,), in m and rad and scaled."""
        outputs = self._rates_kernel.rows(q, pose[:3, 3], pose[:3, :3])
        return outputs[:, :-2], outputs[:, -2], outputs[:, -1]

    def field(self, pose: FloatArray, healthy: BoolArray) -> Callable[[FloatArray], FloatArray]:
        """Return a fast function, not thread-safe, from q (n,) to the rates (n,) of the ``healthy`` joints for ``pose``."""
        n, rates_function = self.law.arm.n, self._rates_kernel.single_row()
        inputs = np.concatenate([np.zeros(n), pose[:3, 3], pose[:3, :3].ravel()])
        healthy_mask = healthy.astype(np.float64)

        def healthy_rates(q: FloatArray) -> FloatArray:
            inputs[:n] = q
            return np.asarray(rates_function(inputs)[:n] * healthy_mask)

        return healthy_rates

    def matrices(self, q: FloatArray, pose: FloatArray, healthy: BoolArray) -> FloatArray:
        """Return the linearisation (N, h, h) of the ``healthy`` joints at ``q`` for the target ``pose``."""
        jacobians, task_jacobian, scaled_error = self._jacobian_kernel(q, pose[:3, 3], pose[:3, :3])
        # At the target, where the derivative of the rotation vector is 0/0, the error changes by -J. The law is linear in the
        # error there or has no derivative.
        n, at_target = self.law.arm.n, np.flatnonzero(scaled_error < REACHED_ERROR)
        # The change of the error with each joint in turn.
        error_changes = -task_jacobian[at_target].transpose(0, 2, 1).reshape(-1, self.law.task.m)
        rates = self.law.velocity(np.repeat(q[at_target], n, axis=0), error_changes)
        jacobians[at_target] = rates.reshape(-1, n, n).transpose(0, 2, 1)
        return np.asarray(jacobians[:, healthy][:, :, healthy])

    def eigenvalues(self, q: FloatArray, pose: FloatArray, healthy: BoolArray) -> NDArray[np.complex128]:
        """Return the eigenvalues (N, h) of :meth:`matrices` for ``q``, ``pose``, ``healthy``, by decreasing real part."""
        matrices = self.matrices(q, pose, healthy)
        is_finite = np.isfinite(matrices).all(axis=(1, 2))
        eigenvalues = np.full(matrices.shape[:2], np.nan, dtype=np.complex128)
        if is_finite.any():
            values = np.linalg.eigvals(matrices[is_finite])
            eigenvalues[is_finite] = np.take_along_axis(values, np.argsort(-values.real, axis=1, kind="stable"), axis=1)
        return eigenvalues


@lru_cache(maxsize=16)
def linearisation(law: Law) -> Linearisation:
    """Return the compiled linearisation of ``law``."""
    return Linearisation(law)
