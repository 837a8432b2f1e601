"""Where what is left of a law ends off its target: another posture, from which it does not when it is followed ahead."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.reaction.masked import MaskedLaw

Array = NDArray[np.float64]

DEPTHS = (0.25, 0.5, 0.75, 1.0)  # of the way of all joints to the middle of their ranges
TURN = np.pi / 2  # rad, of a joint without limits, either way
_PARTS = 16  # of the way to a posture, for the length of the tool's


def postures(arm: Arm, q: Array, mask: Array) -> Array:
    """(K, n) around q (n,), rad and m: joints with a mask of 1 nearer to their middle, or one of them there or beyond."""
    bounded = np.isfinite(arm.lower) & np.isfinite(arm.upper)
    middle = np.where(bounded, np.mean(finite_limits(arm), axis=0), q)
    found = [q + mask * depth * (middle - q) for depth in DEPTHS]
    for j in np.flatnonzero(mask):
        for place in (middle[j], 2 * middle[j] - q[j]) if bounded[j] else (q[j] - TURN, q[j] + TURN):
            found.append(np.where(np.arange(arm.n) == j, place, q))
    return np.array(found)


def better_posture(law: MaskedLaw, q: Array, *, most: Array, fastest: float | None) -> Array | None:
    """The posture (n,) by way of which the target is reached soonest; None if by way of none.

    Args:
        law: What is left of the law.
        q: (n,) where the arm is, rad and m.
        most: (n,) joint rates, rad/s and m/s.
        fastest: m/s, of the tool; None: as fast as the joints.
    """
    arm = law.arm
    tried = postures(arm, np.clip(q, arm.lower, arm.upper), law.mask)
    takes = (np.abs(tried - q) / most).max(axis=1)
    if fastest is not None:
        between = q + np.linspace(0.0, 1.0, _PARTS)[:, None, None] * (tried - q)
        tool = arm.forward_kinematics(between.reshape(-1, arm.n))[:, :3, 3].reshape(_PARTS, -1, 3)
        takes = np.maximum(takes, np.linalg.norm(np.diff(tool, axis=0), axis=-1).sum(axis=0) / fastest)
    takes = takes + law.ahead(tried, most=most)
    best = int(np.argmin(takes))
    return tried[best] if np.isfinite(takes[best]) else None
