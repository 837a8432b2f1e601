"""Batched inverse kinematics: damped least squares from random starts, within the joint limits."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import Any, Literal

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.progress import ProgressCount, reports_progress
from holdfast.core.status import Status, require_ok
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.core.validation import check_arguments
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import damped_least_norm
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kinematics.solvers import joint_space
from holdfast.model.arm import kinematics
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import check_poses
from holdfast.model.arm.task import Task, as_task

Accept = Callable[[FloatArray], BoolArray]

MAX_STEPS = 40  # per start; most successful starts converge within 15
_HALF_TURN_SINE = 1e-6  # sine of a rotation by nearly half a turn
_ZERO_SINE = 1e-9  # sine of a rotation by nearly 0
_ROUNDING_SINE = 1e-15  # sine that is only rounding
_WAVE_ROWS = 8192  # rows of starts that run at once for the remaining poses
_ROW_MULTIPLIER = 2654435761  # odd, so that each row passes through the whole pool of starts
_START_MULTIPLIER = 40503  # odd as well


@dataclass(frozen=True, kw_only=True)
class PoseSolutions:
    """Configurations found for N poses, or for one (without the leading N).

    Attributes:
        q: (N, n) configurations, rad and m, within the limits; the best found if ``status`` is not OK, NaN if the pose is NaN.
        status: (N,) ``OK``, ``NOT_FOUND`` (not found within the budget, which is no proof) or ``BAD_INPUT``.
        position_error: (N,) position error in the task rows, m.
        rotation_error: (N,) orientation error in the task rows, rad; 0 for a task without angular rows.
        restarts: (N,) number of starts used.
    """

    q: FloatArray
    status: NDArray[np.uint8]
    position_error: FloatArray
    rotation_error: FloatArray
    restarts: IndexArray

    @property
    def success(self) -> BoolArray:
        """Flags (N,) of the poses that are reached within tolerance and limits."""
        return np.asarray(self.status == Status.OK)

    @property
    def first_row(self) -> PoseSolutions:
        """Result for the first row, without the leading N."""
        return PoseSolutions(**{field.name: getattr(self, field.name)[0] for field in fields(self)})

    def require_ok(self) -> PoseSolutions:
        """Return the result, or raise :class:`holdfast.HoldfastError`, which names the first row that failed."""
        require_ok(self.status, "inverse kinematics")
        return self


def pose_error(position: SX, rotation: SX, target: SX, target_rotation: SX) -> SX:
    """Return the world-frame error (6,): ``(p_d - p; log(R_d R'))`` with the shortest rotation, up to half a turn.

    At half a turn the shortest rotation changes its direction. At exactly half a turn, where both directions are equally long,
    the rotation is about the axis whose largest component is positive.
    """
    error_rotation = target_rotation @ rotation.T
    skew_vector = _axis_times_sine(error_rotation)
    sine = ca.sqrt(ca.sumsqr(skew_vector))
    cosine = 0.5 * (error_rotation[0, 0] + error_rotation[1, 1] + error_rotation[2, 2] - 1)
    angle = ca.atan2(sine, cosine)
    factor = ca.if_else(sine > _ZERO_SINE, angle / ca.if_else(sine > _ZERO_SINE, sine, 1.0), 1.0)
    # Near half a turn the skew part is too short to give the axis a, but gives its sign. The other part of R,
    # R + R' - 2 cos I = 2 (1 - cos) a a', contains a in every column; the longest column is that of the largest component.
    columns = [error_rotation[:, i] + error_rotation.T[:, i] - 2 * cosine * ca.SX.eye(3)[:, i] for i in range(3)]
    column = ca.if_else(error_rotation[0, 0] >= error_rotation[2, 2], columns[0], columns[2])
    axis = ca.if_else(
        ca.logic_and(error_rotation[1, 1] >= error_rotation[0, 0], error_rotation[1, 1] >= error_rotation[2, 2]),
        columns[1],
        column,
    )
    opposite = ca.logic_and(cosine < 0, sine <= _HALF_TURN_SINE)
    signed_angle = ca.if_else(ca.dot(axis, skew_vector) < 0, -angle, angle)
    rotation_vector = ca.if_else(
        opposite, signed_angle * axis / ca.if_else(opposite, ca.norm_2(axis), 1.0), skew_vector * factor
    )
    return ca.vertcat(target - position, rotation_vector)


def pointing_error(position: SX, rotation: SX, target: SX, target_rotation: SX) -> SX:
    """Return :func:`pose_error` for a task with free rotation about the tool axis: the rotation from z to the target's z.

    If z points exactly opposite, every axis perpendicular to z is equally good, and the tool's x axis is used.
    """
    z, zd = rotation[:, 2], target_rotation[:, 2]
    rotation_axis = ca.cross(z, zd)
    sine, cosine = ca.sqrt(ca.sumsqr(rotation_axis)), ca.dot(z, zd)
    angle = ca.atan2(sine, cosine)
    opposite = ca.logic_and(cosine < 0, sine <= _ROUNDING_SINE)
    has_axis = ca.logic_or(sine > _ZERO_SINE, ca.logic_and(cosine < 0, sine > _ROUNDING_SINE))
    factor = ca.if_else(has_axis, angle / ca.if_else(has_axis, sine, 1.0), 1.0)
    return ca.vertcat(target - position, ca.if_else(opposite, np.pi * rotation[:, 0], rotation_axis * factor))


def _axis_times_sine(r: SX) -> SX:
    """Return the axis times the sine of the angle of a rotation."""
    return 0.5 * ca.vertcat(r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1])


def pose_error_for_task(task: Task, position: SX, rotation: SX, target: SX, target_rotation: SX) -> SX:
    """Return the world-frame error (6,) of the end effector by its shortest rotation, from which a task selects its rows."""
    return (pointing_error if _has_free_tool_rotation(task) else pose_error)(position, rotation, target, target_rotation)


def _has_free_tool_rotation(task: Task) -> bool:
    return task.frame == "tool" and not np.any(task.rows[:, 5])


def task_error_and_jacobian(arm: Arm, task: Task, q: SX, target: SX, target_rotation: SX) -> tuple[SX, SX]:
    """Return the error (m,) of the task's components, in metres and radians, and its Jacobian (m, n).

    Errors of poses are in metres for any characteristic length of the indices.
    """
    chain = kinematics.kinematic_chain(arm, q)
    error = pose_error_for_task(task, chain.position, chain.rotation, target, target_rotation)
    full_jacobian = kinematics.chain_jacobian(arm, chain, chain.position)
    jacobian = ca.horzcat(*[task.error(full_jacobian[:, column], chain.rotation) for column in range(arm.n)])
    return task.error(error, chain.rotation), jacobian


def scaled_error_and_jacobian(arm: Arm, task: Task, q: SX, target: SX, target_rotation: SX) -> tuple[SX, SX]:
    """Return :func:`task_error_and_jacobian` with lengths in units of :attr:`holdfast.Arm.length_unit`, for tolerances."""
    error, jacobian = task_error_and_jacobian(arm, task, q, target, target_rotation)
    scale = ca.sparsify(ca.SX(ca.DM(task.scale(arm.length_unit))))
    return scale @ error, scale @ jacobian


def sine_task_error(arm: Arm, task: Task, q: SX, target: SX, target_rotation: SX) -> SX:
    """Return the error of :func:`task_error_and_jacobian` with sines instead of angles: equal near 0, but differentiable."""
    chain = kinematics.kinematic_chain(arm, q)
    if _has_free_tool_rotation(task):
        rotation_vector = ca.cross(chain.rotation[:, 2], target_rotation[:, 2])
    else:
        rotation_vector = _axis_times_sine(target_rotation @ chain.rotation.T)
    return task.error(ca.vertcat(target - chain.position, rotation_vector), chain.rotation)


def _append_free_joints(poses: FloatArray, joint_count: int, locked: IndexArray) -> FloatArray:
    """Return flat poses (N, 12) and a mask (N, n) that is 0 for the joints ``locked`` (N, k) of each row."""
    is_free = np.ones((len(poses), joint_count))
    is_free[np.arange(len(poses))[:, None], locked] = 0.0
    return np.concatenate([_flatten_poses(poses), is_free], axis=1)


def _flatten_poses(poses: FloatArray) -> FloatArray:
    return np.concatenate([poses[:, :3, 3], poses[:, :3, :3].reshape(len(poses), 9)], axis=1)


class InverseKinematics:
    """Compiled solver of one arm and task.

    One step is damped least squares without the joints that press against a limit: ``dq = A J' (J A J' + lambda I)^-1 e`` with
    ``lambda = 1e-3 |e|^2 + 1e-12``, and the new q is clipped to the limits. Its lengths, and those of every ``tolerance``, are
    in units of :attr:`holdfast.Arm.length_unit`; see :meth:`scale_tolerance`.
    """

    def __init__(self, arm: Arm, task: Task) -> None:
        self.arm, self.task = arm, task
        self._unit = arm.length_unit
        self._low, self._high = sampling_limits(arm)

    @cached_property
    def _symbols(self) -> tuple[SX, SX, SX, SX, SX]:
        q = kinematics.joint_symbols(self.arm)
        position, rotation = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
        return q, position, rotation, *scaled_error_and_jacobian(self.arm, self.task, q, position, rotation)

    @cached_property
    @cached_kernel
    def _damped_step_loop(self) -> Loop:
        q, position, rotation, error, jacobian = self._symbols
        step, residual = damped_step_and_residual(self.arm, q, error, jacobian)
        return Loop("inverse kinematics", q, [position, rotation], next_state=step, residual=residual)

    @cached_property
    @cached_kernel
    def _error_kernel(self) -> Kernel:
        # The rows are orthonormal directions of (linear; angular), so the two parts of the error are their projections.
        q, position, rotation, _, _ = self._symbols
        world_error = ca.SX(ca.DM(self.task.rows)).T @ task_error_and_jacobian(self.arm, self.task, q, position, rotation)[0]
        return Kernel(
            "task error", [q, position, rotation], [ca.vertcat(ca.norm_2(world_error[:3]), ca.norm_2(world_error[3:]))]
        )

    def scale_tolerance(self, tolerance: float) -> float:
        """Return the tolerance that keeps errors within ``tolerance`` m and rad."""
        return tolerance / max(self._unit, 1.0)

    def sample_starts(self, rows: int, generator: np.random.Generator) -> FloatArray:
        """Sample random configurations (rows, n), uniform within the limits."""
        return generator.uniform(self._low, self._high, (rows, self.arm.n))

    def attempt(
        self, q: FloatArray, poses: FloatArray, tolerance: float, fixed_joints: Sequence[int] = ()
    ) -> tuple[FloatArray, BoolArray]:
        """Try one start q (N, n) for each pose; return the ends, and whether each is on the pose and within the limits.

        The joints ``fixed_joints``, by index from 0, do not move.
        """
        parameters, loop = _flatten_poses(poses), self._damped_step_loop
        if fixed_joints:
            locked = np.tile(np.array(fixed_joints, dtype=np.int64), (len(q), 1))
            parameters, loop = _append_free_joints(poses, self.arm.n, locked), self._locked_damped_step_loop
        run = loop.run(q, parameters, tolerance**2, MAX_STEPS)
        return run.state, self.check_solutions(run.state, poses, tolerance)

    @cached_property
    @cached_kernel
    def _locked_damped_step_loop(self) -> Loop:
        q, position, rotation, error, jacobian = self._symbols
        free = ca.SX.sym("free", self.arm.n)
        masked = ca.horzcat(*[jacobian[:, k] * free[k] for k in range(self.arm.n)])
        step, residual = damped_step_and_residual(self.arm, q, error, masked)
        return Loop("inverse kinematics with locked joints", q, [position, rotation, free], next_state=step, residual=residual)

    def solve_locked(
        self,
        poses: FloatArray,
        locked: IndexArray,
        angles: FloatArray,
        seed: np.random.SeedSequence,
        restarts: int,
        tolerance: float,
        accept: Accept | None = None,
    ) -> PoseSolutions:
        """Solve as :meth:`solve`, with joint or joints ``locked[i]`` locked at ``angles[i]`` and values not wrapped."""
        lock_count = locked.shape[1] if locked.ndim > 1 else 1
        locked, angles = locked.reshape(-1, lock_count), angles.reshape(-1, lock_count)  # also for 0 rows
        parameters = _append_free_joints(poses, self.arm.n, locked)
        finite: BoolArray = np.asarray(np.isfinite(parameters).all(axis=1) & np.isfinite(angles).all(axis=1))

        def lock_joints(start: FloatArray, chosen: IndexArray) -> FloatArray:
            start[np.arange(chosen.size)[:, None], locked[chosen]] = angles[chosen]
            return start

        loop = self._locked_damped_step_loop
        q, start_counts = self._solve_with_restarts(
            loop, parameters, np.flatnonzero(finite), seed, restarts, tolerance, lock_joints, accept=accept
        )
        is_locked = (q[np.arange(len(q))[:, None], locked] == angles).all(axis=1)
        return self._check_results(q, poses, tolerance, accept, finite, start_counts, is_locked)

    def is_reachable_with_lock(
        self,
        poses: FloatArray,
        locked: IndexArray,
        angles: FloatArray,
        seed: np.random.SeedSequence,
        restarts: int,
        tolerance: float,
        accept: Accept | None = None,
    ) -> BoolArray:
        """Return (N,) True where a configuration of pose i is found with joint ``locked[i]`` locked at ``angles[i]``.

        False means that none was found in ``restarts`` starts, which is no proof. Poses must be finite.
        """
        return self.solve_locked(poses, locked, angles, seed, restarts, tolerance, accept).success

    def _solve_with_restarts(
        self,
        loop: Loop,
        parameters: FloatArray,
        rows: IndexArray,
        seed: np.random.SeedSequence,
        restarts: int,
        tolerance: float,
        prepare: Callable[[FloatArray, IndexArray], FloatArray],
        first: FloatArray | None = None,
        accept: Accept | None = None,
        steps: int = MAX_STEPS,
    ) -> tuple[FloatArray, IndexArray]:
        """Try starts until each of the chosen rows is solved, and return the configurations (N, n) and starts used (N,).

        Several starts of a row run in parallel once few rows remain. A solution that ``accept`` rejects counts as a failed
        start.

        Start k of row i is one of a pool of random configurations and depends only on i and k: not on the remaining rows, on
        the number of parallel starts, or on the number of rows.
        """
        count, n = len(parameters), self.arm.n
        pool_size = 1 << max(12, (restarts - 1).bit_length())
        pool_of_starts = self.sample_starts(pool_size, np.random.default_rng(seed))
        q, residual = np.full((count, n), np.nan), np.full(count, np.inf)
        start_counts = np.zeros(count, dtype=np.int64)
        unsolved, next_start = rows, 0
        with ProgressCount("starts of each pose", restarts, most=True) as advance:
            while unsolved.size and next_start < restarts:
                # Doubling, because most rows converge early, and starts that run in parallel with a successful one are wasted.
                wave_size = (
                    1 if next_start == 0 else min(restarts - next_start, next_start, max(1, _WAVE_ROWS // unsolved.size))
                )
                start_number = np.repeat(np.arange(next_start, next_start + wave_size), unsolved.size)
                chosen = np.tile(unsolved, wave_size)
                start = pool_of_starts[(chosen * _ROW_MULTIPLIER + start_number * _START_MULTIPLIER) % pool_size]
                if next_start == 0 and first is not None:
                    start = first[unsolved]
                run = loop.run(prepare(start, chosen), parameters[chosen], tolerance**2, steps)
                converged, residuals = run.done, run.residual
                if accept is not None:
                    indices = np.flatnonzero(converged)
                    converged = np.zeros_like(converged)
                    converged[indices] = accept(run.state[indices])
                    residuals = np.where(run.done & ~converged, np.inf, residuals)
                done_by_wave, residuals_by_wave = converged.reshape(wave_size, -1), residuals.reshape(wave_size, -1)
                solved = done_by_wave.any(axis=0)
                # The first start that reached the target, else the one that came closest; NaN never wins.
                best_wave = np.where(
                    solved,
                    done_by_wave.argmax(axis=0),
                    np.where(np.isnan(residuals_by_wave), np.inf, residuals_by_wave).argmin(axis=0),
                )
                column = np.arange(unsolved.size)
                best_residual = residuals_by_wave[best_wave, column]
                start_counts[unsolved] += np.where(solved, best_wave + 1, wave_size)
                is_better = best_residual < residual[unsolved]
                q[unsolved[is_better]] = run.state.reshape(wave_size, unsolved.size, n)[best_wave, column][is_better]
                residual[unsolved[is_better]] = best_residual[is_better]
                unsolved = unsolved[~solved]
                next_start += wave_size
                advance(wave_size)
        return q, start_counts

    def check_solutions(self, q: FloatArray, poses: FloatArray, tolerance: float) -> BoolArray:
        """Return (N,) True where q is on the pose and within the limits."""
        return self._is_reached(q, *self.position_and_rotation_errors(q, poses), tolerance)

    def _is_reached(self, q: FloatArray, position_error: FloatArray, rotation_error: FloatArray, tolerance: float) -> BoolArray:
        inside = ((q >= self.arm.lower) & (q <= self.arm.upper)).all(axis=1)
        return np.asarray(inside & (position_error <= tolerance * self._unit) & (rotation_error <= tolerance))

    def position_and_rotation_errors(self, q: FloatArray, poses: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the position (m) and rotation error (rad) of the task's rows, (N,) each; NaN where q or the pose is NaN."""
        errors = self._error_kernel.rows(q, poses[:, :3, 3], poses[:, :3, :3])
        return errors[:, 0], errors[:, 1]

    def solve(
        self,
        poses: FloatArray,
        seed: np.random.SeedSequence,
        restarts: int,
        tolerance: float,
        first: FloatArray | None = None,
        accept: Accept | None = None,
        steps: int = MAX_STEPS,
    ) -> PoseSolutions:
        """Solve (N, 4, 4) poses; start k of pose i does not depend on the other poses.

        Args:
            poses: (N, 4, 4) poses in the world, m.
            seed: Seed of the starts.
            restarts: Maximum number of starts.
            tolerance: Largest pose error, rad, and lengths in units of the arm's own length.
            first: (N, n) first start of each pose; default: random.
            accept: Function of configurations (K, n) that meet their poses, which returns those to accept (K,); default: all.
            steps: Maximum number of steps from each start.
        """
        parameters = _flatten_poses(poses)
        finite: BoolArray = np.asarray(np.isfinite(parameters).all(axis=1))
        q, start_counts = self._solve_with_restarts(
            self._damped_step_loop,
            parameters,
            np.flatnonzero(finite),
            seed,
            restarts,
            tolerance,
            lambda start, _: start,
            first,
            accept,
            steps,
        )
        return self._check_results(joint_space.wrap_joints(self.arm, q), poses, tolerance, accept, finite, start_counts)

    def _check_results(
        self,
        q: FloatArray,
        poses: FloatArray,
        tolerance: float,
        accept: Accept | None,
        finite: BoolArray,
        restarts: IndexArray,
        is_valid: BoolArray | bool = True,
    ) -> PoseSolutions:
        """Return the result for q (N, n), with a status from the returned configuration, not from a residual."""
        position_error, rotation_error = self.position_and_rotation_errors(q, poses)
        reached = self._is_reached(q, position_error, rotation_error, tolerance) & is_valid
        reached &= True if accept is None else accept(q)
        status = np.where(reached, Status.OK, Status.NOT_FOUND).astype(np.uint8)
        status[~finite] = Status.BAD_INPUT
        return PoseSolutions(
            q=q, status=status, position_error=position_error, rotation_error=rotation_error, restarts=restarts
        )

    def prefer_given_configurations(
        self, reach: PoseSolutions, q: FloatArray, poses: FloatArray, tolerance: float
    ) -> PoseSolutions:
        """Replace the configurations of a result by those of q (N, n) that meet their poses (N, 4, 4) within the limits."""
        position_error, rotation_error = self.position_and_rotation_errors(q, poses)
        is_reached = self._is_reached(q, position_error, rotation_error, tolerance)
        return PoseSolutions(
            q=np.where(is_reached[:, None], q, reach.q),
            status=np.where(is_reached, np.uint8(Status.OK), reach.status),
            position_error=np.where(is_reached, position_error, reach.position_error),
            rotation_error=np.where(is_reached, rotation_error, reach.rotation_error),
            restarts=reach.restarts,
        )


def damped_step_and_residual(arm: Arm, q: SX, e: SX, j: SX, limits: tuple[SX, SX] | None = None) -> tuple[SX, SX]:
    """Return the next q (n,) of :class:`InverseKinematics` from an error (m,) and its Jacobian (m, n), and the squared error.

    The step stays within the limits of the arm, or within ``limits``, two symbols (n,).
    """
    n = arm.n
    bounds = _finite_bounds(arm) if limits is None else [(limits[0][k], limits[1][k]) for k in range(n)]
    square_error = ca.sumsqr(e)
    gradient = [ca.dot(j[:, k], e) for k in range(n)]
    active = []
    for k in range(n):
        # CasADi has no short form of "at the lower limit and pulled below it".
        lower, upper = bounds[k]
        at_lower = ca.SX(0) if lower is None else ca.logic_and(q[k] <= lower, gradient[k] < 0)
        at_upper = ca.SX(0) if upper is None else ca.logic_and(q[k] >= upper, gradient[k] > 0)
        active.append(ca.if_else(ca.logic_or(at_lower, at_upper), 0.0, 1.0))
    masked = ca.horzcat(*[j[:, k] * active[k] for k in range(n)])
    step = damped_least_norm(masked, e, 1e-3 * square_error + 1e-12)
    return _clip_to_bounds(bounds, [q[k] + step[k] for k in range(n)]), square_error


def clip_to_limits(arm: Arm, q: Sequence[SX]) -> SX:
    """Clip joint values (n,) to the limits."""
    return _clip_to_bounds(_finite_bounds(arm), q)


def _finite_bounds(arm: Arm) -> list[tuple[Any, Any]]:
    """Return the limits of each joint, None where there is no limit."""
    ends = zip(arm.lower, arm.upper, strict=True)
    return [
        (lower if kinematics.is_limit_given(lower) else None, upper if kinematics.is_limit_given(upper) else None)
        for lower, upper in ends
    ]


def _clip_to_bounds(bounds: Sequence[tuple[Any, Any]], q: Sequence[SX]) -> SX:
    clipped_values = []
    for value, (lower, upper) in zip(q, bounds, strict=True):
        if lower is not None:
            value = ca.if_else(value < lower, lower, value)
        if upper is not None:
            value = ca.if_else(value > upper, upper, value)
        clipped_values.append(value)
    return ca.vertcat(*clipped_values)


@lru_cache(maxsize=16)
def _cached_solver(arm: Arm, rows: tuple[tuple[float, ...], ...], frame: Literal["base", "tool"]) -> InverseKinematics:
    # The key omits the characteristic length, which has no effect here, because every call makes a new Task.
    return InverseKinematics(arm, Task("task", np.array(rows), frame))


def solver(arm: Arm, task: Task) -> InverseKinematics:
    """Return the inverse kinematics of the model ``arm`` and the ``task``, compiled once."""
    return _cached_solver(arm, tuple(map(tuple, task.rows.tolist())), task.frame)


@check_arguments
@reports_progress("solving inverse kinematics")
def solve_ik(
    arm: Arm,
    poses: ArrayLike,
    seed: int = 0,
    *,
    task: str | Task | Sequence[str] = "pose",
    restarts: int = 100,
    tolerance: float = 1e-6,
    start: ArrayLike | None = None,
) -> PoseSolutions:
    """Find configurations that put the end effector at poses, within the joint limits.

    Args:
        arm: Arm model.
        poses: (4, 4) or (N, 4, 4) tool poses in the world, m; only the task's rows must be met.
        seed: Seed of the random starts; the same seed gives the same result.
        task: Rows of the pose that must be met.
        restarts: Maximum number of random starts per pose.
        tolerance: Largest error, m and rad; for an arm shorter than 1 m the length is reduced in proportion.
        start: (n,) or (N, n) configuration of the first start, rad and m; default: random.

    Returns:
        A :class:`PoseSolutions`. Its status is never OK for a configuration outside the limits or the tolerance.

    Raises:
        InputError: Poses are not 4x4 transforms, or an option is out of range.
    """
    targets = check_poses(poses)
    if restarts < 1:
        raise InputError(f"restarts is {restarts}; it must be 1 or more")
    if not 0 < tolerance <= 1:
        raise InputError(f"tolerance is {tolerance:g}; it must be above 0 and at most 1, m and rad")
    engine = solver(arm, as_task(arm, task))
    first = None
    if start is not None:
        start_configurations = arm.check_configurations(start)
        if start_configurations.ndim == 2 and len(start_configurations) not in (1, len(targets)):
            raise InputError(
                f"start has {len(start_configurations)} configurations for {len(targets)} poses; give one, or one per pose"
            )
        first = np.broadcast_to(start_configurations, (len(targets), arm.n))
        if not np.isfinite(first).all():
            raise InputError("start holds NaN or infinity; give finite joint values")
        first = np.clip(first, arm.lower, arm.upper)
    result = engine.solve(targets, np.random.SeedSequence(seed), restarts, engine.scale_tolerance(tolerance), first)
    if np.ndim(poses) == 2:
        return result.first_row
    return result
