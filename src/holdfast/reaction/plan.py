"""A route for what is left of an arm, run through by its controller."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.control.law import Law
from holdfast.failures import Degraded
from holdfast.recovery import recover

Array = NDArray[np.float64]

SPEED = 0.5  # of the velocity limits
UNLIMITED = 1.0  # rad/s or m/s of a joint without one
_PEAK = 1.5  # of a smooth step 3 x^2 - 2 x^3, its largest slope
PULL = 5.0  # 1/s, at which a reference returns to the route


@dataclass(frozen=True, eq=False, kw_only=True)
class Planned:
    """A timed route, straight between K waypoints and at rest in each.

    Attributes:
        start: s, when it begins.
        q: (K, n) rad and m.
        at: (K,) when it is in each, s.
    """

    start: float
    q: Array
    at: Array

    @property
    def waypoints(self) -> int:
        """How many."""
        return len(self.q)

    @property
    def duration(self) -> float:
        """From the start to the last waypoint, s."""
        return float(self.at[-1] - self.at[0])

    def over(self, time: float) -> bool:
        """It has been run through."""
        return bool(time > self.at[-1])

    def rates(self, time: float, q: Array) -> Array:
        """Rates (n,) along the route, and back to it for an arm at (n,)."""
        k = int(np.clip(np.searchsorted(self.at, time, side="right") - 1, 0, len(self.q) - 2))
        span, step = self.at[k + 1] - self.at[k], self.q[k + 1] - self.q[k]
        x = float(np.clip((time - self.at[k]) / span, 0.0, 1.0))
        return np.asarray(step * (6 * x * (1 - x) / span) + PULL * (self.q[k] + x * x * (3 - 2 * x) * step - q))


def planned(law: Law, q: Array, target: Array, left: Degraded, *, time: float, pace: float = 1.0) -> Planned | str:
    """A route to the target, or a phrase with what is in its way.

    Args:
        law: Whose task it is; its speed limit holds for the tool on the chords of the route.
        q: (n,) where the arm is, rad and m.
        target: (4, 4) m, world.
        left: What is left of the arm.
        time: s, now. Planning takes none: the arm waits.
        pace: Fraction of the usual speed.
    """
    arm = law.arm
    found = recover(arm, left, np.clip(q, arm.lower, arm.upper), goal=target, task=law.task, samples=0, clearance=False)
    if not found.ok:
        gives = "" if found.given_up is None else f"; it could be met without {', '.join(found.given_up.names)}"
        return f"{found.ending.sentence}{gives}"
    steps, limit = np.diff(found.q, axis=0), np.array([min(joint.velocity, 1e9) for joint in arm.joints])
    limit = np.where(limit < 1e9, SPEED * limit, UNLIMITED)
    seconds = _PEAK * (np.abs(steps) / limit).max(axis=1)
    if law.speed_limit is not None:
        chords = np.linalg.norm(np.diff(arm.forward_kinematics(found.q)[:, :3, 3], axis=0), axis=1)
        seconds = np.maximum(seconds, _PEAK * chords / law.speed_limit)
    return Planned(start=time, q=found.q, at=time + np.r_[0.0, np.maximum(seconds / pace, 1e-3).cumsum()])
