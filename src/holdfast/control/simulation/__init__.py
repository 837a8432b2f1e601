"""The closed loop of an arm with an undetected locked joint."""

from holdfast.core._lazy import offer

offer(__name__)
