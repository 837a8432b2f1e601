"""Result of a search for designs, and the choice of the best one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.formatting import format_number, format_percent
from holdfast.core.probability.distribution import Distribution
from holdfast.core.probability.intervals import Interval
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.kinematics.indices.index import Index
from holdfast.kinematics.regions.region import Region
from holdfast.model.arm.model import Arm
from holdfast.studies.designs.space import DesignSpace

SAME_VALUE_TOLERANCE = (
    1e-3  # fraction of the greatest value: closer quantiles print alike, and held-out poses hardly distinguish them
)
_ZERO_INDEX = 1e-6  # a smaller index is due to rounding
_ACCEPTABLE_LOSS = 0.05  # fraction of the quantile that a user might give up for reach
_WORTHWHILE_GAIN = 0.02  # fraction of the reach that is worth this loss


@dataclass(frozen=True)
class HeldOutResult:
    """Index of an arm on held-out poses, which is an estimate from a sample, not a proof.

    Attributes:
        distribution: Distribution of the index at the best configuration of every pose; a pose out of reach counts as 0.
        guaranteed: Lower quantile of the index over the poses, with its 95 % confidence interval.
    """

    distribution: Distribution
    guaranteed: Interval

    @classmethod
    def from_values(
        cls, value: FloatArray, reached: NDArray[Any], weights: FloatArray, *, level: float, heaviest: float = 0.0
    ) -> HeldOutResult:
        """Return the distribution on held-out poses, and its quantile with the order statistics that enclose it.

        With too few poses for one of them to be below the quantile with certainty (72 for a level of 0.95), the lower end is 0.

        Args:
            value: (P,) index at each pose.
            reached: (P,) True for reached poses.
            weights: (P,) weights of the poses; empty if all are equal.
            level: Fraction of the poses that have at least the quantile.
            heaviest: Largest weight that a pose can have.

        Source: David and Nagaraja 2003, section 7.1, for the interval.
        """
        from scipy.stats import binom

        is_reached = reached.astype(bool)
        if weights.size:
            distribution = Distribution.from_values(
                value[is_reached],
                "larger",
                int((~is_reached).sum()),
                weights=weights[is_reached],
                unreached_weights=weights[~is_reached],
                heaviest=heaviest,
            )
        else:
            distribution = Distribution.from_values(value[is_reached], "larger", int((~is_reached).sum()))
        sample_count, fraction, confidence = int(distribution.effective() + 1e-9), 1 - level, 0.95
        end_fractions = (
            np.asarray(binom.ppf([(1 - confidence) / 2, (1 + confidence) / 2], sample_count, fraction)) / sample_count
        )
        lower, middle, upper = distribution.quantile(
            np.clip([end_fractions[0], fraction, end_fractions[1] + 1 / sample_count], 0, 1), reachable_only=False
        ).tolist()
        return cls(
            distribution, Interval(value=middle, low=lower if end_fractions[0] > 0 else 0.0, high=upper, confidence=confidence)
        )


@dataclass(frozen=True)
class HeldOutCheck:
    """Baseline arm and best design on the same held-out poses, on which no choice was based.

    Attributes:
        given: Result of the baseline arm on these poses.
        best: Result of the best design on these poses.
        optimism: Amount by which the quantile of the best design was larger on the poses on which it was selected.
    """

    given: HeldOutResult
    best: HeldOutResult
    optimism: float


@dataclass(frozen=True, kw_only=True)
class Designs(Result):
    """Result of :func:`holdfast.design` with D designs, the baseline arm first.

    Attributes:
        space: Design space.
        values: (D, k) designs, rad and m.
        guaranteed: (D,) index that a fraction ``level`` of the poses of the search has at least; an estimate from a sample.
        reach: (D,) largest distance of the tool point from the arm's base within the limits, m.
        reached: (D,) fraction of the poses with a configuration.
        front: Numbers of the designs on the Pareto front of reach and ``guaranteed``, by reach.
        best: Number of the design with the greatest ``guaranteed``, or of the farthest-reaching one within 0.1 % of it.
        checked: Results of the baseline arm and the best design on held-out poses.
        index: Index of the baseline arm.
        region: Region of the poses, which are the same for all designs.
        level: Fraction of the poses that have at least the quantile.
        poses: Number of poses of the search.
        screened: Number of designs that were spread over the space.
        climbs: Number of local searches from the best of them.
        seed: Seed of all random numbers.
        seconds: Duration of this call, s, which is shorter than the search if it was resumed; None if not known.
        method: Description of the method for reports, as pairs of titles and texts.
    """

    space: DesignSpace
    values: FloatArray
    guaranteed: FloatArray
    reach: FloatArray
    reached: FloatArray
    front: NDArray[np.intp]
    best: int
    checked: HeldOutCheck
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
        """Quantile ``guaranteed`` of the baseline arm, in the unit of the index."""
        return float(self.guaranteed[0])

    @property
    def start_reach(self) -> float:
        """Reach of the baseline arm, m."""
        return float(self.reach[0])

    @property
    def best_is_start(self) -> bool:
        """True if no design beats the baseline arm."""
        return self.best == 0

    def arm(self, number: int | None = None) -> Arm:
        """Return the arm of the design with a ``number``, by default the best one."""
        return self.space.arm_of(self.values[self.best if number is None else number])


def format_level(fraction: float) -> str:
    """Format a fraction that the user chose, as percent."""
    return f"{100 * fraction:.4g} %"


def format_value_interval(interval: Interval) -> str:
    """Format a value with its interval."""
    return (
        f"{format_number(interval.value)} ({format_number(interval.low)} to {format_number(interval.high)}, "
        f"{100 * interval.confidence:.4g} %)"
    )


def choose_best_design(guaranteed: FloatArray, reach: FloatArray) -> int:
    """Return the number of the design with the greatest value (D,), or of the farthest-reaching one within 0.1 % of it.

    The first design, the baseline arm, stays the best unless another design has a larger value or reach.
    """
    is_equal = guaranteed >= (1 - SAME_VALUE_TOLERANCE) * guaranteed.max() - _ZERO_INDEX
    if is_equal[0] and reach[is_equal].max() <= (1 + SAME_VALUE_TOLERANCE) * reach[0]:
        return 0
    candidates = np.flatnonzero(is_equal)
    return int(candidates[np.lexsort((guaranteed[candidates], reach[candidates]))[-1]]) if guaranteed.max() > _ZERO_INDEX else 0


def describe_farther_design(guaranteed: FloatArray, reach: FloatArray, best: int) -> str:
    """Describe the design that reaches farthest for slightly less than the best quantile; the text is empty without one."""
    is_candidate = (guaranteed >= (1 - _ACCEPTABLE_LOSS) * guaranteed[best]) & (reach >= (1 + _WORTHWHILE_GAIN) * reach[best])
    if not guaranteed[best] > 0 or not is_candidate.any():
        return ""
    design = int(np.flatnonzero(is_candidate)[reach[is_candidate].argmax()])
    loss_text = format_percent(1 - guaranteed[design] / guaranteed[best])
    return (
        f"For {loss_text} less, {format_number(float(guaranteed[design]))} on the poses of the search, another design reaches "
        f"{reach[design]:.3f} m, {format_percent(reach[design] / reach[best] - 1)} farther."
    )
