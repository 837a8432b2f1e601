"""Which single locks a motion survives that is there already."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.clearance.choice import CellLike
from holdfast.clearance.clearance import Clearance
from holdfast.endurance.endurance import Endurance
from holdfast.endurance.problem import Mode, posed
from holdfast.endurance.rates import FailureRates, RatesLike
from holdfast.errors import InputError
from holdfast.motion.trajectory import Trajectory
from holdfast.notice import says
from holdfast.paths.timed_path import TimedPath
from holdfast.solvers.self_motions import STARTS

Array = NDArray[np.float64]


@checked
@says("looking at what the motion survives")
def endurance_of(
    arm: Arm,
    motion: Trajectory | ArrayLike,
    path: TimedPath,
    *,
    rates: RatesLike | FailureRates | None = None,
    per_second: bool = False,
    mode: Mode = "on-path",
    task: str | Task | Sequence[str] | None = None,
    samples: int = 101,
    spacing: float = 0.05,
    seed: int = 0,
    starts: int = STARTS,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    margin: float = 0.0,
) -> Endurance:
    """Which single locks a motion along a path survives, whatever made it.

    Args:
        arm: The arm.
        motion: What :func:`holdfast.follow` gives, or (S, n) configurations evenly spaced in time, rad and m.
        path: Where the tool is to be, and when.
        rates: How often each joint locks, (n,) or by joint: relative weights. Default: all alike.
        per_second: The rates are in 1/s.
        mode: ``on-path`` or ``detour``; see :func:`endure`.
        task: Rows of the poses to keep; by default as of :func:`endure`.
        samples: Times at which locks are tried, evenly spaced; between those of the motion it is interpolated.
        spacing: Of the points on the self-motion curves that detours need, rad.
        seed: Of the search for these.
        starts: Of the same.
        clearance: Of the arm from itself.
        cell: Objects around the arm, or their file, to keep clear of after the lock.
        margin: m; from an object beyond what the cell keeps from it.

    Raises:
        InputError: A motion that is not on the path, rates or options that do not fit.
        TaskError: No redundancy, or detours with more than one degree of it.
    """
    problem = posed(
        arm, path, rates, per_second, mode, task, samples, clearance, cell, margin, spacing=spacing, seed=seed, starts=starts
    )
    if isinstance(motion, Trajectory):
        given, times = motion.q, motion.time
    else:
        given = np.atleast_2d(arm.check_configurations(motion))
        times = np.linspace(0.0, path.duration, len(given))
    if len(given) < 2 or not np.isfinite(given).all():
        raise InputError(f"the motion of '{arm.name}' must be 2 or more configurations of finite numbers")
    if abs(times[-1] - path.duration) > 1e-9 * path.duration:
        raise InputError(
            f"the motion takes {times[-1]:.4g} s and the path {path.duration:.4g} s; give those that belong together"
        )
    q = np.column_stack([np.interp(problem.time, times, x) for x in given.T])
    off = problem.off(q)
    if off.any():
        raise InputError(
            f"the motion is off the path by more than 1 mm or 1 mrad, first at {problem.time[off.argmax()]:.4g} s; give one "
            "along this path"
        )
    return Endurance.of(problem, q, survives=problem.judge(q))
