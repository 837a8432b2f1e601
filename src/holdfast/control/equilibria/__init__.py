"""Stationary points of a failed arm, their curves and basins, and limit cycles."""

from holdfast.core._lazy import offer

offer(__name__)
