"""Failure modes: sets of joints that may fail, and the known failures of an arm."""

from holdfast.core._lazy import offer

offer(__name__)
