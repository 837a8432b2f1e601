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
from holdfast.failures.sets import FailureSpec, single_joints
from holdfast.grammar import TASKS

Array = NDArray[np.float64]

ROWS = {
    "planar": [0, 1],
    "planar-pose": [0, 1, 5],
    "position": [0, 1, 2],
    "pointing": [0, 1, 2, 3, 4],
    "pose": [0, 1, 2, 3, 4, 5],
}  # of tool paths
_TASKS = {2: "planar", 3: "position"}  # by coordinates of a target, where the tool may turn as it likes
_SKEWED = 1e-6  # of a rotation: so much is mended


@dataclass(frozen=True, kw_only=True)
class ReachClaim:
    """For every target of a box, and every value at which one joint may be locked, a configuration within limits reaches it.

    Attributes:
        arm: The arm.
        task: ``position``, ``planar``, ``pose``, ``planar-pose`` or ``pointing``.
        box: (3, 2), planar (2, 2): targets of the tool point along each axis of the base frame, m; (6, 2) where the tool is
            turned as well: its roll, pitch and yaw, rad, the rotation Rz(yaw) Ry(pitch) Rx(roll); (3, 2) of a planar pose, with
            yaw alone.
        rotation: (3, 3) of the tool at every target, when pointing that of its z axis alone; None where it is free, or turned.
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
    task: str | None = None,
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
            Rz(yaw) Ry(pitch) Rx(roll). Of an arm that moves in a plane (2,), of its yaw.
        task: ``pointing``: only where its z axis points counts of the rotation. Default: what the other arguments say.
        locked: ``{joint: (low, high)}``, rad or m, a single joint; None: the arm is healthy.
        limits: ``{joint: (low, high)}``, rad or m, that the configurations keep, within the arm's own: working ranges. Of
            another joint that is locked, twice where it is.

    Raises:
        InputError: A box, joint, angle or limit that makes no claim.
    """
    box, rows, turned = _targets(arm, centre, size, rotation, rpy, task)
    which, angle, kept = _lock(arm, locked, limits)
    still = (kept[:, 0] == kept[:, 1]) | (np.arange(arm.n) == which)
    _need_joints(arm, int(still.sum()), rows)
    return ReachClaim(arm=arm, task=rows, box=box, rotation=turned, locked=which, angle=angle, limits=kept)


@checked
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
    """The claim that a box of targets is failure-tolerant: reached while healthy, and after any one joint has locked.

    The healthy arm is kept within its working ranges, so a joint locks somewhere in its own; after that the arm uses all of
    its limits.

    Args:
        arm: The arm.
        centre: (3,) m, of the box of targets in the base frame; (2,) for an arm that moves in a plane.
        size: Its edges, m: one number, or one along each axis; 0: none.
        rotation: As of :func:`reach_claim`.
        rpy: Likewise.
        task: Likewise.
        working_ranges: ``{joint: (low, high)}``, rad or m, within the limits; of a joint that is not named, its limits.
        failures: Which joints may lock, one at a time: ``"single"``, or a list of joints by name or index from 0.

    Raises:
        InputError: A box, joint or range that makes no claim, or a joint without limits that may lock and has no working
            range.
        TaskError: No failure, or one of several joints at once.

    Source: Lewis and Maciejewski 1997, whose guarantee for points this is over a box.
    """
    box, rows, turned = _targets(arm, centre, size, rotation, rpy, task)
    ranges = narrowed(arm, working_ranges or {})
    locks = tuple(sorted(single_joints(arm, failures)))
    for k in locks:
        if not np.isfinite(ranges[k]).all():
            raise InputError(f"{arm.joint_names[k]} has no limits, so it may lock anywhere; give its working range")
    _need_joints(arm, 1, rows)
    return TolerantClaim(arm=arm, task=rows, box=box, rotation=turned, working_ranges=ranges, locks=locks)


def _targets(
    arm: Arm, centre: ArrayLike, size: ArrayLike, rotation: ArrayLike | None, rpy: ArrayLike | None, task: str | None
) -> tuple[Array, str, Array | None]:
    """Box, task and rotation of a claim."""
    box = _box(arm, centre, size)
    if task not in (None, "pointing"):
        raise InputError(f"task is '{task}'; give pointing, or leave it out: the box and the rotation say the rest")
    if rotation is None and rpy is None and task is None:
        if len(box) == 2:
            need_flat(arm, "a box of two coordinates is", slides=True)
        return box, _TASKS[len(box)], None
    if (rotation is None) == (rpy is None):
        raise InputError("rotation and rpy both say how the tool is turned; give one of them")
    if rpy is not None:
        if task is not None:
            raise InputError("pointing is about one direction: give rotation, whose z axis it is, in place of rpy")
        angles, said = real_numbers(rpy, "rpy", "lowest and highest roll, pitch and yaw, (3, 2), rad"), [3, 2]
        what = "the lowest and the highest roll, pitch and yaw, (3, 2)"
        if len(box) == 2:
            need_flat(arm, "a planar pose is")
            said, what = [2], "the lowest and the highest yaw, (2,)"
        pairs = angles.reshape(-1, 2) if list(angles.shape) == said else np.array([[1.0, 0.0]])
        if not np.isfinite(pairs).all() or (pairs[:, 0] > pairs[:, 1]).any():
            raise InputError(f"rpy must be {what}, rad, finite, the lower first")
        return np.vstack([box, pairs]), "pose" if len(box) == 3 else "planar-pose", None
    if len(box) < 3:
        raise InputError("a tool is turned in space; give the centre of the box with three numbers, or in the plane rpy")
    turn = real_numbers(rotation, "rotation", "a rotation (3, 3)")
    if turn.shape != (3, 3) or not np.abs(turn.T @ turn - np.eye(3)).max() < _SKEWED or np.linalg.det(turn) < 0:
        raise InputError("rotation must be a rotation (3, 3): orthonormal columns, right-handed")
    left, _, right = np.linalg.svd(turn)
    return box, task or "pose", left @ right


def _box(arm: Arm, centre: ArrayLike, size: ArrayLike) -> Array:
    """(m, 2) m, of an arm for which there are certificates."""
    middle = np.asarray(centre, dtype=np.float64).reshape(-1)
    if middle.shape not in ((2,), (3,)) or not np.isfinite(middle).all():
        raise InputError("the centre of the box must be three finite numbers, m, or two for an arm that moves in a plane")
    edges = np.broadcast_to(np.asarray(size, dtype=np.float64), middle.shape) if np.size(size) in (1, len(middle)) else None
    if edges is None or not np.isfinite(edges).all() or (edges < 0).any():
        raise InputError(f"the size of the box must be one number or {len(middle)}, m, finite, not negative")
    return np.column_stack([middle - edges / 2, middle + edges / 2])


def _lock(
    arm: Arm,
    locked: Mapping[str | int, tuple[float, float]] | None,
    limits: Mapping[str | int, tuple[float, float]] | None,
) -> tuple[int, Array | None, Array]:
    """Which joint is locked, -1 if none is, between which values, and the limits of all."""
    kept = narrowed(arm, limits or {})
    which, angle = -1, None
    if locked is not None:
        if len(locked) != 1:
            raise InputError(f"{len(locked)} joints are given as locked; a certificate is about one, or none")
        ((joint, pair),) = locked.items()
        which, angle = arm.joint_index(joint), within(arm, joint, pair)
        if angle[0] < kept[which, 0] or angle[1] > kept[which, 1]:
            raise InputError(
                f"{arm.joint_names[which]} may lock beyond the limits that are given for it; widen these, or leave them out"
            )
    return which, angle, kept


def _need_joints(arm: Arm, locked: int, task: str) -> None:
    if arm.n - locked < TASKS[task]:
        raise InputError(f"{arm.n - locked} joints are left for {TASKS[task]} rows: no box can be reached")


def narrowed(arm: Arm, intervals: Mapping[str | int, tuple[float, float]]) -> Array:
    """(n, 2) rad and m, the intervals of some joints, which are in their limits, and the limits of the others."""
    kept = np.column_stack([arm.lower, arm.upper])
    for joint, pair in intervals.items():
        kept[arm.joint_index(joint)] = within(arm, joint, pair)
    return kept


def within(arm: Arm, joint: str | int, pair: tuple[float, float]) -> Array:
    """An interval of a joint, in its limits."""
    k = arm.joint_index(joint)
    found = np.asarray(pair, dtype=np.float64).reshape(-1)
    if found.shape != (2,) or not np.isfinite(found).all() or found[0] > found[1]:
        values = "lengths, m" if arm.prismatic[k] else "angles, rad"
        given = " to ".join(f"{x:.4g}" for x in found)
        raise InputError(
            f"the interval of {arm.joint_names[k]} is {given}; it must be two finite {values}, the lower one first"
        )
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
        arm, task, box, rotation, locked, angle, limits: As of :class:`ReachClaim`.
    """

    arm: Arm
    task: str
    box: Array
    rotation: Array | None = None
    locked: int
    angle: Array | None
    limits: Array


@checked
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
    """The claim that no point of a box is reached, by the healthy arm or after a lock at any angle of an interval.

    The arguments are those of :func:`reach_claim`; size may be 0, for a single target.

    Raises:
        InputError: A box, joint, angle or limit that makes no claim, a slide without limits, or two coordinates for an arm that
            does not move in a plane.
    """
    box, rows, turned = _targets(arm, centre, size, rotation, rpy, task)
    if rows == "planar":
        need_flat(arm, "a box of two coordinates is")
    which, angle, kept = _lock(arm, locked, limits)
    endless = np.flatnonzero(arm.prismatic & ~np.isfinite(kept).all(axis=1) & (np.arange(arm.n) != which))
    if endless.size:
        raise InputError(f"{arm.joint_names[endless[0]]} slides without limits; give its range")
    return OutOfReachClaim(arm=arm, task=rows, box=box, rotation=turned, locked=which, angle=angle, limits=kept)


def need_flat(arm: Arm, what: str, slides: bool = False) -> None:
    """Refuse an arm whose joints do not all turn about axes parallel to z, or slide, if they may; ``what`` is asked of it."""
    turns = [*(joint.origin[:3, :3] for joint in arm.joints), arm.base[:3, :3]]
    upright = [slides if joint.prismatic else abs(joint.axis[2]) == 1 for joint in arm.joints]
    if not all(abs(turn[2, 2]) == 1 for turn in turns) or not all(upright):
        raise InputError(f"{what} for arms that move in the xy plane, and this one leaves it")


def need_turning(arm: Arm, what: str) -> None:
    """Refuse an arm with a joint that slides; ``what`` is asked of it."""
    if arm.prismatic.any():
        slides = [name for name, slide in zip(arm.joint_names, arm.prismatic, strict=True) if slide]
        raise InputError(f"{slides[0]} slides; {what} for arms whose joints all turn")
