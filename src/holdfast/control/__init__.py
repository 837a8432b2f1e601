"""Control laws, and the motions that they produce: simulation, physics, stationary points, and convergence.

A module belongs here if it needs a control law or integrates over time. This package also exports the names of ``laws``.
"""

from holdfast.core._lazy import offer

offer(__name__)
