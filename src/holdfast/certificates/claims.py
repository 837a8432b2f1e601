"""Claims about reaching the targets of a box."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from holdfast.certificates.kinds import Claim
from holdfast.core.errors import InputError
from holdfast.core.labels import TASK_SIZES
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.model.arm.model import Arm
from holdfast.model.failure_modes.sets import FailureSpec, single_joints

TASK_ROWS = {"planar": [0, 1], "planar-pose": [0, 1, 5], "position": [0, 1, 2], "pointing": [*range(5)], "pose": [*range(6)]}
_TASK_BY_DIMENSION = {2: "planar", 3: "position"}  # by the number of target coordinates, if the orientation is free
_ORTHONORMALITY_TOLERANCE = 1e-6  # largest deviation of a given rotation that is corrected


@dataclass(frozen=True, kw_only=True)
class TargetClaim(Claim):
    """Claim about the targets of a box, with the attributes of :class:`ReachClaim`."""

    arm: Arm
    task: str
    box: FloatArray
    rotation: FloatArray | None = None


@dataclass(frozen=True, kw_only=True)
class LockedTargetClaim(TargetClaim):
    """Claim about the targets of a box at every value at which one joint may lock."""

    locked: int
    angle: FloatArray | None
    limits: FloatArray


class ReachClaim(LockedTargetClaim):
    """Claim that a configuration within limits reaches every target of a box, for every value at which one joint may lock.

    Attributes:
        arm: The arm.
        task: ``position``, ``planar``, ``pose``, ``planar-pose`` or ``pointing``.
        box: (3, 2), or planar (2, 2), range of the tool point along each axis of the base frame, m. With ranges of the tool
            orientation (6, 2), with roll, pitch and yaw, rad, of the rotation Rz(yaw) Ry(pitch) Rx(roll); for a planar pose
            (3, 2), with yaw alone.
        rotation: (3, 3) rotation of the tool at every target, of which ``pointing`` uses only the z axis; None if the
            orientation is free or in the box.
        locked: Index of the locked joint; -1 for a healthy arm.
        angle: (2,) range in which the joint may lock, rad or m; None for a healthy arm.
        limits: (n, 2) limits of the configuration, rad and m.
    """

    kind: ClassVar[str] = "reach"


class OutOfReachClaim(LockedTargetClaim):
    """Claim that no configuration reaches any target of a box, for any value at which one joint may lock.

    The attributes ``arm``, ``task``, ``box``, ``rotation``, ``locked``, ``angle``, ``limits`` are those of :class:`ReachClaim`.
    """

    kind: ClassVar[str] = "refutation"


@dataclass(frozen=True, kw_only=True)
class TolerantClaim(TargetClaim):
    """Claim that an arm reaches every target of a box, healthy within working ranges and after any joint locks in its range.

    Attributes:
        arm, task, box, rotation: Arm, task, box of targets and tool rotation, as in :class:`ReachClaim`.
        working_ranges: (n, 2) ranges of the healthy arm, rad and m, so that a joint locks inside its range.
        locks: Indices of the joints that may lock, one at a time, in ascending order. After a lock the arm's limits hold.
    """

    kind: ClassVar[str] = "bundle"
    working_ranges: FloatArray
    locks: tuple[int, ...]

    @property
    def parts(self) -> tuple[ReachClaim, ...]:
        """Claims for the healthy arm, then for each lock."""
        arm_limits = np.column_stack([self.arm.lower, self.arm.upper])
        make_claim = partial(ReachClaim, arm=self.arm, task=self.task, box=self.box, rotation=self.rotation)
        healthy = make_claim(locked=-1, angle=None, limits=self.working_ranges)
        return healthy, *(make_claim(locked=joint, angle=self.working_ranges[joint], limits=arm_limits) for joint in self.locks)


@check_arguments
def reach_claim(
    arm: Arm,
    centre: ArrayLike,
    size: ArrayLike,
    *,
    rotation: ArrayLike | None = None,
    rpy: ArrayLike | None = None,
    task: str | None = None,
    locked: Mapping[str | int, tuple[float, float]] | None = None,
    limits: Mapping[str | int, tuple[float, float]] | None = None,
) -> ReachClaim:
    """Make the claim that the arm reaches every point of a box, healthy or after a lock at any value of an interval.

    Args:
        arm: The arm.
        centre: (3,) centre of the box of targets in the base frame, m; (2,) for an arm that moves in a plane.
        size: Edge lengths of the box, m: one number, or one for each axis. A length may be 0.
        rotation: (3, 3) rotation of the tool in the base frame at every target. None: the orientation is free.
        rpy: (3, 2) lowest and highest roll, pitch and yaw of the tool, rad; all rotations Rz(yaw) Ry(pitch) Rx(roll) in these
            ranges are targets. For an arm that moves in a plane, (2,) lowest and highest yaw.
        task: ``pointing`` if only the direction of the tool's z axis matters. Default: the task that the other arguments imply.
        locked: Range in which one joint may lock, as ``{joint: (low, high)}``, rad or m. None: the arm is healthy.
        limits: Narrower limits of the configurations, for example working ranges, as ``{joint: (low, high)}``, rad or m. For a
            further locked joint, give its value twice.

    Raises:
        InputError: The box, a joint, an interval or a limit is invalid.
    """
    claim = ReachClaim(arm=arm, **_parse_targets(arm, centre, size, rotation, rpy, task), **_parse_lock(arm, locked, limits))
    is_fixed = (claim.limits[:, 0] == claim.limits[:, 1]) | (np.arange(arm.n) == claim.locked)
    _require_enough_free_joints(arm, int(is_fixed.sum()), claim.task)
    return claim


@check_arguments
def tolerant_claim(
    arm: Arm,
    centre: ArrayLike,
    size: ArrayLike,
    *,
    rotation: ArrayLike | None = None,
    rpy: ArrayLike | None = None,
    task: str | None = None,
    working_ranges: Mapping[str | int, tuple[float, float]] | None = None,
    failures: FailureSpec = "single",
) -> TolerantClaim:
    """Make the claim that a box of targets is failure-tolerant: the arm reaches it healthy and after any one joint has locked.

    The healthy arm stays within its working ranges, so a joint locks inside its own range. After the lock the arm uses its full
    limits.

    Args:
        arm: The arm.
        centre: (3,) centre of the box of targets in the base frame, m; (2,) for an arm that moves in a plane.
        size: Edge lengths of the box, m: one number, or one for each axis. A length may be 0.
        rotation: (3, 3) rotation of the tool in the base frame at every target. None: the orientation is free.
        rpy: (3, 2) lowest and highest roll, pitch and yaw, rad, or (2,) yaw, as in :func:`reach_claim`.
        task: ``pointing`` if only the direction of the tool's z axis matters. Default: the task that the others imply.
        working_ranges: Ranges within the limits as ``{joint: (low, high)}``, rad or m. Default for a joint: its limits.
        failures: Joints that may lock, one at a time: ``"single"``, or a list of joints by name or index from 0.

    Raises:
        InputError: The box, a joint or a range is invalid, or a joint that may lock has neither limits nor a working range.
        TaskError: There is no failure, or a failure of several joints at once.

    Source: Lewis and Maciejewski 1997 for the guarantee at points, which is extended to a box here.
    """
    targets, ranges = _parse_targets(arm, centre, size, rotation, rpy, task), narrow_limits(arm, working_ranges or {})
    locks = tuple(sorted(single_joints(arm, failures)))
    for joint in locks:
        if not np.isfinite(ranges[joint]).all():
            raise InputError(f"{arm.joint_names[joint]} has no limits, so it may lock anywhere; give its working range")
    _require_enough_free_joints(arm, 1, targets["task"])
    return TolerantClaim(arm=arm, **targets, working_ranges=ranges, locks=locks)


def _parse_targets(
    arm: Arm, centre: ArrayLike, size: ArrayLike, rotation: ArrayLike | None, rpy: ArrayLike | None, task: str | None
) -> dict[str, Any]:
    """Return the box, the task and the rotation of a claim."""
    box = _make_target_box(arm, centre, size)
    if task not in (None, "pointing"):
        raise InputError(f"task is '{task}'; give pointing, or leave it out: the box and the rotation imply the other tasks")
    if rotation is None and rpy is None and task is None:
        if len(box) == 2:
            require_planar(arm, "a box of two coordinates is", allow_prismatic=True)
        return {"box": box, "task": _TASK_BY_DIMENSION[len(box)]}
    if (rotation is None) == (rpy is None):
        raise InputError("rotation and rpy both give the orientation of the tool; give one of them")
    if rpy is not None:
        if task is not None:
            raise InputError("pointing has one direction; give rotation, whose z axis is this direction, in place of rpy")
        angles, expected_shape = require_real_numbers(rpy, "rpy", "lowest and highest roll, pitch and yaw, (3, 2), rad"), [3, 2]
        description = "the lowest and the highest roll, pitch and yaw, (3, 2)"
        if len(box) == 2:
            require_planar(arm, "a planar pose is")
            expected_shape, description = [2], "the lowest and the highest yaw, (2,)"
        intervals = angles.reshape(-1, 2) if list(angles.shape) == expected_shape else np.array([[1.0, 0.0]])
        if not np.isfinite(intervals).all() or (intervals[:, 0] > intervals[:, 1]).any():
            raise InputError(f"rpy must be {description}, rad, finite, the lower first")
        return {"box": np.vstack([box, intervals]), "task": "pose" if len(box) == 3 else "planar-pose"}
    if len(box) < 3:
        raise InputError("rotation needs a box in space; give the centre of the box with three numbers, or in the plane rpy")
    matrix = require_real_numbers(rotation, "rotation", "a rotation (3, 3)")
    is_orthonormal = matrix.shape == (3, 3) and np.abs(matrix.T @ matrix - np.eye(3)).max() < _ORTHONORMALITY_TOLERANCE
    if not is_orthonormal or np.linalg.det(matrix) < 0:
        raise InputError("rotation must be a rotation (3, 3): orthonormal columns, right-handed")
    left_vectors, _, right_vectors = np.linalg.svd(matrix)
    return {"box": box, "task": task or "pose", "rotation": left_vectors @ right_vectors}


def _make_target_box(arm: Arm, centre: ArrayLike, size: ArrayLike) -> FloatArray:
    """Return the bounds (m, 2) of a box of targets, m, after checking its center and size."""
    center = np.asarray(centre, dtype=np.float64).reshape(-1)
    if center.shape not in ((2,), (3,)) or not np.isfinite(center).all():
        raise InputError("the centre of the box must be three finite numbers, m, or two for an arm that moves in a plane")
    edges = np.broadcast_to(np.asarray(size, dtype=np.float64), center.shape) if np.size(size) in (1, len(center)) else None
    if edges is None or not np.isfinite(edges).all() or (edges < 0).any():
        raise InputError(f"the size of the box must be one number or {len(center)}, m, finite, not negative")
    return np.column_stack([center - edges / 2, center + edges / 2])


def _parse_lock(
    arm: Arm, locked: Mapping[str | int, tuple[float, float]] | None, limits: Mapping[str | int, tuple[float, float]] | None
) -> dict[str, Any]:
    """Return the index of the locked joint (-1 for none), its interval of locked values, and the limits of all joints."""
    joint_limits = narrow_limits(arm, limits or {})
    if locked is None:
        return {"locked": -1, "angle": None, "limits": joint_limits}
    if len(locked) != 1:
        raise InputError(f"locked has {len(locked)} joints; a certificate is about one, or none")
    ((joint, bounds),) = locked.items()
    index, interval = arm.joint_index(joint), validate_interval(arm, joint, bounds)
    if interval[0] < joint_limits[index, 0] or interval[1] > joint_limits[index, 1]:
        name = arm.joint_names[index]
        raise InputError(f"{name} may lock beyond the limits that are given; widen these, or leave them out")
    return {"locked": index, "angle": interval, "limits": joint_limits}


def _require_enough_free_joints(arm: Arm, locked_count: int, task: str) -> None:
    if arm.n - locked_count < TASK_SIZES[task]:
        raise InputError(f"{arm.n - locked_count} joints are free for {TASK_SIZES[task]} task rows, so no box can be reached")


def narrow_limits(arm: Arm, intervals: Mapping[str | int, tuple[float, float]]) -> FloatArray:
    """Return joint limits (n, 2), rad and m, in which the given intervals replace the limits of the arm."""
    limits = np.column_stack([arm.lower, arm.upper])
    for joint, interval in intervals.items():
        limits[arm.joint_index(joint)] = validate_interval(arm, joint, interval)
    return limits


def validate_interval(arm: Arm, joint: str | int, bounds: tuple[float, float]) -> FloatArray:
    """Return the interval of a joint as an array after checking that it lies within the joint's limits."""
    index = arm.joint_index(joint)
    interval = np.asarray(bounds, dtype=np.float64).reshape(-1)
    if interval.shape != (2,) or not np.isfinite(interval).all() or interval[0] > interval[1]:
        value_kind = "lengths, m" if arm.prismatic[index] else "angles, rad"
        interval_text = " to ".join(f"{x:.4g}" for x in interval)
        reason = f"is {interval_text}; it must be two finite {value_kind}, the lower one first"
        raise InputError(f"the interval of {arm.joint_names[index]} {reason}")
    if interval[0] < arm.lower[index] or interval[1] > arm.upper[index]:
        factor, unit = arm.joints[index].display_unit
        lower, upper, lower_limit, upper_limit = (factor * x for x in (*interval, arm.lower[index], arm.upper[index]))
        raise InputError(
            f"{arm.joint_names[index]} from {lower:.4g} to {upper:.4g} {unit} is outside of its limits, "
            f"{lower_limit:.4g} to {upper_limit:.4g} {unit}"
        )
    return interval


@check_arguments
def out_of_reach_claim(
    arm: Arm,
    centre: ArrayLike,
    size: ArrayLike,
    *,
    rotation: ArrayLike | None = None,
    rpy: ArrayLike | None = None,
    task: str | None = None,
    locked: Mapping[str | int, tuple[float, float]] | None = None,
    limits: Mapping[str | int, tuple[float, float]] | None = None,
) -> OutOfReachClaim:
    """Make the claim that the arm reaches no point of a box, healthy or after a lock at any value of an interval.

    ``arm``, ``centre``, ``size``, ``rotation``, ``rpy``, ``task``, ``locked`` and ``limits`` are those of :func:`reach_claim`;
    ``size`` may be 0 for a single target.

    Raises:
        InputError: The box, a joint, an interval or a limit is invalid, a prismatic joint has no limits, or the box has two
            coordinates but the arm leaves the plane.
    """
    targets = _parse_targets(arm, centre, size, rotation, rpy, task)
    if targets["task"] == "planar":
        require_planar(arm, "a box of two coordinates is")
    claim = OutOfReachClaim(arm=arm, **targets, **_parse_lock(arm, locked, limits))
    is_endless = arm.prismatic & ~np.isfinite(claim.limits).all(axis=1) & (np.arange(arm.n) != claim.locked)
    if is_endless.any():
        raise InputError(f"prismatic joint {arm.joint_names[int(np.argmax(is_endless))]} has no limits; give its range")
    return claim


def require_planar(arm: Arm, message_start: str, allow_prismatic: bool = False) -> None:
    """Raise an error, which begins with ``message_start``, unless the arm moves in the xy plane (with revolute joints only)."""
    rotations = [*(joint.origin[:3, :3] for joint in arm.joints), arm.base[:3, :3]]
    upright = [allow_prismatic if joint.prismatic else abs(joint.axis[2]) == 1 for joint in arm.joints]
    if not all(abs(rotation[2, 2]) == 1 for rotation in rotations) or not all(upright):
        raise InputError(f"{message_start} for arms that move in the xy plane, but this arm leaves it")


def require_revolute(arm: Arm, message_start: str) -> None:
    """Raise an error, whose reason begins with ``message_start``, if the arm has a prismatic joint."""
    if arm.prismatic.any():
        prismatic_joints = [name for name, is_prismatic in zip(arm.joint_names, arm.prismatic, strict=True) if is_prismatic]
        raise InputError(f"{prismatic_joints[0]} is prismatic; {message_start} for arms with revolute joints only")
