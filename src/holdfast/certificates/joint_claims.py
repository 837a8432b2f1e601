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

_TASK_DIMENSIONS = {"pose": 6, "planar-pose": 3}  # rows of tasks that prescribe the whole motion


@dataclass(frozen=True, kw_only=True)
class BoundClaim(Claim):
    """Claim that bounds the least relative manipulability after one of some locks, for every configuration of a box.

    Attributes:
        arm: The arm, with revolute joints only.
        kind: ``ceiling`` if the threshold is an upper bound, ``floor`` if it is a lower bound.
        task: ``pose`` or ``planar-pose``.
        joint_box: (n, 2) lowest and highest value of each joint, rad.
        threshold: Bound of the relative manipulability, between 0 and 1.
        locks: Indices of the joints that may lock, one at a time, in ascending order.
    """

    arm: Arm
    kind: str
    task: str
    joint_box: FloatArray
    threshold: float
    locks: tuple[int, ...]

    @property
    def most(self) -> float:
        """Upper bound at every configuration, because all squares sum to n - m, and the least of some is at most their mean."""
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
        arm: The arm; all of its joints must be revolute.
        joint_box: (n, 2) lowest and highest value of each joint, rad; or ``{joint: (low, high)}``, in which the default for a
            joint is its limits.
        threshold: Bound of the relative manipulability, from 1e-6 to 1.
        failures: Joints that may lock, one at a time: ``"single"``, or a list of joints by name or index from 0.
        task: ``pose``, or ``planar-pose`` for an arm that moves in a plane.

    Raises:
        InputError: The box or threshold is invalid, no configuration exceeds the threshold, the task is another one, or the arm
            has a prismatic joint.
        TaskError: The arm has no redundancy, or a failure does not have exactly one joint.

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

    ``arm``, ``joint_box``, ``threshold``, ``failures``, ``task``, the errors and the source are those of :func:`ceiling_claim`.
    """
    return _make_bound_claim(arm, "floor", joint_box, threshold, failures, task)


def _make_bound_claim(arm: Arm, kind: str, joint_box: Any, threshold: float, failures: FailureSpec, task: str) -> BoundClaim:
    if task not in _TASK_DIMENSIONS:
        raise InputError(f"task is '{task}'; for a bound it must be {' or '.join(_TASK_DIMENSIONS)}")
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
        advice = "give a lower threshold" if kind == "ceiling" else "no box has a higher floor"
        raise InputError(f"threshold is {threshold:g}, but every configuration is at {claim.most:.4g} or below; {advice}")
    return claim


@dataclass(frozen=True, kw_only=True)
class StructuralZeroClaim(Claim):
    """Claim that a lock of one joint removes all relative manipulability of the pose in every configuration.

    Attributes:
        arm: The arm, with revolute joints only.
        locked: Index of the locked joint.
        tolerance: Largest distance, m, of the geometry from one for which the claim holds exactly.
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
    """Make the claim that a lock of a joint removes all relative manipulability, because the other axes meet in two points.

    The axes before the joint meet in one point, and those behind it in another.

    Args:
        arm: The arm; all of its joints must be revolute.
        joint: Name, or index from 0, of a joint between others.
        tolerance: Largest distance, m, of the frames in the file from those of an arm for which the claim holds exactly.

    Raises:
        InputError: The joint is the first or last one, the tolerance is not from 0 to 1 mm, or the arm has a prismatic joint.
    """
    require_revolute(arm, "structural zeros are")
    index = arm.joint_index(joint)
    if not 1 <= index <= arm.n - 2:
        raise InputError(f"{arm.joint_names[index]} is the first or last joint; give a joint between other joints")
    if not 0 <= tolerance <= 1e-3:
        raise InputError(f"tolerance is {tolerance}; it must be from 0 to 0.001 m")
    return StructuralZeroClaim(arm=arm, locked=index, tolerance=float(tolerance))
