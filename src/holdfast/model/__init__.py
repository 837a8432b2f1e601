"""Models of arms and their surroundings: kinematic chains, failure modes, shapes, cells, and collision distances.

A module belongs here if it describes a robot or computes a geometric quantity of one configuration. It does not
depend on a task or a motion.
"""

from holdfast.core._lazy import offer

offer(__name__)
