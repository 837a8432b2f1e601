"""Plan a route for the remaining joints with :func:`holdfast.recover` and follow it."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.failure_modes import Degraded
from holdfast.response.recovery import TimedMotion, recover
from holdfast.response.supervisor.masked_law import MaskedLaw

ACCELERATION_LIMIT = 10.0  # rad/s^2 or m/s^2, of the commanded rates
ROUTE_PACE = 0.5  # fraction of the highest speed of the motion
ROUTE_GAIN_PER_S = 5.0  # gain with which the arm returns to the route


class RouteFollower:
    """Timed motion and the present position along it.

    Args:
        motion: Timed motion at its highest speed.
        max_tool_speed: Speed limit of the tool in m/s; None without one.
        max_speeds: (n,) largest joint rates, rad/s and m/s; an arm that is commanded faster would leave the route.

    Attributes:
        waypoints: Number of waypoints of the route.
        duration: Time in s from the start to the end at the full pace.
    """

    def __init__(self, motion: TimedMotion, *, waypoints: int, max_tool_speed: float | None, max_speeds: FloatArray) -> None:
        self.waypoints, self._motion, self._motion_time = waypoints, motion, 0.0
        tool = (motion.arm.jacobian(motion.q)[:, :3] @ motion.qd[:, :, None])[..., 0]
        limit = np.inf if max_tool_speed is None else max_tool_speed
        pace = np.minimum(ROUTE_PACE, limit / np.maximum(np.linalg.norm(tool, axis=1), 1e-9))
        pace = np.minimum(pace, (max_speeds / np.maximum(np.abs(motion.qd), 1e-9)).min(axis=1))
        self._segment_paces = np.minimum(pace, np.r_[pace[1:], pace[-1]])  # from each row to the next
        self.duration = float((motion.period / self._segment_paces[:-1]).sum())

    @property
    def is_finished(self) -> bool:
        """True once the end of the route is reached."""
        return bool(self._motion_time >= self._motion.time[-1])

    def rates(self, q: FloatArray, *, pace: float, dt: float) -> FloatArray:
        """Return rates (n,) for the next ``dt`` s along the route at a fraction of its pace, and back to it for an arm at q
        (n,).
        """
        motion, last = self._motion, len(self._motion.q) - 1
        x = min(self._motion_time / motion.period, float(last)) if last else 0.0
        sample = min(int(x), max(last - 1, 0))
        rate = pace * float(self._segment_paces[sample])
        self._motion_time += rate * dt
        q_route, qd_route = (
            part[sample] + (x - sample) * (part[min(sample + 1, last)] - part[sample]) for part in (motion.q, motion.qd)
        )
        return np.asarray(rate * qd_route + ROUTE_GAIN_PER_S * (q_route - q))


def plan_route(
    law: MaskedLaw, q: FloatArray, goal: FloatArray, failures: Degraded, *, max_speeds: FloatArray
) -> RouteFollower | str:
    """Plan a route to a goal, or return a phrase with the obstacle; planning takes no simulated time because the arm waits.

    Args:
        law: Control law with the task, the speed limit of the tool, and the clearance of the arm.
        q: (n,) present configuration, rad and m.
        goal: (4, 4) pose of the tool, m, world; or (n,) a configuration.
        failures: Failures of the arm.
        max_speeds: (n,) largest joint rates, rad/s and m/s.
    """
    start = np.clip(q, law.arm.lower, law.arm.upper)
    task = law.whole.task if goal.ndim == 2 else None
    clearance = law.clearance or False
    recovery = recover(
        law.arm, failures, start, goal=goal, task=task, samples=0, clearance=clearance, accelerations=ACCELERATION_LIMIT
    )
    if not recovery.ok or recovery.timed is None:
        relaxed_text = "" if recovery.relaxed is None else f"; it could be met without {', '.join(recovery.relaxed.names)}"
        return f"{recovery.ending.sentence}{relaxed_text}"
    return RouteFollower(recovery.timed, waypoints=len(recovery.q), max_tool_speed=law.whole.speed_limit, max_speeds=max_speeds)
