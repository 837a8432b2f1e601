"""Waypoints as CSV files, and a check that replays them through kinematics, limits and clearance.

The first column is ``time_s`` (each straight piece at the velocity limit of its slowest joint, accelerations left aside) or,
for an arm without velocity limits, ``travel_rad`` (length of the joints' motion so far, 1 m of a slide counted as 1 rad); the
others are joints, ``joint1_rad`` or ``slide_m``. In between, joints move in a straight line.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm.model import Arm
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.sharper import sharpened
from holdfast.errors import InputError
from holdfast.failures import Locked, degraded_at
from holdfast.files.output import writing
from holdfast.keep.labels import KeepLike, all_kept
from holdfast.paths.joint_table import joint_columns, read_joint_table
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
        writer.writerow([name, *joint_columns(arm)])
        writer.writerows([[repr(float(x)) for x in row] for row in np.column_stack([values, q])])
    return file


def read_waypoints(arm: Arm, path: str | Path) -> Array:
    """Waypoints (K, n), rad and m, that :func:`write_waypoints` wrote; the first column is not needed.

    Raises:
        InputError: Unreadable, or a column, line or number that is missing or wrong; the message names it.
    """
    table, wanted = read_joint_table(arm, Path(path), "waypoints", FIRST[0]), joint_columns(arm)
    odd = [name for name in table.head if name not in wanted and name not in FIRST]
    if odd:
        raise InputError(f"{table.title}: column '{odd[0]}' is not known; columns are {', '.join([FIRST[0], *wanted])}")
    return table.numbers(wanted)


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

    @property
    def ok(self) -> bool:
        """True if limits, locks, rows and clearance are kept."""
        return self._clear and not self.beyond_limits and not self.locks_moved and not any(self.kept)

    @property
    def _clear(self) -> bool:
        return self.least_room is None or self.least_room >= self.margin

    def describe(self) -> list[str]:
        """A few sentences for people."""
        lines = [f"{len(self.q)} waypoints, looked at in {self.looked_at:,} configurations"]
        lines += [f"{name} leaves its limits by {miss:.4g}" for name, miss in self.beyond_limits.items()]
        lines += [f"{name} should be locked and moves {miss:.4g} away" for name, miss in self.locks_moved.items()]
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

    Raises:
        InputError: Invalid waypoints, an unknown joint, or a cell that cannot be read or does not fit.
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
    return WaypointCheck(
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
