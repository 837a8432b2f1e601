"""Probability that a power loss in a random configuration stays harmless."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.falls.fall import MEASURE_UNITS, FallMeasure, PowerLoss, measure_fall
from holdfast.control.falls.power_cut import power_loss
from holdfast.core.errors import InputError
from holdfast.core.probability.intervals import Interval
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.status import Status
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.regions.region import Region
from holdfast.kinematics.solvers.inverse_kinematics import solve_ik
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance


@dataclass(frozen=True, kw_only=True)
class DropProbability(Result):
    """Fraction of random configurations in which a measure of the fall after a power loss stays at or below a limit.

    Attributes:
        fall: Falls from the N configurations.
        measure: ``drop``, ``released``, ``impact_speed`` or ``impact_energy``.
        below: Limit of the measure, in its unit.
        value: (N,) measure of each fall; NaN for a fall without contact, which has no impact and counts as below the limit, and
            infinity for a fall whose simulation failed, which counts as above.
        drawn: Number of configurations that were drawn; N of them are free of collisions.
        unreached: Number of poses of the region without a configuration.
        where: Description of the region.
    """

    fall: PowerLoss
    measure: FallMeasure
    below: float
    value: FloatArray
    drawn: int
    unreached: int
    where: str

    @property
    def unit(self) -> str:
        """Unit of the measure."""
        return MEASURE_UNITS[self.measure]

    def interval(self, below: float | None = None, confidence: float = 0.95) -> Interval:
        """Return the fraction of falls at or below a limit (default: ``below``) with its Clopper-Pearson interval."""
        limit = self.below if below is None else below
        return Interval.from_counts(int(np.sum(~(self.value > limit))), len(self.value), confidence)

    def map(self, first: str | int, second: str | int, bins: int = 20) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the mean measure over two joints: (bins + 1,) edges of each, rad or m, and (bins, bins) means."""
        pair = self.fall.q[:, [self.fall.arm.joint_index(first), self.fall.arm.joint_index(second)]]
        known = np.isfinite(self.value)
        x, y = pair[known, 0], pair[known, 1]
        counts, x_edges, y_edges = np.histogram2d(x, y, bins=bins)
        sums = np.histogram2d(x, y, bins=[x_edges, y_edges], weights=self.value[known])[0]
        return x_edges, y_edges, np.where(counts > 0, sums / np.maximum(counts, 1), np.nan)

    def rank_worst(self, count: int = 10) -> IndexArray:
        """Return the indices of the falls with the largest measure, the largest first."""
        return np.argsort(-np.nan_to_num(self.value, nan=-np.inf))[:count]


@check_arguments
@reports_progress("simulating power losses in random configurations")
def power_loss_probability(
    arm: Arm,
    below: float,
    *,
    measure: FallMeasure = "drop",
    where: Region | None = None,
    q: ArrayLike | None = None,
    samples: int = 20_000,
    seed: int = 1,
    cell: CellLike | None = None,
    clearance: Clearance | bool | None = None,
    **options: Any,
) -> DropProbability:
    """Estimate the probability that a power loss in a random configuration at rest stays harmless.

    Args:
        arm: The arm, with inertial data for every link.
        below: Limit of the measure: m for the drop, J for energies, m/s for the impact speed.
        measure: ``drop``, ``released`` (energy until the end of the fall), ``impact_speed`` or ``impact_energy`` of the first
            contact.
        where: Region of joint values, or of tool poses, for each of which one random configuration is used. Default: uniform
            within the limits.
        q: (N, n) configurations to use instead, rad and m.
        samples: Number of configurations that are drawn; those in collision are not used.
        seed: Seed of the configurations.
        cell: Objects around the arm, or their file.
        clearance: Collision model of the arm, as in :func:`holdfast.power_loss`.
        **options: Other keyword arguments of :func:`holdfast.power_loss`.

    Raises:
        InputError: The limit is not above 0, no configuration of the region is free of collisions, or an argument of
            :func:`holdfast.power_loss` is wrong.
        ArmError: As for :func:`holdfast.power_loss`.
    """
    if not (np.isfinite(below) and below > 0):
        raise InputError(f"below is {below:g}; it must be a finite number above 0")
    if measure not in MEASURE_UNITS:
        raise InputError(f"measure is '{measure}'; use one of {', '.join(MEASURE_UNITS)}")
    if samples < 1:
        raise InputError(f"samples is {samples}; it must be 1 or more")
    model = chosen_clearance(arm, clearance, cell, looks=False)
    if measure.startswith("impact") and model is None:
        raise InputError(f"{measure} needs contacts, which are not checked; give a cell or clearance=True")
    unreached = 0
    if q is not None:
        rows, description = np.atleast_2d(arm.check_configurations(q)), "the given configurations"
    elif where is None:
        rows = np.random.default_rng(seed).uniform(*sampling_limits(arm), (samples, arm.n))
        description = "random configurations within the joint limits"
    else:
        rows, unreached = _sample_region(arm, where, samples, seed)
        description = f"random configurations of region '{where.name}'"
    usable = np.array(np.isfinite(rows).all(axis=1))
    if model is not None and usable.any():
        usable[usable] = model.margin_left(rows[usable]) > 0
    if not usable.any():
        raise InputError(f"{description}: none of {len(rows):,} configurations is free of collisions; choose another region")
    fall = power_loss(arm, rows[usable], clearance=model, **options)
    value = np.where(fall.status == Status.OK, measure_fall(fall, measure), np.inf)
    return DropProbability(
        fall=fall,
        measure=measure,
        below=float(below),
        value=value,
        drawn=len(rows),
        unreached=unreached,
        where=description,
    )


def _sample_region(arm: Arm, region: Region, samples: int, seed: int) -> tuple[FloatArray, int]:
    """Return configurations (N, n) of a region, and the number of poses without one."""
    blocks = region.blocks(0, seed, count=samples)
    if region.has_weights(samples):
        raise InputError(
            f"region '{region.name}' has weights, which an interval of equal samples does not describe; leave them out"
        )
    drawn = np.concatenate(list(islice(blocks, -(-samples // region.block))))[:samples]
    if region.kind == "joints":
        return drawn, 0
    solutions = solve_ik(arm, region.poses(drawn), seed)
    return solutions.q[solutions.success], int(np.sum(~solutions.success))
