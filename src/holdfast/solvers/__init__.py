"""Solvers for configurations: inverse kinematics, the best one of a pose, all of them, and the best along a path."""

from holdfast._lazy import offer

offer(__name__)
