"""Motions of the end effector: lines, arcs, and sequences of poses, with their timing."""

from holdfast.core._lazy import offer

offer(__name__)
