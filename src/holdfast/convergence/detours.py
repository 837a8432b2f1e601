"""What a control law costs the healthy arm: detours, slants and delays on the way to a target."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.poses import check_poses
from holdfast.caching import cached_property
from holdfast.control.law import Law
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled
from holdfast.simulation.closed_loop import CYCLE_LIMIT, simulate
from holdfast.simulation.runs import Reason
from holdfast.simulation.system import own_units, prescribed_way
from holdfast.solvers.inverse_kinematics import task_error

Array = NDArray[np.float64]

NEAR = 1e-3  # rad, and of the arm's own length: this near to the target counts as reached
HORIZON, SAMPLES = 40.0, 64  # 1/Ke; samples of a motion, closer to each other at its start


@dataclass(frozen=True, eq=False)
class HealthyCost:
    """N motions of the healthy arm under one law.

    Attributes:
        deviation: (N,) largest distance of the tool point from the straight line between start and target, m; of the
            directions that the task prescribes.
        angle: (N,) largest angle between the task's velocity and the one commanded while the error is above 1e-3
            (rad, and of the arm's own length, its links end to end rounded to a power of two), rad.
        time: (N,) until the error is below that, s; in cycles, until the run ended. NaN: never.
    """

    deviation: Array
    angle: Array
    time: Array


def healthy_cost(law: Law, q0: Array, target: Array, cycles: bool, radius: float) -> HealthyCost:
    """Follow N motions, (N, n) to (N, 4, 4), of the healthy arm, looked at piece by piece.

    What is between two samples is not seen: 64 samples over 40/Ke, the first 0.01/Ke and the last 1.3/Ke apart.
    """
    share = np.linspace(0, 1, SAMPLES + 1) ** 2
    until = np.unique(np.ceil(CYCLE_LIMIT / 4 * share)) if cycles else HORIZON / law.gain * share
    q, now, on = q0, np.zeros(len(q0)), np.arange(len(q0))
    configurations, times = [q0], [now]
    for step in np.diff(until):
        if on.size:
            runs = simulate(law, q[on], target[on], cycles=cycles, time_limit=float(step), radius=radius)
            q, now = q.copy(), now.copy()
            # A run that has ended in a singularity stays there: NaN would spoil what came before.
            q[on] = np.where(np.isfinite(runs.q_final), runs.q_final, q[on])
            now[on] += np.nan_to_num(runs.time)
            # So does one whose steps shrink to nothing: each of the pieces would take all the steps that there are.
            on = on[~np.isin(runs.reason, (Reason.STEPS, Reason.HALF_TURN))]
        configurations.append(q)
        times.append(now)
    look = _Look(law)
    size, scaled, gap, angle = look(np.array(configurations), check_poses(target))
    time, far = np.array(times), scaled > NEAR
    return HealthyCost(
        deviation=_off_the_line(gap),
        angle=np.where(far & np.isfinite(angle), angle, 0.0).max(axis=0),
        time=_arrival(size, time, radius) if cycles else _arrival(scaled, time, NEAR),
    )


class _Look:
    """Errors of configurations at targets, and how slanted the law's answer is."""

    def __init__(self, law: Law) -> None:
        self._law = law

    @cached_property
    @recalled
    def _error(self) -> Kernel:
        arm = self._law.arm
        q, p, r = kinematics.joint_symbols(arm), ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
        return Kernel("error of the task", [q, p, r], [task_error(arm, self._law.task, q, p, r)[0]])

    def __call__(self, q: Array, poses: Array) -> tuple[Array, Array, Array, Array]:
        """Errors (K, N), and with lengths in the arm's own unit; what is left of the way (K, N, 3); angles (K, N)."""
        samples, count, n = q.shape
        rows, every = q.reshape(-1, n), np.tile(poses, (samples, 1, 1))
        error = self._error.rows(rows, every[:, :3, 3], every[:, :3, :3]).reshape(len(rows), -1)
        hand = self._law.arm.forward_kinematics(rows)
        gap = prescribed_way(self._law, hand, every)
        angle = self._law.healthy_angle(rows, error)
        size = np.linalg.norm(error, axis=1)
        scaled = own_units(self._law, size, hand, every)
        shape = samples, count
        return size.reshape(shape), scaled.reshape(shape), gap.reshape(*shape, 3), angle.reshape(shape)


def _off_the_line(gap: Array) -> Array:
    """(N,) largest distance from the segment between the first point and the target, of what is left to go (K, N, 3)."""
    whole = gap[0]
    square = np.maximum((whole**2).sum(axis=1), 1e-30)
    left = np.clip((gap * whole).sum(axis=2) / square, 0.0, 1.0)
    return np.asarray(np.linalg.norm(gap - left[:, :, None] * whole, axis=2).max(axis=0))


def _arrival(size: Array, time: Array, near: float) -> Array:
    """(N,) when the error (K, N) falls below ``near`` for good: between samples it falls exponentially."""
    inside = size <= near
    last = np.where(inside.all(axis=0), 0, len(size) - np.argmax(~inside[::-1], axis=0))  # first sample that stays inside
    found = np.full(size.shape[1], np.nan)
    for k in np.flatnonzero(last < len(size)):
        i = last[k]
        if i == 0:
            found[k] = 0.0
            continue
        a, b = np.log(np.maximum(size[i - 1 : i + 1, k], 1e-300))
        part = (a - np.log(near)) / (a - b) if a > b else 1.0
        found[k] = time[i - 1, k] + part * (time[i, k] - time[i - 1, k])
    return found
