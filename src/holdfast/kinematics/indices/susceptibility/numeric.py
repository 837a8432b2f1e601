"""Objectives whose value and gradient need an iteration, which no symbolic program contains."""

from __future__ import annotations

from abc import abstractmethod

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.typing import FloatArray
from holdfast.kernels.linalg import HouseholderQR
from holdfast.kernels.program import SX
from holdfast.kinematics.indices.objective import Objective, ObjectivePart
from holdfast.model.arm.configurations import as_configurations


class NumericObjective(Objective):
    """Objective of which :meth:`measure` computes the value and the gradient together; smaller is better."""

    @abstractmethod
    def measure(self, q: FloatArray) -> FloatArray:
        """Return values and gradients, (N, 1 + n), at ``q`` (N, n), rad and m."""

    @cached_property
    def measured(self) -> SX | None:
        """Symbols of the value and the gradient."""
        return ca.SX.sym("measured", 1 + self.arm.n)

    def __call__(self, q: ArrayLike) -> FloatArray:
        """Return the value, (N,) or a scalar, at ``q`` (N, n) or (n,), rad and m."""
        rows, single = as_configurations(self.arm, q)
        value = self.measure(rows)[:, 0]
        return np.asarray(value[0]) if single else value

    def gradient(self, q: ArrayLike) -> FloatArray:
        """Return the exact gradient at ``q`` (N, n) or (n,), of the same shape, per rad and m."""
        rows, single = as_configurations(self.arm, q)
        gradient = self.measure(rows)[:, 1:]
        return gradient[0] if single else gradient

    def parts(self, q: SX, j: SX, qr: HouseholderQR, directions: list[SX]) -> list[ObjectivePart]:
        """Return minus the value and its slopes; arguments as for other objectives."""
        del q, j, qr
        symbols = ca.SX(self.measured)
        return [ObjectivePart(1.0, [-symbols[0]], [[-ca.dot(symbols[1:], direction) for direction in directions]])]
