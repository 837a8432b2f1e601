"""Where it ends: where a failed arm can come to rest, what attracts it, and from where."""

from holdfast.converge.basins import Basins, basins
from holdfast.converge.curves import Curve, Curves, Segment
from holdfast.converge.linearisation import Kind, Linearisation, linearisation
from holdfast.converge.orbits import Orbit, orbit
from holdfast.converge.stationary import RestPoints, stationary
from holdfast.converge.theorem import column_residual, is_stuck, null_components, stuck_subspace

__all__ = [
    "Basins",
    "Curve",
    "Curves",
    "Kind",
    "Linearisation",
    "Orbit",
    "RestPoints",
    "Segment",
    "basins",
    "column_residual",
    "is_stuck",
    "linearisation",
    "null_components",
    "orbit",
    "stationary",
    "stuck_subspace",
]
