"""What a search of designs found."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.assess.distribution import Distribution
from holdfast.assess.region import Region
from holdfast.design.space import DesignSpace
from holdfast.indices import Index
from holdfast.interval import Interval

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Checked:
    """What an arm guarantees on fresh poses.

    Attributes:
        distribution: Of the index at the best configuration of every pose; one that is not reached counts as 0.
        guaranteed: The quantile, with its 95 % confidence interval.
    """

    distribution: Distribution
    guaranteed: Interval


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


@dataclass(frozen=True)
class Designs:
    """What :func:`holdfast.design` found: D designs, the given arm first.

    Attributes:
        space: What was varied.
        values: (D, k) rad and m.
        guaranteed: (D,) index that a share ``level`` of the poses of the search has at least.
        reach: (D,) largest distance of the tool point from the arm's base within the limits, m.
        reached: (D,) share of the poses with a configuration.
        front: Numbers of the designs that no other one beats in both reach and guaranteed value, by reach.
        best: Number of the design with the greatest guaranteed value.
        checked: The given arm and the best design on fresh poses.
        index: Of the given arm.
        region: The poses; the same for all designs.
        level: Share of the poses for which the value is guaranteed.
        poses: Number of poses of the search.
        screened: Designs spread over the space.
        climbs: Climbs from the best of them.
        seed: Of everything random.
        seconds: Time it took, or None where it went on from a folder.
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
