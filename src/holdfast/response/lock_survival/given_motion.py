"""Evaluate the single locks that a given motion survives, and compare other motions with the best one.

The other motions are least norm, gradient projection of a measure, and the best value of the measure at every pose.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.indices.determinants import relative_manipulability
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.path_following.tracking import follow
from holdfast.kinematics.path_following.trajectory import Trajectory
from holdfast.kinematics.paths.timed_path import TimedPath
from holdfast.kinematics.solvers.self_motions import TRACING_STARTS
from holdfast.kinematics.tool_constraints.labels import KeepLike
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike
from holdfast.response.lock_survival.lock_evaluation import find_survived_locks, is_off_path
from holdfast.response.lock_survival.planning import BaselineMotion, LockSurvival
from holdfast.response.lock_survival.problem import Mode, SurvivalProblem, make_problem
from holdfast.response.lock_survival.rates import FailureRates, RatesLike

LEAST_NORM = "least-norm"


@check_arguments
@reports_progress("evaluating locks of the motion")
def evaluate_motion(
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
    starts: int = TRACING_STARTS,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    margin: float = 0.0,
    keep: KeepLike | None = None,
) -> LockSurvival:
    """Evaluate which single locks a motion along a path survives; the motion may come from any source.

    Args:
        arm: Arm that executes the motion.
        motion: Result of :func:`holdfast.follow`, or (S, n) configurations evenly spaced in time, rad and m.
        path: Pose of the tool as a function of time.
        rates: Failure rates, (n,) or by joint name, as relative weights. Default: all equal.
        per_second: True if the rates are in 1/s.
        mode: ``on-path`` or ``detour``; see :func:`holdfast.plan_motion`.
        task: Task whose rows the tool follows. Default: as for :func:`holdfast.plan_motion`.
        samples: Number of evenly spaced times at which locks are evaluated; the motion is interpolated between its samples.
        spacing: Distance of the points on the self-motion curves, which detours need, rad.
        seed: Seed of the search for these curves.
        starts: Random starts of that search per pose.
        clearance: Self-collision model of the arm. None: self-collisions are not checked.
        cell: Objects around the arm, or their file, to avoid after the lock.
        margin: Smallest distance of the links, m; from an object, in addition to the margin that the cell states for it.
        keep: Tool constraints before and after the lock; see :func:`holdfast.plan_motion`.

    Raises:
        InputError: The motion is off the path or violates a constraint, or rates or options are invalid.
        TaskError: The arm is not redundant; or it has more than one degree of redundancy, and ``detour`` is combined with
            obstacles or constraints.
    """
    problem = make_problem(
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
        configurations, times = motion.q, motion.time
    else:
        configurations = np.atleast_2d(arm.check_configurations(motion))
        times = np.linspace(0.0, path.duration, len(configurations))
    if len(configurations) < 2 or not np.isfinite(configurations).all():
        raise InputError(f"the motion of '{arm.name}' must be 2 or more configurations of finite numbers")
    if abs(times[-1] - path.duration) > 1e-9 * path.duration:
        raise InputError(f"the motion takes {times[-1]:.4g} s and the path {path.duration:.4g} s; give a motion of this path")
    q = np.column_stack([np.interp(problem.time, times, positions) for positions in configurations.T])
    off_path = is_off_path(problem, q)
    if off_path.any():
        raise InputError(
            f"the motion is off the path by more than 1 mm or 1 mrad, first at {problem.time[off_path.argmax()]:.4g} s; give "
            "a motion along this path"
        )
    broken = problem.conditions.find_violation(q)
    if broken is not None:
        raise InputError(f"the motion violates a constraint: at {problem.time[broken[0]]:.4g} s the tool is {broken[1]}")
    return LockSurvival.for_motion(problem, q, survives=find_survived_locks(problem, q))


def with_baselines(
    problem: SurvivalProblem, result: LockSurvival, baselines: Sequence[Objective | str], seed: int
) -> LockSurvival:
    """Return the result with baseline motions for comparison, each from its own best start.

    Raises:
        InputError: A baseline is unknown, or a measure is of another arm.
    """
    comparisons: list[BaselineMotion] = []
    for baseline in baselines:
        if isinstance(baseline, str):
            if baseline != LEAST_NORM:
                raise InputError(
                    f"compare contains '{baseline}'; give '{LEAST_NORM}', or a measure such as relative manipulability"
                )
            least_norm = _plan_baseline_motion(problem, relative_manipulability(problem.arm, problem.task), "none", False, seed)
            comparisons.append(_evaluate_baseline(problem, "least norm", least_norm.q))
            continue
        projected = _plan_baseline_motion(problem, baseline, "gradient-projection", True, seed)
        comparisons.append(_evaluate_baseline(problem, f"gradient projection of {baseline.name}", projected.q))
        assert projected.best_path is not None
        comparisons.append(_evaluate_baseline(problem, f"best continuous {baseline.name}", projected.best_path))
    return replace(result, comparisons=tuple(comparisons))


def _plan_baseline_motion(
    problem: SurvivalProblem, objective: Objective, method: str, from_best_start: bool, seed: int
) -> Trajectory:
    objective_option = {"minimise" if objective.better == "smaller" else "maximise": objective}
    clearance, margin = problem.conditions.required_clearance or (None, 0.0)
    return follow(
        problem.arm,
        problem.path,
        **objective_option,  # type: ignore[arg-type]
        method=method,  # type: ignore[arg-type]
        task=problem.task,
        samples=len(problem.time),
        best=from_best_start,
        seed=seed,
        clearance=clearance,
        margin=margin,
    )


def _evaluate_baseline(problem: SurvivalProblem, name: str, q: FloatArray) -> BaselineMotion:
    """Evaluate the locks that a motion survives; where it is off the path or violates a condition, it survives none."""
    is_invalid = is_off_path(problem, q)
    is_invalid[~is_invalid] = ~problem.conditions.are_constraints_met(q[~is_invalid])
    survives = find_survived_locks(problem, np.where(is_invalid[:, None], np.nan, q))
    result = LockSurvival.for_motion(problem, q, survives=survives)
    return BaselineMotion(name=name, survival=result.survival, curve=result.curve(), off=float(is_invalid.mean()))
