"""Redundancy resolution laws, which differ in the self-motion."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.validation import check_constructor
from holdfast.kernels.linalg import Cholesky, damped_gram, damped_least_norm
from holdfast.kernels.program import SX
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.path_following.resolution import (
    SINGULAR_REGULARIZATION,
    Resolution,
    gradient_to_maximise,
    null_basis_and_gradient,
    value_to_maximise,
)
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task


@check_constructor
class GradientProjection(Resolution):
    """Self-motion down (or up) the gradient of the objective, projected off the task: ``J^+ v -+ gain (I - J^+ J) grad``.

    At each instant these rates minimise ``dF/dt + w |rates|^2`` under the task (with -F if larger is better), with
    ``w = 1 / (2 gain)``, so the objective and the joint rates form one weighted sum.

    Args:
        arm: Arm model.
        objective: Objective to improve all the time, in its better direction.
        gain: Gain of the gradient, rad/s per unit of the objective and rad.
        task: Task, as for :class:`Resolution`.
        rate_cap: Largest norm of the joint rates, rad/s, as for :class:`Resolution`.
        period: Control period, s, as for :class:`Resolution`.
        damping: Damping factor at a singularity, as for :class:`Resolution`.

    Source: Liegeois 1977; English and Maciejewski 1998, section II.
    """

    name = "gradient projection"
    source = "Liegeois 1977; English and Maciejewski 1998, section II"

    def __init__(
        self,
        arm: Arm,
        objective: Objective,
        gain: float = 1.0,
        *,
        task: str | Task | Sequence[str] | None = None,
        rate_cap: float | None = None,
        period: float | None = 0.01,
        damping: float = 0.05,
    ) -> None:
        super().__init__(arm, objective, task, rate_cap=rate_cap, period=period, damping=damping)
        if not (np.isfinite(gain) and gain >= 0):
            raise InputError(f"gain is {gain:g}; it must be 0 or more, because the objective sets the direction")
        self.gain = gain

    def _desired_self_motion(self, q: SX, jacobian: SX, particular: SX) -> SX:
        return self.gain * gradient_to_maximise(self.objective, q, jacobian)


@check_constructor
class ExtendedJacobian(Resolution):
    """Law that holds the objective at an extremum along the self-motion: the null-space part of its gradient stays 0.

    The rows ``d(N' grad)/dq`` are added to J. If they lose rank although J does not, the tracked extremum ends or splits. This
    is an algorithmic singularity, at which the rates grow without bound.

    Args:
        arm: Arm model.
        objective: Objective to keep at an extremum.
        gain: Gain of the return to the extremum, 1/s.
        task: Task, as for :class:`Resolution`.
        rate_cap: Largest norm of the joint rates, rad/s, as for :class:`Resolution`.
        period: Control period, s, as for :class:`Resolution`.
        damping: Damping factor at a singularity, as for :class:`Resolution`.

    Source: Baillieul 1985; English and Maciejewski 1998, sections II and VI-B.
    """

    name = "extended Jacobian"
    source = "Baillieul 1985; English and Maciejewski 1998, section VI-B"

    def __init__(
        self,
        arm: Arm,
        objective: Objective,
        gain: float = 5.0,
        *,
        task: str | Task | Sequence[str] | None = None,
        rate_cap: float | None = None,
        period: float | None = 0.01,
        damping: float = 0.05,
    ) -> None:
        super().__init__(arm, objective, task, rate_cap=rate_cap, period=period, damping=damping)
        if not (np.isfinite(gain) and gain > 0):
            raise InputError(f"gain is {gain:g}; it must be above 0")
        self.gain = gain

    def _desired_self_motion(self, q: SX, jacobian: SX, particular: SX) -> SX:
        null_space, gradient = null_basis_and_gradient(self.objective, self.task, q)
        gradient_jacobian = ca.jacobian(gradient, q)
        return null_space @ damped_least_norm(
            gradient_jacobian @ null_space, -self.gain * gradient - gradient_jacobian @ particular, SINGULAR_REGULARIZATION
        )


@check_constructor
class AugmentedJacobian(Resolution):
    """Law that brings the objective to a requested value and holds it there; its gradient is one more row of the task.

    Args:
        arm: Arm model.
        objective: Objective to keep at the value.
        wanted: Value of the objective, in its unit. If the path makes it impossible, the law comes as close as damping allows.
        gain: Gain of the approach, 1/s.
        task: Task, as for :class:`Resolution`.
        rate_cap: Largest norm of the joint rates, rad/s, as for :class:`Resolution`.
        period: Control period, s, as for :class:`Resolution`.
        damping: Damping factor at a singularity, as for :class:`Resolution`.

    Source: Egeland 1987; Sciavicco and Siciliano 1988; English and Maciejewski 1998, section II.
    """

    name = "augmented Jacobian"
    source = "Sciavicco and Siciliano 1988; English and Maciejewski 1998, section II"

    def __init__(
        self,
        arm: Arm,
        objective: Objective,
        wanted: float,
        *,
        gain: float = 5.0,
        task: str | Task | Sequence[str] | None = None,
        rate_cap: float | None = None,
        period: float | None = 0.01,
        damping: float = 0.05,
    ) -> None:
        super().__init__(arm, objective, task, rate_cap=rate_cap, period=period, damping=damping)
        if not np.isfinite(wanted):
            raise InputError(f"the wanted value is {wanted:g}; it must be a finite number")
        if not (np.isfinite(gain) and gain > 0):
            raise InputError(f"gain is {gain:g}; it must be above 0")
        self.wanted, self.gain = wanted, gain

    def _desired_self_motion(self, q: SX, jacobian: SX, particular: SX) -> SX:
        sign = 1.0 if self.objective.better == "larger" else -1.0
        gradient = gradient_to_maximise(self.objective, q, jacobian)
        value = value_to_maximise(self.objective, q, jacobian)
        missing = self.gain * (sign * self.wanted - value) - ca.dot(gradient, particular)
        # Least norm within the null space; where the objective does not change, the law has no effect on it.
        projected_gradient = gradient - jacobian.T @ ca.vertcat(
            *Cholesky(damped_gram(jacobian, SINGULAR_REGULARIZATION)).solve(ca.vertsplit(ca.densify(jacobian @ gradient)))
        )
        steepness = ca.sumsqr(projected_gradient)
        return projected_gradient * missing / (steepness + 1e-6 * (steepness + ca.sumsqr(gradient)) + 1e-30)
