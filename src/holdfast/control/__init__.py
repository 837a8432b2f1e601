"""How to move: redundancy resolution that serves an objective while the hand does its task, and slowly enough."""

from holdfast.control.resolution import AugmentedJacobian, ExtendedJacobian, GradientProjection, Rates, Resolution, Step
from holdfast.control.slow_motion import SlowMotion, slow_enough

__all__ = [
    "AugmentedJacobian",
    "ExtendedJacobian",
    "GradientProjection",
    "Rates",
    "Resolution",
    "SlowMotion",
    "Step",
    "slow_enough",
]
