"""Choose the default configuration in which an arm is shown."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm

_CANDIDATE_COUNT = 96
_SUFFICIENT_SCORE_FRACTION = 0.25  # of the best score: the first configuration that reaches this fraction is chosen
_STRUCTURAL_LOSS_TOLERANCE = 1e-9  # relative manipulability: a joint is vital by structure if less remains everywhere


@check_arguments
def generic_configuration(arm: Arm) -> FloatArray:
    """Return a generic configuration (n,) of ``arm``, rad and m: within the limits, not singular, without accidental losses.

    It is the arm's ``home`` if this exists and is generic, else the first suitable one of a fixed list around home or around
    the middle between the limits. Suitable means that the Jacobian is well conditioned and that after any single lock the
    relative manipulability (Abdi et al. 2012, eq. (3)) is as large as can be expected; joints that are single points of failure
    by structure do not count. If possible, no joint is behind the mounting plane of the arm, across the z axis of its base. The
    result is the same for the same arm.
    """
    lower, upper = sampling_limits(arm)
    ranges = np.minimum(upper - lower, np.where(arm.prismatic, np.inf, 2 * np.pi))
    start = arm.states.get("home", (lower + upper) / 2)
    margin = 0.05 * (upper - lower)
    finite_lower, finite_upper = np.isfinite(arm.lower), np.isfinite(arm.upper)
    inside = np.where(finite_lower, lower + margin, -np.inf), np.where(finite_upper, upper - margin, np.inf)
    start = np.clip(start, *inside)
    # Additive recurrence (Roberts 2018): fixed points that fill a cube evenly, first near the centre, then far from it.
    generator = float(np.max(np.real(np.roots([1.0, *[0.0] * (arm.n - 1), -1.0, -1.0]))))
    directions = 2 * ((0.5 + np.arange(1, _CANDIDATE_COUNT)[:, None] * generator ** -np.arange(1.0, arm.n + 1)) % 1.0) - 1
    radii = np.linspace(0.04, 0.4, _CANDIDATE_COUNT - 1)[:, None]
    candidates = np.clip(np.vstack([start, start + radii * ranges * directions]), *inside)
    scores = _score_configurations(arm, candidates)
    return np.asarray(candidates[np.argmax(scores >= _SUFFICIENT_SCORE_FRACTION * scores.max())])


def _score_configurations(arm: Arm, q: FloatArray) -> FloatArray:
    """Return scores (N,), 0 or more, of configurations (N, n) by conditioning and manipulability after any lock."""
    jacobian = arm.jacobian(q)
    jacobian[:, :3] /= arm.length_unit
    score = np.ones(len(q))
    for jacobian_rows in (jacobian[:, :3], jacobian):
        _, sigma, vt = np.linalg.svd(jacobian_rows, full_matrices=False)
        rank = max(int((sigma > 1e-6 * sigma[:, :1]).sum(axis=1).max()), 1)
        score = np.minimum(score, sigma[:, rank - 1] / np.maximum(sigma[:, 0], 1e-300))
    remaining = np.sqrt(np.clip(1 - (vt[:, :rank] ** 2).sum(axis=1), 0.0, 1.0))
    is_relevant = remaining.max(axis=0) > np.sqrt(_STRUCTURAL_LOSS_TOLERANCE)
    if is_relevant.any():
        score = score * remaining[:, is_relevant].min(axis=1)
    # The mounting surface is assumed to lie across the z axis of the base.
    heights = (arm.frames(q)[:, :, :3, 3] - arm.base[:3, 3]) @ arm.base[:3, 2]
    score = score * np.where(heights.min(axis=1) < -0.02 * arm.length_unit, 0.5, 1.0)
    return np.asarray(score)
