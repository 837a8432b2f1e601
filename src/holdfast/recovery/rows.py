"""Configurations of a failed arm that meet chosen rows of a task: all of them, or all but those that are given up."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from typing import Literal

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.caching import cached_property
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.solvers.inverse_kinematics import damped_step, pose_error

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Frame = Literal["base", "tool"]

TOLERANCE = 1e-6  # m and rad, of every row that is kept; of an arm that is shorter than 1 m, lengths are as much nearer
_STEPS = 60
TILT_ROW = "tilt of tool z"
_FAR = 1e300  # rad and m, for a limit that is not there: a loop takes an infinite input for a missing one
_LIGHT = 1e-3  # weight of a row that is given up while its error is made small: the kept rows yield to it by its square only


@dataclass(frozen=True)
class Rows:
    """The rows of a task, to be given up one by one.

    A full pose is the same six rows in any axes; here its position is along the world's axes and its orientation about the
    tool's, where "the turn about the tool's z axis" is a row. Other tasks keep the axes they have.

    Attributes:
        names: One per row, for people: ``x``, ``about tool z``.
        matrix: (k, 6) orthonormal rows of the error (linear; angular), of every row but the tilt.
        linear, angular: The axes of the two parts.
        within: Angle in rad between the tool's z axis and that of a pose up to which the last row, ``tilt of tool z``, is met.
            The error of that row is the angle beyond it, never below 0. None: there is no such row.
    """

    names: tuple[str, ...]
    matrix: Array
    linear: Frame
    angular: Frame
    within: float | None = None

    @classmethod
    def of(cls, task: Task, within: float | None = None) -> Rows:
        """Return the rows of a task, with the tilt of the tool's z axis as one more row if ``within`` (rad) is given."""
        matrix = np.eye(6) if task.invariant else task.rows
        linear, angular = task.frame, "tool" if task.invariant else task.frame
        names = [_name(row, k, linear, angular) for k, row in enumerate(matrix)] + [TILT_ROW] * (within is not None)
        return cls(tuple(names), matrix, "base" if task.invariant else linear, angular, within)

    @property
    def m(self) -> int:
        """Number of rows."""
        return len(self.names)

    @property
    def units(self) -> tuple[str, ...]:
        """``rad`` of rows that turn, ``m`` of the others."""
        units = tuple("rad" if np.abs(row[:3]).max() == 0 else "m" for row in self.matrix)
        return units + ("rad",) * (self.within is not None)


def _name(row: Array, k: int, linear: str, angular: str) -> str:
    at = np.flatnonzero(np.abs(row) > 1e-12)
    frame = "tool " if (linear if at[0] < 3 else angular) == "tool" else ""
    if at.size == 1:
        return f"{'' if at[0] < 3 else 'about '}{frame}{'xyzxyz'[at[0]]}"
    if at.max() < 3 or at.min() >= 3:
        part = row[:3] if at.max() < 3 else row[3:]
        return f"{'along' if at.max() < 3 else 'about'} {frame}({', '.join(f'{x:.3g}' for x in part)})"
    return f"row {k + 1}"


def _log_slope(phi: SX) -> SX:
    """(3, 3) ``A`` with ``d/dt log(R_d R') = -A(log(R_d R')) w`` for the angular velocity w of R in the world.

    It is the inverse of the right Jacobian of SO(3), ``I + [phi]/2 + c [phi]^2`` with ``t = |phi|`` and
    ``c = 1/t^2 - cot(t/2) / (2 t)``; a textbook formula, checked by finite differences.
    """
    square = ca.sumsqr(phi)
    far = square > 1e-8
    angle = ca.sqrt(ca.if_else(far, square, 1.0))
    factor = ca.if_else(far, 1 / angle**2 - ca.cos(angle / 2) / (2 * angle * ca.sin(angle / 2)), 1 / 12)
    cross = ca.skew(phi)
    return ca.SX.eye(3) + cross / 2 + factor * (cross @ cross)


def _tilt(axis: SX, wanted: SX, within: float) -> tuple[SX, SX]:
    """Return the angle between unit vectors (3,) beyond ``within`` (rad), and its decrease (1, 3) per angular velocity of axis.

    Both are 0 inside the cone. The solver aims at a cone that is narrower by its tolerance, so that what it takes as met is
    within the angle.
    """
    across = ca.cross(axis, wanted)
    square = ca.sumsqr(across)
    size = ca.sqrt(ca.if_else(square > 1e-24, square, 1.0))
    beyond = ca.atan2(ca.if_else(square > 1e-24, size, 0.0), ca.dot(axis, wanted)) - (within - TOLERANCE)
    return ca.fmax(beyond, 0.0), ca.if_else(beyond > 0, 1.0, 0.0) * across.T / size


class _Kernels:
    """The rows of a task as compiled functions of one arm; limits and locks are among their inputs.

    The Jacobian is the exact derivative of the error, also where rows that are given up leave a large one.
    """

    def __init__(self, arm: Arm, rows: Rows) -> None:
        self.arm, self.rows = arm, rows

    @cached_property
    def _symbols(self) -> tuple[SX, SX, SX, SX, SX]:
        q, p, r = kinematics.joint_symbols(self.arm), ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
        return q, p, r, *self._error(q, p, r)

    @cached_property
    @recalled
    def loop(self) -> Loop:
        arm = self.arm
        q, p, r, error, slope = self._symbols
        weights, free = ca.SX.sym("w", self.rows.m), ca.SX.sym("free", arm.n)
        low, high = ca.SX.sym("low", arm.n), ca.SX.sym("high", arm.n)
        pull = ca.horzcat(*[weights * slope[:, k] * free[k] for k in range(arm.n)])
        step, residual = damped_step(arm, q, weights * error, pull, (low, high))
        inputs = [p, r, weights, free, low, high]
        return Loop("inverse kinematics of chosen rows", q, inputs, next_state=step, residual=residual)

    @cached_property
    @recalled
    def errors(self) -> Kernel:
        q, p, r, error, _ = self._symbols
        return Kernel("errors of the rows", [q, p, r], [ca.densify(error)])

    def _error(self, q: SX, p: SX, r: SX) -> tuple[SX, SX]:
        """Error (m,) of the rows and its derivative (m, n), sign turned."""
        rows, chain = self.rows, kinematics.chain(self.arm, q)
        full = kinematics.jacobian_of(self.arm, chain, chain.position)
        away, linear, spin = p - chain.position, full[:3, :], full[3:, :]
        back = chain.rotation.T
        parts, slopes = [away], [linear]
        if rows.linear == "tool":
            turned = [linear[:, k] + ca.cross(spin[:, k], away) for k in range(self.arm.n)]
            parts, slopes = [back @ away], [back @ ca.horzcat(*turned)]
        if np.abs(rows.matrix[:, 3:]).max() > 0:
            turn = pose_error(chain.position, chain.rotation, p, r)[3:]
            # In the tool's axes the error is that of R' R_d, whose derivative is that of the other side.
            slope = _log_slope(turn) @ spin
            if rows.angular == "tool":
                turn = back @ turn
                slope = _log_slope(-turn) @ (back @ spin)
            parts.append(turn)
            slopes.append(slope)
        matrix = kinematics.constant(np.ascontiguousarray(rows.matrix[:, : 3 * len(parts)]))
        error, slope = matrix @ ca.vertcat(*parts), matrix @ ca.vertcat(*slopes)
        if rows.within is None:
            return error, slope
        beyond, decrease = _tilt(chain.rotation[:, 2], r[:, 2], rows.within)
        return ca.vertcat(error, beyond), ca.vertcat(slope, decrease @ spin)

    @cached_property
    @recalled
    def slopes(self) -> Kernel:
        q, p, r, _, slope = self._symbols
        return Kernel("slopes of the rows", [q, p, r], [ca.densify(-slope)])


class RowSolver:
    """Damped least squares on weighted rows with some joints locked: one kernel for every set of rows, joints and limits.

    Attributes:
        arm: The arm, with the limits in force.
        rows: The rows.
    """

    def __init__(self, kernels: _Kernels, arm: Arm) -> None:
        self._kernels, self.arm, self.rows = kernels, arm, kernels.rows
        unit = arm.length_unit
        self._scale = np.where(np.array(self.rows.units) == "m", unit, 1.0)
        self._tolerance = TOLERANCE / max(unit, 1.0)

    def within(self, limited: Arm) -> RowSolver:
        """The same for the same arm with other limits; nothing is compiled again."""
        return RowSolver(self._kernels, limited)

    def errors(self, q: Array, poses: Array) -> Array:
        """Signed error (N, m) of every row at q (N, n), m and rad."""
        return self._kernels.errors.rows(q, poses[:, :3, 3], poses[:, :3, :3])

    def inside_cone(self, q: Array, pose: Array) -> Flags:
        """(N,) True where the tool's z axis at q (N, n) is within the angle of that of a pose (4, 4), or none is given."""
        if self.rows.within is None:
            return np.ones(len(q), dtype=bool)
        return ~self.find_violated_rows(q, np.repeat(pose[None], len(q), axis=0))[:, -1]

    def slopes(self, q: Array, pose: Array) -> Array:
        """Exact derivative (m, n) of :meth:`errors` at q (n,) and pose (4, 4), or (N, m, n) at (N, n) and (N, 4, 4)."""
        poses = pose.reshape(-1, 4, 4)
        flat = self._kernels.slopes.rows(np.atleast_2d(q), poses[:, :3, 3], poses[:, :3, :3])
        return np.asarray(flat.reshape((*q.shape[:-1], self.rows.m, self.arm.n)))

    def run(self, q: Array, poses: Array, weights: Array, free: Flags, steps: int = _STEPS) -> Array:
        """Where starts q (N, n) lead with row weights (N, m), joints that are not free (n,) locked."""
        count = len(q)
        limits = np.clip([self.arm.lower, self.arm.upper], -_FAR, _FAR)
        parameters = np.concatenate(
            [
                poses[:, :3, 3],
                poses[:, :3, :3].reshape(count, 9),
                weights / self._scale,
                *(np.broadcast_to(x, (count, self.arm.n)) for x in (free, *limits)),
            ],
            axis=1,
        )
        return self._kernels.loop.run(q, parameters, (1e-2 * self._tolerance) ** 2, steps).state

    def meets(self, q: Array, poses: Array, kept: Array, free: Flags) -> Flags:
        """(N,) True where the joints that are free keep their limits and the rows kept (N, m) above 0 are within tolerance."""
        inside = (((q >= self.arm.lower) & (q <= self.arm.upper)) | ~free).all(axis=1)
        return np.asarray(inside & ~(self.find_violated_rows(q, poses) & (kept > 0)).any(axis=1))

    def find_violated_rows(self, q: Array, poses: Array) -> Flags:
        """Return (N, m) True for rows whose error at q (N, n) exceeds the tolerance."""
        return np.asarray(~(np.abs(self.errors(q, poses) / self._scale) <= self._tolerance))

    def nearest(self, q: Array, poses: Array, kept: Array, free: Flags) -> Array:
        """From starts q (N, n): the rows kept (N, m) met, and of the others as little error as possible."""
        if (kept == 0).any():
            q = self.run(q, poses, np.where(kept > 0, 1.0, _LIGHT), free)
        return self.run(q, poses, kept, free)

    def starts(self, count: int, at: Array, free: Flags, rng: np.random.Generator) -> Array:
        """Random configurations (count, n), uniform within the limits, joints that are not free as in ``at``."""
        low, high = finite_limits(self.arm)
        return np.where(free, rng.uniform(low, high, (count, self.arm.n)), at)


@lru_cache(maxsize=16)
def _kernels(
    arm: Arm,
    matrix: tuple[tuple[float, ...], ...],
    names: tuple[str, ...],
    linear: Frame,
    angular: Frame,
    within: float | None,
) -> _Kernels:
    return _Kernels(arm, Rows(names, np.array(matrix), linear, angular, within))


def row_solver(arm: Arm, task: Task, within: float | None = None) -> RowSolver:
    """Return the solver of an arm and the rows of :meth:`Rows.of`, compiled once."""
    rows = Rows.of(task, within)
    matrix = tuple(map(tuple, rows.matrix.tolist()))
    return RowSolver(_kernels(arm, matrix, rows.names, rows.linear, rows.angular, within), arm)


def subsets(m: int, size: int, without: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Sets of ``size`` of m rows that contain none of the sets ``without``."""
    return [s for s in combinations(range(m), size) if not any(set(w) <= set(s) for w in without)]


def preferred(rows: Rows, given_up: tuple[int, ...]) -> tuple[int, int, int]:
    """Sorts sets of rows to give up: few first, then those that turn, of these the turn about the tool's z axis."""
    lengths = sum(rows.units[k] == "m" for k in given_up)
    spin = any(rows.names[k] in ("about tool z", "about z") for k in given_up)
    return len(given_up), lengths, 0 if spin else 1
