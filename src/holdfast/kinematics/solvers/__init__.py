"""Solvers for configurations: inverse kinematics, the best configuration of a pose, self-motions, and the best path."""

from holdfast.core._lazy import offer

offer(__name__)
