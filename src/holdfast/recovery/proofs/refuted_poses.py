"""A proof that a pose has no configuration as a certificate, which others check without holdfast."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.task import Task
from holdfast.certificates.claims import out_of_reach_claim
from holdfast.certificates.joint_boxes.refutations import Refutation
from holdfast.certificates.prover import certify
from holdfast.errors import InputError
from holdfast.failures import Degraded
from holdfast.grammar import TASKS

Array = NDArray[np.float64]

_FINEST = 20  # halvings of each joint: a single pose may be near to one that is reached


def refuted_pose(degraded: Degraded, task: Task, pose: Array, time_limit: float | None) -> Refutation:
    """That no configuration within what is left of the limits has a pose (4, 4): locks are limits that are equal.

    Raises:
        InputError: Other rows than those of a named task, or nothing is proved of the arm alone.
    """
    arm = degraded.arm
    if task.name not in TASKS:
        raise InputError(f"task '{task.name}' has rows of its own; certificates are about {', '.join(TASKS)}")
    flat = task.name.startswith("planar")
    yaw = float(np.arctan2(pose[1, 0], pose[0, 0]))
    found = certify(
        out_of_reach_claim(
            arm,
            pose[: 2 if flat else 3, 3],
            0.0,
            rotation=pose[:3, :3] if task.m > 3 else None,
            rpy=(yaw, yaw) if task.name == "planar-pose" else None,
            task="pointing" if task.name == "pointing" else None,
            limits=dict(enumerate(zip(degraded.lo.tolist(), degraded.hi.tolist(), strict=True))),
        ),
        halvings=_FINEST,
        time_limit=time_limit,
    )
    if found.refuted:
        raise InputError("there is no certificate: without the objects around it, and its own links, the arm reaches the pose")
    if not found.ok:
        raise InputError(f"there is no certificate: {found.describe()[1]} More time may do")
    return found
