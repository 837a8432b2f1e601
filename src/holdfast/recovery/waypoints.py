"""Waypoints as CSV files, and a check that replays them through kinematics, limits and clearance.

The first column is ``time_s`` (each straight piece at the velocity limit of its slowest joint, accelerations left aside) or,
for an arm without velocity limits, ``travel_rad`` (length of the joints' motion so far, 1 m of a slide counted as 1 rad); the
others are joints, ``joint1_rad`` or ``slide_m``. In between, joints move in a straight line. Of a motion that is timed within
accelerations (:class:`holdfast.recovery.TimedMotion`) the rates and accelerations follow.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import real_numbers
from holdfast.arm.model import Arm
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.sharper import sharpened
from holdfast.errors import InputError
from holdfast.failures import Degraded, Locked, degraded_at
from holdfast.files.output import writing
from holdfast.files.spreadsheet import cell
from holdfast.keep.labels import KeepLike, all_kept
from holdfast.paths.joint_table import JointTable, joint_columns, motion_columns, read_joint_table
from holdfast.recovery.timing.limits import AccelerationsLike, limits_by_joint
from holdfast.result import Result

Array = NDArray[np.float64]

FIRST = ("time_s", "travel_rad")
_FINE = 2e-3  # rad and m between configurations looked at
_CHUNK = 100_000


def parameter(arm: Arm, q: Array) -> tuple[str, Array]:
    """Name and values (K,) of the first column for waypoints (K, n)."""
    moved = np.abs(np.diff(q, axis=0))
    speed = np.array([j.velocity for j in arm.joints])
    moving = moved.max(axis=0, initial=0.0) > 0
    if (np.isfinite(speed[moving]) & (speed[moving] > 0)).all():
        steps = (moved[:, moving] / speed[moving]).max(axis=1, initial=0.0)
        return FIRST[0], np.concatenate([[0.0], np.cumsum(steps)])[: len(q)]
    return FIRST[1], np.concatenate([[0.0], np.cumsum(np.linalg.norm(moved, axis=1))])[: len(q)]


def write_waypoints(arm: Arm, q: Array, path: str | Path) -> Path:
    """Write waypoints (K, n), rad and m, with every digit.

    Raises:
        StoreError: The file cannot be written.
    """
    file = Path(path)
    name, values = parameter(arm, q)
    with writing(file, "waypoints") as stream:
        writer = csv.writer(stream)
        writer.writerow(map(cell, [name, *joint_columns(arm)]))
        writer.writerows([[repr(float(x)) for x in row] for row in np.column_stack([values, q])])
    return file


def read_waypoints(arm: Arm, path: str | Path) -> Array:
    """Waypoints (K, n), rad and m, that :func:`write_waypoints` wrote; of other columns none is needed.

    Raises:
        InputError: Unreadable, or a column, line or number that is missing or wrong; the message names it.
    """
    return _table(arm, path).numbers(joint_columns(arm))


def read_times(arm: Arm, path: str | Path) -> Array | None:
    """Times (K,) of such waypoints, s; None where the file has none.

    Raises:
        InputError: As for :func:`read_waypoints`.
    """
    table = _table(arm, path)
    return table.numbers(FIRST[:1])[:, 0] if FIRST[0] in table.head else None


def _table(arm: Arm, path: str | Path) -> JointTable:
    table, known = read_joint_table(arm, Path(path), "waypoints", FIRST[0]), motion_columns(arm)
    odd = [name for name in table.head if name not in FIRST and not any(name in names for names in known)]
    if odd:
        raise InputError(f"{table.title}: column '{odd[0]}' is not known; columns are {', '.join([FIRST[0], *known[0]])}")
    return table


@dataclass(frozen=True, kw_only=True)
class WaypointCheck(Result):
    """What a motion through waypoints does, in small steps.

    Attributes:
        q: (K, n) the waypoints, rad and m.
        poses: (K, 4, 4) of the end effector at them, world, m.
        looked_at: Configurations on the way that were looked at.
        beyond_limits: Joints that leave their limits, by name, with the most by which they do, rad or m.
        locks_moved: Locked joints that move, by name, with the farthest from their angle, rad or m.
        least_clearance: m; None if the clearance was not looked at.
        least_room: m, what is least left beyond the margins of the objects of a cell; None if that was not looked at.
        closest: Names of the pair that attains it, ``panda_joint4 & table``; empty where there is none.
        margin: m, that was asked for.
        kept: By how much each thing that should be kept all the way is broken, a phrase; empty where it is not.
        too_fast: Joints faster than they can be, by name, with their greatest mean speed between two waypoints, rad/s or m/s;
            empty where no times were given.
        too_hard: The same of mean accelerations over two pieces, rad/s^2 or m/s^2, from standstill to standstill.
        paced: What of these was looked at: ``speeds``, ``speeds and accelerations``, or nothing.
    """

    q: Array
    poses: Array
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
        """True if limits, locks, rows, clearance, and speeds and accelerations where they were looked at, are kept."""
        broken = self.beyond_limits or self.locks_moved or self.too_fast or self.too_hard or any(self.kept)
        return self._clear and not broken

    @property
    def _clear(self) -> bool:
        return self.least_room is None or self.least_room >= self.margin

    def describe(self) -> list[str]:
        """A few sentences for people."""
        lines = [f"{len(self.q)} waypoints, looked at in {self.looked_at:,} configurations"]
        lines += [f"{name} leaves its limits by {miss:.4g}" for name, miss in self.beyond_limits.items()]
        lines += [f"{name} should be locked and moves {miss:.4g} away" for name, miss in self.locks_moved.items()]
        lines += [f"{name} is too fast: {rate:.4g} a second" for name, rate in self.too_fast.items()]
        lines += [f"{name} accelerates by {rate:.4g} a second squared" for name, rate in self.too_hard.items()]
        lines += [f"the tool is {trouble}" for trouble in self.kept if trouble]
        if self.kept and not any(self.kept):
            lines.append("what is kept all the way is kept")
        if self.least_clearance is None:
            lines.append("clearance was not looked at")
        else:
            where = f"{self.closest}, " if self.closest else ""
            verdict = "kept" if self._clear else "NOT KEPT"
            lines.append(f"least clearance {self.least_clearance:.4g} m ({where}margin {self.margin:g} m): {verdict}")
        if not self.beyond_limits and not self.locks_moved:
            lines.append("limits and locks are kept")
        if self.paced and not self.too_fast and not self.too_hard:
            lines.append(f"{self.paced} are kept")
        return lines


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
    """Replay waypoints in steps of at most 2 mrad or 2 mm of a joint, by code that shares nothing with the planner.

    Args:
        arm: The arm.
        q: (K, n) waypoints, rad and m.
        locked: ``{joint: value}``, rad or m, of the joints that are locked; None for where the first waypoint has it. Or a
            :class:`holdfast.Degraded`, whose reduced ranges must be kept too.
        clearance: Looked at if given.
        cell: Objects around the arm, or their file; looked at if given. What the bound calls too close is asked exactly where a
            library for that is installed.
        margin: m that should be kept; from an object beyond what the cell keeps from it.
        keep: What the tool should keep along the whole motion; see :func:`holdfast.recover`.
        time: (K,) s, of each waypoint; then differences must keep the speeds that are left.
        accelerations: Limits that second differences must keep, from standstill to standstill; see :func:`holdfast.recover`.

    Raises:
        InputError: Invalid waypoints or times, an unknown joint, accelerations without times, or a cell that cannot be read or
            does not fit.
    """
    a = np.atleast_2d(arm.check_configurations(q))
    if not len(a) or not np.isfinite(a).all():
        raise InputError("waypoints must be one configuration or more of finite numbers")
    fine = finely(a)
    degraded = degraded_at(arm, locked, a[0])
    limits = arm if degraded is None else degraded.limited
    beyond = np.maximum(np.maximum(limits.lower - fine, fine - limits.upper).max(axis=0), 0.0)
    locks = {} if degraded is None else degraded.locked
    moved = {
        name: float(np.abs(fine[:, arm.joint_index(name)] - value).max()) for name, value in locks.items() if value is not None
    }
    seen = chosen_clearance(arm, clearance, cell, looks=False)
    least = room = None
    closest = ""
    if seen is not None:
        least, room, closest = _nearest(seen, fine)
        sharp = sharpened(seen, margin) if room < margin else None
        if sharp is not None:
            least, room, closest = _nearest(sharp, fine)
    poses = arm.forward_kinematics(a)
    rows = all_kept(keep, poses[0])
    too_fast, too_hard = _paced(arm, degraded, a, time, accelerations)
    return WaypointCheck(
        too_fast=too_fast,
        too_hard=too_hard,
        paced="" if time is None else "speeds" if accelerations is None else "speeds and accelerations",
        q=a,
        poses=poses,
        kept=tuple(one.trouble(arm.forward_kinematics(fine)) for one in rows),
        looked_at=len(fine),
        beyond_limits={arm.joint_names[k]: float(beyond[k]) for k in np.flatnonzero(beyond > 1e-12)},
        locks_moved={name: miss for name, miss in moved.items() if miss > 1e-12},
        least_clearance=least,
        least_room=room,
        closest=closest,
        margin=margin,
    )


def _paced(
    arm: Arm, degraded: Degraded | None, q: Array, time: ArrayLike | None, accelerations: AccelerationsLike | None
) -> tuple[dict[str, float], dict[str, float]]:
    """Joints that are too fast and those that accelerate too hard, by name, with means that some instant has at least."""
    if time is None:
        if accelerations is not None:
            raise InputError("accelerations need times; give the time of each waypoint, or a file with a column time_s")
        return {}, {}
    t = real_numbers(time, "time", "a number for each waypoint, s")
    if t.shape != (len(q),) or not np.isfinite(t).all() or (np.diff(t) < 0).any():
        raise InputError(f"time must be {len(q)} finite numbers that never fall, one for each waypoint, s")
    step = np.maximum(np.diff(t), 1e-12)[:, None]
    rates = np.diff(q, axis=0) / step
    speed = np.array([j.velocity for j in (arm if degraded is None else degraded.limited).joints])
    noise = 8 * np.finfo(float).eps * np.abs(q).max(initial=1.0)
    fastest = (np.abs(rates) - noise / step).max(axis=0, initial=0.0)
    known = np.isfinite(speed) & (speed > 0)
    found = fastest > np.where(known, speed * (1 + 1e-9), np.inf)
    too_fast = {arm.joint_names[k]: float(fastest[k]) for k in np.flatnonzero(found)}
    if accelerations is None or len(q) < 2:
        return too_fast, {}
    still = np.zeros((1, arm.n))
    apart = np.concatenate([step[:1], step[:-1] + step[1:], step[-1:]]) / 2
    change = np.diff(np.concatenate([still, rates, still]), axis=0) / apart
    hardest = (np.abs(change) - 2 * noise / apart**2).max(axis=0)
    most = limits_by_joint(arm, accelerations, np.ones(arm.n, dtype=bool) if degraded is None else degraded.moves)
    found = hardest > np.where(most > 0, most * (1 + 1e-9), np.inf)
    return too_fast, {arm.joint_names[k]: float(hardest[k]) for k in np.flatnonzero(found)}


def _nearest(clearance: Clearance, q: Array) -> tuple[float, float, str]:
    """The least clearance and room of configurations (N, n), m, and the pair with the least room."""
    parts = [q[i : i + _CHUNK] for i in range(0, len(q), _CHUNK)]
    rooms = np.concatenate([clearance.room(part) for part in parts])
    k = int(clearance.closest_pair(q[rooms.argmin()]))
    least = min(float(clearance(part).min()) for part in parts)
    return least, float(rooms.min()), clearance.pair_names[k] if k >= 0 else ""


def finely(q: Array) -> Array:
    """Configurations along the way through q (K, n), at most 2 mrad or 2 mm of a joint apart, the waypoints among them."""
    parts = [q[:1]]
    for a, b in pairwise(q):
        count = max(int(np.ceil(float(np.abs(b - a).max()) / _FINE)), 1)
        parts.append(a + (np.arange(1, count + 1) / count)[:, None] * (b - a))
        parts[-1][-1] = b
    return np.concatenate(parts)
