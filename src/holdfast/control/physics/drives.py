"""The drives of a simulated robot: a velocity loop inside each motor, and a position loop in the control cycle around it."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray

OBSERVER_RAD_S = 2 * np.pi * 20  # bandwidth with which an error of the joint sensors reaches the velocity loop


class Drives:
    """The cascaded loops of a robot's drives, which turn references into torques.

    In each control cycle the position loop asks every motor for the torque

        K (reference - measured position) + D (reference rate - rate error) + gravity torque,

    and from it the drive subtracts ``D`` times the joint's rate by itself, much faster than the control cycle: the bodies of
    :meth:`holdfast.Body.model` have this damping inside MuJoCo, whose integrator is implicit in it. With any K and D above 0
    that loop is passive, so joints that share an axis, and together are much lighter than one alone, stay stable.

    The rate error is the derivative of the joint sensors' error (noise, quantisation, a sensor fault), filtered at 20 Hz. So
    the noise of the sensors reaches the motors, but not as a difference of two samples 1 ms apart.

    Args:
        stiffness: (..., n) K of each joint, N m/rad and N/m.
        damping: (..., n) D, N m s/rad and N s/m.
        effort: (n,) largest torque of each motor, N m and N.
        period: Control cycle in seconds.
    """

    def __init__(self, stiffness: FloatArray, damping: FloatArray, *, effort: FloatArray, period: float) -> None:
        self.stiffness, self.damping, self._effort, self._period = stiffness, damping, effort, period
        self._filter_fraction = min(1.0, OBSERVER_RAD_S * period)
        self.rate_error, self._sensor_error = np.zeros_like(stiffness), np.zeros_like(stiffness)

    def update_rate_error(self, measured: FloatArray, true: FloatArray) -> None:
        """Update the rate error from measured and true positions (..., n) of this cycle, rad and m."""
        error = measured - true
        self.rate_error = self.rate_error + self._filter_fraction * (
            (error - self._sensor_error) / self._period - self.rate_error
        )
        self._sensor_error = error

    def compute_motor_controls(
        self, reference: FloatArray, rates: FloatArray, measured: FloatArray, *, gravity: FloatArray, velocity: FloatArray
    ) -> FloatArray:
        """Compute the controls (..., n) of the motors, N m and N, from which the drives subtract ``D`` times the velocity.

        The drive limits the sum to the effort before the motor makes a torque of it, so a weak motor is asked for no more
        than a healthy one.
        """
        requested_torque = self.stiffness * (reference - measured) + self.damping * (rates - self.rate_error) + gravity
        damping_torque = self.damping * velocity
        return np.minimum(np.maximum(requested_torque, damping_torque - self._effort), damping_torque + self._effort)

    def compute_mean_torque(self, command: FloatArray, moved: FloatArray) -> FloatArray:
        """Compute the mean torque (..., n) of a cycle, N m and N, in which the joints moved (..., n), rad and m."""
        return np.clip(command - self.damping * (moved / self._period), -self._effort, self._effort)
