"""The failed closed loop near a stationary point: its linearisation, its eigenvalues, and the kind of the point.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (22). That signs change only where the determinant vanishes is not so:
complex pairs cross too, and eigenvalues are looked at everywhere.
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

REACHED_ERROR = 1e-6  # rad, and lengths in units of the arm's own: an error below it counts as 0
ZERO_BAND = 1e-6  # of the linearisation's norm, or of 1: real parts below it have no sign


class Kind(IntEnum):
    """Kind of a stationary point.

    ``SOLUTION``: the target is reached. The others are erroneous: ``SINK`` (attracts), ``SADDLE``, ``SOURCE`` (repels), and
    ``DEGENERATE`` where a real part is zero, so that the linearisation does not decide.
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
    """Return (N,) True where no real part is above 0, zeros allowed; NaN does not attract."""
    band = ZERO_BAND * np.maximum(1.0, np.abs(eigenvalues).max(axis=1, initial=0.0))[:, None]
    return np.asarray((eigenvalues.real < band).all(axis=1))


def classify_kinds(eigenvalues: NDArray[np.complex128], scaled_errors: FloatArray) -> Kinds:
    """Return (N,) :class:`Kind` from eigenvalues (N, h), complex, and scaled errors (N,); NaN is degenerate."""
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
    """Rates and linearisation of the failed arm under one law, without its speed limit, in units of ``1/Ke``."""

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
        """Return commanded rates (N, n) of all joints at q (N, n), errors (N,), m and rad, and (N,) with lengths scaled."""
        outputs = self._rates_kernel.rows(q, pose[:3, 3], pose[:3, :3])
        return outputs[:, :-2], outputs[:, -2], outputs[:, -1]

    def field(self, pose: FloatArray, healthy: BoolArray) -> Callable[[FloatArray], FloatArray]:
        """Return the fastest function of the motion, rates (n,) of q (n,), other joints at rest; not for several threads."""
        n, rates_function = self.law.arm.n, self._rates_kernel.single_row()
        inputs = np.concatenate([np.zeros(n), pose[:3, 3], pose[:3, :3].ravel()])
        healthy_mask = healthy.astype(np.float64)

        def healthy_rates(q: FloatArray) -> FloatArray:
            inputs[:n] = q
            return np.asarray(rates_function(inputs)[:n] * healthy_mask)

        return healthy_rates

    def matrices(self, q: FloatArray, pose: FloatArray, healthy: BoolArray) -> FloatArray:
        """Return the linearisation (N, h, h) of the healthy joints at q (N, n)."""
        jacobians, task_jacobian, scaled_error = self._jacobian_kernel(q, pose[:3, 3], pose[:3, :3])
        # Where the target is reached the rates change by those for -J, as the law is linear there or has no derivative; that
        # of the rotation vector is 0/0 there.
        n, at_target = self.law.arm.n, np.flatnonzero(scaled_error < REACHED_ERROR)
        # Of the error with each joint in turn.
        error_changes = -task_jacobian[at_target].transpose(0, 2, 1).reshape(-1, self.law.task.m)
        rates = self.law.velocity(np.repeat(q[at_target], n, axis=0), error_changes)
        jacobians[at_target] = rates.reshape(-1, n, n).transpose(0, 2, 1)
        return np.asarray(jacobians[:, healthy][:, :, healthy])

    def eigenvalues(self, q: FloatArray, pose: FloatArray, healthy: BoolArray) -> NDArray[np.complex128]:
        """Return the eigenvalues (N, h) by falling real part; NaN where the law is undefined."""
        matrices = self.matrices(q, pose, healthy)
        is_finite = np.isfinite(matrices).all(axis=(1, 2))
        eigenvalues = np.full(matrices.shape[:2], np.nan, dtype=np.complex128)
        if is_finite.any():
            values = np.linalg.eigvals(matrices[is_finite])
            eigenvalues[is_finite] = np.take_along_axis(values, np.argsort(-values.real, axis=1, kind="stable"), axis=1)
        return eigenvalues


@lru_cache(maxsize=16)
def linearisation(law: Law) -> Linearisation:
    """Return the compiled linearisation of a law."""
    return Linearisation(law)
