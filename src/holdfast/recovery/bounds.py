"""Bounds from geometry alone: where the end effector of a failed arm can never be."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_SLACK = 1e-9  # of the arm's own length: rounding of the bounds themselves


def out_of_reach(arm: Arm, free: Flags, at: Array, pose: Array, whole_pose: bool, planar: Array | None) -> str | None:
    """A sentence that proves a pose out of reach with joints locked; None if this bound cannot.

    The failed arm is a chain of rigid parts between the axes that still move. The end effector is no farther from the first of
    them than the sum of the parts' lengths, and no nearer than the longest less the others. Of a full pose also the origin of
    the last axis is known, which leaves one part less and a sharper bound.

    Args:
        arm: The arm.
        free: (n,) joints that move.
        at: (n,) where the others are.
        pose: (4, 4) of the end effector, m.
        whole_pose: The orientation counts too.
        planar: Normal (3,) of the plane in which the arm moves and the position counts, or None for the whole position.
    """
    moving = np.flatnonzero(free)
    if not moving.size:
        return None
    flat = planar is not None and not arm.prismatic[moving].any()
    place, offsets = arm.base, []
    for k, joint in enumerate(arm.joints):
        place = place @ joint.origin
        if free[k]:
            offsets.append(place[:3, 3])
            place = np.eye(4)
        else:
            place = place @ joint.motion(float(at[k]))
    tail = place @ arm.tool  # from the last moving joint to the tool
    centre = offsets[0]
    lengths = [_range(arm, k, offset, flat) for k, offset in zip(moving[:-1], offsets[1:], strict=True)]
    proofs = [("the end effector", pose[:3, 3], [*lengths, _range(arm, moving[-1], tail[:3, 3], flat)])]
    if whole_pose and not arm.prismatic[moving[-1]] and len(lengths):
        wrist = pose @ np.linalg.inv(tail)
        proofs.append((f"the axis of {arm.joint_names[moving[-1]]}", wrist[:3, 3], lengths))
    slack = _SLACK * arm.length_unit
    for what, target, spans in proofs:
        away = target - centre
        if planar is not None:
            away = away - planar * (planar @ away)
        distance = float(np.linalg.norm(away))
        most = sum(high for _, high in spans)
        longest = max(spans, key=lambda s: s[0])
        least = longest[0] - (most - longest[1])
        if distance > most + slack:
            return (
                f"proved out of reach: {what} would be {distance:.4g} m from {arm.joint_names[moving[0]]}, and with these "
                f"joints locked it is at most {most:.4g} m away"
            )
        if (planar is None or flat) and distance < least - slack:
            return (
                f"proved out of reach: {what} would be {distance:.4g} m from {arm.joint_names[moving[0]]}, and with these "
                f"joints locked it is at least {least:.4g} m away"
            )
    return None


def _range(arm: Arm, k: int, offset: Array, flat: bool) -> tuple[float, float]:
    """Least and greatest distance from the origin of joint k to a point at ``offset`` (3,) beyond it; flat: across its axis."""
    joint = arm.joints[k]
    along = float(joint.axis @ offset)
    across = float(np.linalg.norm(offset - along * joint.axis))
    if not joint.prismatic:
        length = across if flat else float(np.hypot(across, along))
        return length, length
    ends = [abs(along + x) for x in (joint.lower, joint.upper)]
    nearest = 0.0 if joint.lower <= -along <= joint.upper else min(ends)
    return float(np.hypot(across, nearest)), float(np.hypot(across, max(ends)))
