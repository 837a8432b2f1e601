"""Fault tolerance over a region: sample poses, solve, evaluate, and compute probabilities."""

from holdfast.core._lazy import offer

offer(__name__)
