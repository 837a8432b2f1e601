"""Notebook view of a region."""

from __future__ import annotations

import numpy as np

from holdfast.interface.presentation.presentation import Fact, Presentation, TableSpec, make_headers
from holdfast.kinematics.regions.region import Region

_BOX_COLUMNS = (("x", "m"), ("y", "m"), ("z", "m"), ("yaw", "deg"), ("pitch", "deg"), ("roll", "deg"))
_CONE_COLUMNS = (
    *_BOX_COLUMNS[:3],
    ("cosine of the angle from the axis", ""),
    ("direction about the axis", "deg"),
    ("rotation about z", "deg"),
)


def present(region: Region) -> Presentation:
    """Present the description and the bounds of the region; for a list the number of poses."""
    title = region.name
    if region.listed is not None:
        return Presentation(title, title, lines=[region.describe()], facts=[Fact("poses", len(region.listed))])
    if region.draw is not None:
        function = getattr(region.draw[0], "__name__", "a function")
        return Presentation(title, title, lines=[region.describe()], facts=[Fact("sampled by", function)])
    joints = [(f"joint {joint + 1}", "") for joint in range(len(region.center))]
    parameters = {"box": _BOX_COLUMNS, "cone": _CONE_COLUMNS}.get(region.kind, joints)
    rows = []
    for (name, unit), center, size in zip(parameters, region.center, region.size, strict=True):
        bounds = np.array([center - size / 2, center + size / 2])
        bounds = np.round(np.degrees(bounds) if unit == "deg" else bounds, 9) + 0.0
        rows.append((f"{name}{unit and ', '}{unit}", *bounds))
    head = "" if region.kind in ("box", "cone") else "rad or m"
    table = TableSpec("", [head, *make_headers("from", "to", aligned=False)], rows)
    return Presentation(title, title, lines=[region.describe()], tables=[table])
