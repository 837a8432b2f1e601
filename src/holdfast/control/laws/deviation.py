"""Deviation of the end effector's velocity from the command at one instant, without failure and with each joint locked.

The controller has no fault information, so the end effector of an arm with joint i locked moves at ``J rates - j_i rates_i``.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (4), (8), (10).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kernels.program import SX

_STILL_SPEED = 1e-12  # fraction of the commanded speed below which a velocity has no direction


@dataclass(frozen=True, kw_only=True)
class Deviations:
    """Velocity errors and angles at N configurations for unit commands; for a single configuration, without the axis N.

    Linear rows of the task are divided by its characteristic length. With an allowed pre-failure error e,

    * the healthy angle is below arcsin(e) for the failure-tolerant inverse, because its error and its velocity make no
      obtuse angle;
    * with joint i locked, the angle is at most arcsin(error i) if that error is below 1, for every law. A peak error below
      0.5 therefore bounds the peak angle by 30 degrees. If the error is 1 or more, nothing follows, and no e bounds the
      peak angle.

    Attributes:
        errors: (N, n) norm of the velocity error with joint i locked, a fraction of the commanded speed.
        angles: (N, n) angle between command and velocity with joint i locked, rad; pi/2 if the end effector does not move.
        still: (N, n) True if the end effector does not move with joint i locked.
        healthy_error: (N,) norm of the velocity error without failure, a fraction of the commanded speed.
        healthy_angle: (N,) angle between command and velocity without failure, rad.
    """

    errors: FloatArray
    angles: FloatArray
    still: BoolArray
    healthy_error: Any
    healthy_angle: Any

    @property
    def peak_velocity_error(self) -> Any:
        """(N,) peak velocity error PKE, eq. (8), which is the largest of ``errors``."""
        return self.errors.max(axis=-1)

    @property
    def peak_angular_deviation(self) -> Any:
        """(N,) peak angular deviation PAD, eq. (10), rad, which is the largest of ``angles``."""
        return self.angles.max(axis=-1)

    @property
    def worst_joint(self) -> Any:
        """(N,) index from 0 of the joint with the largest error; 0 if the errors are NaN."""
        return self.errors.argmax(axis=-1)


def deviation_expression(j: SX, v: SX, rates: SX) -> SX:
    """Return errors, angles, and flags with each joint locked, then error and angle without failure, as one (3 n + 2,) vector.

    Args:
        j: (m, n) scaled task Jacobian.
        v: (m,) scaled task velocity that is commanded.
        rates: (n,) joint rates that are commanded.
    """
    speed = ca.sqrt(ca.sumsqr(v))
    u, unit_rates = v / speed, rates / speed
    tool_velocity = j @ unit_rates
    failed = [_compare_velocities(u, tool_velocity - j[:, joint] * unit_rates[joint]) for joint in range(j.shape[1])]
    healthy = _compare_velocities(u, tool_velocity)
    return ca.vertcat(*[ca.vertcat(*column) for column in zip(*failed, strict=True)], healthy[0], healthy[1])


def _compare_velocities(u: SX, w: SX) -> tuple[SX, SX, SX]:
    """Return the error and angle of a velocity against a unit command, and whether the velocity is zero."""
    parallel = ca.dot(u, w)
    perpendicular = ca.sqrt(ca.sumsqr(w - parallel * u))
    is_still = ca.sumsqr(w) <= _STILL_SPEED**2
    # The arccosine would lose half of the digits of small angles.
    angle = ca.if_else(is_still, np.pi / 2, ca.atan2(perpendicular, parallel))
    return ca.sqrt(ca.sumsqr(u - w)), angle, ca.if_else(is_still, 1.0, 0.0)


def read_deviations(values: FloatArray, n: int) -> Deviations:
    """Return the deviations in the values (3 n + 2,) or (N, 3 n + 2) of :func:`deviation_expression`."""
    return Deviations(
        errors=values[..., :n],
        angles=values[..., n : 2 * n],
        still=values[..., 2 * n : 3 * n] > 0,
        healthy_error=values[..., 3 * n],
        healthy_angle=values[..., 3 * n + 1],
    )
