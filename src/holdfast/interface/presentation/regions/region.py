"""Notebook view of a region."""

from __future__ import annotations

import numpy as np

from holdfast.interface.presentation.arm.console import find_redundant_task
from holdfast.interface.presentation.notebook import list_variables
from holdfast.interface.presentation.printing import TextTable
from holdfast.kinematics.regions.region import Region
from holdfast.model import arms
from holdfast.model.arm.model import Arm

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


def picture(region: Region, about: str) -> str:
    """Draw the region with the notebook's own arm, if there is one and the region is a box."""
    from holdfast.interface.presentation.arm import view

    notebook_arms = [arm for _, arm in list_variables() if isinstance(arm, Arm)] if region.kind == "box" else []
    return view.picture(notebook_arms[0], about, region) if notebook_arms else ""


def next_steps(region: Region, name: str) -> list[str]:
    """Suggest an assessment over the region, with the notebook's own arm if there is one, else with a built-in one."""
    joints = len(region.center) if region.kind == "joints" else None
    library_arm = next((arm_name for arm_name in arms.names() if arms.about(arm_name).n == (joints or 9)), None)
    notebook_arms = [
        (arm_name, arm) for arm_name, arm in list_variables() if isinstance(arm, Arm) and arm.n == (joints or arm.n)
    ]
    for text, arm in [
        *notebook_arms,
        *([] if library_arm is None else [(f"hf.arms.load({library_arm!r})", arms.load(library_arm))]),
    ]:
        if (task := find_redundant_task(arm)) is not None:
            return [f"hf.assess({text}, {name}, task={task!r}, poses=200)"]
    return []
