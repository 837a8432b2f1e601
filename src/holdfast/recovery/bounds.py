"""Bounds from geometry alone: how fast distances on an arm can change, and where its end effector can never be."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.clearance.clearance import Clearance

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_SLACK = 1e-9  # of the arm's own length: rounding of the bounds themselves


def clearance_slopes(clearance: Clearance, low: Array, high: Array) -> Array:
    """(P, n) bounds of how much the distance of each checked pair changes per rad and m of each joint.

    A joint between the two links of a pair turns one capsule about an axis that the other does not feel, so the distance
    changes by no more than the farthest point of either capsule from that axis, per rad; by 1 m per m along a slide. The
    farthest point is no farther than the lengths along the chain: a Lipschitz bound for every configuration within the box.

    Args:
        clearance: The pairs.
        low: (n,) lower corner of the box, finite, rad and m.
        high: (n,) upper corner.
    """
    arm = clearance.arm
    slide = np.where(arm.prismatic, np.maximum(np.abs(low), np.abs(high)), 0.0)
    step = np.array([float(np.linalg.norm(j.origin[:3, 3])) for j in arm.joints])  # frame k seen from link k - 1
    bounds = np.zeros((len(clearance.pairs), arm.n))
    for row, (a, b) in zip(bounds, clearance.pairs, strict=True):
        first, second = clearance.capsules.parts[a], clearance.capsules.parts[b]
        far = [max(float(np.linalg.norm(x)) for x in (part.start, part.end)) for part in (first, second)]
        for k in range(first.link + 1, second.link + 1):
            # Outwards from axis k to the second capsule; inwards from it to the first.
            outward = slide[k] + step[k + 1 : second.link + 1].sum() + slide[k + 1 : second.link + 1].sum() + far[1]
            inward = step[first.link + 1 : k + 1].sum() + slide[first.link + 1 : k].sum() + far[0]
            row[k] = 1.0 if arm.prismatic[k] else min(outward, inward)
    return bounds


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
