"""Rows of the tool's pose that are kept along a whole motion: an upright tray, a drawer's rail, a plane."""

from holdfast._lazy import offer

offer(__name__)
