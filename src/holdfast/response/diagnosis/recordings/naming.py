"""Name the kind of a fault from the two seconds after its alarm, with the causes that the frames do not exclude."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.response.diagnosis.recordings.following import STATISTIC_NAMES, Frames, HealthyBehaviour

POSSIBLE_CAUSES = {
    "stale": ("all readings stopped",),
    "dropped": ("lost frames",),
    "spike": ("spike",),
    "stale joint": ("reading stopped",),
    "slip": ("slip", "contact"),
    "leap": ("offset", "contact"),
    "limp": ("limp",),
    "standing": ("locked", "frozen reading", "contact"),
    "offset": ("offset", "contact", "weak", "friction", "play"),
    "not following": ("friction", "play", "weak", "limp", "contact"),
}
_NAMING_TIME_S = 2.0
_MEMORY_S = 0.5  # a leap of the references acts on the prediction for this time
_PULSE_FRAMES = 4  # after the alarm, within which a pulse ends
_FROZEN_FRAMES = 5
_RETURN_FRACTION = 0.35  # of a leap: a smaller residual afterwards means that the joint is back
_MIN_LEAP_DEG = 2.0
_LEAP_TIME_S = 1 / 6  # before the alarm
_LEAP_FRACTION = 0.6  # of the residual: a leap that explains most of it
_FALL_LIMITS_DEG = (3.0, 5.0, 8.0)  # of the motion, of the motion beyond the prediction, and of the final residual
_MIN_WEIGHT_TORQUE_NM = 0.15
_MAX_STANDING_DEG = 2.2
_MAX_STANDING_FRACTION = 0.15  # of the motion that the reference asks for
_MIN_ASKED_DEG = 3.0
_SLOPE_TOLERANCE = 0.25


def name_fault(
    healthy: HealthyBehaviour, frames: Frames, scores: FloatArray, *, frame: int, threshold: float, weight: FloatArray | None
) -> tuple[int, str, tuple[str, ...]]:
    """Return the joint with the largest score at the alarm, the kind of its fault, and all possible causes.

    Args:
        healthy: Healthy behaviour.
        frames: Frames of the episode.
        scores: (T, 9, n) scores of the frames.
        frame: Frame of the alarm.
        threshold: Score above which an alarm is raised.
        weight: (n,) torque, N m, with which gravity pulls each joint. None: unknown, so that a fall is not named.
    """
    fps = healthy.fps
    joint = int(scores[frame].max(axis=0).argmax())
    of_statistic = dict(zip(STATISTIC_NAMES, scores[:, :, joint].T, strict=True))
    q, predicted = (values[:, joint] / healthy.degree for values in (frames.position, healthy.predict(frames.reference)))
    residual, window = q - predicted, slice(frame, frame + max(2, round(_NAMING_TIME_S * fps)))
    earlier = max(0, frame - round(_MEMORY_S * fps))
    final_residual = float(np.abs(residual[window][-max(2, round(fps / 2)) :]).mean())
    before_alarm = residual[max(0, frame - round(_LEAP_TIME_S * fps)) : frame + 1]
    leap = float(np.abs(np.diff(before_alarm)).max())

    def decide() -> str:
        if (of_statistic["drop"][earlier : frame + 2] > threshold / 2).any():
            return "dropped"
        if (of_statistic["hold"][window] > threshold).any():
            return "stale"
        if (of_statistic["pulse"][frame : frame + _PULSE_FRAMES + 1] > threshold).any():
            return "spike"
        if _returns_from_frozen_reading(q, residual, window, float(healthy.ticks[joint] / healthy.degree)):
            return "stale joint"
        if leap > max(_MIN_LEAP_DEG, _LEAP_FRACTION * np.abs(before_alarm).max()):
            return "slip" if final_residual < _RETURN_FRACTION * leap else "leap"
        asked, moved = float(np.ptp(predicted[earlier : window.stop])), float(np.ptp(q[window]))
        if weight is not None and can_fall:
            fall, excess = ((np.sign(weight[joint]) * (x[window] - x[frame - 1])).max() for x in (q, residual))
            if (np.array([fall, excess, final_residual]) > _FALL_LIMITS_DEG).all():
                return "limp"
        if asked > _MIN_ASKED_DEG and (moved < _MAX_STANDING_DEG or moved < _MAX_STANDING_FRACTION * asked):
            return "standing"
        spread = predicted[window] - predicted[window].mean()
        slope = float(spread @ q[window]) / max(float(spread @ spread), np.finfo(float).tiny)
        rests = np.ptp(predicted[window]) < _MIN_ASKED_DEG
        return "offset" if rests or abs(slope - 1) < _SLOPE_TOLERANCE else "not following"

    can_fall = weight is None or abs(weight[joint]) >= _MIN_WEIGHT_TORQUE_NM
    kind = decide()
    held_by_friction = ("limp",) if kind == "standing" and (weight is None or not can_fall) else ()
    return joint, "offset" if kind == "leap" else kind, (*POSSIBLE_CAUSES[kind], *held_by_friction)


def _returns_from_frozen_reading(q: FloatArray, residual: FloatArray, window: slice, tick: float) -> bool:
    """Return whether a constant reading leaps back to the prediction, within the window or at the alarm."""
    for frame in range(window.start, min(window.stop, len(q))):
        before = abs(residual[frame - 1])
        leaps = before > _MIN_LEAP_DEG and abs(q[frame] - q[frame - 1]) > before / 2
        if leaps and abs(residual[frame]) < _RETURN_FRACTION * before:
            return bool(np.ptp(q[max(0, frame - _FROZEN_FRAMES) : frame]) <= 1.2 * tick)
    return False
