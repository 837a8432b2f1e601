"""Over a region: sample poses, solve, evaluate, and say how probable fault tolerance is."""

from holdfast._lazy import offer

offer(__name__)
