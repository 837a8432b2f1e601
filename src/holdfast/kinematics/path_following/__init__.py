"""Path tracking: redundancy resolution, the trajectory and its events, and the slowness that a motion needs."""

from holdfast.core._lazy import offer

offer(__name__)
