"""Claims that an assessment suggests for a certificate."""

from __future__ import annotations

import numpy as np

from holdfast.certificates import ReachClaim, reach_claim
from holdfast.core.errors import InputError
from holdfast.kinematics.regions import Region
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task


def make_region_claim(arm: Arm, region: Region, task: Task, unreached: float) -> ReachClaim:
    """Return the claim that the arm reaches every pose of a region, after a sample that missed ``unreached`` poses.

    Raises:
        InputError: The region is not a box of positions, the task neither position nor pose, or some poses were not reached.
    """
    if region.kind != "box" or task.name not in ("position", "pose"):
        raise InputError("certificates are for boxes of positions and angles, and for tasks position and pose")
    if unreached:
        raise InputError("some sampled poses were not reached, so the claim is false; choose a smaller region")
    center, sizes = np.array(region.center), np.array(region.size)
    if task.name == "position":
        return reach_claim(arm, center[:3], sizes[:3])
    # A region has its angles in the order of the paper, about z, y and x, and a certificate in the order of URDF.
    angle_ranges = np.column_stack([center - sizes / 2, center + sizes / 2])[:2:-1]
    return reach_claim(arm, center[:3], sizes[:3], rpy=angle_ranges)
