"""That what is asked for cannot be done: the goal, or a pose of the tool path."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task, plane_normal
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.certainty import certain_contacts
from holdfast.enclosure import Configurations, Finding, all_configurations
from holdfast.enclosure.box_bounds import Parts, idle
from holdfast.enclosure.boxes import Blocked
from holdfast.errors import TaskError
from holdfast.failures import Degraded
from holdfast.recovery.proofs.blocked_boxes import BlockedBoxes
from holdfast.recovery.recovery import Recovery
from holdfast.recovery.rows import RowSolver
from holdfast.recovery.space import Space

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

BOXES = 8_000_000  # about 3 s: a number and not a time, so that the same seed gives the same result
_SLACK = 1e-9  # of the arm's own length: rounding of the bounds themselves
Tolerance = tuple[float, float]
ANY_ORIENTATION = "; this is about the position alone, so it holds for every orientation"
EXACT: Tolerance = (1e-6, 1e-6)  # m and rad: what the search takes as met


def unreachable(solver: RowSolver, free: Flags, at: Array, pose: Array) -> str | None:
    """A sentence that proves a pose (4, 4) out of reach, if its position counts and the bound says so.

    Args:
        solver: Of the rows that count, with the arm and the limits in force.
        free: (n,) joints that move.
        at: (n,) where the others are.
        pose: (4, 4) of the end effector, m.
    """
    rows, arm = solver.rows, solver.arm
    linear = rows.matrix[np.abs(rows.matrix[:, 3:]).max(axis=1) == 0, :3]
    rank = int(np.linalg.matrix_rank(linear)) if len(linear) else 0
    normal = plane_normal(arm)
    if rank == 3:
        normal = None
    elif rank != 2 or normal is None or rows.linear != "base" or np.abs(linear @ normal).max() > 1e-9:
        return None
    return out_of_reach(arm, free, at, pose, rows.m == 6, normal)


def every_clear(
    made: Recovery, solver: RowSolver, space: Space, poses: Array
) -> tuple[Array, NDArray[np.int64], list[str | None]]:
    """Enumerate the clear configurations of poses (G, 4, 4), each pose in half of the time that is left.

    Returns:
        Configurations (K, n), the pose (K,) of each, and for each pose the proof that it has none, if there is one. A proof
        is about the rows of the task alone, so it holds for every tilt of the tool.
    """
    goals, owner, proofs = np.zeros((0, made.arm.n)), np.zeros(0, dtype=np.int64), list[str | None]()
    for k, pose in enumerate(poses):
        blocked = blocked_in(space)
        found = listed(made.degraded, made.task, pose, space.seconds_left / 2, blocked)
        proofs.append(proved_by(found, made.clearance, "" if blocked is None else blocked.what))
        some = goals[:0] if found is None else found.q
        some = some[space.clear(some) & solver.inside_cone(some, pose)] if len(some) else some
        goals, owner = np.concatenate([goals, some]), np.append(owner, np.full(len(some), k))
    return goals, owner, proofs


def nothing_within(degraded: Degraded, task: Task, pose: Array, space: Space, tolerance: Tolerance) -> bool:
    """Whether it is proved that nothing clear misses a pose (4, 4) by no more than a tolerance, m and rad.

    In half of the time that is left.
    """
    found = listed(degraded, task, pose, space.seconds_left / 2, blocked_in(space), tolerance)
    return found is not None and found.none


def blocked_in(space: Space) -> BlockedBoxes | None:
    """Which boxes are blocked; None without a clearance."""
    kept = space.clearance
    return None if kept is None else BlockedBoxes(kept, space.margin, (space.low, space.high))


def listed(
    degraded: Degraded,
    task: Task,
    pose: Array,
    seconds: float,
    blocked: Blocked | None = None,
    tolerance: Tolerance = EXACT,
) -> Configurations | None:
    """Every configuration of a pose (4, 4) within the limits in force, if that can be told; None where nothing can be proved.

    Those in which the arm certainly touches something are left out.

    Args:
        degraded: What is in force, every lock with its value.
        task: Whose rows count.
        pose: (4, 4) of the end effector, m.
        seconds: At most.
        blocked: Which boxes are; None without a cell.
        tolerance: m and rad by which the pose may be missed.
    """
    limits = degraded.lo, degraded.hi
    known = np.isfinite(limits).all(axis=0) | (np.isinf(limits).all(axis=0) & ~degraded.arm.prismatic)  # or it turns once
    if not known.all() or not seconds > 0:
        return None
    allowed = {} if np.isinf(seconds) else {"time_limit": seconds}
    try:
        return all_configurations(
            degraded.arm,
            pose,
            task,
            limits=limits,
            tolerance=tolerance,
            most_boxes=BOXES,
            first=False,
            blocked=blocked,
            **allowed,
        )
    except TaskError:
        return None


def proved_by(found: Configurations | None, clearance: Clearance | None, what: str = "") -> str | None:
    """A sentence that proves that no clear configuration exists: there is none, or each of them touches something.

    Args:
        found: All there are.
        clearance: By which they are judged.
        what: Names of what blocked the boxes that were left out.
    """
    if found is None or found.finding not in (Finding.NONE, Finding.ALL):
        return None
    if not len(found.q) and found.blocked:
        return (
            f"every configuration within the limits that meets it touches something ({what}), by {found.boxes:,} boxes of "
            "joints, up to floating point"
        )
    if not len(found.q):
        return f"no configuration within the limits meets it, by {found.boxes:,} boxes of joints, up to floating point"
    if found.lower[-1] < found.upper[-1] and idle(found.arm, Parts.of(found.arm, found.task)):
        return None  # the last joint was looked at in one place, and its turn may clear what touches
    if clearance is None or not all(certain_contacts(clearance, found.q)):
        return None
    return f"each of its {len(found.q)} configurations touches something, by {found.boxes:,} boxes of joints and exact geometry"


# ---- bounds from geometry alone: where the end effector of a failed arm can never be ----------------------------------------


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
