"""Control laws without fault information, their deviations after a failure, and their export."""

from holdfast._lazy import offer

offer(__name__)
