"""Check whether a motion is slow enough that only gravity matters, as susceptibilities to free-swinging failures assume.

Source: English and Maciejewski 1998, eq. (5), (6).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm


@dataclass(frozen=True, kw_only=True)
class SlowMotion:
    """Time scale at which a motion is slow enough.

    Attributes:
        time_scale: Smallest factor k such that the motion meets the bound if it takes k times as long, or longer; 0 if it meets
            the bound at any speed.
        worst_joint: Index from 0 of the joint that determines the time scale.
        worst_time_index: Index from 0 of the sample that determines it.
        satisfied: True if ``time_scale <= 1``, so that the motion is slow enough as it is.
    """

    time_scale: float
    worst_joint: int
    worst_time_index: int
    satisfied: bool


@check_arguments
def slow_enough(arm: Arm, q: ArrayLike, qd: ArrayLike, *, qdd: ArrayLike, bound: ArrayLike) -> SlowMotion:
    """Compute the factor by which a motion must be stretched in time for its torques to stay close to the torques at rest.

    If a motion takes k times as long, its rates are divided by k and its accelerations by k^2. Its torques then exceed
    gravity's by ``b / k + a / k^2``, with the friction b and the inertial torque a of the original motion. The largest k at
    which this meets the bound is a root of a quadratic, one for each joint and sample. If friction and inertia oppose each
    other, a faster motion may meet the bound again; this case does not count.

    Args:
        arm: Arm model with inertial data.
        q: (T, n) configurations of the motion, rad and m.
        qd: (T, n) joint rates, rad/s and m/s.
        qdd: (T, n) joint accelerations, rad/s^2 and m/s^2.
        bound: Bound of ``|torque - gravity torque|``, N m and N: a number or (n,), above 0. It may be 0 for a joint without
            friction and inertia.

    Raises:
        ArmError: The mass or inertia of a link is unknown, or impossible for a body.
        InputError: Shapes do not fit, there are no samples, a number is not finite, or no slowness meets the bound.

    Source: English and Maciejewski 1998, eq. (5), (6).
    """
    inertial, viscous, _ = (np.atleast_2d(term) for term in arm.torque_terms(q, qd, qdd))
    if not len(inertial):
        raise InputError("the motion has no samples; give q, qd and qdd with at least one row")
    is_invalid = ~np.isfinite(inertial).all(axis=1)
    if is_invalid.any():
        raise InputError(
            f"the motion holds NaN or infinity at sample {int(is_invalid.argmax())}; all its numbers must be finite"
        )
    limit = _read_bounds(arm, bound)
    loaded = ((inertial != 0) | (viscous != 0)).any(axis=0)
    for joint, joint_bound, is_loaded in zip(arm.joints, limit, loaded, strict=True):
        if is_loaded and joint_bound == 0:
            raise InputError(
                f"the bound of joint '{joint.name}' is 0, but friction or inertia acts on it, so no motion is slow enough; "
                "give a bound above 0"
            )
    joint_bound = np.where(loaded, limit, 1.0)  # the others meet every bound
    scales = _required_time_stretch(viscous / joint_bound, inertial / joint_bound)
    sample, joint_index = np.unravel_index(int(scales.argmax()), scales.shape)
    scale = float(scales.max())
    return SlowMotion(time_scale=scale, worst_joint=int(joint_index), worst_time_index=int(sample), satisfied=scale <= 1)


def _read_bounds(arm: Arm, bound: ArrayLike) -> FloatArray:
    try:
        bounds = np.asarray(bound, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"bound must be a number or {arm.n} numbers, N m and N") from error
    if bounds.shape not in ((), (arm.n,)):
        raise InputError(f"bound has shape {bounds.shape}; it must be a number or ({arm.n},), one per joint")
    if not (bounds >= 0).all():
        raise InputError(f"bound is {bounds.tolist()}; it must be above 0, N m and N")
    return np.broadcast_to(bounds, (arm.n,))


def _required_time_stretch(b: FloatArray, a: FloatArray) -> FloatArray:
    """Return the largest time scale k at which ``|b / k + a / k^2| = 1``; 0 if b and a are 0.

    Signs are chosen so that b is positive: ``k^2 - b k - a = 0`` for +1 and ``k^2 + b k + a = 0`` for -1.
    """
    a, b = np.where(b < 0, -a, a), np.abs(b)
    root = np.sqrt(b**2 + 4 * np.abs(a))
    aligned_root = (b + root) / 2
    # If opposed, inertia dominates in fast motion and friction in slow motion. This form avoids cancellation.
    inertia_root = 2 * np.abs(a) / np.where(b + root > 0, b + root, 1.0)
    discriminant = b**2 - 4 * np.abs(a)
    friction_root = np.where(discriminant > 0, (b + np.sqrt(np.maximum(discriminant, 0))) / 2, 0.0)
    return np.asarray(np.where(a >= 0, aligned_root, np.maximum(inertia_root, friction_root)))
