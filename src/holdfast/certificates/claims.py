"""What a certificate is asked to prove."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.errors import InputError

Array = NDArray[np.float64]

ROWS = {"planar": 2, "position": 3}


@dataclass(frozen=True, kw_only=True)
class ReachClaim:
    """For every target of a box, and every value at which one joint may be locked, a configuration within limits reaches it.

    Attributes:
        arm: The arm, all of whose joints turn.
        task: ``position`` or ``planar``.
        box: (3, 2), planar (2, 2): targets of the tool point along each axis of the base frame, m.
        locked: Index of the locked joint; -1: the arm is healthy.
        angle: (2,) rad, between which it may be locked; None for a healthy arm.
        limits: (n, 2) rad, within which the configuration is.
    """

    arm: Arm
    task: str
    box: Array
    locked: int
    angle: Array | None
    limits: Array


@checked
def reach_claim(
    arm: Arm,
    centre: ArrayLike,
    size: ArrayLike,
    *,
    locked: Mapping[str | int, tuple[float, float]] | None = None,
    limits: Mapping[str | int, tuple[float, float]] | None = None,
) -> ReachClaim:
    """The claim that every point of a box is reached, by the healthy arm or after a lock at any angle of an interval.

    Args:
        arm: The arm; all of its joints must turn.
        centre: (3,) m, of the box of targets in the base frame; (2,) for an arm that moves in a plane.
        size: Its edges, m: one number, or one along each axis; 0: none.
        locked: ``{joint: (low, high)}``, rad, a single joint; None: the arm is healthy.
        limits: ``{joint: (low, high)}``, rad, that the configurations keep, narrower than the arm's own: working ranges.

    Raises:
        InputError: A box, joint, angle or limit that makes no claim, or an arm with slides.
    """
    middle = np.asarray(centre, dtype=np.float64).reshape(-1)
    if middle.shape not in ((2,), (3,)) or not np.isfinite(middle).all():
        raise InputError("the centre of the box must be three finite numbers, m, or two for an arm that moves in a plane")
    edges = np.broadcast_to(np.asarray(size, dtype=np.float64), middle.shape) if np.size(size) in (1, len(middle)) else None
    if edges is None or not np.isfinite(edges).all() or (edges < 0).any() or not (edges > 0).any():
        raise InputError(f"the size of the box must be one number or {len(middle)}, m, finite, not negative, not all 0")
    if arm.prismatic.any():
        slides = [name for name, slide in zip(arm.joint_names, arm.prismatic, strict=True) if slide]
        raise InputError(f"{slides[0]} slides; certificates are for arms whose joints all turn")
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
    rows = len(middle)
    if arm.n - len(locked or ()) < rows:
        raise InputError(f"{arm.n - len(locked or ())} joints are left for {rows} rows: no box can be reached")
    return ReachClaim(
        arm=arm,
        task="planar" if rows == 2 else "position",
        box=np.column_stack([middle - edges / 2, middle + edges / 2]),
        locked=which,
        angle=angle,
        limits=kept,
    )


def _within(arm: Arm, joint: str | int, pair: tuple[float, float]) -> Array:
    """An interval of a joint, in its limits."""
    k = arm.joint_index(joint)
    found = np.asarray(pair, dtype=np.float64).reshape(-1)
    if found.shape != (2,) or not np.isfinite(found).all() or found[0] > found[1]:
        raise InputError(f"the interval of {arm.joint_names[k]} must be two finite angles, rad, the lower one first")
    if found[0] < arm.lower[k] or found[1] > arm.upper[k]:
        least, most = np.rad2deg([arm.lower[k], arm.upper[k]])
        low, high = np.rad2deg(found)
        raise InputError(
            f"{arm.joint_names[k]} from {low:.4g} to {high:.4g} deg is outside of its limits, {least:.4g} to {most:.4g} deg"
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
    same = reach_claim(arm, centre, size, locked=locked, limits=limits)
    if same.task == "planar":
        turns = [*(joint.origin[:3, :3] for joint in arm.joints), arm.base[:3, :3]]
        if not all(abs(turn[2, 2]) == 1 for turn in turns) or not all(abs(joint.axis[2]) == 1 for joint in arm.joints):
            raise InputError("two coordinates are for arms that move in the xy plane; give the box of this one with three")
    return OutOfReachClaim(
        arm=arm, task=same.task, box=same.box, locked=same.locked, angle=same.angle, limits=same.limits
    )
