"""A route for what is left of an arm, as :func:`holdfast.recover` times it, run through by its controller."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.failures import Degraded
from holdfast.reaction.masked import MaskedLaw
from holdfast.recovery import TimedMotion, recover

Array = NDArray[np.float64]

ACCELERATION = 10.0  # rad/s^2 or m/s^2, of commanded rates
SPEED = 0.5  # of the motion at its fastest
PULL = 5.0  # 1/s, at which a reference returns to the route


class Planned:
    """A motion, and how far along it the arm is.

    Args:
        motion: As it is at its fastest.
        fastest: m/s, of the tool; None: as fast as that.
        most: (n,) of the joints, rad/s and m/s. What the arm is told beyond that it would not do, and leave the route.

    Attributes:
        waypoints: Of the route, how many.
        duration: From its start to its end at the full pace, s.
    """

    def __init__(self, motion: TimedMotion, *, waypoints: int, fastest: float | None, most: Array) -> None:
        self.waypoints, self._motion, self._at = waypoints, motion, 0.0
        tool = (motion.arm.jacobian(motion.q)[:, :3] @ motion.qd[:, :, None])[..., 0]
        limit = np.inf if fastest is None else fastest
        slow = np.minimum(SPEED, limit / np.maximum(np.linalg.norm(tool, axis=1), 1e-9))
        slow = np.minimum(slow, (most / np.maximum(np.abs(motion.qd), 1e-9)).min(axis=1))
        self._slow = np.minimum(slow, np.r_[slow[1:], slow[-1]])  # from each row to the next
        self.duration = float((motion.period / self._slow[:-1]).sum())

    @property
    def over(self) -> bool:
        """Whether its end is reached."""
        return bool(self._at >= self._motion.time[-1])

    def rates(self, q: Array, *, pace: float, dt: float) -> Array:
        """Rates (n,) of the next ``dt`` s along the route at a fraction of its pace, and back to it for an arm at (n,)."""
        motion, last = self._motion, len(self._motion.q) - 1
        x = min(self._at / motion.period, float(last)) if last else 0.0
        k = min(int(x), max(last - 1, 0))
        rate = pace * float(self._slow[k])
        self._at += rate * dt
        there, along = (part[k] + (x - k) * (part[min(k + 1, last)] - part[k]) for part in (motion.q, motion.qd))
        return np.asarray(rate * along + PULL * (there - q))


def planned(law: MaskedLaw, q: Array, goal: Array, left: Degraded, *, most: Array) -> Planned | str:
    """A route to a goal, or a phrase with what is in its way. Planning takes no time: the arm waits.

    Args:
        law: Whose task it is; its speed limit holds for the tool, and what it keeps clear of for the arm.
        q: (n,) where the arm is, rad and m.
        goal: (4, 4) pose of the tool, m, world; or (n,) a configuration.
        left: What is left of the arm.
        most: (n,) joint rates, rad/s and m/s.
    """
    start = np.clip(q, law.arm.lower, law.arm.upper)
    task = law.whole.task if goal.ndim == 2 else None
    clear = law.clearance or False
    found = recover(law.arm, left, start, goal=goal, task=task, samples=0, clearance=clear, accelerations=ACCELERATION)
    if not found.ok or found.timed is None:
        gives = "" if found.given_up is None else f"; it could be met without {', '.join(found.given_up.names)}"
        return f"{found.ending.sentence}{gives}"
    return Planned(found.timed, waypoints=len(found.q), fastest=law.whole.speed_limit, most=most)
