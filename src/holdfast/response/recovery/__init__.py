"""Recover an arm after a known lock: the remaining task, and a route to the goal."""

from holdfast.core._lazy import offer

offer(__name__)
