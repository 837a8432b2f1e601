"""Where a joint turns back on the self-motion manifold of a target: equations (8) and (9)."""

from __future__ import annotations

from functools import lru_cache
from typing import Literal

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.caching import cached_property
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled
from holdfast.notice import each
from holdfast.solvers.inverse_kinematics import scaled_error, solver

Array = NDArray[np.float64]

TOLERANCE = 1e-10  # off the target, rad and in units of the arm's own length, and of the rank condition
_STEPS = 80
_CHUNK = 4096  # rows of which the matrices are held at once


class CriticalPoints:
    """Newton's method for (8) ``f(q) = x`` and (9), of one arm and task.

    (9) ``n_j(i) = 0`` for every null vector says that joint i takes no part in any self-motion, which is
    ``rank(iJ) < m``: there is a unit vector u with ``j_k' u = 0`` for every joint k but i. In (q, u) these are n + m
    equations for n + m unknowns, whatever n - m is; a joint that rests on a limit adds its column to those left out, and its
    value to locked joints. Where J itself loses rank they hold too, and the manifold may end or cross itself there.
    """

    def __init__(self, arm: Arm, task: Task) -> None:
        self.arm, self.task, self.m = arm, task, task.m
        self.engine = solver(arm, task)

    @cached_property
    @recalled
    def _kernel(self) -> Kernel:
        arm, task = self.arm, self.task
        q = kinematics.joint_symbols(arm)
        p, r, u = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3), ca.SX.sym("u", task.m)
        e, j = scaled_error(arm, task, q, p, r)
        across = j.T @ u
        residual = ca.vertcat(e, across, ca.sumsqr(u) - 1)
        # On the target the derivative of the error is -J, and that is where the steps go.
        slope = ca.vertcat(
            ca.horzcat(-j, ca.SX(task.m, task.m)),
            ca.horzcat(ca.jacobian(across, q), j.T),
            ca.horzcat(ca.SX(1, arm.n), 2 * u.T),
        )
        flat = ca.densify(ca.vertcat(residual, ca.vec(slope.T)))
        return Kernel("critical points", [q, u, p, r], [flat])

    def seeds(self, pose: Array, count: int, generator: np.random.Generator) -> Array:
        """Configurations (S, n) of the pose, S of ``count`` random starts."""
        starts = self.engine.starts(count, generator)
        q, ok = self.engine.attempt(starts, np.broadcast_to(pose, (count, 4, 4)), TOLERANCE)
        return q[ok]

    def solve(
        self, pose: Array, q: Array, joint: NDArray[np.int64], held: NDArray[np.bool_]
    ) -> tuple[Array, NDArray[np.bool_]]:
        """From starts q (B, n): critical points of ``joint`` (B,) with the joints ``held`` (B, n) where they are.

        Returns:
            Where each start led, and whether that is a critical point within the limits.
        """
        chunks = [slice(s, s + _CHUNK) for s in range(0, len(q), _CHUNK)]
        parts = [self._solve(pose, q[c], joint[c], held[c]) for c in chunks]
        if not parts:
            return q, np.zeros(0, dtype=bool)
        return np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])

    def _solve(
        self, pose: Array, q: Array, joint: NDArray[np.int64], held: NDArray[np.bool_]
    ) -> tuple[Array, NDArray[np.bool_]]:
        n, m, count = self.arm.n, self.m, len(q)
        bound = ~held  # whose columns must be at right angles to u
        bound[np.arange(count), joint] = False
        j = -self._evaluate(pose, q, np.zeros((count, m)))[1][:, :m, :n]
        reduced = np.where(np.isfinite(j), j, 0.0) * bound[:, None, :]
        x = np.concatenate([q, np.linalg.svd(reduced)[0][:, :, -1]], axis=1)
        keep = np.concatenate([~held, np.ones((count, m), dtype=bool)], axis=1)
        done = np.zeros(count, dtype=bool)
        left = np.arange(count)
        for _ in each("steps of Newton's method", range(_STEPS), most=True):
            residual, slope = self._evaluate(pose, x[left, :n], x[left, n:])
            residual[:, m : m + n] *= bound[left]
            small = np.abs(residual).max(axis=1) <= TOLERANCE
            done[left[small]] = True
            # A start that runs into a place where the equations say nothing (NaN) is dropped.
            on = ~small & np.isfinite(residual).all(axis=1) & np.isfinite(slope).all(axis=(1, 2))
            left, residual, slope = left[on], residual[on], slope[on]
            if not left.size:
                break
            slope[:, m : m + n] *= bound[left][:, :, None]
            slope *= keep[left][:, None, :]
            damping = 1e-3 * np.minimum((residual**2).sum(axis=1), 1.0) + 1e-13
            normal = slope.transpose(0, 2, 1) @ slope + damping[:, None, None] * np.eye(n + m)
            step = np.linalg.solve(normal, (slope.transpose(0, 2, 1) @ residual[:, :, None]))[:, :, 0]
            size = np.linalg.norm(step, axis=1, keepdims=True)
            x[left] -= step * np.minimum(1.0, 0.5 / np.maximum(size, 1e-300))
        found = x[:, :n]
        inside = ((found >= self.arm.lower - 1e-9) & (found <= self.arm.upper + 1e-9)).all(axis=1)
        return found, done & inside

    def _evaluate(self, pose: Array, q: Array, u: Array) -> tuple[Array, Array]:
        out = self._kernel.rows(q, u, pose[:3, 3], pose[:3, :3])
        size = self.m + self.arm.n + 1
        return out[:, :size].copy(), out[:, size:].reshape(len(q), size, self.arm.n + self.m)


@lru_cache(maxsize=16)
def _critical(arm: Arm, rows: tuple[tuple[float, ...], ...], frame: Literal["base", "tool"]) -> CriticalPoints:
    return CriticalPoints(arm, Task("task", np.array(rows), frame))


def critical_points(arm: Arm, task: Task) -> CriticalPoints:
    """The solver of an arm and task, compiled once."""
    return _critical(arm, tuple(map(tuple, task.rows.tolist())), task.frame)
