"""Predict the detection delay of a locked joint from its commanded motion and its servo."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.response.diagnosis.bounds import Bounds
from holdfast.response.diagnosis.observer import FILTER_BANDWIDTH_RAD_S, OBSERVER_GAIN_PER_S, accumulate_excess, low_pass
from holdfast.response.diagnosis.signals import EXCESS_LIMITS_S


@check_arguments
def expected_delays(
    bounds: Bounds, reference: ArrayLike, *, stiffness: ArrayLike, damping: ArrayLike, onset: float = 0.0
) -> FloatArray:
    """Return the time (n,) in s from a lock of each joint to its alarm; infinite where the motion ends before the alarm.

    A locked joint falls behind its reference by ``d``, and its servo adds a torque of ``K d + D d'``. This torque, filtered
    like the signals of the observer, is the residual. The alarm is raised by the first of torque and tracking error whose
    accumulated excess reaches its limit.

    Args:
        bounds: Detection thresholds of the healthy arm.
        reference: (T, n) references, rad and m, at the rate of the thresholds.
        stiffness: (n,) stiffness K of the servos, N m/rad and N/m.
        damping: (n,) damping D of the servos, N m s/rad and N s/m.
        onset: Time of the lock, s.

    Raises:
        InputError: The number of joints differs, or the onset is beyond the motion.

    Source: derived here. Friction and a healthy lag are neglected; measured delays are 0.6 to 1.2 times these.
    """
    motion, period = np.asarray(reference, dtype=np.float64), 1 / bounds.rate
    joint_count = len(bounds.joints)
    if motion.ndim != 2 or motion.shape[1] != joint_count:
        raise InputError(f"reference has shape {motion.shape}; it must be (T, {joint_count}), one row per sample")
    onset_row = round(onset / period)
    if not 0 <= onset_row < len(motion) - 1:
        raise InputError(f"onset is {onset:g} s; it must lie within the motion of {len(motion) * period:g} s")
    tracking_error = motion[onset_row:] - motion[onset_row]
    servo_torque = (
        np.asarray(stiffness) * tracking_error + np.asarray(damping) * np.gradient(motion, period, axis=0)[onset_row:]
    )
    servo_torque[0] = 0.0
    zeros = np.zeros(joint_count)
    residual = low_pass(low_pass(servo_torque, period, FILTER_BANDWIDTH_RAD_S, zeros), period, OBSERVER_GAIN_PER_S, zeros)
    scaled_residuals = {"torque": np.abs(residual) / bounds.torque, "tracking": np.abs(tracking_error) / bounds.tracking}
    alarms = np.any(
        [accumulate_excess(value, period) > EXCESS_LIMITS_S[name] for name, value in scaled_residuals.items()], axis=0
    )
    return np.asarray(np.where(alarms.any(axis=0), alarms.argmax(axis=0) * period, np.inf))
