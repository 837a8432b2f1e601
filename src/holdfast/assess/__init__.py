"""Over a region: sample poses, solve, evaluate, and say how probable fault tolerance is."""

from holdfast.assess.assess import Assessment, assess, load
from holdfast.assess.compare import Comparison, compare
from holdfast.assess.distribution import Distribution, Interval
from holdfast.assess.region import Region, rotation_from_rpy, rpy_from_rotation
from holdfast.assess.structure import Structure, explain, structure, structures
from holdfast.assess.upgrade import Upgrade

__all__ = [
    "Assessment",
    "Comparison",
    "Distribution",
    "Interval",
    "Region",
    "Structure",
    "Upgrade",
    "assess",
    "compare",
    "explain",
    "load",
    "rotation_from_rpy",
    "rpy_from_rotation",
    "structure",
    "structures",
]
