"""The closed loop of an arm with an undetected locked joint."""

from holdfast._lazy import offer

offer(__name__)
