"""Which joint deserves the redundant motor or brake: what the arm would keep if one joint could never fail."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError
from holdfast.indices.index import Index
from holdfast.probability.distribution import Distribution
from holdfast.probability.intervals import Interval
from holdfast.status import Status

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Upgrade:
    """What a region would gain if one joint could never fail, at the same poses and configurations.

    Attributes:
        joint: Name of the joint.
        before: Probability that the index meets the threshold now.
        after: The same if no failure of this joint could happen.
        gain: ``after - before``: share of the poses that fail now and would not then.
        low, high: Interval of the gain. It is paired, because both samples are of the same poses: a failure less never makes
            a pose worse, so the gain is one share, with its exact interval.
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


def if_never_fails(index: Index, k: int, s: Sample) -> Distribution:
    """See :meth:`Assessment.if_never_fails`."""
    left = _remaining(index, k)
    if not left:
        raise InputError(
            f"every failure considered is one of '{index.arm.joint_names[k]}', so nothing could fail; assess with more failures"
        )
    values = s.by_failure[s.reached][:, left]
    worst = values.min(axis=1) if index.better == "larger" else values.max(axis=1)
    reached, missed = (None, ()) if s.weight is None else (s.weight[s.reached], s.weight[~s.reached])
    lost, singular = int((~s.reached).sum()), int((s.worst[s.reached] < 0).sum())
    return Distribution.of(worst, index.better, lost, singular=singular, weights=reached, unreached_weights=missed)


def upgrades(index: Index, d: Distribution, s: Sample, threshold: float, confidence: float) -> list[Upgrade]:
    """See :meth:`Assessment.upgrades`."""
    if not np.isfinite(threshold):
        raise InputError(f"threshold is {threshold:g}; it must be a finite number")
    larger = index.better == "larger"
    now = d.interval(at_least=threshold) if larger else d.interval(at_most=threshold)
    value = np.where(s.reached[:, None], s.by_failure, 0.0 if larger else np.inf)
    meets = value >= threshold if larger else value <= threshold
    fails = ~meets.all(axis=1)
    found = []
    for k, name in enumerate(index.arm.joint_names):
        left = _remaining(index, k)
        if not left or len(left) == len(index.failures):
            continue  # nothing would be left to fail, or nothing would change
        gained = fails & meets[:, left].all(axis=1)
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
