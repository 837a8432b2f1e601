"""From a start to a goal without a path: the way of the joints that is exposed least to locks that lose the goal."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, real_numbers
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, target_pose
from holdfast.endurance.rates import FailureRates, RatesLike
from holdfast.errors import HoldfastError, InputError, TaskError
from holdfast.notice import says
from holdfast.solvers import joint_space
from holdfast.solvers.self_motions import STARTS, SelfMotion, fibres, tracer

Array = NDArray[np.float64]
Spans = list[tuple[float, float]]

_FEW = 20  # nodes around which the goal is looked for once more
_FINER = 32


@dataclass(frozen=True, eq=False, kw_only=True)
class Approach:
    """A motion from a start to a goal pose, each joint on its own and at its velocity limit.

    Attributes:
        arm, task: What moves, and which rows of the goal matter.
        rates: Of the joints.
        start, goal: (n,) where it begins, and the configuration of the goal pose where it ends, rad and m.
        outside: (n,) s that each joint spends at values at which a lock loses the goal.
        ranges: Of each joint, the values at which it may lock and the goal stays within reach, ``(low, high)`` each.
        velocity: (n,) of the joints, rad/s and m/s.
    """

    arm: Arm
    task: Task
    rates: FailureRates
    start: Array
    goal: Array
    outside: Array
    ranges: Sequence[Spans]
    velocity: Array

    @property
    def exposure(self) -> float:
        """``sum rate_i outside_i``: with rates in 1/s, expected number of locks that lose the goal; else s, of weight 1."""
        return float(self.rates.each @ self.outside)

    @property
    def duration(self) -> float:
        """Until the last joint is at its goal, s."""
        return float((np.abs(self.goal - self.start) / self.velocity).max())

    def at(self, time: ArrayLike) -> Array:
        """(n,) or (N, n) where the joints are at times, s: each goes straight to its goal as fast as it can, and waits."""
        share = np.asarray(time, dtype=np.float64)[..., None] * self.velocity
        way = self.goal - self.start
        return np.asarray(self.start + np.sign(way) * np.minimum(share, np.abs(way)))


@checked
@says("looking for the safest way to the goal")
def endure_to(
    arm: Arm,
    start: ArrayLike,
    goal: ArrayLike,
    *,
    rates: RatesLike | FailureRates | None = None,
    per_second: bool = False,
    task: str | Task | Sequence[str] = "pose",
    velocity: ArrayLike | None = None,
    spacing: float = 0.02,
    seed: int = 0,
    starts: int = STARTS,
) -> Approach:
    """The motion to a goal pose with the least exposure to locks after which the goal is out of reach.

    Without obstacles a lock of joint i at a value that it has in some configuration of the goal loses nothing. A joint must
    cover the way from its start to its goal whatever the others do, so that the least time outside such values is that of
    the way at its velocity limit, and joints that all move at their own limits attain it: the optimum over all motions is a
    minimum over the goal's configurations.

    Args:
        arm: The arm; with obstacles in the way the exposure is a lower bound.
        start: (n,) a configuration, rad and m; or (4, 4) a pose, of which the best configuration is chosen.
        goal: (m,) for tasks without angular rows, or (4, 4), as of :func:`holdfast.self_motion`.
        rates: How often each joint locks, (n,) or by joint: relative weights. Default: 1 each.
        per_second: The rates are in 1/s.
        task: Rows of the goal that matter.
        velocity: (n,) or one number, rad/s and m/s. Default: the joints' velocity limits.
        spacing: Of the points on the self-motion curves, rad.
        seed: Of the search for these.
        starts: Of the same.

    Raises:
        InputError: A start, goal, rates or velocities that do not fit, or joints without a velocity limit.
        TaskError: No redundancy, or more than one degree of it.
        HoldfastError: No configuration of the goal, or of the start, was found.

    Source: ranges of a joint over a self-motion manifold, Lewis and Maciejewski 1997; the closed form is ours.
    """
    rows = as_task(arm, task)
    if arm.n - rows.m != 1:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task '{rows.name}' {rows.m} rows; one joint more than rows is needed"
        )
    failing = FailureRates.of(arm, rates, per_second=per_second)
    speed = real_numbers([j.velocity for j in arm.joints] if velocity is None else velocity, "velocity")
    if speed.shape not in ((), (arm.n,)) or not (np.isfinite(speed) & (speed > 0)).all():
        raise InputError(
            f"velocity is {speed.tolist()}; give one number or {arm.n}, finite and above 0, for the joints of '{arm.name}'"
        )
    speed = np.broadcast_to(speed, arm.n)
    options = {"spacing": spacing, "seed": seed, "starts": starts}
    wanted = _of(fibres(arm, target_pose(rows, goal), rows, **options)[0], "goal")  # type: ignore[arg-type]
    if np.shape(start) == (4, 4):
        begins = _of(fibres(arm, start, rows, **options)[0], "start").q  # type: ignore[arg-type]
    else:
        begins = arm.check_configurations(start)[None]
        if begins.shape != (1, arm.n) or not np.isfinite(begins).all():
            raise InputError(f"the start of '{arm.name}' must be one configuration of {arm.n} finite numbers, or a pose (4, 4)")
        if ((begins < arm.lower) | (begins > arm.upper)).any():
            raise InputError("the start lies outside the joint limits")
    ways = _Ways(arm, wanted.arcs(), failing.each / speed)
    best_start, best_goal = ways.least(begins, wanted.q)
    best_goal = _refined(ways, wanted, best_start, best_goal)
    if len(begins) > 1:
        best_start, _ = ways.least(begins, best_goal[None])
    ends, outside = ways.of(best_start, best_goal)
    return Approach(
        arm=arm,
        task=rows,
        rates=failing,
        start=best_start,
        goal=ends,
        outside=outside / speed,
        ranges=ways.arcs,
        velocity=speed,
    )


def _of(found: SelfMotion, what: str) -> SelfMotion:
    if not len(found.q):
        raise HoldfastError(f"no configuration of the {what} was found: {found.describe()[0]}")
    return found


class _Ways:
    """How far joints go at values that lose the goal, on their ways between values.

    Attributes:
        arcs: Of each joint, the values that do not.
    """

    def __init__(self, arm: Arm, arcs: list[Spans], price: Array) -> None:
        self.arm, self.arcs, self._price = arm, arcs, price
        turns = joint_space.turning(arm)
        around = [k * 2 * np.pi for k in range(-3, 4)]
        self._spans = [
            sorted((low + turn, high + turn) for low, high in spans for turn in (around if circle else [0.0]))
            for spans, circle in zip(arcs, turns, strict=True)
        ]

    def _lost(self, k: int, values: Array) -> Array:
        """Length of what loses the goal between 0 and each value, negative below 0."""
        safe = np.zeros(values.shape)
        for low, high in self._spans[k]:
            safe += np.clip(values, low, high) - np.clip(0.0, low, high)
        return np.asarray(values - safe)

    def _each(self, k: int, a: Array, b: Array) -> tuple[Array, Array]:
        """Where joint k ends from a to b, which broadcast, if it goes the better way round, and how far it goes at a loss."""
        if not joint_space.turning(self.arm)[k]:
            return b + 0 * a, np.abs(self._lost(k, b) - self._lost(k, a))
        begin = self._lost(k, a)
        short = a + np.arctan2(np.sin(b - a), np.cos(b - a))
        long = short - np.sign(short - a) * 2 * np.pi
        near, far = (np.abs(self._lost(k, x) - begin) for x in (short, long))
        return np.where(far < near - 1e-12, long, short), np.minimum(near, far)

    def least(self, begins: Array, ends: Array) -> tuple[Array, Array]:
        """The best of starts (S, n) and ends (G, n); of equals the shortest way."""
        cost, way = np.zeros((len(begins), len(ends))), np.zeros((len(begins), len(ends)))
        for k, price in enumerate(self._price):
            end, lost = self._each(k, begins[:, None, k], ends[None, :, k])
            cost += price * lost
            way += np.abs(end - begins[:, None, k])
        best = np.argwhere(cost <= cost.min() + 1e-12)
        s, g = best[way[best[:, 0], best[:, 1]].argmin()]
        return begins[s], ends[g]

    def costs(self, begin: Array, ends: Array) -> Array:
        """(G,) of one start."""
        return np.asarray(sum(p * self._each(k, begin[k], ends[:, k])[1] for k, p in enumerate(self._price)))

    def of(self, begin: Array, end: Array) -> tuple[Array, Array]:
        """Where the joints end, as far round as is best, and how far each goes at a loss."""
        ends, lost = zip(*(self._each(k, begin[k : k + 1], end[k : k + 1]) for k in range(self.arm.n)), strict=True)
        return np.concatenate(ends), np.concatenate(lost)


def _refined(ways: _Ways, wanted: SelfMotion, start: Array, goal: Array) -> Array:
    """The best goal between the nodes too: the pieces next to the best nodes, cut finer and brought back to the pose."""
    pieces = [np.stack([c.q[:-1], c.q[1:]], axis=1) for c in wanted.components]
    pieces += [
        np.stack([c.q[-1], c.q[-1] + joint_space.difference(wanted.arm, c.q[0], c.q[-1])])[None]
        for c in wanted.components
        if c.closed
    ]
    every = np.concatenate(pieces)
    price = np.minimum(ways.costs(start, every[:, 0]), ways.costs(start, every[:, 1]))
    some = every[np.argsort(price, kind="stable")[:_FEW]]
    share = np.linspace(0, 1, _FINER + 1)[:, None, None]
    between = (some[:, 0] + share * (some[:, 1] - some[:, 0])).reshape(-1, wanted.arm.n)
    poses = np.broadcast_to(wanted.pose, (len(between), 4, 4))
    moved, on, _ = tracer(wanted.arm, wanted.task).corrected(between, poses)
    inside = on & ((moved >= wanted.arm.lower) & (moved <= wanted.arm.upper)).all(axis=1)
    return ways.least(start[None], np.concatenate([goal[None], moved[inside]]))[1]
