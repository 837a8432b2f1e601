"""Dexterity, inverse kinematics, regions, paths, and workspaces of arms, healthy and with failed joints.

A module belongs here if it relates configurations to tasks without a control law and without time. Bounds that hold for every
arm, and searches over intervals, are in this package as well.
"""

from holdfast.core._lazy import offer

offer(__name__)
