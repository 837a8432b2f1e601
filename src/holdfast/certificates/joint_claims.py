"""Claims about configurations: bounds of relative manipulability, and structural zeros."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from holdfast.certificates.claims import narrow_limits, require_planar, require_revolute, validate_interval
from holdfast.certificates.kinds import Claim
from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm
from holdfast.model.failure_modes.sets import FailureSpec, require_redundant, single_joints

_TASK_DIMENSIONS = {"pose": 6, "planar-pose": 3}  # rows of tasks that are all of the motion


@dataclass(frozen=True, kw_only=True)
class BoundClaim(Claim):
    """Bound of the least relative manipulability after one of some locks, for every configuration of a box.

    Attributes:
        arm: The arm, all of whose joints turn.
        kind: ``ceiling``: at most the threshold; ``floor``: at least.
        task: ``pose``, or ``planar-pose``.
        joint_box: (n, 2) rad.
        threshold: Between 0 and 1.
        locks: Indices of the joints that may lock, one at a time, in order.
    """

    arm: Arm
    kind: str
    task: str
    joint_box: FloatArray
    threshold: float
    locks: tuple[int, ...]

    @property
    def most(self) -> float:
        """Upper bound of every configuration: all squares sum to n - m, and the least of some is at most their mean."""
        return float(np.sqrt(min(1.0, (self.arm.n - _TASK_DIMENSIONS[self.task]) / len(self.locks))))


@check_arguments
def ceiling_claim(
    arm: Arm,
    joint_box: Mapping[str | int, tuple[float, float]] | ArrayLike,
    threshold: float,
    *,
    failures: FailureSpec = "single",
    task: str = "pose",
) -> BoundClaim:
    """Make the claim that relative manipulability is nowhere above a threshold in a box of configurations.

    Args:
        arm: The arm; all of its joints must turn.
        joint_box: (n, 2) rad, lowest and highest value of each joint; or ``{joint: (low, high)}``, of a joint that is not named
            its limits.
        threshold: Between 0 and 1.
        failures: Which joints may lock, one at a time: ``"single"``, or a list of joints by name or index from 0.
        task: ``pose``; ``planar-pose`` for an arm that moves in a plane.

    Raises:
        InputError: A box or threshold that makes no claim, a threshold that no configuration exceeds, another task, or an arm
            with slides.
        TaskError: An arm without redundancy, no failures, or failures of several joints at once.

    Source: Abdi, Maciejewski and Nahavandi 2012, eq. (3), for relative manipulability.
    """
    return _make_bound_claim(arm, "ceiling", joint_box, threshold, failures, task)


@check_arguments
def floor_claim(
    arm: Arm,
    joint_box: Mapping[str | int, tuple[float, float]] | ArrayLike,
    threshold: float,
    *,
    failures: FailureSpec = "single",
    task: str = "pose",
) -> BoundClaim:
    """Make the claim that relative manipulability is everywhere at least a threshold in a box of configurations.

    The arguments, errors and source are those of :func:`ceiling_claim`.
    """
    return _make_bound_claim(arm, "floor", joint_box, threshold, failures, task)


def _make_bound_claim(arm: Arm, kind: str, joint_box: Any, threshold: float, failures: FailureSpec, task: str) -> BoundClaim:
    if task not in _TASK_DIMENSIONS:
        raise InputError(f"task is '{task}'; bounds are for {' and '.join(_TASK_DIMENSIONS)}, whose rows are all of the motion")
    require_revolute(arm, "bounds are")
    locks = tuple(sorted(single_joints(arm, failures)))
    require_redundant(arm, _TASK_DIMENSIONS[task], task, tuple((index,) for index in locks))
    if task == "planar-pose":
        require_planar(arm, "task planar-pose is")
    if isinstance(joint_box, Mapping):
        box = narrow_limits(arm, joint_box)
    else:
        intervals = np.asarray(joint_box, dtype=np.float64)
        if intervals.shape != (arm.n, 2):
            raise InputError(f"the box must be two angles for each of {arm.n} joints, rad, not an array of {intervals.shape}")
        box = np.array([validate_interval(arm, index, interval) for index, interval in enumerate(intervals)])
    if not np.isfinite(box).all():
        raise InputError(f"{arm.joint_names[int(np.argwhere(~np.isfinite(box))[0, 0])]} has no limits; give its range")
    if not 1e-6 <= threshold < 1:
        raise InputError(f"threshold is {threshold}; it must be from 1e-6 to 1")
    claim = BoundClaim(arm=arm, kind=kind, task=task, joint_box=box, threshold=float(threshold), locks=locks)
    if threshold >= claim.most:
        reason = "nothing to prove" if kind == "ceiling" else "no box has that floor"
        raise InputError(f"every configuration is at {claim.most:.4g} or below, by the sum over all joints: {reason}")
    return claim


@dataclass(frozen=True, kw_only=True)
class StructuralZeroClaim(Claim):
    """Claim that the axes of the arm make a lock of one joint remove all relative manipulability of the pose in every
    configuration.

    Attributes:
        arm: The arm, all of whose joints turn.
        locked: Index of the joint.
        tolerance: m, by which its geometry may miss exact ones.
    """

    kind: ClassVar[str] = "structural-zero"
    arm: Arm
    locked: int
    tolerance: float

    @property
    def task(self) -> str:
        """Name of the task, which has all six rows."""
        return "pose"


@check_arguments
def structural_zero_claim(arm: Arm, joint: str | int, *, tolerance: float = 1e-5) -> StructuralZeroClaim:
    """Make the claim that the axes before a joint meet in one point and those behind it in another, so that its lock removes
    all relative manipulability.

    Args:
        arm: The arm; all of its joints must turn.
        joint: Between others, by name or index from 0.
        tolerance: m, by which the frames of the file may miss those of an arm of which it is true exactly.

    Raises:
        InputError: The first or last joint, a tolerance that is not from 0 to 1 mm, or an arm with slides.
    """
    require_revolute(arm, "structural zeros are")
    index = arm.joint_index(joint)
    if not 1 <= index <= arm.n - 2:
        raise InputError(f"{arm.joint_names[index]} is not between other joints, and only these can have a structural zero")
    if not 0 <= tolerance <= 1e-3:
        raise InputError(f"tolerance is {tolerance}; it must be from 0 to 0.001 m")
    return StructuralZeroClaim(arm=arm, locked=index, tolerance=float(tolerance))
