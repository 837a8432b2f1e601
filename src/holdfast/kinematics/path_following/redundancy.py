"""The resolution laws, which differ in the self-motion."""

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
    """Self-motion down (or up) the gradient of the objective, kept off the task: ``J^+ v -+ gain (I - J^+ J) grad``.

    At each instant these rates make ``dF/dt + w |rates|^2`` as small as the task allows (of an objective that is better when
    larger, its negative), with ``w = 1 / (2 gain)``: the objective and the joint rates in one weighted sum.

    Args:
        arm: The arm.
        objective: Made better all the time; which way that is, it knows.
        gain: Of the gradient, rad/s per unit of the objective and rad.
        task: As for every law.
        rate_cap: As for every law.
        period: As for every law.
        damping: As for every law.

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
            raise InputError(f"gain is {gain:g}; it must be 0 or more: the objective knows which way is better")
        self.gain = gain

    def _desired_self_motion(self, q: SX, jacobian: SX, particular: SX) -> SX:
        return self.gain * gradient_to_maximise(self.objective, q, jacobian)


@check_constructor
class ExtendedJacobian(Resolution):
    """Law that holds the objective at an extremum along the self-motion: the null-space part of its gradient stays 0.

    The rows ``d(N' grad)/dq`` are added to J. Where they lose rank although J does not, the extremum that is tracked ends
    or splits: an algorithmic singularity, at which the rates grow without bound.

    Args:
        arm: The arm.
        objective: The objective.
        gain: Of the return to the extremum, 1/s.
        task: As for every law.
        rate_cap: As for every law.
        period: As for every law.
        damping: As for every law.

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
    """Law that brings the objective to a requested value and holds it there: its gradient is one more row of the task.

    Args:
        arm: The arm.
        objective: The objective.
        wanted: Its value. The path may make it impossible; then it comes as close as the damping lets it.
        gain: Of the way there, 1/s.
        task: As for every law.
        rate_cap: As for every law.
        period: As for every law.
        damping: As for every law.

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
        # Least norm within the null space; where the objective does not change there, it cannot be helped.
        projected_gradient = gradient - jacobian.T @ ca.vertcat(
            *Cholesky(damped_gram(jacobian, SINGULAR_REGULARIZATION)).solve(ca.vertsplit(ca.densify(jacobian @ gradient)))
        )
        steepness = ca.sumsqr(projected_gradient)
        return projected_gradient * missing / (steepness + 1e-6 * (steepness + ca.sumsqr(gradient)) + 1e-30)
