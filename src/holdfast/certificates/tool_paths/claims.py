"""Claims that the path of a tool is finished after a lock."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from holdfast.certificates.claims import TASK_ROWS, require_planar
from holdfast.certificates.kinds import Claim
from holdfast.certificates.tool_paths.cells import SEGMENT_INSTANTS
from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.model.arm.model import Arm
from holdfast.model.failure_modes.sets import FailureSpec, require_redundant, single_joints

_MAX_SEGMENTS = 256
_MAX_TUBE = 0.1  # m and rad, of a tube
_MAX_JOINT_VALUE = 7.0  # rad and m, as the file counts them
_INSTANT_STEP = SEGMENT_INSTANTS >> 6  # instants: ends of what is claimed are multiples of it


@dataclass(frozen=True, kw_only=True)
class PathClaim(Claim):
    """Claim that one continuous motion finishes the path of the tool after a lock at any instant of a healthy motion.

    Attributes:
        arm: The arm.
        task: ``pose``, ``position``, ``pointing``, ``planar`` or ``planar-pose``: what of the tool follows the path.
        knots: (K + 1, n) rad and m, of the healthy motion, which is straight between them.
        locks: Indices of the joints that may lock, one at a time, in order.
        during: First and last instant of a lock, in units of 2^-20 of a segment.
        tube: (2,) m and rad: within this of the path, any continuous one that begins on it is finished as well.
        deviation: m, between the tool at configurations that were given and that of the straight segments, at most.
    """

    kind: ClassVar[str] = "path"
    arm: Arm
    task: str
    knots: FloatArray
    locks: tuple[int, ...]
    during: tuple[int, int]
    tube: FloatArray
    deviation: float

    @property
    def segments(self) -> int:
        """Number of segments K."""
        return len(self.knots) - 1


@check_arguments
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
    """Make the claim that, for any single locked joint and any lock instant, one continuous motion finishes the path of the
    tool.

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
    if task not in TASK_ROWS:
        raise InputError(f"task is '{task}'; paths are of {', '.join(TASK_ROWS)}")
    if task == "pointing" and np.any(tube):
        raise InputError("there is no tube around a pointing path; tube must be 0")
    if task == "planar-pose":
        require_planar(arm, "a planar pose is")
    locks = tuple(sorted(single_joints(arm, failures)))
    require_redundant(arm, len(TASK_ROWS[task]), task, tuple((joint,) for joint in locks))
    wanted = f"configurations, (K + 1, {arm.n}), rad and m"
    configurations = require_real_numbers(getattr(motion, "q", motion), "motion", wanted)
    is_motion = configurations.ndim == 2 and configurations.shape[1] == arm.n and len(configurations) >= 2
    if not is_motion or not np.isfinite(configurations).all():
        raise InputError(
            f"a motion needs two configurations or more of {arm.n} finite numbers, not an array of {configurations.shape}"
        )
    if np.abs(configurations).max() >= _MAX_JOINT_VALUE:
        raise InputError(
            f"a joint of the motion is at {np.abs(configurations).max():.3g} rad or m; for certificates of paths "
            f"{_MAX_JOINT_VALUE:g} is most"
        )
    outside = np.argwhere((configurations < arm.lower) | (configurations > arm.upper))
    if outside.size:
        row, joint = outside[0].tolist()
        raise InputError(f"configuration {row + 1} of the motion is beyond the limits of {arm.joint_names[joint]}")
    knots = configurations
    if segments is not None:
        if not 1 <= segments < len(configurations):
            raise InputError(f"segments is {segments}; of this motion it may be 1 to {len(configurations) - 1}")
        knots = configurations[np.round(np.linspace(0, len(configurations) - 1, segments + 1)).astype(int)]
    if len(knots) - 1 > _MAX_SEGMENTS:
        raise InputError(f"{len(knots) - 1} segments are more than {_MAX_SEGMENTS}; give segments=50, say, to use fewer")
    return PathClaim(
        arm=arm, task=task, knots=knots, locks=locks, during=_claimed_lock_instants(during, len(knots) - 1),
        tube=_parse_tube(tube), deviation=_measure_deviation(arm, configurations, knots),
    )  # fmt: skip


def _claimed_lock_instants(during: Sequence[float], count: int) -> tuple[int, int]:
    """Return the first and last lock instant in units of the file."""
    if len(during) != 2 or not 0 <= during[0] < during[1] <= 1:
        raise InputError("during must be two parts of the motion between 0 and 1, the earlier one first")
    step_count = count * SEGMENT_INSTANTS // _INSTANT_STEP
    return int(np.floor(during[0] * step_count)) * _INSTANT_STEP, int(np.ceil(during[1] * step_count)) * _INSTANT_STEP


def _parse_tube(tube: ArrayLike) -> FloatArray:
    widths = np.asarray(tube, dtype=np.float64).reshape(-1)
    if widths.size not in (1, 2) or not ((widths >= 0) & (widths <= _MAX_TUBE)).all():
        raise InputError(f"the tube must be one number, m and rad, or one for each, from 0 to {_MAX_TUBE}")
    return np.broadcast_to(widths, 2).astype(np.float64)


def _measure_deviation(arm: Arm, configurations: FloatArray, knots: FloatArray) -> float:
    """Return the largest distance, m, between the tool at the given configurations and on the straight segments."""
    parameters = np.linspace(0, 1, len(configurations))
    knot_parameters = parameters[np.round(np.linspace(0, len(configurations) - 1, len(knots))).astype(int)]
    interpolated = np.stack([np.interp(parameters, knot_parameters, column) for column in knots.T], axis=1)
    positions = (arm.forward_kinematics(q)[:, :3, 3] for q in (configurations, interpolated))
    return float(np.linalg.norm(next(positions) - next(positions), axis=1).max())
