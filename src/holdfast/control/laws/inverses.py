"""Control laws that invert the task Jacobian: pseudoinverse, weighted inverse, and damped inverse."""

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
    """Control law with the joint rates of least norm, ``J' (J J')^-1 v``.

    At an exactly singular configuration the rates are NaN, because the law contains no hidden damping.
    The arguments are those of :class:`holdfast.control.laws.Law`.

    Source: Goel et al. 2005, eq. (5).
    """

    name, slug, source = "pseudoinverse", "pseudoinverse", "Goel et al. 2005, eq. (5)"

    def inverse(self, j: SX, v: SX) -> SX:
        """Return the joint rates (n,) of least norm for the scaled ``j`` (m, n) and ``v`` (m,); see :meth:`Law.inverse`."""
        return damped_least_norm(j, v, 0.0)

    def quadratic(self) -> tuple[FloatArray, float]:
        """Return the matrix ``A`` (n, n) and the number ``d`` of the law; see :meth:`Law.quadratic`."""
        return np.eye(self.arm.n), 0.0


@check_constructor
class Weighted(Law):
    """Control law with the joint rates of least weighted norm, ``W^-1 J' (J W^-1 J')^-1 v``.

    Args:
        arm: The arm.
        weights: (n,) weights above 0, or (n, n) symmetric positive definite matrix W. A larger weight slows its joint down.
        task, gain, speed_limit: Task, gain and speed limit, as for every :class:`holdfast.control.laws.Law`.

    Raises:
        InputError: The weights have a wrong shape or are not positive.

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
        """Return the joint rates (n,) of least weighted norm for ``j`` (m, n), ``v`` (m,); see :meth:`Law.inverse`."""
        weight_root = np.linalg.inv(np.linalg.cholesky(self.weights)).T  # W^-1 = root root'
        sparse_root = ca.sparsify(ca.SX(ca.DM(weight_root)))
        return sparse_root @ damped_least_norm(j @ sparse_root, v, 0.0)

    def quadratic(self) -> tuple[FloatArray, float]:
        """Return the matrix ``A`` (n, n) and the number ``d`` of the law; see :meth:`Law.quadratic`."""
        return np.asarray(np.linalg.inv(self.weights), dtype=np.float64), 0.0

    @property
    def settings(self) -> dict[str, Any]:
        """Weights of the law, (n,) or (n, n), by the name of the argument; a law with a full matrix has no label."""
        diagonal = np.diag(self.weights)
        return {"weights": diagonal if np.array_equal(self.weights, np.diag(diagonal)) else self.weights}

    def phrase(self) -> str:
        """Return a phrase that names the law, its settings, and its task, without gain and speed limit."""
        joint_weights = self.settings["weights"]
        return (
            f"{super().phrase()}, weights "
            f"{'as a full matrix' if joint_weights.ndim == 2 else ', '.join(f'{weight:g}' for weight in joint_weights)}"
        )


@check_constructor
class Damped(Law):
    """Control law with damped least squares and fixed damping, ``J' (J J' + damping^2 I)^-1 v``.

    Args:
        arm: The arm.
        damping: Damping factor above 0, not its square, in the unit of the scaled Jacobian (m for a position task).
        task, gain, speed_limit: Task, gain and speed limit, as for every :class:`holdfast.control.laws.Law`.

    Raises:
        InputError: The damping is not above 0.

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
        """Return the damped joint rates (n,) for the scaled ``j`` (m, n) and ``v`` (m,); see :meth:`Law.inverse`."""
        return damped_least_norm(j, v, self.fixed_damping**2)

    def damping(self, q: ArrayLike, v: ArrayLike) -> Any:
        """Return the fixed damping at each ``q`` (N, n) and ``v`` (N, m), or NaN; see :meth:`Law.damping`."""
        return self._fill_constant(q, v, self.fixed_damping)

    def quadratic(self) -> tuple[FloatArray, float]:
        """Return the matrix ``A`` (n, n) and the number ``d`` of the law; see :meth:`Law.quadratic`."""
        return np.eye(self.arm.n), self.fixed_damping**2

    @property
    def settings(self) -> dict[str, Any]:
        """Damping of the law, by the name of the argument."""
        return {"damping": self.fixed_damping}

    def phrase(self) -> str:
        """Return a phrase that names the law, its settings, and its task, without gain and speed limit."""
        return f"{super().phrase()}, damping {self.fixed_damping:g}"


def _one_to_n(arm: Arm, task: object) -> FloatArray:
    del task
    return np.arange(1.0, arm.n + 1)


@constructor()
def pseudoinverse(arm: Arm, task: TaskSpec = "pose", gain: float = 1.0, *, speed_limit: float | None = None) -> Pseudoinverse:
    """Make the control law with the joint rates of least norm; Goel et al. 2005, eq. (5).

    ``arm``, ``task``, ``gain`` and ``speed_limit`` are those of :class:`holdfast.control.laws.Law`.
    """
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
    """Make the control law with the joint rates of least weighted norm; Goel et al. 2005, eq. (10).

    ``arm``, ``weights``, ``task``, ``gain`` and ``speed_limit`` are those of :class:`holdfast.control.laws.Weighted`.
    """
    return Weighted(arm, weights, task, gain=gain, speed_limit=speed_limit)


@constructor()
def damped(
    arm: Arm,
    damping: Annotated[float, Parameter("m for linear components", "damping factor", low=0, example=0.1)],
    task: TaskSpec = "pose",
    *,
    gain: float = 1.0,
    speed_limit: float | None = None,
) -> Damped:
    """Make the control law of damped least squares with fixed damping; Goel et al. 2003, section 2.

    ``arm``, ``damping``, ``task``, ``gain`` and ``speed_limit`` are those of :class:`holdfast.control.laws.Damped`.
    """
    return Damped(arm, damping, task, gain=gain, speed_limit=speed_limit)
