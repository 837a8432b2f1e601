"""Constraints on the tool's pose along a whole motion, for example an upright tray, a drawer's rail, or a plane."""

from holdfast.core._lazy import offer

offer(__name__)
