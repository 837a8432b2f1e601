"""Search for fault-tolerant arms: Jacobians, link lengths, and other geometric parameters."""

from holdfast.core._lazy import offer

offer(__name__)
