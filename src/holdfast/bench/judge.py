"""Whether a motion does a case: by plain NumPy, which shares only the arm and the cell with those who planned it."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.poses import rotation_vectors
from holdfast.bench.cases import Case
from holdfast.clearance.clearance import Clearance

Array = NDArray[np.float64]

NEAR, TURN = 1e-3, np.deg2rad(0.5)  # m and rad within which rows count as met
_FINE = 2e-3  # rad and m between configurations looked at
_ROUND = 1e-9  # of limits and of the start
_LOCK = 1e-12  # rad and m by which a lock may move


@dataclass(frozen=True, eq=False)
class Motion:
    """What a planner gives.

    Attributes:
        q: (K, n) waypoints, joints moving in straight lines between them, rad and m.
        first: From which of them on the path is followed.
        share: (K - first,) where on the path each of these is, 0 to 1; empty where a pose is to be reached.
    """

    q: Array
    _: KW_ONLY
    first: int = 0
    share: Array


def trouble(case: Case, motion: Motion | None, clearance: Clearance | None) -> str:
    """Why the motion does not do the case, in a word; nothing if it does.

    Looked at every 2 mrad or 2 mm of a joint: rows within 1 mm and 0.5 deg (of the goal, or of the path at every instant),
    what is kept all the way, limits, locks and start exact, and clear by the exact sign.

    Raises:
        HoldfastError: The extra ``cell`` is not installed, which the exact sign needs.
    """
    if motion is None or not len(motion.q):
        return "none"
    arm, degraded = case.degraded.arm, case.degraded
    at, q = _between(motion.q)
    if np.abs(q[0] - case.at).max() > _ROUND:
        return "start"
    moves = degraded.moves
    if (np.abs(q - case.at)[:, ~moves] > _LOCK).any():
        return "lock"
    if ((q < degraded.lo - _ROUND) | (q > degraded.hi + _ROUND))[:, moves].any():
        return "limits"
    poses = arm.forward_kinematics(q)
    if any(kept.trouble(poses) for kept in case.keep):
        return "kept"
    if case.goal is not None and not _met(case, poses[-1:], case.goal[None])[0]:
        return "goal"
    if case.path is not None:
        if motion.share[0] > _ROUND or motion.share[-1] < 1 - _ROUND or (np.diff(motion.share) < 0).any():
            return "path"
        on = at >= motion.first
        wanted = case.path.pose(np.interp(at[on] - motion.first, np.arange(len(motion.share)), motion.share))
        if not _met(case, poses[on], wanted).all():
            return "path"
    if clearance is not None and not clearance.sign(q).all():
        return "contact"
    return ""


def _met(case: Case, poses: Array, wanted: Array) -> NDArray[np.bool_]:
    """(N,) True where every row of the task is within tolerance."""
    turned, rows = poses[:, :3, :3], case.rows.rows
    error = np.concatenate(
        [wanted[:, :3, 3] - poses[:, :3, 3], rotation_vectors(wanted[:, :3, :3] @ turned.transpose(0, 2, 1))], axis=1
    )
    if case.rows.frame == "tool":
        error = np.concatenate([np.einsum("nji,nj->ni", turned, e) for e in (error[:, :3], error[:, 3:])], axis=1)
    tolerance = np.where(np.abs(rows[:, :3]).max(axis=1) > 0, NEAR, TURN)
    return np.asarray((np.abs(error @ rows.T) <= tolerance).all(axis=1))


def _between(q: Array) -> tuple[Array, Array]:
    """Configurations on the way, and at which waypoint, with fractions, each is."""
    most = np.abs(np.diff(q, axis=0)).max(axis=1, initial=0.0)
    parts = [np.linspace(k, k + 1, max(int(np.ceil(size / _FINE)), 1), endpoint=False) for k, size in enumerate(most)]
    at = np.concatenate([*parts, [len(q) - 1.0]])
    return at, np.stack([np.interp(at, np.arange(len(q)), column) for column in q.T], axis=1)
