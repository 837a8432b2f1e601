"""Ceilings: what no arm can keep when joints fail, and what is known to be attainable."""

from holdfast._lazy import offer

offer(__name__)
