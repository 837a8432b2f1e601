"""Motions by which an arm with braked joints still reaches its target where the control law alone would not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.failure_modes import Degraded
from holdfast.response.supervisor.masked_law import MaskedLaw
from holdfast.response.supervisor.plan import RouteFollower, plan_route
from holdfast.response.supervisor.posture_change import choose_intermediate_configuration


@dataclass(frozen=True)
class TrialRoute:
    """Route for which the brake of a joint is released.

    Attributes:
        joint: Index of the joint.
        lower: Lower end of the joint's range on the route, rad or m.
        upper: Upper end of the joint's range on the route, rad or m.
        route: The route.
    """

    joint: int
    lower: float
    upper: float
    route: RouteFollower


def plan_intermediate_motion(
    law: MaskedLaw, q: FloatArray, failures: Degraded, *, max_speeds: FloatArray
) -> RouteFollower | str:
    """Plan a motion to an intermediate configuration from which the law converges, or return a phrase with the obstacle.

    Args:
        law: The law without the braked joints.
        q: (n,) present configuration, rad and m.
        failures: Failures of the arm.
        max_speeds: (n,) largest joint rates, rad/s and m/s.
    """
    posture = choose_intermediate_configuration(law, q, max_speeds=max_speeds, max_tool_speed=law.whole.speed_limit)
    return "no other posture helps" if posture is None else plan_route(law, q, posture, failures, max_speeds=max_speeds)


def plan_target_route(law: MaskedLaw, q: FloatArray, failures: Degraded, *, max_speeds: FloatArray) -> RouteFollower | str:
    """Plan a route to the target with the joints that are not braked, or return a phrase with the obstacle.

    Args:
        law: The law without the braked joints.
        q: (n,) present configuration, rad and m.
        failures: Failures of the arm.
        max_speeds: (n,) largest joint rates, rad/s and m/s.
    """
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
