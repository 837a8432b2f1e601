"""A region, as a notebook shows it."""

from __future__ import annotations

import numpy as np

from holdfast import arms
from holdfast.present.printing import Rows
from holdfast.regions.region import Region

_BOX = (("x", "m"), ("y", "m"), ("z", "m"), ("roll", "deg"), ("pitch", "deg"), ("yaw", "deg"))


def sentences(region: Region) -> list[str]:
    """Its name, and what it is."""
    return [region.name, region.describe()]


def key_table(region: Region) -> Rows:
    """The bounds of a box; of a list how many poses it has."""
    if region.listed is not None:
        return Rows(["", ""], [["poses", f"{len(region.listed):,}"]])
    if region.draw is not None:
        return Rows(["", ""], [["drawn by", getattr(region.draw[0], "__name__", "a function")]])
    named = _BOX if region.kind == "box" else [(f"joint {k + 1}", "") for k in range(len(region.center))]
    rows = []
    for (name, unit), center, size in zip(named, region.center, region.size, strict=True):
        ends = np.array([center - size / 2, center + size / 2])
        low, high = np.round(np.degrees(ends) if unit == "deg" else ends, 9) + 0.0
        rows.append([f"{name}{unit and ', '}{unit}", f"{low:.4g}", f"{high:.4g}"])
    return Rows(["" if region.kind == "box" else "rad or m", "from", "to"], rows)


def next_steps(region: Region, name: str) -> list[str]:
    """An arm over it."""
    joints = len(region.center) if region.kind == "joints" else 9
    arm = next((each for each in arms.names() if arms.about(each).n == joints), None)
    return [] if arm is None else [f"hf.assess(hf.arms.load({arm!r}), {name}, poses=200)  # or your own arm"]
