"""Over a region: sample poses, solve, evaluate, and say how probable fault tolerance is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from holdfast.on_demand import offer

if TYPE_CHECKING:
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

offer(
    __name__,
    {
        "assess": "Assessment assess load",
        "compare": "Comparison compare",
        "distribution": "Distribution Interval",
        "region": "Region rotation_from_rpy rpy_from_rotation",
        "structure": "Structure explain structure structures",
        "upgrade": "Upgrade",
    },
)
