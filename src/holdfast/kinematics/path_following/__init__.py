"""Path tracking: redundancy resolution, the trajectory, its events, and how slow it must be."""

from holdfast.core._lazy import offer

offer(__name__)
