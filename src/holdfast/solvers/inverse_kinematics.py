"""Inverse kinematics of whole batches: damped least squares from random starts, within the joint limits."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import Any, Literal

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm import kinematics
from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.poses import check_poses
from holdfast.arm.task import Task, as_task
from holdfast.caching import cached_property
from holdfast.errors import InputError
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.linalg import damped_least_norm
from holdfast.notice import Count, says
from holdfast.solvers import joint_space
from holdfast.status import Status, require_ok

Array = NDArray[np.float64]
Accept = Callable[[Array], NDArray[np.bool_]]

STEPS = 40  # per start; most starts that reach the target do so within 15
_FLAT, _TINY, _ROUNDING = 1e-6, 1e-9, 1e-15  # sines of half a turn, of no turn, and of which nothing is left but rounding
_WAVE = 8192  # rows of starts that run side by side when poses are left over
_BY_ROW, _BY_START = 2654435761, 40503  # odd numbers: each row walks through the whole pool of starts


@dataclass(frozen=True, kw_only=True)
class Reach:
    """Configurations found for N poses, or for one (then without the leading N).

    Attributes:
        q: (N, n) rad and m, within the limits; the best found where ``status`` is not OK, NaN where the pose is NaN.
        status: (N,) ``OK``, ``NOT_FOUND`` (not found within the budget, which proves nothing) or ``BAD_INPUT``.
        position_error: (N,) m, of the task rows.
        rotation_error: (N,) rad, of the task rows; 0 for a task without angular rows.
        restarts: (N,) starts used.
    """

    q: Array
    status: NDArray[np.uint8]
    position_error: Array
    rotation_error: Array
    restarts: NDArray[np.int64]

    @property
    def success(self) -> NDArray[np.bool_]:
        """(N,) True where the pose is reached within tolerance and limits."""
        return np.asarray(self.status == Status.OK)

    @property
    def first(self) -> Reach:
        """The first row alone, without the leading N."""
        return Reach(**{field.name: getattr(self, field.name)[0] for field in fields(self)})

    def require_ok(self) -> Reach:
        """Itself, or :class:`holdfast.HoldfastError` naming the first row that failed."""
        require_ok(self.status, "inverse kinematics")
        return self


def pose_error(position: SX, rotation: SX, target: SX, target_rotation: SX) -> SX:
    """World-frame error (6,): ``(p_d - p; log(R_d R'))``; the vector part is the shortest turn, up to half a turn.

    There the shortest turn flips from one way to the other. At exactly half a turn, where both ways are as long, it is about
    the axis of which the largest component is positive.
    """
    r = target_rotation @ rotation.T
    skew = _skew_part(r)
    sine, cosine = ca.sqrt(ca.sumsqr(skew)), 0.5 * (r[0, 0] + r[1, 1] + r[2, 2] - 1)
    angle = ca.atan2(sine, cosine)
    factor = ca.if_else(sine > _TINY, angle / ca.if_else(sine > _TINY, sine, 1.0), 1.0)
    # Near half a turn the skew part is too short to give the axis a, but says which way it points. The other part of R,
    # R + R' - 2 cos I = 2 (1 - cos) a a', has it in every column; the longest is that of the largest component.
    columns = [r[:, i] + r.T[:, i] - 2 * cosine * ca.SX.eye(3)[:, i] for i in range(3)]
    first = ca.if_else(r[0, 0] >= r[2, 2], columns[0], columns[2])
    axis = ca.if_else(ca.logic_and(r[1, 1] >= r[0, 0], r[1, 1] >= r[2, 2]), columns[1], first)
    opposite = ca.logic_and(cosine < 0, sine <= _FLAT)
    way = ca.if_else(ca.dot(axis, skew) < 0, -angle, angle)
    turn = ca.if_else(opposite, way * axis / ca.if_else(opposite, ca.norm_2(axis), 1.0), skew * factor)
    return ca.vertcat(target - position, turn)


def pointing_error(position: SX, rotation: SX, target: SX, target_rotation: SX) -> SX:
    """As :func:`pose_error` for a task that leaves the turn about the tool axis free: turns z to the target's z.

    Where z points exactly away from it, every axis across z is as good, and the tool's x axis is taken.
    """
    z, zd = rotation[:, 2], target_rotation[:, 2]
    turn = ca.cross(z, zd)
    sine, cosine = ca.sqrt(ca.sumsqr(turn)), ca.dot(z, zd)
    angle = ca.atan2(sine, cosine)
    opposite = ca.logic_and(cosine < 0, sine <= _ROUNDING)
    known = ca.logic_or(sine > _TINY, ca.logic_and(cosine < 0, sine > _ROUNDING))
    factor = ca.if_else(known, angle / ca.if_else(known, sine, 1.0), 1.0)
    return ca.vertcat(target - position, ca.if_else(opposite, np.pi * rotation[:, 0], turn * factor))


def _skew_part(r: SX) -> SX:
    """Axis times the sine of the angle of a rotation."""
    return 0.5 * ca.vertcat(r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1])


def tool_error(task: Task, position: SX, rotation: SX, target: SX, target_rotation: SX) -> SX:
    """World-frame error (6,) of the end effector, of which a task takes its rows: the shortest turn that a task asks for."""
    return (pointing_error if _free_spin(task) else pose_error)(position, rotation, target, target_rotation)


def _free_spin(task: Task) -> bool:
    return task.frame == "tool" and not np.any(task.rows[:, 5])


def task_error(arm: Arm, task: Task, q: SX, target: SX, target_rotation: SX) -> tuple[SX, SX]:
    """Error (m,) of the task's rows in metres and radians, and their Jacobian (m, n).

    Whatever the characteristic length of the indices, errors of poses are in metres.
    """
    chain = kinematics.chain(arm, q)
    error = tool_error(task, chain.position, chain.rotation, target, target_rotation)
    full = kinematics.jacobian_of(arm, chain, chain.position)
    j = ca.horzcat(*[task.error(full[:, k], chain.rotation) for k in range(arm.n)])
    return task.error(error, chain.rotation), j


def scaled_error(arm: Arm, task: Task, q: SX, target: SX, target_rotation: SX) -> tuple[SX, SX]:
    """As :func:`task_error` with lengths in units of :attr:`holdfast.Arm.length_unit`, for what has a threshold."""
    e, j = task_error(arm, task, q, target, target_rotation)
    scale = ca.sparsify(ca.SX(ca.DM(task.scale(arm.length_unit))))
    return scale @ e, scale @ j


def smooth_error(arm: Arm, task: Task, q: SX, target: SX, target_rotation: SX) -> SX:
    """As the error of :func:`task_error`, with sines in place of angles: the same near 0, but with derivatives."""
    chain = kinematics.chain(arm, q)
    if _free_spin(task):
        turn = ca.cross(chain.rotation[:, 2], target_rotation[:, 2])
    else:
        turn = _skew_part(target_rotation @ chain.rotation.T)
    return task.error(ca.vertcat(target - chain.position, turn), chain.rotation)


def _parameters(poses: Array) -> Array:
    return np.concatenate([poses[:, :3, 3], poses[:, :3, :3].reshape(len(poses), 9)], axis=1)


@dataclass(frozen=True)
class _Found:
    q: Array
    restarts: NDArray[np.int64]


class InverseKinematics:
    """The compiled solver of one arm and task.

    One step is damped least squares with the joints that press against a limit taken out:
    ``dq = A J' (J A J' + lambda I)^-1 e`` with ``lambda = 1e-3 |e|^2 + 1e-12`` and the new q clipped to the limits.
    Lengths in it, and in every ``tolerance``, are in units of :attr:`holdfast.Arm.length_unit`; see :meth:`within`.
    """

    def __init__(self, arm: Arm, task: Task) -> None:
        self.arm, self.task = arm, task
        self._unit = arm.length_unit
        self._low, self._high = finite_limits(arm)

    @cached_property
    def _symbols(self) -> tuple[SX, SX, SX, SX, SX]:
        q = kinematics.joint_symbols(self.arm)
        p, r = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
        return q, p, r, *scaled_error(self.arm, self.task, q, p, r)

    @cached_property
    @recalled
    def _loop(self) -> Loop:
        q, p, r, e, j = self._symbols
        step, residual = damped_step(self.arm, q, e, j)
        return Loop("inverse kinematics", q, [p, r], next_state=step, residual=residual)

    @cached_property
    @recalled
    def _errors(self) -> Kernel:
        # The rows are orthonormal directions of (linear; angular), so the two parts of the error are their projections.
        q, p, r, _, _ = self._symbols
        back = ca.SX(ca.DM(self.task.rows)).T @ task_error(self.arm, self.task, q, p, r)[0]
        return Kernel("task error", [q, p, r], [ca.vertcat(ca.norm_2(back[:3]), ca.norm_2(back[3:]))])

    def within(self, tolerance: float) -> float:
        """The tolerance that keeps errors within so many m and rad."""
        return tolerance / max(self._unit, 1.0)

    def starts(self, rows: int, generator: np.random.Generator) -> Array:
        """Random configurations (rows, n), uniform within the limits."""
        return generator.uniform(self._low, self._high, (rows, self.arm.n))

    def attempt(self, q: Array, poses: Array, tolerance: float, held: Sequence[int] = ()) -> tuple[Array, NDArray[np.bool_]]:
        """One start q (N, n) for each pose: where it led, and whether that is on the pose and within the limits.

        Joints that are ``held``, by index from 0, stay where they are.
        """
        parameters, loop = _parameters(poses), self._loop_with_locks if held else self._loop
        if held:
            free = np.ones((len(q), self.arm.n))
            free[:, held] = 0.0
            parameters = np.concatenate([parameters, free], axis=1)
        run = loop.run(q, parameters, tolerance**2, STEPS)
        return run.state, self.verdict(run.state, poses, tolerance)

    @cached_property
    @recalled
    def _loop_with_locks(self) -> Loop:
        q, p, r, e, j = self._symbols
        free = ca.SX.sym("free", self.arm.n)
        masked = ca.horzcat(*[j[:, k] * free[k] for k in range(self.arm.n)])
        step, residual = damped_step(self.arm, q, e, masked)
        return Loop("inverse kinematics with locked joints", q, [p, r, free], next_state=step, residual=residual)

    def solve_locked(
        self,
        poses: Array,
        locked: NDArray[np.int64],
        angles: Array,
        seed: np.random.SeedSequence,
        restarts: int,
        tolerance: float,
        accept: Accept | None = None,
    ) -> Reach:
        """As :meth:`solve` with joint, or joints, ``locked[i]`` of row i locked at ``angles[i]``; values are not wrapped."""
        wide = locked.shape[1] if locked.ndim > 1 else 1
        locked, angles = locked.reshape(-1, wide), angles.reshape(-1, wide)  # no rows are rows, too
        rows = np.arange(len(poses))[:, None]
        free = np.ones((len(poses), self.arm.n))
        free[rows, locked] = 0.0
        parameters = np.concatenate([_parameters(poses), free], axis=1)
        finite = np.isfinite(parameters).all(axis=1) & np.isfinite(angles).all(axis=1)

        def lock(start: Array, chosen: NDArray[np.int64]) -> Array:
            start[np.arange(chosen.size)[:, None], locked[chosen]] = angles[chosen]
            return start

        found = self._search(
            self._loop_with_locks, parameters, np.flatnonzero(finite), seed, restarts, tolerance, lock, accept=accept
        )
        kept = (found.q[rows, locked] == angles).all(axis=1)
        kept &= True if accept is None else accept(found.q)
        position_error, rotation_error = self.errors(found.q, poses)
        reached = self._reached(found.q, position_error, rotation_error, tolerance) & kept
        status = np.where(reached, Status.OK, Status.NOT_FOUND).astype(np.uint8)
        status[~finite] = Status.BAD_INPUT
        return Reach(
            q=found.q, status=status, position_error=position_error, rotation_error=rotation_error, restarts=found.restarts
        )

    def reaches_locked(
        self,
        poses: Array,
        locked: NDArray[np.int64],
        angles: Array,
        seed: np.random.SeedSequence,
        restarts: int,
        tolerance: float,
        accept: Accept | None = None,
    ) -> NDArray[np.bool_]:
        """(N,) True where a configuration of pose i is found with joint ``locked[i]`` locked at ``angles[i]``.

        False says that none was found in ``restarts`` starts, which proves nothing. Poses must be finite.
        """
        return self.solve_locked(poses, locked, angles, seed, restarts, tolerance, accept).success

    def near(self, q: Array, pose: Array, free: Array, tolerance: float, steps: int = STEPS) -> tuple[Array, bool]:
        """From q (n,) towards one pose (4, 4), without restarts: for an end effector that is dragged.

        Args:
            q: (n,) where the arm is, rad and m.
            pose: (4, 4) in the world.
            free: (n,) 1 for joints that may move, 0 for locked ones.
            tolerance: rad, and lengths in units of the arm's own.
            steps: At most so many.

        Returns:
            The configuration (n,), never farther from the pose than q, joint values not wrapped; and whether it is on the pose
            and within the limits.
        """
        poses = pose[None]
        run = self._loop_with_locks.run(q[None], np.concatenate([_parameters(poses), free[None]], axis=1), tolerance**2, steps)
        both = np.concatenate([run.state, q[None]])
        miss = np.hypot(*self.errors(both, np.repeat(poses, 2, axis=0)))
        best = both[0] if miss[0] < miss[1] else both[1]
        return best, bool(self.verdict(best[None], poses, tolerance)[0])

    def _search(
        self,
        loop: Loop,
        parameters: Array,
        rows: NDArray[np.int64],
        seed: np.random.SeedSequence,
        restarts: int,
        tolerance: float,
        prepare: Callable[[Array, NDArray[np.int64]], Array],
        first: Array | None = None,
        accept: Accept | None = None,
        steps: int = STEPS,
    ) -> _Found:
        """Starts until each of the chosen rows is done; several starts of a row run side by side once few rows are left.

        What is not accepted counts as if its start had led nowhere.

        Start k of row i is one of a pool of random configurations, chosen by i and k alone: it does not depend on which
        rows are left, on how many starts run side by side, or on how many rows there are.
        """
        count, n = len(parameters), self.arm.n
        size = 1 << max(12, (restarts - 1).bit_length())
        pool_of_starts = self.starts(size, np.random.default_rng(seed))
        q, residual = np.full((count, n), np.nan), np.full(count, np.inf)
        used = np.zeros(count, dtype=np.int64)
        left, k = rows, 0
        with Count("starts of each pose", restarts, most=True) as tell:
            while left.size and k < restarts:
                # Doubling: most rows converge early, and starts that run beside a successful one are wasted.
                wave = 1 if k == 0 else min(restarts - k, k, max(1, _WAVE // left.size))
                number = np.repeat(np.arange(k, k + wave), left.size)
                chosen = np.tile(left, wave)
                start = pool_of_starts[(chosen * _BY_ROW + number * _BY_START) % size]
                if k == 0 and first is not None:
                    start = first[left]
                run = loop.run(prepare(start, chosen), parameters[chosen], tolerance**2, steps)
                ended, residuals = run.done, run.residual
                if accept is not None:
                    at = np.flatnonzero(ended)
                    ended = np.zeros_like(ended)
                    ended[at] = accept(run.state[at])
                    residuals = np.where(run.done & ~ended, np.inf, residuals)
                done, rest = ended.reshape(wave, -1), residuals.reshape(wave, -1)
                solved = done.any(axis=0)
                # The first start that reached the target, else the one that came closest; NaN never wins.
                pick = np.where(solved, done.argmax(axis=0), np.where(np.isnan(rest), np.inf, rest).argmin(axis=0))
                column = np.arange(left.size)
                best = rest[pick, column]
                used[left] += np.where(solved, pick + 1, wave)
                better = best < residual[left]
                q[left[better]] = run.state.reshape(wave, left.size, n)[pick, column][better]
                residual[left[better]] = best[better]
                left = left[~solved]
                k += wave
                tell(wave)
        return _Found(q, used)

    def verdict(self, q: Array, poses: Array, tolerance: float) -> NDArray[np.bool_]:
        """(N,) True where q is on the pose and within the limits."""
        return self._reached(q, *self.errors(q, poses), tolerance)

    def _reached(self, q: Array, position_error: Array, rotation_error: Array, tolerance: float) -> NDArray[np.bool_]:
        inside = ((q >= self.arm.lower) & (q <= self.arm.upper)).all(axis=1)
        return np.asarray(inside & (position_error <= tolerance * self._unit) & (rotation_error <= tolerance))

    def errors(self, q: Array, poses: Array) -> tuple[Array, Array]:
        """Position (m) and rotation error (rad) of the task's rows, (N,) each; NaN where q or the pose is."""
        errors = self._errors.rows(q, poses[:, :3, 3], poses[:, :3, :3])
        return errors[:, 0], errors[:, 1]

    def solve(
        self,
        poses: Array,
        seed: np.random.SeedSequence,
        restarts: int,
        tolerance: float,
        first: Array | None = None,
        accept: Accept | None = None,
        steps: int = STEPS,
    ) -> Reach:
        """Solve (N, 4, 4) poses; start k of pose i does not depend on the other poses.

        Args:
            poses: The poses.
            seed: Of the starts.
            restarts: At most so many.
            tolerance: Largest pose error, rad, and lengths in units of the arm's own.
            first: (N, n) the first start of each, if it is not a random one.
            accept: Which configurations (K, n) that meet their poses count, (K,); all of them if not given.
            steps: At most so many from each start.
        """
        parameters = _parameters(poses)
        finite = np.isfinite(parameters).all(axis=1)
        rows = np.flatnonzero(finite)
        found = self._search(
            self._loop, parameters, rows, seed, restarts, tolerance, lambda start, _: start, first, accept, steps
        )
        q, used = found.q, found.restarts
        q = joint_space.wrapped(self.arm, q)
        # The verdict comes from the configuration handed out, not from the solver's own residual.
        position_error, rotation_error = self.errors(q, poses)
        reached = self._reached(q, position_error, rotation_error, tolerance)
        reached &= True if accept is None else accept(q)
        status = np.where(reached, Status.OK, Status.NOT_FOUND).astype(np.uint8)
        status[~finite] = Status.BAD_INPUT
        return Reach(q=q, status=status, position_error=position_error, rotation_error=rotation_error, restarts=used)

    def prefer(self, reach: Reach, q: Array, poses: Array, tolerance: float) -> Reach:
        """Replace the configurations of a result by those of q (N, n) that meet their poses (N, 4, 4) within the limits."""
        position_error, rotation_error = self.errors(q, poses)
        kept = self._reached(q, position_error, rotation_error, tolerance)
        return Reach(
            q=np.where(kept[:, None], q, reach.q),
            status=np.where(kept, np.uint8(Status.OK), reach.status),
            position_error=np.where(kept, position_error, reach.position_error),
            rotation_error=np.where(kept, rotation_error, reach.rotation_error),
            restarts=reach.restarts,
        )


def damped_step(arm: Arm, q: SX, e: SX, j: SX, limits: tuple[SX, SX] | None = None) -> tuple[SX, SX]:
    """The next q (n,) of :class:`InverseKinematics` from an error (m,) and its Jacobian (m, n), and the squared error.

    Within the limits of the arm, or within ``limits``, two symbols (n,).
    """
    n = arm.n
    bounds = _bounds(arm) if limits is None else [(limits[0][k], limits[1][k]) for k in range(n)]
    size = ca.sumsqr(e)
    pull = [ca.dot(j[:, k], e) for k in range(n)]
    active = []
    for k in range(n):
        # CasADi has no short way to say "at the lower limit and pulled below it".
        lower, upper = bounds[k]
        low = ca.SX(0) if lower is None else ca.logic_and(q[k] <= lower, pull[k] < 0)
        high = ca.SX(0) if upper is None else ca.logic_and(q[k] >= upper, pull[k] > 0)
        active.append(ca.if_else(ca.logic_or(low, high), 0.0, 1.0))
    masked = ca.horzcat(*[j[:, k] * active[k] for k in range(n)])
    step = damped_least_norm(masked, e, 1e-3 * size + 1e-12)
    return _clipped(bounds, [q[k] + step[k] for k in range(n)]), size


def clipped(arm: Arm, q: Sequence[SX]) -> SX:
    """Joint values (n,) brought back to the limits."""
    return _clipped(_bounds(arm), q)


def _bounds(arm: Arm) -> list[tuple[Any, Any]]:
    """The limits of each joint, None where there is none."""
    ends = zip(arm.lower, arm.upper, strict=True)
    return [(x if kinematics.limited(x) else None, y if kinematics.limited(y) else None) for x, y in ends]


def _clipped(bounds: Sequence[tuple[Any, Any]], q: Sequence[SX]) -> SX:
    inside = []
    for x, (low, high) in zip(q, bounds, strict=True):
        if low is not None:
            x = ca.if_else(x < low, low, x)
        if high is not None:
            x = ca.if_else(x > high, high, x)
        inside.append(x)
    return ca.vertcat(*inside)


@lru_cache(maxsize=16)
def _solver(arm: Arm, rows: tuple[tuple[float, ...], ...], frame: Literal["base", "tool"]) -> InverseKinematics:
    # Keyed by what matters: every call makes a new Task, and the characteristic length plays no part here.
    return InverseKinematics(arm, Task("task", np.array(rows), frame))


def solver(arm: Arm, task: Task) -> InverseKinematics:
    """The solver of an arm and task, compiled once."""
    return _solver(arm, tuple(map(tuple, task.rows.tolist())), task.frame)


@checked
@says("solving inverse kinematics")
def solve_ik(
    arm: Arm,
    poses: ArrayLike,
    seed: int = 0,
    *,
    task: str | Task | Sequence[str] = "pose",
    restarts: int = 100,
    tolerance: float = 1e-6,
    start: ArrayLike | None = None,
) -> Reach:
    """Configurations that put the end effector at poses, within the joint limits.

    Args:
        arm: The arm.
        poses: (4, 4) or (N, 4, 4) tool poses in the world; of them only the task's rows must be met.
        seed: Of the random starts: the same seed gives the same result.
        task: Rows of the pose that matter.
        restarts: Random starts per pose before giving up.
        tolerance: Largest error, m and rad; of an arm that is shorter than 1 m, lengths are as much nearer.
        start: (n,) or (N, n) where to start from the first time; random if not given.

    Returns:
        A :class:`Reach`. It never says OK for a configuration outside the limits or beyond the tolerance.

    Raises:
        InputError: Poses that are not 4x4 transforms, or options out of range.
    """
    targets = check_poses(poses)
    if restarts < 1:
        raise InputError(f"restarts is {restarts}; it must be 1 or more")
    if not 0 < tolerance <= 1:
        raise InputError(f"tolerance is {tolerance:g}; it must be above 0 and at most 1, m and rad")
    engine = solver(arm, as_task(arm, task))
    first = None
    if start is not None:
        given = arm.check_configurations(start)
        if given.ndim == 2 and len(given) not in (1, len(targets)):
            raise InputError(f"start has {len(given)} configurations for {len(targets)} poses; give one, or one per pose")
        first = np.broadcast_to(given, (len(targets), arm.n))
        if not np.isfinite(first).all():
            raise InputError("start holds NaN or infinity; give finite joint values")
        first = np.clip(first, arm.lower, arm.upper)
    result = engine.solve(targets, np.random.SeedSequence(seed), restarts, engine.within(tolerance), first)
    if np.ndim(poses) == 2:
        return result.first
    return result
