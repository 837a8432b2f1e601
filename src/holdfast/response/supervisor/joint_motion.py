"""Motion of one joint in a control cycle, compared with its command."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.response.supervisor.thresholds import (
    LAGGING_TRACKING_RATIO,
    MIN_CALIBRATED_SPEED,
    MOVING_SPEED,
    REDUCED_PACE,
    RUNAWAY_SPEED_ERROR,
    RUNAWAY_TRACKING_RATIO,
    STILL_SPEED,
)


@dataclass(frozen=True)
class JointMotion:
    """Motion of one joint in a control cycle.

    Attributes:
        tracking_error: Reference minus position in rad or m.
        tracking_bound: Bound of the monitor for the tracking error in rad or m.
        v: Measured rate in rad/s or m/s.
        commanded_rate: Commanded rate in rad/s or m/s.
    """

    tracking_error: float
    tracking_bound: float
    v: float
    commanded_rate: float

    @property
    def tracking_ratio(self) -> float:
        """Size of the tracking error divided by its bound."""
        return abs(self.tracking_error) / self.tracking_bound

    def early_brake_reason(self) -> str | None:
        """Return why the joint must be braked before its fault kind is known; None if it need not be."""
        is_falling = self.tracking_error * self.v < 0
        if abs(self.v) < STILL_SPEED and self.tracking_ratio > LAGGING_TRACKING_RATIO:
            return "it does not move"
        if (
            self.tracking_ratio > (LAGGING_TRACKING_RATIO if is_falling else RUNAWAY_TRACKING_RATIO)
            and abs(self.v - self.commanded_rate) > RUNAWAY_SPEED_ERROR
            and abs(self.v) > MOVING_SPEED
        ):
            return "it runs away"
        return None

    def is_following(self) -> bool:
        """Return whether the joint follows its command closely, in position or in rate."""
        rate_tolerance = max(STILL_SPEED, REDUCED_PACE * abs(self.commanded_rate))
        return self.tracking_ratio < LAGGING_TRACKING_RATIO or abs(self.commanded_rate - self.v) < rate_tolerance

    def lagging_speed_fraction(self) -> float | None:
        """Return the fraction of the commanded rate that a lagging joint reaches; None if the joint does not lag or move."""
        forward_speed = self.v * np.sign(self.commanded_rate)
        is_slower = MIN_CALIBRATED_SPEED < forward_speed < abs(self.commanded_rate)
        return self.v / self.commanded_rate if self.tracking_ratio > LAGGING_TRACKING_RATIO and is_slower else None
