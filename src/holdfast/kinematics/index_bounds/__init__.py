"""Certified upper bounds of relative manipulability after joint failures, and the best values known to be attainable."""

from holdfast.core._lazy import offer

offer(__name__)
