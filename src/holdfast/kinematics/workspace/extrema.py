"""Critical points of a joint on the self-motion manifold of a target: equations (8) and (9)."""

from __future__ import annotations

from functools import lru_cache
from typing import Literal

import casadi as ca
import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kinematics.solvers.inverse_kinematics import scaled_error_and_jacobian, solver
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task

CRITICAL_POINT_TOLERANCE = 1e-10  # of the target, rad and in units of the arm's length, and of the rank condition
_MAX_EXTREMUM_STEPS = 80
_CHUNK_ROWS = 4096  # rows whose matrices are in memory at once


class CriticalPoints:
    """Newton's method for (8) ``f(q) = x`` and (9), for one arm and task.

    (9) ``n_j(i) = 0`` for every null vector means that joint i takes no part in any self-motion, so ``rank(iJ) < m``: there is
    a unit vector u with ``j_k' u = 0`` for every joint k except i. In (q, u) these are n + m equations for n + m unknowns, for
    any n - m. A joint that rests on a limit adds its column to the excluded ones, and its value to the locked joints. If J
    itself loses rank, the equations hold as well, and the manifold may end or cross itself there.
    """

    def __init__(self, arm: Arm, task: Task) -> None:
        self.arm, self.task, self.m = arm, task, task.m
        self.engine = solver(arm, task)

    @cached_property
    @cached_kernel
    def _kernel(self) -> Kernel:
        arm, task = self.arm, self.task
        q = kinematics.joint_symbols(arm)
        position, rotation, multipliers = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3), ca.SX.sym("u", task.m)
        error, jacobian = scaled_error_and_jacobian(arm, task, q, position, rotation)
        gradient = jacobian.T @ multipliers
        residual = ca.vertcat(error, gradient, ca.sumsqr(multipliers) - 1)
        # On the target the derivative of the error is -J, and the steps converge to the target.
        derivative = ca.vertcat(
            ca.horzcat(-jacobian, ca.SX(task.m, task.m)),
            ca.horzcat(ca.jacobian(gradient, q), jacobian.T),
            ca.horzcat(ca.SX(1, arm.n), 2 * multipliers.T),
        )
        outputs = ca.densify(ca.vertcat(residual, ca.vec(derivative.T)))
        return Kernel("critical points", [q, multipliers, position, rotation], [outputs])

    def find_seeds(self, pose: FloatArray, count: int, generator: np.random.Generator) -> FloatArray:
        """Find configurations (S, n) of the pose from ``count`` random starts, S of which converge."""
        starts = self.engine.sample_starts(count, generator)
        q, converged = self.engine.attempt(starts, np.broadcast_to(pose, (count, 4, 4)), CRITICAL_POINT_TOLERANCE)
        return q[converged]

    def solve(self, pose: FloatArray, q: FloatArray, joint: IndexArray, fixed: BoolArray) -> tuple[FloatArray, BoolArray]:
        """Find critical points of ``joint`` (B,) from starts q (B, n), with the joints ``fixed`` (B, n) at their values.

        Returns:
            End of each start, and whether it is a critical point within the limits.
        """
        chunks = [slice(start, start + _CHUNK_ROWS) for start in range(0, len(q), _CHUNK_ROWS)]
        parts = [self._solve_chunk(pose, q[chunk], joint[chunk], fixed[chunk]) for chunk in chunks]
        if not parts:
            return q, np.zeros(0, dtype=bool)
        return np.concatenate([part[0] for part in parts]), np.concatenate([part[1] for part in parts])

    def _solve_chunk(
        self, pose: FloatArray, q: FloatArray, joint: IndexArray, fixed: BoolArray
    ) -> tuple[FloatArray, BoolArray]:
        n, m, count = self.arm.n, self.m, len(q)
        is_constrained = ~fixed  # whose columns must be perpendicular to u
        is_constrained[np.arange(count), joint] = False
        jacobian = -self._residual_and_jacobian(pose, q, np.zeros((count, m)))[1][:, :m, :n]
        reduced = np.where(np.isfinite(jacobian), jacobian, 0.0) * is_constrained[:, None, :]
        unknowns = np.concatenate([q, np.linalg.svd(reduced)[0][:, :, -1]], axis=1)
        is_free = np.concatenate([~fixed, np.ones((count, m), dtype=bool)], axis=1)
        done = np.zeros(count, dtype=bool)
        active = np.arange(count)
        for _ in track("steps of Newton's method", range(_MAX_EXTREMUM_STEPS), most=True):
            residual, derivative = self._residual_and_jacobian(pose, unknowns[active, :n], unknowns[active, n:])
            residual[:, m : m + n] *= is_constrained[active]
            has_converged = np.abs(residual).max(axis=1) <= CRITICAL_POINT_TOLERANCE
            done[active[has_converged]] = True
            # A start that reaches a point where the equations are not defined (NaN) is dropped.
            continues = ~has_converged & np.isfinite(residual).all(axis=1) & np.isfinite(derivative).all(axis=(1, 2))
            active, residual, derivative = active[continues], residual[continues], derivative[continues]
            if not active.size:
                break
            derivative[:, m : m + n] *= is_constrained[active][:, :, None]
            derivative *= is_free[active][:, None, :]
            damping = 1e-3 * np.minimum((residual**2).sum(axis=1), 1.0) + 1e-13
            normal = derivative.transpose(0, 2, 1) @ derivative + damping[:, None, None] * np.eye(n + m)
            step = np.linalg.solve(normal, (derivative.transpose(0, 2, 1) @ residual[:, :, None]))[:, :, 0]
            step_norm = np.linalg.norm(step, axis=1, keepdims=True)
            unknowns[active] -= step * np.minimum(1.0, 0.5 / np.maximum(step_norm, 1e-300))
        points = unknowns[:, :n]
        inside = ((points >= self.arm.lower - 1e-9) & (points <= self.arm.upper + 1e-9)).all(axis=1)
        return points, done & inside

    def _residual_and_jacobian(self, pose: FloatArray, q: FloatArray, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        outputs = self._kernel.rows(q, u, pose[:3, 3], pose[:3, :3])
        size = self.m + self.arm.n + 1
        return outputs[:, :size].copy(), outputs[:, size:].reshape(len(q), size, self.arm.n + self.m)


@lru_cache(maxsize=16)
def _cached_critical_points(arm: Arm, rows: tuple[tuple[float, ...], ...], frame: Literal["base", "tool"]) -> CriticalPoints:
    return CriticalPoints(arm, Task("task", np.array(rows), frame))


def critical_point_solver(arm: Arm, task: Task) -> CriticalPoints:
    """Return the solver of an arm and task, compiled once."""
    return _cached_critical_points(arm, tuple(map(tuple, task.rows.tolist())), task.frame)
