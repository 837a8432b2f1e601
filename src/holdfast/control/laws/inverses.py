"""Pseudoinverse, weighted and damped inverse."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.laws.law import Law
from holdfast.core.errors import InputError
from holdfast.core.registry import Parameter, constructor
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor
from holdfast.kernels.linalg import damped_least_norm
from holdfast.kernels.program import SX
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, TaskSpec


class Pseudoinverse(Law):
    """Least-norm joint rates, ``J' (J J')^-1 v``; NaN at an exactly singular configuration, without hidden damping.

    Source: Goel et al. 2005, eq. (5).
    """

    name, slug, source = "pseudoinverse", "pseudoinverse", "Goel et al. 2005, eq. (5)"

    def inverse(self, j: SX, v: SX) -> SX:
        """See :meth:`Law.inverse`."""
        return damped_least_norm(j, v, 0.0)

    def quadratic(self) -> tuple[FloatArray, float]:
        """See :meth:`Law.quadratic`."""
        return np.eye(self.arm.n), 0.0


@check_constructor
class Weighted(Law):
    """Joint rates of least weighted norm, ``W^-1 J' (J W^-1 J')^-1 v``.

    Source: Goel et al. 2005, eq. (10).
    """

    name, slug, source = "weighted inverse", "weighted", "Goel et al. 2005, eq. (10)"

    def __init__(
        self,
        arm: Arm,
        weights: ArrayLike,
        task: str | Task | Sequence[str] = "pose",
        *,
        gain: float = 1.0,
        speed_limit: float | None = None,
    ) -> None:
        super().__init__(arm, task, gain, speed_limit=speed_limit)
        weight_matrix = np.asarray(weights, dtype=np.float64)
        weight_matrix = np.diag(weight_matrix) if weight_matrix.ndim == 1 else weight_matrix
        if weight_matrix.shape != (arm.n, arm.n) or not np.isfinite(weight_matrix).all():
            raise InputError(
                f"weights have shape {np.shape(weights)}; they must be ({arm.n},) or ({arm.n}, {arm.n}) finite numbers"
            )
        self.weights = (weight_matrix + weight_matrix.T) / 2
        if not np.allclose(weight_matrix, weight_matrix.T) or np.linalg.eigvalsh(self.weights)[0] <= 0:
            raise InputError("weights must be a symmetric positive definite matrix, or numbers above 0")

    def inverse(self, j: SX, v: SX) -> SX:
        """See :meth:`Law.inverse`."""
        weight_root = np.linalg.inv(np.linalg.cholesky(self.weights)).T  # W^-1 = root root'
        sparse_root = ca.sparsify(ca.SX(ca.DM(weight_root)))
        return sparse_root @ damped_least_norm(j @ sparse_root, v, 0.0)

    def quadratic(self) -> tuple[FloatArray, float]:
        """See :meth:`Law.quadratic`."""
        return np.asarray(np.linalg.inv(self.weights), dtype=np.float64), 0.0

    @property
    def settings(self) -> dict[str, Any]:
        """See :attr:`Law.settings`; a full matrix has no label."""
        diagonal = np.diag(self.weights)
        return {"weights": diagonal if np.array_equal(self.weights, np.diag(diagonal)) else self.weights}

    def phrase(self) -> str:
        """Return the law and its task, without gain and speed limit, for people."""
        joint_weights = self.settings["weights"]
        return (
            f"{super().phrase()}, weights "
            f"{'as a full matrix' if joint_weights.ndim == 2 else ', '.join(f'{weight:g}' for weight in joint_weights)}"
        )


@check_constructor
class Damped(Law):
    """Damped least squares with fixed damping, ``J' (J J' + damping^2 I)^-1 v``.

    Source: Goel et al. 2003, section 2.
    """

    name, slug, source = "damped inverse", "damped", "Goel et al. 2003, section 2"

    def __init__(
        self,
        arm: Arm,
        damping: float,
        task: str | Task | Sequence[str] = "pose",
        *,
        gain: float = 1.0,
        speed_limit: float | None = None,
    ) -> None:
        super().__init__(arm, task, gain, speed_limit=speed_limit)
        if not (np.isfinite(damping) and damping > 0):
            raise InputError(f"damping is {damping:g}; it must be above 0 (for none, use the pseudoinverse)")
        self.fixed_damping = float(damping)

    def inverse(self, j: SX, v: SX) -> SX:
        """See :meth:`Law.inverse`."""
        return damped_least_norm(j, v, self.fixed_damping**2)

    def damping(self, q: ArrayLike, v: ArrayLike) -> Any:
        """See :meth:`Law.damping`."""
        return self._fill_constant(q, v, self.fixed_damping)

    def quadratic(self) -> tuple[FloatArray, float]:
        """See :meth:`Law.quadratic`."""
        return np.eye(self.arm.n), self.fixed_damping**2

    @property
    def settings(self) -> dict[str, Any]:
        """See :attr:`Law.settings`."""
        return {"damping": self.fixed_damping}

    def phrase(self) -> str:
        """Return the law and its task, without gain and speed limit, for people."""
        return f"{super().phrase()}, damping {self.fixed_damping:g}"


def _one_to_n(arm: Arm, task: object) -> FloatArray:
    del task
    return np.arange(1.0, arm.n + 1)


@constructor()
def pseudoinverse(arm: Arm, task: TaskSpec = "pose", gain: float = 1.0, *, speed_limit: float | None = None) -> Pseudoinverse:
    """Least-norm joint rates; Goel et al. 2005, eq. (5)."""
    return Pseudoinverse(arm, task, gain, speed_limit=speed_limit)


@constructor()
def weighted(
    arm: Arm,
    weights: Annotated[ArrayLike, Parameter("1", "one number for each joint", low=0, example="_one_to_n")],
    task: TaskSpec = "pose",
    *,
    gain: float = 1.0,
    speed_limit: float | None = None,
) -> Weighted:
    """Joint rates of least weighted norm; Goel et al. 2005, eq. (10)."""
    return Weighted(arm, weights, task, gain=gain, speed_limit=speed_limit)


@constructor()
def damped(
    arm: Arm,
    damping: Annotated[float, Parameter("m for linear components", "the damping", low=0, example=0.1)],
    task: TaskSpec = "pose",
    *,
    gain: float = 1.0,
    speed_limit: float | None = None,
) -> Damped:
    """Damped least squares with fixed damping; Goel et al. 2003, section 2."""
    return Damped(arm, damping, task, gain=gain, speed_limit=speed_limit)
