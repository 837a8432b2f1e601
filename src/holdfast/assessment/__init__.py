"""Fault tolerance over a region: sample poses, solve, evaluate, and give probabilities."""

from holdfast._lazy import offer

offer(__name__)
