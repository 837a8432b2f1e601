"""Tasks to choose from, and the choice."""

from holdfast._lazy import offer

offer(__name__)
