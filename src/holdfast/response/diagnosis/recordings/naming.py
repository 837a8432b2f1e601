"""Name the kind of a fault from the two seconds after its alarm, with the other kinds that the frames do not exclude."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.response.diagnosis.recordings.following import ARM_STATISTICS, JOINT_STATISTICS

CANDIDATES = {
    "stale": ("stale",),
    "dropped": ("dropped",),
    "spike": ("spike",),
    "stale joint": ("stale joint",),
    "slip": ("slip", "contact"),
    "offset": ("offset", "contact"),
    "limp": ("limp",),
    "standing": ("locked", "frozen reading", "contact"),
    "not following": ("friction", "play", "weak", "limp", "contact"),
}
"""Possible causes of each kind, as far as references and positions can distinguish them."""

NAMING_TIME_S = 2.0
_PULSE = JOINT_STATISTICS.index("pulse")
_HOLD = ARM_STATISTICS.index("hold")
_DROP = ARM_STATISTICS.index("drop")
_PULSE_FRAMES = 4  # after the alarm, within which a pulse ends
_RETURN_FRACTION = 0.35  # of a leap: a smaller residual afterwards means that the joint is back
_MIN_LEAP_DEG = 2.0
_LEAP_TIME_S = 1 / 6  # before the alarm
_LEAP_FRACTION = 0.6  # of the residual: a leap that explains most of it
_MIN_FALL_DEG = 3.0
_MIN_EXCESS_FALL_DEG = 5.0
_MIN_FALL_RESIDUAL_DEG = 8.0
_MIN_WEIGHT_TORQUE_NM = 0.15
_MAX_STANDING_DEG = 2.2
_MAX_STANDING_FRACTION = 0.15
_MIN_ASKED_DEG = 3.0
_LOOK_BACK_S = 0.5  # before the alarm: the memory of the model
_SLOPE_TOLERANCE = 0.25


@dataclass(frozen=True, eq=False)
class Alarm:
    """Alarm of one episode of T frames, with positions and predictions in deg.

    Attributes:
        frame: Frame of the alarm.
        joint: Index of the joint with the largest score.
        position: (T,) positions of this joint.
        predicted: (T,) healthy positions of this joint.
        joint_scores: (T, 7, n) scores of the statistics of joints.
        arm_scores: (T, 2) scores of the statistics of the arm.
        threshold: Score above which an alarm is raised.
        fps: Frames per second.
        tick: Resolution of the position.
        weight: Function that returns the torque, N m, with which gravity pulls the joint at the alarm. None: unknown.
    """

    frame: int
    joint: int
    position: FloatArray
    predicted: FloatArray
    joint_scores: FloatArray
    arm_scores: FloatArray
    threshold: float
    fps: float
    tick: float
    weight: Callable[[], float] | None = None

    def classify(self) -> tuple[str, tuple[str, ...]]:
        """Return the kind of the fault, and all causes that remain possible."""
        end = self.frame + max(2, round(NAMING_TIME_S * self.fps))
        window, ending = slice(self.frame, end), slice(self.frame, self.frame + _PULSE_FRAMES + 1)
        # A leap of the references acts on the prediction for half a second, so it can precede the alarm.
        recent = slice(max(0, self.frame - round(_LOOK_BACK_S * self.fps)), self.frame + 2)
        if (self.arm_scores[recent, _DROP] > self.threshold / 2).any():
            return "dropped", CANDIDATES["dropped"]
        if (self.arm_scores[window, _HOLD] > self.threshold).any():
            return "stale", CANDIDATES["stale"]
        residual = self.position - self.predicted
        if (self.joint_scores[ending, _PULSE, self.joint] > self.threshold).any():
            return "spike", CANDIDATES["spike"]
        if self._returns_from_frozen_reading(residual, window):
            return "stale joint", CANDIDATES["stale joint"]
        at_end = float(np.abs(residual[window][-max(2, round(self.fps / 2)) :]).mean())
        before_alarm = residual[max(0, self.frame - round(_LEAP_TIME_S * self.fps)) : self.frame + 1]
        leap = float(np.abs(np.diff(before_alarm)).max())
        if leap > max(_MIN_LEAP_DEG, _LEAP_FRACTION * np.abs(before_alarm).max()):
            kind = "slip" if at_end < _RETURN_FRACTION * leap else "offset"
            return kind, CANDIDATES[kind]
        return self._classify_motion(window, residual, at_end)

    def _returns_from_frozen_reading(self, residual: FloatArray, window: slice) -> bool:
        """Return whether a constant reading leaps back to the prediction, within the window or at the alarm."""
        for frame in range(window.start, min(window.stop, len(residual))):
            before, change = abs(residual[frame - 1]), abs(self.position[frame] - self.position[frame - 1])
            if before > _MIN_LEAP_DEG and abs(residual[frame]) < _RETURN_FRACTION * before and change > before / 2:
                run = self.position[max(0, frame - max(3, round(self.fps / 6))) : frame]
                return bool(np.ptp(run) <= 1.2 * self.tick)
        return False

    def _classify_motion(self, window: slice, residual: FloatArray, at_end: float) -> tuple[str, tuple[str, ...]]:
        position, predicted = self.position[window], self.predicted[window]
        asked = float(np.ptp(self.predicted[max(0, window.start - round(_LOOK_BACK_S * self.fps)) : window.stop]))
        weight = None if self.weight is None else self.weight()
        can_fall = weight is None or abs(weight) >= _MIN_WEIGHT_TORQUE_NM
        if weight is not None and can_fall:
            fall = np.sign(weight) * (position - self.position[self.frame - 1])
            excess = np.sign(weight) * (residual[window] - residual[self.frame - 1])
            if fall.max() > _MIN_FALL_DEG and excess.max() > _MIN_EXCESS_FALL_DEG and at_end > _MIN_FALL_RESIDUAL_DEG:
                return "limp", CANDIDATES["limp"]
        moved = float(np.ptp(position))
        if asked > _MIN_ASKED_DEG and (moved < _MAX_STANDING_DEG or moved < _MAX_STANDING_FRACTION * asked):
            held_by_friction = ("limp",) if weight is None or not can_fall else ()
            return "standing", (*CANDIDATES["standing"], *held_by_friction)
        spread = predicted - predicted.mean()
        rests = np.ptp(predicted) < _MIN_ASKED_DEG
        if rests or abs(float(spread @ position) / float(spread @ spread) - 1) < _SLOPE_TOLERANCE:
            return "offset", (*CANDIDATES["offset"], "weak", "friction", "play")  # without a leap, these are not excluded
        return "not following", CANDIDATES["not following"]
