"""Result of a diagnosis: the fault that a recording shows, and the inconclusive joints."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.result import Result
from holdfast.model.arm.model import Arm
from holdfast.response.diagnosis.bounds import Bounds
from holdfast.response.diagnosis.gaps import MAX_BRIDGED_GAP_S
from holdfast.response.diagnosis.kinds import FaultVerdict
from holdfast.response.diagnosis.signals import ScaledResiduals, Signals
from holdfast.response.faults.log import Log

_MIN_TRAVEL_FACTOR = 2.0  # of the tracking threshold: a reference that moves by less does not reveal a lock
_MAX_SPEED_FACTOR = 1.1  # of the calibrated speed
_LEVEL_NAMES = {"torque": "torques", "tracking": "joint sensors", "tool": "the measured tool pose"}


@dataclass(frozen=True, eq=False, kw_only=True)
class Diagnosis(Result):
    """Result of :func:`holdfast.response.diagnosis.diagnose` for a recording.

    Attributes:
        arm: Monitored arm.
        log: Diagnosed log.
        bounds: Detection thresholds of the healthy arm.
        signals: Residuals of the log.
        scaled: Residuals in units of their thresholds, and their accumulated excess in seconds.
        verdict: First alarm, with the faulty joint and the kind of its fault.
    """

    arm: Arm
    log: Log
    bounds: Bounds
    signals: Signals
    scaled: ScaledResiduals
    verdict: FaultVerdict

    @cached_property
    def inconclusive(self) -> tuple[str, ...]:
        """Joints whose reference moves by less than twice their tracking threshold, so that a lock could not be detected."""
        travel = np.fmax.reduce(self.log.q_ref) - np.fmin.reduce(self.log.q_ref)
        moves_too_little = ~(travel >= _MIN_TRAVEL_FACTOR * self.bounds.tracking)
        return tuple(self.arm.joint_names[joint] for joint in np.flatnonzero(moves_too_little))

    @cached_property
    def beyond(self) -> tuple[str, ...]:
        """Joints whose reference is more than 10 % faster than in calibration, so that their thresholds are not valid."""
        max_speeds = np.fmax.reduce(np.abs(np.diff(self.log.q_ref, axis=0))) * self.bounds.rate
        is_too_fast = max_speeds > _MAX_SPEED_FACTOR * self.bounds.speed + 1e-9
        return tuple(self.arm.joint_names[joint] for joint in np.flatnonzero(is_too_fast))

    @cached_property
    def gaps(self) -> tuple[tuple[float, float], ...]:
        """Start and end, s, of the intervals of more than 50 ms without joint measurements, in which nothing was monitored."""
        measured_times = self.log.t[self.signals.seen]
        intervals = pairwise([self.log.t[0], *measured_times, self.log.t[-1]])
        min_gap = MAX_BRIDGED_GAP_S + 1.5 * self.signals.dt
        return tuple((float(start), float(end)) for start, end in intervals if end - start > min_gap)

    @property
    def unmonitored(self) -> tuple[str, ...]:
        """Signals that are not monitored, because the log or the thresholds lack them."""
        has_bound = {"torque": np.isfinite(self.bounds.torque).all(), "tool": np.isfinite(self.bounds.position)}
        levels = self.signals.levels
        return tuple(_LEVEL_NAMES[name] for name, is_bound in has_bound.items() if not is_bound or name not in levels)
