"""Control laws without fault information, their deviations after a failure, and their export."""

from holdfast.core._lazy import offer

offer(__name__)
