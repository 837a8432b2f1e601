"""What a record showed, and what it could not show."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from holdfast.arm.model import Arm
from holdfast.caching import cached_property
from holdfast.diagnosis.bounds import Bounds
from holdfast.diagnosis.gaps import STALE
from holdfast.diagnosis.kinds import Verdict
from holdfast.diagnosis.signals import Scaled, Signals
from holdfast.faults.log import Log
from holdfast.result import Result
from holdfast.words import format_seconds

_ENOUGH = 2.0  # of its tracking bound: a reference that moves by less shows no lock
_FASTER = 1.1  # than in calibration
_LEVELS = {"torque": "torques", "tracking": "joint sensors", "tool": "the measured tool pose"}
_KINDS = {
    "locked": "is locked",
    "standstill": "does not move: locked, or free-swinging and held by friction",
    "limp": "swings free: its motor gives no torque",
    "weak": "is weak",
    "friction": "has more friction",
    "sluggish": "moves against more than it should: its motor is weak, or it has more friction",
    "sensor": "has a faulty sensor, or a clutch that slips",
    "unknown": "has a fault of an unknown kind",
}


@dataclass(frozen=True, eq=False, kw_only=True)
class Diagnosis(Result):
    """What :func:`holdfast.diagnosis.diagnose` found in a record.

    Attributes:
        arm: The arm.
        log: The record.
        bounds: Of the healthy arm.
        signals: Residuals.
        scaled: The same in units of their bounds, and seconds of excess.
        verdict: The first alarm, its joint and kind.
    """

    arm: Arm
    log: Log
    bounds: Bounds
    signals: Signals
    scaled: Scaled
    verdict: Verdict

    @cached_property
    def untold(self) -> tuple[str, ...]:
        """Joints that were not asked to move enough to tell whether they are locked: by less than twice their bound."""
        travel = np.fmax.reduce(self.log.q_ref) - np.fmin.reduce(self.log.q_ref)
        few = ~(travel >= _ENOUGH * self.bounds.tracking)
        return tuple(name for name, little in zip(self.arm.joint_names, few, strict=True) if little)

    @cached_property
    def beyond(self) -> tuple[str, ...]:
        """Joints that were asked to move more than 10 % faster than in calibration: the bounds do not hold for them."""
        speed = np.fmax.reduce(np.abs(np.diff(self.log.q_ref, axis=0))) * self.bounds.rate
        fast = speed > _FASTER * self.bounds.speed + 1e-9
        return tuple(name for name, faster in zip(self.arm.joint_names, fast, strict=True) if faster)

    @cached_property
    def gaps(self) -> tuple[tuple[float, float], ...]:
        """From when to when, s, nothing was looked at: the record has no numbers of the joints for more than 50 ms."""
        told = self.log.t[self.signals.seen]
        ends = [self.log.t[0], *told, self.log.t[-1]]
        return tuple((float(a), float(b)) for a, b in pairwise(ends) if b - a > STALE + 1.5 * self.signals.dt)

    @property
    def off(self) -> tuple[str, ...]:
        """What is not watched, because the record or the bounds do not have it."""
        bounds = self.bounds
        known = {"torque": bool(np.isfinite(bounds.torque).all()), "tool": bool(np.isfinite(bounds.position))}
        return tuple(_LEVELS[name] for name, there in known.items() if not there or name not in self.signals.levels)

    def describe(self) -> list[str]:
        """The fault or that none was seen, the reasons, and what could not be told."""
        v = self.verdict
        if not v.alarm:
            lines = [f"no fault seen in {self.log.duration:.4g} s"]
        elif v.kind == "contact":
            blame = f", or {v.suspect} has a fault: it alone is above its bound" if v.suspect else "; no joint is to blame"
            lines = [f"alarm at {format_seconds(v.time)}: something pushed the arm{blame}"]
        else:
            lost = f" (it gives {1 - v.loss:.0%} of its torque, ± {v.uncertainty:.0%})" if v.kind == "weak" else ""
            lines = [f"alarm at {format_seconds(v.time)}: {v.joint or 'a joint that is not known'} {_KINDS[v.kind]}{lost}"]
        lines += list(v.evidence)
        others = [kind for kind in v.candidates if kind != v.kind]
        if others:
            lines.append(f"it may also be: {', '.join(others)}")
        if self.untold:
            lines.append(f"these joints did not move enough to tell: {', '.join(self.untold)}")
        if self.gaps:
            long = sum(end - start for start, end in self.gaps)
            lines.append(f"nothing was looked at for {long:.4g} s: there the record has no numbers of the joints")
        if self.off:
            lines.append(f"not watched: {', '.join(self.off)}")
        if self.beyond:
            lines.append(f"faster than calibrated, so that an alarm proves little: {', '.join(self.beyond)}")
        return lines
