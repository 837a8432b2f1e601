"""Starts in a workspace from which a target is still reached after an undetected lock on the way."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.convergence.analysis import (
    END_ARRIVING,
    END_NO_SINK,
    FAILURE_ENDS,
    Method,
    RelativeTo,
    StartConfigurations,
    TargetAnalysis,
)
from holdfast.control.convergence.measures import FINISH_NAMES, MEASURE_NAMES, REACH_NAMES, Measures
from holdfast.control.convergence.places import Places
from holdfast.control.laws.law import Law
from holdfast.control.simulation.runs import RunOutcome
from holdfast.core.errors import InputError
from holdfast.core.probability.intervals import Interval, check_confidence
from holdfast.core.result import Result
from holdfast.core.sweeps.store import Store
from holdfast.core.typing import FloatArray, IndexArray, Rows

if TYPE_CHECKING:
    import xarray as xr

Progress = Callable[[int, int], None]

_CHUNK_STARTS = 128  # starts that are analysed and stored together; no result depends on it


@dataclass(frozen=True, eq=False, kw_only=True)
class Workspace(Result):
    """Measures of the paper for P starts; the last column of each (P, n + 1) array is for an arbitrary joint.

    Attributes:
        law: The control law.
        target: (4, 4) tool pose of the target; only the rows of the task count.
        places: Places of the end effector at the start.
        bounds: Arcs (lower, upper) of each joint, rad, in which it may lock while the target stays in reach.
        method: ``brute``, ``procedure`` or ``sampled``.
        relative_to: Reference of ``finish``: the part of a motion ``inside`` the bounds, or the ``whole`` motion.
        configurations: (P,) number of starting configurations that were analysed; 0 if the place is out of reach.
        lost: (P,) number of them whose healthy motion ran into a singular configuration; all measures exclude these.
        reach: R100, Ravg and Rsens of the fraction of a motion from which the target stays in reach, percent.
        finish: F100, Favg and Fsens of the fraction from which the failed arm reaches the target, percent, without undecided
            runs.
        ends: (P, 6) number of failures by outcome: converged, stuck, moving, undecided; arriving, which is undecided at the
            time limit but next to an attracting solution; and not simulated because the joint locked where there is no sink.
    """

    law: Law
    target: FloatArray
    places: Places
    bounds: tuple[tuple[tuple[float, float], ...], ...]
    method: Method
    relative_to: RelativeTo
    configurations: IndexArray
    lost: IndexArray
    reach: Measures
    finish: Measures
    ends: IndexArray

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns of the measures: the joints, and ``any`` for an arbitrary joint."""
        return (*self.law.arm.joint_names, "any")

    @property
    def measures(self) -> dict[str, FloatArray]:
        """Measures R100, Ravg, Rsens, F100, Favg and Fsens by name, (P, n + 1) each, percent."""
        return dict(zip(MEASURE_NAMES, (*self.reach.parts, *self.finish.parts), strict=True))

    @property
    def simulated_count(self) -> int:
        """Number of failures that were simulated."""
        return int(self.ends[:, :END_NO_SINK].sum())

    @property
    def undecided_fraction(self) -> float:
        """Fraction of the simulated failures that were undecided at the time limit; NaN if no failure was simulated."""
        return (
            float(self.ends[:, [RunOutcome.UNDECIDED, END_ARRIVING]].sum() / self.simulated_count)
            if self.simulated_count
            else float("nan")
        )

    @property
    def skipped_fraction(self) -> float:
        """Fraction of the failures that did not have to be simulated, because the joint locked where there is no sink."""
        total = int(self.ends.sum())
        return float(self.ends[:, END_NO_SINK].sum() / total) if total else float("nan")

    def means(self) -> dict[str, FloatArray]:
        """Return the mean of every measure over the starts with a value, (n + 1,) each, percent."""
        return {name: mean_ignoring_nan(values, 0) for name, values in self.measures.items()}

    def intervals(self, confidence: float = 0.95) -> dict[str, FloatArray]:
        """Return the intervals of the means if the starts are a random sample: (n + 1, 2) each, lower and upper end, percent.

        The sampling unit is the start, because the configurations and failures of one start are correlated; more of them make
        only the value of this start more accurate. The intervals always cover at the level ``confidence``, and are wide for few
        starts (:meth:`holdfast.core.probability.Interval.of_fractions`). They are NaN if no start has a value.
        """
        check_confidence(confidence)
        return {name: mean_intervals(values, confidence) for name, values in self.measures.items()}

    def throughout(self, name: str = "R100", confidence: float = 0.95) -> tuple[Interval, ...]:
        """Return the fraction of the starts, for each column, at which a measure is 100, with its exact interval.

        Only the analysed configurations are known, so this is an upper bound of the fraction of starts at which the measure is
        100 for every configuration of the self-motion. It is NaN if no start has a value.

        Args:
            name: Name of the measure, ``R100`` or ``F100``.
            confidence: Confidence level of the intervals.

        Raises:
            InputError: The name is neither R100 nor F100.
        """
        check_confidence(confidence)
        if name not in (REACH_NAMES[0], FINISH_NAMES[0]):
            raise InputError(f"'{name}' is not known; use R100 or F100")
        values = self.measures[name]
        known_counts = (~np.isnan(values)).sum(axis=0).tolist()
        hit_counts = (values >= 100 - 1e-9).sum(axis=0).tolist()
        no_interval = Interval(value=np.nan, low=np.nan, high=np.nan, confidence=confidence)
        return tuple(
            Interval.from_counts(hit_count, count, confidence) if count else no_interval
            for hit_count, count in zip(hit_counts, known_counts, strict=True)
        )

    def to_xarray(self) -> xr.Dataset:
        """Return the measures, percent, by start and joint (the last is ``any``), and the position and counts of each start."""
        values: dict[str, Any] = {
            name: (("place", "joint"), columns, {"units": "percent"}) for name, columns in self.measures.items()
        }
        values |= {"configurations": ("place", self.configurations), "lost": ("place", self.lost)}
        values["ends"] = (("place", "ending"), self.ends)
        return self.places.dataset(values, joint=self.columns, ending=FAILURE_ENDS)


def compute_workspace(
    job: TargetAnalysis, starts: StartConfigurations, store: str | Path | None = None, progress: Progress | None = None
) -> Workspace:
    """Analyse one target in chunks of starts, which are stored."""
    places, count = starts.places, len(starts.places)

    def analyse_chunks(numbers: Iterable[int]) -> Iterator[tuple[int, Rows]]:
        for number in numbers:
            first, stop = number * _CHUNK_STARTS, min((number + 1) * _CHUNK_STARTS, count)
            yield number, job.analyse(*starts.find_configurations(first, stop), stop - first)
            if store is None and progress is not None:
                progress(stop, count)

    if store is None:
        chunks = [results for _, results in analyse_chunks(range(-(-count // _CHUNK_STARTS)))]
    else:
        folder = Store.create(store, job.plan(places), job.store_columns(), rows=count, chunk=_CHUNK_STARTS)
        with folder.lock_for_writing():
            folder.commit_missing(analyse_chunks, progress)
        chunks = list(folder.read_all_checked())
    columns = {name: np.concatenate([results[name] for results in chunks]) for name in job.names}
    return Workspace(
        law=job.law,
        target=job.pose,
        places=places,
        bounds=job.bounds,
        method=job.method,
        relative_to=job.relative_to,
        configurations=columns["configurations"],
        lost=columns["lost"],
        reach=Measures(*(columns[name] for name in REACH_NAMES)),
        finish=Measures(*(columns[name] for name in FINISH_NAMES)),
        ends=columns["ends"],
    )


def mean_intervals(values: FloatArray, confidence: float) -> FloatArray:
    """Return the intervals (C, 2) of the column means of values (P, C), percent, for P independent places."""
    bounds = np.full((values.shape[1], 2), np.nan)
    for index, column in enumerate(values.T):
        if not np.isnan(column).all():
            interval = Interval.of_fractions(np.clip(column[~np.isnan(column)] / 100, 0.0, 1.0), confidence)
            bounds[index] = 100 * interval.low, 100 * interval.high
    return bounds


def mean_ignoring_nan(values: FloatArray, axis: int) -> FloatArray:
    """Return the mean along an axis of the values that are not NaN; NaN if there is none."""
    is_known = ~np.isnan(values)
    count = is_known.sum(axis=axis)
    return np.where(count > 0, np.where(is_known, values, 0.0).sum(axis=axis) / np.maximum(count, 1), np.nan)
