"""Simulation of several control laws on the same motions, for their comparison."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.convergence.healthy_cost import measure_healthy_cost
from holdfast.control.convergence.law_choice import LawChoice, rank_laws
from holdfast.control.convergence.law_comparison import HEALTHY_CASE, LawComparison, target_error_threshold
from holdfast.control.convergence.maps import Over, Progress
from holdfast.control.convergence.places import Places
from holdfast.control.laws.law import Law
from holdfast.control.simulation.closed_loop import DEFAULT_TOLERANCE, TARGET_RADIUS_M, simulate
from holdfast.control.simulation.runs import RunOutcome, Runs
from holdfast.control.simulation.system import prescribed_offset
from holdfast.core.errors import InputError
from holdfast.core.progress import report_work
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.model.arm.configurations import as_configurations
from holdfast.model.arm.poses import check_poses
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance
from holdfast.model.failure_modes import FailureSpec, single_joints

_DEFAULT_RESTARTS = 24


@overload
def compare_laws(
    laws: Sequence[Law] | Mapping[str, Law],
    q0: ArrayLike,
    target: ArrayLike,
    *,
    best: Literal[False] = False,
    failures: FailureSpec | None = "single",
    cycles: bool = False,
    time_limit: float | None = None,
    tolerance: float | None = None,
    radius: float = TARGET_RADIUS_M,
    restarts: int = _DEFAULT_RESTARTS,
    seed: int = 0,
    about: str = "",
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
) -> LawComparison: ...
@overload
def compare_laws(
    laws: Sequence[Law] | Mapping[str, Law],
    q0: ArrayLike | str | int | Places,
    target: ArrayLike | str | int | Places,
    *,
    best: Literal[True],
    **options: Any,
) -> LawChoice: ...
@check_arguments  # type: ignore[misc]  # the second signature leaves its options to this check
def compare_laws(
    laws: Sequence[Law] | Mapping[str, Law],
    q0: ArrayLike | str | int | Places,
    target: ArrayLike | str | int | Places,
    *,
    best: bool = False,
    failures: FailureSpec | None = "single",
    cycles: bool = False,
    time_limit: float | None = None,
    tolerance: float | None = None,
    radius: float = TARGET_RADIUS_M,
    restarts: int = _DEFAULT_RESTARTS,
    seed: int = 0,
    about: str = "",
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    configurations: int = 20,
    over: Over = "starts",
    progress: Progress | None = None,
) -> LawComparison | LawChoice:
    """Simulate the same motions under several control laws, without a failure and with each joint locked from the start.

    The laws receive no information about the failure. Each law is simulated by one call of
    :func:`holdfast.control.simulation.simulate`.

    With ``best=True`` the result ranks the laws by how often they reach the target. Every law meets the failures of
    :func:`holdfast.convergence_map` with the same starts, targets, configurations and seed. To find the best pre-failure error,
    give the failure-tolerant law with several values.

    Args:
        laws: Laws of one arm and task, of which the others are compared with the first; or a dictionary of laws by name. The
            default names are their labels, with ``best`` their phrases.
        q0: (n,) or (N, n) configurations at the start, rad and m, for example of :func:`holdfast.point_to_point`. With
            ``best``, the ``starts`` of :func:`holdfast.convergence_map`, for example 300 random places.
        target: One or N targets, (m,) or (N, m) positions, m, or (4, 4) or (N, 4, 4) poses, as for
            :func:`holdfast.control.simulation.simulate`. With ``best``, the ``targets`` of :func:`holdfast.convergence_map`.
        best: True to rank the laws by how often they reach their targets, instead of comparing them on given motions. Then
            ``failures``, ``cycles``, ``radius``, ``restarts`` and ``about`` must be left out.
        failures: ``"single"`` (each joint alone), or a list of joints by name or index from 0, each of which locks alone; None:
            no failures.
        cycles: True for discrete control cycles in place of continuous time.
        time_limit: Time limit of each run, s or cycles. Default: that of :func:`holdfast.control.simulation.simulate`.
        tolerance: Local error of a step of the adaptive method, rad (and m).
        radius: Radius of the target in cycles, m (and rad).
        restarts: Number of random starts of the search for the least error that a failed arm can have.
        seed: Seed of these random starts, with ``best`` of all random choices.
        about: Phrase for the report that describes the motions.
        clearance: Collision model of the arm, used with a cell, which it may contain. None: the default model. Every run is
            then checked for its first contact, which changes no run.
        cell: Objects around the arm, or their file.
        configurations: Number of motions for each place, with ``best``.
        over: Places of the map with ``best``: ``starts`` or ``targets``.
        progress: Function that is called with (runs done, runs in all), with ``best``.

    Returns:
        A :class:`holdfast.LawComparison`, with ``best`` a :class:`holdfast.LawChoice`.

    Raises:
        InputError: Wrong shapes or options, laws of different arms or tasks, or with ``best`` fewer than two laws.
        TaskError: A failure does not have exactly one joint.
    """
    law_by_name = dict(laws) if isinstance(laws, Mapping) else _index_by_label(laws, best)
    all_laws = tuple(law_by_name.values())
    if not all_laws:
        raise InputError("there is no law to compare; give one or more, for example hf.control.pseudoinverse(arm)")
    arm, task = all_laws[0].arm, all_laws[0].task
    for name, law in law_by_name.items():
        if law.arm.fingerprint != arm.fingerprint or not law.task.same_rows(task):
            raise InputError(f"law '{name}' has another arm or task than '{next(iter(law_by_name))}'; use one arm and task")
    if best:
        if failures != "single" or cycles or radius != TARGET_RADIUS_M or restarts != _DEFAULT_RESTARTS or about:
            raise InputError("failures, cycles, radius, restarts and about belong to given motions; leave them out with best")
        options: dict[str, Any] = {} if tolerance is None else {"tolerance": tolerance}
        options |= {"configurations": configurations, "over": over, "time_limit": time_limit, "seed": seed}
        return rank_laws(law_by_name, target, q0, progress, clearance=clearance, cell=cell, **options)
    joints = single_joints(arm, failures)
    starts, _ = as_configurations(arm, require_real_numbers(q0, "q0"))
    targets = require_real_numbers(target, "target")
    if not targets.ndim:
        raise InputError(f"target is {target!r}; give ({task.m},) or (4, 4) numbers, or rows of them")
    single = 2 if targets.shape[-2:] == (4, 4) else 1
    targets = targets[None] if targets.ndim == single else targets
    count = max(len(starts), len(targets)) if min(len(starts), len(targets)) else 0
    if not count or {len(starts), len(targets)} - {1, count}:
        raise InputError(f"q0 has {len(starts)} rows and target {len(targets)}; give the same number of each, or one for all")
    starts = np.broadcast_to(starts, (count, arm.n))
    targets = np.broadcast_to(targets, (count, *targets.shape[1:]))
    checked_clearance = chosen_clearance(arm, clearance or False, cell, looks=False)
    locked_joints = np.repeat(np.array([-1, *joints]), count)
    case_count = len(joints) + 1
    runs, costs = [], []
    with report_work("comparing control laws") as report_progress:
        for number, law in enumerate(all_laws):
            every_start, every_goal = np.tile(starts, (case_count, 1)), np.tile(targets, (case_count, *[1] * single))
            runs.append(
                simulate(
                    law,
                    every_start,
                    every_goal,
                    locked=locked_joints,
                    cycles=cycles,
                    time_limit=time_limit,
                    tolerance=DEFAULT_TOLERANCE if tolerance is None else tolerance,
                    radius=radius,
                    clearance=checked_clearance,
                )
            )
            poses = _to_poses(law, targets)
            costs.append(measure_healthy_cost(law, starts, poses, cycles, radius))
            report_progress(number + 1, len(all_laws) + 1)
        least_errors = _find_least_errors(
            runs, radius if cycles else target_error_threshold(all_laws[0]), restarts, seed
        ).reshape(case_count, count)
    failure_names = (HEALTHY_CASE, *[arm.joint_names[number] for number in joints])
    offsets = prescribed_offset(all_laws[0], arm.forward_kinematics(starts), poses)
    return LawComparison(
        laws=all_laws,
        names=tuple(law_by_name),
        failures=failure_names,
        runs=tuple(runs),
        least_error=least_errors,
        way=np.linalg.norm(offsets, axis=1),
        healthy=tuple(costs),
        about=about,
    )


def _index_by_label(laws: Sequence[Law], by_phrase: bool) -> dict[str, Law]:
    law_by_label: dict[str, Law] = {}
    for law in laws:
        label = law.phrase().replace(f", task {law.task.describe()}", "") if by_phrase else law.label
        if label in law_by_label:
            raise InputError(f"two laws have the name '{label}'; give a dictionary with different names")
        law_by_label[label] = law
    return law_by_label


def _to_poses(law: Law, targets: FloatArray) -> FloatArray:
    """Return targets as tool poses (N, 4, 4); the orientation of targets given as task components does not matter."""
    if targets.shape[-2:] == (4, 4):
        return check_poses(targets)
    poses = np.tile(np.eye(4), (len(targets), 1, 1))
    poses[:, :3, 3] = targets @ law.task.rows[:, :3]
    return poses


def _find_least_errors(runs: Sequence[Runs], accuracy: float, restarts: int, seed: int) -> FloatArray:
    """Return the least errors (F N,), which are common to all laws because joints lock at their initial values."""
    least_errors = np.full(len(runs[0]), np.inf)
    for law_runs in runs:
        least_errors = np.fmin(least_errors, np.where(law_runs.code == RunOutcome.CONVERGED, law_runs.error, np.inf))
    for number, law_runs in enumerate(runs):
        open_rows = np.flatnonzero((least_errors > accuracy) & np.isfinite(law_runs.q_final).all(axis=1))
        if open_rows.size:
            # The search starts from the ends of every law, but from random configurations only once.
            errors = _select_runs(law_runs, open_rows).least_error(restarts if number == 0 else 0, seed)
            least_errors[open_rows] = np.fmin(least_errors[open_rows], errors)
    return np.where(np.isfinite(least_errors), least_errors, np.nan)


def _select_runs(runs: Runs, rows: IndexArray) -> Runs:
    arrays: dict[str, Any] = {name: value[rows] for name, value in vars(runs).items() if isinstance(value, np.ndarray)}
    return replace(runs, **arrays)
