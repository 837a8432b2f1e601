"""A region, as a notebook shows it."""

from __future__ import annotations

import numpy as np

from holdfast import arms
from holdfast.arm.model import Arm
from holdfast.present.arm.console import redundant_task
from holdfast.present.notebook import variables
from holdfast.present.printing import Rows
from holdfast.regions.region import Region

_BOX = (("x", "m"), ("y", "m"), ("z", "m"), ("yaw", "deg"), ("pitch", "deg"), ("roll", "deg"))
_CONE_COLUMNS = (
    *_BOX[:3],
    ("cosine of the angle from the axis", ""),
    ("direction about the axis", "deg"),
    ("turn about z", "deg"),
)


def sentences(region: Region) -> list[str]:
    """Its name, and what it is."""
    return [region.name, region.describe()]


def key_table(region: Region) -> Rows:
    """The bounds of a box; of a list how many poses it has."""
    if region.listed is not None:
        return Rows(["", ""], [["poses", f"{len(region.listed):,}"]])
    if region.draw is not None:
        return Rows(["", ""], [["drawn by", getattr(region.draw[0], "__name__", "a function")]])
    joints = [(f"joint {k + 1}", "") for k in range(len(region.center))]
    named = {"box": _BOX, "cone": _CONE_COLUMNS}.get(region.kind, joints)
    rows = []
    for (name, unit), center, size in zip(named, region.center, region.size, strict=True):
        ends = np.array([center - size / 2, center + size / 2])
        low, high = np.round(np.degrees(ends) if unit == "deg" else ends, 9) + 0.0
        rows.append([f"{name}{unit and ', '}{unit}", f"{low:.4g}", f"{high:.4g}"])
    return Rows(["" if region.kind in ("box", "cone") else "rad or m", "from", "to"], rows)


def picture(region: Region, about: str) -> str:
    """It with the notebook's own arm, where there is one and the region is a box."""
    from holdfast.present.arm import view

    known = [arm for _, arm in variables() if isinstance(arm, Arm)] if region.kind == "box" else []
    return view.picture(known[0], about, region) if known else ""


def next_steps(region: Region, name: str) -> list[str]:
    """An arm over it: the notebook's own where there is one, else one that comes with holdfast."""
    joints = len(region.center) if region.kind == "joints" else None
    known = next((each for each in arms.names() if arms.about(each).n == (joints or 9)), None)
    mine = [(each, arm) for each, arm in variables() if isinstance(arm, Arm) and arm.n == (joints or arm.n)]
    for text, arm in [*mine, *([] if known is None else [(f"hf.arms.load({known!r})", arms.load(known))])]:
        if (task := redundant_task(arm)) is not None:
            return [f"hf.assess({text}, {name}, task={task!r}, poses=200)"]
    return []
