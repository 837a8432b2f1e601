"""One trial: stick, plant, operator, measures."""

from holdfast._lazy import offer

offer(__name__)
