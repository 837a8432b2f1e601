"""How to move: redundancy resolution that serves an objective while the hand does its task, and slowly enough."""

from holdfast.control.follow import METHODS, follow
from holdfast.control.laws import AugmentedJacobian, ExtendedJacobian, GradientProjection
from holdfast.control.resolution import Rates, Resolution, Step
from holdfast.control.slow_motion import SlowMotion, slow_enough
from holdfast.control.trajectory import Event, Trajectory

__all__ = [
    "METHODS",
    "AugmentedJacobian",
    "Event",
    "ExtendedJacobian",
    "GradientProjection",
    "Rates",
    "Resolution",
    "SlowMotion",
    "Step",
    "Trajectory",
    "follow",
    "slow_enough",
]
