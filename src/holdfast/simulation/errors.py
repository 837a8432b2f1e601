"""The errors of the end effector over one run: the largest after the lock, and those some time later."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.simulation.runs import Outcome, Runs

Array = NDArray[np.float64]

LATER = (1.0, 10.0, 60.0)  # s, or cycles, after the first lock
_SAMPLES = 20_000  # of a run, about: more where its integrator took more steps


@dataclass(frozen=True)
class ErrorAt:
    """The error at one time.

    Attributes:
        time: s, or cycles.
        position: m.
        angle: rad; 0 where the task has no angular row.
    """

    time: float
    position: float
    angle: float


@dataclass(frozen=True, kw_only=True)
class ErrorHistory:
    """The errors of one run.

    Attributes:
        lock_time: Time of the first lock, s or cycles; 0 where no joint locks.
        end: The last error.
        least_position, least_angle: The errors where the distance, and where the angle, was least, over the whole run.
        largest_position: The error where the distance was largest, from the first lock on.
        largest_angle: The error where the angle was largest, from the first lock on.
        later: The errors 1, 10, and 60 s (or cycles) after the first lock, as far as the run is known then.
    """

    lock_time: float
    end: ErrorAt
    least_position: ErrorAt
    least_angle: ErrorAt
    largest_position: ErrorAt
    largest_angle: ErrorAt
    later: tuple[ErrorAt, ...]


def error_history(runs: Runs, k: int = 0) -> ErrorHistory:
    """Compute the errors of run k over time, from every step of its integrator.

    Raises:
        InputError: The run has no path.
    """
    end, locks = float(np.atleast_1d(runs.time)[k]), np.atleast_2d(runs.lock_time)[k]
    steps, at = runs._motion.recorded(runs, k, end)
    steps = np.unique(np.minimum(steps, end))
    between = np.linspace(0.0, 1.0, max(_SAMPLES // len(steps), 1), endpoint=False)
    grid = (steps[:-1, None] + np.diff(steps)[:, None] * between).ravel()
    lock = float(locks.min()) if locks.min() <= end else 0.0
    rests = np.atleast_1d(runs.code)[k] in (Outcome.CONVERGED, Outcome.STUCK)
    later = [lock + delay for delay in LATER if rests or lock + delay <= end]
    time = np.unique(np.concatenate([grid, [0.0, lock, end], later]))
    path = runs._motion.sampled(runs, k, at, np.minimum(time, end))
    within = time <= end
    after = within & (time >= lock)

    def error_at(index: int) -> ErrorAt:
        return ErrorAt(float(time[index]), float(path.position_error[index]), float(path.angle_error[index]))

    def largest(values: Array) -> ErrorAt:
        return error_at(int(np.argmax(np.where(after, values, -np.inf))))

    def least(values: Array) -> ErrorAt:
        return error_at(int(np.argmin(np.where(within, values, np.inf))))

    return ErrorHistory(
        lock_time=lock,
        end=error_at(int(np.flatnonzero(within)[-1])),
        least_position=least(path.position_error),
        least_angle=least(path.angle_error),
        largest_position=largest(path.position_error),
        largest_angle=largest(path.angle_error),
        later=tuple(error_at(int(np.searchsorted(time, t))) for t in later),
    )


def least_errors(runs: Runs, k: int = 0) -> tuple[float, float]:
    """Find the position error, m, and the angle error, rad, where run k's failed arm is as near to its target as it can be.

    Both are those of :meth:`Runs.least_error`, of the norm over metres and radians.
    """
    _, nearest = runs._motion.least_error(runs, 24, np.random.default_rng(0))
    position, angle = runs._motion.errors(runs, k, nearest[k : k + 1])
    return float(position[0]), float(angle[0])
