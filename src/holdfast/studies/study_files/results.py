"""Results of the cells of a study, which are read one chunk at a time, for any number of chunks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from holdfast.control.convergence.maps import NO_CONFIGURATION, average_fraction
from holdfast.control.convergence.start_workspace import mean_ignoring_nan, mean_intervals
from holdfast.control.simulation.runs import RunOutcome
from holdfast.core.errors import StoreError
from holdfast.core.probability.distribution import Distribution
from holdfast.core.probability.intervals import Difference, Interval
from holdfast.core.sweeps.store import Store
from holdfast.core.sweeps.study import Study
from holdfast.core.typing import FloatArray, Rows
from holdfast.studies.assessment.assessment import ZERO_INDEX
from holdfast.studies.assessment.plan import AssessmentPlan
from holdfast.studies.assessment.run import read_assessment_store
from holdfast.teleop.trials.recordings import End


def read_chunks(study: Study, cell: int) -> Iterator[Rows]:
    """Yield the committed chunks of a cell after comparing their checksums.

    Raises:
        StoreError: A chunk is damaged.
    """
    if study.cell_folder(cell).exists():
        yield from study.cell_store(cell).read_all_checked()


_SWEPT_LABELS = ("index", "task", "region", "failures")
_LABELS_BY_JOB = {"assess": (*_SWEPT_LABELS, "keep"), "designs": _SWEPT_LABELS}


def read_labels(study: Study, cell: int) -> dict[str, Any]:
    """Return the labels of a cell in the sweep.

    Raises:
        StoreError: A label is missing.
    """
    labels: dict[str, Any] = study.cells[cell]["labels"]
    for name in ("job", "arm", *_LABELS_BY_JOB.get(str(labels.get("job")), ("law", "task"))):
        if not isinstance(labels.get(name), str):
            raise StoreError(
                f"'{study.path}' is damaged: cell '{study.cells[cell]['name']}' has no label '{name}'; give the study file to "
                "'holdfast study run' again, which writes the label"
            )
    return labels


@dataclass(frozen=True)
class AssessedCell:
    """Result of a cell with an index over a region.

    Attributes:
        labels: Labels of the cell in the sweep.
        plan: Plan of the assessment.
        plain, optimised: Distributions as found and at the best configurations; None if not computed or not requested.
        worst: Name and fraction of the failure that is the worst most often; None if there is none.
        survival_fraction: Fraction of the poses that remain after a lock, mean over the joints; None if not requested.
    """

    labels: dict[str, Any]
    plan: AssessmentPlan
    plain: Distribution | None
    optimised: Distribution | None
    worst: tuple[str, float] | None
    survival_fraction: float | None

    def interval(self, threshold: float, optimised: bool) -> Interval | None:
        """Return the probability that the index meets a threshold; None without a distribution."""
        distribution = self.optimised if optimised else self.plain
        if distribution is None or not distribution.samples:
            return None
        larger = self.plan.index.better == "larger"
        return distribution.interval(at_least=threshold) if larger else distribution.interval(at_most=threshold)


def read_assessment(study: Study, cell: int) -> AssessedCell:
    """Read the result of an assessment."""
    labels, run = read_labels(study, cell), read_assessment_store(study.cell_store(cell))
    counts, worst, survival_fraction = run.worst_counts, None, None
    if counts.sum() > 0:
        worst = run.index.failure_names[int(counts.argmax())], float(counts.max() / counts.sum())
    if not run.distribution.samples:
        return AssessedCell(labels, run.plan, None, None, worst, None)
    if run.survivors is not None:
        survival_fraction = float(np.mean(run.survivors) / run.distribution.total_weight())
    return AssessedCell(labels, run.plan, run.distribution, run.optimised, worst, survival_fraction)


def choose_threshold(cells: list[AssessedCell]) -> float:
    """Choose a threshold for several arms: half of the smallest bound, or about the median of the medians."""
    bounds = [cell.plan.index.bound for cell in cells]
    known_bounds = [bound for bound in bounds if bound is not None]
    if known_bounds and len(known_bounds) == len(bounds):
        return float(f"{min(known_bounds) / 2:.2g}")
    medians = [float(cell.plain.quantile(0.5)) for cell in cells if cell.plain is not None and cell.plain.reached]
    medians = [median for median in medians if np.isfinite(median) and abs(median) > ZERO_INDEX]
    return float(f"{np.median(medians):.2g}") if medians else 1.0


@dataclass(frozen=True)
class DrivenCell:
    """Result of a cell with motions under a law.

    Attributes:
        labels: Labels of the cell in the sweep.
        joints: Names of the joints.
        motions: Number of motions with a configuration to start from.
        ends: (n + 1, 4) fractions of converged, stuck, moving and undecided motions, for each locked joint and without failure.
        reaches: (n + 1,) fractions of motions that reach the target, with intervals.
        fraction_by_motion: (R,) fraction of the locked joints with which a motion reaches the target; NaN without a start.
        mean_fraction: Mean of ``fraction_by_motion``, with its interval.
        in_reach: Fraction of the runs with a locked joint in which the target was in reach.
        touched: Upper bound of the fraction of these runs with a contact; None if contacts were not checked.
    """

    labels: dict[str, Any]
    joints: tuple[str, ...]
    motions: int
    ends: FloatArray
    reaches: tuple[Interval, ...]
    fraction_by_motion: FloatArray
    mean_fraction: Interval
    in_reach: float
    touched: float | None = None


def read_convergence(study: Study, cell: int) -> DrivenCell | None:
    """Read the result of a convergence map; None if there is none."""
    store = study.cell_store(cell)
    parts = [(rows["code"], rows["in_reach"], rows.get("touched")) for rows in read_chunks(study, cell)]
    if not parts:
        return None
    codes, in_reach = (np.concatenate([part[number] for part in parts]) for number in (0, 1))
    contact_flags = [part[2] for part in parts if part[2] is not None]
    is_known = codes[:, 0] != NO_CONFIGURATION
    runs = int(is_known.sum())
    if not runs:
        return None
    ends = np.stack([(codes[is_known] == number).mean(axis=0) for number in RunOutcome], axis=1)
    has_converged = codes == RunOutcome.CONVERGED
    fraction_by_motion = np.where(is_known, has_converged[:, :-1].mean(axis=1), np.nan)
    reaches = tuple(Interval.from_counts(int(has_converged[is_known, number].sum()), runs) for number in range(codes.shape[1]))
    joints = tuple(joint["name"] for joint in store.plan["arm"]["joints"] if joint["type"] != "fixed")
    whole = average_fraction(fraction_by_motion, codes.shape[1] - 1, 0.95)
    labels = read_labels(study, cell)
    in_reach_fraction = float(in_reach[is_known, :-1].mean())
    touched = float(np.concatenate(contact_flags)[is_known, :-1].mean()) if contact_flags else None
    return DrivenCell(labels, joints, runs, ends, reaches, fraction_by_motion, whole, in_reach_fraction, touched)


def compare_convergence_cells(first_cell: DrivenCell, second_cell: DrivenCell) -> Difference | None:
    """Return the gain of the second law over the first, on the same motions; None if there are none."""
    in_both = (
        ~np.isnan(first_cell.fraction_by_motion) & ~np.isnan(second_cell.fraction_by_motion)
        if first_cell.fraction_by_motion.shape == second_cell.fraction_by_motion.shape
        else np.zeros(1, bool)
    )
    return (
        Difference.of_fractions(second_cell.fraction_by_motion[in_both] - first_cell.fraction_by_motion[in_both])
        if in_both.any()
        else None
    )


@dataclass(frozen=True)
class MeasureTable:
    """Further measures of a cell with their intervals.

    Attributes:
        labels: Labels of the cell in the sweep.
        samples: Number of starts, or of sets of tasks.
        values: Value, lower end and upper end of each measure, by name; NaN if there is none.
    """

    labels: dict[str, Any]
    samples: int
    values: dict[str, tuple[float, float, float]]


def read_workspace(study: Study, cell: int) -> MeasureTable | None:
    """Read the means over the starts of the measures of a workspace, for an arbitrary joint, percent."""
    parts = list(read_chunks(study, cell))
    if not parts:
        return None
    values = {}
    for name in ("R100", "Ravg", "F100", "Favg"):
        column = np.concatenate([part[name][:, -1] for part in parts])
        lower, upper = mean_intervals(column[:, None], 0.95)[0]
        values[name] = (float(mean_ignoring_nan(column[:, None], 0)[0]), float(lower), float(upper))
    return MeasureTable(read_labels(study, cell), sum(len(part["lost"]) for part in parts), values)


def read_bank(study: Study, cell: int) -> MeasureTable | None:
    """Read the fractions of the tasks completed without an operator, healthy and failed, and the median time, cycles."""
    parts = list(read_chunks(study, cell))
    if not parts:
        return None
    endings = np.concatenate([part["end"] for part in parts])
    cycles = np.concatenate([part["measures"][..., 0] for part in parts])
    values = {}
    for number, case in enumerate(("healthy", "failed")):
        has_arrived = endings[..., number] == End.ARRIVED
        interval = Interval.from_counts(int(has_arrived.sum()), has_arrived.size)
        values[f"reached, {case}"] = (100 * interval.value, 100 * interval.low, 100 * interval.high)
        median = float(np.median(cycles[..., number][has_arrived])) if has_arrived.any() else np.nan
        values[f"time, {case}"] = (median, np.nan, np.nan)
    return MeasureTable(read_labels(study, cell), len(endings), values)


@dataclass(frozen=True)
class DesignSweep:
    """Result of a cell with D designs of one arm, the baseline arm first if it is computed.

    Attributes:
        labels: Labels of the cell in the sweep.
        plan: Plan of the sweep.
        values: (D, k) designs, rad or m.
        guaranteed, median: (D,) lower quantile and median of the index over the poses.
        reached: (D,) fraction of the poses that are reached.
        reach: (D,) reach, m.
        start: Row of the baseline arm; None if it is not computed yet.
    """

    labels: dict[str, Any]
    plan: Mapping[str, Any]
    values: FloatArray
    guaranteed: FloatArray
    median: FloatArray
    reached: FloatArray
    reach: FloatArray
    start: int | None


def read_design_sweep(study: Study, cell: int) -> DesignSweep | None:
    """Read the result of a sweep of designs; None if there is none."""
    parts = list(read_chunks(study, cell))
    if not parts:
        return None
    names = ("design", "guaranteed", "median", "reached", "reach")
    values, guaranteed, median, reached, reach = (np.concatenate([part[name] for part in parts]) for name in names)
    store = study.cell_store(cell)
    start = 0 if 0 in store.committed_chunks else None
    return DesignSweep(read_labels(study, cell), store.plan, values, guaranteed, median, reached, reach, start)


def stored_size_bytes(store: Store) -> int:
    """Return the size of the committed chunks of a store in bytes."""
    return sum(entry.size for entry in store.entries.values())
