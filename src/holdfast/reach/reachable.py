"""Whether a target is still within reach when a joint has locked."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, real_numbers
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, target_poses
from holdfast.errors import InputError
from holdfast.failures import Degraded, LockedValues, read_locks
from holdfast.notice import says
from holdfast.solvers.inverse_kinematics import Reach, solver

Array = NDArray[np.float64]


@checked
@says("looking for configurations with a locked joint")
def reachable_when_locked(
    arm: Arm,
    target: ArrayLike,
    locked: LockedValues,
    *,
    task: str | Task | Sequence[str] = "pose",
    seed: int = 0,
    restarts: int = 100,
    tolerance: float = 1e-6,
) -> Reach:
    """Whether the arm reaches a target with a joint locked at given values, within the limits of the others.

    Args:
        arm: The arm.
        target: (m,) or (N, m) for tasks without angular rows: the task's rows of the wanted tool point, m. For any task,
            (4, 4) or (N, 4, 4) tool poses in the world.
        locked: ``{joint: value}`` of one joint, by name or index from 0, rad or m; or its values (N,). One target goes with
            many values, and the other way round. Or a :class:`holdfast.Degraded` of several joints, whose reduced ranges
            count too.
        task: Rows of the pose that matter.
        seed: Of the random starts.
        restarts: Random starts per row before giving up.
        tolerance: Largest error, m and rad.

    Returns:
        A :class:`holdfast.Reach`; ``success`` says where the target is reached, ``q`` in which configuration. Where it is not,
        none was found, which proves nothing: :func:`holdfast.joint_bounds` looks more closely.

    Raises:
        InputError: Wrong shapes, no such joint, a value beyond the joint's limits, or options out of range.

    Source: Goel et al. 2005: the target stays reachable if and only if the value lies in the range of the joint over the
    self-motion manifold.
    """
    rows = as_task(arm, task)
    joints, angles = _locks(arm, locked)
    poses, given = target_poses(rows, target)
    if restarts < 1:
        raise InputError(f"restarts is {restarts}; it must be 1 or more")
    if not 0 < tolerance <= 1:
        raise InputError(f"tolerance is {tolerance:g}; it must be above 0 and at most 1, m and rad")
    for k, values in zip(joints, angles, strict=True):
        low, high = arm.lower[k], arm.upper[k]
        beyond = np.atleast_1d(values)[np.atleast_1d((values < low) | (values > high))]
        if beyond.size:
            raise InputError(
                f"joint '{arm.joint_names[k]}' cannot be locked at {beyond[0]:g} {arm.joints[k].unit}; its limits are "
                f"{low:g} to {high:g}"
            )
    single_target = np.ndim(target) == (2 if given is None else 1)
    counts = {1 if single_target else len(poses), 1 if angles.ndim == 1 else angles.shape[1]} - {1}
    if len(counts) > 1:
        raise InputError(f"there are {len(poses)} targets and {angles.shape[1]} values; give the same number, or one for all")
    size = counts.pop() if counts else 1
    engine = solver(locked.limited if isinstance(locked, Degraded) else arm, rows)
    found = engine.solve_locked(
        np.broadcast_to(poses, (size, 4, 4)),
        np.tile(joints, (size, 1)),
        np.ascontiguousarray(np.broadcast_to(angles.T, (size, len(joints)))),
        np.random.SeedSequence(seed),
        restarts,
        engine.within(tolerance),
    )
    if single_target and angles.ndim == 1:
        return found.first
    return found


def _locks(arm: Arm, locked: LockedValues) -> tuple[NDArray[np.int64], Array]:
    """The locked joints (k,) and where, (k,), or of one joint (1, N) values."""
    if isinstance(locked, Degraded):
        locked.require_arm(arm)
        return np.flatnonzero(~locked.moves), locked.require_values().lo[~locked.moves]
    if len(locked) != 1:
        raise InputError(f"locked names {len(locked)} joints; give {{joint: value}} of one, or a Degraded of several")
    (k,) = read_locks(arm, list(locked))
    name = arm.joint_names[k]
    angles = real_numbers(
        next(iter(locked.values())), f"the lock of '{name}'", f"a value, {arm.joints[k].unit}, or (N,) of them"
    )
    if angles.ndim > 1:
        raise InputError(f"the lock of '{name}' has shape {angles.shape}; give one value, or (N,) of them")
    return np.array([k]), angles[None]
