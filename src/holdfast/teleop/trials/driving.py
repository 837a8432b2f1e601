"""Trials in progress, in batches: an operator, a plant for each law, and the rules that end a trial."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.teleop.trials.plant import JoystickPlant
from holdfast.teleop.trials.recordings import End, Trials
from holdfast.teleop.trials.stick import Joystick

_NOT_OVER = 255


@dataclass(frozen=True)
class EndRules:
    """Rules that end a trial.

    Attributes:
        radius: Radius of the target circle, m.
        at_rest: True if the end effector must also get no command in the circle, as with people.
        cycle_limit: Largest number of cycles.
        still: Motion per cycle, m, below which a commanded end effector counts as still.
        patience: Number of consecutive still cycles after which the trial ends.

    Source: Goel et al. 2003, section 4, for radius and rest; limit, ``still`` and ``patience`` are ours.
    """

    radius: float = 0.1
    at_rest: bool = False
    cycle_limit: int = 1000
    _: KW_ONLY
    still: float = 1e-6
    patience: int = 50

    def __post_init__(self) -> None:
        for name in ("radius", "cycle_limit", "still", "patience"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0):
                raise InputError(f"{name} is {value:g}; it must be above 0")


class Operator(ABC):
    """Operator of the joystick in a batch of trials."""

    @abstractmethod
    def begin(self, x: FloatArray, target: FloatArray) -> None:
        """Begin a batch of N trials with tool points ``x`` (N, m) and targets ``target`` (N, m), m."""

    @abstractmethod
    def command_velocity(self, rows: IndexArray, cycle: int, x: FloatArray, *, target: FloatArray) -> FloatArray:
        """Return the velocity (K, m), m/cycle, that the operator commands, before dead zone and limit.

        Args:
            rows: (K,) indices of the trials in progress.
            cycle: Index of the control cycle, from 0.
            x: (K, m) tool points of these trials, m.
            target: (K, m) targets of these trials, m.
        """

    def gives_up(self, rows: IndexArray, cycle: int) -> NDArray[np.bool_]:
        """Return (K,) True for the trials in progress, with indices ``rows`` (K,), that the operator aborts in ``cycle``."""
        del cycle
        return np.zeros(rows.size, dtype=bool)


class ComputerOperator(Operator):
    """Operator that steers straight to the target: ``Ke`` times the error, within the joystick's limit.

    Args:
        gain: Gain Ke, 1/cycle.

    Source: Goel et al. 2003, eq. (6); the gain is reconstructed.
    """

    def __init__(self, gain: float = 1.0) -> None:
        if not (np.isfinite(gain) and gain > 0):
            raise InputError(f"the computer's gain is {gain:g}; it must be above 0")
        self.gain = gain

    def begin(self, x: FloatArray, target: FloatArray) -> None:
        """See :meth:`Operator.begin`."""

    def command_velocity(self, rows: IndexArray, cycle: int, x: FloatArray, *, target: FloatArray) -> FloatArray:
        """See :meth:`Operator.command_velocity`."""
        return self.gain * (target - x)


class RecordedOperator(Operator):
    """Operator that repeats the commands of N recorded ``trials``, cycle by cycle, and gives no command after their end."""

    def __init__(self, trials: Trials) -> None:
        self._trials = trials

    def begin(self, x: FloatArray, target: FloatArray) -> None:
        """See :meth:`Operator.begin`."""
        if len(x) != len(self._trials):
            raise InputError(f"{len(self._trials)} recorded trials cannot drive {len(x)} trials; give equal numbers")

    def command_velocity(self, rows: IndexArray, cycle: int, x: FloatArray, *, target: FloatArray) -> FloatArray:
        """See :meth:`Operator.command_velocity`."""
        trials = self._trials
        velocity = np.zeros((rows.size, trials.velocity.shape[1]))
        in_progress = cycle < trials.cycles[rows]
        velocity[in_progress] = trials.velocity[trials.first[rows[in_progress]] + cycle]
        return velocity

    def gives_up(self, rows: IndexArray, cycle: int) -> NDArray[np.bool_]:
        """See :meth:`Operator.gives_up`."""
        gave_up = np.isin(self._trials.end[rows], (End.ABORTED, End.BROKEN_OFF))
        return np.asarray(gave_up & (cycle >= self._trials.cycles[rows]))


def drive_trials(
    plants: Sequence[JoystickPlant],
    plant_of: ArrayLike,
    q0: ArrayLike,
    *,
    target: ArrayLike,
    healthy: ArrayLike,
    operator: Operator,
    stick: Joystick | None = None,
    rules: EndRules | None = None,
) -> Trials:
    """Run a batch of trials and record them.

    Args:
        plants: Plants, one for each law, all with the same arm and task rows.
        plant_of: (N,) index of the plant of each trial.
        q0: (N, n) start configurations, rad and m.
        target: (N, m) centres of the target circles, m.
        healthy: (N, n) mask: 1, or 0 for joints that are locked from the start.
        operator: Operator of the joystick.
        stick: Joystick. None: commands of the operator are not limited, as for a replay.
        rules: Rules that end a trial. Default: ``EndRules()``.

    Returns:
        The recorded trials.

    Raises:
        InputError: The shapes of the arrays do not match.
    """
    end_rules = EndRules() if rules is None else rules
    n, m = plants[0].n, plants[0].m
    q, goals, mask = (np.array(array, dtype=np.float64, ndmin=2) for array in (q0, target, healthy))
    plant_index = np.asarray(plant_of, dtype=np.int64)
    count = len(plant_index)
    for name, array, width in (("q0", q, n), ("target", goals, m), ("healthy", mask, n)):
        if array.shape != (count, width) or not np.isfinite(array).all():
            raise InputError(
                f"{name} has shape {array.shape}; it must be ({count}, {width}), a row of finite numbers for each trial"
            )
    x = plants[0].position(q)
    operator.begin(x, goals)
    ends = np.full(count, End.TIME, dtype=np.uint8)
    q_end, x_end = q.copy(), x.copy()
    still_cycles = np.zeros(count, dtype=np.int64)
    running = np.arange(count)
    batches: list[tuple[IndexArray, FloatArray, FloatArray, FloatArray, FloatArray]] = []
    for cycle in range(end_rules.cycle_limit + 1):
        commanded = operator.command_velocity(running, cycle, x, target=goals[running])
        velocity = commanded if stick is None else stick.limit_velocity(commanded)
        at_rest = np.asarray(~velocity.any(axis=1))
        inside = np.linalg.norm(goals[running] - x, axis=1) <= end_rules.radius
        outcomes = np.full(running.size, End.TIME if cycle == end_rules.cycle_limit else _NOT_OVER, dtype=np.uint8)
        outcomes[still_cycles[running] >= end_rules.patience] = End.STILL
        outcomes[inside & (at_rest | (not end_rules.at_rest))] = End.ARRIVED
        outcomes[operator.gives_up(running, cycle)] = End.ABORTED
        ended = outcomes != _NOT_OVER
        if ended.any():
            finished = running[ended]
            ends[finished], q_end[finished], x_end[finished] = outcomes[ended], q[ended], x[ended]
            continues = ~ended
            running, at_rest = running[continues], at_rest[continues]
            q, x, velocity = q[continues], x[continues], velocity[continues]
        if not running.size:
            break
        q_next, actual = np.empty_like(q), np.empty_like(x)
        for index, plant in enumerate(plants):
            selected = np.flatnonzero(plant_index[running] == index)
            if selected.size:
                q_next[selected], actual[selected] = plant.step_batch(q[selected], velocity[selected], mask[running[selected]])
        batches.append((running, velocity, q, x, actual))
        x_next = plants[0].position(q_next)
        is_still = (np.linalg.norm(x_next - x, axis=1) < end_rules.still) & ~at_rest
        still_cycles[running] = np.where(is_still, still_cycles[running] + 1, 0)
        q, x = q_next, x_next
    return _gather_trials(batches, count, n, m, q_end, x_end, goals, ends)


def _gather_trials(
    batches: list[tuple[IndexArray, FloatArray, FloatArray, FloatArray, FloatArray]],
    count: int,
    n: int,
    m: int,
    q_end: FloatArray,
    x_end: FloatArray,
    target: FloatArray,
    end: NDArray[np.uint8],
) -> Trials:
    """Gather the recorded cycles of all trials, sorted by trial."""
    trial_of_cycle = np.concatenate([np.empty(0, dtype=np.int64), *(batch[0] for batch in batches)])
    order = np.argsort(trial_of_cycle, kind="stable")

    def sorted_cycles(field_index: int, width: int) -> FloatArray:
        return np.concatenate([np.empty((0, width)), *(batch[field_index] for batch in batches)])[order]

    first = np.concatenate([[0], np.cumsum(np.bincount(trial_of_cycle, minlength=count))])
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
