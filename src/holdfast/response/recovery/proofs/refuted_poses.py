"""Certificate of a proof that a pose has no configuration, which can be verified without holdfast."""

from __future__ import annotations

import numpy as np

from holdfast.certificates.claims import out_of_reach_claim
from holdfast.certificates.joint_boxes.refutations import Refutation
from holdfast.certificates.prover import certify
from holdfast.core.errors import InputError
from holdfast.core.labels import TASK_SIZES
from holdfast.core.typing import FloatArray
from holdfast.model.arm.task import Task
from holdfast.model.failure_modes import Degraded

_MAX_JOINT_BISECTIONS = 20  # bisections of each joint, because a single pose may be close to a reachable one


def certify_unreachable_pose(degraded: Degraded, task: Task, pose: FloatArray, time_limit: float | None) -> Refutation:
    """Certify that no configuration within the remaining limits has a pose (4, 4); locked joints have equal limits.

    Raises:
        InputError: The rows are not those of a named task, or nothing is proved about the arm alone.
    """
    arm = degraded.arm
    if task.name not in TASK_SIZES:
        raise InputError(f"task '{task.name}' has custom rows; certificates are about {', '.join(TASK_SIZES)}")
    is_planar = task.name.startswith("planar")
    yaw = float(np.arctan2(pose[1, 0], pose[0, 0]))
    certificate = certify(
        out_of_reach_claim(
            arm,
            pose[: 2 if is_planar else 3, 3],
            0.0,
            rotation=pose[:3, :3] if task.m > 3 else None,
            rpy=(yaw, yaw) if task.name == "planar-pose" else None,
            task="pointing" if task.name == "pointing" else None,
            limits=dict(enumerate(zip(degraded.lo.tolist(), degraded.hi.tolist(), strict=True))),
        ),
        halvings=_MAX_JOINT_BISECTIONS,
        time_limit=time_limit,
    )
    if certificate.refuted:
        raise InputError("there is no certificate: certificates ignore collisions, and without them the arm reaches the pose")
    if not certificate.ok:
        raise InputError(f"there is no certificate: {certificate.describe()[1]} More time may help")
    return certificate
