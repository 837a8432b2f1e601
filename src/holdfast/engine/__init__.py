"""Studies: sweeps of jobs in chunks that survive crashes and grow over machines. Knows no robots."""

from holdfast._lazy import offer

offer(__name__)
