"""How far the end effector's velocity is from the one commanded, at one instant: healthy, and with each joint locked.

The controller knows of no failure, so the arm with joint i locked moves its end effector by ``J rates - j_i rates_i``.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (4), (8), (10).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.kernels.program import SX

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_STILL = 1e-12  # of the commanded speed: slower has no direction


@dataclass(frozen=True, kw_only=True)
class Deviations:
    """Velocity errors and angles at N configurations, or at one (then without the leading N), for unit commands.

    Linear rows of the task are divided by its characteristic length. With an allowed pre-failure error e,

    * the healthy angle is below arcsin(e) for the failure-tolerant inverse, because its error and its velocity make no
      obtuse angle;
    * with joint i locked, the angle is at most arcsin(error i) where that error is below 1, whatever the law; so a peak
      error below 0.5 bounds the peak angle by 30 degrees. Where it is 1 or more nothing follows, and no e bounds the
      peak angle.

    Attributes:
        errors: (N, n) norm of the velocity error with joint i locked.
        angles: (N, n) angle between command and velocity with joint i locked, rad; pi/2 where the end effector does not move.
        still: (N, n) the end effector does not move with joint i locked.
        healthy_error: (N,) norm of the velocity error without failure.
        healthy_angle: (N,) angle without failure, rad.
    """

    errors: Array
    angles: Array
    still: Flags
    healthy_error: Any
    healthy_angle: Any

    @property
    def peak_velocity_error(self) -> Any:
        """(N,) PKE, eq. (8): the largest of ``errors``."""
        return self.errors.max(axis=-1)

    @property
    def peak_angular_deviation(self) -> Any:
        """(N,) PAD, eq. (10): the largest of ``angles``, rad."""
        return self.angles.max(axis=-1)

    @property
    def worst_joint(self) -> Any:
        """(N,) index from 0 of the joint with the largest error; 0 where that is NaN."""
        return self.errors.argmax(axis=-1)


def expression(j: SX, v: SX, rates: SX) -> SX:
    """Errors, angles and flags with each joint locked, then error and angle without failure: (3 n + 2,).

    Args:
        j: Task Jacobian (m, n), scaled.
        v: Commanded task velocity (m,), scaled.
        rates: (n,) commanded.
    """
    size = ca.sqrt(ca.sumsqr(v))
    u, moved = v / size, rates / size
    hand = j @ moved
    failed = [_compare(u, hand - j[:, i] * moved[i]) for i in range(j.shape[1])]
    healthy = _compare(u, hand)
    return ca.vertcat(*[ca.vertcat(*column) for column in zip(*failed, strict=True)], healthy[0], healthy[1])


def _compare(u: SX, w: SX) -> tuple[SX, SX, SX]:
    """Error and angle of a velocity against a unit command, and whether it is still."""
    along = ca.dot(u, w)
    across = ca.sqrt(ca.sumsqr(w - along * u))
    still = ca.sumsqr(w) <= _STILL**2
    # Not the arccosine, which loses half of the digits of small angles.
    angle = ca.if_else(still, np.pi / 2, ca.atan2(across, along))
    return ca.sqrt(ca.sumsqr(u - w)), angle, ca.if_else(still, 1.0, 0.0)


def read(out: Array, n: int) -> Deviations:
    """What :func:`expression` gave, (3 n + 2,) or (N, 3 n + 2)."""
    return Deviations(
        errors=out[..., :n],
        angles=out[..., n : 2 * n],
        still=out[..., 2 * n : 3 * n] > 0,
        healthy_error=out[..., 3 * n],
        healthy_angle=out[..., 3 * n + 1],
    )
