"""Condition of an arm and its joints after faults, which the controller keeps from one state to the next."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import rotation_vectors
from holdfast.model.failure_modes import Degraded
from holdfast.response.diagnosis.bounds import Bounds
from holdfast.response.supervisor import thresholds


@dataclass
class Pace:
    """Speed of the arm as fractions of the commanded speed."""

    target: float = 1.0  # fraction that the arm approaches
    current: float = 0.0  # present fraction
    allowed: float = 1.0  # largest fraction with the failures so far

    def ramp(self, dt: float) -> None:
        """Move the present fraction towards its target for dt s."""
        self.current += min(max(self.target - self.current, -thresholds.PACE_RATE_PER_S * dt), thresholds.PACE_RATE_PER_S * dt)


@dataclass(frozen=True)
class JointMotion:
    """Motion of one joint in a control cycle."""

    tracking_error: float  # reference minus position in rad or m
    tracking_bound: float  # bound of the monitor for the tracking error in rad or m
    v: float  # measured rate in rad/s or m/s
    commanded_rate: float  # commanded rate in rad/s or m/s

    @property
    def tracking_ratio(self) -> float:
        """Size of the tracking error divided by its bound."""
        return abs(self.tracking_error) / self.tracking_bound

    def early_brake_reason(self) -> str | None:
        """Return why the joint must be braked before its fault kind is known; None if it need not be."""
        is_falling = self.tracking_error * self.v < 0
        if abs(self.v) < thresholds.STILL_SPEED and self.tracking_ratio > thresholds.LAGGING_TRACKING_RATIO:
            return "it does not move"
        if (
            self.tracking_ratio > (thresholds.LAGGING_TRACKING_RATIO if is_falling else thresholds.RUNAWAY_TRACKING_RATIO)
            and abs(self.v - self.commanded_rate) > thresholds.RUNAWAY_SPEED_ERROR
            and abs(self.v) > thresholds.MOVING_SPEED
        ):
            return "it runs away"
        return None

    def is_following(self) -> bool:
        """Return whether the joint follows its command closely, in position or in rate."""
        rate_tolerance = max(thresholds.STILL_SPEED, thresholds.REDUCED_PACE * abs(self.commanded_rate))
        return self.tracking_ratio < thresholds.LAGGING_TRACKING_RATIO or abs(self.commanded_rate - self.v) < rate_tolerance

    def lagging_speed_fraction(self) -> float | None:
        """Return the fraction of the commanded rate that a lagging joint reaches; None if the joint does not lag or move."""
        forward_speed = self.v * np.sign(self.commanded_rate)
        is_slower = thresholds.MIN_CALIBRATED_SPEED < forward_speed < abs(self.commanded_rate)
        return self.v / self.commanded_rate if self.tracking_ratio > thresholds.LAGGING_TRACKING_RATIO and is_slower else None


class ArmCondition:
    """Facts about the joints that faults and brakes change.

    Args:
        arm: The arm without failures.

    Attributes:
        true_positions: Positions in rad and m of the braked joints whose sensors are not trusted, by joint index.
        lower: (n,) lower joint limits in rad and m; a joint on trial has a narrower range.
        upper: (n,) upper joint limits in rad and m.
        max_speeds: (n,) largest joint rates in rad/s and m/s.
        max_efforts: (n,) largest torques and forces in N m and N.
        last_braked: Index of the joint that was braked last; None before the first brake.
        named_direction: 1 or -1, the direction in which the joint that the monitor named last was commanded; 0 at rest.
        is_sensor_fault: True if the joint that the monitor named last has a faulty sensor.
        has_tool_poses: True once a tool pose was measured.
    """

    def __init__(self, arm: Arm) -> None:
        self._arm = arm
        self.true_positions: dict[int, float] = {}
        self.lower, self.upper = arm.lower.copy(), arm.upper.copy()
        self.max_speeds = np.array([joint.velocity for joint in arm.joints])
        self.max_efforts = np.array([joint.effort for joint in arm.joints])
        self.last_braked: int | None = None
        self.named_direction = 0.0
        self.is_sensor_fault = False
        self.has_tool_poses = False

    def trusted_positions(self, q_measured: FloatArray) -> FloatArray:
        """Return the joint positions (n,), replacing those of sensors that are not trusted."""
        if not self.true_positions:
            return q_measured
        q = q_measured.copy()
        for j, value in self.true_positions.items():
            q[j] = value
        return q

    def find_failures(self, q: FloatArray, mask: FloatArray) -> Degraded | None:
        """Return the failures of an arm at q (n,) whose mask (n,) is 0 for braked joints; None if there are none."""
        arm = self._arm
        locked = {int(j): float(q[j]) for j in np.flatnonzero(mask == 0)}
        range_limited = np.flatnonzero((self.lower > arm.lower) | (self.upper < arm.upper))
        ranges = {int(j): (self.lower[j], self.upper[j]) for j in range_limited if j not in locked}
        return Degraded(arm, locked=locked, ranges=ranges) if locked or ranges else None


def calibrated_speeds(arm: Arm, bounds: Bounds) -> FloatArray:
    """Return the rates (n,), rad/s and m/s, for which the monitor is calibrated; faster motion would raise alarms."""
    limits = np.array([joint.velocity for joint in arm.joints])
    return np.asarray(np.minimum(np.maximum(bounds.speed, thresholds.MIN_CALIBRATED_SPEED), limits))


def estimate_joint_position(arm: Arm, joint: int, samples: list[tuple[FloatArray, FloatArray]]) -> tuple[float, float]:
    """Estimate the position of a braked joint from measured tool poses, and the error of its sensor, in rad or m.

    Each of three iterations corrects the joint by ``b = sum J_i' c / sum J_i' J_i``, where ``c`` is the error of the tool pose
    and ``J_i`` the joint's Jacobian column; metres and radians have equal weights. A sample is the joint positions (n,) in rad
    and m, with the tool pose (4, 4) measured there.
    """
    rows = np.array([q for q, _ in samples])
    measured = np.array([pose for _, pose in samples])
    for _ in range(3):
        poses, columns = arm.forward_kinematics(rows), arm.jacobian(rows)[:, :, joint]
        rotations = rotation_vectors(measured[:, :3, :3] @ poses[:, :3, :3].transpose(0, 2, 1))
        c = np.concatenate([measured[:, :3, 3] - poses[:, :3, 3], rotations], axis=1)
        rows[:, joint] += (c * columns).sum() / max(float((columns**2).sum()), 1e-12)
    sensor_error = float(np.mean([row[joint] - q[joint] for row, (q, _) in zip(rows, samples, strict=True)]))
    return float(rows[:, joint].mean()), sensor_error
