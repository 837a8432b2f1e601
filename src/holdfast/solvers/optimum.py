"""The best configuration of a pose: as good as possible after the worst failure, without moving the end effector.

Source: Abdi, Maciejewski, Nahavandi 2012, eq. (11), (12), in the epigraph form: ``max t`` subject to ``s_k(q) >= t`` for
every failure k, the pose and the joint limits. Each step solves that program linearised about q on the self-motion
manifold, within a trust region; many starts run side by side and the poor ones are dropped early.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task
from holdfast.caching import cached_property
from holdfast.errors import TaskError
from holdfast.indices.objective import Objective
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled
from holdfast.linalg import damped_least_norm, dot, householder
from holdfast.notice import each
from holdfast.solvers import joint_space
from holdfast.solvers.inverse_kinematics import InverseKinematics, Reach, clipped, solver, task_error
from holdfast.solvers.maximin import maximin_step
from holdfast.status import Status, require_ok

if TYPE_CHECKING:
    from holdfast.clearance.clearance import Clearance

Array = NDArray[np.float64]

_MORE_WAVES = 7  # of random starts, for poses that fewer than half of a wave reached
FIRST_STEPS = 4  # of every start
LAST_STEPS = 12  # of the few that are kept
_KEPT = 4
RADIUS = 0.3  # first step along each null-space direction, rad or m
_WIDEST = 0.6


@dataclass(frozen=True, kw_only=True)
class Optimum:
    """Best configurations found for N poses, or for one (then without the leading N).

    Attributes:
        q: (N, n) rad and m, within limits; NaN where no configuration of the pose was found.
        value: (N,) of the objective; never worse than ``start_value``.
        start_value: (N,) of the first configuration that inverse kinematics found: the non-optimised sample.
        start_q: (N, n) that configuration, or the nearest miss.
        status: (N,) ``OK``, ``NOT_FOUND``, ``SINGULAR`` (nothing better than a singular configuration), ``INFEASIBLE`` (every
            configuration found has the arm collide with itself or the cell), ``UNDEFINED`` (a formula of the user's own has no
            value at any configuration found) or ``BAD_INPUT``.
        position_error: (N,) m.
        rotation_error: (N,) rad.
        starts: (N,) starts from which a configuration of the pose was found.
        agreeing: (N,) share of the starts followed to the end that reached the best value to 1e-3 of the scale of values.
        blocked: (N,) True where a clearance was asked for and the best configuration without it has the arm collide with
            itself or the cell.
        blocked_by: (N,) there the position in ``clearance.pair_names`` of the pair with the least room, or, where the status is
            INFEASIBLE, of the pair that most often has the least at the configurations found; else -1.
    """

    q: Array
    value: Array
    start_value: Array
    start_q: Array
    status: NDArray[np.uint8]
    position_error: Array
    rotation_error: Array
    starts: NDArray[np.int64]
    agreeing: Array
    blocked: NDArray[np.bool_]
    blocked_by: NDArray[np.int64]

    @property
    def success(self) -> NDArray[np.bool_]:
        """(N,) True where the pose is reached."""
        return np.asarray((self.status == Status.OK) | (self.status == Status.SINGULAR))

    def require_ok(self) -> Self:
        """Itself, or :class:`holdfast.HoldfastError` naming the first row that failed."""
        require_ok(self.status, "optimisation")
        return self


def ascent_step(
    objective: Objective,
    task: Task,
    clearance: Clearance | None = None,
    margin: float = 0.0,
    around: bool = False,
    free: bool = False,
) -> tuple[list[SX], SX]:
    """One step of the ascent, of an arm whose geometry may be symbols.

    Args:
        objective: What to raise.
        task: The rows of the pose that are kept.
        clearance: Of the arm from itself.
        margin: Smallest clearance, m.
        around: There are objects too. What room they leave is an input, so that no step is compiled for a cell.
        free: No pose is kept: every joint may move by itself.

    Returns:
        Symbols of the configuration (n,), the trust radius, the last step (n,) and the pose, position (3,) and rotation
        (3, 3), and of the objects around the room, m, and its gradient (n,); the next three of them as one column.
    """
    arm = objective.arm
    q = kinematics.joint_symbols(arm)
    p, r, radius = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3), ca.SX.sym("radius")
    last = ca.SX.sym("last", arm.n)
    j = kinematics.invariant_jacobian(arm, q) if task.invariant else task.jacobian(arm, q)
    qr = householder(j)
    rows = [ca.horzsplit(x) for x in ca.vertsplit(ca.SX.eye(arm.n))] if free else qr.null_rows()
    directions = [ca.vertcat(*column) for column in zip(*rows, strict=True)]
    parts = objective.parts(q, j, qr, directions)
    # Back onto the pose, least norm. The step along the manifold leaves it only to second order.
    e, full = task_error(arm, task, q, p, r)
    back = ca.SX.zeros(arm.n) if free else damped_least_norm(full, e, 1e-12)
    big = 1e3  # stands for no limit: far beyond any trust region
    rows_kept: list[list[SX]] = []
    room: list[tuple[SX, SX]] = []
    for k, (low, high) in enumerate(zip(arm.lower, arm.upper, strict=True)):
        if kinematics.limited(low) or kinematics.limited(high):
            below = low - q[k] - back[k] if kinematics.limited(low) else ca.SX(-big)
            above = high - q[k] - back[k] if kinematics.limited(high) else ca.SX(big)
            rows_kept.append(rows[k])
            room.append((below, above))
    outside = [ca.SX.sym("gap"), ca.SX.sym("slope", arm.n)] if around else []
    near = [] if clearance is None or not clearance.pairs else [clearance.smallest_with_slopes(q, directions)]
    near += [(outside[0], [ca.dot(outside[1], v) for v in directions])] if outside else []
    if near:
        gap, slope = near[0]
        for other, slopes in near[1:]:
            slope = [ca.if_else(other < gap, x, y) for x, y in zip(slopes, slope, strict=True)]
            gap = ca.if_else(other < gap, other, gap)
        rows_kept.append(slope)
        room.append((margin - gap, ca.SX(big)))
    z = maximin_step(parts, rows_kept, [below for below, _ in room], [above for _, above in room], radius)
    move = [dot(rows[k], z) for k in range(arm.n)]
    moved = clipped(arm, [q[k] + back[k] + move[k] for k in range(arm.n)])
    # Steps that agree may grow; steps that turn back have passed the best point.
    d = ca.vertcat(*move)
    turn = ca.dot(d, last) / (ca.sqrt(ca.sumsqr(d) * ca.sumsqr(last)) + 1e-30)
    next_radius = radius * ca.if_else(turn < 0, 0.5, ca.if_else(turn > 0.5, 1.3, 0.85))
    next_radius = ca.if_else(next_radius > _WIDEST, _WIDEST, next_radius)
    return [q, radius, last, p, r, *outside], ca.vertcat(moved, next_radius, d)


@recalled
def step_kernel(
    objective: Objective, task: Task, clearance: Clearance | None, margin: float, around: bool, free: bool
) -> Kernel:
    """:func:`ascent_step`, compiled; what an objective measures comes last."""
    inputs, step = ascent_step(objective, task, clearance, margin, around, free)
    measured = objective.measured
    return Kernel(f"ascent of {objective.name}", [*inputs, *([] if measured is None else [measured])], [step])


class Ascent:
    """The compiled step of one objective: towards the best configuration, back onto the pose, within the limits.

    Where the task leaves no freedom there is nothing to climb, and the best of the configurations found is chosen. A free
    ascent keeps no pose (:mod:`holdfast.solvers.anywhere`).
    """

    def __init__(
        self, objective: Objective, task: Task, clearance: Clearance | None = None, margin: float = 0.0, free: bool = False
    ) -> None:
        self.objective, self.task, self.arm = objective, task, objective.arm
        self.clearance, self.margin, self.free = clearance, margin, free
        self.engine: InverseKinematics = solver(self.arm, task)
        if not free:
            _ = self._step  # an objective that cannot be climbed says so before anything is computed

    @cached_property
    def _step(self) -> Kernel | None:
        if self.arm.n <= self.task.m and not self.free:
            return None
        return step_kernel(self.objective, self.task, None, 0.0, False, self.free)

    @cached_property
    def _clear_step(self) -> Kernel:
        """The step that also keeps the arm clear: compiled once it is needed, and for a changed cell not again."""
        assert self.clearance is not None
        around = self.clearance.obstacles is not None
        return step_kernel(self.objective, self.task, self.clearance.alone, self.margin, around, self.free)

    def climb(self, clear: bool, q: Array, poses: Array, steps: int, radius: Array | None = None) -> tuple[Array, Array]:
        """Steps from q (N, n); returns where they led and the last trust radius."""
        n = self.arm.n
        trust = np.full(len(q), RADIUS) if radius is None else radius
        if self._step is None:
            return q, trust
        step = self._clear_step if clear else self._step
        around = self.clearance.obstacles if clear and self.clearance is not None else None
        state = np.concatenate([q, trust[:, None], np.zeros_like(q)], axis=1)
        p, r = np.ascontiguousarray(poses[:, :3, 3]), np.ascontiguousarray(poses[:, :3, :3])
        for _ in each("steps of the ascent", range(steps)):
            before = state
            more = [] if self.objective.measured is None else [self.objective.measure(state[:, :n])]
            if around is not None:
                room, _, slope = around.nearest(state[:, :n])
                more = [room, slope, *more]
            state = step.rows(state[:, :n], state[:, n], state[:, n + 1 :], p, r, *more)
            # A step that divided by zero (a singular configuration) is not taken.
            bad = ~np.isfinite(state).all(axis=1)
            state[bad] = before[bad]
        return state[:, :n], state[:, n]

    def oriented(self, q: Array) -> Array:
        """The objective with its sign turned so that larger is better."""
        value = self.objective(q)
        return value if self.objective.better == "larger" else -value

    def _followed(
        self, owner: NDArray[np.int64], q: Array, poses: Array, tolerance: float, clear: bool
    ) -> tuple[NDArray[np.int64], Array, Array]:
        """Starts q of poses ``owner``, climbed, the poor ones dropped: owners, where they ended, oriented values.

        The value is -inf where the end is not on its pose or, if asked, not clear.
        """
        q, radius = self.climb(clear, q, poses[owner], FIRST_STEPS)
        value = self.oriented(q)
        keep = best_of_each(owner, np.where(self.is_clear(q), value, -np.inf) if clear else value, _KEPT)
        owner, q, radius = owner[keep], q[keep], radius[keep]
        q, _ = self.climb(clear, q, poses[owner], LAST_STEPS, radius)
        # Far below the tolerance, so that the pose does not pay for the value.
        q, _ = self.engine.attempt(q, poses[owner], 1e-3 * tolerance)
        q = joint_space.wrapped(self.engine.arm, q)
        good = self.engine.verdict(q, poses[owner], tolerance)
        if clear:
            good &= self.is_clear(q)
        return owner, q, np.where(good, self.oriented(q), -np.inf)

    def is_clear(self, q: Array) -> NDArray[np.bool_]:
        """(N,) True where q (N, n) leaves the margin."""
        assert self.clearance is not None
        return np.asarray(self.clearance.room(q) >= self.margin)

    def _most_often_nearest(self, owner: NDArray[np.int64], q: Array, poses: NDArray[np.int64]) -> NDArray[np.int64]:
        """Of each of some poses (H,), the pair that has the least room at most of its configurations among q (K, n)."""
        assert self.clearance is not None
        there = np.isin(owner, poses)
        votes = np.zeros((len(poses), len(self.clearance.pair_names)), dtype=np.int64)
        np.add.at(votes, (np.searchsorted(poses, owner[there]), self.clearance.closest_pair(q[there])), 1)
        return np.asarray(votes.argmax(axis=1), dtype=np.int64)

    def _started(
        self, poses: Array, first: Reach, seed: np.random.SeedSequence, starts: int, tolerance: float
    ) -> tuple[NDArray[np.int64], Array]:
        """Configurations of the reached poses to climb from, and whose they are.

        Where joint limits let few random starts converge, more waves of them follow, so that hard poses are searched as
        well as easy ones. Start k of pose i is the same number whichever other poses are reached.
        """
        reached = np.flatnonzero(first.success)
        owners, found = [reached], [first.q[reached]]
        converged = first.success.astype(np.int64)
        for wave, child in enumerate([seed, *seed.spawn(_MORE_WAVES)]):
            number = starts - 1 if wave == 0 else starts
            draws = self.engine.starts(len(poses) * number, np.random.default_rng(child)).reshape(
                len(poses), number, self.arm.n
            )
            few = reached if wave == 0 else reached[converged[reached] < starts // 2]
            if not few.size:
                break
            owner = np.tile(few, number)
            q, ok = self.engine.attempt(draws[few].transpose(1, 0, 2).reshape(-1, self.arm.n), poses[owner], tolerance)
            owners.append(owner[ok])
            found.append(q[ok])
            converged += np.bincount(owner[ok], minlength=len(poses))
        return np.concatenate(owners), np.concatenate(found)

    def solve(self, poses: Array, first: Reach, seed: np.random.SeedSequence, starts: int, tolerance: float) -> Optimum:
        """Best of several starts for (N, 4, 4) poses.

        Args:
            poses: The poses.
            first: What inverse kinematics found for them: the first start, and what the result never falls below.
            seed: Of the other starts.
            starts: In all, the first included.
            tolerance: Largest pose error, rad, and lengths in units of the arm's own.
        """
        count = len(poses)
        engine, sign = self.engine, 1.0 if self.objective.better == "larger" else -1.0
        reached = np.flatnonzero(first.success)
        best_q = np.where(first.success[:, None], first.q, np.nan)
        best, agreeing = np.full(count, np.nan), np.full(count, np.nan)
        found, blocked = np.zeros(count, dtype=np.int64), np.zeros(count, dtype=bool)
        blocked_by = np.full(count, -1, dtype=np.int64)
        status = first.status.copy()
        if reached.size:
            best[reached] = self.oriented(first.q[reached])
        start_value = sign * best
        if reached.size:
            owner, q = self._started(poses, first, seed, starts, tolerance)
            found = np.bincount(owner, minlength=count)

            def choose(owner: NDArray[np.int64], q: Array, value: Array, chosen: NDArray[np.int64]) -> None:
                top = best_of_each(owner, value, 1)
                # A formula of the user's own may have no value at the first configuration: any other is better.
                top = top[(value[top] > -np.inf) & ~(value[top] <= best[owner[top]])]
                best_q[owner[top]], best[owner[top]] = q[top], value[top]
                start = sign * start_value
                # Either may be infinite, at a singular configuration or by a formula of the user's own.
                gain = np.subtract(best, start, out=np.zeros(count), where=np.isfinite(best) & np.isfinite(start))
                scale = np.where(np.isfinite(best), np.maximum(np.abs(best), np.abs(gain)), 0.0)
                close = (value >= best[owner] - 1e-3 * scale[owner]) & (value > -np.inf)
                agreeing[chosen] = np.bincount(owner, close, count)[chosen] / np.maximum(
                    np.bincount(owner, minlength=count)[chosen], 1
                )

            choose(*self._followed(owner, q, poses, tolerance, clear=False), reached)
            if self.clearance is not None:
                blocked[reached] = ~self.is_clear(best_q[reached])
                again = np.flatnonzero(blocked)
                if again.size:
                    blocked_by[again] = self.clearance.closest_pair(best_q[again])
                    # Only the poses whose best configuration is not clear are climbed once more.
                    best[again], best_q[again], agreeing[again] = -np.inf, np.nan, 0.0
                    mine = blocked[owner]
                    mine[mine] = self.is_clear(q[mine])
                    if mine.any():
                        choose(owner[mine], q[mine], self.oriented(q[mine]), again)
                        choose(*self._followed(owner[mine], q[mine], poses, tolerance, clear=True), again)
                    hopeless = again[best[again] == -np.inf]
                    status[hopeless] = Status.INFEASIBLE
                    best[best == -np.inf] = np.nan
                    blocked_by[hopeless] = self._most_often_nearest(owner, q, hopeless)
            kept = reached[status[reached] != Status.INFEASIBLE]
            found_there = self.objective.statuses(best_q[kept])
            for code in (Status.SINGULAR, Status.UNDEFINED):
                status[kept[found_there == code]] = code
        position_error, rotation_error = engine.errors(best_q, poses)
        return Optimum(
            q=best_q,
            value=sign * best,
            start_value=start_value,
            start_q=first.q,
            status=status,
            position_error=position_error,
            rotation_error=rotation_error,
            starts=found,
            agreeing=agreeing,
            blocked=blocked,
            blocked_by=blocked_by,
        )


def default_starts(arm: Arm, task: Task) -> int:
    """Random starts per pose if none are given.

    One degree of redundancy gives curves, often many short ones between joint limits, and each must be hit to be climbed;
    measured on a Panda, 32 starts find the best of 600 on 81 % of poses and 128 on 97 %. More redundancy joins them.
    """
    return 128 if arm.n - task.m <= 1 else 32


def best_of_each(owner: NDArray[np.int64], value: Array, most: int) -> NDArray[np.int64]:
    """Positions of the ``most`` largest values of each owner, ordered by owner, then value."""
    order = np.lexsort((-value, owner))
    sorted_owner = owner[order]
    first = np.flatnonzero(np.r_[True, sorted_owner[1:] != sorted_owner[:-1]])
    rank = np.arange(len(owner)) - np.repeat(first, np.diff(np.r_[first, len(owner)]))
    return np.asarray(order[rank < most])


def objective_ascent(
    objective: Objective,
    task: Task | None = None,
    clearance: Clearance | None = None,
    margin: float = 0.0,
    free: bool = False,
) -> Ascent:
    """The compiled ascent of an objective, made once for each task, clearance and margin; free: it keeps no pose.

    Raises:
        TaskError: A task other than the objective's own.
    """
    own = objective.own_task
    if own is not None and task is not None and not own.same_rows(task):
        raise TaskError(f"{objective.name} is defined for the task '{own.name}', not for '{task.name}'; make it for that task")
    chosen = own or task or as_task(objective.arm, "pose")
    made: dict[object, Ascent] = objective._ascents
    key = (chosen.rows.tobytes(), chosen.frame, clearance, margin, free)
    if key not in made:
        made[key] = Ascent(objective, chosen, clearance, margin, free)
    return made[key]
