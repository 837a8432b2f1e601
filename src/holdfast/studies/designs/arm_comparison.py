"""Comparison of arms by measures over a region, joint space, and the workspace in one table, with intervals."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError, TaskError
from holdfast.core.probability.intervals import Interval
from holdfast.core.progress import ProgressCount, reports_progress
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.indices.determinants import RelativeManipulability
from holdfast.kinematics.regions.region import Region, default_region
from holdfast.kinematics.solvers.optima import optimise
from holdfast.kinematics.solvers.self_motions import fibres
from holdfast.kinematics.workspace.tolerance import tolerant_workspace
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task, plane_normal
from holdfast.model.failure_modes import FailureSpec
from holdfast.studies.designs.designs import HeldOutResult
from holdfast.studies.designs.search import sample_poses

_Cell = tuple[str, str, int, Interval]  # name and unit of a column, number of samples, and value of one arm

COMPARISON_MEASURES = ("quantile", "fraction-above", "self-motion-size", "tolerant-workspace")
INTERVAL_CONFIDENCE = 0.95  # confidence level of all intervals
_CURVE_SPACING_RAD = 0.05  # rad
_CURVE_STARTS = 32  # random starts of the search for self-motions


@dataclass(frozen=True, kw_only=True)
class ArmMeasures:
    """Column of a comparison of arms with a measure of all arms.

    Attributes:
        measure: Name of the measure.
        name: Title of the column.
        unit: Unit of the values; ``1`` if they have none.
        samples: Number of poses, configurations or points of each value; 0 for an exact value.
    """

    measure: str
    name: str
    unit: str
    samples: int


@dataclass(frozen=True, kw_only=True, eq=False)
class ArmComparison(Result):
    """Result of :func:`compare_arms`.

    Attributes:
        arms: The A arms, one for each row.
        task: Task, with the rows of a pose that matter.
        failures: Largest number of joints that lock simultaneously.
        region: Region from which the poses were sampled.
        columns: The C columns of the comparison.
        values: (A, C) measures of each arm, all better when larger.
        low: (A, C) lower ends of the 95 % intervals.
        high: (A, C) upper ends of the 95 % intervals.
        left_out: Default measures that are not defined for all arms, with the reason.
        level: Fraction of the poses that have at least a quantile.
        seed: Seed of all samples.
        seconds: Duration of the computation, s.
    """

    arms: tuple[Arm, ...]
    task: Task
    failures: int
    region: Region
    columns: tuple[ArmMeasures, ...]
    values: FloatArray
    low: FloatArray
    high: FloatArray
    left_out: tuple[str, ...]
    level: float
    seed: int
    seconds: float

    def front(self, *names: str) -> NDArray[np.int64]:
        """Return the indices from 0 of the non-dominated arms; values whose intervals overlap count as equal.

        Args:
            names: Names of the columns to compare. Default: all columns.

        Raises:
            InputError: There is no such column.
        """
        column_names = [column.name for column in self.columns]
        for name in names:
            if name not in column_names:
                raise InputError(f"column '{name}' is not known; use {', '.join(column_names)}")
        selected = [column_names.index(name) for name in names or column_names]
        lower, upper = self.low[:, selected], self.high[:, selected]
        # No column is significantly worse, and one is significantly better.
        no_worse = (upper[:, None] >= lower[None]).all(axis=2)
        better = (lower[:, None] > upper[None]).any(axis=2)
        return np.flatnonzero(~(no_worse & better).any(axis=0))


@check_arguments
@reports_progress("judging arms")
def compare_arms(
    arms: Arm | Sequence[Arm],
    region: Region | None = None,
    *,
    task: str | Task | Sequence[str] = "pose",
    failures: FailureSpec = "single",
    measures: Sequence[str] | None = None,
    level: float = 0.95,
    thresholds: Sequence[float] = (0.05, 0.1, 0.2, 0.3),
    poses: int = 100,
    samples: int = 20_000,
    points: int = 300,
    best_limits: bool = False,
    seed: int = 0,
) -> ArmComparison:
    """Compare arms by measures of the whole arm, because the value at one best configuration does not characterise the rest.

    - ``quantile``: relative manipulability, at the best configuration of each pose of the region, that a fraction ``level`` of
      the poses has at least; poses out of reach count as 0.
    - ``fraction-above``: fraction of the joint space, within the limits or full circles, that has at least each threshold.
    - ``self-motion-size``: full turns of all joints on one self-motion curve of a pose: the median over the region, and the
      size that a fraction ``level`` of the poses has at least; for one degree of redundancy.
    - ``tolerant-workspace``: fraction of the disc or ball of the arm's length that is reached before and after any one lock.

    Args:
        arms: An arm, or several arms that are compared at the same poses.
        region: Region of the poses. Default: around the home of the first arm.
        task: Rows of the pose that matter; the tolerant workspace is that of positions in space, or in the plane of the arm.
        failures: Joints that lock simultaneously; the tolerant workspace is for single locks.
        measures: Names of the measures. Default: all that are defined for the arms.
        level: Fraction of the poses that have at least a quantile.
        thresholds: Thresholds of relative manipulability.
        poses: Number of poses from the region.
        samples: Number of configurations of each arm.
        points: Number of points of a sampled workspace.
        best_limits: True to search for the artificial limits with the largest tolerant workspace, which takes long if it is
            sampled. False: the arm's limits, between which a joint may lock.
        seed: Seed of all samples.

    Raises:
        InputError: There is no arm, a measure is unknown, or thresholds or counts are out of range.
        TaskError: An arm has no redundancy, or more than one degree of it for the requested size of self-motions.

    Source: derived here.
    """
    start_time = time.monotonic()
    arm_list = (arms,) if isinstance(arms, Arm) else tuple(arms)
    if not arm_list:
        raise InputError("there is no arm to compare; give one or more")
    unknown = [measure_name for measure_name in measures or () if measure_name not in COMPARISON_MEASURES]
    if unknown:
        raise InputError(f"measure '{unknown[0]}' is not known; use {', '.join(COMPARISON_MEASURES)}")
    if min(poses, samples, points) < 1 or not 0 < level < 1 or not thresholds:
        raise InputError("give at least 1 pose, sample, point and threshold, and a level between 0 and 1")
    tasks = [as_task(arm, task) for arm in arm_list]
    chosen, left_out = list(measures or COMPARISON_MEASURES), list[str]()
    redundancies = {arm.n - arm_task.m for arm, arm_task in zip(arm_list, tasks, strict=True)}
    if redundancies != {1} and "self-motion-size" in chosen:
        reason = (
            f"the size of self-motions needs one degree of redundancy; here it is {', '.join(map(str, sorted(redundancies)))}"
        )
        if measures is not None:
            raise TaskError(reason)
        chosen.remove("self-motion-size")
        left_out.append(reason)
    pose_region = default_region(arm_list[0]) if region is None else region
    targets, weights = sample_poses(pose_region, poses, seed)
    sample = _ComparisonSample(
        pose_region,
        targets,
        np.empty(0) if weights is None else weights,
        level,
        tuple(thresholds),
        samples,
        points,
        best_limits,
        seed,
    )
    methods = {
        "quantile": sample.measure_quantile,
        "fraction-above": sample.measure_fractions_above,
        "self-motion-size": sample.measure_self_motions,
        "tolerant-workspace": sample.measure_workspace,
    }
    columns: list[ArmMeasures] = []
    cells: list[list[Interval]] = []
    most_failures = 0
    with ProgressCount("arms", len(arm_list), whole=True) as advance:
        for arm, arm_task in zip(arm_list, tasks, strict=True):
            index = RelativeManipulability(arm, arm_task, failures)
            most_failures = max(most_failures, *map(len, index.failures))
            entries = [(measure, *cell) for measure in chosen for cell in methods[measure](index)]
            columns = [
                ArmMeasures(measure=measure, name=name, unit=unit, samples=count) for measure, name, unit, count, _ in entries
            ]
            cells.append([interval for *_, interval in entries])
            advance(1)
    return ArmComparison(
        arms=arm_list,
        task=tasks[0],
        failures=most_failures,
        region=pose_region,
        columns=tuple(columns),
        values=np.array([[estimate.value for estimate in row] for row in cells]),
        low=np.array([[estimate.low for estimate in row] for row in cells]),
        high=np.array([[estimate.high for estimate in row] for row in cells]),
        left_out=tuple(left_out),
        level=level,
        seed=seed,
        seconds=time.monotonic() - start_time,
    )


@dataclass(frozen=True)
class _ComparisonSample:
    """Poses and further settings of the samples, which are equal for all arms."""

    region: Region
    poses: FloatArray
    weights: FloatArray
    level: float
    thresholds: tuple[float, ...]
    samples: int
    points: int
    best_limits: bool
    seed: int

    def _compute_quantile(self, values: FloatArray, level: float) -> Interval:
        is_reached = np.ones(len(values), dtype=bool)
        return HeldOutResult.from_values(
            values, is_reached, self.weights, level=level, heaviest=self.region.heaviest
        ).guaranteed

    def measure_quantile(self, index: RelativeManipulability) -> list[_Cell]:
        best = optimise(index.arm, self.poses, index, seed=self.seed)
        interval = self._compute_quantile(np.where(best.success, best.value, 0.0), self.level)
        return [(f"kept at {_format_percent(self.level)} of the poses", "1", len(self.poses), interval)]

    def measure_fractions_above(self, index: RelativeManipulability) -> list[_Cell]:
        lower, upper = sampling_limits(index.arm)
        value = index(np.random.default_rng(self.seed).uniform(lower, upper, (self.samples, index.arm.n)))
        counts = [int((value >= threshold).sum()) for threshold in self.thresholds]
        return [
            (
                f"joint space at {threshold:g} or more",
                "1",
                self.samples,
                Interval.from_counts(count, self.samples, INTERVAL_CONFIDENCE),
            )
            for threshold, count in zip(self.thresholds, counts, strict=True)
        ]

    def measure_self_motions(self, index: RelativeManipulability) -> list[_Cell]:
        motions = fibres(index.arm, self.poses, index.task, spacing=_CURVE_SPACING_RAD, starts=_CURVE_STARTS, seed=self.seed)
        revolutions = np.array([motion.size for motion in motions]) / (2 * np.pi)
        levels = {"self-motion, median": 0.5, f"self-motion at {_format_percent(self.level)} of the poses": self.level}
        return [(name, "turns", len(revolutions), self._compute_quantile(revolutions, level)) for name, level in levels.items()]

    def measure_workspace(self, index: RelativeManipulability) -> list[_Cell]:
        is_planar = plane_normal(index.arm) is not None
        task_name, options = "planar" if is_planar else "position", {"points": self.points, "seed": self.seed}
        tolerant = tolerant_workspace(
            index.arm, task_name, optimise=self.best_limits, confidence=INTERVAL_CONFIDENCE, **options
        )
        length = index.arm.end_to_end
        full_size = np.pi * length**2 if is_planar else 4 / 3 * np.pi * length**3
        value, lower, upper = (x / full_size for x in (tolerant.size, *tolerant.size_interval))
        interval = Interval(value=value, low=lower, high=upper, confidence=INTERVAL_CONFIDENCE)
        unit, points = f"of the {'disc' if is_planar else 'ball'}", 0 if tolerant.exact else self.points
        return [("workspace that every lock leaves", unit, points, interval)]


def _format_percent(fraction: float) -> str:
    return f"{100 * fraction:g} %"
