"""Motions along a path that survive the lock of a joint: the best one, and what a given one survives."""

from holdfast._lazy import offer

offer(__name__)
