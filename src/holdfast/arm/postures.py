"""Which configuration an arm is shown in where none is asked for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arguments import checked
from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm

Array = NDArray[np.float64]

_TRIED = 96
_ENOUGH = 0.25  # of the best score among those tried: an earlier one that has it is taken
_NEVER = 1e-9  # a joint without which less than this is left everywhere is a matter of structure


@checked
def generic_configuration(arm: Arm) -> Array:
    """A configuration (n,), rad and m, in which nothing is special: inside the limits, not singular, no loss by accident.

    The arm's ``home`` where it has one and nothing is special there, else the first sound one of a fixed list around home, or
    around the middle between the limits. Sound means: the Jacobian is well conditioned, and whichever joint locks, as much is
    left as can be expected (relative manipulability, Abdi et al. 2012, eq. (3)); joints that are single points of failure by
    structure do not count. Where it can be had, no joint is behind the plane that the arm is mounted on, across the z axis of
    its base. The same arm gets the same answer.
    """
    low, high = finite_limits(arm)
    wide = np.minimum(high - low, np.where(arm.prismatic, np.inf, 2 * np.pi))
    start = arm.states.get("home", (low + high) / 2)
    edge = 0.05 * (high - low)
    inside = (np.where(np.isfinite(arm.lower), low + edge, -np.inf), np.where(np.isfinite(arm.upper), high - edge, np.inf))
    start = np.clip(start, *inside)
    # Additive recurrence (Roberts 2018): points that fill a cube evenly, the same ones everywhere; first near, then far.
    root = float(np.max(np.real(np.roots([1.0, *[0.0] * (arm.n - 1), -1.0, -1.0]))))
    steps = 2 * ((0.5 + np.arange(1, _TRIED)[:, None] * root ** -np.arange(1.0, arm.n + 1)) % 1.0) - 1
    far = np.linspace(0.04, 0.4, _TRIED - 1)[:, None]
    tried = np.clip(np.vstack([start, start + far * wide * steps]), *inside)
    score = _soundness(arm, tried)
    return np.asarray(tried[np.argmax(score >= _ENOUGH * score.max())])


def _soundness(arm: Arm, q: Array) -> Array:
    """(N,) what there is of manipulability and of what a lock leaves, 0 or more, for configurations (N, n)."""
    jacobian = arm.jacobian(q)
    jacobian[:, :3] /= arm.length_unit
    score = np.ones(len(q))
    for rows in (jacobian[:, :3], jacobian):
        _, sigma, vt = np.linalg.svd(rows, full_matrices=False)
        rank = max(int((sigma > 1e-6 * sigma[:, :1]).sum(axis=1).max()), 1)
        score = np.minimum(score, sigma[:, rank - 1] / np.maximum(sigma[:, 0], 1e-300))
    left = np.sqrt(np.clip(1 - (vt[:, :rank] ** 2).sum(axis=1), 0.0, 1.0))
    counts = left.max(axis=0) > np.sqrt(_NEVER)
    if counts.any():
        score = score * left[:, counts].min(axis=1)
    # What an arm is mounted on is taken to lie across the z axis of its base.
    heights = (arm.frames(q)[:, :, :3, 3] - arm.base[:3, 3]) @ arm.base[:3, 2]
    score = score * np.where(heights.min(axis=1) < -0.02 * arm.length_unit, 0.5, 1.0)
    return np.asarray(score)
