"""Control law of the Jacobian transpose, which follows the gradient of the error and needs no inverse."""

from __future__ import annotations

import casadi as ca

from holdfast.control.laws.law import Law
from holdfast.core.registry import constructor
from holdfast.kernels.program import SX
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import TaskSpec


class JacobianTranspose(Law):
    """Control law with the rates ``a J' v`` and the step ``a = v'J J'v / |J J'v|^2`` that brings ``J rates`` nearest to v.

    The arguments are those of :class:`holdfast.control.laws.Law`.

    Source: Wolovich and Elliott 1984; the step from Buss 2004, section 4.
    """

    name, slug, source = "Jacobian transpose", "jacobian-transpose", "Wolovich and Elliott 1984; Buss 2004"

    def inverse(self, j: SX, v: SX) -> SX:
        """Return the joint rates (n,) along the gradient for the scaled ``j`` (m, n), ``v`` (m,); see :meth:`Law.inverse`."""
        gradient = j.T @ v
        squared_velocity = ca.sumsqr(j @ gradient)
        return (
            ca.if_else(squared_velocity > 0, ca.sumsqr(gradient) / ca.if_else(squared_velocity > 0, squared_velocity, 1.0), 0.0)
            * gradient
        )


@constructor()
def jacobian_transpose(
    arm: Arm, task: TaskSpec = "pose", *, gain: float = 1.0, speed_limit: float | None = None
) -> JacobianTranspose:
    """Make the law of joint rates along the error gradient, with the step of the smallest remaining error; Buss 2004.

    ``arm``, ``task``, ``gain`` and ``speed_limit`` are those of :class:`holdfast.control.laws.Law`.
    """
    return JacobianTranspose(arm, task, gain, speed_limit=speed_limit)
