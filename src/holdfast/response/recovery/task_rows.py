"""Solve for configurations of a failed arm that meet chosen rows of a task: all of them, or all except relaxed ones."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from typing import Literal

import casadi as ca
import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kinematics.solvers.inverse_kinematics import damped_step_and_residual, pose_error
from holdfast.model.arm import kinematics
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task

Frame = Literal["base", "tool"]

ROW_TOLERANCE = 1e-6  # tolerance of a row, m and rad; for an arm shorter than 1 m, lengths are scaled by its length
_MAX_STEPS = 60
TILT_ROW = "tilt of tool z"
_UNLIMITED = 1e300  # stands for a missing limit, rad and m, because a loop treats an infinite input as missing
# Weight of a relaxed row while its error is minimised: the other rows deviate by its square only.
_RELAXED_ROW_WEIGHT = 1e-3


@dataclass(frozen=True)
class TaskRows:
    """Rows of a task, which can be relaxed one by one.

    A full pose has the same six rows in any axes. Here its position is along the world's axes and its orientation about the
    tool's, so that "the rotation about the tool's z axis" is one row. Other tasks keep their axes.

    Attributes:
        names: Name of each row, such as ``x`` or ``about tool z``.
        matrix: (k, 6) orthonormal rows of the error (linear; angular), for every row except the tilt.
        linear, angular: Axes of the two parts.
        within: Angle in rad between the tool's z axis and that of a pose up to which the last row, ``tilt of tool z``, is met.
            The error of that row is the angle beyond it, never below 0. None: there is no such row.
    """

    names: tuple[str, ...]
    matrix: FloatArray
    linear: Frame
    angular: Frame
    within: float | None = None

    @classmethod
    def from_task(cls, task: Task, within: float | None = None) -> TaskRows:
        """Return the rows of a task, with the tilt of the tool's z axis as one more row if ``within`` (rad) is given."""
        matrix = np.eye(6) if task.invariant else task.rows
        linear, angular = task.frame, "tool" if task.invariant else task.frame
        names = [_name_row(row, index, linear, angular) for index, row in enumerate(matrix)] + [TILT_ROW] * (within is not None)
        return cls(tuple(names), matrix, "base" if task.invariant else linear, angular, within)

    @property
    def m(self) -> int:
        """Number of rows."""
        return len(self.names)

    @property
    def units(self) -> tuple[str, ...]:
        """Unit ``rad`` of rotational rows, ``m`` of the others."""
        units = tuple("rad" if np.abs(row[:3]).max() == 0 else "m" for row in self.matrix)
        return units + ("rad",) * (self.within is not None)


def _name_row(row: FloatArray, index: int, linear: str, angular: str) -> str:
    nonzero = np.flatnonzero(np.abs(row) > 1e-12)
    frame = "tool " if (linear if nonzero[0] < 3 else angular) == "tool" else ""
    if nonzero.size == 1:
        return f"{'' if nonzero[0] < 3 else 'about '}{frame}{'xyzxyz'[nonzero[0]]}"
    if nonzero.max() < 3 or nonzero.min() >= 3:
        part = row[:3] if nonzero.max() < 3 else row[3:]
        return f"{'along' if nonzero.max() < 3 else 'about'} {frame}({', '.join(f'{entry:.3g}' for entry in part)})"
    return f"row {index + 1}"


def _log_jacobian(phi: SX) -> SX:
    """Return the (3, 3) ``A`` with ``d/dt log(R_d R') = -A(log(R_d R')) w`` for the angular velocity w of R in the world.

    It is the inverse of the right Jacobian of SO(3), ``I + [phi]/2 + c [phi]^2`` with ``t = |phi|`` and
    ``c = 1/t^2 - cot(t/2) / (2 t)``; a textbook formula, checked by finite differences.
    """
    squared_angle = ca.sumsqr(phi)
    is_regular = squared_angle > 1e-8
    angle = ca.sqrt(ca.if_else(is_regular, squared_angle, 1.0))
    factor = ca.if_else(is_regular, 1 / angle**2 - ca.cos(angle / 2) / (2 * angle * ca.sin(angle / 2)), 1 / 12)
    cross = ca.skew(phi)
    return ca.SX.eye(3) + cross / 2 + factor * (cross @ cross)


def _tilt_excess_and_decrease(axis: SX, target_axis: SX, within: float) -> tuple[SX, SX]:
    """Return the angle between unit vectors (3,) beyond ``within`` (rad), and its decrease (1, 3) per angular velocity of axis.

    Both are 0 inside the cone. The solver uses a cone that is narrower by its tolerance, so that a row that it accepts is
    within the angle.
    """
    normal = ca.cross(axis, target_axis)
    squared_sine = ca.sumsqr(normal)
    sine = ca.sqrt(ca.if_else(squared_sine > 1e-24, squared_sine, 1.0))
    excess_angle = ca.atan2(ca.if_else(squared_sine > 1e-24, sine, 0.0), ca.dot(axis, target_axis)) - (within - ROW_TOLERANCE)
    return ca.fmax(excess_angle, 0.0), ca.if_else(excess_angle > 0, 1.0, 0.0) * normal.T / sine


class _TaskRowKernels:
    """Rows of a task as compiled functions of one arm; limits and locks are among their inputs.

    The Jacobian is the exact derivative of the error, even where relaxed rows have large errors.
    """

    def __init__(self, arm: Arm, rows: TaskRows) -> None:
        self.arm, self.rows = arm, rows

    @cached_property
    def _input_and_error_symbols(self) -> tuple[SX, SX, SX, SX, SX]:
        q, position, rotation = kinematics.joint_symbols(self.arm), ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
        return q, position, rotation, *self._error_and_negative_jacobian(q, position, rotation)

    @cached_property
    @cached_kernel
    def solver_loop(self) -> Loop:
        arm = self.arm
        q, position, rotation, error, jacobian = self._input_and_error_symbols
        weights, free = ca.SX.sym("w", self.rows.m), ca.SX.sym("free", arm.n)
        lower, upper = ca.SX.sym("low", arm.n), ca.SX.sym("high", arm.n)
        weighted_jacobian = ca.horzcat(*[weights * jacobian[:, k] * free[k] for k in range(arm.n)])
        next_state, residual = damped_step_and_residual(arm, q, weights * error, weighted_jacobian, (lower, upper))
        inputs = [position, rotation, weights, free, lower, upper]
        return Loop("inverse kinematics of chosen rows", q, inputs, next_state=next_state, residual=residual)

    @cached_property
    @cached_kernel
    def error_kernel(self) -> Kernel:
        q, position, rotation, error, _ = self._input_and_error_symbols
        return Kernel("errors of the rows", [q, position, rotation], [ca.densify(error)])

    def _error_and_negative_jacobian(self, q: SX, position: SX, rotation: SX) -> tuple[SX, SX]:
        """Return the error (m,) of the rows and its negative derivative (m, n)."""
        rows, chain = self.rows, kinematics.kinematic_chain(self.arm, q)
        jacobian = kinematics.chain_jacobian(self.arm, chain, chain.position)
        position_error, linear_jacobian, angular_jacobian = position - chain.position, jacobian[:3, :], jacobian[3:, :]
        inverse_rotation = chain.rotation.T
        errors, jacobians = [position_error], [linear_jacobian]
        if rows.linear == "tool":
            columns = [linear_jacobian[:, k] + ca.cross(angular_jacobian[:, k], position_error) for k in range(self.arm.n)]
            errors, jacobians = [inverse_rotation @ position_error], [inverse_rotation @ ca.horzcat(*columns)]
        if np.abs(rows.matrix[:, 3:]).max() > 0:
            orientation_error = pose_error(chain.position, chain.rotation, position, rotation)[3:]
            # In the tool's axes the error is that of R' R_d, whose derivative is that of the other factor.
            error_jacobian = _log_jacobian(orientation_error) @ angular_jacobian
            if rows.angular == "tool":
                orientation_error = inverse_rotation @ orientation_error
                error_jacobian = _log_jacobian(-orientation_error) @ (inverse_rotation @ angular_jacobian)
            errors.append(orientation_error)
            jacobians.append(error_jacobian)
        matrix = kinematics.constant_matrix(np.ascontiguousarray(rows.matrix[:, : 3 * len(errors)]))
        error, error_jacobian = matrix @ ca.vertcat(*errors), matrix @ ca.vertcat(*jacobians)
        if rows.within is None:
            return error, error_jacobian
        excess_angle, decrease = _tilt_excess_and_decrease(chain.rotation[:, 2], rotation[:, 2], rows.within)
        return ca.vertcat(error, excess_angle), ca.vertcat(error_jacobian, decrease @ angular_jacobian)

    @cached_property
    @cached_kernel
    def jacobian_kernel(self) -> Kernel:
        q, position, rotation, _, jacobian = self._input_and_error_symbols
        return Kernel("slopes of the rows", [q, position, rotation], [ca.densify(-jacobian)])


class RowSolver:
    """Damped least squares on weighted rows with some joints locked; one kernel serves all sets of rows, joints, and limits.

    Attributes:
        arm: Arm with the limits in force.
        rows: Rows of the task.
    """

    def __init__(self, kernels: _TaskRowKernels, arm: Arm) -> None:
        self._kernels, self.arm, self.rows = kernels, arm, kernels.rows
        unit = arm.length_unit
        self._scale = np.where(np.array(self.rows.units) == "m", unit, 1.0)
        self._tolerance = ROW_TOLERANCE / max(unit, 1.0)

    def with_limits(self, limited: Arm) -> RowSolver:
        """Return the solver for the same arm with other limits; nothing is compiled again."""
        return RowSolver(self._kernels, limited)

    def compute_errors(self, q: FloatArray, poses: FloatArray) -> FloatArray:
        """Return the signed error (N, m) of every row at q (N, n), m and rad."""
        return self._kernels.error_kernel.rows(q, poses[:, :3, 3], poses[:, :3, :3])

    def is_inside_cone(self, q: FloatArray, pose: FloatArray) -> BoolArray:
        """Return (N,) True where the tool's z axis at q (N, n) is within the angle of a pose's (4, 4), or none is given."""
        if self.rows.within is None:
            return np.ones(len(q), dtype=bool)
        return ~self.find_violated_rows(q, np.repeat(pose[None], len(q), axis=0))[:, -1]

    def compute_jacobian(self, q: FloatArray, pose: FloatArray) -> FloatArray:
        """Return the exact derivative (m, n) of the errors at q (n,) and pose (4, 4), or (N, m, n) at (N, n) and (N, 4, 4)."""
        poses = pose.reshape(-1, 4, 4)
        entries = self._kernels.jacobian_kernel.rows(np.atleast_2d(q), poses[:, :3, 3], poses[:, :3, :3])
        return np.asarray(entries.reshape((*q.shape[:-1], self.rows.m, self.arm.n)))

    def solve(
        self, q: FloatArray, poses: FloatArray, weights: FloatArray, free: BoolArray, max_steps: int = _MAX_STEPS
    ) -> FloatArray:
        """Iterate from q (N, n) with row weights (N, m); joints that are not free (n,) stay locked."""
        count = len(q)
        limits = np.clip([self.arm.lower, self.arm.upper], -_UNLIMITED, _UNLIMITED)
        parameters = np.concatenate(
            [
                poses[:, :3, 3],
                poses[:, :3, :3].reshape(count, 9),
                weights / self._scale,
                *(np.broadcast_to(values, (count, self.arm.n)) for values in (free, *limits)),
            ],
            axis=1,
        )
        return self._kernels.solver_loop.run(q, parameters, (1e-2 * self._tolerance) ** 2, max_steps).state

    def meets_rows(self, q: FloatArray, poses: FloatArray, row_masks: FloatArray, free: BoolArray) -> BoolArray:
        """Return (N,) True where free joints are within limits and the rows with a mask (N, m) above 0 are within tolerance."""
        inside = (((q >= self.arm.lower) & (q <= self.arm.upper)) | ~free).all(axis=1)
        return np.asarray(inside & ~(self.find_violated_rows(q, poses) & (row_masks > 0)).any(axis=1))

    def find_violated_rows(self, q: FloatArray, poses: FloatArray) -> BoolArray:
        """Return (N, m) True for rows whose error at q (N, n) exceeds the tolerance."""
        return np.asarray(~(np.abs(self.compute_errors(q, poses) / self._scale) <= self._tolerance))

    def solve_required_rows(self, q: FloatArray, poses: FloatArray, row_masks: FloatArray, free: BoolArray) -> FloatArray:
        """Solve from q (N, n) the rows with a mask (N, m) above 0, with the least errors of the other rows."""
        if (row_masks == 0).any():
            q = self.solve(q, poses, np.where(row_masks > 0, 1.0, _RELAXED_ROW_WEIGHT), free)
        return self.solve(q, poses, row_masks, free)

    def sample_configurations(self, count: int, q_locked: FloatArray, free: BoolArray, rng: np.random.Generator) -> FloatArray:
        """Sample configurations (count, n) uniformly within the limits; joints that are not free are as in ``q_locked``."""
        lower, upper = sampling_limits(self.arm)
        return np.where(free, rng.uniform(lower, upper, (count, self.arm.n)), q_locked)


@lru_cache(maxsize=16)
def _compile_kernels(
    arm: Arm, matrix: tuple[tuple[float, ...], ...], names: tuple[str, ...], linear: Frame, angular: Frame, within: float | None
) -> _TaskRowKernels:
    return _TaskRowKernels(arm, TaskRows(names, np.array(matrix), linear, angular, within))


def make_row_solver(arm: Arm, task: Task, within: float | None = None) -> RowSolver:
    """Return the solver of an arm and the rows of a task, compiled once."""
    rows = TaskRows.from_task(task, within)
    matrix = tuple(map(tuple, rows.matrix.tolist()))
    return RowSolver(_compile_kernels(arm, matrix, rows.names, rows.linear, rows.angular, within), arm)


def list_subsets(m: int, size: int, excluded_subsets: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Return the sets of ``size`` of m rows that contain none of the sets ``excluded_subsets``."""
    excluded_sets = [set(excluded) for excluded in excluded_subsets]
    subsets = combinations(range(m), size)
    return [subset for subset in subsets if not any(excluded <= set(subset) for excluded in excluded_sets)]


def relaxed_rows_sort_key(rows: TaskRows, dropped_rows: tuple[int, ...]) -> tuple[int, int, int]:
    """Return the sort key of a set of relaxed rows: few first, then rotations, of these that about the tool's z axis."""
    translation_count = sum(rows.units[index] == "m" for index in dropped_rows)
    is_tool_spin = any(rows.names[index] in ("about tool z", "about z") for index in dropped_rows)
    return len(dropped_rows), translation_count, 0 if is_tool_spin else 1
