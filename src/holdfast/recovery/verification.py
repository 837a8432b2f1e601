"""Whether a motion does what was asked, by code that shares only the arm and its clearance with what planned it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.poses import rotation_vectors
from holdfast.clearance.clearance import Clearance
from holdfast.errors import HoldfastError
from holdfast.failures import Degraded
from holdfast.recovery.waypoints import FIRST, check_waypoints, finely, parameter

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.keep.kept import Kept
    from holdfast.paths.path import Path
    from holdfast.recovery.rows import Rows

Array = NDArray[np.float64]

AT_WAYPOINTS = 1e-5  # m of an arm of about 1 m, and rad
BETWEEN = 1e-3, np.deg2rad(0.5)  # m and rad: between the waypoints along a tool path
_INNER = 4  # places between two waypoints


@dataclass(frozen=True, kw_only=True)
class Verification:
    """What other code finds of a motion.

    Attributes:
        faults: What is wrong, a sentence each; none if all is well.
        looked_at: Configurations, at most 2 mrad (and mm) of a joint apart.
        exact_by: What said whether anything touches: the exact sign, or lower bounds of distances; empty if nobody looked.
        goal_miss: Of the rows of the goal at the end of the motion, the largest error, m and rad; None without a goal.
        path_miss: Of the rows along the tool path, the largest error between waypoints; None without one.
        kept: Of each thing that is kept all the way, how far the tool point was off its line or plane, m, and how far it was
            turned away from what is kept, rad, at most.
    """

    faults: tuple[str, ...]
    looked_at: int
    exact_by: str
    goal_miss: float | None
    path_miss: float | None
    kept: tuple[tuple[float, float], ...] = ()

    @property
    def ok(self) -> bool:
        """Nothing is wrong."""
        return not self.faults

    def beside(self, timed: Verification) -> Verification:
        """Of a motion through waypoints, with what is found of the same motion as it is timed."""
        misses = [x for x in (self.path_miss, timed.path_miss) if x is not None]
        return replace(
            self,
            faults=(*self.faults, *(f"as it is timed, {fault}" for fault in timed.faults)),
            looked_at=self.looked_at + timed.looked_at,
            path_miss=max(misses, default=None),
            kept=tuple((max(a, c), max(b, d)) for (a, b), (c, d) in zip(self.kept, timed.kept, strict=True)),
        )

    def __str__(self) -> str:
        if self.faults:
            return "refused by other code: " + "; ".join(self.faults)
        by = f", nothing touches by {self.exact_by}" if self.exact_by else ""
        rows = ", every row kept" * bool(self.kept)
        return f"verified by other code in {self.looked_at:,} configurations{rows}{by}"


def verify(
    degraded: Degraded,
    at: Array,
    q: Array,
    *,
    rows: Rows,
    goals: Array | None = None,
    goal_q: Array | None = None,
    along: tuple[Path, Array, slice] | None = None,
    keep: Sequence[Kept] = (),
    clearance: Clearance | None = None,
    margin: float = 0.0,
    pace: tuple[Array, Array] | None = None,
) -> Verification:
    """Look at a motion through waypoints (K, n), straight in joint space, in steps of 2 mrad.

    Args:
        degraded: What limits, locks and speeds are in force.
        at: (n,) where the arm is.
        q: (K, n) the waypoints.
        rows: Of the tool's pose that count.
        goals: (G, 4, 4) one of which must be met at the end.
        goal_q: (n,) the configuration that must be met at the end.
        along: A tool path, the places (S,) on it, 0 to 1, and which waypoints are there.
        keep: What must be kept at every instant, through the pose at the start.
        clearance: Of which the motion must keep clear.
        margin: m.
        pace: Times (K,) of the waypoints, s, and the accelerations (n,) that may not be exceeded; None: as fast as speeds
            allow, and exactly through every waypoint along a tool path.
    """
    arm, faults = degraded.arm, []
    unit = max(arm.length_unit, 1.0)
    if np.abs(q[0] - at).max() > 1e-6:
        faults.append("the motion does not begin where the arm is")
    name, time = parameter(degraded.limited, q)
    replay = check_waypoints(
        arm,
        q,
        degraded,
        clearance=clearance if clearance is not None else False,
        margin=margin,
        time=pace[0] if pace is not None else time if name == FIRST[0] else None,
        accelerations=None if pace is None else pace[1],
    )
    faults += [f"{name} leaves its limits by {miss:.3g}" for name, miss in replay.beyond_limits.items()]
    faults += [f"{name} is locked and moves by {miss:.3g}" for name, miss in replay.locks_moved.items()]
    if replay.least_room is not None and replay.least_room < margin:
        faults.append(f"the room at {replay.closest} is {replay.least_room:.4g} m")
    faults += [f"{joint} is faster than it can be" for joint in replay.too_fast]
    faults += [f"{joint} accelerates by {most:.4g}, more than it may" for joint, most in replay.too_hard.items()]
    poses = tool_poses(arm, finely(q)) if keep else np.zeros((0, 4, 4))
    faults += [f"the tool is {trouble}" for trouble in (one.trouble(poses) for one in keep) if trouble]
    exact_by = "" if clearance is None else "lower bounds of the distances"
    if clearance is not None and clearance.pair_names:
        try:
            touching = int((~clearance.sign(finely(q))).sum())
            exact_by = "the exact sign"
            if touching:
                faults.append(
                    f"the arm touches something at {touching} of {replay.looked_at} configurations, by the exact sign"
                )
        except HoldfastError:  # no library for it is installed
            pass
    goal_miss = path_miss = None
    if goal_q is not None:
        away = q[-1] - goal_q
        turns = ~arm.prismatic & ~np.isfinite(arm.lower) & ~np.isfinite(arm.upper)
        goal_miss = float(np.abs(np.where(turns, away - 2 * np.pi * np.round(away / (2 * np.pi)), away)).max())
    elif goals is not None:
        ends = np.repeat(q[-1:], len(goals), axis=0)
        goal_miss = float(np.abs(row_errors(arm, rows, ends, goals)).max(axis=1).min())
    if goal_miss is not None and goal_miss > AT_WAYPOINTS * unit:
        faults.append(f"the goal is missed by {goal_miss:.3g} (m or rad)")
    if along is not None:
        path, places, part = along
        at_poses = float(np.abs(row_errors(arm, rows, q[part], path.pose(places))).max())
        if pace is None and at_poses > AT_WAYPOINTS * unit:
            faults.append(f"the tool path is missed by {at_poses:.3g} (m or rad)")
        s = np.arange(1, _INNER + 1) / (_INNER + 1)
        inner = np.concatenate([a + s[:, None] * (b - a) for a, b in pairwise(q[part])])
        off = np.abs(row_errors(arm, rows, inner, path.pose(np.concatenate([a + s * (b - a) for a, b in pairwise(places)]))))
        path_miss = float(off.max())
        beyond = off > np.where(np.array(rows.units) == "m", BETWEEN[0] * unit, BETWEEN[1])
        if beyond.any():
            name = rows.names[int(beyond.any(axis=0).argmax())]
            faults.append(f"between waypoints {name} is off the tool path by {off[beyond].max():.3g} (m or rad)")
    return Verification(
        faults=tuple(faults),
        looked_at=replay.looked_at,
        exact_by=exact_by,
        goal_miss=goal_miss,
        path_miss=path_miss,
        kept=tuple(one.farthest(poses) for one in keep),
    )


def row_errors(arm: Arm, rows: Rows, q: Array, poses: Array) -> Array:
    """Signed errors (N, m) of rows at q (N, n) and poses (N, 4, 4), m and rad, by chains of matrices in NumPy alone."""
    have = tool_poses(arm, q)
    away, turn = poses[:, :3, 3] - have[:, :3, 3], rotation_vectors(poses[:, :3, :3] @ have[:, :3, :3].transpose(0, 2, 1))
    back = have[:, :3, :3].transpose(0, 2, 1)
    parts = [
        (back @ part[:, :, None])[:, :, 0] if frame == "tool" else part
        for part, frame in ((away, rows.linear), (turn, rows.angular))
    ]
    errors = np.concatenate(parts, axis=1) @ rows.matrix.T
    if rows.within is None:
        return np.asarray(errors)
    axis, wanted = have[:, :3, 2], poses[:, :3, 2]
    tilt = np.arctan2(np.linalg.norm(np.cross(axis, wanted), axis=1), (axis * wanted).sum(axis=1))
    return np.column_stack([errors, np.maximum(tilt - rows.within, 0.0)])


def tool_poses(arm: Arm, q: Array) -> Array:
    """(N, 4, 4) of the tool at q (N, n), joint by joint: Rodrigues' formula, and no kernel."""
    pose = np.repeat(arm.base[None], len(q), axis=0)
    for k, joint in enumerate(arm.joints):
        moved = np.repeat(np.eye(4)[None], len(q), axis=0)
        if joint.prismatic:
            moved[:, :3, 3] = q[:, k, None] * joint.axis
        else:
            x, y, z = joint.axis
            cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
            s, c = np.sin(q[:, k])[:, None, None], np.cos(q[:, k])[:, None, None]
            moved[:, :3, :3] = np.eye(3) + s * cross + (1 - c) * (cross @ cross)
        pose = pose @ joint.origin @ moved
    return np.asarray(pose @ arm.tool)
