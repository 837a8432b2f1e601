"""Reachability of a target after a joint has locked."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.kinematics.solvers.inverse_kinematics import PoseSolutions, solver
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task, target_poses
from holdfast.model.failure_modes import Degraded, LockedValues, read_locks


@check_arguments
@reports_progress("looking for configurations with a locked joint")
def reachable_when_locked(
    arm: Arm,
    target: ArrayLike,
    locked: LockedValues,
    *,
    task: str | Task | Sequence[str] = "pose",
    seed: int = 0,
    restarts: int = 100,
    tolerance: float = 1e-6,
) -> PoseSolutions:
    """Test whether the arm reaches a target with a joint locked at given values, within the limits of the other joints.

    Args:
        arm: Arm model.
        target: (m,) or (N, m) rows of the target tool point, m, for tasks without angular rows; or, for any task, (4, 4) or
            (N, 4, 4) tool poses in the world.
        locked: ``{joint: value}`` of one joint, by name or index from 0, rad or m; or its values (N,). One target combines with
            many values, and one value with many targets. Or a :class:`holdfast.Degraded` of several joints, whose reduced
            ranges apply as well.
        task: Rows of the pose that must be met.
        seed: Seed of the random starts.
        restarts: Maximum number of random starts per row.
        tolerance: Largest error, m and rad.

    Returns:
        A :class:`holdfast.PoseSolutions`; ``success`` is true where the target is reached, with the configuration ``q``.
        Elsewhere none was found, which is no proof: :func:`holdfast.joint_bounds` searches more thoroughly.

    Raises:
        InputError: A shape is wrong, there is no such joint, a value is beyond the joint's limits, or an option is out of
            range.

    Source: Goel et al. 2005: the target stays reachable if and only if the value lies in the range of the joint over the
    self-motion manifold.
    """
    resolved_task = as_task(arm, task)
    joints, angles = _read_lock_values(arm, locked)
    poses, positions = target_poses(resolved_task, target)
    if restarts < 1:
        raise InputError(f"restarts is {restarts}; it must be 1 or more")
    if not 0 < tolerance <= 1:
        raise InputError(f"tolerance is {tolerance:g}; it must be above 0 and at most 1, m and rad")
    for joint, values in zip(joints, angles, strict=True):
        lower, upper = arm.lower[joint], arm.upper[joint]
        beyond = np.atleast_1d(values)[np.atleast_1d((values < lower) | (values > upper))]
        if beyond.size:
            raise InputError(
                f"joint '{arm.joint_names[joint]}' cannot be locked at {beyond[0]:g} {arm.joints[joint].unit}; its limits are "
                f"{lower:g} to {upper:g}"
            )
    single_target = np.ndim(target) == (2 if positions is None else 1)
    counts = {1 if single_target else len(poses), 1 if angles.ndim == 1 else angles.shape[1]} - {1}
    if len(counts) > 1:
        raise InputError(f"there are {len(poses)} targets and {angles.shape[1]} values; give the same number, or one for all")
    count = counts.pop() if counts else 1
    engine = solver(locked.limited if isinstance(locked, Degraded) else arm, resolved_task)
    solutions = engine.solve_locked(
        np.broadcast_to(poses, (count, 4, 4)),
        np.tile(joints, (count, 1)),
        np.ascontiguousarray(np.broadcast_to(angles.T, (count, len(joints)))),
        np.random.SeedSequence(seed),
        restarts,
        engine.scale_tolerance(tolerance),
    )
    if single_target and angles.ndim == 1:
        return solutions.first_row
    return solutions


def _read_lock_values(arm: Arm, locked: LockedValues) -> tuple[IndexArray, FloatArray]:
    """Return the locked joints (k,) and their values (k,), or (1, N) values of one joint."""
    if isinstance(locked, Degraded):
        locked.require_arm(arm)
        return np.flatnonzero(~locked.moves), locked.require_values().lo[~locked.moves]
    if len(locked) != 1:
        raise InputError(f"locked names {len(locked)} joints; give {{joint: value}} of one, or a Degraded of several")
    (joint,) = read_locks(arm, list(locked))
    name = arm.joint_names[joint]
    angles = require_real_numbers(
        next(iter(locked.values())), f"the lock of '{name}'", f"a value, {arm.joints[joint].unit}, or (N,) of them"
    )
    if angles.ndim > 1:
        raise InputError(f"the lock of '{name}' has shape {angles.shape}; give one value, or (N,) of them")
    return np.array([joint]), angles[None]
