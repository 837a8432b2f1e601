"""Result of an assessment: the probability that an index meets a threshold after a failure, and derived results."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.errors import InputError
from holdfast.core.extras import import_extra
from holdfast.core.probability.distribution import Distribution, Interval
from holdfast.core.probability.intervals import check_confidence
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.sweeps.store import Store
from holdfast.core.typing import FloatArray, Rows
from holdfast.core.validation import check_arguments
from holdfast.kinematics.indices.index import Index
from holdfast.kinematics.regions.region import Region, Sampling
from holdfast.model.arm.model import Arm
from holdfast.studies.assessment import upgrade
from holdfast.studies.assessment.plan import AssessmentPlan
from holdfast.studies.assessment.rows import Collisions, describe_provenance
from holdfast.studies.assessment.upgrade import RunSample, Upgrade, check_failure_rates, make_run_sample

if TYPE_CHECKING:
    import xarray as xr

    from holdfast.certificates import ReachClaim

MIN_INFORMATIVE_PROBABILITY = 0.01  # below this probability a report explains the reason and gives other results
ZERO_INDEX = 1e-9  # values after a structural failure are rounding noise below this


@dataclass(frozen=True, kw_only=True)
class Assessment(Result):
    """Result of :func:`holdfast.assess`.

    Attributes:
        plan: Plan of the run, which defines its rows.
        distribution: Distribution of the index over the region at the configurations that inverse kinematics found.
        worst_counts: (F,) number, or weight, of the reached and non-singular poses for which each failure is the worst.
        optimised: Distribution of the index at the best configurations; None if they were not requested.
        optimised_worst_counts: (F,) ``worst_counts`` at the best configurations.
        survivors: (n,) number, or weight, of the poses that can still be reached after the joint has locked; 0 for joints that
            were not requested, None if none was.
        collisions: Configurations in which the arm collides with itself or its cell; None if this was not checked.
        clear: Number, or weight, of the poses with a collision-free configuration; None without a cell.
        store: Results folder; None if none was written.
        seconds: Duration of the run, s; None if not known.
        complete: False if the run was stopped before all poses were computed.
    """

    plan: AssessmentPlan
    distribution: Distribution
    worst_counts: NDArray[Any]
    optimised: Distribution | None
    optimised_worst_counts: NDArray[Any] | None
    survivors: NDArray[Any] | None = None
    collisions: Collisions | None = None
    clear: float | None = None
    store: Store | None = None
    seconds: float | None
    complete: bool
    _rows: Rows | None = None

    @property
    def arm(self) -> Arm:
        """Arm of the index."""
        return self.plan.arm

    @property
    def region(self) -> Region:
        """Region of the poses."""
        return self.plan.region

    @property
    def index(self) -> Index:
        """Index that was evaluated."""
        return self.plan.index

    @property
    def poses(self) -> int:
        """Number of requested poses."""
        return self.plan.poses

    @property
    def seed(self) -> int:
        """Seed of the run."""
        return self.plan.seed

    @property
    def sampling(self) -> Sampling:
        """Sampling of the poses, ``random`` or ``sobol``."""
        return self.plan.sampling

    @property
    def restarts(self) -> int:
        """Number of random starts after which a pose counts as not found."""
        return self.plan.restarts

    def distribution_of(self, optimised: bool) -> Distribution:
        """Return the distribution at the best configurations if ``optimised``, or at those that inverse kinematics found.

        Raises:
            InputError: The run was not optimised.
        """
        if not optimised:
            return self.distribution
        if self.optimised is None:
            raise InputError("this run was not optimised; assess again with optimise=True")
        return self.optimised

    @check_arguments
    def cdf(self, h: ArrayLike, optimised: bool = False, reachable_only: bool = False) -> FloatArray:
        """Return ``F(h)``, the fraction of poses whose index is below h.

        Args:
            h: Values of the index, of any shape.
            optimised: True for the best configurations.
            reachable_only: True to exclude poses without a configuration, which otherwise count as 0.
        """
        return self.distribution_of(optimised).cdf(h, reachable_only)

    @check_arguments
    def probability(
        self,
        at_least: float | None = None,
        at_most: float | None = None,
        optimised: bool = False,
        *,
        reachable_only: bool = False,
    ) -> float:
        """Return the probability ``1 - F(h)`` that the index meets a threshold.

        Args:
            at_least: Threshold of an index that is better when larger, in the unit of the index.
            at_most: Threshold of an index that is better when smaller.
            optimised: True for the best configurations.
            reachable_only: True to exclude poses without a configuration, which otherwise count as 0.
        """
        return self.distribution_of(optimised).probability(at_least, at_most, reachable_only)

    @check_arguments
    def interval(
        self,
        at_least: float | None = None,
        at_most: float | None = None,
        optimised: bool = False,
        *,
        reachable_only: bool = False,
        confidence: float = 0.95,
    ) -> Interval:
        """Return the probability that the index meets a threshold, with its Clopper-Pearson interval.

        ``at_least``, ``at_most``, ``optimised`` and ``reachable_only`` are those of :meth:`probability`, and ``confidence`` is
        the confidence level.
        """
        return self.distribution_of(optimised).interval(at_least, at_most, reachable_only, confidence=confidence)

    @check_arguments
    def survival(self, joint: str | int | None = None, confidence: float = 0.95) -> dict[str, Interval]:
        """Return the fraction of all poses that are reachable after a joint has locked, with its Clopper-Pearson interval.

        The joint is locked at its value in ``locked`` of the run, otherwise at its value for another pose of the region;
        :attr:`locks` lists these values. A pose that the healthy arm does not reach counts as lost. So does a pose that was not
        found again in a limited number of starts, so the fractions are lower bounds. With a cell, only collision-free
        configurations count, before and after the lock; see :meth:`reached_clear`.

        Args:
            joint: Name, or index from 0, of the joint. Default: every joint for which the run computed it.
            confidence: Confidence level of the intervals.

        Raises:
            InputError: The run did not compute it; assess again with ``after_lock=True``.
        """
        check_confidence(confidence)
        if self.survivors is None:
            raise InputError("this run did not compute reachability after a lock; assess again with after_lock=True")
        chosen = list(self.plan.locks) if joint is None else [self.arm.joint_index(joint)]
        names = self.arm.joint_names
        for lock in chosen:
            if lock not in self.plan.locks:
                raise InputError(
                    f"this run did not compute a lock of '{names[lock]}'; assess again with after_lock=True or with it in "
                    f"locked"
                )
        return {names[lock]: self._pose_fraction_interval(float(self.survivors[lock]), confidence) for lock in chosen}

    def _pose_fraction_interval(self, hits: float, confidence: float) -> Interval:
        """Return the fraction of all poses with its interval, by weight if poses have weights."""
        distribution = self.distribution
        if distribution.has_weights:
            return Interval.of_share(min(hits / distribution.total_weight(), 1.0), distribution.effective(), confidence)
        return Interval.from_counts(int(hits), distribution.samples, confidence)

    @check_arguments
    def reached_clear(self, confidence: float = 0.95) -> Interval:
        """Return the fraction of all poses that the healthy arm reaches without collision, with its Clopper-Pearson interval.

        Collisions are those with itself and its cell. A pose for which no collision-free configuration was found in a limited
        number of starts counts as lost, and the bounding spheres extend slightly beyond the arm, so the fraction is a lower
        bound. ``confidence`` is the confidence level.

        Raises:
            InputError: The run had no cell, or was over a region of joints.
        """
        check_confidence(confidence)
        if self.clear is None:
            raise InputError("this run had no cell around the arm; assess again with cell=")
        return self._pose_fraction_interval(self.clear, confidence)

    @property
    def locks(self) -> dict[str, float | None]:
        """Locked value of each joint of :meth:`survival`: an angle (rad or m), or None for its value at another pose."""
        return {self.arm.joint_names[lock]: angle for lock, angle in self.plan.locks.items()}

    @check_arguments
    def expected_survival(self, rates: Mapping[str | int, float]) -> float:
        """Return the fraction of the region that remains after a failure, weighted by the failure rate of each joint.

        Args:
            rates: Relative failure rates by joint name or index from 0; other joints do not fail.

        Raises:
            InputError: A rate is negative, none is above 0, or the run did not compute a lock of a joint with a rate above 0.
        """
        weights = check_failure_rates(self.arm, rates)
        failing = np.flatnonzero(weights)
        shares = np.array([self.survival(int(joint))[self.arm.joint_names[joint]].value for joint in failing])
        return float(shares @ weights[failing] / weights.sum())

    # ---- interpretation --------------------------------------------------------------------------------------------

    def default_threshold(self) -> float:
        """Return the default threshold of reports: half of the bound, or about the median, with two digits."""
        if self.index.bound is not None:
            return float(f"{self.index.bound / 2:.2g}")
        distribution = self.distribution
        for value in [*(distribution.quantile([0.5, 0.25]).tolist() if distribution.reached else []), distribution.highest]:
            if np.isfinite(value) and abs(value) > ZERO_INDEX:
                return float(f"{value:.2g}")
        return 1.0

    def gap(self, optimised: bool = False) -> float | None:
        """Return the distance of the median over the reached poses from the bound for every configuration; None if unknown.

        For relative manipulability after any one failure the bound is ``sqrt((n - m) / n)``. ``index.bound_note`` explains the
        bound for several simultaneous failures. ``optimised`` selects the best configurations.
        """
        distribution = self.distribution_of(optimised)
        if self.index.bound is None or not distribution.reached:
            return None
        return self.index.bound - float(distribution.quantile(0.5))

    @check_arguments
    def if_never_fails(self, joint: str | int, optimised: bool = False) -> Distribution:
        """Compute the distribution if one joint could never fail: the worst case over the remaining failures.

        Args:
            joint: Name, or index from 0, of the joint.
            optimised: True for configurations that are optimised again for the remaining failures, for at most the first 500
                poses, instead of those that inverse kinematics found.

        Raises:
            InputError: There is no such joint, no failure remains, the rows were not kept, or the run was not optimised.
        """
        number, run_sample = self.arm.joint_index(joint), self._select_sample(optimised)
        return upgrade.make_sample_distribution(
            self.index, run_sample, self._values_if_never_failing(number, run_sample, optimised)
        )

    @check_arguments
    def upgrades(self, threshold: float | None = None, optimised: bool = False, confidence: float = 0.95) -> list[Upgrade]:
        """Rank the joints by the gain from a redundant motor or brake, with which the joint could never fail.

        Args:
            threshold: Value of the index that the task needs. Default: :meth:`default_threshold`.
            optimised: True for the best configurations, which are optimised again without failures of each joint, for at most
                the first 500 poses, instead of those that inverse kinematics found.
            confidence: Confidence level of the intervals.

        Raises:
            InputError: The threshold is not finite, the rows were not kept, or the run was not optimised.
        """
        check_confidence(confidence)
        minimum = self.default_threshold() if threshold is None else threshold
        run_sample = self._select_sample(optimised)
        return upgrade.rank_upgrades(
            self.index, run_sample, lambda k: self._values_if_never_failing(k, run_sample, optimised), minimum, confidence
        )

    def _select_sample(self, optimised: bool) -> RunSample:
        self.distribution_of(optimised)  # raises InputError if the run was not optimised
        run_sample = make_run_sample(self.index, self.columns, optimised)
        return run_sample.first_poses if optimised else run_sample

    def _values_if_never_failing(self, joint: int, run_sample: RunSample, optimised: bool) -> FloatArray:
        """Return the values (N,) of a sample if a joint, given by its index, never failed; optimised values are cached."""
        cached: dict[int, FloatArray] = self.__dict__.setdefault("_optimised_without", {})
        if optimised and joint not in cached:
            cached[joint] = upgrade.optimise_index_excluding_joint(self.plan, self.columns, joint, run_sample)
        return cached[joint] if optimised else upgrade.compute_index_excluding_joint(self.index, joint, run_sample)

    # ---- rows, files -----------------------------------------------------------------------------------------------

    @property
    def has_rows(self) -> bool:
        """True if the rows were kept, in memory or in a folder, and not only counted in bins."""
        return self._rows is not None or self.store is not None

    @property
    def columns(self) -> Mapping[str, Any]:
        """Rows by column, (N, ...) each, which are read when they are sliced; :attr:`dataset` adds names and units.

        Raises:
            InputError: The rows were not kept; give ``store`` or ``keep=True``.
        """
        if self._rows is not None:
            return self._rows
        if self.store is not None:
            return self.store.arrays()
        raise InputError("the poses of this run were not kept; assess again with store=PATH, keep=True, or keep: rows")

    @property
    def dataset(self) -> xr.Dataset:
        """All poses with configurations and index values, as an xarray dataset with units and provenance.

        Raises:
            InputError: The rows were not kept; give ``store`` or ``keep=True``.
            HoldfastError: xarray is not installed (extra ``xarray``); ``columns`` has the same values as NumPy arrays.
        """
        xr = import_extra("xarray", "xarray")

        if self._rows is None and self.store is not None:
            return self.store.dataset()
        columns = {column.name: column for column in self.plan.columns()}
        data = {
            name: xr.DataArray(
                values,
                dims=("row", *[dimension for dimension, _ in columns[name].dims]),
                attrs={"units": columns[name].units, "long_name": columns[name].about},
            )
            for name, values in self.columns.items()
        }
        return xr.Dataset(data, attrs={"plan": json.dumps(self.plan.to_dict())})

    def claim(self) -> ReachClaim:
        """Return the claim, for :func:`holdfast.certify`, that every pose is reached, after a sample that missed none."""
        from holdfast.studies.assessment.suggested import make_region_claim

        return make_region_claim(self.arm, self.region, self.index.task, self.distribution.unreached)

    def to_dict(
        self,
        thresholds: Sequence[float] | None = None,
        rates: Mapping[str | int, float] | None = None,
        report: Path | None = None,
    ) -> dict[str, Any]:
        """Return the result as JSON data; see :meth:`holdfast.core.result.Result.to_dict`.

        Args:
            thresholds: Values of the index for which to give the probability. Default: some values over its range.
            rates: Relative failure rates by joint name or index from 0, for :meth:`expected_survival`.
            report: Path of the report, which the data then contain.
        """
        return super().to_dict(thresholds=thresholds, rates=rates, report=report)

    @check_arguments
    def save(self, folder: str | Path, threshold: float | None = None) -> list[Path]:
        """Write the rows and the report into a results folder that :func:`holdfast.load` and ``holdfast report`` read.

        Args:
            folder: Path of the folder; rows that are already in it stay there.
            threshold: Value of the index that the task needs, for :meth:`report`.

        Returns:
            Paths of ``run.json``, which describes the contents of the folder, and ``report.html``.

        Raises:
            StoreError: The folder contains other files, or cannot be written.
            InputError: The rows were not kept.
        """
        target = Path(folder)
        if self._rows is not None:
            self._write_rows(target, self._rows)
        elif self.store is None or self.store.path.resolve() != target.resolve():
            raise InputError("the poses of this run were not kept, or are in another folder already; assess with store=PATH")
        return [target / "run.json", self.report(target / "report.html", threshold)]

    @reports_progress("writing the results")
    def _write_rows(self, folder: Path, rows: Rows) -> None:
        store = self.plan.create_store(folder)
        with store.lock_for_writing():
            store.commit_missing(lambda missing: ((chunk, _take_rows(rows, *store.chunk_span(chunk))) for chunk in missing))
            store.add_notes(**describe_provenance(self.seconds))

    @check_arguments
    @reports_progress("drawing the report")
    def report(self, path: str | Path, threshold: float | None = None) -> Path:
        """Write a self-contained HTML report.

        Args:
            path: Path of the file, which is replaced in one step.
            threshold: Value of the index that the task needs. Default: half of the bound, or the median.

        Raises:
            StoreError: The file cannot be written.
        """
        return super().report(path, threshold=threshold)


def _take_rows(rows: Rows, start: int, stop: int) -> Rows:
    return {name: values[start:stop] for name, values in rows.items()}
