"""Looking for stationary points of a failed arm: at given values of the locked joints, or curves over the value of one."""

from __future__ import annotations

from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from holdfast.arguments import checked
from holdfast.arm.task import target_pose
from holdfast.control.law import Law
from holdfast.equilibria.curves import Curves
from holdfast.equilibria.points import StationaryPoints, search
from holdfast.equilibria.system import RestSystem
from holdfast.equilibria.tracing import trace
from holdfast.failures import Locked, LockedAnywhere, LockedAt, locks_given, read_locks
from holdfast.notice import working


@overload
def stationary_points(law: Law, target: ArrayLike, locked: LockedAt, *, seed: int = ...) -> StationaryPoints: ...
@overload
def stationary_points(law: Law, target: ArrayLike, locked: LockedAnywhere, *, seed: int = ...) -> Curves: ...
@overload
def stationary_points(law: Law, target: ArrayLike, locked: Locked, *, seed: int = ...) -> StationaryPoints | Curves: ...
@checked
def stationary_points(law: Law, target: ArrayLike, locked: Locked, *, seed: int = 0) -> StationaryPoints | Curves:
    """Where the arm can stop while its controller does not know that joints have locked.

    With ``{joint: value}``, all stationary points that were found for these values of the locked joints: solutions, where the
    target is reached, and erroneous ones, where only locked joints are commanded. They are looked for from random starts, until
    three waves of 256 starts bring nothing new. With one joint and no value, ``{joint: None}``, it may be anywhere: the curves
    that the erroneous points make as its value changes are traced; see :class:`holdfast.equilibria.Curves`.

    The speed limit of the law is left out, as it changes no path, and so are the joint limits, which the law does not heed.

    Args:
        law: The control law, with its arm, task and gain.
        target: (m,) for tasks without angular rows, or a tool pose (4, 4).
        locked: ``{joint: value}``, rad or m, of one joint or several, by name or index from 0; or one joint without a value.
        seed: Of the starts.

    Returns:
        :class:`holdfast.equilibria.StationaryPoints`, or :class:`holdfast.equilibria.Curves` of a joint without a value.

    Raises:
        InputError: Wrong shapes, joints or values.

    Source: Goel et al. 2005, Theorem 1 as corrected, eq. (18) to (22). Looking for all points is ours.
    """
    pose = target_pose(law.task, target)
    locks = read_locks(law.arm, locked)
    if list(locks.values()) == [None] and law.arm.n > 1:
        with working("tracing stationary points") as advance:
            return trace(law, pose, next(iter(locks)), seed, advance=advance)
    joints, values = locks_given(law.arm, locks)
    with working("looking for stationary points") as advance:
        return search(RestSystem(law, pose, joints), values, np.random.default_rng(seed), advance)
