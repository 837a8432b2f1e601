"""How to move: redundancy resolution that serves an objective while the hand does its task."""

from holdfast.control.follow import METHODS, follow
from holdfast.control.resolution import AugmentedJacobian, ExtendedJacobian, GradientProjection, Rates, Resolution, Step
from holdfast.control.trajectory import Event, Trajectory

__all__ = [
    "METHODS",
    "AugmentedJacobian",
    "Event",
    "ExtendedJacobian",
    "GradientProjection",
    "Rates",
    "Resolution",
    "Step",
    "Trajectory",
    "follow",
]
