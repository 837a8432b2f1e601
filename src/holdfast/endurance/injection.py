"""Locks injected into a motion at random times: does the failed arm get to the end? By another integrator than the table's."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.endurance import tables
from holdfast.endurance.problem import CHANGED, Problem
from holdfast.notice import Count
from holdfast.probability.intervals import Interval
from holdfast.solvers import joint_space
from holdfast.solvers.inverse_kinematics import solver

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.int64]

_STEP = 0.02  # rad, m and so many 5ths of the duration, along the branch
_WHOLE = 5.0  # what the duration counts beside joints, rad
_LONGEST = 60.0  # of a branch
_OFF = 1e-3  # m and rad at the end: the integration went wrong


@dataclass(frozen=True, eq=False, kw_only=True)
class Injection:
    """Locks at random times, N of them.

    Attributes:
        time: (N,) s.
        joint: (N,) index of the locked joint.
        survived: (N,) True where the failed arm finished the path.
        expected: (N,) what the motion says at the sample before.
        told: (N,) True where it says the same at the sample behind; between samples that differ it says nothing.
        interval: Of the probability that a lock is survived.
    """

    time: Array
    joint: Index
    survived: Flags
    expected: Flags
    told: Flags
    interval: Interval

    @property
    def alike(self) -> float:
        """Of the locks of which the motion says something, the fraction of which the injection says the same."""
        return float((self.survived == self.expected)[self.told].mean()) if self.told.any() else 1.0

    @property
    def disagreements(self) -> list[tuple[float, int]]:
        """Time, s, and joint of the others."""
        other = self.told & (self.survived != self.expected)
        return list(zip(self.time[other].tolist(), self.joint[other].tolist(), strict=True))


def drawn_locks(problem: Problem, locks: int, generator: np.random.Generator) -> tuple[Array, Index]:
    """Times (N,) and joints (N,): joints by their rates; times evenly, or as the first failure comes within the duration."""
    rates, duration = problem.rates, problem.path.duration
    joint = generator.choice(problem.arm.n, size=locks, p=rates.each / rates.total)
    share = generator.uniform(size=locks)
    if rates.per_second:
        end = -np.expm1(-rates.total * duration)
        return -np.log1p(-share * end) / rates.total, joint
    return share * duration, joint


def finished(problem: Problem, q: Array, time: Array, joint: Index, *, begin: Array) -> Flags:
    """(N,) True where the arm, at q (N, n) on the path at time (N,) with joint (N,) locked there, finishes the path.

    Its motion began at ``begin`` (n,).
    """
    if problem.mode == "detour":
        return problem.regained(q, np.searchsorted(problem.time, time), joint)
    if problem.spare == 1:
        return _on_path(problem, q, time, joint, tuple(problem.immobile))
    survived = np.zeros(len(q), dtype=bool)
    for held in problem.sets:  # the failed arm may hold any of them
        some = np.flatnonzero(~survived & ~np.isin(joint, held))
        survived[some] = _on_path(problem, q[some], time[some], joint[some], (*problem.immobile, *held))
    narrower = problem.narrower_at(begin)
    if narrower is not None:
        some = np.flatnonzero(~survived & ~narrower.off(q, time))
        survived[some] = finished(narrower, q[some], time[some], joint[some], begin=begin)
    some = np.flatnonzero(~survived)
    survived[some] = _changing(problem, q[some], time[some], joint[some])
    return survived


def _changing(problem: Problem, q: Array, time: Array, joint: Index) -> Flags:
    """As :func:`finished`, of an arm with redundancy left that may hold other joints at every sample."""
    at, owner = q[:0], np.empty(0, dtype=np.int64)
    since = np.searchsorted(problem.time, time, side="right")
    for k in range(1, len(problem.time)):
        fresh = np.flatnonzero(np.minimum(since, len(problem.time) - 1) == k)
        at, owner = np.concatenate([at, q[fresh]]), np.concatenate([owner, fresh])
        begin = np.maximum(time[owner], problem.time[k - 1])
        landed, row = [at[:0]], [owner[:0]]
        for held in problem.sets[:CHANGED]:
            some = np.flatnonzero(~np.isin(joint[owner], held))
            stopped = joint[owner[some]], (*problem.immobile, *held)
            ended, good = _branch(problem, at[some], begin[some], stopped, problem.time[k])
            landed.append(ended[good])
            row.append(owner[some[good]])
        at, owner = np.concatenate(landed), np.concatenate(row)
        some = tables.apart(at, owner)
        at, owner = at[some], owner[some]
    survived = np.zeros(len(q), dtype=bool)
    survived[owner[_on_last_pose(problem, at)]] = True
    return survived


def _on_path(problem: Problem, q: Array, time: Array, joint: Index, held: tuple[int, ...]) -> Flags:
    """Whether the branch through (joints, time) leads to the last pose."""
    ended, good = _branch(problem, q, time, (joint, held), problem.path.duration)
    good[good] = _on_last_pose(problem, ended[good])
    return good


def _branch(
    problem: Problem, q: Array, time: Array, stopped: tuple[Index, tuple[int, ...]], until: float
) -> tuple[Array, Flags]:
    """Where the branch through (joints, time) leads at a time, and whether it gets there.

    It is followed by its arc length, with Runge and Kutta's steps of fourth order. Where time turns back on it the branch ends:
    nothing goes on from there along the path.
    """
    arm, scale = problem.arm, _WHOLE / problem.path.duration
    joint, held = stopped
    end = until * scale
    found, reached = np.full(q.shape, np.nan), np.zeros(len(q), dtype=bool)
    left = np.arange(len(q))
    state = np.column_stack([q, time * scale])
    tangent = np.zeros(state.shape)
    tangent[:, -1] = 1.0
    with Count("locks", len(q)) as tell:
        for _ in range(int(_LONGEST / _STEP)):
            if not left.size:
                break
            lock = joint[left]
            first = _direction(problem, state, (lock, held), tangent, scale)
            second = _direction(problem, state + _STEP / 2 * first, (lock, held), first, scale)
            third = _direction(problem, state + _STEP / 2 * second, (lock, held), second, scale)
            fourth = _direction(problem, state + _STEP * third, (lock, held), third, scale)
            state = state + _STEP / 6 * (first + 2 * second + 2 * third + fourth)
            tangent = fourth
            over = (state[:, -1] >= end) & (fourth[:, -1] > 0)
            # What has passed the end is judged there, not where its step went.
            back = np.where(over, (state[:, -1] - end) / np.where(over, fourth[:, -1], 1.0), 0.0)
            here = state[:, :-1] - back[:, None] * fourth[:, :-1]
            good = ((here >= arm.lower - 1e-9) & (here <= arm.upper + 1e-9)).all(axis=1) & (fourth[:, -1] > 0)
            good[good] = problem.conditions.holds(here[good], 1e-9)
            ended = np.flatnonzero(over & good)
            found[left[ended]], reached[left[ended]] = here[ended], True
            go_on = good & ~over
            tell(int(np.count_nonzero(~go_on)))
            left, state, tangent = left[go_on], state[go_on], tangent[go_on]
    return found, reached


def _on_last_pose(problem: Problem, q: Array) -> Flags:
    """Whether branches that have passed the end did so on the last pose."""
    last = np.broadcast_to(problem.lock.poses[-1], (len(q), 4, 4))
    return np.asarray(np.max(solver(problem.arm, problem.task).errors(q, last), axis=0, initial=0.0) <= _OFF)


def _direction(problem: Problem, state: Array, stopped: tuple[Index, tuple[int, ...]], before: Array, scale: float) -> Array:
    """(N, n + 1) unit tangent of the branch at (joints, scaled time), the way that it ran ``before``."""
    arm, task = problem.arm, problem.task
    n, rows = arm.n, np.arange(len(state))
    time = np.clip(state[:, -1] / scale, 0.0, problem.path.duration * (1 - 1e-12))
    twist = problem.path.twist(time) / scale
    columns = np.concatenate([arm.jacobian(state[:, :-1]), -twist[:, :, None]], axis=2)
    if task.frame == "tool":
        turned = arm.forward_kinematics(state[:, :-1])[:, :3, :3].transpose(0, 2, 1)
        columns = np.concatenate([turned @ columns[:, :3], turned @ columns[:, 3:]], axis=1)
    system = np.zeros((len(state), n + 1, n + 1))
    system[:, : task.m] = task.rows @ columns
    lock, held = stopped
    system[rows, task.m, lock] = 1.0
    for k, other in enumerate(held):
        system[:, task.m + 1 + k, other] = 1.0
    system[:, n] = before
    wanted = np.zeros((len(state), n + 1, 1))
    wanted[:, n] = 1.0
    try:
        found = np.linalg.solve(system, wanted)[:, :, 0]
    except np.linalg.LinAlgError:
        found = (np.linalg.pinv(system) @ wanted)[:, :, 0]
    return np.asarray(found / np.maximum(np.linalg.norm(found, axis=1, keepdims=True), 1e-300))


def healthy(problem: Problem, q: Array, time: Array) -> Array:
    """(N, n) where a motion (T, n) is at times (N,), brought to the pose of that time and back within the joint limits.

    A motion that holds the axis of a cone at its samples does so between them.
    """
    narrower = problem.narrower_at(q[0])
    if narrower is not None and not narrower.off(q).any():
        return healthy(narrower, q, time)
    arm = problem.arm
    k = np.clip(np.searchsorted(problem.time, time, side="right") - 1, 0, len(q) - 2)
    share = (time - problem.time[k]) / np.diff(problem.time)[k]
    between = q[k] + share[:, None] * joint_space.difference(arm, q[k + 1], q[k])
    poses = problem.path.pose(time)
    found = problem.lock.tracer.corrected(between, poses)[0]
    inside = np.clip(found, arm.lower, arm.upper)
    if problem.spare > 1:
        return problem.conditions.brought(inside, poses)
    beyond = np.flatnonzero((found != inside).any(axis=1))  # of a motion along a limit
    limit = np.abs(found - inside)[beyond].argmax(axis=1)
    back, good = problem.lock.held(inside[beyond], limit, poses[beyond])
    found[beyond[good]] = back[good]
    return found
