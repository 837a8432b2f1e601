"""Search for arms whose joints sweep as far as possible on one self-motion, so that the pose stays reachable after any lock."""

from __future__ import annotations

import time
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError, TaskError
from holdfast.core.progress import ProgressCount, reports_progress
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.studies.designs.family import Family
from holdfast.studies.designs.space import Vary, design_space
from measurements.record_designs.found import EvolvedDesign
from measurements.record_designs.strategy import minimise_by_evolution
from measurements.record_designs.sweeps import SelfMotionTracer

_POPULATION_SIZE = 48
_TRACE_SPACING_RAD = 0.1  # rad
_FINAL_SPACING_RAD = 0.02  # long steps may pass from one curve to another
_FULL_SIZE_TOLERANCE = 1e-6  # of a turn
_WINDING_BONUS = 1e-3  # turns that a joint that winds is worth more than one that turns all the way and back


@check_arguments
@reports_progress("searching designs")
def design_for_self_motion(
    arm: Arm, vary: Vary, *, task: str | Task | Sequence[str] = "pose", generations: int = 150, restarts: int = 3, seed: int = 0
) -> EvolvedDesign:
    """Search for an arm and a pose with a self-motion on which the joints sweep farthest: at most all joints, a full revolution
    each.

    Where all do, the pose stays within reach whatever joint locks, at whatever angle, and all these configurations are on one
    curve. Of equal sums more joints that wind are better: those take every angle, whatever the spacing of the points. A pose
    of full size may lie in a small pocket; nothing is said of others.

    Args:
        arm: Of revolute joints, one more than the task has rows; its own limits hold.
        vary: What is varied, and between which bounds, m and rad, as for :func:`holdfast.design`.
        task: Rows of the pose to keep.
        generations: Of each search, 48 designs each.
        restarts: Searches, until every joint winds.
        seed: Of all draws.

    Raises:
        InputError: Prismatic joints, or counts below 1.
        TaskError: The redundancy is not 1.

    Source: Almarkhi and Maciejewski, RA-L 2020, for the size; the search is ours.
    """
    start_time = time.monotonic()
    if generations < 1 or restarts < 1:
        raise InputError(f"generations is {generations} and restarts {restarts}; give at least 1")
    space = design_space(arm, vary)
    family = Family(space, task=task)
    if arm.n - family.task.m != 1:
        raise TaskError(
            f"'{arm.name}' has {arm.n} joints and the task {family.task.m} rows; the size of a self-motion is that of a curve, "
            f"of {family.task.m + 1} joints"
        )
    if family.prismatic.any():
        raise InputError(f"'{arm.name}' has prismatic joints, which have no turns; vary an arm of revolute joints")
    tracer, rng, history = SelfMotionTracer(family), np.random.default_rng(seed), list[float]()
    parameter_count = len(space.start)

    def mirror_into_bounds(x: FloatArray) -> FloatArray:
        """Return designs (P, k) within their bounds; values beyond a bound are mirrored."""
        folded = np.mod(x[:, :parameter_count], 2)
        return np.asarray(space.lower + np.where(folded > 1, 2 - folded, folded) * (space.upper - space.lower))

    def measure_revolutions(values: FloatArray, q: FloatArray, spacing: float) -> tuple[FloatArray, NDArray[np.int64]]:
        curves = tracer(values, q, spacing)
        return curves.ranges.sum(axis=1) / (2 * np.pi), curves.winding

    def compute_cost(x: FloatArray) -> FloatArray:
        revolutions, winding = measure_revolutions(mirror_into_bounds(x), x[:, parameter_count:], _TRACE_SPACING_RAD)
        return np.asarray(-revolutions - _WINDING_BONUS * (winding != 0).sum(axis=1))

    initial_configurations = rng.uniform(-np.pi, np.pi, (_POPULATION_SIZE, arm.n))
    baseline_value = float(
        measure_revolutions(np.tile(space.start, (_POPULATION_SIZE, 1)), initial_configurations, _FINAL_SPACING_RAD)[0].max()
    )
    best: tuple[float, float, FloatArray] | None = None
    full_score = arm.n * (1 + _WINDING_BONUS) - _FULL_SIZE_TOLERANCE
    with ProgressCount("generations", restarts * generations, most=True) as advance:

        def record_generation(least_cost: float) -> bool:
            advance(1)
            history.append(max(-least_cost, history[-1] if history else 0.0))
            return -least_cost >= full_score

        for _ in range(restarts):
            start_point = np.concatenate([rng.uniform(0.2, 0.8, parameter_count), rng.uniform(-np.pi, np.pi, arm.n)])
            deviations = np.concatenate([np.full(parameter_count, 0.25), np.full(arm.n, 1.5)])
            x, _ = minimise_by_evolution(
                compute_cost,
                start_point,
                deviations,
                population=_POPULATION_SIZE,
                generations=generations,
                rng=rng,
                on_generation=record_generation,
            )
            value, winding = measure_revolutions(mirror_into_bounds(x[None]), x[None, parameter_count:], _FINAL_SPACING_RAD)
            score = float(value[0]) + _WINDING_BONUS * float((winding != 0).sum())
            if best is None or score > best[0]:
                best = score, float(value[0]), x
            if best[0] >= full_score:
                break
    assert best is not None
    values, q = mirror_into_bounds(best[2][None]), np.mod(best[2][parameter_count:] + np.pi, 2 * np.pi) - np.pi
    return EvolvedDesign(
        space=space,
        objective="self-motion-size",
        values=values[0],
        value=best[1],
        given=baseline_value,
        bound=float(arm.n),
        q=q,
        winding=measure_revolutions(values, q[None], _FINAL_SPACING_RAD)[1][0],
        history=np.minimum(history, arm.n),
        seed=seed,
        seconds=time.monotonic() - start_time,
    )
