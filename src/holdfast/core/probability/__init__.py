"""Probabilities and their confidence intervals."""

from holdfast.core._lazy import offer

offer(__name__)
