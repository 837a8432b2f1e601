"""Configurations in which an arm stays without power, and safe paths to them."""

from holdfast.core._lazy import offer

offer(__name__)
