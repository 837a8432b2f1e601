"""A law integrated along a path, step by step: the end effector is sent to where the path is at the end of each."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.errors import HoldfastError
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled
from holdfast.motion.nearness import ROWS, Room
from holdfast.motion.resolution import Resolution
from holdfast.notice import Count
from holdfast.paths.timed_path import TimedPath
from holdfast.solvers.inverse_kinematics import clipped, tool_error

Array = NDArray[np.float64]

_SETTLING = 400  # steps before the first
_CATCH_UP = 3.0  # times the largest twist of the path
_KEPT = 1e-9  # m/s: a limit broken by less is kept
_BLOCK = 500  # steps after which somebody is told of them


def integrate(
    law: Resolution, path: TimedPath, start: Array, count: int, step: float, limits: bool, settle: bool, room: Room | None
) -> tuple[Array, Array, Array]:
    """Joints (N + 1, n), rates (N + 1, n) and shares (N + 1, 3) at N steps and the end: see :class:`holdfast.motion.Rates`.

    In each step the end effector is sent to where the path is at its end, so that errors do not add up.
    """
    # An end effector that limits kept off its path comes back to it at a few times the speed of the path, not within one step.
    fastest = float(np.linalg.norm(path.twist((np.arange(count) + 0.5) * step), axis=1).max())
    kernel = _step_kernel(law, step, limits, _CATCH_UP * fastest * step, room is not None)
    if settle:  # what a search left open would be made up for at once, with rates that no motion needs
        start = _run(kernel, start, np.broadcast_to(path.pose(0.0), (_SETTLING, 4, 4)), step, room)[0][-1]
    joints, rates, shares = _run(kernel, start, path.pose(np.arange(1, count + 1) * step), step, room)
    n = law.arm.n
    limit = [] if room is None else [room.limits(joints[-1])[:ROWS].ravel()]
    last = kernel.rows(joints[-1], np.zeros(3), np.eye(3), path.twist(path.duration), 1.0, *limit)[0]
    return joints, np.vstack([rates, last[n : 2 * n]]), np.vstack([shares, last[2 * n :]])


def _run(kernel: Kernel, start: Array, targets: Array, step: float, room: Room | None) -> tuple[Array, Array, Array]:
    """Joints (N + 1, n), rates (N, n) and shares (N, 3) from a start (n,) after targets (N, 4, 4)."""
    count, n = len(targets), len(start)
    data = np.concatenate([targets[:, :3, 3], targets[:, :3, :3].reshape(count, 9)], axis=1)[:, :, None]
    columns = np.zeros((n + 19 + (0 if room is None else ROWS * (n + 1)), kernel.lanes))
    out = np.zeros((2 * n + 3, kernel.lanes))
    once, steps = kernel.bound(columns, out), np.empty((count, len(out)))
    columns[:n] = start[:, None]
    with Count("steps of the motion", count) as tell:
        for first in range(0, count, _BLOCK):
            last = min(first + _BLOCK, count)
            for k in range(first, last):
                columns[n : n + 12] = data[k]
                if room is not None:
                    columns[n + 19 :] = 0.0  # slopes of 0 limit nothing
                once()
                steps[k] = out[:, 0]
                if room is not None and not room.idle(columns[:n, 0], steps[k, n : 2 * n]):
                    keep_limits(once, columns, out, room.limits(columns[:n, 0]))
                    steps[k] = _cut(out[:, 0], columns[:n, 0], room)
                columns[:n] = steps[k, :n, None]
            tell(last - first)
    broken = ~np.isfinite(steps).all(axis=1)
    if broken.any():
        raise HoldfastError(
            f"the motion breaks down at {broken.argmax() * step:.4g} s: the arm is exactly singular there; start elsewhere"
        )
    return np.vstack([start, steps[:, :n]]), steps[:, n : 2 * n], steps[:, 2 * n :]


def keep_limits(once: Callable[[], None], columns: Array, out: Array, limits: Array) -> None:
    """The step that keeps the first two limits (K, n + 1), or where others are broken by it the one of a pair that keeps all.

    What is best under two limits and keeps the others is best under all of them. Self-motion of one or two dimensions is
    bounded by no more than two at a time.

    Args:
        once: Computes ``out`` from ``columns``.
        columns: The inputs of the step; the last rows are two limits.
        out: What it gives: the next configuration, rates (n,), shares.
        limits: What is to be kept.
    """
    n = limits.shape[1] - 1
    first: Array | None = None
    for pair in combinations(range(len(limits)), ROWS):
        columns[-ROWS * (n + 1) :] = limits[list(pair)].reshape(-1, 1)
        once()
        lack = limits[:, n] - limits[:, :n] @ out[n : 2 * n, 0]
        # Where the first two themselves cannot be kept the end effector is slowed already, and nothing else is tried.
        if lack.max() <= _KEPT or (first is None and not (lack[ROWS:] > _KEPT).any()):
            return
        first = out.copy() if first is None else first
    out[:] = first


def _cut(step: Array, q: Array, room: Room) -> Array:
    """A step of the kernel from q (n,), or as much of it as the room allows."""
    n, part = len(q), room.part(q, step[: len(q)])
    if part < 1:
        step = step.copy()
        step[:n] = q + part * (step[:n] - q)
        step[n : 2 * n] *= part
        step[2 * n + 1] *= part
    return step


@recalled
def _step_kernel(law: Resolution, step: float, limits: bool, farthest: float, clear: bool) -> Kernel:
    """From q and a target pose, or a twist if ``given`` is 1, to the next q, the rates to it, and the shares.

    To keep clear of something it takes two slopes (n,), and after each the least that the rates may make of it.
    """
    arm = law.arm
    q, p, r = kinematics.joint_symbols(arm), ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
    twist, given = ca.SX.sym("twist", 6), ca.SX.sym("given")
    chain = kinematics.chain(arm, q)
    error = tool_error(law.task, chain.position, chain.rotation, p, r)
    size = ca.sqrt(ca.sumsqr(law.task.error(error, chain.rotation)) + 1e-30)  # of the rows that are prescribed
    around = [ca.SX.sym("around", ROWS * (arm.n + 1))] if clear else []
    rows = [(part[:-1], part[-1]) for each in around for part in ca.vertsplit(each, arm.n + 1)]
    out = law.expression(q, ca.if_else(given, twist, error * ca.if_else(size > farthest, farthest / size, 1) / step), rows)
    following = q + step * out[: arm.n]
    if limits:
        following = clipped(arm, ca.vertsplit(following))
    return Kernel(f"step of {law.name}", [q, p, r, twist, given, *around], [ca.vertcat(following, out)])
