"""Verify a motion with code that shares only the arm and its clearance with the planner."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.model.arm.poses import rotation_vectors
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.exact.engines import CONTACT_DISTANCE_M, is_library_installed
from holdfast.model.failure_modes import Degraded
from holdfast.response.recovery.waypoints import FIRST_COLUMNS, check_waypoints, subdivide_path, time_or_length_column

if TYPE_CHECKING:
    from holdfast.kinematics.paths.path import Path
    from holdfast.kinematics.tool_constraints.constraint import ToolConstraint
    from holdfast.model.arm.model import Arm
    from holdfast.response.recovery.task_rows import TaskRows


WAYPOINT_TOLERANCE = 1e-5  # tolerance at waypoints, m for an arm of about 1 m, and rad
PATH_TOLERANCE = 1e-3, np.deg2rad(0.5)  # tolerance between the waypoints along a tool path, m and rad
_POINTS_PER_SEGMENT = 4  # points between two waypoints


@dataclass(frozen=True, kw_only=True)
class Verification:
    """Result of the independent check of a motion.

    Attributes:
        faults: Violations, one sentence each; empty if there are none.
        checked: Number of configurations, at most 2 mrad (and mm) of a joint apart.
        exact_by: Method of the collision check, exact sign or lower bounds of distances; empty if it was not checked.
        goal_miss: Largest error of the rows of the goal at the end of the motion, m and rad; None without a goal.
        path_miss: Largest error of the rows along the tool path between waypoints, m and rad; None without one.
        kept: Largest errors of each constraint along the motion: distance of the tool point from its line or plane, m, and
            angle from the constrained direction, rad.
    """

    faults: tuple[str, ...]
    checked: int
    exact_by: str
    goal_miss: float | None
    path_miss: float | None
    kept: tuple[tuple[float, float], ...] = ()

    @property
    def ok(self) -> bool:
        """True if the check found no fault."""
        return not self.faults

    def merge_timed(self, timed: Verification) -> Verification:
        """Merge the verification of waypoints with ``timed``, that of the same motion with its timing."""
        misses = [miss for miss in (self.path_miss, timed.path_miss) if miss is not None]
        return replace(
            self,
            faults=(*self.faults, *(f"in the timed motion, {fault}" for fault in timed.faults)),
            checked=self.checked + timed.checked,
            path_miss=max(misses, default=None),
            kept=tuple(
                (max(distance, timed_distance), max(angle, timed_angle))
                for (distance, angle), (timed_distance, timed_angle) in zip(self.kept, timed.kept, strict=True)
            ),
        )

    def __str__(self) -> str:
        if self.faults:
            return "rejected by the independent check: " + "; ".join(self.faults)
        method_text = f", no collision by {self.exact_by}" if self.exact_by else ""
        constraint_text = ", every constraint met" * bool(self.kept)
        return f"verified by independent code in {self.checked:,} configurations{constraint_text}{method_text}"


def verify_waypoints(
    degraded: Degraded,
    q_start: FloatArray,
    q: FloatArray,
    *,
    rows: TaskRows,
    goals: FloatArray | None = None,
    goal_q: FloatArray | None = None,
    path_samples: tuple[Path, FloatArray, slice] | None = None,
    constraints: Sequence[ToolConstraint] = (),
    clearance: Clearance | None = None,
    margin: float = 0.0,
    timing_limits: tuple[FloatArray, FloatArray] | None = None,
) -> Verification:
    """Check a motion through waypoints (K, n), straight in joint space, in steps of 2 mrad.

    Args:
        degraded: Failed arm with limits, locks and speeds in force.
        q_start: (n,) start configuration, rad and m.
        q: (K, n) waypoints, rad and m.
        rows: Rows of the tool pose that must be met.
        goals: (G, 4, 4) poses, one of which must be met at the end.
        goal_q: (n,) configuration that must be met at the end.
        path_samples: Tool path, fractions (S,) of it, 0 to 1, and the slice of the waypoints at these fractions.
        constraints: Tool constraints along the whole motion, anchored at the pose of the start.
        clearance: Collision model.
        margin: Smallest clearance, m.
        timing_limits: Times (K,) of the waypoints, s, and the acceleration limits (n,). None: as fast as the speeds allow, and
            exactly through every waypoint along a tool path.
    """
    arm, faults = degraded.arm, []
    length_scale = max(arm.length_unit, 1.0)
    if np.abs(q[0] - q_start).max() > 1e-6:
        faults.append("the motion does not begin at the start configuration")
    name, times = time_or_length_column(degraded.limited, q)
    replay = check_waypoints(
        arm,
        q,
        degraded,
        clearance=clearance if clearance is not None else False,
        margin=margin,
        time=timing_limits[0] if timing_limits is not None else times if name == FIRST_COLUMNS[0] else None,
        accelerations=None if timing_limits is None else timing_limits[1],
    )
    faults += [f"{name} exceeds its limits by {miss:.3g}" for name, miss in replay.beyond_limits.items()]
    faults += [f"{name} is locked and moves by {miss:.3g}" for name, miss in replay.locks_moved.items()]
    if replay.least_room is not None and replay.least_room < margin:
        faults.append(f"the clearance of {replay.closest} is {replay.least_room:.4g} m")
    faults += [f"{joint} exceeds its velocity limit" for joint in replay.too_fast]
    faults += [f"{joint} accelerates by {peak:.4g}, above its limit" for joint, peak in replay.too_hard.items()]
    poses = compute_tool_poses(arm, subdivide_path(q)) if constraints else np.zeros((0, 4, 4))
    faults += [
        f"the tool is {violation}" for violation in (constraint.trouble(poses) for constraint in constraints) if violation
    ]
    exact_by = "" if clearance is None else "lower bounds of the distances"
    if clearance is not None and clearance.pair_names and is_library_installed():
        exact_by = "the exact sign"
        may_touch = replay.least_clearance is None or replay.least_clearance < CONTACT_DISTANCE_M
        touching = int((~clearance.sign(subdivide_path(q))).sum()) if may_touch else 0
        if touching:
            faults.append(f"the arm collides at {touching} of {replay.looked_at} configurations, by the exact sign")
    goal_miss = path_miss = None
    if goal_q is not None:
        joint_errors = q[-1] - goal_q
        is_unlimited = ~arm.prismatic & ~np.isfinite(arm.lower) & ~np.isfinite(arm.upper)
        goal_miss = float(
            np.abs(np.where(is_unlimited, joint_errors - 2 * np.pi * np.round(joint_errors / (2 * np.pi)), joint_errors)).max()
        )
    elif goals is not None:
        end_configurations = np.repeat(q[-1:], len(goals), axis=0)
        goal_miss = float(np.abs(compute_row_errors(arm, rows, end_configurations, goals)).max(axis=1).min())
    if goal_miss is not None and goal_miss > WAYPOINT_TOLERANCE * length_scale:
        faults.append(f"the goal is missed by {goal_miss:.3g} (m or rad)")
    if path_samples is not None:
        path, fractions, waypoint_slice = path_samples
        waypoint_error = float(np.abs(compute_row_errors(arm, rows, q[waypoint_slice], path.pose(fractions))).max())
        if timing_limits is None and waypoint_error > WAYPOINT_TOLERANCE * length_scale:
            faults.append(f"the tool path is missed by {waypoint_error:.3g} (m or rad)")
        inner_fractions = np.arange(1, _POINTS_PER_SEGMENT + 1) / (_POINTS_PER_SEGMENT + 1)
        inner_configurations = np.concatenate([a + inner_fractions[:, None] * (b - a) for a, b in pairwise(q[waypoint_slice])])
        path_errors = np.abs(
            compute_row_errors(
                arm,
                rows,
                inner_configurations,
                path.pose(np.concatenate([a + inner_fractions * (b - a) for a, b in pairwise(fractions)])),
            )
        )
        path_miss = float(path_errors.max())
        is_off_path = path_errors > np.where(np.array(rows.units) == "m", PATH_TOLERANCE[0] * length_scale, PATH_TOLERANCE[1])
        if is_off_path.any():
            name = rows.names[int(is_off_path.any(axis=0).argmax())]
            faults.append(f"between waypoints {name} is off the tool path by {path_errors[is_off_path].max():.3g} (m or rad)")
    return Verification(
        faults=tuple(faults),
        checked=replay.looked_at,
        exact_by=exact_by,
        goal_miss=goal_miss,
        path_miss=path_miss,
        kept=tuple(constraint.farthest(poses) for constraint in constraints),
    )


def compute_row_errors(arm: Arm, rows: TaskRows, q: FloatArray, poses: FloatArray) -> FloatArray:
    """Return the signed errors (N, m) of rows at q (N, n) and poses (N, 4, 4), m and rad, by matrices in NumPy alone."""
    actual_poses = compute_tool_poses(arm, q)
    position_errors = poses[:, :3, 3] - actual_poses[:, :3, 3]
    orientation_errors = rotation_vectors(poses[:, :3, :3] @ actual_poses[:, :3, :3].transpose(0, 2, 1))
    inverse_rotations = actual_poses[:, :3, :3].transpose(0, 2, 1)
    parts = [
        (inverse_rotations @ part[:, :, None])[:, :, 0] if frame == "tool" else part
        for part, frame in ((position_errors, rows.linear), (orientation_errors, rows.angular))
    ]
    errors = np.concatenate(parts, axis=1) @ rows.matrix.T
    if rows.within is None:
        return np.asarray(errors)
    axis, target_axis = actual_poses[:, :3, 2], poses[:, :3, 2]
    tilt = np.arctan2(np.linalg.norm(np.cross(axis, target_axis), axis=1), (axis * target_axis).sum(axis=1))
    return np.column_stack([errors, np.maximum(tilt - rows.within, 0.0)])


def compute_tool_poses(arm: Arm, q: FloatArray) -> FloatArray:
    """Return poses (N, 4, 4) of the tool at q (N, n), joint by joint with Rodrigues' formula and without a compiled kernel."""
    pose = np.repeat(arm.base[None], len(q), axis=0)
    for index, joint in enumerate(arm.joints):
        joint_motions = np.repeat(np.eye(4)[None], len(q), axis=0)
        if joint.prismatic:
            joint_motions[:, :3, 3] = q[:, index, None] * joint.axis
        else:
            x, y, z = joint.axis
            cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
            sine, cosine = np.sin(q[:, index])[:, None, None], np.cos(q[:, index])[:, None, None]
            joint_motions[:, :3, :3] = np.eye(3) + sine * cross + (1 - cosine) * (cross @ cross)
        pose = pose @ joint.origin @ joint_motions
    return np.asarray(pose @ arm.tool)
