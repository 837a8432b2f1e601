"""Choose an intermediate configuration from which the law with masked joints converges to the target, by forward simulation."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.response.supervisor.masked_law import MaskedLaw

CENTRING_FRACTIONS = (0.25, 0.5, 0.75, 1.0)  # of the motion of all joints to the middle of their ranges
UNLIMITED_STEP_RAD = np.pi / 2  # motion of a joint without limits, in both directions
_PATH_SEGMENTS = 16  # number of configurations that approximate the length of the tool path


def candidate_configurations(arm: Arm, q: FloatArray, mask: FloatArray) -> FloatArray:
    """Return candidates (K, n) near q (n,), rad and m: unmasked joints nearer to their middle, or one of them there
    or beyond.
    """
    bounded = np.isfinite(arm.lower) & np.isfinite(arm.upper)
    middle = np.where(bounded, np.mean(sampling_limits(arm), axis=0), q)
    candidates = [q + mask * depth * (middle - q) for depth in CENTRING_FRACTIONS]
    for joint in np.flatnonzero(mask):
        for value in (
            (middle[joint], 2 * middle[joint] - q[joint])
            if bounded[joint]
            else (q[joint] - UNLIMITED_STEP_RAD, q[joint] + UNLIMITED_STEP_RAD)
        ):
            candidates.append(np.where(np.arange(arm.n) == joint, value, q))
    return np.array(candidates)


def choose_intermediate_configuration(
    law: MaskedLaw, q: FloatArray, *, max_speeds: FloatArray, max_tool_speed: float | None
) -> FloatArray | None:
    """Choose the intermediate configuration (n,) through which the target is reached soonest; None if none reaches it.

    Args:
        law: The law without the braked joints.
        q: (n,) present configuration, rad and m.
        max_speeds: (n,) largest joint rates, rad/s and m/s.
        max_tool_speed: Speed limit of the tool in m/s; None without one.
    """
    arm = law.arm
    candidates = candidate_configurations(arm, np.clip(q, arm.lower, arm.upper), law.mask)
    durations = (np.abs(candidates - q) / max_speeds).max(axis=1)
    if max_tool_speed is not None:
        between = q + np.linspace(0.0, 1.0, _PATH_SEGMENTS)[:, None, None] * (candidates - q)
        tool = arm.forward_kinematics(between.reshape(-1, arm.n))[:, :3, 3].reshape(_PATH_SEGMENTS, -1, 3)
        durations = np.maximum(durations, np.linalg.norm(np.diff(tool, axis=0), axis=-1).sum(axis=0) / max_tool_speed)
    durations = durations + law.predict_time_to_target(candidates, max_speeds=max_speeds)
    best = int(np.argmin(durations))
    return candidates[best] if np.isfinite(durations[best]) else None
