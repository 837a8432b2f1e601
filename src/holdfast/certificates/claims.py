"""What a certificate is asked to prove."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, real_numbers
from holdfast.arm.model import Arm
from holdfast.errors import InputError
from holdfast.failures.sets import FailureSpec, require_redundant, single_joints

Array = NDArray[np.float64]

ROWS = {"planar": 2, "position": 3, "pose": 6}
_TASKS = {2: "planar", 3: "position"}  # by coordinates of a target
_SKEWED = 1e-6  # of a rotation: so much is mended
_SIX = {"pose": 6, "planar-pose": 3}  # rows of tasks that are all of the motion


@dataclass(frozen=True, kw_only=True)
class ReachClaim:
    """For every target of a box, and every value at which one joint may be locked, a configuration within limits reaches it.

    Attributes:
        arm: The arm.
        task: ``position``, ``planar`` or ``pose``.
        box: (3, 2), planar (2, 2): targets of the tool point along each axis of the base frame, m; (6, 2) where the tool is
            turned as well: its roll, pitch and yaw, rad, the rotation Rz(yaw) Ry(pitch) Rx(roll).
        rotation: (3, 3) of the tool at every target; None where it is free, or turned.
        locked: Index of the locked joint; -1: the arm is healthy.
        angle: (2,) rad or m, between which it may be locked; None for a healthy arm.
        limits: (n, 2) rad and m, within which the configuration is.
    """

    arm: Arm
    task: str
    box: Array
    rotation: Array | None = None
    locked: int
    angle: Array | None
    limits: Array


@dataclass(frozen=True, kw_only=True)
class TolerantClaim:
    """Every target of a box is reached by the healthy arm within working ranges, and after any one joint locked within its own.

    Attributes:
        arm, task, box, rotation: As of :class:`ReachClaim`.
        working_ranges: (n, 2) rad and m, within which the healthy arm is kept, and so a joint when it locks.
        locks: Indices of the joints that may lock, one at a time, in order. After it the arm's own limits hold.
    """

    arm: Arm
    task: str
    box: Array
    rotation: Array | None = None
    working_ranges: Array
    locks: tuple[int, ...]

    @property
    def parts(self) -> tuple[ReachClaim, ...]:
        """Of the healthy arm, then of each lock."""
        own = np.column_stack([self.arm.lower, self.arm.upper])
        made = partial(ReachClaim, arm=self.arm, task=self.task, box=self.box, rotation=self.rotation)
        healthy = made(locked=-1, angle=None, limits=self.working_ranges)
        return healthy, *(made(locked=k, angle=self.working_ranges[k], limits=own) for k in self.locks)


@checked
def reach_claim(
    arm: Arm,
    centre: ArrayLike,
    size: ArrayLike,
    *,
    rotation: ArrayLike | None = None,
    rpy: ArrayLike | None = None,
    locked: Mapping[str | int, tuple[float, float]] | None = None,
    limits: Mapping[str | int, tuple[float, float]] | None = None,
) -> ReachClaim:
    """The claim that every point of a box is reached, by the healthy arm or after a lock at any angle of an interval.

    Args:
        arm: The arm.
        centre: (3,) m, of the box of targets in the base frame; (2,) for an arm that moves in a plane.
        size: Its edges, m: one number, or one along each axis; 0: none.
        rotation: (3, 3) of the tool in the base frame, at every target; None: it may turn as it likes.
        rpy: (3, 2) lowest and highest roll, pitch and yaw of the tool, rad, all of which are targets: the rotations
            Rz(yaw) Ry(pitch) Rx(roll).
        locked: ``{joint: (low, high)}``, rad or m, a single joint; None: the arm is healthy.
        limits: ``{joint: (low, high)}``, rad or m, that the configurations keep, narrower than the arm's own: working ranges.

    Raises:
        InputError: A box, joint, angle or limit that makes no claim.
    """
    box, task, turned = _targets(arm, centre, size, rotation, rpy)
    kept = np.column_stack([arm.lower, arm.upper])
    for joint, pair in (limits or {}).items():
        kept[arm.joint_index(joint)] = _within(arm, joint, pair)
    which, angle = -1, None
    if locked is not None:
        if len(locked) != 1:
            raise InputError(f"{len(locked)} joints are given as locked; a certificate is about one, or none")
        ((joint, pair),) = locked.items()
        which, angle = arm.joint_index(joint), _within(arm, joint, pair)
        if angle[0] < kept[which, 0] or angle[1] > kept[which, 1]:
            raise InputError(
                f"{arm.joint_names[which]} may lock beyond the limits that are given for it; widen these, or leave them out"
            )
    _need_joints(arm, len(locked or ()), ROWS[task])
    return ReachClaim(arm=arm, task=task, box=box, rotation=turned, locked=which, angle=angle, limits=kept)


@checked
def tolerant_claim(
    arm: Arm,
    centre: ArrayLike,
    size: ArrayLike,
    *,
    rotation: ArrayLike | None = None,
    rpy: ArrayLike | None = None,
    working_ranges: Mapping[str | int, tuple[float, float]] | None = None,
    failures: FailureSpec = "single",
) -> TolerantClaim:
    """The claim that a box of targets is failure-tolerant: reached while healthy, and after any one joint has locked.

    The healthy arm is kept within its working ranges, so a joint locks somewhere in its own; after that the arm uses all of
    its limits.

    Args:
        arm: The arm.
        centre: (3,) m, of the box of targets in the base frame; (2,) for an arm that moves in a plane.
        size: Its edges, m: one number, or one along each axis; 0: none.
        rotation: As of :func:`reach_claim`.
        rpy: Likewise.
        working_ranges: ``{joint: (low, high)}``, rad or m, within the limits; of a joint that is not named, its limits.
        failures: Which joints may lock, one at a time: ``"single"``, or a list of joints by name or index from 0.

    Raises:
        InputError: A box, joint or range that makes no claim, or a joint without limits that may lock and has no working
            range.
        TaskError: No failure, or one of several joints at once.

    Source: Lewis and Maciejewski 1997, whose guarantee for points this is over a box.
    """
    box, task, turned = _targets(arm, centre, size, rotation, rpy)
    ranges = np.column_stack([arm.lower, arm.upper])
    for joint, pair in (working_ranges or {}).items():
        ranges[arm.joint_index(joint)] = _within(arm, joint, pair)
    locks = tuple(sorted(single_joints(arm, failures)))
    for k in locks:
        if not np.isfinite(ranges[k]).all():
            raise InputError(f"{arm.joint_names[k]} has no limits, so it may lock anywhere; give its working range")
    _need_joints(arm, 1, ROWS[task])
    return TolerantClaim(arm=arm, task=task, box=box, rotation=turned, working_ranges=ranges, locks=locks)


def _targets(
    arm: Arm, centre: ArrayLike, size: ArrayLike, rotation: ArrayLike | None, rpy: ArrayLike | None
) -> tuple[Array, str, Array | None]:
    """Box, task and rotation of a claim."""
    box = _box(arm, centre, size)
    if rotation is None and rpy is None:
        return box, _TASKS[len(box)], None
    if rotation is not None and rpy is not None:
        raise InputError("rotation and rpy both say how the tool is turned; give one of them")
    if len(box) < 3:
        raise InputError("a tool is turned in space; give the centre of the box with three numbers")
    if rpy is not None:
        angles = real_numbers(rpy, "rpy", "lowest and highest roll, pitch and yaw, (3, 2), rad")
        if angles.shape != (3, 2) or not np.isfinite(angles).all() or (angles[:, 0] > angles[:, 1]).any():
            raise InputError("rpy must be the lowest and the highest roll, pitch and yaw, (3, 2), rad, finite, the lower first")
        return np.vstack([box, angles]), "pose", None
    turn = real_numbers(rotation, "rotation", "a rotation (3, 3)")
    if turn.shape != (3, 3) or not np.abs(turn.T @ turn - np.eye(3)).max() < _SKEWED or np.linalg.det(turn) < 0:
        raise InputError("rotation must be a rotation (3, 3): orthonormal columns, right-handed")
    left, _, right = np.linalg.svd(turn)
    return box, "pose", left @ right


def _box(arm: Arm, centre: ArrayLike, size: ArrayLike) -> Array:
    """(m, 2) m, of an arm for which there are certificates."""
    middle = np.asarray(centre, dtype=np.float64).reshape(-1)
    if middle.shape not in ((2,), (3,)) or not np.isfinite(middle).all():
        raise InputError("the centre of the box must be three finite numbers, m, or two for an arm that moves in a plane")
    edges = np.broadcast_to(np.asarray(size, dtype=np.float64), middle.shape) if np.size(size) in (1, len(middle)) else None
    if edges is None or not np.isfinite(edges).all() or (edges < 0).any() or not (edges > 0).any():
        raise InputError(f"the size of the box must be one number or {len(middle)}, m, finite, not negative, not all 0")
    return np.column_stack([middle - edges / 2, middle + edges / 2])


def _need_joints(arm: Arm, locked: int, rows: int) -> None:
    if arm.n - locked < rows:
        raise InputError(f"{arm.n - locked} joints are left for {rows} rows: no box can be reached")


def _within(arm: Arm, joint: str | int, pair: tuple[float, float]) -> Array:
    """An interval of a joint, in its limits."""
    k = arm.joint_index(joint)
    found = np.asarray(pair, dtype=np.float64).reshape(-1)
    if found.shape != (2,) or not np.isfinite(found).all() or found[0] > found[1]:
        values = "lengths, m" if arm.prismatic[k] else "angles, rad"
        raise InputError(f"the interval of {arm.joint_names[k]} must be two finite {values}, the lower one first")
    if found[0] < arm.lower[k] or found[1] > arm.upper[k]:
        factor, unit = arm.joints[k].shown
        low, high, least, most = (factor * x for x in (*found, arm.lower[k], arm.upper[k]))
        raise InputError(
            f"{arm.joint_names[k]} from {low:.4g} to {high:.4g} {unit} is outside of its limits, "
            f"{least:.4g} to {most:.4g} {unit}"
        )
    return found


@dataclass(frozen=True, kw_only=True)
class OutOfReachClaim:
    """For every target of a box, every value at which one joint may be locked and every configuration: the tool is elsewhere.

    Attributes:
        arm, task, box, locked, angle, limits: As of :class:`ReachClaim`.
    """

    arm: Arm
    task: str
    box: Array
    locked: int
    angle: Array | None
    limits: Array


@checked
def out_of_reach_claim(
    arm: Arm,
    centre: ArrayLike,
    size: ArrayLike,
    *,
    locked: Mapping[str | int, tuple[float, float]] | None = None,
    limits: Mapping[str | int, tuple[float, float]] | None = None,
) -> OutOfReachClaim:
    """The claim that no point of a box is reached, by the healthy arm or after a lock at any angle of an interval.

    The arguments are those of :func:`reach_claim`.

    Raises:
        InputError: A box, joint, angle or limit that makes no claim, an arm with slides, or two coordinates for an arm that
            does not move in a plane.
    """
    _need_turning(arm)
    same = reach_claim(arm, centre, size, locked=locked, limits=limits)
    if same.task == "planar":
        _need_flat(arm, "a box of two coordinates is")
    return OutOfReachClaim(arm=arm, task=same.task, box=same.box, locked=same.locked, angle=same.angle, limits=same.limits)


@dataclass(frozen=True, kw_only=True)
class BoundClaim:
    """For every configuration of a box, a bound of the least relative manipulability after one of some locks.

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
    joint_box: Array
    threshold: float
    locks: tuple[int, ...]


@checked
def ceiling_claim(
    arm: Arm,
    joint_box: Mapping[str | int, tuple[float, float]] | ArrayLike,
    threshold: float,
    *,
    failures: FailureSpec = "single",
    task: str = "pose",
) -> BoundClaim:
    """The claim that nowhere in a box of configurations relative manipulability is above a threshold.

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
    return _bound(arm, "ceiling", joint_box, threshold, failures, task)


@checked
def floor_claim(
    arm: Arm,
    joint_box: Mapping[str | int, tuple[float, float]] | ArrayLike,
    threshold: float,
    *,
    failures: FailureSpec = "single",
    task: str = "pose",
) -> BoundClaim:
    """The claim that everywhere in a box of configurations relative manipulability is a threshold or above.

    The arguments, errors and source are those of :func:`ceiling_claim`.
    """
    return _bound(arm, "floor", joint_box, threshold, failures, task)


def _bound(
    arm: Arm,
    kind: str,
    joint_box: Mapping[str | int, tuple[float, float]] | ArrayLike,
    threshold: float,
    failures: FailureSpec,
    task: str,
) -> BoundClaim:
    if task not in _SIX:
        raise InputError(f"task is '{task}'; bounds are for {' and '.join(_SIX)}, whose rows are all of the motion")
    _need_turning(arm)
    locks = tuple(sorted(single_joints(arm, failures)))
    require_redundant(arm, _SIX[task], task, tuple((k,) for k in locks))
    if task == "planar-pose":
        _need_flat(arm, "task planar-pose is")
    if isinstance(joint_box, Mapping):
        box = np.column_stack([arm.lower, arm.upper])
        for joint, pair in joint_box.items():
            box[arm.joint_index(joint)] = _within(arm, joint, pair)
    else:
        pairs = np.asarray(joint_box, dtype=np.float64)
        if pairs.shape != (arm.n, 2):
            raise InputError(f"the box must be two angles for each of {arm.n} joints, rad, not an array of {pairs.shape}")
        box = np.array([_within(arm, k, pair) for k, pair in enumerate(pairs)])
    if not np.isfinite(box).all():
        k = int(np.flatnonzero(~np.isfinite(box).all(axis=1))[0])
        raise InputError(f"{arm.joint_names[k]} has no limits; give its range")
    if not 1e-6 <= threshold < 1:
        raise InputError(f"threshold is {threshold}; it must be from 1e-6 to 1")
    # The squares of all relative manipulabilities sum to n - m, so the least of some is at most their mean.
    most = float(np.sqrt(min(1.0, (arm.n - _SIX[task]) / len(locks))))
    if threshold >= most:
        tail = "nothing to prove" if kind == "ceiling" else "no box has that floor"
        raise InputError(f"every configuration is at {most:.4g} or below, by the sum over all joints: {tail}")
    return BoundClaim(arm=arm, kind=kind, task=task, joint_box=box, threshold=float(threshold), locks=locks)


@dataclass(frozen=True, kw_only=True)
class StructuralZeroClaim:
    """Wherever the arm is, a lock of one joint costs all relative manipulability of the pose: axes say so, not angles.

    Attributes:
        arm: The arm, all of whose joints turn.
        locked: Index of the joint.
        tolerance: m, by which its geometry may miss exact ones.
    """

    arm: Arm
    locked: int
    tolerance: float

    @property
    def task(self) -> str:
        """All six rows."""
        return "pose"


@checked
def structural_zero_claim(arm: Arm, joint: str | int, *, tolerance: float = 1e-5) -> StructuralZeroClaim:
    """The claim that the axes before a joint meet in one point, and those behind it in another: that its lock costs everything.

    Args:
        arm: The arm; all of its joints must turn.
        joint: Between others, by name or index from 0.
        tolerance: m, by which the frames of the file may miss those of an arm of which it is true exactly.

    Raises:
        InputError: The first or last joint, a tolerance that is not from 0 to 1 mm, or an arm with slides.
    """
    _need_turning(arm)
    which = arm.joint_index(joint)
    if not 1 <= which <= arm.n - 2:
        raise InputError(f"{arm.joint_names[which]} is not between other joints, and only these can have a structural zero")
    if not 0 <= tolerance <= 1e-3:
        raise InputError(f"tolerance is {tolerance}; it must be from 0 to 0.001 m")
    return StructuralZeroClaim(arm=arm, locked=which, tolerance=float(tolerance))


def _need_flat(arm: Arm, what: str) -> None:
    turns = [*(joint.origin[:3, :3] for joint in arm.joints), arm.base[:3, :3]]
    if not all(abs(turn[2, 2]) == 1 for turn in turns) or not all(abs(joint.axis[2]) == 1 for joint in arm.joints):
        raise InputError(f"{what} for arms that move in the xy plane, and this one leaves it")


def _need_turning(arm: Arm) -> None:
    if arm.prismatic.any():
        slides = [name for name, slide in zip(arm.joint_names, arm.prismatic, strict=True) if slide]
        raise InputError(f"{slides[0]} slides; certificates are for arms whose joints all turn")
