"""Figures and one-file HTML reports; knows no robots."""

from holdfast._lazy import offer

offer(__name__)
