"""Isolation of the faulty joint and classification of its fault, cycle by cycle after the alarm, with a state of constant size.

Source: derived here; the thresholds were set on other simulated faults than those of the measurements.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm
from holdfast.response.diagnosis.bounds import Bounds
from holdfast.response.diagnosis.gaps import count_cycles
from holdfast.response.diagnosis.kinds import SCALE, FaultClassifier, FaultVerdict
from holdfast.response.diagnosis.observer import FRICTION_TRANSITION_RATE
from holdfast.response.diagnosis.sensors import Sensors

ISOLATION_TIME_S = 0.020  # after the alarm
CLASSIFICATION_TIME_S = 0.100  # after the isolation
SENSOR_REVISION_TIME_S = 0.5  # after the alarm; until then the tool pose may show that a sensor is faulty
POSE_MONITORING_TIME_S = 2.0  # after the alarm; until then the tool pose may identify that sensor
SUSPECT = 1.5  # of the tool threshold: above, the joint sensors contradict the tool pose
WORSE = 28.0  # squared deviations by which every other joint must explain the tool pose worse
_RANK_TOLERANCE = 1e-9  # of the largest: a direction in which a force loads no joint
UNSURE = 0.7  # of a torque threshold: the level follows the residuals while all are below; healthy ones are below 1 / factor
PUSHED = 4.0  # squared deviations by which a force on a link must explain the torques better than one joint


class AlarmDecision:
    """Isolation and classification of the fault behind one alarm.

    Args:
        arm: Monitored arm.
        bounds: Detection thresholds of the healthy arm.
        sensors: Accuracy of the sensors.
        time: Time of the alarm, s.
        level: (n,) level of the residual torques before the alarm, N m and N.
        joints: (n,) mask of the monitored joints.
        torques: True if torques are monitored.
        tool: True if the tool pose is measured.
        tool_alone: True if only the tool pose raised the alarm.
    """

    def __init__(
        self,
        arm: Arm,
        bounds: Bounds,
        sensors: Sensors,
        *,
        time: float,
        level: FloatArray,
        joints: NDArray[np.bool_],
        torques: bool,
        tool: bool,
        tool_alone: bool,
    ) -> None:
        joint_count, period = arm.n, 1 / bounds.rate
        self._arm, self._bounds, self._joint_noise = arm, bounds, sensors.joint
        self._alarm_time, self._residual_level, self._has_torques, self._has_tool = time, level, torques, tool
        self._isolation_cycles = count_cycles(ISOLATION_TIME_S, period)
        self._classification_cycles = count_cycles(ISOLATION_TIME_S + CLASSIFICATION_TIME_S, period)
        self._revision_cycles = count_cycles(SENSOR_REVISION_TIME_S, period)
        self.end_cycle = count_cycles(POSE_MONITORING_TIME_S, period)
        self.count = 0
        self._residual_sizes, self._residual_sum = np.zeros(joint_count), np.zeros(joint_count)
        self.force_advantage = 0.0
        self._classifier: FaultClassifier | None = None
        self._sensor_suspected = tool_alone
        self._pose_weight = np.repeat(1 / np.array([sensors.position, sensors.angle]), 3)
        self._unexplained, self._pose_count = np.where(joints, 0.0, np.inf), 0
        self._residual_deviations = np.where(joints, SCALE * bounds.change, np.inf)
        self._best_joint: tuple[int, float] | None = None

    def add_cycle(
        self,
        q: FloatArray,
        reference: FloatArray,
        signals: tuple[FloatArray, FloatArray, FloatArray, FloatArray],
        scaled_torque: FloatArray,
        scaled_tracking: FloatArray,
    ) -> None:
        """Add the signals of one control cycle.

        Args:
            q: (n,) measured joint positions, rad and m.
            reference: (n,) references of the joints, rad and m.
            signals: (n,) each: rates, residual torques, commanded torques through both filters of these, gravity torques.
            scaled_torque: (n,) residual torques in units of their thresholds.
            scaled_tracking: (n,) tracking errors in units of their thresholds.
        """
        self.count += 1
        if self.count <= self._isolation_cycles:
            sizes = np.maximum(scaled_torque, scaled_tracking) if self._has_torques else scaled_tracking
            self._residual_sizes += np.nan_to_num(sizes)
            self._residual_sum += signals[1]
            if self.count == self._isolation_cycles:
                self._isolate_joint(q)
        elif self._classifier is not None and self.count <= self._classification_cycles:
            joint = self._classifier.joint
            rate, *torques = (float(signal[joint]) for signal in signals)
            slip = float(np.tanh(rate / FRICTION_TRANSITION_RATE))
            self._classifier.add_cycle(float(q[joint]), float(reference[joint]), slip, torques)

    def add_tool_pose(self, scaled_residual: float, residual: FloatArray, jacobian: FloatArray) -> None:
        """Add a sample of the tool pose in the cycle of the last call of :meth:`add_cycle`.

        For each joint, the residual that its column does not explain, ``c = -J_i b``, is accumulated with a separate error
        ``b`` per sample, because a frozen sensor drifts.

        Args:
            scaled_residual: Smoothed residual of the pose, in units of its threshold.
            residual: (6,) pose residual of this sample, m and rad.
            jacobian: (6, n) Jacobian at this sample.
        """
        if self.count <= self._revision_cycles and scaled_residual > SUSPECT:
            self._sensor_suspected = True
        if self._best_joint is not None and self._best_joint[1] > WORSE:
            return
        scaled, columns = residual * self._pose_weight, jacobian * self._pose_weight[:, None]
        self._unexplained += scaled @ scaled - (scaled @ columns) ** 2 / np.maximum((columns**2).sum(axis=0), 1e-300)
        self._pose_count += 1
        if self._pose_count > 1 and self._arm.n > 1:
            best, second = np.partition(self._unexplained, 1)[:2]
            self._best_joint = int(self._unexplained.argmin()), float(second - best)
        elif self._pose_count > 1:
            self._best_joint = 0, np.inf

    def _isolate_joint(self, q: FloatArray) -> None:
        """Select the joint with the largest residuals, and compare it with a force on a link as their cause."""
        if self._has_torques:
            residual_change = self._residual_sum / self._isolation_cycles - self._residual_level
            self.force_advantage = _force_advantage(self._arm, q, residual_change, self._residual_deviations)
        joint, bounds = int(self._residual_sizes.argmax()), self._bounds
        self._classifier = FaultClassifier(
            joint,
            coulomb=float(bounds.coulomb[joint]),
            bounds=(float(bounds.torque[joint]), float(bounds.tracking[joint])),
            largest=float(bounds.torque[joint] / bounds.factor),
            noise=self._joint_noise,
            torques=self._has_torques,
        )

    def current_verdict(self, *, last: bool = False) -> FaultVerdict:
        """Return the verdict from the cycles so far.

        Args:
            last: True if no more cycles follow, so that the decision uses the cycles so far.
        """
        if self._sensor_suspected and (self.count >= self._isolation_cycles or last):
            return self._sensor_verdict()
        # The only joint that was above its threshold, on average over the cycles that isolate it.
        above_bound = np.flatnonzero(self._residual_sizes > self._isolation_cycles)
        suspect = self._arm.joint_names[above_bound[0]] if above_bound.size == 1 else None
        classifier = self._classifier
        if self.force_advantage > PUSHED and not (classifier is not None and classifier.exceeds_external_force_error):
            contact: dict[str, Any] = {"kind": "contact", "candidates": ("contact",)}
            contact["evidence"] = ("a force on a link explains all rows",)
            return FaultVerdict(True, self._alarm_time, suspect=suspect, **contact)
        if classifier is None:
            largest = self._arm.joint_names[int(self._residual_sizes.argmax())]
            return FaultVerdict(True, self._alarm_time, joint=largest if last and self.count else None)
        joint = self._arm.joints[classifier.joint]
        if self.count < self._classification_cycles and not last:
            return FaultVerdict(True, self._alarm_time, joint=joint.name)
        mean_sizes = self._residual_sizes / self._isolation_cycles
        size, next_largest = mean_sizes[classifier.joint], np.delete(mean_sizes, classifier.joint).max(initial=0.0)
        reason = f"its residuals are {size:.3g} times their thresholds, those of the next joint {next_largest:.3g}"
        classification: dict[str, Any] = classifier.classify(joint.unit, () if self._has_tool else ("sensor",))
        classification["evidence"] = (reason, *classification["evidence"])
        culprit: dict[str, Any] = {"suspect": suspect} if classification["kind"] == "contact" else {"joint": joint.name}
        return FaultVerdict(True, self._alarm_time, **culprit, **classification)

    def _sensor_verdict(self) -> FaultVerdict:
        """Return the verdict on the joint whose sensor error would explain the tool pose."""
        evidence, joint = ["the measured tool pose contradicts the joint sensors"], None
        if self._best_joint is not None:
            best_joint, advantage = self._best_joint
            if advantage > WORSE:
                joint = self._arm.joint_names[best_joint]
                evidence.append(f"the next joint explains its pose worse by {advantage:.3g} squared deviations")
            else:
                first, second = np.argsort(self._unexplained)[:2]
                evidence.append(f"{self._arm.joint_names[first]} and {self._arm.joint_names[second]} both explain its pose")
        candidates, reasons = ("sensor", "slipping_clutch"), tuple(evidence)
        return FaultVerdict(True, self._alarm_time, joint=joint, kind="sensor", candidates=candidates, evidence=reasons)


def _force_advantage(arm: Arm, q: FloatArray, residual_change: FloatArray, scale: FloatArray) -> float:
    """Return by how many squared deviations a force at the far end of a link explains residual torques better than one joint.

    The arm is at q (n,); ``residual_change`` (n,) is the change of the residual torques and ``scale`` (n,) their deviation, N m
    and N.
    """
    ends, jacobian, scaled_change = arm.frames(q)[2:, :3, 3], arm.jacobian(q), residual_change / scale
    smallest_error = np.inf
    for index, end in enumerate(ends):
        columns = (jacobian[:3] + np.cross(jacobian[3:].T, end - ends[-1]).T).T / scale[:, None]
        columns[index + 1 :] = 0.0  # the force loads only the joints that carry the link
        force = np.linalg.lstsq(columns, scaled_change, rcond=_RANK_TOLERANCE)[0]
        smallest_error = min(smallest_error, float(((scaled_change - columns @ force) ** 2).sum()))
    return float((scaled_change**2).sum() - (scaled_change**2).max() - smallest_error)
