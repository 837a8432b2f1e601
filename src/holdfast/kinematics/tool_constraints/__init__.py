"""Constraints on the tool's pose along a whole motion: an upright tray, a drawer's rail, a plane."""

from holdfast.core._lazy import offer

offer(__name__)
