"""Ranking of joints for a redundant motor or brake by the fault tolerance of the arm if one joint could never fail."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.probability.distribution import Distribution
from holdfast.core.probability.intervals import Interval
from holdfast.core.status import Status
from holdfast.core.typing import FloatArray
from holdfast.kinematics.indices.index import Index
from holdfast.kinematics.solvers.optima import optimise
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import rotations_of_quaternions
from holdfast.studies.assessment.plan import AssessmentPlan

MAX_REOPTIMISED_POSES = 500  # poses; each is optimised once for each joint, which takes 1 to 2 ms of two threads


@dataclass(frozen=True, kw_only=True)
class Upgrade:
    """Gain in the probability of an index over a region if one joint could never fail, at the same poses.

    Without optimisation the configurations are the same; with it they are optimised again for the remaining failures.

    Attributes:
        joint: Name of the joint.
        before: Probability that the index meets the threshold with all failures.
        after: Probability that it meets the threshold without failures of this joint.
        gain: ``after - before``, the fraction of the poses that fail with, but not without, failures of this joint.
        low: Lower limit of the exact interval of the gain. The interval is paired because both samples have the same poses.
            Excluding a failure never makes a pose worse, so the gain is a single fraction.
        high: Upper limit of this interval.
        confidence: Confidence level of the interval.
    """

    joint: str
    before: float
    after: float
    gain: float
    low: float
    high: float
    confidence: float


@dataclass(frozen=True)
class RunSample:
    """Computed poses of a run at one choice of configurations.

    Attributes:
        number: (N,) row of the dataset.
        reached: (N,) True for poses with a configuration.
        q: (N, n) configurations, rad and m; NaN for poses without one.
        value: (N,) index.
        by_failure: (N, F) index after each failure.
        worst: (N,) position of the worst failure; -1 if there is none.
        weight: (N,) weight of each pose; None if all poses have the same weight.
    """

    number: NDArray[np.int64]
    reached: NDArray[np.bool_]
    q: FloatArray
    value: FloatArray
    by_failure: FloatArray
    worst: NDArray[np.int64]
    weight: FloatArray | None

    @property
    def first_poses(self) -> RunSample:
        """First 500 poses, which are optimised again without each joint."""
        values: dict[str, Any] = {entry.name: getattr(self, entry.name) for entry in fields(self)}
        return replace(self, **{name: column[:MAX_REOPTIMISED_POSES] for name, column in values.items() if column is not None})


def make_run_sample(index: Index, columns: Mapping[str, Any], optimised: bool) -> RunSample:
    """Return the sample of a run from its columns.

    At the best configurations the values after each failure are not stored but computed again, which is faster than reading.
    """
    status = columns["status"][:]
    computed = np.flatnonzero(status != Status.NOT_COMPUTED)
    reached = np.isin(status[computed], (Status.OK, Status.SINGULAR))
    if optimised and "optimised_status" in columns:  # without a collision-free configuration there is no best one
        reached &= columns["optimised_status"][:][computed] != Status.INFEASIBLE
    weight = columns["weight"][:][computed] if "weight" in columns else None
    prefix = "optimised_" if optimised else ""
    q = columns[f"{prefix}q"][:][computed]
    if optimised:
        by_failure = np.full((len(computed), len(index.failures)), np.nan)
        by_failure[reached] = index.by_joint(q[reached])
    else:
        by_failure = columns["by_failure"][:][computed]
    value, worst = columns[f"{prefix}index"][:][computed], columns[f"{prefix}worst"][:][computed].astype(np.int64)
    return RunSample(computed, reached, q, value, by_failure, worst, weight)


def compute_index_excluding_joint(index: Index, joint: int, run_sample: RunSample) -> FloatArray:
    """Compute the worst case (N,) over the failures without a joint, given by its index; NaN for poses that are not reached.

    Raises:
        InputError: No failure remains.
    """
    remaining = _failures_excluding_joint(index, joint)
    if not remaining:
        raise InputError(
            f"every failure includes '{index.arm.joint_names[joint]}', so no failure remains without it; assess with more "
            f"failures"
        )
    values = run_sample.by_failure[:, remaining]
    return np.asarray(values.min(axis=1) if index.better == "larger" else values.max(axis=1))


def optimise_index_excluding_joint(
    plan: AssessmentPlan, columns: Mapping[str, Any], joint: int, run_sample: RunSample
) -> FloatArray:
    """Compute the values of :func:`compute_index_excluding_joint` at configurations optimised for the remaining failures.

    The configuration optimised for all failures is the first start, so the value is never worse than at this configuration.
    """
    value = compute_index_excluding_joint(plan.index, joint, run_sample)
    remaining = _failures_excluding_joint(plan.index, joint)
    numbers = run_sample.number[run_sample.reached]
    if len(remaining) == len(plan.index.failures) or not numbers.size:
        return value
    poses = np.tile(np.eye(4), (numbers.size, 1, 1))
    poses[:, :3, 3] = columns["position"][:][numbers]
    poses[:, :3, :3] = rotations_of_quaternions(columns["quaternion"][:][numbers])
    solutions = optimise(
        plan.arm,
        poses,
        plan.index.with_failures([plan.index.failures[position] for position in remaining]),
        seed=plan.seed,
        restarts=plan.restarts,
        clearance=plan.clearance,
        margin=plan.margin,
        initial=run_sample.q[run_sample.reached],
    )
    better = np.fmax if plan.index.better == "larger" else np.fmin
    value[run_sample.reached] = better(value[run_sample.reached], solutions.value)
    return value


def make_sample_distribution(index: Index, run_sample: RunSample, value: FloatArray) -> Distribution:
    """Build the distribution of values (N,) of the sampled poses."""
    reached, unreached = (
        (None, ())
        if run_sample.weight is None
        else (run_sample.weight[run_sample.reached], run_sample.weight[~run_sample.reached])
    )
    lost_count, singular = int((~run_sample.reached).sum()), int((run_sample.worst[run_sample.reached] < 0).sum())
    return Distribution.from_values(
        value[run_sample.reached], index.better, lost_count, singular=singular, weights=reached, unreached_weights=unreached
    )


def rank_upgrades(
    index: Index,
    run_sample: RunSample,
    values_excluding_joint: Callable[[int], FloatArray],
    threshold: float,
    confidence: float,
) -> list[Upgrade]:
    """Compute :meth:`Assessment.upgrades` from the values (N,) without failures of each joint."""
    if not np.isfinite(threshold):
        raise InputError(f"threshold is {threshold:g}; it must be a finite number")
    larger_is_better = index.better == "larger"
    distribution = make_sample_distribution(index, run_sample, run_sample.value)
    probability = distribution.interval(at_least=threshold) if larger_is_better else distribution.interval(at_most=threshold)

    def meets_threshold(value: FloatArray) -> NDArray[np.bool_]:
        return np.asarray(run_sample.reached & (value >= threshold if larger_is_better else value <= threshold))

    gains = []
    for joint, name in enumerate(index.arm.joint_names):
        remaining = _failures_excluding_joint(index, joint)
        if not remaining or len(remaining) == len(index.failures):
            continue  # no failure would remain, or none would be excluded
        gained = ~meets_threshold(run_sample.value) & meets_threshold(values_excluding_joint(joint))
        if run_sample.weight is None:
            gain = Interval.from_counts(int(gained.sum()), distribution.samples, confidence)
        else:
            gain = Interval.of_share(
                min(float(run_sample.weight[gained].sum()) / distribution.total_weight(), 1.0),
                distribution.effective(),
                confidence,
            )
        gains.append(
            Upgrade(
                joint=name,
                before=probability.value,
                after=probability.value + gain.value,
                gain=gain.value,
                low=gain.low,
                high=gain.high,
                confidence=confidence,
            )
        )
    return sorted(gains, key=lambda entry: -entry.gain)


def _failures_excluding_joint(index: Index, joint: int) -> list[int]:
    """Return the positions of the failures that do not include a joint, from 0."""
    return [position for position, failed in enumerate(index.failures) if joint not in failed]


def check_failure_rates(arm: Arm, rates: Mapping[Any, float]) -> FloatArray:
    """Return the failure rates (n,) of all joints; see :meth:`Assessment.expected_survival`."""
    weights = np.zeros(arm.n)
    for joint, rate in rates.items():
        weights[arm.joint_index(joint)] = rate
    if not np.isfinite(weights).all() or (weights < 0).any() or weights.sum() <= 0:
        raise InputError("failure rates must be finite numbers of 0 or more, at least one of them above 0")
    return weights
