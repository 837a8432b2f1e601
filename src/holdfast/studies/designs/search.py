"""Search for designs: designs spread over the space, local searches with exact gradients, and a check on held-out poses."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress
from holdfast.core.sweeps.memory import Parts, SearchMemory
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.indices.own_file import plan_entries
from holdfast.kinematics.regions.region import Region, default_region
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.model.arms.serial import to_dict
from holdfast.model.failure_modes import FailureSpec
from holdfast.studies.designs.designs import Designs, HeldOutCheck, HeldOutResult, choose_best_design
from holdfast.studies.designs.evaluation import Evaluated, Evaluator
from holdfast.studies.designs.family import Family
from holdfast.studies.designs.gradient import sensitivity
from holdfast.studies.designs.quantile import compute_lower_quantile, compute_quantile_weights
from holdfast.studies.designs.reach import ReachEvaluator
from holdfast.studies.designs.space import DesignSpace, Vary, design_space

Progress = Callable[[int, int], None]

_FIRST_DESIGNS = 64  # designs that start from one another; all later ones start from the nearest of these
_CHUNK_DESIGNS = 128
_NEGLIGIBLE_WEIGHT = 1e-7  # weight of a pose in the smooth quantile below which its gradient is not computed
_MAX_ITERATIONS = 30  # iterations of a local search
_TRAIL_DESIGNS = 12  # designs of a local search from which the next ones can start
_RANDOM_STARTS_PER_STEP = 2  # random starts of each pose in every step of a local search
_DESIGNS_PER_LOCAL_SEARCH = 32  # number of designs that a local search counts in the progress


@check_arguments
@reports_progress("searching designs")
def design(
    arm: Arm,
    vary: Vary,
    objective: str = "relative-manipulability",
    *,
    region: Region | None = None,
    task: str | Task | Sequence[str] = "pose",
    level: float = 0.95,
    failures: FailureSpec = "single",
    length: float | None = None,
    poses: int = 256,
    designs: int = 512,
    local_searches: int = 8,
    check_poses: int = 2000,
    seed: int = 0,
    store: str | Path | None = None,
    progress: Progress | None = None,
) -> Designs:
    """Search for the arm with the largest index quantile over a region after the worst failure.

    The value of a design is the ``1 - level`` quantile, over the poses of the region, of the index at the best configuration
    of every pose (:func:`holdfast.optimise`); a pose that is not reached counts as 0. The search first compares designs that
    are spread over the bounds, as rows of the same kernels. Sequential quadratic programs with exact gradients then improve
    the best designs and designs along the Pareto front of value and reach. Self-collisions are not checked.

    Args:
        arm: The baseline arm; its values must lie within the bounds.
        vary: Varied parameters with bounds, rad and m, for example ``{"a3": (0.2, 0.6)}``, or any other form of
            :func:`holdfast.studies.designs.design_space`.
        objective: Name of an index that is better when larger.
        region: Region of the poses, which are the same for all designs. Default: that of :func:`holdfast.assess`.
        task: Rows of the pose that the configurations must reach.
        level: Fraction of the poses that have at least the quantile.
        failures: ``"single"``, ``"pairs"``, the number of joints that fail together, or a list of joints or sets of joints.
        length: Characteristic length of the task, m.
        poses: Number of poses on which designs are compared.
        designs: Number of designs that are spread over the bounds.
        local_searches: Number of local searches; the first half maximise the value, each of the others at a given reach.
        check_poses: Number of held-out poses of the final check.
        seed: Seed of all random numbers. The result does not depend on the number of threads.
        store: Folder from which a stopped search can be resumed.
        progress: Function that is called with (designs done, designs in all).

    Returns:
        A :class:`holdfast.Designs`.

    Raises:
        InputError: Options are out of range, or bounds and names do not fit the arm.
        TaskError: The index cannot be maximised, or the arm is not redundant for the task.
        StoreError: The folder contains other files.

    Source: Abdi et al. 2012, section IV, for the distribution; Harrell and Davis 1982 for the smooth quantile.
    """
    start_time = time.monotonic()
    if not 0 < level < 1:
        raise InputError(f"level is {level:g}; it must be between 0 and 1, for example 0.95")
    for option, count, minimum in (
        ("poses", poses, 1),
        ("designs", designs, 1),
        ("local_searches", local_searches, 0),
        ("check_poses", check_poses, 1),
    ):
        if count < minimum:
            raise InputError(f"{option} is {count}; it must be {minimum} or more")
    space = design_space(arm, vary)
    region = default_region(arm) if region is None else region
    family = Family(space, objective, task, failures=failures, length=length)
    search = _DesignSearch(family, region, level, poses, seed)
    plan = {
        "kind": "design",
        "arm": to_dict(arm),
        "vary": [parameter.option_text for parameter in space.parameters],
        **plan_entries(family.index),
        "task": [family.task.rows.tolist(), family.task.frame, family.task.length],
        "failures": [list(columns) for columns in family.index.failures],
        "region": region.to_dict(),
        "level": level,
        "poses": poses,
        "designs": designs,
        "climbs": local_searches,
        "fresh": check_poses,
        "seed": seed,
    }
    if store is not None and not region.storable:
        raise InputError(
            f"region '{region.name}' has a custom function, which cannot be stored in a folder; search without a store"
        )
    memory = None if store is None else SearchMemory(store, plan)

    def recall_part(name: str, make: Callable[[], Parts]) -> Parts:
        return make() if memory is None else memory.recall_or_compute(name, make)

    total, finished = designs + 1 + local_searches * _DESIGNS_PER_LOCAL_SEARCH, 0

    def advance(count: int) -> None:
        nonlocal finished
        finished += count
        if progress is not None:
            progress(finished, total)

    values = np.concatenate([space.start[None], space.draw(designs, seed)])
    chunks = []
    for number, first in enumerate([0, *range(_FIRST_DESIGNS, len(values), _CHUNK_DESIGNS)]):
        chunk = values[first : _FIRST_DESIGNS if first == 0 else first + _CHUNK_DESIGNS]
        chunks.append(recall_part(f"screen {number}", lambda c=chunk: search.evaluate_designs(c)))  # type: ignore[misc]
        if first == 0:
            search.set_neighbours(values[:_FIRST_DESIGNS])
        advance(len(chunk))
    screened = {name: np.concatenate([columns[name] for columns in chunks]) for name in chunks[0]}
    local_optima = []
    for number, (start_number, least_reach) in enumerate(
        _choose_local_starts(screened["smooth"], screened["reach"], values, space, local_searches)
    ):
        local_optima.append(
            recall_part(
                f"climb {number + 1}",
                lambda b=start_number, r=least_reach: {"values": search.search_locally(values[b], r)},  # type: ignore[misc]
            )["values"]
        )
        advance(_DESIGNS_PER_LOCAL_SEARCH)
    deepened_values = np.array([space.start, *local_optima])
    deepened = recall_part("deep", lambda: search.evaluate_thoroughly(deepened_values))
    # The baseline arm keeps its position, and is evaluated as thoroughly as the results of the local searches.
    merged = {name: np.concatenate([deepened[name][:1], screened[name][1:], deepened[name][1:]]) for name in screened}
    all_values = np.concatenate([values, deepened_values[1:]])
    best = choose_best_design(merged["guaranteed"], merged["reach"])
    checks = recall_part(f"check {best}", lambda: search.evaluate_held_out(all_values[[0, best]], check_poses))
    baseline, chosen = (
        HeldOutResult.from_values(
            checks["value"][position], checks["reached"][position], checks["weights"], level=level, heaviest=region.heaviest
        )
        for position in (0, 1)
    )
    return Designs(
        space=space,
        values=all_values,
        guaranteed=merged["guaranteed"],
        reach=merged["reach"],
        reached=merged["reached"],
        front=find_pareto_front(merged["reach"], merged["guaranteed"]),
        best=best,
        checked=HeldOutCheck(baseline, chosen, float(merged["guaranteed"][best] - chosen.guaranteed.value)),
        index=family.numeric_index,
        region=region,
        level=level,
        poses=poses,
        screened=designs,
        climbs=len(local_optima),
        seed=seed,
        seconds=time.monotonic() - start_time,
        method=search.describe_method(designs, len(local_optima), check_poses),
    )


def find_pareto_front(reach: FloatArray, value: FloatArray) -> NDArray[np.intp]:
    """Return the numbers of the designs that are non-dominated in reach and value, from the shortest reach."""
    order = np.lexsort((-value, -reach))  # from the farthest reach; for equal reach the best value first
    front, best_value = [], -np.inf
    for number in order:
        if value[number] > best_value:
            front.append(int(number))
            best_value = value[number]
    return np.array(front[::-1], dtype=np.intp)


def sample_comparison_poses(region: Region, count: int, seed: int) -> tuple[FloatArray, FloatArray | None]:
    """Return the poses (P, 4, 4) on which designs are compared, and their weights (P,), or None if all are equal.

    The poses are low-discrepancy points for a box region, otherwise random.

    Raises:
        InputError: The region is one of joints.
    """
    return sample_poses(region, count, seed, "sobol" if region.kind == "box" else "random")


def sample_poses(region: Region, count: int, seed: int, sampling: Any = "random") -> tuple[FloatArray, FloatArray | None]:
    """Return poses (P, 4, 4) of a region and their weights (P,), or None if all are equal."""
    if region.kind == "joints":
        raise InputError("a region of joints fixes the configurations, so designs have no poses to reach; give a box of poses")
    samples: list[FloatArray] = []
    blocks = region.blocks(0, seed, sampling, count=count)
    while sum(len(sample) for sample in samples) < count:
        samples.append(next(blocks))
    sample = np.concatenate(samples)[:count]
    return region.poses(sample), region.weights(sample) if region.has_weights(count) else None


def _choose_local_starts(
    smooth: FloatArray, reach: FloatArray, values: FloatArray, space: DesignSpace, local_searches: int
) -> list[tuple[int, float]]:
    """Return the starts of the local searches, each with its least reach: the best distinct designs, and those for a reach."""
    fractions = (values - space.lower) / (space.upper - space.lower)
    order = np.argsort(-smooth, kind="stable")
    distinct: list[int] = []
    for distance in (0.5, 0.0):  # root mean square distance, as a fraction of a side of the unit cube
        for number in order:
            if len(distinct) == -(-local_searches // 2):
                break
            if number not in distinct and all(
                np.sqrt(np.mean((fractions[number] - fractions[other]) ** 2)) >= distance / 2 for other in distinct
            ):
                distinct.append(int(number))
    starts = [(number, -np.inf) for number in distinct]
    missing = local_searches - len(starts)
    if missing > 0:
        shortest, longest = float(reach[order[0]]), float(reach.max())
        for least_reach in np.linspace(shortest, longest, missing + 2)[1:-1]:
            eligible = np.flatnonzero(reach >= least_reach)
            starts.append((int(eligible[np.argmax(smooth[eligible])]), float(least_reach)))
    return starts


class _DesignSearch:
    """Evaluation and local search of designs of a family at the poses of a region."""

    def __init__(self, family: Family, region: Region, level: float, poses: int, seed: int) -> None:
        self.family, self.region, self.level, self.seed = family, region, level, seed
        sampled_poses, self._weights = sample_comparison_poses(region, poses, seed)
        self.evaluator = Evaluator(family, sampled_poses, seed)
        self._reach_evaluator = ReachEvaluator(family, seed)
        self._first_values: FloatArray | None = None
        self._first_evaluated: Evaluated | None = None

    def set_neighbours(self, values: FloatArray) -> None:
        """Set the designs from whose configurations later designs start."""
        self._first_values = values

    @property
    def _neighbour_results(self) -> Evaluated | None:
        """Designs from which others start, computed again after resuming from a folder, which stores no configurations."""
        if self._first_evaluated is None and self._first_values is not None:
            self._first_evaluated = self.evaluator(self._first_values)
        return None if self._first_values is None else self._first_evaluated

    def evaluate_designs(self, values: FloatArray) -> Parts:
        """Return the measures of designs."""
        evaluated = self.evaluator(values, self._neighbour_results)
        if self._first_values is None:
            self._first_evaluated = evaluated
        return self._compute_measures(evaluated)

    def _compute_measures(self, evaluated: Evaluated) -> Parts:
        extended = evaluated.signed_index
        weights = np.ones(extended.shape[1]) if self._weights is None else self._weights
        return {
            "smooth": (compute_quantile_weights(extended, self.level, self._weights) * extended).sum(axis=1),
            "guaranteed": compute_lower_quantile(evaluated.value, self.level, self._weights),
            "reached": evaluated.reached @ weights / weights.sum(),
            "reach": self._reach_evaluator(evaluated.values, self.evaluator.finite_limits(evaluated.values))[0],
        }

    def search_locally(self, start: FloatArray, least_reach: float) -> FloatArray:
        """Return the best design (k,) near a start with a reach of at least ``least_reach``, m."""
        from scipy.optimize import minimize

        space = self.family.space
        width = space.upper - space.lower
        trail: list[Evaluated] = [self.evaluator(start[None], self._neighbour_results)]
        point_cache: dict[bytes, tuple[float, FloatArray, float, FloatArray]] = {}
        trials: list[tuple[float, float, FloatArray]] = []

        def evaluate_point(u: FloatArray) -> tuple[float, FloatArray, float, FloatArray]:
            """Return the smooth quantile and the reach with their gradients, at a point of the unit cube."""
            key = u.tobytes()
            if key not in point_cache:
                trial_values = np.clip(space.lower + u * width, space.lower, space.upper)
                evaluated = self.evaluator(
                    trial_values[None], Evaluated.concatenate(trail[:1] + trail[1:][-_TRAIL_DESIGNS:]), _RANDOM_STARTS_PER_STEP
                )
                trail.append(evaluated)
                value, gradient = self.evaluate_smooth_quantile(evaluated)
                reach, by_design = self._reach_evaluator(trial_values[None], self.evaluator.finite_limits(trial_values[None]))
                point_cache[key] = value, gradient * width, float(reach[0]), by_design[0] * width
                trials.append((value, float(reach[0]), trial_values))
            return point_cache[key]

        long_enough: Any = {
            "type": "ineq",
            "fun": lambda u: evaluate_point(u)[2] - least_reach,
            "jac": lambda u: evaluate_point(u)[3],
        }
        minimize(  # type: ignore[call-overload]
            lambda u: -evaluate_point(u)[0],
            np.clip((start - space.lower) / width, 0.0, 1.0),
            jac=lambda u: -evaluate_point(u)[1],
            bounds=[(0.0, 1.0)] * len(width),
            constraints=[long_enough] if np.isfinite(least_reach) else [],
            method="SLSQP",
            options={"maxiter": _MAX_ITERATIONS, "ftol": 1e-6},
        )
        feasible = [(value, design_values) for value, reach, design_values in trials if reach >= least_reach - 1e-6]
        return max(feasible, key=lambda entry: entry[0])[1] if feasible else start

    def evaluate_smooth_quantile(self, evaluated: Evaluated) -> tuple[float, FloatArray]:
        """Return the smooth quantile of one design, and its exact gradient (k,)."""
        extended = evaluated.signed_index[0]
        weights = compute_quantile_weights(extended[None], self.level, self._weights)[0]
        rows = np.flatnonzero(weights > _NEGLIGIBLE_WEIGHT)
        sensitivities = sensitivity(self.evaluator, evaluated, rows)
        extended[rows] = sensitivities.value
        weights = compute_quantile_weights(extended[None], self.level, self._weights)[0]
        return float(weights @ extended), weights[rows] @ sensitivities.gradient

    def evaluate_thoroughly(self, values: FloatArray) -> Parts:
        """Return the measures of designs, each searched from the number of random starts of :func:`holdfast.optimise`."""
        neighbours = self.evaluator(values, self._neighbour_results)
        return self._compute_measures(self.evaluator(values, neighbours, self.evaluator.starts))

    def evaluate_held_out(self, values: FloatArray, count: int) -> Parts:
        """Return index (D, P), reached (D, P), and weights (P,) if any, of designs on held-out poses, from random starts."""
        seed = int(np.random.SeedSequence(self.seed, spawn_key=(6,)).generate_state(1)[0])
        poses, weights = sample_poses(self.region, count, seed, "random")
        evaluator = Evaluator(self.family, poses, seed)
        evaluated = Evaluated.concatenate([evaluator(design_values[None]) for design_values in values])
        return {"value": evaluated.value, "reached": evaluated.reached, "weights": np.empty(0) if weights is None else weights}

    def describe_method(self, designs: int, local_searches: int, check_poses: int) -> list[tuple[str, str]]:
        """Return the description of the method for reports, as pairs of titles and texts."""
        return [
            ("Designs", f"the baseline arm and {designs:,} scrambled Sobol points within the bounds, one kernel for all"),
            (
                "Configurations",
                "the best found for each design and pose, from the configurations of the two nearest designs and a few random "
                "starts; many random starts for the baseline arm and the results of local searches",
            ),
            (
                "Local searches",
                f"{local_searches}: sequential quadratic programs (SLSQP) on the Harrell-Davis estimate of the quantile, with "
                "exact gradients; half of them maximise the quantile, half maximise it beyond a given reach",
            ),
            (
                "Unreached poses",
                "count as 0; in the local searches as minus the norm of the smallest pose error found, m and rad",
            ),
            ("Check", f"{check_poses:,} held-out random poses; interval of the quantile by order statistics"),
            ("Not checked", "self-collision, and the masses of the links"),
        ]
