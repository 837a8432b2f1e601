"""Errors of the end effector over one run: the largest after the lock, and those some time later."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from holdfast.control.laws.law import Law
from holdfast.control.simulation.runs import RunOutcome, Runs
from holdfast.control.simulation.system import position_and_angle_errors
from holdfast.core.typing import FloatArray

REPORT_DELAYS = (1.0, 10.0, 60.0)  # s, or cycles, after the first lock
_SAMPLES_PER_RUN = 20_000  # approximate; more if the integrator took more steps


class ErrorKind(NamedTuple):
    """One of the two errors of the end effector, with its names and units."""

    name: Literal["position_error", "angle_error"]  # attribute of the results that have it, in m or rad
    key: str  # name with the unit, for files
    text: str  # name in texts
    unit: str  # unit in texts
    factor: float  # number of units in 1 m or 1 rad
    whole: str  # part of the target from which the error is measured


_POSITION_KIND = ErrorKind("position_error", "position_error_m", "distance from the target", "mm", 1000.0, "the target")
_ANGLE_KIND = ErrorKind("angle_error", "angle_error_rad", "angle from the target", "degrees", 180 / np.pi, "its orientation")


def error_kinds(law: Law) -> list[ErrorKind]:
    """Return the errors that the task of a law prescribes: the distance, the angle, or both."""
    return [_POSITION_KIND] * bool(law.task.rows[:, :3].any()) + [_ANGLE_KIND] * bool(law.task.angular)


def display_errors(law: Law, q: FloatArray, error: FloatArray, target: FloatArray) -> list[FloatArray]:
    """Compute the errors of configurations (N, n) with error norms (N,) for a target (4, 4), in mm and degrees.

    There is one array (N,) for each of :func:`error_kinds`.
    """
    errors_by_kind = dict(zip((_POSITION_KIND, _ANGLE_KIND), position_and_angle_errors(law, q, error, target), strict=True))
    return [kind.factor * errors_by_kind[kind] for kind in error_kinds(law)]


@dataclass(frozen=True)
class ErrorAt:
    """Error of the end effector at one time."""

    time: float  # s, or cycles
    position: float  # m
    angle: float  # rad; 0 if the task has no angular row


@dataclass(frozen=True, kw_only=True)
class ErrorHistory:
    """Errors of one run at its end and at its extremes."""

    lock_time: float  # time of the first lock, s or cycles; 0 if no joint locks
    end: ErrorAt  # error at the end
    least_position: ErrorAt  # error at the least distance, over the whole run
    least_angle: ErrorAt  # error at the least angle, over the whole run
    largest_position: ErrorAt  # error at the largest distance, from the first lock on
    largest_angle: ErrorAt  # error at the largest angle, from the first lock on
    later: tuple[ErrorAt, ...]  # errors 1, 10, and 60 s (or cycles) after the first lock, as far as the run lasts


def error_history(runs: Runs, run: int = 0) -> ErrorHistory:
    """Compute the errors of run k over time, from every step of its integrator.

    Raises:
        InputError: The run has no path.
    """
    end_time, lock_times = float(np.atleast_1d(runs.time)[run]), np.atleast_2d(runs.lock_time)[run]
    step_times, motion = runs._simulator.replay_run(runs, run, end_time)
    step_times = np.unique(np.minimum(step_times, end_time))
    between = np.linspace(0.0, 1.0, max(_SAMPLES_PER_RUN // len(step_times), 1), endpoint=False)
    sample_times = (step_times[:-1, None] + np.diff(step_times)[:, None] * between).ravel()
    first_lock = float(lock_times.min()) if lock_times.min() <= end_time else 0.0
    is_at_rest = np.atleast_1d(runs.code)[run] in (RunOutcome.CONVERGED, RunOutcome.STUCK)
    report_times = [first_lock + delay for delay in REPORT_DELAYS if is_at_rest or first_lock + delay <= end_time]
    time = np.unique(np.concatenate([sample_times, [0.0, first_lock, end_time], report_times]))
    path = runs._simulator.sample_path(runs, run, motion, np.minimum(time, end_time))
    is_within_run = time <= end_time
    is_after_lock = is_within_run & (time >= first_lock)

    def error_at(index: int) -> ErrorAt:
        return ErrorAt(float(time[index]), float(path.position_error[index]), float(path.angle_error[index]))

    def find_largest(values: FloatArray) -> ErrorAt:
        return error_at(int(np.argmax(np.where(is_after_lock, values, -np.inf))))

    def find_least(values: FloatArray) -> ErrorAt:
        return error_at(int(np.argmin(np.where(is_within_run, values, np.inf))))

    return ErrorHistory(
        lock_time=first_lock,
        end=error_at(int(np.flatnonzero(is_within_run)[-1])),
        least_position=find_least(path.position_error),
        least_angle=find_least(path.angle_error),
        largest_position=find_largest(path.position_error),
        largest_angle=find_largest(path.angle_error),
        later=tuple(error_at(int(np.searchsorted(time, report_time))) for report_time in report_times),
    )


def least_errors(runs: Runs, run: int = 0) -> tuple[float, float]:
    """Find the position error, m, and the angle error, rad, of run k's failed arm at its least error.

    The least error is that of :meth:`Runs.least_error`, a norm over metres and radians.
    """
    _, nearest = runs._simulator.least_error(runs, 24, np.random.default_rng(0))
    position, angle = runs._simulator.compute_errors(runs, run, nearest[run : run + 1])
    return float(position[0]), float(angle[0])
