"""Figures and one-file HTML reports, independent of any robot model."""

from holdfast._lazy import offer

offer(__name__)
