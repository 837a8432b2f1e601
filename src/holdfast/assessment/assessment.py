"""The result of an assessment: how probably an index meets a threshold after a failure, and what follows."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.assessment import upgrade
from holdfast.assessment.answer import ZERO, Answer
from holdfast.assessment.plan import Plan, Rows
from holdfast.assessment.rows import Collisions, provenance
from holdfast.assessment.upgrade import Sample, Upgrade, check_rates, sample
from holdfast.engine.store import Store
from holdfast.errors import InputError
from holdfast.indices.index import Index
from holdfast.notice import says
from holdfast.probability.distribution import Distribution, Interval
from holdfast.probability.intervals import check_confidence
from holdfast.regions.region import Region, Sampling
from holdfast.result import Result

if TYPE_CHECKING:
    import xarray as xr

    from holdfast.certificates import ReachClaim

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Assessment(Result):
    """What :func:`holdfast.assess` found.

    Attributes:
        plan: What was asked for.
        distribution: Of the index over the region, at the configurations that inverse kinematics found.
        worst_counts: (F,) how often each failure is the worst, over reached and non-singular poses; if poses have weights,
            the sum of theirs.
        optimised: The distribution at the best configurations, or None if they were not asked for.
        optimised_worst_counts: As ``worst_counts``, at the best configurations.
        survivors: (n,) poses that can still be reached once the joint has locked, or their weights; 0 for joints that were
            not asked for, None if none was.
        collisions: Configurations that bring the arm into collision with itself or its cell, or None if that was not looked at.
        clear: Poses of which a configuration clear of itself and the cell was found, or their weights; None without a cell.
        store: The results folder, if one was written.
        seconds: Time it took, or None if that is not known.
        complete: False if the run was stopped before all poses were done.
    """

    plan: Plan
    distribution: Distribution
    worst_counts: NDArray[Any]
    optimised: Distribution | None
    optimised_worst_counts: NDArray[Any] | None
    survivors: NDArray[Any] | None
    collisions: Collisions | None
    clear: float | None
    store: Store | None
    seconds: float | None
    complete: bool
    _rows: Rows | None = None

    @property
    def arm(self) -> Arm:
        """The arm."""
        return self.plan.arm

    @property
    def region(self) -> Region:
        """The region."""
        return self.plan.region

    @property
    def index(self) -> Index:
        """The index."""
        return self.plan.index

    @property
    def poses(self) -> int:
        """Poses asked for."""
        return self.plan.poses

    @property
    def seed(self) -> int:
        """Seed of the run."""
        return self.plan.seed

    @property
    def sampling(self) -> Sampling:
        """How poses were drawn."""
        return self.plan.sampling

    @property
    def restarts(self) -> int:
        """Random starts per pose before it counted as not found."""
        return self.plan.restarts

    def of(self, optimised: bool) -> Distribution:
        """The distribution at the best configurations, or at those that inverse kinematics found.

        Raises:
            InputError: The run was not optimised.
        """
        if not optimised:
            return self.distribution
        if self.optimised is None:
            raise InputError("this run was not optimised; assess again with optimise=True")
        return self.optimised

    @checked
    def cdf(self, h: ArrayLike, optimised: bool = False, reachable_only: bool = False) -> Array:
        """``F(h)``: share of poses whose index is below h; one without a configuration counts as 0 unless asked otherwise."""
        return self.of(optimised).cdf(h, reachable_only)

    @checked
    def probability(
        self,
        at_least: float | None = None,
        at_most: float | None = None,
        optimised: bool = False,
        *,
        reachable_only: bool = False,
    ) -> float:
        """Probability that the index meets a threshold: ``1 - F(h)``."""
        return self.of(optimised).probability(at_least, at_most, reachable_only)

    @checked
    def interval(
        self,
        at_least: float | None = None,
        at_most: float | None = None,
        optimised: bool = False,
        *,
        reachable_only: bool = False,
        confidence: float = 0.95,
    ) -> Interval:
        """That probability with its exact (Clopper-Pearson) interval."""
        return self.of(optimised).interval(at_least, at_most, reachable_only, confidence=confidence)

    @checked
    def survival(self, joint: str | int | None = None, confidence: float = 0.95) -> dict[str, Interval]:
        """Share of all poses of the region that can still be reached once a joint has locked, with its exact interval.

        The joint is locked at the angle that ``locked`` gave, else where it was at another pose of the region; :attr:`locks`
        says which. A pose that the healthy arm does not reach counts as
        lost; so does one that was not found again in a limited number of starts, so the shares are lower bounds. With a cell
        only configurations count that are clear of it and of the arm itself, locked or not; see :meth:`reached_clear`.

        Args:
            joint: Name or index from 0; every joint that the run asked for if not given.
            confidence: Of the interval.

        Raises:
            InputError: The run did not ask; assess again with ``after_lock=True``.
        """
        check_confidence(confidence)
        if self.survivors is None:
            raise InputError("this run did not look at what survives a lock; assess again with after_lock=True")
        chosen = list(self.plan.locks) if joint is None else [self.arm.joint_index(joint)]
        names = self.arm.joint_names
        for k in chosen:
            if k not in self.plan.locks:
                raise InputError(
                    f"this run did not look at a lock of '{names[k]}'; assess again with after_lock=True or with it in locked"
                )
        return {names[k]: self._share(float(self.survivors[k]), confidence) for k in chosen}

    def _share(self, hits: float, confidence: float) -> Interval:
        """Of all poses, by weight if they have one."""
        d = self.distribution
        if d.weighted:
            return Interval.of_share(min(hits / d.total_weight(), 1.0), d.effective(), confidence)
        return Interval.of(int(hits), d.samples, confidence)

    @checked
    def reached_clear(self, confidence: float = 0.95) -> Interval:
        """Share of all poses that the healthy arm reaches clear of itself and its cell, with its exact interval.

        A pose of which no such configuration was found in a limited number of starts counts as lost, and the spheres that
        cover the arm reach a little beyond it, so the share is a lower bound.

        Raises:
            InputError: The run had no cell, or was over a region of joints.
        """
        check_confidence(confidence)
        if self.clear is None:
            raise InputError("this run had no cell around the arm; assess again with cell=")
        return self._share(self.clear, confidence)

    @property
    def locks(self) -> dict[str, float | None]:
        """Where each joint of :meth:`survival` locks: an angle (rad or m), or None for where it was at another pose."""
        return {self.arm.joint_names[k]: angle for k, angle in self.plan.locks.items()}

    @checked
    def expected_survival(self, rates: Mapping[str | int, float]) -> float:
        """Share of the region that is left after a failure, weighted by how often each joint fails.

        Args:
            rates: Relative failure rates by joint name or index from 0; joints that are not named do not fail.

        Raises:
            InputError: A negative rate, or none above 0, or the run did not ask (for a joint with a rate above 0).
        """
        weights = check_rates(self.arm, rates)
        some = np.flatnonzero(weights)
        shares = np.array([self.survival(int(k))[self.arm.joint_names[k]].value for k in some])
        return float(shares @ weights[some] / weights.sum())

    # ---- what it means ---------------------------------------------------------------------------------------------

    def default_threshold(self) -> float:
        """The value that reports ask for unless they are given one: half of the bound, else about the median; two digits."""
        if self.index.bound is not None:
            return float(f"{self.index.bound / 2:.2g}")
        d = self.distribution
        for v in [*(d.quantile([0.5, 0.25]).tolist() if d.reached else []), d.highest]:
            if np.isfinite(v) and abs(v) > ZERO:
                return float(f"{v:.2g}")
        return 1.0

    def gap(self, optimised: bool = False) -> float | None:
        """Distance of the median over the reached poses from the bound of every configuration; None if unknown.

        For relative manipulability after any one failure the bound is ``sqrt((n - m) / n)``. What is known of
        the bound for several failures at a time, ``index.bound_note`` says.
        """
        d = self.of(optimised)
        if self.index.bound is None or not d.reached:
            return None
        return self.index.bound - float(d.quantile(0.5))

    @checked
    def if_never_fails(self, joint: str | int, optimised: bool = False) -> Distribution:
        """Compute the distribution if one joint could never fail: the worst case over the remaining failures.

        Args:
            joint: Name or index from 0.
            optimised: At configurations optimised again for the remaining failures, of at most the first 500 poses, instead
                of those that inverse kinematics found.

        Raises:
            InputError: No such joint, no failure would be left, the rows were not kept, or the run was not optimised.
        """
        k, s = self.arm.joint_index(joint), self._sample(optimised)
        return upgrade.distribution_without(self.index, s, self._compute_values_without(k, s, optimised))

    @checked
    def upgrades(self, threshold: float | None = None, optimised: bool = False, confidence: float = 0.95) -> list[Upgrade]:
        """Rank the joints by what a redundant motor or brake, with which the joint could never fail, would gain.

        Args:
            threshold: Value of the index that the task needs; :meth:`default_threshold` if not given.
            optimised: At the best configurations, optimised again without each joint, of at most the first 500 poses, instead
                of those that inverse kinematics found.
            confidence: Of the intervals.

        Raises:
            InputError: The threshold is not finite, the rows were not kept, or the run was not optimised.
        """
        check_confidence(confidence)
        least = self.default_threshold() if threshold is None else threshold
        s = self._sample(optimised)
        return upgrade.upgrades(self.index, s, lambda k: self._compute_values_without(k, s, optimised), least, confidence)

    def _sample(self, optimised: bool) -> Sample:
        self.of(optimised)  # says so where the run was not optimised
        s = sample(self.index, self.columns, optimised)
        return s.first if optimised else s

    def _compute_values_without(self, k: int, s: Sample, optimised: bool) -> Array:
        """Return the values (N,) of a sample if a joint, from 0, never failed; optimised values are computed once."""
        known: dict[int, Array] = self.__dict__.setdefault("_optimised_without", {})
        if optimised and k not in known:
            known[k] = upgrade.optimised_value_without(self.plan, self.columns, k, s)
        return known[k] if optimised else upgrade.value_without(self.index, k, s)

    # ---- rows, files -----------------------------------------------------------------------------------------------

    @property
    def kept(self) -> bool:
        """True if the rows were kept, in memory or in a folder, and not only counted in bins."""
        return self._rows is not None or self.store is not None

    @property
    def columns(self) -> Mapping[str, Any]:
        """The rows by column, (N, ...) each, read when it is sliced: :attr:`dataset` without names and units.

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
        """Every pose with its configuration and index values, as an xarray dataset with units and provenance.

        Raises:
            InputError: The rows were not kept; give ``store`` or ``keep=True``.
        """
        import xarray as xr

        if self._rows is None and self.store is not None:
            return self.store.dataset()
        columns = {c.name: c for c in self.plan.columns()}
        data = {
            name: xr.DataArray(
                values,
                dims=("row", *[d for d, _ in columns[name].dims]),
                attrs={"units": columns[name].units, "long_name": columns[name].about},
            )
            for name, values in self.columns.items()
        }
        return xr.Dataset(data, attrs={"plan": json.dumps(self.plan.to_dict())})

    def claim(self) -> ReachClaim:
        """What the sample suggests where it missed no pose: :func:`holdfast.certify` proves that every pose is reached."""
        from holdfast.assessment.suggested import region_claim

        return region_claim(self.arm, self.region, self.index.task, self.distribution.unreached)

    def describe(self) -> list[str]:
        """The answer at :meth:`default_threshold`, and what it is about."""
        said = [Answer(self, None).headline]
        if not self.complete:
            said.append(f"Not finished: {self.distribution.samples} of {self.poses} poses.")
        return [*said, f"{self.arm.title}: {self.index.describe()}.", f"{self.region.name}: {self.region.describe()}."]

    def to_dict(
        self,
        thresholds: Sequence[float] | None = None,
        rates: Mapping[str | int, float] | None = None,
        report: Path | None = None,
    ) -> dict[str, Any]:
        """See :meth:`holdfast.result.Result.to_dict`.

        Args:
            thresholds: Values of the index to give the probability of; some over its range if not given.
            rates: How often each joint fails, for :meth:`expected_survival`.
            report: Where the report was written, to be named.
        """
        return super().to_dict(thresholds=thresholds, rates=rates, report=report)

    @checked
    def save(self, folder: str | Path, threshold: float | None = None) -> list[Path]:
        """Write the rows and the report into a results folder that :func:`holdfast.load` and ``holdfast report`` read.

        Args:
            folder: The folder; the rows stay where they are if they are in it.
            threshold: See :meth:`report`.

        Returns:
            ``run.json``, which says what the folder holds, and ``report.html``.

        Raises:
            StoreError: The folder exists with something else in it, or cannot be written.
            InputError: The rows were not kept.
        """
        target = Path(folder)
        if self._rows is not None:
            self._write(target, self._rows)
        elif self.store is None or self.store.path.resolve() != target.resolve():
            raise InputError("the poses of this run were not kept, or are in another folder already; assess with store=PATH")
        return [target / "run.json", self.report(target / "report.html", threshold)]

    @says("writing the results")
    def _write(self, folder: Path, rows: Rows) -> None:
        store = self.plan.create(folder)
        with store.writing():
            for k in store.missing:
                start, stop = store.chunks[k]
                store.write(k, {name: values[start:stop] for name, values in rows.items()})
            store.note(**provenance(self.seconds))

    @checked
    @says("drawing the report")
    def report(self, path: str | Path, threshold: float | None = None) -> Path:
        """Write a self-contained HTML report.

        Args:
            path: The file, replaced in one step.
            threshold: Value of the index that the task needs; half of the bound, or the median, if not given.

        Raises:
            StoreError: The file cannot be written.
        """
        return super().report(path, threshold)
