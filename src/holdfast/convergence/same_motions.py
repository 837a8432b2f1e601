"""Several control laws on the same motions: the runs that a comparison is made of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, real_numbers
from holdfast.arm.configurations import as_configurations
from holdfast.arm.poses import check_poses
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.control.law import Law
from holdfast.convergence.detours import healthy_cost
from holdfast.convergence.law_comparison import HEALTHY, LawComparison, at_rest
from holdfast.errors import InputError
from holdfast.failures import FailureSpec, single_joints
from holdfast.notice import working
from holdfast.simulation.closed_loop import RADIUS, TOLERANCE, simulate
from holdfast.simulation.runs import Outcome, Runs
from holdfast.simulation.system import prescribed_way

Array = NDArray[np.float64]


@checked
def compare_laws(
    laws: Sequence[Law] | Mapping[str, Law],
    q0: ArrayLike,
    target: ArrayLike,
    *,
    failures: FailureSpec | None = "single",
    cycles: bool = False,
    time_limit: float | None = None,
    tolerance: float = TOLERANCE,
    radius: float = RADIUS,
    restarts: int = 24,
    seed: int = 0,
    about: str = "",
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
) -> LawComparison:
    """Run control laws over the same motions: with nothing failed, and with each joint locked from the start.

    Nobody tells the laws: see :func:`holdfast.simulation.simulate`, which this is one call of for each law.

    Args:
        laws: Laws of one arm and task, the first being the one that the others are compared with; or a
            dictionary of them by name. Without names they are called by their labels.
        q0: (n,) or (N, n) configurations at the start, rad and m; see also :func:`holdfast.point_to_point`.
        target: As :func:`holdfast.simulation.simulate` takes it, one or N.
        failures: ``"single"`` (each joint alone), or a list of joints by name or index from 0, each of which locks alone; None:
            no failures.
        cycles: As for :func:`holdfast.simulation.simulate`, and so the next three.
        time_limit: s or cycles.
        tolerance: Of the adaptive method.
        radius: Of the target in cycles, m (and rad).
        restarts: Random starts of the search for the least error that a failed arm can have.
        seed: Of these.
        about: What the motions are, a phrase for the report.
        clearance: As for :func:`holdfast.simulation.simulate`, and so ``cell``: every run is looked at, one after the
            other, for what it touches first; that changes none.
        cell: Objects around the arm, or their file.

    Raises:
        InputError: Wrong shapes or options; laws of different arms or tasks.
        TaskError: Failures that are not of one joint each.
    """
    named = dict(laws) if isinstance(laws, Mapping) else _by_label(laws)
    every = tuple(named.values())
    if not every:
        raise InputError("there is no law to compare; give one or more, for example hf.control.pseudoinverse(arm)")
    arm, task = every[0].arm, every[0].task
    for name, law in named.items():
        if law.arm is not arm or not law.task.same_rows(task):
            raise InputError(f"law '{name}' is of another arm or task than '{next(iter(named))}'; make both of the same")
    joints = single_joints(arm, failures)
    start, _ = as_configurations(arm, q0)
    goal = real_numbers(target, "target")
    if not goal.ndim:
        raise InputError(f"target is {target!r}; give ({task.m},) or (4, 4) numbers, or rows of them")
    single = 2 if goal.shape[-2:] == (4, 4) else 1
    goal = goal[None] if goal.ndim == single else goal
    count = max(len(start), len(goal)) if min(len(start), len(goal)) else 0
    if not count or {len(start), len(goal)} - {1, count}:
        raise InputError(f"q0 has {len(start)} rows and target {len(goal)}; give the same number of each, or one for all")
    start = np.broadcast_to(start, (count, arm.n))
    goal = np.broadcast_to(goal, (count, *goal.shape[1:]))
    looked = chosen_clearance(arm, clearance or False, cell, looks=False)
    stood = np.repeat(np.array([-1, *joints]), count)
    many = len(joints) + 1
    runs, costs = [], []
    with working("comparing control laws") as advance:
        for k, law in enumerate(every):
            every_start, every_goal = np.tile(start, (many, 1)), np.tile(goal, (many, *[1] * single))
            runs.append(
                simulate(
                    law,
                    every_start,
                    every_goal,
                    locked=stood,
                    cycles=cycles,
                    time_limit=time_limit,
                    tolerance=tolerance,
                    radius=radius,
                    clearance=looked,
                )
            )
            poses = _poses(law, goal)
            costs.append(healthy_cost(law, start, poses, cycles, radius))
            advance(k + 1, len(every) + 1)
        least = _least(runs, radius if cycles else at_rest(every[0]), restarts, seed).reshape(many, count)
    names = (HEALTHY, *[arm.joint_names[k] for k in joints])
    way = prescribed_way(every[0], arm.forward_kinematics(start), poses)
    return LawComparison(
        laws=every,
        names=tuple(named),
        failures=names,
        runs=tuple(runs),
        least_error=least,
        way=np.linalg.norm(way, axis=1),
        healthy=tuple(costs),
        about=about,
    )


def _by_label(laws: Sequence[Law]) -> dict[str, Law]:
    found: dict[str, Law] = {}
    for law in laws:
        if law.label in found:
            raise InputError(f"two laws are called '{law.label}'; give a dictionary with names of your own")
        found[law.label] = law
    return found


def _poses(law: Law, goal: Array) -> Array:
    """Targets as tool poses (N, 4, 4): of those given as the task's rows the turn does not matter."""
    if goal.shape[-2:] == (4, 4):
        return check_poses(goal)
    poses = np.tile(np.eye(4), (len(goal), 1, 1))
    poses[:, :3, 3] = goal @ law.task.rows[:, :3]
    return poses


def _least(runs: Sequence[Runs], accuracy: float, restarts: int, seed: int) -> Array:
    """(F N,) least errors: joints are locked where they started, so what one law's runs find is true for all of them."""
    least = np.full(len(runs[0]), np.inf)
    for r in runs:
        least = np.fmin(least, np.where(r.code == Outcome.CONVERGED, r.error, np.inf))
    for k, r in enumerate(runs):
        rows = np.flatnonzero((least > accuracy) & np.isfinite(r.q_final).all(axis=1))
        if rows.size:
            # From the ends of every law, but from random configurations once.
            found = _some(r, rows).least_error(restarts if k == 0 else 0, seed)
            least[rows] = np.fmin(least[rows], found)
    return np.where(np.isfinite(least), least, np.nan)


def _some(runs: Runs, rows: NDArray[np.int64]) -> Runs:
    arrays: dict[str, Any] = {name: value[rows] for name, value in vars(runs).items() if isinstance(value, np.ndarray)}
    return replace(runs, **arrays)
