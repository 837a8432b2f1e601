"""Where a failed arm stops: stationary points, their curves and basins, and limit cycles."""

from holdfast._lazy import offer

offer(__name__)
