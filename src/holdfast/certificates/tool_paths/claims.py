"""What a certificate of a path is asked to prove."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, real_numbers
from holdfast.arm.model import Arm
from holdfast.certificates.claims import ROWS, need_flat
from holdfast.certificates.tool_paths.cells import SEGMENT
from holdfast.errors import InputError
from holdfast.failures.sets import FailureSpec, require_redundant, single_joints

Array = NDArray[np.float64]

_MOST_SEGMENTS = 256
_WIDEST = 0.1  # m and rad, of a tube
_MOST_TURN = 7.0  # rad and m, as the file counts them
_FINEST = SEGMENT >> 6  # instants: ends of what is claimed are multiples of it


@dataclass(frozen=True, kw_only=True)
class PathClaim:
    """After a lock at any instant of a healthy motion, one continuous motion finishes the path of the tool.

    Attributes:
        arm: The arm.
        task: ``pose``, ``position``, ``pointing``, ``planar`` or ``planar-pose``: what of the tool follows the path.
        knots: (K + 1, n) rad and m, of the healthy motion, which is straight between them.
        locks: Indices of the joints that may lock, one at a time, in order.
        during: First and last instant of a lock, in units of 2^-20 of a segment.
        tube: (2,) m and rad: within this of the path, any continuous one that begins on it is finished as well.
        deviation: m, between the tool at configurations that were given and that of the straight segments, at most.
    """

    arm: Arm
    task: str
    knots: Array
    locks: tuple[int, ...]
    during: tuple[int, int]
    tube: Array
    deviation: float

    @property
    def segments(self) -> int:
        """K."""
        return len(self.knots) - 1


@checked
def path_claim(
    arm: Arm,
    motion: object,
    *,
    failures: FailureSpec = "single",
    during: tuple[float, float] = (0.0, 1.0),
    tube: ArrayLike = 0.0,
    task: str = "pose",
    segments: int | None = None,
) -> PathClaim:
    """The claim that whatever joint locks, and whenever, one continuous motion finishes what the tool was doing.

    The locked joint stays where the healthy motion had it at that instant; the others begin where they are.

    Args:
        arm: The arm.
        motion: (K + 1, n) rad and m, configurations of the healthy arm one after the other, or what has such a ``q``, as a
            :class:`holdfast.Trajectory`. Between them joints move along straight lines, and it is the path of the tool on that
            motion which is finished.
        failures: Which joints may lock, one at a time: ``"single"``, or a list of joints by name or index from 0.
        during: From when to when a joint may lock, as parts of the motion, all of whose segments count alike; rounded outwards
            to 1/64 of a segment.
        tube: m, and rad as well where the task has rotations, or these two: any continuous path of the tool is finished that
            begins on that of the motion and stays within this of it.
        task: ``pose``, ``position``, ``pointing``, ``planar`` or ``planar-pose``: what of the tool follows the path.
        segments: Use so many, of equal numbers of steps of the motion as nearly as may be; default: all, at most 256.

    Raises:
        InputError: A motion, interval or tube that makes no claim, a motion beyond the limits, or an arm that leaves the plane.
        TaskError: An arm without redundancy, no failures, or failures of several joints at once.
    """
    if task not in ROWS:
        raise InputError(f"task is '{task}'; paths are of {', '.join(ROWS)}")
    if task == "pointing" and np.any(tube):
        raise InputError("there is no tube around a pointing path; tube must be 0")
    if task == "planar-pose":
        need_flat(arm, "a planar pose is")
    locks = tuple(sorted(single_joints(arm, failures)))
    require_redundant(arm, len(ROWS[task]), task, tuple((k,) for k in locks))
    given = real_numbers(getattr(motion, "q", motion), "motion", f"configurations, (K + 1, {arm.n}), rad and m")
    if given.ndim != 2 or given.shape[1] != arm.n or len(given) < 2 or not np.isfinite(given).all():
        raise InputError(f"a motion needs two configurations or more of {arm.n} finite numbers, not an array of {given.shape}")
    if np.abs(given).max() >= _MOST_TURN:
        raise InputError(
            f"a joint of the motion is at {np.abs(given).max():.3g} rad or m; for certificates of paths {_MOST_TURN:g} is most"
        )
    beyond = ((given < arm.lower) | (given > arm.upper)).any(axis=1)
    if beyond.any():
        row = int(np.flatnonzero(beyond)[0])
        k = int(np.flatnonzero((given[row] < arm.lower) | (given[row] > arm.upper))[0])
        raise InputError(f"configuration {row + 1} of the motion is beyond the limits of {arm.joint_names[k]}")
    knots = given
    if segments is not None:
        if not 1 <= segments < len(given):
            raise InputError(f"segments is {segments}; of this motion it may be 1 to {len(given) - 1}")
        knots = given[np.round(np.linspace(0, len(given) - 1, segments + 1)).astype(int)]
    if len(knots) - 1 > _MOST_SEGMENTS:
        raise InputError(f"{len(knots) - 1} segments are more than {_MOST_SEGMENTS}; give segments=50, say, to use fewer")
    return PathClaim(
        arm=arm, task=task, knots=knots, locks=locks, during=_instants(during, len(knots) - 1), tube=_tube(tube),
        deviation=_deviation(arm, given, knots),
    )  # fmt: skip


def _instants(during: Sequence[float], count: int) -> tuple[int, int]:
    """In units of the file."""
    if len(during) != 2 or not 0 <= during[0] < during[1] <= 1:
        raise InputError("during must be two parts of the motion between 0 and 1, the earlier one first")
    fine = count * SEGMENT // _FINEST
    return int(np.floor(during[0] * fine)) * _FINEST, int(np.ceil(during[1] * fine)) * _FINEST


def _tube(tube: ArrayLike) -> Array:
    widths = np.asarray(tube, dtype=np.float64).reshape(-1)
    if widths.size not in (1, 2) or not ((widths >= 0) & (widths <= _WIDEST)).all():
        raise InputError(f"the tube must be one number, m and rad, or one for each, from 0 to {_WIDEST}")
    return np.broadcast_to(widths, 2).astype(np.float64)


def _deviation(arm: Arm, given: Array, knots: Array) -> float:
    """m, at the configurations that were given, by their numbers."""
    at = np.linspace(0, 1, len(given))
    kept = at[np.round(np.linspace(0, len(given) - 1, len(knots))).astype(int)]
    straight = np.stack([np.interp(at, kept, column) for column in knots.T], axis=1)
    tools = (arm.forward_kinematics(q)[:, :3, 3] for q in (given, straight))
    return float(np.linalg.norm(next(tools) - next(tools), axis=1).max())
