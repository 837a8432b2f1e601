"""What is asked of a recovery: the goal, the rows that count, and whether the arm may start at all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.model import Arm
from holdfast.arm.poses import check_poses
from holdfast.arm.task import Task, as_task, plane_normal
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.certainty import certain_contacts, unknown_shape
from holdfast.errors import InputError
from holdfast.failures import Degraded
from holdfast.keep.kept import Kept
from holdfast.recovery.goals import RowsGivenUp
from holdfast.recovery.recovery import Ending
from holdfast.recovery.rows import Rows
from holdfast.solvers import joint_space
from holdfast.words import list_names

if TYPE_CHECKING:
    from holdfast.paths.path import Path

Array = NDArray[np.float64]

NARROWEST_CONE_RAD = 1e-4  # rad, of a cone that the tool's axis may be in
SAME = 1e-6  # rad and m: a joint this near to its angle is there


@dataclass(frozen=True)
class Goal:
    """What the end effector, or the arm, should reach.

    Attributes:
        text: For people.
        poses: (G, 4, 4) of the end effector, any of which will do.
        q: (n,) the configuration, if that itself is the goal; else None.
        lost: Joints locked elsewhere than in that configuration, or None.
    """

    text: str
    poses: Array
    q: Array | None = None
    lost: RowsGivenUp | None = None


def check_numbers(
    counts: Mapping[str, tuple[int, int]],
    *,
    time_limit: float | None,
    tolerance: tuple[float, float] | None,
    period: float,
    margin: float,
) -> None:
    """Check the numbers of a recovery; counts come with the least that each may be.

    Raises:
        InputError: One of them is out of bounds.
    """
    for name, (number, least) in counts.items():
        if number < least:
            raise InputError(f"{name} is {number}; it must be {least} or more")
    if time_limit is not None and not time_limit > 0:
        raise InputError(f"time_limit is {time_limit}; it must be above 0, in seconds")
    if tolerance is not None and (len(tolerance) != 2 or not all(0 <= x < np.inf for x in tolerance)):
        raise InputError(f"tolerance is {tolerance}; give two finite numbers of 0 or more, in m and rad")
    if not (np.isfinite(period) and period > 0):
        raise InputError(f"period is {period}; it must be above 0, in seconds")
    if not np.isfinite(margin):
        raise InputError(f"margin is {margin}; it must be a finite number of metres")


class Trouble(NamedTuple):
    """Why the arm may not even start.

    Attributes:
        ending: What it means.
        reason: A sentence.
        certain: Whether that is proved; False where only a cover of the arm, or an assumption about it, is in the way.
    """

    ending: Ending
    reason: str
    certain: bool = True


def home_of(arm: Arm) -> tuple[Array, str]:
    """Where home is, (n,), rad and m, and in words: the arm's state of this name, or every joint as near to 0 as it may be."""
    if "home" in arm.states:
        return arm.states["home"], "home"
    q = np.clip(np.zeros(arm.n), arm.lower, arm.upper)
    others = [name for name, value in zip(arm.joint_names, q, strict=True) if value]
    return q, "all joints at 0" + (f", {', '.join(others)} at the limit nearest to it" if others else "")


def task_of(arm: Arm, task: str | Task | Sequence[str] | None, path: Path | None, within: float | None) -> Task:
    """The rows that count: those given, else the pose, or the position in a plane or along a path without orientations.

    Next to the tilt of a goal with ``within`` (rad) the position counts.
    """
    if within is not None:
        return _position_of(arm, task, path, within)
    if task is not None:
        return as_task(arm, task)
    flat = plane_normal(arm) is not None
    whole = path is None or path.oriented
    return as_task(arm, "planar" if flat else "pose" if whole else "position")


def _position_of(arm: Arm, task: str | Task | Sequence[str] | None, path: Path | None, within: float) -> Task:
    """Return the rows that count next to the tilt of a goal with ``within``: the position.

    Raises:
        InputError: The angle is out of bounds, there is a tool path, or the task does not prescribe the whole position.
    """
    if not NARROWEST_CONE_RAD <= within < np.pi:
        raise InputError(
            f"within is {within:g} rad; it must be from {NARROWEST_CONE_RAD:g} rad to below pi (180 deg); for a single "
            "direction use task='pointing'"
        )
    if path is not None:
        raise InputError("within is of a goal, and a tool path has rows of its own; leave out within or the path")
    position = as_task(arm, "planar" if plane_normal(arm) is not None else "position")
    chosen = position if task is None else as_task(arm, task)
    if not np.allclose(position.rows @ chosen.rows.T @ chosen.rows, position.rows, atol=1e-9):
        raise InputError(
            f"within keeps the whole position of the tool, and task '{chosen.name}' does not; leave out the task, or use "
            "pose, pointing or position"
        )
    return position


def goal_of(
    degraded: Degraded,
    goal: ArrayLike | str | None,
    within: float | None,
    by_hand: bool,
    standing: Array,
    clearance: Clearance | None,
    margin: float,
    path: Path | None,
) -> Goal | None:
    """What the goal means for the arm as it is left, or None for the end of the path; with ``within`` (rad) always poses.

    Raises:
        InputError: It cannot be read, is beyond the limits, or is not clear.
    """
    arm, free = degraded.arm, degraded.moves
    cone = "" if within is None else f", its z axis within {np.rad2deg(within):.4g} deg of the axis there"
    if goal is None:
        if path is None:
            raise InputError("there is neither a goal nor a path; give goal='home', a pose, a configuration, or a path")
        return None
    if isinstance(goal, str):
        if goal != "home" and goal not in arm.states:
            known = list_names(list({"home": 0, **arm.states}))
            raise InputError(f"goal '{goal}' is not known; give {known}, a pose (4, 4) or a configuration ({arm.n},)")
        q, text = (arm.states[goal], goal) if goal in arm.states else home_of(arm)
    else:
        given = np.asarray(goal, dtype=np.float64)
        if given.ndim in (2, 3) and given.shape[-2:] == (4, 4) and given.size:
            if not np.isfinite(given).all():
                raise InputError("goal holds NaN or infinity; give a pose of finite numbers")
            poses = check_poses(given.reshape(-1, 4, 4))
            text = "a pose of the end effector" if len(poses) == 1 else f"any of {len(poses)} poses of the end effector"
            return Goal(text + cone, poses)
        if given.shape != (arm.n,) or not np.isfinite(given).all():
            raise InputError(
                f"goal has shape {given.shape}; give 'home', a pose (4, 4), poses (G, 4, 4), or a configuration of {arm.n} "
                "finite numbers"
            )
        text, q = "a configuration", given
    beyond = [arm.joint_names[k] for k in np.flatnonzero((q < arm.lower) | (q > arm.upper))]
    if beyond:
        raise InputError(f"goal: joint '{beyond[0]}' is outside its limits there; give a configuration within them")
    poses = arm.forward_kinematics(q)[None]
    if by_hand or within is not None:
        return Goal(f"the end effector where it is at {text}{cone}", poses)
    if clearance is not None and float(clearance.room(q)) < margin and certain_contacts(clearance, q[None], margin)[0]:
        raise InputError(
            f"goal: at that configuration the arm {clearance.too_close(margin, q)}; give a clear one, or no clearance"
        )
    away = np.abs(joint_space.difference(arm, q, np.where(free, np.clip(q, degraded.lo, degraded.hi), standing)))
    lost = np.flatnonzero(np.where(free, away > 0, away > SAME))
    if not lost.size:
        return Goal(text, poses, np.where(free, q, standing))
    units = ["m" if arm.prismatic[k] else "rad" for k in lost]
    rows = RowsGivenUp(tuple(arm.joint_names[k] for k in lost), tuple(away[lost].tolist()), tuple(units))
    return Goal(text, poses, None, rows)


def broken_by(keep: Sequence[Kept], rows: Rows | None, pose: Array) -> str:
    """Which row kept all the way is broken by whatever meets a goal pose (4, 4), a sentence; empty if none is proved to be.

    Args:
        keep: What is kept, anchored.
        rows: Of the goal; None: a configuration, which means its pose.
        pose: Of the goal.
    """
    placed = turned = True  # of a configuration
    if rows is not None:
        linear, angular = (np.abs(rows.matrix[:, part]).max(axis=1) > 0 for part in (slice(3), slice(3, 6)))
        placed = int(np.linalg.matrix_rank(rows.matrix[linear & ~angular])) == 3
        turned = int(np.linalg.matrix_rank(rows.matrix[angular & ~linear])) == 3
    for one in keep:
        known = replace(
            one,
            normals=one.normals if placed else one.normals[:0],
            direction=one.direction if turned else None,
            turned=one.turned and turned,
        )
        trouble = known.trouble(pose[None])
        if trouble:
            return f"what is kept all the way is broken there: {trouble} ({one})"
    return ""


def doubtful_contact(clearance: Clearance, q: Array, margin: float) -> str:
    """Say that a configuration (n,) may be clear although what covers the arm is too close there, and what is not known."""
    unknown = unknown_shape(clearance) or f"exact distances ({clearance.exact_by}) do not decide it"
    return f"it is not known whether the arm {clearance.too_close(margin, q)}: {unknown}; give its meshes or its real capsules"


def trouble_of(
    degraded: Degraded, at: Array, clearance: Clearance | None, margin: float, keep: Sequence[Kept] = ()
) -> Trouble | None:
    """Why the arm may not even start, or None if it may."""
    arm, value = degraded.arm, degraded.lo
    for k in np.flatnonzero(~degraded.moves & (np.abs(at - value) > SAME)):
        return Trouble(
            Ending.LOCK_ELSEWHERE,
            f"{arm.joint_names[k]} is said to be locked at {value[k]:.6g} and is at {at[k]:.6g} {arm.joints[k].unit}; "
            "give the angle at which it is, or leave the angle out",
        )
    for joint, x in zip(degraded.limited.joints, at, strict=True):
        if not joint.lower <= x <= joint.upper:
            reduced = joint.name in degraded.ranges
            return Trouble(
                Ending.START_OUTSIDE_LIMITS,
                f"{joint.name} is at {x:.6g} {joint.unit}, its limits are {'now ' * reduced}{joint.lower:.6g} to "
                f"{joint.upper:.6g}; if it can move there, widen {'its range' if reduced else 'the limits of the arm'}",
            )
    if clearance is not None and clearance.pair_names and float(clearance.room(at)) < margin:
        pair = certain_contacts(clearance, at[None], margin)[0]
        if not pair:
            return Trouble(Ending.START_TOO_CLOSE, doubtful_contact(clearance, at, margin), certain=False)
        own = int(clearance.closest_pair(at)) < len(clearance.pairs)
        advice = "or no clearance" if own else "or move the object"
        close = f"the arm {clearance.too_close(margin, at)}, which is certain of {pair}"
        return Trouble(Ending.START_TOO_CLOSE, f"{close}; give the arm's real capsules, {advice}")
    start = arm.forward_kinematics(at[None])
    for one in keep:
        trouble = one.trouble(start)
        if trouble:
            return Trouble(Ending.START_BREAKS_ROWS, f"the tool is {trouble} where the arm is; what is kept is {one}")
    return None
