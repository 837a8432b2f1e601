"""Notebook view of a region."""

from __future__ import annotations

import numpy as np

from holdfast.interface.presentation.printing import TextTable
from holdfast.kinematics.regions.region import Region

_BOX_COLUMNS = (("x", "m"), ("y", "m"), ("z", "m"), ("yaw", "deg"), ("pitch", "deg"), ("roll", "deg"))
_CONE_COLUMNS = (
    *_BOX_COLUMNS[:3],
    ("cosine of the angle from the axis", ""),
    ("direction about the axis", "deg"),
    ("turn about z", "deg"),
)


def sentences(region: Region) -> list[str]:
    """Return the name and the description of the region."""
    return [region.name, region.describe()]


def key_table(region: Region) -> TextTable:
    """Tabulate the bounds of the region; for a list the number of poses."""
    if region.listed is not None:
        return TextTable(["", ""], [["poses", f"{len(region.listed):,}"]])
    if region.draw is not None:
        return TextTable(["", ""], [["drawn by", getattr(region.draw[0], "__name__", "a function")]])
    joints = [(f"joint {joint + 1}", "") for joint in range(len(region.center))]
    columns = {"box": _BOX_COLUMNS, "cone": _CONE_COLUMNS}.get(region.kind, joints)
    rows = []
    for (name, unit), center, size in zip(columns, region.center, region.size, strict=True):
        bounds = np.array([center - size / 2, center + size / 2])
        lower, upper = np.round(np.degrees(bounds) if unit == "deg" else bounds, 9) + 0.0
        rows.append([f"{name}{unit and ', '}{unit}", f"{lower:.4g}", f"{upper:.4g}"])
    return TextTable(["" if region.kind in ("box", "cone") else "rad or m", "from", "to"], rows)
