"""Figures and one-file HTML reports, independent of any robot model."""

from holdfast.core._lazy import offer

offer(__name__)
