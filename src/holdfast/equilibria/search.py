"""Looking for stationary points of a failed arm: at given values of the locked joints, or curves over the value of one."""

from __future__ import annotations

from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from holdfast.arguments import checked
from holdfast.arm.task import target_pose
from holdfast.control.law import Law
from holdfast.equilibria.curves import Curves
from holdfast.equilibria.points import Joints, StationaryPoints, read_joints, read_values, search
from holdfast.equilibria.system import RestSystem
from holdfast.equilibria.tracing import trace
from holdfast.errors import InputError
from holdfast.notice import working


@overload
def stationary_points(law: Law, target: ArrayLike, locked: Joints, *, at: ArrayLike, seed: int = ...) -> StationaryPoints: ...
@overload
def stationary_points(law: Law, target: ArrayLike, locked: Joints, *, at: None = ..., seed: int = ...) -> Curves: ...
@checked
def stationary_points(
    law: Law, target: ArrayLike, locked: Joints, *, at: ArrayLike | None = None, seed: int = 0
) -> StationaryPoints | Curves:
    """Where the arm can stop while its controller does not know that joints have locked.

    With ``at``, all stationary points that were found for these values of the locked joints: solutions, where the target is
    reached, and erroneous ones, where only locked joints are commanded. They are looked for from random starts, until three
    waves of 256 starts bring nothing new. Without it, for one locked joint, the curves that the erroneous points make as that
    joint's value changes are traced; see :class:`holdfast.equilibria.Curves`.

    The speed limit of the law is left out, as it changes no path, and so are the joint limits, which the law does not heed.

    Args:
        law: The control law, with its arm, task and gain.
        target: (m,) for tasks without angular rows, or a tool pose (4, 4).
        locked: A joint by name or index from 0, or several.
        at: Value of each, rad (or m).
        seed: Of the starts.

    Returns:
        :class:`holdfast.equilibria.StationaryPoints`, or :class:`holdfast.equilibria.Curves` without ``at``.

    Raises:
        InputError: Wrong shapes, joints or values.

    Source: Goel et al. 2005, Theorem 1 as corrected, eq. (18) to (22). Looking for all points is ours.
    """
    joints = read_joints(law.arm, locked)
    pose = target_pose(law.task, target)
    if at is None:
        if len(joints) != 1:
            raise InputError(f"locked names {len(joints)} joints; curves over the locked value are those of one, or give at")
        with working("tracing stationary points") as advance:
            return trace(law, pose, joints[0], seed, advance=advance)
    values = read_values(joints, at)
    with working("looking for stationary points") as advance:
        return search(RestSystem(law, pose, joints), values, np.random.default_rng(seed), advance)
