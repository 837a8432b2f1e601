"""Proofs that the goal or a pose of the tool path is unreachable."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from holdfast.core.errors import TaskError
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.interval_search import Configurations, SearchOutcome, all_configurations
from holdfast.kinematics.interval_search.box_bounds import BoundedTask, is_last_joint_idle
from holdfast.kinematics.interval_search.boxes import Blocked
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, plane_normal
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.exact.certainty import name_certain_contacts
from holdfast.model.failure_modes import Degraded
from holdfast.response.recovery.goals import PoseSearch
from holdfast.response.recovery.proofs.blocked_boxes import BlockedBoxes
from holdfast.response.recovery.recovery import Recovery
from holdfast.response.recovery.space import FreeSpace
from holdfast.response.recovery.task_rows import RowSolver

MAX_BOXES = 8_000_000  # about 3 s; a number and not a time, so that the same seed gives the same result
_MAX_PLAIN_BOXES = 1_500_000  # about 0.5 s, without the test for blocked boxes
_TIME_SHARE_WITHIN = 1 / 4  # of the remaining time, for a proof within the tolerance, which is tried before the exact one
_RELATIVE_SLACK = 1e-9  # of the arm's length: rounding error of the bounds
Tolerance = tuple[float, float]
ANY_ORIENTATION = "; this is about the position alone, so it holds for every orientation"
EXACT_TOLERANCE: Tolerance = (1e-6, 1e-6)  # errors that the search accepts, m and rad


def prove_unreachable(solver: RowSolver, free: BoolArray, q_locked: FloatArray, pose: FloatArray) -> str | None:
    """Prove that a pose (4, 4) is unreachable, if its position must be met, and return the sentence; None if that fails.

    Args:
        solver: Solver of the rows that must be met, with the arm and the limits in force.
        free: (n,) mask of the joints that move.
        q_locked: (n,) configuration with the values of the other joints, rad and m.
        pose: (4, 4) pose of the end effector, m.
    """
    rows, arm = solver.rows, solver.arm
    linear_rows = rows.matrix[np.abs(rows.matrix[:, 3:]).max(axis=1) == 0, :3]
    rank = int(np.linalg.matrix_rank(linear_rows)) if len(linear_rows) else 0
    normal = plane_normal(arm)
    if rank == 3:
        normal = None
    elif rank != 2 or normal is None or rows.linear != "base" or np.abs(linear_rows @ normal).max() > 1e-9:
        return None
    return prove_by_reach_bound(arm, free, q_locked, pose, rows.m == 6, normal)


class PoseProof(NamedTuple):
    """Proof that no collision-free configuration meets a pose.

    Attributes:
        sentence: The proof.
        holds_within_tolerance: True if it is also proved for everything that misses the pose by the tolerance.
    """

    sentence: str
    holds_within_tolerance: bool = False


def enumerate_collision_free(
    recovery: Recovery, search: PoseSearch, poses: FloatArray
) -> tuple[FloatArray, IndexArray, list[PoseProof | None]]:
    """Enumerate the collision-free configurations of poses (G, 4, 4), in a part of the remaining time.

    Returns:
        Configurations (K, n), the pose (K,) of each, and for each pose the proof that it has none, if there is one. A proof
        is about the rows of the task alone, so it holds for every tilt of the tool.
    """
    space, configurations, proofs = search.space, list[FloatArray](), list[PoseProof | None]()
    for pose in poses:
        within_proof = prove_within_tolerance(recovery, search, pose)  # which includes the exact pose
        q, proof = (np.zeros((0, recovery.arm.n)), None) if within_proof else search_pose(recovery, space, pose)
        configurations.append(q[space.are_valid(q) & search.solver.is_inside_cone(q, pose)] if len(q) else q)
        proofs.append(PoseProof(within_proof, True) if within_proof else PoseProof(proof) if proof else None)
    return np.concatenate(configurations), np.repeat(np.arange(len(poses)), [len(q) for q in configurations]), proofs


def prove_within_tolerance(recovery: Recovery, search: PoseSearch, pose: FloatArray) -> str | None:
    """Prove that no collision-free configuration meets a pose (4, 4) within the tolerance, and return the sentence, or None.

    The search ends at a configuration within the tolerance that is not blocked.
    """
    if recovery.tolerance is None:
        return None
    return search_pose(recovery, search.space, pose, recovery.tolerance, first=True, time_share=_TIME_SHARE_WITHIN)[1]


def search_pose(
    recovery: Recovery,
    space: FreeSpace,
    pose: FloatArray,
    tolerance: Tolerance = EXACT_TOLERANCE,
    *,
    first: bool = False,
    time_share: float = 0.5,
) -> tuple[FloatArray, str | None]:
    """Return the configurations (K, n) of a pose (4, 4), and the proof that none of them is collision-free, if there is one."""
    request, blocked, solutions = (recovery.degraded, recovery.task, pose), None, None
    # Isolated configurations are few, and to check them takes less time than to exclude boxes in contact.
    if not first and int(space.free.sum()) <= recovery.task.m:
        solutions = enumerate_configurations(*request, space.seconds_left * time_share, max_boxes=_MAX_PLAIN_BOXES)
    if solutions is None or solutions.finding == SearchOutcome.OPEN:
        blocked = make_blocked_boxes(space)
        solutions = enumerate_configurations(*request, space.seconds_left * time_share, blocked, tolerance, first)
    proof = prove_no_configuration(solutions, recovery.clearance, "" if blocked is None else blocked.blocker_names)
    return np.zeros((0, recovery.arm.n)) if solutions is None else solutions.q, proof


def make_blocked_boxes(space: FreeSpace) -> BlockedBoxes | None:
    """Return the test for blocked boxes; None without a clearance."""
    clearance = space.clearance
    return None if clearance is None else BlockedBoxes(clearance, space.margin, (space.low, space.high))


def enumerate_configurations(
    failed_arm: Degraded | Arm,
    task: Task,
    pose: FloatArray,
    time_limit: float,
    is_blocked: Blocked | None = None,
    tolerance: Tolerance = EXACT_TOLERANCE,
    first: bool = False,
    max_boxes: int = MAX_BOXES,
) -> Configurations | None:
    """Enumerate the configurations of a pose (4, 4) within the limits in force; None if the list cannot be proved complete.

    Configurations in which the arm certainly collides are excluded.

    Args:
        failed_arm: Failed arm, with the value of every lock, or an arm without failures.
        task: Task whose rows must be met.
        pose: (4, 4) pose of the end effector, m.
        time_limit: Time limit, s.
        is_blocked: Test for blocked boxes. None: no test.
        tolerance: Allowed errors of the pose, m and rad.
        first: Stop at the first configuration.
        max_boxes: Number of boxes after which the search ends.
    """
    if isinstance(failed_arm, Degraded):
        arm, limits = failed_arm.arm, (failed_arm.lo, failed_arm.hi)
    else:
        arm, limits = failed_arm, (failed_arm.lower, failed_arm.upper)
    # One full revolution covers an unlimited joint.
    is_enumerable = np.isfinite(limits).all(axis=0) | (np.isinf(limits).all(axis=0) & ~arm.prismatic)
    if not is_enumerable.all() or not time_limit > 0:
        return None
    try:
        return all_configurations(
            arm,
            pose,
            task,
            limits=limits,
            tolerance=tolerance,
            most_boxes=max_boxes,
            first=first,
            time_limit=time_limit,
            blocked=is_blocked,
        )
    except TaskError:
        return None


def prove_no_configuration(
    solutions: Configurations | None, clearance: Clearance | None, blocker_names: str = ""
) -> str | None:
    """Prove that no collision-free configuration exists, and return the sentence: there is none, or each collides.

    Args:
        solutions: All configurations.
        clearance: Collision model that decides.
        blocker_names: Names of the bodies that blocked the excluded boxes.
    """
    if solutions is None or solutions.finding not in (SearchOutcome.NONE, SearchOutcome.ALL):
        return None
    if not len(solutions.q) and solutions.blocked:
        return (
            f"every configuration within the limits that meets it collides ({blocker_names}), by {solutions.boxes:,} "
            "boxes of joints, up to floating point"
        )
    if not len(solutions.q):
        return f"no configuration within the limits meets it, by {solutions.boxes:,} boxes of joints, up to floating point"
    if solutions.lower[-1] < solutions.upper[-1] and is_last_joint_idle(
        solutions.arm, BoundedTask.from_task(solutions.arm, solutions.task)
    ):
        return None  # the last joint was evaluated at one value, and its rotation may end the collision
    if clearance is None or not all(name_certain_contacts(clearance, solutions.q)):
        return None
    return f"each of its {len(solutions.q)} configurations collides, by {solutions.boxes:,} boxes of joints and exact geometry"


# ---- bounds from geometry alone: positions that the end effector of a failed arm can never have -----------------------------


def prove_by_reach_bound(
    arm: Arm, free: BoolArray, q_locked: FloatArray, pose: FloatArray, whole_pose: bool, planar: FloatArray | None
) -> str | None:
    """Prove that a pose is unreachable with joints locked, and return the sentence; None if this bound cannot prove it.

    The failed arm is a chain of rigid parts between the axes that still move. The distance of the end effector from the first
    axis is at most the sum of the parts' lengths, and at least the longest one minus the others. A full pose also determines
    the origin of the last axis, which leaves one part less and a sharper bound.

    Args:
        arm: The arm.
        free: (n,) mask of the joints that move.
        q_locked: (n,) configuration with the values of the other joints, rad and m.
        pose: (4, 4) pose of the end effector, m.
        whole_pose: True if the orientation must be met too.
        planar: Normal (3,) of the plane of a planar arm, in which the position must be met. None: the whole position.
    """
    moving = np.flatnonzero(free)
    if not moving.size:
        return None
    is_planar = planar is not None and not arm.prismatic[moving].any()
    frame, offsets = arm.base, []
    for index, joint in enumerate(arm.joints):
        frame = frame @ joint.origin
        if free[index]:
            offsets.append(frame[:3, 3])
            frame = np.eye(4)
        else:
            frame = frame @ joint.motion(float(q_locked[index]))
    tool_offset = frame @ arm.tool  # from the last moving joint to the tool
    center = offsets[0]
    lengths = [
        _bound_distance_from_joint(arm, k, offset, is_planar) for k, offset in zip(moving[:-1], offsets[1:], strict=True)
    ]
    tool_distance = _bound_distance_from_joint(arm, moving[-1], tool_offset[:3, 3], is_planar)
    proofs = [("the end effector", pose[:3, 3], [*lengths, tool_distance])]
    if whole_pose and not arm.prismatic[moving[-1]] and len(lengths):
        wrist = pose @ np.linalg.inv(tool_offset)
        proofs.append((f"the axis of {arm.joint_names[moving[-1]]}", wrist[:3, 3], lengths))
    slack = _RELATIVE_SLACK * arm.length_unit
    for target_name, target, spans in proofs:
        offset_to_target = target - center
        if planar is not None:
            offset_to_target = offset_to_target - planar * (planar @ offset_to_target)
        distance = float(np.linalg.norm(offset_to_target))
        max_distance = sum(span_end for _, span_end in spans)
        longest = max(spans, key=lambda span: span[0])
        min_distance = longest[0] - (max_distance - longest[1])
        if distance > max_distance + slack:
            return (
                f"proved out of reach: {target_name} would be {distance:.4g} m from {arm.joint_names[moving[0]]}, and with "
                f"these joints locked it is at most {max_distance:.4g} m away"
            )
        if (planar is None or is_planar) and distance < min_distance - slack:
            return (
                f"proved out of reach: {target_name} would be {distance:.4g} m from {arm.joint_names[moving[0]]}, and with "
                f"these joints locked it is at least {min_distance:.4g} m away"
            )
    return None


def _bound_distance_from_joint(arm: Arm, k: int, offset: FloatArray, is_planar: bool) -> tuple[float, float]:
    """Return the least and greatest distance from the origin of joint k to a point at ``offset`` (3,), or from its axis."""
    joint = arm.joints[k]
    axial_component = float(joint.axis @ offset)
    axis_distance = float(np.linalg.norm(offset - axial_component * joint.axis))
    if not joint.prismatic:
        length = axis_distance if is_planar else float(np.hypot(axis_distance, axial_component))
        return length, length
    end_distances = [abs(axial_component + limit) for limit in (joint.lower, joint.upper)]
    nearest = 0.0 if joint.lower <= -axial_component <= joint.upper else min(end_distances)
    return float(np.hypot(axis_distance, nearest)), float(np.hypot(axis_distance, max(end_distances)))
