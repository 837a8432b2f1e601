"""Integration of a resolution law along a path: each step moves the end effector to the pose of the path at its end."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations

import casadi as ca
import numpy as np

from holdfast.core.errors import HoldfastError
from holdfast.core.progress import ProgressCount
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kinematics.path_following.clearance_limits import ENFORCED_LIMITS, ClearanceRateLimit
from holdfast.kinematics.path_following.resolution import Resolution
from holdfast.kinematics.paths.timed_path import TimedPath
from holdfast.kinematics.solvers.inverse_kinematics import clip_to_limits, pose_error_for_task
from holdfast.model.arm import kinematics

_SETTLING_STEPS = 400  # steps before the first one
_CATCH_UP_FACTOR = 3.0  # multiple of the largest twist of the path
_RATE_TOLERANCE = 1e-9  # m/s: a smaller violation of a limit is accepted
_PROGRESS_STEPS = 500  # steps between two reports of progress


def integrate_law(
    law: Resolution,
    path: TimedPath,
    start: FloatArray,
    count: int,
    step: float,
    limits: bool,
    settle: bool,
    rate_limit: ClearanceRateLimit | None,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return joints (N + 1, n), rates (N + 1, n) and fractions (N + 1, 3) at N steps and the end: see
    :class:`holdfast.kinematics.path_following.Rates`.

    Each step moves the end effector to the pose of the path at the end of the step, so that errors do not add up.
    """
    # An end effector that limits held off its path returns at a few times the speed of the path, not within one step.
    max_twist = float(np.linalg.norm(path.twist((np.arange(count) + 0.5) * step), axis=1).max())
    kernel = _step_kernel(law, step, limits, _CATCH_UP_FACTOR * max_twist * step, rate_limit is not None)
    if settle:  # a remaining error of the search would be corrected at once, with rates that no motion needs
        start = _run_steps(kernel, start, np.broadcast_to(path.pose(0.0), (_SETTLING_STEPS, 4, 4)), step, rate_limit)[0][-1]
    joints, rates, fractions = _run_steps(kernel, start, path.pose(np.arange(1, count + 1) * step), step, rate_limit)
    n = law.arm.n
    final_limits = [] if rate_limit is None else [rate_limit.rate_limits(joints[-1])[:ENFORCED_LIMITS].ravel()]
    final_row = kernel.rows(joints[-1], np.zeros(3), np.eye(3), path.twist(path.duration), 1.0, *final_limits)[0]
    return joints, np.vstack([rates, final_row[n : 2 * n]]), np.vstack([fractions, final_row[2 * n :]])


def _run_steps(
    kernel: Kernel, start: FloatArray, targets: FloatArray, step: float, rate_limit: ClearanceRateLimit | None
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return joints (N + 1, n), rates (N, n) and fractions (N, 3) from a start (n,) through targets (N, 4, 4)."""
    count, n = len(targets), len(start)
    target_rows = np.concatenate([targets[:, :3, 3], targets[:, :3, :3].reshape(count, 9)], axis=1)[:, :, None]
    columns = np.zeros((n + 19 + (0 if rate_limit is None else ENFORCED_LIMITS * (n + 1)), kernel.lanes))
    outputs = np.zeros((2 * n + 3, kernel.lanes))
    run_kernel, steps = kernel.bind_arrays(columns, outputs), np.empty((count, len(outputs)))
    columns[:n] = start[:, None]
    with ProgressCount("steps of the motion", count) as advance:
        for first in range(0, count, _PROGRESS_STEPS):
            last = min(first + _PROGRESS_STEPS, count)
            for index in range(first, last):
                columns[n : n + 12] = target_rows[index]
                if rate_limit is not None:
                    columns[n + 19 :] = 0.0  # gradients of 0 limit nothing
                run_kernel()
                steps[index] = outputs[:, 0]
                if rate_limit is not None and not rate_limit.is_inactive(columns[:n, 0], steps[index, n : 2 * n]):
                    enforce_limits(run_kernel, columns, outputs, rate_limit.rate_limits(columns[:n, 0]))
                    steps[index] = _shorten_step(outputs[:, 0], columns[:n, 0], rate_limit)
                columns[:n] = steps[index, :n, None]
            advance(last - first)
    broken = ~np.isfinite(steps).all(axis=1)
    if broken.any():
        raise HoldfastError(
            f"the motion breaks down at {broken.argmax() * step:.4g} s: the arm is exactly singular there; start elsewhere"
        )
    return np.vstack([start, steps[:, :n]]), steps[:, n : 2 * n], steps[:, 2 * n :]


def enforce_limits(run_kernel: Callable[[], None], columns: FloatArray, outputs: FloatArray, limits: FloatArray) -> None:
    """Take the step that respects the first two limits (K, n + 1), or the first pair of limits whose step respects all.

    A step that is best under two limits and respects the others is best under all. No more than two limits at a time bound a
    self-motion of one or two dimensions.

    Args:
        run_kernel: Function that computes ``outputs`` from ``columns``.
        columns: Inputs of the step; the last rows are two limits.
        outputs: Next configuration, rates (n,), and fractions.
        limits: (K, n + 1) limits to respect.
    """
    n = limits.shape[1] - 1
    first_outputs: FloatArray | None = None
    for pair in combinations(range(len(limits)), ENFORCED_LIMITS):
        columns[-ENFORCED_LIMITS * (n + 1) :] = limits[list(pair)].reshape(-1, 1)
        run_kernel()
        shortfall = limits[:, n] - limits[:, :n] @ outputs[n : 2 * n, 0]
        # If the first two limits cannot be respected, the end effector is slowed already and nothing else is tried.
        if shortfall.max() <= _RATE_TOLERANCE or (
            first_outputs is None and not (shortfall[ENFORCED_LIMITS:] > _RATE_TOLERANCE).any()
        ):
            return
        first_outputs = outputs.copy() if first_outputs is None else first_outputs
    outputs[:] = first_outputs


def _shorten_step(step: FloatArray, q: FloatArray, rate_limit: ClearanceRateLimit) -> FloatArray:
    """Return a step of the kernel from q (n,), shortened to the fraction that the clearance allows."""
    n, fraction = len(q), rate_limit.allowed_fraction(q, step[: len(q)])
    if fraction < 1:
        step = step.copy()
        step[:n] = q + fraction * (step[:n] - q)
        step[n : 2 * n] *= fraction
        step[2 * n + 1] *= fraction
    return step


@cached_kernel
def _step_kernel(law: Resolution, step: float, limits: bool, max_error: float, has_clearance: bool) -> Kernel:
    """Build the kernel from q and a target pose (a twist if ``twist_given`` is 1) to the next q, the rates, and the fractions.

    For a clearance it takes two gradients (n,), and after each the least product with the rates.
    """
    arm = law.arm
    q, target_position, target_rotation = kinematics.joint_symbols(arm), ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
    twist, twist_given = ca.SX.sym("twist", 6), ca.SX.sym("given")
    chain = kinematics.kinematic_chain(arm, q)
    error = pose_error_for_task(law.task, chain.position, chain.rotation, target_position, target_rotation)
    error_norm = ca.sqrt(ca.sumsqr(law.task.error(error, chain.rotation)) + 1e-30)  # of the prescribed rows
    clearance_limits = [ca.SX.sym("around", ENFORCED_LIMITS * (arm.n + 1))] if has_clearance else []
    rows = [(row[:-1], row[-1]) for limits_symbol in clearance_limits for row in ca.vertsplit(limits_symbol, arm.n + 1)]
    outputs = law.expression(
        q, ca.if_else(twist_given, twist, error * ca.if_else(error_norm > max_error, max_error / error_norm, 1) / step), rows
    )
    next_q = q + step * outputs[: arm.n]
    if limits:
        next_q = clip_to_limits(arm, ca.vertsplit(next_q))
    return Kernel(
        f"step of {law.name}",
        [q, target_position, target_rotation, twist, twist_given, *clearance_limits],
        [ca.vertcat(next_q, outputs)],
    )
