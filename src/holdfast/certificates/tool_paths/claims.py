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
_MAX_TUBE = 0.1  # m and rad
_MAX_JOINT_VALUE = 7.0  # rad and m, a limit of the file format
_INSTANT_STEP = SEGMENT_INSTANTS >> 6  # ends of a claimed interval are multiples of this number of instants


@dataclass(frozen=True, kw_only=True)
class PathClaim(Claim):
    """Claim that one continuous motion finishes the path of the tool after a lock at any instant of a healthy motion.

    Attributes:
        arm: The arm.
        task: Components of the tool that follow the path: ``pose``, ``position``, ``pointing``, ``planar`` or ``planar-pose``.
        knots: (K + 1, n) configurations of the healthy motion, rad and m, connected by straight lines.
        locks: Indices of the joints that may lock, one at a time, in ascending order.
        during: First and last instant of a lock, in units of 2^-20 of a segment.
        tube: (2,) distance, m, and angle, rad. Any continuous path that begins on the path and stays this close is finished,
            too.
        deviation: Largest distance, m, between the tool at the given configurations and on the straight segments.
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
    """Make the claim that a continuous motion finishes the path of the tool after any single lock at any instant.

    The locked joint stays at its value in the healthy motion at that instant, and the other joints begin at theirs.

    Args:
        arm: The arm.
        motion: (K + 1, n) consecutive configurations of the healthy arm, rad and m, or an object with such a ``q``, for
            example a :class:`holdfast.Trajectory`. The joints move along straight lines between them, and the claim is about
            the tool path of this motion.
        failures: Joints that may lock, one at a time: ``"single"``, or a list of joints by name or index from 0.
        during: First and last instant of a lock as fractions of the motion, in which all segments count equally; rounded
            outwards to 1/64 of a segment.
        tube: Distance, m, also used as the angle, rad, for a task with rotations; or both numbers. Any continuous tool path
            that begins on the path and stays this close is finished, too.
        task: Components of the tool that follow the path: ``pose``, ``position``, ``pointing``, ``planar`` or ``planar-pose``.
        segments: Number of segments to use, each with nearly the same number of steps. Default: all, at most 256.

    Raises:
        InputError: The motion, interval or tube is invalid, the motion exceeds the limits, or the arm leaves the plane.
        TaskError: The arm has no redundancy, or a failure does not have exactly one joint.
    """
    if task not in TASK_ROWS:
        raise InputError(f"task is '{task}'; for a path it must be {', '.join(TASK_ROWS)}")
    if task == "pointing" and np.any(tube):
        raise InputError(f"tube is {np.asarray(tube).tolist()}; it must be 0 for a pointing path")
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
            f"a joint of the motion is at {np.abs(configurations).max():.3g} rad or m; for certificates of paths it must be "
            f"{_MAX_JOINT_VALUE:g} or less"
        )
    outside = np.argwhere((configurations < arm.lower) | (configurations > arm.upper))
    if outside.size:
        row, joint = outside[0].tolist()
        raise InputError(f"configuration {row + 1} of the motion is beyond the limits of {arm.joint_names[joint]}")
    knots = configurations
    if segments is not None:
        if not 1 <= segments < len(configurations):
            raise InputError(f"segments is {segments}; for this motion it must be from 1 to {len(configurations) - 1}")
        knots = configurations[np.round(np.linspace(0, len(configurations) - 1, segments + 1)).astype(int)]
    if len(knots) - 1 > _MAX_SEGMENTS:
        raise InputError(f"{len(knots) - 1} segments are more than {_MAX_SEGMENTS}; use fewer, for example segments=50")
    return PathClaim(
        arm=arm, task=task, knots=knots, locks=locks, during=_claimed_lock_instants(during, len(knots) - 1),
        tube=_parse_tube(tube), deviation=_measure_deviation(arm, configurations, knots),
    )  # fmt: skip


def _claimed_lock_instants(during: Sequence[float], count: int) -> tuple[int, int]:
    """Return the first and last lock instant in units of the file."""
    if len(during) != 2 or not 0 <= during[0] < during[1] <= 1:
        raise InputError("during must be two fractions of the motion between 0 and 1, the earlier one first")
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
