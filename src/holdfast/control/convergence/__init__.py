"""Outcomes of failed arms over a workspace: measures, maps, the best law, and comparisons of laws."""

from holdfast.core._lazy import offer

offer(__name__)
