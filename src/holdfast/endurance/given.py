"""Which single locks a motion survives that is there already: one that is given, or others beside the best.

These are least norm, gradient projection of a measure, and its best at every pose.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.clearance.choice import CellLike
from holdfast.clearance.clearance import Clearance
from holdfast.endurance.endurance import Compared, Endurance
from holdfast.endurance.problem import Mode, Problem, posed
from holdfast.endurance.rates import FailureRates, RatesLike
from holdfast.errors import InputError
from holdfast.indices.determinants import relative_manipulability
from holdfast.indices.objective import Objective
from holdfast.keep.labels import KeepLike
from holdfast.motion.tracking import follow
from holdfast.motion.trajectory import Trajectory
from holdfast.notice import says
from holdfast.paths.timed_path import TimedPath
from holdfast.solvers.self_motions import STARTS

Array = NDArray[np.float64]

LEAST_NORM = "least-norm"


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
    keep: KeepLike | None = None,
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
        keep: What the tool keeps beside the path, before the lock and after it; see :func:`endure`.

    Raises:
        InputError: A motion that is not on the path or breaks what is kept, rates or options that do not fit.
        TaskError: No redundancy, or more than one degree of it and detours among obstacles or with something kept.
    """
    problem = posed(
        arm,
        path,
        rates,
        per_second,
        mode,
        task,
        samples,
        clearance,
        cell,
        margin,
        keep=keep,
        spacing=spacing,
        seed=seed,
        starts=starts,
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
    broken = problem.conditions.broken(q)
    if broken is not None:
        raise InputError(f"the motion breaks what is kept: at {problem.time[broken[0]]:.4g} s the tool is {broken[1]}")
    return Endurance.of(problem, q, survives=problem.judge(q))


def beside(problem: Problem, best: Endurance, others: Sequence[Objective | str], seed: int) -> Endurance:
    """The result with the others beside it, each from its own best start.

    Raises:
        InputError: An unknown word, or a measure of another arm.
    """
    found: list[Compared] = []
    for other in others:
        if isinstance(other, str):
            if other != LEAST_NORM:
                raise InputError(f"compare holds '{other}'; give '{LEAST_NORM}', or a measure such as relative manipulability")
            plain = _followed(problem, relative_manipulability(problem.arm, problem.task), "none", False, seed)
            found.append(_judged(problem, "least norm", plain.q))
            continue
        local = _followed(problem, other, "gradient-projection", True, seed)
        found.append(_judged(problem, f"gradient projection of {other.name}", local.q))
        assert local.best_path is not None
        found.append(_judged(problem, f"best continuous {other.name}", local.best_path))
    return replace(best, beside=tuple(found))


def _followed(problem: Problem, objective: Objective, method: str, best: bool, seed: int) -> Trajectory:
    aim = {"minimise" if objective.better == "smaller" else "maximise": objective}
    kept, margin = problem.conditions.room or (None, 0.0)
    return follow(
        problem.arm,
        problem.path,
        **aim,  # type: ignore[arg-type]
        method=method,  # type: ignore[arg-type]
        task=problem.task,
        samples=len(problem.time),
        best=best,
        seed=seed,
        clearance=kept,
        margin=margin,
    )


def _judged(problem: Problem, name: str, q: Array) -> Compared:
    """What a motion survives; where it is off the path, or breaks what is kept, nothing is."""
    off = problem.off(q)
    off[~off] = ~problem.conditions.keeps(q[~off])
    survives = problem.judge(np.where(off[:, None], np.nan, q))
    made = Endurance.of(problem, q, survives=survives)
    return Compared(name=name, survival=made.survival, curve=made.curve(), off=float(off.mean()))
