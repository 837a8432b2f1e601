"""Probabilities with their intervals."""

from holdfast._lazy import offer

offer(__name__)
