"""What then happens: the closed loop of a controller that knows of no failure, and the free swing of a failed joint."""

from holdfast.simulate.closed_loop import simulate
from holdfast.simulate.free_swing import BrakedDrop, FreeSwing, free_swing
from holdfast.simulate.physical_loop import simulate_physics
from holdfast.simulate.physical_run import PhysicalRun
from holdfast.simulate.runs import Outcome, Path, Reason, Runs
from holdfast.simulate.servos import Servos

__all__ = [
    "BrakedDrop",
    "FreeSwing",
    "Outcome",
    "Path",
    "PhysicalRun",
    "Reason",
    "Runs",
    "Servos",
    "free_swing",
    "simulate",
    "simulate_physics",
]
