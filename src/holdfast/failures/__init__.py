"""Failure modes: which joints may fail, and what is known to have failed."""

from holdfast._lazy import offer

offer(__name__)
