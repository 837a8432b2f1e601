"""Over a region: sample poses, solve, evaluate, and say how probable fault tolerance is."""

from holdfast.assess.assess import Assessment, assess, load
from holdfast.assess.distribution import Distribution, Interval
from holdfast.assess.region import Region, rotation_from_rpy, rpy_from_rotation
from holdfast.assess.structure import Structure, explain, structure, structures

__all__ = [
    "Assessment",
    "Distribution",
    "Interval",
    "Region",
    "Structure",
    "assess",
    "explain",
    "load",
    "rotation_from_rpy",
    "rpy_from_rotation",
    "structure",
    "structures",
]
