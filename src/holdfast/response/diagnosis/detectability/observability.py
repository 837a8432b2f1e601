"""Predict which single locked joints a motion makes detectable, with which delay, and which of them are not separable."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm
from holdfast.response.diagnosis.bounds import Bounds
from holdfast.response.diagnosis.detectability.delay import expected_delays
from holdfast.response.diagnosis.detectability.motions import resample_motion
from holdfast.response.diagnosis.detectability.probe import PLAN_RATE_HZ
from holdfast.response.diagnosis.detectability.separation import hypothesis_separations, inseparable_pairs, undetectable_joints
from holdfast.response.diagnosis.sensors import Sensors

_ONSET_COUNT = 40  # times along the motion at which a joint may lock
_SERVO_BANDWIDTH_RAD_S = 2 * np.pi * 10  # rad/s, of the default servos
_MOVING_FRICTION_FACTOR = 2.0  # times dry friction: gravity torque that moves a joint whose motor is dead


@dataclass(frozen=True, eq=False, kw_only=True)
class Observability(Result):
    """Detectability of locked joints on a motion. Hypothesis 0 is that no joint is locked.

    Attributes:
        arm: Arm of the motion.
        duration: Duration of the motion, s.
        separation: (n + 1, n + 1) separation of the hypotheses by the measured tool pose, in nats, if the lock is present from
            the beginning. Hypotheses above 9.2 are separable.
        delays: (K, n) time in s from a lock at one of K times of the motion to its alarm by joint sensors and torques;
            infinite without an alarm. None without thresholds.
        strayed: (K, n) position error of the tool at the time of that alarm, m. None without thresholds.
        alike: Joints whose lock looks like a dead motor that friction holds. None without thresholds.
    """

    arm: Arm
    duration: float
    separation: FloatArray
    delays: FloatArray | None
    strayed: FloatArray | None
    alike: tuple[str, ...] | None

    @cached_property
    def unseen(self) -> tuple[str, ...]:
        """Joints whose lock the tool's pose does not reveal."""
        return tuple(self.arm.joint_names[joint] for joint in undetectable_joints(self.separation, range(self.arm.n)))

    @cached_property
    def inseparable(self) -> tuple[tuple[str, str], ...]:
        """Pairs of joints whose locks the tool's pose reveals but does not distinguish."""
        names = self.arm.joint_names
        return tuple((names[first], names[second]) for first, second in inseparable_pairs(self.separation, range(self.arm.n)))


@check_arguments
@reports_progress("predicting detections")
def predict_detection(
    arm: Arm,
    motion: ArrayLike,
    *,
    rate: float = 1000.0,
    sensors: Sensors | None = None,
    bounds: Bounds | None = None,
    stiffness: ArrayLike | None = None,
    damping: ArrayLike | None = None,
) -> Observability:
    """Predict which locks of single joints a motion makes detectable, before the arm executes it.

    Args:
        arm: Arm that will execute the motion.
        motion: (T, n) references, rad and m.
        rate: Sample rate of the motion, Hz.
        sensors: Accuracy of the measured tool pose, with 100 samples per second. Default: ``Sensors()``.
        bounds: Detection thresholds of the healthy arm. With them, detection delays by joint sensors and torques are computed.
        stiffness: (n,) stiffness of the servos, N m/rad and N/m. Default: servos of 10 Hz.
        damping: (n,) damping of the servos, N m s/rad and N s/m. Default: servos of 10 Hz.

    Raises:
        InputError: The number of joints differs, there are fewer than two samples, the thresholds are of another arm, or only
            one of stiffness and damping is given.
        ArmError: Thresholds are given without stiffness, and inertial data are missing or impossible.

    Source: derived here; see :func:`holdfast.response.diagnosis.expected_delays` and
        :func:`holdfast.response.diagnosis.plan_identification`.
    """
    references = arm.check_configurations(motion)
    if references.ndim != 2 or len(references) < 2 or not rate > 0:
        raise InputError(
            f"motion has shape {references.shape} at {rate:g} Hz; it must be two configurations or more, and a rate above 0"
        )
    if (stiffness is None) != (damping is None):
        raise InputError("only one of stiffness and damping is given; give both, or neither")
    sampled = resample_motion(references, rate, PLAN_RATE_HZ) if rate > PLAN_RATE_HZ else references
    duration = (len(references) - 1) / rate
    delays = strayed = alike = None
    if bounds is not None:
        bounds.require(arm, bounds.rate)
        references = resample_motion(references, rate, bounds.rate)
        torques = bool(np.isfinite(bounds.torque).all())
        if stiffness is None and torques:
            inertia = arm.inertia_diagonal(sampled).max(axis=0)
            stiffness, damping = _SERVO_BANDWIDTH_RAD_S**2 * inertia, 2 * _SERVO_BANDWIDTH_RAD_S * inertia
        elif stiffness is None:
            stiffness = damping = np.zeros(arm.n)
        onsets = np.unique(np.linspace(0, 0.9 * (len(references) - 2), _ONSET_COUNT).astype(int))
        gains: dict[str, Any] = {"stiffness": stiffness, "damping": damping}
        delays = np.array([expected_delays(bounds, references, **gains, onset=onset / bounds.rate) for onset in onsets])
        strayed = _tool_errors(arm, references, onsets, np.where(np.isfinite(delays), delays, 0.0) * bounds.rate)
        if torques:
            has_small_gravity = np.abs(arm.gravity_torque(sampled)).max(axis=0) < _MOVING_FRICTION_FACTOR * bounds.coulomb
            alike = tuple(arm.joint_names[joint] for joint in np.flatnonzero(has_small_gravity))
    return Observability(
        arm=arm,
        duration=duration,
        separation=hypothesis_separations(arm, sampled, sensors or Sensors()),
        delays=delays,
        strayed=strayed,
        alike=alike,
    )


def _tool_errors(arm: Arm, q: FloatArray, onsets: NDArray[np.int64], delay_rows: FloatArray) -> FloatArray:
    """Return the tool position errors (K, n), m, a given number of samples after each joint locked."""
    errors = np.zeros(delay_rows.shape)
    for index, onset in enumerate(onsets):
        rows = np.minimum(onset + np.round(delay_rows[index]).astype(int), len(q) - 1)
        locked = q[rows].copy()
        np.fill_diagonal(locked, q[onset])
        displacements = arm.forward_kinematics(locked)[:, :3, 3] - arm.forward_kinematics(q[rows])[:, :3, 3]
        errors[index] = np.linalg.norm(displacements, axis=1)
    return errors
