"""Motions by which an arm with braked joints still reaches its target where the control law alone would not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.failure_modes import Degraded
from holdfast.response.recovery import TimedMotion, recover
from holdfast.response.supervisor.masked_law import MaskedLaw

ACCELERATION_LIMIT = 10.0  # rad/s^2 or m/s^2, of the commanded rates
ROUTE_PACE = 0.5  # fraction of the highest speed of the motion
ROUTE_GAIN_PER_S = 5.0  # gain with which the arm returns to the route
CENTRING_FRACTIONS = (0.25, 0.5, 0.75, 1.0)  # of the motion of all joints to the middle of their ranges
UNLIMITED_STEP_RAD = np.pi / 2  # motion of a joint without limits, in both directions
_PATH_SEGMENTS = 16  # number of configurations that approximate the length of the tool path


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
        """Return rates (n,) for the next ``dt`` s along the route at a fraction of its pace, and from q (n,) back to it."""
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


def candidate_configurations(arm: Arm, q: FloatArray, mask: FloatArray) -> FloatArray:
    """Return candidates (K, n) near q (n,), rad and m: unmasked joints nearer to their middle, or one at or beyond it."""
    bounded = np.isfinite(arm.lower) & np.isfinite(arm.upper)
    middle = np.where(bounded, np.mean(sampling_limits(arm), axis=0), q)
    candidates = [q + mask * depth * (middle - q) for depth in CENTRING_FRACTIONS]
    for joint in np.flatnonzero(mask):
        for value in (
            (middle[joint], 2 * middle[joint] - q[joint])
            if bounded[joint]
            else (q[joint] - UNLIMITED_STEP_RAD, q[joint] + UNLIMITED_STEP_RAD)
        ):
            candidates.append(np.where(np.arange(arm.n) == joint, value, q))
    return np.array(candidates)


def choose_intermediate_configuration(
    law: MaskedLaw, q: FloatArray, *, max_speeds: FloatArray, max_tool_speed: float | None
) -> FloatArray | None:
    """Choose the configuration (n,) through which the law reaches its target soonest, by forward simulation.

    Returns None if the target is reached through none of the :func:`candidate_configurations`.
    """
    arm = law.arm
    candidates = candidate_configurations(arm, np.clip(q, arm.lower, arm.upper), law.mask)
    durations = (np.abs(candidates - q) / max_speeds).max(axis=1)
    if max_tool_speed is not None:
        between = q + np.linspace(0.0, 1.0, _PATH_SEGMENTS)[:, None, None] * (candidates - q)
        tool = arm.forward_kinematics(between.reshape(-1, arm.n))[:, :3, 3].reshape(_PATH_SEGMENTS, -1, 3)
        durations = np.maximum(durations, np.linalg.norm(np.diff(tool, axis=0), axis=-1).sum(axis=0) / max_tool_speed)
    durations = durations + law.predict_time_to_target(candidates, max_speeds=max_speeds)
    best = int(np.argmin(durations))
    return candidates[best] if np.isfinite(durations[best]) else None


@dataclass(frozen=True)
class TrialRoute:
    """Route for which the brake of a joint is released."""

    joint: int  # index of the joint
    lower: float  # lower end of the joint's range on the route, rad or m
    upper: float  # upper end of the joint's range on the route, rad or m
    route: RouteFollower  # the route


def plan_intermediate_motion(
    law: MaskedLaw, q: FloatArray, failures: Degraded, *, max_speeds: FloatArray
) -> RouteFollower | str:
    """Plan a motion to an intermediate configuration from which the law converges, with arguments of :func:`plan_route`."""
    posture = choose_intermediate_configuration(law, q, max_speeds=max_speeds, max_tool_speed=law.whole.speed_limit)
    if posture is None:
        return "no intermediate configuration helps"
    return plan_route(law, q, posture, failures, max_speeds=max_speeds)


def plan_target_route(law: MaskedLaw, q: FloatArray, failures: Degraded, *, max_speeds: FloatArray) -> RouteFollower | str:
    """Plan a route to the target with the joints that are not braked, with arguments of :func:`plan_route`."""
    return plan_route(law, q, law.pose, failures, max_speeds=max_speeds)


def plan_trial_route(
    law: MaskedLaw, q: FloatArray, joint: int, directions: Sequence[float], *, max_speeds: FloatArray
) -> TrialRoute | None:
    """Plan a route to the target that also moves a braked joint; None if there is none.

    Args:
        law: The law without the braked joint.
        q: (n,) present configuration, rad and m.
        joint: Index of the braked joint.
        directions: Directions in which the joint is not moved, in the order in which they are tried: 1, -1, or 0 for a joint
            that may move in both directions.
        max_speeds: (n,) largest joint rates, rad/s and m/s.
    """
    arm = law.arm
    limits = max(arm.lower[joint], q[joint] - 2 * np.pi), min(arm.upper[joint], q[joint] + 2 * np.pi)
    for direction in dict.fromkeys(directions):
        lower, upper = q[joint] if direction < 0 else limits[0], q[joint] if direction > 0 else limits[1]
        if not limits[0] <= lower < upper <= limits[1]:
            continue
        failures = Degraded(arm, ranges={joint: (lower, upper)})
        route = plan_route(law, q, law.pose, failures, max_speeds=max_speeds)
        if not isinstance(route, str):
            return TrialRoute(joint, lower, upper, route)
    return None
