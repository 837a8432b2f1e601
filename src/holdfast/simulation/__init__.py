"""The closed loop of an arm with a locked joint that nobody has noticed."""

from holdfast._lazy import offer

offer(__name__)
