"""Which joint deserves the redundant motor or brake: what the arm would keep if one joint could never fail."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.poses import rotations_of_quaternions
from holdfast.assessment.plan import Plan
from holdfast.errors import InputError
from holdfast.indices.index import Index
from holdfast.probability.distribution import Distribution
from holdfast.probability.intervals import Interval
from holdfast.solvers.optima import optimise
from holdfast.status import Status

Array = NDArray[np.float64]

MOST_OPTIMISED_AGAIN = 500  # poses; each is optimised once for each joint, which takes 1 to 2 ms of two threads


@dataclass(frozen=True, kw_only=True)
class Upgrade:
    """The gain of a region if one joint could never fail, at the same poses.

    Without optimisation the configurations are the same; with it they are optimised again for the failures that remain.

    Attributes:
        joint: Name of the joint.
        before: Probability that the index meets the threshold now.
        after: The same if no failure of this joint could happen.
        gain: ``after - before``: fraction of the poses that fail now and would not then.
        low, high: Interval of the gain. It is paired, because both samples are of the same poses: a failure less never makes
            a pose worse, so the gain is one fraction, with its exact interval.
        confidence: Of the interval.
    """

    joint: str
    before: float
    after: float
    gain: float
    low: float
    high: float
    confidence: float


@dataclass(frozen=True)
class Sample:
    """The computed poses of a run at one choice of configurations.

    Attributes:
        number: (N,) which row of the dataset.
        reached: (N,) has a configuration.
        q: (N, n) configurations, NaN where there is none.
        value: (N,) the index.
        by_failure: (N, F) the index after each failure.
        worst: (N,) position of the worst failure; -1 where there is none.
        weight: (N,) how much each pose counts, or None if all count alike.
    """

    number: NDArray[np.int64]
    reached: NDArray[np.bool_]
    q: Array
    value: Array
    by_failure: Array
    worst: NDArray[np.int64]
    weight: Array | None

    @property
    def first(self) -> Sample:
        """The first 500 poses: those that are optimised again without each joint."""
        kept: dict[str, Any] = {f.name: getattr(self, f.name) for f in fields(self)}
        return replace(self, **{name: x[:MOST_OPTIMISED_AGAIN] for name, x in kept.items() if x is not None})


def sample(index: Index, columns: Mapping[str, Any], optimised: bool) -> Sample:
    """The rows of a run by its columns.

    At the best configurations the values after each failure are not stored but computed again, which costs less than reading.
    """
    status = columns["status"][:]
    keep = np.flatnonzero(status != Status.NOT_COMPUTED)
    reached = np.isin(status[keep], (Status.OK, Status.SINGULAR))
    if (
        optimised and "optimised_status" in columns
    ):  # where every configuration brings the arm into collision with itself there is no best one
        reached &= columns["optimised_status"][:][keep] != Status.INFEASIBLE
    weight = columns["weight"][:][keep] if "weight" in columns else None
    before = "optimised_" if optimised else ""
    q = columns[f"{before}q"][:][keep]
    if optimised:
        by_failure = np.full((len(keep), len(index.failures)), np.nan)
        by_failure[reached] = index.by_joint(q[reached])
    else:
        by_failure = columns["by_failure"][:][keep]
    value, worst = columns[f"{before}index"][:][keep], columns[f"{before}worst"][:][keep].astype(np.int64)
    return Sample(keep, reached, q, value, by_failure, worst, weight)


def value_without(index: Index, k: int, s: Sample) -> Array:
    """Compute the worst case (N,) over the failures in which joint k, from 0, has no part; NaN where no pose is reached.

    Raises:
        InputError: No such failure is left.
    """
    left = _remaining(index, k)
    if not left:
        raise InputError(
            f"every failure considered is one of '{index.arm.joint_names[k]}', so nothing could fail; assess with more failures"
        )
    values = s.by_failure[:, left]
    return np.asarray(values.min(axis=1) if index.better == "larger" else values.max(axis=1))


def optimised_value_without(plan: Plan, columns: Mapping[str, Any], k: int, s: Sample) -> Array:
    """Compute what :func:`value_without` does, at configurations optimised again for the failures that remain.

    The configuration optimised for all failures is the first start, so the value is never worse than there.
    """
    value = value_without(plan.index, k, s)
    left = _remaining(plan.index, k)
    some = s.number[s.reached]
    if len(left) == len(plan.index.failures) or not some.size:
        return value
    poses = np.tile(np.eye(4), (some.size, 1, 1))
    poses[:, :3, 3] = columns["position"][:][some]
    poses[:, :3, :3] = rotations_of_quaternions(columns["quaternion"][:][some])
    found = optimise(
        plan.arm,
        poses,
        plan.index.with_failures([plan.index.failures[i] for i in left]),
        seed=plan.seed,
        restarts=plan.restarts,
        clearance=plan.clearance,
        margin=plan.margin,
        initial=s.q[s.reached],
    )
    better = np.fmax if plan.index.better == "larger" else np.fmin
    value[s.reached] = better(value[s.reached], found.value)
    return value


def distribution_without(index: Index, s: Sample, value: Array) -> Distribution:
    """Build the distribution of values (N,) of the sampled poses."""
    reached, missed = (None, ()) if s.weight is None else (s.weight[s.reached], s.weight[~s.reached])
    lost, singular = int((~s.reached).sum()), int((s.worst[s.reached] < 0).sum())
    return Distribution.of(value[s.reached], index.better, lost, singular=singular, weights=reached, unreached_weights=missed)


def upgrades(index: Index, s: Sample, without: Callable[[int], Array], threshold: float, confidence: float) -> list[Upgrade]:
    """Compute :meth:`Assessment.upgrades` from the values (N,) that remain without each joint."""
    if not np.isfinite(threshold):
        raise InputError(f"threshold is {threshold:g}; it must be a finite number")
    larger = index.better == "larger"
    d = distribution_without(index, s, s.value)
    now = d.interval(at_least=threshold) if larger else d.interval(at_most=threshold)

    def meets(value: Array) -> NDArray[np.bool_]:
        return np.asarray(s.reached & (value >= threshold if larger else value <= threshold))

    found = []
    for k, name in enumerate(index.arm.joint_names):
        left = _remaining(index, k)
        if not left or len(left) == len(index.failures):
            continue  # nothing would be left to fail, or nothing would change
        gained = ~meets(s.value) & meets(without(k))
        if s.weight is None:
            gain = Interval.of(int(gained.sum()), d.samples, confidence)
        else:
            gain = Interval.of_share(min(float(s.weight[gained].sum()) / d.total_weight(), 1.0), d.effective(), confidence)
        found.append(
            Upgrade(
                joint=name,
                before=now.value,
                after=now.value + gain.value,
                gain=gain.value,
                low=gain.low,
                high=gain.high,
                confidence=confidence,
            )
        )
    return sorted(found, key=lambda u: -u.gain)


def _remaining(index: Index, k: int) -> list[int]:
    """Positions of the failures in which joint k, from 0, has no part."""
    return [i for i, failed in enumerate(index.failures) if k not in failed]


def check_rates(arm: Arm, rates: Mapping[Any, float]) -> Array:
    """Failure rates (n,) of all joints; see :meth:`Assessment.expected_survival`."""
    weights = np.zeros(arm.n)
    for joint, rate in rates.items():
        weights[arm.joint_index(joint)] = rate
    if not np.isfinite(weights).all() or (weights < 0).any() or weights.sum() <= 0:
        raise InputError("failure rates must be finite numbers of 0 or more, at least one of them above 0")
    return weights
