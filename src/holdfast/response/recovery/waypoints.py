"""Waypoints as CSV files, and a check that replays them through kinematics, limits, and clearance.

The first column is ``time_s`` (each straight piece at the velocity limit of its slowest joint, without acceleration limits) or,
for an arm without velocity limits, ``travel_rad`` (length of the joints' motion so far, 1 m of a prismatic joint as 1 rad). The
other columns are joints, ``joint1_rad`` or ``slide_m``, with straight lines between the rows. A motion that is timed within
accelerations (:class:`holdfast.response.recovery.TimedMotion`) also has columns of rates and accelerations.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.files.csv_table import CsvTable, write_rows
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.core.validation import require_real_numbers
from holdfast.kinematics.paths.joint_table import joint_columns, motion_column_names, read_joint_table
from holdfast.kinematics.tool_constraints.labels import KeepLike, anchor_constraints
from holdfast.model.arm.model import Arm
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance
from holdfast.model.collision.exact.exact_clearance import with_exact_distances
from holdfast.model.failure_modes import Degraded, Locked, degraded_at
from holdfast.response.recovery.timing.limits import AccelerationsLike, parse_acceleration_limits

FIRST_COLUMNS = ("time_s", "travel_rad")
_MAX_JOINT_STEP = 2e-3  # rad and m between checked configurations
_CHUNK_ROWS = 100_000


def time_or_length_column(arm: Arm, q: FloatArray) -> tuple[str, FloatArray]:
    """Return the name and values (K,) of the first column for waypoints (K, n)."""
    joint_steps = np.abs(np.diff(q, axis=0))
    max_speeds = np.array([joint.velocity for joint in arm.joints])
    moving = joint_steps.max(axis=0, initial=0.0) > 0
    if (np.isfinite(max_speeds[moving]) & (max_speeds[moving] > 0)).all():
        steps = (joint_steps[:, moving] / max_speeds[moving]).max(axis=1, initial=0.0)
        return FIRST_COLUMNS[0], np.concatenate([[0.0], np.cumsum(steps)])[: len(q)]
    return FIRST_COLUMNS[1], np.concatenate([[0.0], np.cumsum(np.linalg.norm(joint_steps, axis=1))])[: len(q)]


def write_waypoints(arm: Arm, q: FloatArray, path: str | Path) -> Path:
    """Write waypoints ``q`` (K, n) of an ``arm``, rad and m, with every digit to the CSV file ``path``, and return its path.

    Raises:
        StoreError: The file cannot be written.
    """
    column_name, values = time_or_length_column(arm, q)
    return write_rows(path, [column_name, *joint_columns(arm)], np.column_stack([values, q]).tolist(), "waypoints")


def read_waypoints(arm: Arm, path: str | Path) -> FloatArray:
    """Read waypoints (K, n) of an ``arm``, rad and m, from the file ``path`` of :func:`write_waypoints`.

    Columns other than those of the joints are not needed.

    Raises:
        InputError: The file cannot be read, or a column, line or number is missing or wrong; the message names it.
    """
    return _read_table(arm, path).select_columns(joint_columns(arm))


def read_times(arm: Arm, path: str | Path) -> FloatArray | None:
    """Read the times (K,) of waypoints of an ``arm``, s, from the file ``path`` of :func:`write_waypoints`.

    The result is None if the file has no times.

    Raises:
        InputError: As for :func:`read_waypoints`.
    """
    table = _read_table(arm, path)
    return table.select_columns(FIRST_COLUMNS[:1])[:, 0] if FIRST_COLUMNS[0] in table.header else None


def _read_table(arm: Arm, path: str | Path) -> CsvTable:
    table, known_columns = read_joint_table(arm, Path(path), "waypoints", FIRST_COLUMNS[0]), motion_column_names(arm)
    unknown_columns = [
        name for name in table.header if name not in FIRST_COLUMNS and not any(name in names for names in known_columns)
    ]
    if unknown_columns:
        raise InputError(
            f"{table.title}: column '{unknown_columns[0]}' is not known; columns are "
            f"{', '.join([FIRST_COLUMNS[0], *known_columns[0]])}"
        )
    return table


@dataclass(frozen=True, kw_only=True)
class WaypointCheck(Result):
    """Result of replaying a motion through waypoints in small steps.

    Attributes:
        q: (K, n) waypoints, rad and m.
        poses: (K, 4, 4) poses of the end effector at the waypoints in the world, m.
        looked_at: Number of configurations that were checked.
        beyond_limits: Joints outside their limits, by name, with the largest excess, rad or m.
        locks_moved: Locked joints that move, by name, with the largest distance from their lock value, rad or m.
        least_clearance: Smallest distance, m; None if collisions were not checked.
        least_room: Smallest distance beyond the margins of the objects of a cell, m; None if collisions were not checked.
        closest: Names of the pair with ``least_room``, such as ``panda_joint4 & table``; empty without one.
        margin: Requested clearance, m.
        kept: Largest violation of each constraint along the motion, a phrase; empty where it is met.
        too_fast: Joints above their velocity limits, by name, with their greatest mean speed between two waypoints, rad/s or
            m/s; empty without times.
        too_hard: Joints above their acceleration limits, by name, with their greatest mean acceleration over two segments,
            rad/s^2 or m/s^2, from standstill to standstill.
        paced: Checked limits: ``speeds``, ``speeds and accelerations``, or empty.
    """

    q: FloatArray
    poses: FloatArray
    looked_at: int
    beyond_limits: dict[str, float]
    locks_moved: dict[str, float]
    least_clearance: float | None
    least_room: float | None
    closest: str
    margin: float
    kept: tuple[str, ...] = ()
    too_fast: dict[str, float] = field(default_factory=dict)
    too_hard: dict[str, float] = field(default_factory=dict)
    paced: str = ""

    @property
    def ok(self) -> bool:
        """True if limits, locks, constraints, clearance, and, where checked, speeds and accelerations are respected."""
        broken = self.beyond_limits or self.locks_moved or self.too_fast or self.too_hard or any(self.kept)
        return self.is_collision_free and not broken

    @property
    def is_collision_free(self) -> bool:
        """True if the margin is kept, or clearance was not checked."""
        return self.least_room is None or self.least_room >= self.margin


def check_waypoints(
    arm: Arm,
    q: ArrayLike,
    locked: Locked = (),
    *,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    margin: float = 0.0,
    keep: KeepLike | None = None,
    time: ArrayLike | None = None,
    accelerations: AccelerationsLike | None = None,
) -> WaypointCheck:
    """Replay waypoints in steps of at most 2 mrad or 2 mm of a joint, with code that is independent of the planner.

    Args:
        arm: Healthy arm.
        q: (K, n) waypoints, rad and m.
        locked: ``{joint: value}``, rad or m, of the locked joints; None for the value in the first waypoint. Or a
            :class:`holdfast.Degraded`, whose reduced ranges are checked too.
        clearance: Self-collision model. None: self-collisions are not checked.
        cell: Objects around the arm, or their file. None: no objects. Where the bound is below the margin, the check uses exact
            distances if a library for them is installed.
        margin: Required distance of the links, m; from an object, in addition to the margin that the cell states for it.
        keep: Tool constraints along the whole motion; see :func:`holdfast.recover`.
        time: (K,) time of each waypoint, s. With times, differences must respect the remaining velocity limits.
        accelerations: Limits of second differences, from standstill to standstill, rad/s^2 and m/s^2; see
            :func:`holdfast.recover`.

    Raises:
        InputError: Waypoints or times are invalid, a joint is unknown, accelerations are given without times, or the cell
            cannot be read or does not fit the arm.
    """
    waypoints = np.atleast_2d(arm.check_configurations(q))
    if not len(waypoints) or not np.isfinite(waypoints).all():
        raise InputError("waypoints must be one configuration or more of finite numbers")
    fine_steps = subdivide_path(waypoints)
    degraded = degraded_at(arm, locked, waypoints[0])
    limits = arm if degraded is None else degraded.limited
    excesses = np.maximum(np.maximum(limits.lower - fine_steps, fine_steps - limits.upper).max(axis=0), 0.0)
    locked_values = {} if degraded is None else degraded.locked
    lock_errors = {
        name: float(np.abs(fine_steps[:, arm.joint_index(name)] - value).max())
        for name, value in locked_values.items()
        if value is not None
    }
    checked_clearance = chosen_clearance(arm, clearance, cell, looks=False)
    least_clearance = least_margin = None
    closest = ""
    if checked_clearance is not None:
        least_clearance, least_margin, closest = _find_least_clearance(checked_clearance, fine_steps)
        exact_clearance = with_exact_distances(checked_clearance, margin) if least_margin < margin else None
        if exact_clearance is not None:
            least_clearance, least_margin, closest = _find_least_clearance(exact_clearance, fine_steps)
    poses = arm.forward_kinematics(waypoints)
    constraints = anchor_constraints(keep, poses[0])
    too_fast, too_hard = _joints_exceeding_limits(arm, degraded, waypoints, time, accelerations)
    return WaypointCheck(
        too_fast=too_fast,
        too_hard=too_hard,
        paced="" if time is None else "speeds" if accelerations is None else "speeds and accelerations",
        q=waypoints,
        poses=poses,
        kept=tuple(constraint.trouble(arm.forward_kinematics(fine_steps)) for constraint in constraints),
        looked_at=len(fine_steps),
        beyond_limits={
            arm.joint_names[joint_index]: float(excesses[joint_index]) for joint_index in np.flatnonzero(excesses > 1e-12)
        },
        locks_moved={name: lock_error for name, lock_error in lock_errors.items() if lock_error > 1e-12},
        least_clearance=least_clearance,
        least_room=least_margin,
        closest=closest,
        margin=margin,
    )


def _joints_exceeding_limits(
    arm: Arm, degraded: Degraded | None, q: FloatArray, time: ArrayLike | None, accelerations: AccelerationsLike | None
) -> tuple[dict[str, float], dict[str, float]]:
    """Return the joints that are too fast and those that accelerate too hard, by name, with means that some instant attains."""
    if time is None:
        if accelerations is not None:
            raise InputError("accelerations need times; give the time of each waypoint, or a file with a column time_s")
        return {}, {}
    times = require_real_numbers(time, "time", "a number for each waypoint, s")
    if times.shape != (len(q),) or not np.isfinite(times).all() or (np.diff(times) < 0).any():
        raise InputError(f"time must be {len(q)} finite numbers that never fall, one for each waypoint, s")
    time_steps = np.maximum(np.diff(times), 1e-12)[:, None]
    rates = np.diff(q, axis=0) / time_steps
    max_speeds = np.array([joint.velocity for joint in (arm if degraded is None else degraded.limited).joints])
    rounding_error = 8 * np.finfo(float).eps * np.abs(q).max(initial=1.0)
    peak_speeds = (np.abs(rates) - rounding_error / time_steps).max(axis=0, initial=0.0)
    is_limited = np.isfinite(max_speeds) & (max_speeds > 0)
    is_exceeded = peak_speeds > np.where(is_limited, max_speeds * (1 + 1e-9), np.inf)
    too_fast = {arm.joint_names[joint_index]: float(peak_speeds[joint_index]) for joint_index in np.flatnonzero(is_exceeded)}
    if accelerations is None or len(q) < 2:
        return too_fast, {}
    standstill = np.zeros((1, arm.n))
    instant_spacing = np.concatenate([time_steps[:1], time_steps[:-1] + time_steps[1:], time_steps[-1:]]) / 2
    joint_accelerations = np.diff(np.concatenate([standstill, rates, standstill]), axis=0) / instant_spacing
    peak_accelerations = (np.abs(joint_accelerations) - 2 * rounding_error / instant_spacing**2).max(axis=0)
    max_accelerations = parse_acceleration_limits(
        arm, accelerations, np.ones(arm.n, dtype=bool) if degraded is None else degraded.moves
    )
    is_exceeded = peak_accelerations > np.where(max_accelerations > 0, max_accelerations * (1 + 1e-9), np.inf)
    return too_fast, {arm.joint_names[index]: float(peak_accelerations[index]) for index in np.flatnonzero(is_exceeded)}


def _find_least_clearance(clearance: Clearance, q: FloatArray) -> tuple[float, float, str]:
    """Return the least clearance and margin of configurations (N, n), m, and the pair with the least margin."""
    parts = [q[first : first + _CHUNK_ROWS] for first in range(0, len(q), _CHUNK_ROWS)]
    margins = np.concatenate([clearance.margin_left(part) for part in parts])
    pair_index = int(clearance.closest_pair(q[margins.argmin()]))
    least_margin = least_clearance = float(margins.min())
    if clearance.margins.any():
        least_clearance = min(float(clearance(part).min()) for part in parts)
    return least_clearance, least_margin, clearance.pair_names[pair_index] if pair_index >= 0 else ""


def subdivide_path(q: FloatArray) -> FloatArray:
    """Return configurations along the path through q (K, n), at most 2 mrad or 2 mm of a joint apart, with the waypoints."""
    parts = [q[:1]]
    for start, end in pairwise(q):
        count = max(int(np.ceil(float(np.abs(end - start).max()) / _MAX_JOINT_STEP)), 1)
        parts.append(start + (np.arange(1, count + 1) / count)[:, None] * (end - start))
        parts[-1][-1] = end
    return np.concatenate(parts)
