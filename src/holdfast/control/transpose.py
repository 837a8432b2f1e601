"""The Jacobian transpose: along the slope of the error, no inverse at all."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.control.law import Law
from holdfast.kernels.program import SX
from holdfast.registry import constructor

TaskSpec = str | Task | Sequence[str]


class JacobianTranspose(Law):
    """Joint rates ``a J' v`` with the step ``a = v'J J'v / |J J'v|^2`` that brings ``J rates`` nearest to v.

    Source: Wolovich and Elliott 1984; the step from Buss 2004, section 4.
    """

    name, slug, source = "Jacobian transpose", "jacobian-transpose", "Wolovich and Elliott 1984; Buss 2004"

    def inverse(self, j: SX, v: SX) -> SX:
        """See :meth:`Law.inverse`."""
        slope = j.T @ v
        square = ca.sumsqr(j @ slope)
        return ca.if_else(square > 0, ca.sumsqr(slope) / ca.if_else(square > 0, square, 1.0), 0.0) * slope


@constructor()
def jacobian_transpose(
    arm: Arm, task: TaskSpec = "pose", *, gain: float = 1.0, speed_limit: float | None = None
) -> JacobianTranspose:
    """Joint rates along the slope of the error, with the step that leaves the least of it; Buss 2004."""
    return JacobianTranspose(arm, task, gain, speed_limit=speed_limit)
