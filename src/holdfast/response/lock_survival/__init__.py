"""Motions along a path that survive the lock of a joint: the best motion, and the locks that a given motion survives."""

from holdfast.core._lazy import offer

offer(__name__)
