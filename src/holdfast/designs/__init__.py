"""Which arm to build: Jacobians and lengths searched for fault tolerance."""

from holdfast._lazy import offer

offer(__name__)
