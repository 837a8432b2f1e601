"""Control laws, and the motions that they produce: simulation, physics, stationary points, and convergence.

A module belongs here if it needs a control law or integrates over time. The names of ``laws`` are offered here, too.
"""

from holdfast.core._lazy import offer

offer(__name__)
