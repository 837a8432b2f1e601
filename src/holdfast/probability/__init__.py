"""Probabilities and their confidence intervals."""

from holdfast._lazy import offer

offer(__name__)
