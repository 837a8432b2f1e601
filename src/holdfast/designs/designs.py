"""The result of a search of designs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.designs.choice import SAME, farther
from holdfast.designs.space import DesignSpace
from holdfast.indices.index import Index
from holdfast.probability.distribution import Distribution
from holdfast.probability.intervals import Interval
from holdfast.regions.region import Region
from holdfast.result import Result
from holdfast.words import article, counted, number

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Checked:
    """The index of an arm on fresh poses: an estimate from a sample, not a proof.

    Attributes:
        distribution: Of the index at the best configuration of every pose; one that is not reached counts as 0.
        guaranteed: Lower quantile of the index over the poses, with its 95 % confidence interval.
    """

    distribution: Distribution
    guaranteed: Interval

    @classmethod
    def of(cls, value: Array, reached: NDArray[Any], weights: Array, *, level: float, heaviest: float = 0.0) -> Checked:
        """The distribution on fresh poses, and its quantile with the order statistics that enclose it.

        Of fewer poses than it takes for any to be below the quantile for sure (72 for a level of 0.95), the lower end is 0.

        Args:
            value: (P,) index of each pose.
            reached: (P,) whether it was reached.
            weights: (P,) of the poses; empty if all count alike.
            level: Share of the poses that have at least the quantile.
            heaviest: Largest weight that a pose can have.

        Source: David and Nagaraja 2003, section 7.1, for the interval.
        """
        from scipy.stats import binom

        there = reached.astype(bool)
        if weights.size:
            d = Distribution.of(
                value[there],
                "larger",
                int((~there).sum()),
                weights=weights[there],
                unreached_weights=weights[~there],
                heaviest=heaviest,
            )
        else:
            d = Distribution.of(value[there], "larger", int((~there).sum()))
        size, share, confidence = int(d.effective() + 1e-9), 1 - level, 0.95
        ends = np.asarray(binom.ppf([(1 - confidence) / 2, (1 + confidence) / 2], size, share)) / size
        low, middle, high = d.quantile(np.clip([ends[0], share, ends[1] + 1 / size], 0, 1), reachable_only=False).tolist()
        return cls(d, Interval(value=middle, low=low if ends[0] > 0 else 0.0, high=high, confidence=confidence))


@dataclass(frozen=True)
class Check:
    """The given arm and the best design on the same fresh poses, which no choice was made on.

    Attributes:
        given, best: Each on those poses.
        optimism: By how much the best design looked better on the poses it was chosen on.
    """

    given: Checked
    best: Checked
    optimism: float


@dataclass(frozen=True, kw_only=True)
class Designs(Result):
    """What :func:`holdfast.design` found: D designs, the given arm first.

    Attributes:
        space: What was varied.
        values: (D, k) rad and m.
        guaranteed: (D,) index that a share ``level`` of the poses of the search has at least.
        reach: (D,) largest distance of the tool point from the arm's base within the limits, m.
        reached: (D,) share of the poses with a configuration.
        front: Numbers of the designs that no other one beats in both reach and guaranteed value, by reach.
        best: Number of the design with the greatest guaranteed value; of several within 0.1 % of it the farthest-reaching one.
        checked: The given arm and the best design on fresh poses.
        index: Of the given arm.
        region: The poses; the same for all designs.
        level: Share of the poses for which the value is guaranteed.
        poses: Number of poses of the search.
        screened: Designs spread over the space.
        climbs: Climbs from the best of them.
        seed: Of everything random.
        seconds: Time this call took; less than the search where it went on from a folder. None if not known.
        method: How it was computed, for reports: words and texts.
    """

    space: DesignSpace
    values: Array
    guaranteed: Array
    reach: Array
    reached: Array
    front: NDArray[np.intp]
    best: int
    checked: Check
    index: Index
    region: Region
    level: float
    poses: int
    screened: int
    climbs: int
    seed: int
    seconds: float | None
    method: list[tuple[str, str]]

    @property
    def start_guaranteed(self) -> float:
        """Of the given arm."""
        return float(self.guaranteed[0])

    @property
    def start_reach(self) -> float:
        """Of the given arm, m."""
        return float(self.reach[0])

    @property
    def best_is_start(self) -> bool:
        """True where no design beats the given arm."""
        return self.best == 0

    def arm(self, number: int | None = None) -> Arm:
        """The arm of a design; the best one if no number is given."""
        return self.space.arm_of(self.values[self.best if number is None else number])

    @property
    def headline(self) -> str:
        """The answer in one or two sentences."""
        given, best = self.checked.given, self.checked.best
        gives, keeps = interval_text(given.guaranteed), interval_text(best.guaranteed)
        name, share = self.index.name, chosen(self.level)
        if not best.guaranteed.value > 0 and not given.guaranteed.value > 0:
            return (
                f"No design within these bounds keeps any {name} at {share} of the poses of the region: too many poses "
                "are not reached, or a joint whose lock ends the task remains. Widen the bounds, or give a smaller region or "
                "level."
            )
        more = farther(self.guaranteed, self.reach, self.best)
        if self.best_is_start:
            text = (
                f"No design was found that keeps more than the given arm: at {share} of the poses of the region its {name} "
                f"is at least {gives}, {self._failures()}."
            )
            return f"{text} {more}".rstrip()
        if self.guaranteed[self.best] <= (1 + SAME) * self.start_guaranteed:
            return (
                f"No design keeps more than the given arm, but the best one keeps as much, {keeps} "
                f"at {share} of the poses (the given arm {gives}), and reaches {self.reach[self.best]:.3f} m "
                f"instead of {self.start_reach:.3f} m. {more}"
            ).rstrip()
        if best.guaranteed.value <= given.guaranteed.value:
            return (
                f"No gain that lasts was found: on the {counted(self.poses, 'pose')} of the search the best design "
                f"keeps a {name} of {number(float(self.guaranteed[self.best]))}, but on fresh ones {keeps}, and the given "
                f"arm {gives}. Search with more poses."
            )
        reaches = f"The reach goes from {self.start_reach:.3f} m to {self.reach[self.best]:.3f} m."
        return (
            f"For {share} of the poses of the region the best design keeps {article(name)} {name} of at least "
            f"{keeps}, {self._failures()}; the given arm {gives}. {reaches} {more}"
        ).rstrip()

    def _failures(self) -> str:
        sizes = {len(f) for f in self.index.failures}
        if len(sizes) > 1 or len(self.index.failures) != math.comb(self.space.arm.n, min(sizes)):
            return "after any of the failures considered"
        return "whichever joint locks" if sizes == {1} else f"whichever {min(sizes)} joints lock together"

    def describe(self) -> list[str]:
        """A few sentences for people."""
        ends = f"{self.reach[self.front[0]]:.4g} to {self.reach[self.front[-1]]:.4g} m"
        return [
            self.headline,
            f"{len(self.values):,} designs tried; {len(self.front)} of them are on the Pareto front of reach and "
            f"{self.index.name}, reach {ends}",
        ]


def chosen(x: float) -> str:
    """A share that was chosen."""
    return f"{100 * x:.4g} %"


def interval_text(p: Interval) -> str:
    """A value with its interval."""
    return f"{number(p.value)} ({number(p.low)} to {number(p.high)}, {100 * p.confidence:.4g} %)"
