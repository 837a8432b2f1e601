"""Trials under way: an operator, a plant for each law, and the rules by which a trial ends; a whole batch at a time."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.errors import InputError
from holdfast.teleop.trials.plant import Plant
from holdfast.teleop.trials.recordings import End, Trials
from holdfast.teleop.trials.stick import Stick

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_NOT_OVER = 255


@dataclass(frozen=True)
class Rules:
    """When a trial is over.

    Attributes:
        radius: Of the target circle, m.
        at_rest: The end effector must also get no command there: so with people, not with the computer.
        cycle_limit: Cycles allowed.
        still: m per cycle; an end effector that is commanded but moves less ...
        patience: ... for so many cycles one after the other is still, and the trial is over.

    Source: Goel et al. 2003, section 4, for radius and rest; limit, ``still`` and ``patience`` are ours.
    """

    radius: float = 0.1
    at_rest: bool = False
    cycle_limit: int = 1000
    _: KW_ONLY
    still: float = 1e-6
    patience: int = 50

    def __post_init__(self) -> None:
        for what in ("radius", "cycle_limit", "still", "patience"):
            value = getattr(self, what)
            if not (np.isfinite(value) and value > 0):
                raise InputError(f"{what} is {value:g}; it must be above 0")


class Operator(ABC):
    """Who holds the stick, of a batch of trials at once."""

    @abstractmethod
    def begin(self, x: Array, target: Array) -> None:
        """A batch of trials begins: tool points (N, m) and targets (N, m), m."""

    @abstractmethod
    def wanted(self, rows: Indices, cycle: int, x: Array, *, target: Array) -> Array:
        """The velocity (K, m) that the stick is moved for, m/cycle, before dead zone and limit.

        Args:
            rows: (K,) which trials of the batch are under way.
            cycle: From 0.
            x: (K, m) where their tool points are, m.
            target: (K, m) their targets.
        """

    def gives_up(self, rows: Indices, cycle: int) -> NDArray[np.bool_]:
        """(K,) True where the operator aborts the trial."""
        del cycle
        return np.zeros(rows.size, dtype=bool)


class Computer(Operator):
    """Straight at the target: ``Ke`` times the error, within the stick's limit; eq. (6) with Ke in 1/cycle.

    Args:
        gain: Ke, 1/cycle.

    Source: Goel et al. 2003, eq. (6); the gain is reconstructed.
    """

    def __init__(self, gain: float = 1.0) -> None:
        if not (np.isfinite(gain) and gain > 0):
            raise InputError(f"the computer's gain is {gain:g}; it must be above 0")
        self.gain = gain

    def begin(self, x: Array, target: Array) -> None:
        """See :meth:`Operator.begin`."""

    def wanted(self, rows: Indices, cycle: int, x: Array, *, target: Array) -> Array:
        """See :meth:`Operator.wanted`."""
        return self.gain * (target - x)


class Recorded(Operator):
    """The commands of recorded trials again, cycle by cycle, and no command when they are over."""

    def __init__(self, trials: Trials) -> None:
        self._trials = trials

    def begin(self, x: Array, target: Array) -> None:
        """See :meth:`Operator.begin`."""
        if len(x) != len(self._trials):
            raise InputError(f"{len(self._trials)} recorded trials cannot drive {len(x)} others; give the same trials")

    def wanted(self, rows: Indices, cycle: int, x: Array, *, target: Array) -> Array:
        """See :meth:`Operator.wanted`."""
        trials = self._trials
        out = np.zeros((rows.size, trials.velocity.shape[1]))
        under_way = cycle < trials.cycles[rows]
        out[under_way] = trials.velocity[trials.first[rows[under_way]] + cycle]
        return out

    def gives_up(self, rows: Indices, cycle: int) -> NDArray[np.bool_]:
        """See :meth:`Operator.gives_up`."""
        own_will = np.isin(self._trials.end[rows], (End.ABORTED, End.BROKEN_OFF))
        return np.asarray(own_will & (cycle >= self._trials.cycles[rows]))


def drive(
    plants: Sequence[Plant],
    plant_of: ArrayLike,
    q0: ArrayLike,
    *,
    target: ArrayLike,
    healthy: ArrayLike,
    operator: Operator,
    stick: Stick | None = None,
    rules: Rules | None = None,
) -> Trials:
    """Run a batch of trials and record them.

    Args:
        plants: One for each law, all with the same arm and task rows.
        plant_of: (N,) which plant each trial has.
        q0: (N, n) start configurations, rad and m.
        target: (N, m) centres of the target circles, m.
        healthy: (N, n) 1, or 0 for joints that are locked from the start.
        operator: Who holds the stick.
        stick: The stick; None: what the operator wants is commanded as it is, as when replaying.
        rules: When a trial is over.

    Returns:
        The :class:`holdfast.teleop.Trials`.

    Raises:
        InputError: Arrays that do not fit each other.
    """
    rule = Rules() if rules is None else rules
    n, m = plants[0].n, plants[0].m
    q, goal, mask = (np.array(a, dtype=np.float64, ndmin=2) for a in (q0, target, healthy))
    which = np.asarray(plant_of, dtype=np.int64)
    count = len(which)
    for what, a, width in (("q0", q, n), ("target", goal, m), ("healthy", mask, n)):
        if a.shape != (count, width) or not np.isfinite(a).all():
            raise InputError(
                f"{what} has shape {a.shape}; it must be ({count}, {width}), a row of finite numbers for each trial"
            )
    x = plants[0].position(q)
    operator.begin(x, goal)
    end = np.full(count, End.TIME, dtype=np.uint8)
    q_end, x_end = q.copy(), x.copy()
    still = np.zeros(count, dtype=np.int64)
    rows = np.arange(count)
    recorded: list[tuple[Indices, Array, Array, Array, Array]] = []
    for cycle in range(rule.cycle_limit + 1):
        wanted = operator.wanted(rows, cycle, x, target=goal[rows])
        velocity = wanted if stick is None else stick.limited(wanted)
        at_rest = np.asarray(~velocity.any(axis=1))
        inside = np.linalg.norm(goal[rows] - x, axis=1) <= rule.radius
        over = np.full(rows.size, End.TIME if cycle == rule.cycle_limit else _NOT_OVER, dtype=np.uint8)
        over[still[rows] >= rule.patience] = End.STILL
        over[inside & (at_rest | (not rule.at_rest))] = End.ARRIVED
        over[operator.gives_up(rows, cycle)] = End.ABORTED
        ended = over != _NOT_OVER
        if ended.any():
            done = rows[ended]
            end[done], q_end[done], x_end[done] = over[ended], q[ended], x[ended]
            on = ~ended
            rows, at_rest = rows[on], at_rest[on]
            q, x, velocity = q[on], x[on], velocity[on]
        if not rows.size:
            break
        q_next, actual = np.empty_like(q), np.empty_like(x)
        for k, plant in enumerate(plants):
            mine = np.flatnonzero(which[rows] == k)
            if mine.size:
                q_next[mine], actual[mine] = plant.cycles(q[mine], velocity[mine], mask[rows[mine]])
        recorded.append((rows, velocity, q, x, actual))
        x_next = plants[0].position(q_next)
        is_still = (np.linalg.norm(x_next - x, axis=1) < rule.still) & ~at_rest
        still[rows] = np.where(is_still, still[rows] + 1, 0)
        q, x = q_next, x_next
    return _gathered(recorded, count, n, m, q_end, x_end, goal, end)


def _gathered(
    recorded: list[tuple[Indices, Array, Array, Array, Array]],
    count: int,
    n: int,
    m: int,
    q_end: Array,
    x_end: Array,
    target: Array,
    end: NDArray[np.uint8],
) -> Trials:
    """The cycles of all trials, sorted by trial."""
    of = np.concatenate([np.empty(0, dtype=np.int64), *(r[0] for r in recorded)])
    order = np.argsort(of, kind="stable")

    def sorted_cycles(k: int, width: int) -> Array:
        return np.concatenate([np.empty((0, width)), *(r[k] for r in recorded)])[order]

    first = np.concatenate([[0], np.cumsum(np.bincount(of, minlength=count))])
    return Trials(
        velocity=sorted_cycles(1, m),
        q=sorted_cycles(2, n),
        x=sorted_cycles(3, m),
        actual=sorted_cycles(4, m),
        first=first,
        q_end=q_end,
        x_end=x_end,
        target=target,
        end=end,
    )
