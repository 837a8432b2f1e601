"""How to move: redundancy resolution that serves an objective while the hand does its task."""

from holdfast.control.resolution import AugmentedJacobian, ExtendedJacobian, GradientProjection, Rates, Resolution, Step

__all__ = ["AugmentedJacobian", "ExtendedJacobian", "GradientProjection", "Rates", "Resolution", "Step"]
