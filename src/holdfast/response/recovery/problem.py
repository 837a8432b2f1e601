"""Inputs of a recovery: the goal, the rows that must be met, and the conditions under which the arm may start."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.formatting import list_names
from holdfast.core.typing import FloatArray
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.tool_constraints.constraint import ToolConstraint
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import check_poses
from holdfast.model.arm.task import Task, as_task, plane_normal
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.exact.certainty import describe_unknown_shape, name_certain_contacts
from holdfast.model.collision.exact.exact_clearance import with_exact_distances
from holdfast.model.failure_modes import Degraded
from holdfast.response.recovery.goals import RelaxedRows
from holdfast.response.recovery.recovery import RecoveryOutcome
from holdfast.response.recovery.task_rows import TaskRows

if TYPE_CHECKING:
    from holdfast.kinematics.paths.path import Path


NARROWEST_CONE_RAD = 1e-4  # smallest angle of a cone of the tool's axis, rad
LOCK_TOLERANCE = 1e-6  # rad and m: a joint this close to its lock value counts as locked there


@dataclass(frozen=True)
class RecoveryGoal:
    """Goal of the end effector or of the arm.

    Attributes:
        description: Text for the user.
        poses: (G, 4, 4) poses of the end effector, any of which meets the goal.
        q: (n,) configuration, if it is the goal; else None.
        mismatched_locks: Joints whose lock value differs from that configuration, or None.
    """

    description: str
    poses: FloatArray
    q: FloatArray | None = None
    mismatched_locks: RelaxedRows | None = None


def check_recovery_options(
    counts: Mapping[str, tuple[int, int]],
    *,
    time_limit: float | None,
    tolerance: tuple[float, float] | None,
    period: float,
    margin: float,
) -> None:
    """Check the numbers of a recovery; ``counts`` contains the value and the smallest allowed value of each.

    Raises:
        InputError: A number is out of bounds.
    """
    for name, (number, minimum) in counts.items():
        if number < minimum:
            raise InputError(f"{name} is {number}; it must be {minimum} or more")
    if time_limit is not None and not time_limit > 0:
        raise InputError(f"time_limit is {time_limit}; it must be above 0, in seconds")
    if tolerance is not None and (len(tolerance) != 2 or not all(0 <= limit < np.inf for limit in tolerance)):
        raise InputError(f"tolerance is {tolerance}; give two finite numbers of 0 or more, in m and rad")
    if not (np.isfinite(period) and period > 0):
        raise InputError(f"period is {period}; it must be above 0, in seconds")
    if not np.isfinite(margin):
        raise InputError(f"margin is {margin}; it must be a finite number, m")


class StartProblem(NamedTuple):
    """Reason why the arm may not start.

    Attributes:
        outcome: Outcome of the recovery.
        reason: Reason, one sentence.
        certain: True if the reason is proved; False if only the collision model or an assumption about the arm is in the way.
    """

    outcome: RecoveryOutcome
    reason: str
    certain: bool = True


def find_home(arm: Arm) -> tuple[FloatArray, str]:
    """Return the home configuration (n,), rad and m, and its description: the state "home", or all joints nearest to 0."""
    if "home" in arm.states:
        return arm.states["home"], "home"
    q = np.clip(np.zeros(arm.n), arm.lower, arm.upper)
    others = [name for name, value in zip(arm.joint_names, q, strict=True) if value]
    return q, "all joints at 0" + (f", {', '.join(others)} at the limit nearest to it" if others else "")


def choose_task(arm: Arm, task: str | Task | Sequence[str] | None, path: Path | None, within: float | None) -> Task:
    """Return the task: the given one, else the pose, or the position in a plane or along a path without orientations.

    With ``within`` (rad), the rows are the position and the tilt of the tool.
    """
    if within is not None:
        return _choose_position_task(arm, task, path, within)
    if task is not None:
        return as_task(arm, task)
    is_planar = plane_normal(arm) is not None
    has_orientation = path is None or path.oriented
    return as_task(arm, "planar" if is_planar else "pose" if has_orientation else "position")


def _choose_position_task(arm: Arm, task: str | Task | Sequence[str] | None, path: Path | None, within: float) -> Task:
    """Return the position task that is combined with the tilt of a goal with ``within``.

    Raises:
        InputError: The angle is out of bounds, there is a tool path, or the task does not prescribe the whole position.
    """
    if not NARROWEST_CONE_RAD <= within < np.pi:
        raise InputError(
            f"within is {within:g} rad; it must be from {NARROWEST_CONE_RAD:g} rad to below pi (180 deg); for a single "
            "direction use task='pointing'"
        )
    if path is not None:
        raise InputError("within needs a goal, and a tool path has its own rows; leave out within or the path")
    position = as_task(arm, "planar" if plane_normal(arm) is not None else "position")
    chosen = position if task is None else as_task(arm, task)
    if not np.allclose(position.rows @ chosen.rows.T @ chosen.rows, position.rows, atol=1e-9):
        raise InputError(
            f"within needs all position rows of the tool, and task '{chosen.name}' lacks some; leave out the task, or use "
            "pose, pointing or position"
        )
    return position


def parse_goal(
    degraded: Degraded,
    goal: ArrayLike | str | None,
    within: float | None,
    has_task: bool,
    q_start: FloatArray,
    clearance: Clearance | None,
    margin: float,
    path: Path | None,
) -> RecoveryGoal | None:
    """Return the goal for the failed arm, or None for the end of the path; with ``within`` (rad) always poses.

    Raises:
        InputError: The goal cannot be read, is beyond the limits, or collides.
    """
    arm, free = degraded.arm, degraded.moves
    cone_text = "" if within is None else f", its z axis within {np.rad2deg(within):.4g} deg of the axis there"
    if goal is None:
        if path is None:
            raise InputError("no goal and no path is given; give goal='home', a pose, a configuration, or a path")
        return None
    if isinstance(goal, str):
        if goal != "home" and goal not in arm.states:
            known_names = list_names(list({"home": 0, **arm.states}))
            raise InputError(f"goal '{goal}' is not known; give {known_names}, a pose (4, 4) or a configuration ({arm.n},)")
        q, text = (arm.states[goal], goal) if goal in arm.states else find_home(arm)
    else:
        values = np.asarray(goal, dtype=np.float64)
        if values.ndim in (2, 3) and values.shape[-2:] == (4, 4) and values.size:
            if not np.isfinite(values).all():
                raise InputError("goal contains NaN or infinity; give a pose of finite numbers")
            poses = check_poses(values.reshape(-1, 4, 4))
            text = "a pose of the end effector" if len(poses) == 1 else f"any of {len(poses)} poses of the end effector"
            return RecoveryGoal(text + cone_text, poses)
        if values.shape != (arm.n,) or not np.isfinite(values).all():
            raise InputError(
                f"goal has shape {values.shape}; give 'home', a pose (4, 4), poses (G, 4, 4), or a configuration of {arm.n} "
                "finite numbers"
            )
        text, q = "a configuration", values
    beyond = [arm.joint_names[joint_index] for joint_index in np.flatnonzero((q < arm.lower) | (q > arm.upper))]
    if beyond:
        raise InputError(f"goal: joint '{beyond[0]}' is outside its limits there; give a configuration within them")
    poses = arm.forward_kinematics(q)[None]
    if has_task or within is not None:
        return RecoveryGoal(f"the end effector's pose at {text}{cone_text}", poses)
    if clearance is not None and float(clearance.margin_left(q)) < margin:
        exact_clearance = with_exact_distances(clearance, margin) or clearance
        if float(exact_clearance.margin_left(q)) < margin and name_certain_contacts(exact_clearance, q[None], margin)[0]:
            contact_text = exact_clearance.too_close(margin, q)
            raise InputError(f"goal: at that configuration the arm {contact_text}; give a collision-free one, or no clearance")
    joint_errors = np.abs(joint_space.joint_difference(arm, q, np.where(free, np.clip(q, degraded.lo, degraded.hi), q_start)))
    mismatched = np.flatnonzero(np.where(free, joint_errors > 0, joint_errors > LOCK_TOLERANCE))
    if not mismatched.size:
        return RecoveryGoal(text, poses, np.where(free, q, q_start))
    units = ["m" if arm.prismatic[joint_index] else "rad" for joint_index in mismatched]
    relaxed = RelaxedRows(
        tuple(arm.joint_names[joint_index] for joint_index in mismatched),
        tuple(joint_errors[mismatched].tolist()),
        tuple(units),
    )
    return RecoveryGoal(text, poses, None, relaxed)


def _has_rank_three(matrix: FloatArray) -> bool:
    """Return whether a matrix with any number of rows has rank 3; NumPy 2.0 computes no rank without rows."""
    return len(matrix) >= 3 and int(np.linalg.matrix_rank(matrix)) == 3


def describe_goal_violation(constraints: Sequence[ToolConstraint], rows: TaskRows | None, pose: FloatArray) -> str:
    """Describe the tool constraint that every configuration of a goal pose (4, 4) violates; empty if none is proved to be.

    Args:
        constraints: Anchored tool constraints.
        rows: Rows of the goal. None: the goal is a configuration, which sets the whole pose.
        pose: (4, 4) pose of the goal.
    """
    fixes_position = fixes_orientation = True  # for a configuration
    if rows is not None:
        linear, angular = (np.abs(rows.matrix[:, columns]).max(axis=1) > 0 for columns in (slice(3), slice(3, 6)))
        fixes_position = _has_rank_three(rows.matrix[linear & ~angular])
        fixes_orientation = _has_rank_three(rows.matrix[angular & ~linear])
    for constraint in constraints:
        applicable = replace(
            constraint,
            normals=constraint.normals if fixes_position else constraint.normals[:0],
            direction=constraint.direction if fixes_orientation else None,
            turned=constraint.turned and fixes_orientation,
        )
        violation = applicable.trouble(pose[None])
        if violation:
            return f"the goal violates a constraint: {violation} ({constraint})"
    return ""


def describe_doubtful_contact(clearance: Clearance, q: FloatArray, margin: float) -> str:
    """Report that a configuration (n,) may be collision-free although the bounding capsules are too close, and name the gap."""
    unknown = describe_unknown_shape(clearance) or f"exact distances ({clearance.exact_by}) do not decide it"
    return f"it is not known whether the arm {clearance.too_close(margin, q)}: {unknown}; give its meshes or actual capsules"


def find_start_problem(
    degraded: Degraded,
    q_start: FloatArray,
    clearance: Clearance | None,
    margin: float,
    constraints: Sequence[ToolConstraint] = (),
) -> StartProblem | None:
    """Return the reason why the arm may not start, or None if it may."""
    arm, lock_values = degraded.arm, degraded.lo
    for joint_index in np.flatnonzero(~degraded.moves & (np.abs(q_start - lock_values) > LOCK_TOLERANCE)):
        return StartProblem(
            RecoveryOutcome.LOCK_MISMATCH,
            f"{arm.joint_names[joint_index]} is given as locked at {lock_values[joint_index]:.6g} and is at "
            f"{q_start[joint_index]:.6g} {arm.joints[joint_index].unit}; give the value at which it is, or leave the value out",
        )
    for joint, position in zip(degraded.limited.joints, q_start, strict=True):
        if not joint.lower <= position <= joint.upper:
            reduced = joint.name in degraded.ranges
            return StartProblem(
                RecoveryOutcome.START_OUTSIDE_LIMITS,
                f"{joint.name} is at {position:.6g} {joint.unit}, and its limits are {'now ' * reduced}{joint.lower:.6g} to "
                f"{joint.upper:.6g}; if it can move there, widen {'its range' if reduced else 'the limits of the arm'}",
            )
    if clearance is not None and clearance.pair_names and float(clearance.margin_left(q_start)) < margin:
        pair = name_certain_contacts(clearance, q_start[None], margin)[0]
        if not pair:
            return StartProblem(
                RecoveryOutcome.START_TOO_CLOSE, describe_doubtful_contact(clearance, q_start, margin), certain=False
            )
        is_self_collision = int(clearance.closest_pair(q_start)) < len(clearance.pairs)
        advice = "or no clearance" if is_self_collision else "or move the object"
        contact_text = f"the arm {clearance.too_close(margin, q_start)}, which is certain for {pair}"
        return StartProblem(RecoveryOutcome.START_TOO_CLOSE, f"{contact_text}; give the arm's actual capsules, {advice}")
    start_pose = arm.forward_kinematics(q_start[None])
    for constraint in constraints:
        violation = constraint.trouble(start_pose)
        if violation:
            return StartProblem(
                RecoveryOutcome.START_VIOLATES_CONSTRAINTS,
                f"the tool is {violation} at the start; the constraint is {constraint}",
            )
    return None
