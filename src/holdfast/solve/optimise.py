"""The best configuration of a pose: as good as possible after the worst failure, without moving the hand.

Source: Abdi, Maciejewski, Nahavandi 2012, eq. (11), (12), in the epigraph form: ``max t`` subject to ``s_k(q) >= t`` for
every failure k, the pose and the joint limits. Each step solves that program linearised about q on the self-motion
manifold, within a trust region; many starts run side by side and the poor ones are dropped early.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm import kinematics
from holdfast.arm.model import Arm
from holdfast.arm.poses import check_poses
from holdfast.errors import InputError
from holdfast.indices import Index
from holdfast.kernels import Kernel, in_pool, pool, thread_count
from holdfast.linalg import damped_least_norm, dot, householder
from holdfast.solve.inverse import InverseKinematics, Reach, clipped, solver, task_error
from holdfast.solve.maximin import maximin_step
from holdfast.status import Status, require_ok

Array = NDArray[np.float64]

STARTS = 32
_FIRST_STEPS = 4  # of every start
_LAST_STEPS = 12  # of the few that are kept
_KEPT = 4
_RADIUS = 0.3  # first step along each null-space direction, rad or m
_WIDEST = 0.6
_BLOCK = 512  # poses worked on together by one thread; no result depends on it


@dataclass(frozen=True)
class Optimum:
    """Best configurations found for N poses, or for one (then without the leading N).

    Attributes:
        q: (N, n) rad and m, within limits; NaN where no configuration of the pose was found.
        value: (N,) of the index; never worse than ``start_value``.
        start_value: (N,) of the first configuration that inverse kinematics found: the non-optimised sample.
        start_q: (N, n) that configuration, or the nearest miss.
        status: (N,) ``OK``, ``NOT_FOUND``, ``SINGULAR`` (nothing better than a singular configuration) or ``BAD_INPUT``.
        position_error: (N,) m.
        rotation_error: (N,) rad.
        starts: (N,) starts from which a configuration of the pose was found.
        agreeing: (N,) share of the starts followed to the end that reached the best value to 1e-3 of the scale of values.
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

    @property
    def success(self) -> NDArray[np.bool_]:
        """(N,) True where the pose is reached."""
        return np.asarray((self.status == Status.OK) | (self.status == Status.SINGULAR))

    def require_ok(self) -> Optimum:
        """Itself, or :class:`holdfast.HoldfastError` naming the first row that failed."""
        require_ok(self.status, "optimisation")
        return self


class Ascent:
    """The compiled step of one index: towards the best configuration, back onto the pose, within the limits."""

    def __init__(self, index: Index) -> None:
        arm, task = index.arm, index.task
        self.index, self.arm = index, arm
        self.engine: InverseKinematics = solver(arm, task)
        q = kinematics.joint_symbols(arm)
        p, r, radius = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3), ca.SX.sym("radius")
        last = ca.SX.sym("last", arm.n)
        j = kinematics.invariant_jacobian(arm, q) if task.invariant else task.jacobian(arm, q)
        qr = householder(j)
        rows = qr.null_rows()
        free = arm.n - task.m
        directions = [ca.vertcat(*[rows[k][c] for k in range(arm.n)]) for c in range(free)]
        values, slopes = index.scores(q, j, qr, directions)
        # Back onto the pose, least norm. The step along the manifold leaves it only to second order.
        e, full = task_error(arm, task, q, p, r)
        back = damped_least_norm(full, e, 1e-12)
        low = [arm.lower[k] - q[k] - back[k] for k in range(arm.n)]
        high = [arm.upper[k] - q[k] - back[k] for k in range(arm.n)]
        bounded = [k for k in range(arm.n) if np.isfinite(arm.lower[k]) or np.isfinite(arm.upper[k])]
        big = 1e3  # stands for no limit: far beyond any trust region
        z = maximin_step(
            values,
            slopes,
            [rows[k] for k in bounded],
            [low[k] if np.isfinite(arm.lower[k]) else ca.SX(-big) for k in bounded],
            [high[k] if np.isfinite(arm.upper[k]) else ca.SX(big) for k in bounded],
            radius,
        )
        move = [dot(rows[k], z) for k in range(arm.n)]
        moved = clipped(arm, [q[k] + back[k] + move[k] for k in range(arm.n)])
        # Steps that agree may grow; steps that turn back have passed the best point.
        d = ca.vertcat(*move)
        turn = ca.dot(d, last) / (ca.sqrt(ca.sumsqr(d) * ca.sumsqr(last)) + 1e-30)
        next_radius = radius * ca.if_else(turn < 0, 0.5, ca.if_else(turn > 0.5, 1.3, 0.85))
        next_radius = ca.if_else(next_radius > _WIDEST, _WIDEST, next_radius)
        self._step = Kernel(f"ascent of {index.name}", [q, radius, last, p, r], [ca.vertcat(moved, next_radius, d)])

    def climb(self, q: Array, poses: Array, steps: int, radius: Array | None = None) -> tuple[Array, Array]:
        """Steps from q (N, n); returns where they led and the last trust radius."""
        n = self.arm.n
        trust = np.full(len(q), _RADIUS) if radius is None else radius
        state = np.concatenate([q, trust[:, None], np.zeros_like(q)], axis=1)
        p, r = np.ascontiguousarray(poses[:, :3, 3]), np.ascontiguousarray(poses[:, :3, :3])
        for _ in range(steps):
            before = state
            state = self._step.rows(state[:, :n], state[:, n], state[:, n + 1 :], p, r)
            # A step that divided by zero (a singular configuration) is not taken.
            bad = ~np.isfinite(state).all(axis=1)
            state[bad] = before[bad]
        return state[:, :n], state[:, n]

    def solve(self, poses: Array, first: Reach, seed: np.random.SeedSequence, starts: int, tolerance: float) -> Optimum:
        """Best of several starts for (N, 4, 4) poses.

        Args:
            poses: The poses.
            first: What inverse kinematics found for them: the first start, and what the result never falls below.
            seed: Of the other starts.
            starts: In all, the first included.
            tolerance: Largest pose error, m and rad.
        """
        count, n = len(poses), self.arm.n
        engine = self.engine
        reached = np.flatnonzero(first.success)
        best_q = np.where(first.success[:, None], first.q, np.nan)
        best, start_value, agreeing = np.full(count, np.nan), np.full(count, np.nan), np.full(count, np.nan)
        found = np.zeros(count, dtype=np.int64)
        status = first.status.copy()
        if reached.size:
            sign = 1.0 if self.index.better == "larger" else -1.0
            start_value[reached] = best[reached] = self.index(first.q[reached])
            # Start k of pose i is the same number whichever other poses are reached.
            draws = engine.starts(count * (starts - 1), np.random.default_rng(seed)).reshape(count, starts - 1, n)
            owner = np.tile(reached, starts - 1)
            q, ok = engine.attempt(draws[reached].transpose(1, 0, 2).reshape(-1, n), poses[owner], tolerance)
            owner, q = np.r_[reached, owner[ok]], np.concatenate([first.q[reached], q[ok]])
            found = np.bincount(owner, minlength=count)
            q, radius = self.climb(q, poses[owner], _FIRST_STEPS)
            keep = _best_of_each(owner, sign * self.index(q), _KEPT)
            owner, q, radius = owner[keep], q[keep], radius[keep]
            q, _ = self.climb(q, poses[owner], _LAST_STEPS, radius)
            # Far below the tolerance, so that the pose does not pay for the value.
            q, _ = engine.attempt(q, poses[owner], 1e-3 * tolerance)
            q = engine.wrapped(q)
            value = np.where(engine.verdict(q, poses[owner], tolerance), sign * self.index(q), -np.inf)
            top = _best_of_each(owner, value, 1)
            top = top[value[top] > sign * best[owner[top]]]
            best_q[owner[top]], best[owner[top]] = q[top], sign * value[top]
            close = value >= sign * best[owner] - 1e-3 * np.abs(best[owner])
            agreeing[reached] = np.bincount(owner, close, count)[reached] / np.bincount(owner, minlength=count)[reached]
            singular = self.index.evaluate(best_q[reached]).status == Status.SINGULAR
            status[reached[singular]] = Status.SINGULAR
        position_error, rotation_error = engine.errors(best_q, poses)
        return Optimum(best_q, best, start_value, first.q, status, position_error, rotation_error, found, agreeing)


def _best_of_each(owner: NDArray[np.int64], value: Array, most: int) -> NDArray[np.int64]:
    """Positions of the ``most`` largest values of each owner, ordered by owner, then value."""
    order = np.lexsort((-value, owner))
    sorted_owner = owner[order]
    first = np.flatnonzero(np.r_[True, sorted_owner[1:] != sorted_owner[:-1]])
    rank = np.arange(len(owner)) - np.repeat(first, np.diff(np.r_[first, len(owner)]))
    return np.asarray(order[rank < most])


def optimise(
    arm: Arm,
    poses: ArrayLike,
    objective: Index,
    seed: int = 0,
    starts: int = STARTS,
    restarts: int = 100,
    tolerance: float = 1e-6,
) -> Optimum:
    """The configuration of each pose that is best under an index, within the joint limits.

    Args:
        arm: The arm.
        poses: (4, 4) or (N, 4, 4) in the world; only the rows of the index's task must be met.
        objective: An index of that arm; it knows whether larger or smaller is better.
        seed: The same seed gives the same result, whatever the number of threads and of other poses behind.
        starts: Random starts per pose; more find better optima (the problem has many).
        restarts: Random starts of inverse kinematics before a pose counts as not found.
        tolerance: Largest pose error, m and rad.

    Returns:
        An :class:`Optimum`. Its value is never worse than that of the first configuration found.

    Raises:
        InputError: Poses that are not 4x4 transforms, options out of range, or an index of another arm.
        TaskError: An index that cannot be optimised yet.

    Source: Abdi et al. 2012, eq. (11), (12).
    """
    targets = check_poses(poses)
    if objective.arm.fingerprint != arm.fingerprint:
        raise InputError(f"the objective belongs to '{objective.arm.name}', not to '{arm.name}'; make it with the same arm")
    for what, value in (("starts", starts), ("restarts", restarts)):
        if value < 1:
            raise InputError(f"{what} is {value}; it must be 1 or more")
    if not tolerance > 0:
        raise InputError(f"tolerance is {tolerance:g}; it must be above 0")
    ascent = objective_ascent(objective)
    blocks = [slice(a, a + _BLOCK) for a in range(0, len(targets), _BLOCK)] or [slice(0, 0)]

    def work(number: int) -> Optimum:
        part = targets[blocks[number]]
        first, others = np.random.SeedSequence(seed, spawn_key=(number,)).spawn(2)
        reach = ascent.engine.solve(part, first, restarts, tolerance)
        return ascent.solve(part, reach, others, starts, tolerance)

    if len(blocks) == 1 or in_pool() or thread_count() == 1:
        parts = [work(k) for k in range(len(blocks))]
    else:
        parts = list(pool().map(work, range(len(blocks))))
    names = list(Optimum.__dataclass_fields__)
    joined = {name: np.concatenate([getattr(part, name) for part in parts]) for name in names}
    if np.ndim(poses) == 2:
        return Optimum(**{name: value[0] for name, value in joined.items()})
    return Optimum(**joined)


def objective_ascent(index: Index) -> Ascent:
    """The compiled ascent of an index, made once per index."""
    made: Ascent | None = index.__dict__.get("_ascent")
    if made is None:
        made = index.__dict__["_ascent"] = Ascent(index)
    return made
