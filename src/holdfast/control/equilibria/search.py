"""Search for stationary points of a failed arm, at given values of the locked joints or as curves over the value of one."""

from __future__ import annotations

from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.equilibria.curves import Curves
from holdfast.control.equilibria.points import StationaryPoints, find_stationary_points
from holdfast.control.equilibria.system import RestSystem
from holdfast.control.equilibria.tracing import trace_curves
from holdfast.control.laws.law import Law
from holdfast.core.progress import report_work
from holdfast.core.validation import check_arguments
from holdfast.model.arm.task import target_pose
from holdfast.model.failure_modes import Locked, LockedAnywhere, LockedAt, locks_with_values, read_locks


@overload
def stationary_points(law: Law, target: ArrayLike, locked: LockedAt, *, seed: int = ...) -> StationaryPoints: ...
@overload
def stationary_points(law: Law, target: ArrayLike, locked: LockedAnywhere, *, seed: int = ...) -> Curves: ...
@overload
def stationary_points(law: Law, target: ArrayLike, locked: Locked, *, seed: int = ...) -> StationaryPoints | Curves: ...
@check_arguments
def stationary_points(law: Law, target: ArrayLike, locked: Locked, *, seed: int = 0) -> StationaryPoints | Curves:
    """Find the configurations at which the arm can stop while its controller has no information about the locked joints.

    With ``{joint: value}``, the result contains all stationary points that were found for these values of the locked joints:
    solutions, where the target is reached, and erroneous points, where only locked joints are commanded. The search starts from
    random configurations and stops when three waves of 256 starts find no new point. With one joint without a value,
    ``{joint: None}``, the function traces the curves of erroneous points over its value instead; see
    :class:`holdfast.control.equilibria.Curves`.

    The law's speed limit is ignored because it changes no path, and the joint limits because the law does not enforce them.

    Args:
        law: The control law, with its arm, task and gain.
        target: (m,) position, m, for tasks without angular rows; or (4, 4) tool pose.
        locked: Values of one or several joints as ``{joint: value}``, rad or m, by name or index from 0; or one joint without a
            value.
        seed: Seed of the random starts.

    Returns:
        A :class:`holdfast.control.equilibria.StationaryPoints`, or, for a joint without a value, a
        :class:`holdfast.control.equilibria.Curves`.

    Raises:
        InputError: Wrong shapes, joints or values.

    Source: Goel et al. 2005, Theorem 1 as corrected, eq. (18) to (22). The search for all points is ours.
    """
    target_matrix = target_pose(law.task, target)
    lock_values = read_locks(law.arm, locked)
    if list(lock_values.values()) == [None] and law.arm.n > 1:
        with report_work("tracing stationary points") as advance:
            return trace_curves(law, target_matrix, next(iter(lock_values)), seed, report_progress=advance)
    joints, values = locks_with_values(law.arm, lock_values)
    with report_work("looking for stationary points") as report_progress:
        return find_stationary_points(
            RestSystem(law, target_matrix, joints), values, np.random.default_rng(seed), report_progress
        )
