"""What then happens: the closed loop of a controller that knows of no failure, and the free swing of a failed joint."""

from __future__ import annotations

from typing import TYPE_CHECKING

from holdfast.on_demand import offer

if TYPE_CHECKING:
    from holdfast.simulate.closed_loop import simulate
    from holdfast.simulate.compare_laws import Case, LawComparison, compare_laws
    from holdfast.simulate.free_swing import BrakedDrop, FreeSwing, free_swing
    from holdfast.simulate.healthy_cost import HealthyCost
    from holdfast.simulate.physical_loop import simulate_physics
    from holdfast.simulate.physical_run import PhysicalRun
    from holdfast.simulate.point_to_point import PointToPoint, point_to_point
    from holdfast.simulate.runs import Outcome, Path, Reason, Runs
    from holdfast.simulate.servos import Servos

__all__ = [
    "BrakedDrop",
    "Case",
    "FreeSwing",
    "HealthyCost",
    "LawComparison",
    "Outcome",
    "Path",
    "PhysicalRun",
    "PointToPoint",
    "Reason",
    "Runs",
    "Servos",
    "compare_laws",
    "free_swing",
    "point_to_point",
    "simulate",
    "simulate_physics",
]

offer(
    __name__,
    {
        "closed_loop": "simulate",
        "compare_laws": "Case LawComparison compare_laws",
        "free_swing": "BrakedDrop FreeSwing free_swing",
        "healthy_cost": "HealthyCost",
        "physical_loop": "simulate_physics",
        "physical_run": "PhysicalRun",
        "point_to_point": "PointToPoint point_to_point",
        "runs": "Outcome Path Reason Runs",
        "servos": "Servos",
    },
)
