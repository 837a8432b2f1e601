"""The errors of the end effector over one run: the largest after the lock, and those some time later."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from holdfast.control.law import Law
from holdfast.simulation.runs import Outcome, Runs
from holdfast.simulation.system import tool_errors

Array = NDArray[np.float64]

LATER = (1.0, 10.0, 60.0)  # s, or cycles, after the first lock
_SAMPLES = 20_000  # of a run, about: more where its integrator took more steps


class ErrorKind(NamedTuple):
    """One of the two errors of the end effector, and its unit for people.

    Attributes:
        name: Attribute of the results that have it, in m or rad.
        key: Name with the unit, for files.
        text: Name for people.
        unit: Unit for people.
        factor: Number of units in 1 m or 1 rad.
        whole: Part of the target from which the error is measured.
    """

    name: Literal["position_error", "angle_error"]
    key: str
    text: str
    unit: str
    factor: float
    whole: str


_DISTANCE = ErrorKind("position_error", "position_error_m", "distance from the target", "mm", 1000.0, "the target")
_ANGLE = ErrorKind("angle_error", "angle_error_rad", "angle from the target", "degrees", 180 / np.pi, "its orientation")


def error_kinds(law: Law) -> list[ErrorKind]:
    """Return the errors that the task of a law prescribes: the distance, the angle, or both."""
    return [_DISTANCE] * bool(law.task.rows[:, :3].any()) + [_ANGLE] * bool(law.task.angular)


def shown_errors(law: Law, q: Array, error: Array, target: Array) -> list[Array]:
    """Compute the errors of configurations (N, n) in mm and degrees: one array (N,) for each of :func:`error_kinds`.

    Args:
        law: The control law.
        q: (N, n) rad and m.
        error: (N,) norms over the task's rows, m and rad.
        target: (4, 4) wanted tool pose.
    """
    both = dict(zip((_DISTANCE, _ANGLE), tool_errors(law, q, error, target), strict=True))
    return [kind.factor * both[kind] for kind in error_kinds(law)]


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
    path = runs._motion.sample_path(runs, k, at, np.minimum(time, end))
    within = time <= end
    after = within & (time >= lock)

    def error_at(index: int) -> ErrorAt:
        return ErrorAt(float(time[index]), float(path.position_error[index]), float(path.angle_error[index]))

    def largest(values: Array) -> ErrorAt:
        return error_at(int(np.argmax(np.where(after, values, -np.inf))))

    def find_least(values: Array) -> ErrorAt:
        return error_at(int(np.argmin(np.where(within, values, np.inf))))

    return ErrorHistory(
        lock_time=lock,
        end=error_at(int(np.flatnonzero(within)[-1])),
        least_position=find_least(path.position_error),
        least_angle=find_least(path.angle_error),
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
