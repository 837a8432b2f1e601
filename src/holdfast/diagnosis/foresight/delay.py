"""How soon after it locks a joint is noticed: predicted from the motion that is asked of it and from its servo."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.diagnosis.bounds import Bounds
from holdfast.diagnosis.observer import BAND, GAIN, excess, low_passed
from holdfast.diagnosis.signals import LIMITS
from holdfast.errors import InputError

Array = NDArray[np.float64]


@checked
def expected_delays(
    bounds: Bounds, reference: ArrayLike, *, stiffness: ArrayLike, damping: ArrayLike, onset: float = 0.0
) -> Array:
    """(n,) s from a lock of each joint to its alarm; infinite where the motion ends before.

    A joint that locks falls behind its reference by ``d``, and its servo asks ``K d + D d'`` more of it. That torque, filtered
    as the observer filters, is the residual; the first of torque and tracking whose excess is long enough alarms.

    Args:
        bounds: Of the healthy arm.
        reference: (T, n) rad and m, at the rate of the bounds.
        stiffness: (n,) K of the servos, N m/rad and N/m.
        damping: (n,) D, N m s/rad and N s/m.
        onset: s, of the lock.

    Raises:
        InputError: Another number of joints, or an onset beyond the motion.

    Source: derived here. What friction and a healthy lag add is left out: measured delays are 0.6 to 1.2 times these.
    """
    motion, dt = np.asarray(reference, dtype=np.float64), 1 / bounds.rate
    n = len(bounds.joints)
    if motion.ndim != 2 or motion.shape[1] != n:
        raise InputError(f"reference has shape {motion.shape}; it must be (T, {n}), a row for each time")
    first = round(onset / dt)
    if not 0 <= first < len(motion) - 1:
        raise InputError(f"onset is {onset:g} s; it must lie within the motion of {len(motion) * dt:g} s")
    behind = motion[first:] - motion[first]
    asked = np.asarray(stiffness) * behind + np.asarray(damping) * np.gradient(motion, dt, axis=0)[first:]
    asked[0] = 0.0
    none = np.zeros(n)
    residual = low_passed(low_passed(asked, dt, BAND, none), dt, GAIN, none)
    parts = {"torque": np.abs(residual) / bounds.torque, "tracking": np.abs(behind) / bounds.tracking}
    over = np.any([excess(value, dt) > LIMITS[name] for name, value in parts.items()], axis=0)
    return np.asarray(np.where(over.any(axis=0), over.argmax(axis=0) * dt, np.inf))
