"""Control laws that do not know of a failure, their deviations after one, and their export."""

from holdfast._lazy import offer

offer(__name__)
