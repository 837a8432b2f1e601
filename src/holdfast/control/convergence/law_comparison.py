"""Comparison of control laws on the same motions, with each joint locked in turn: convergence, and cost."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from holdfast.control.convergence.healthy_cost import HealthyCost
from holdfast.control.laws.law import Law
from holdfast.control.simulation.batch import CONVERGENCE_TOLERANCE
from holdfast.control.simulation.errors import error_kinds
from holdfast.control.simulation.runs import UNDECIDED_REASONS, RunOutcome, Runs
from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.probability.intervals import Difference, Interval
from holdfast.core.result import Result
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.model.arm.model import Arm

if TYPE_CHECKING:
    from holdfast.model.collision.clearance import Clearance
    from holdfast.model.collision.contacts import Contact


ErrorOf = Literal["error", "excess", "closest", "position_error", "angle_error"]
HEALTHY_CASE = "healthy"
ANY_JOINT = "any joint"
QUANTILE_LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)


@dataclass(frozen=True, eq=False, kw_only=True)
class Case:
    """Runs of N motions under one law with one joint locked, or without a failure.

    Attributes:
        law: Name of the law.
        failure: ``healthy``, or the name of the locked joint.
        code: (N,) :class:`holdfast.control.simulation.RunOutcome` of each run.
        reason: (N,) :class:`holdfast.control.simulation.Reason` of each run.
        reachable: (N,) True if a configuration was found that reaches the target with the joint locked, without regard to joint
            limits.
        error: (N,) norm of the task's error at the end, m and rad, as in the command of the law.
        position_error: (N,) distance of the tool point from the target at the end in the directions of the task, m.
        angle_error: (N,) angle of the end effector from the target at the end in the directions of the task, rad.
        excess: (N,) ``error`` minus the least error that was found for the failed arm.
        closest: (N,) least error during the run, m and rad.
        path_length: (N,) length of the path of the tool point, m.
        path_ratio: (N,) path length divided by the straight distance from start to target in the directions of the task.
        excursion: (N,) sum over the joints of the range that each passed through, rad (and m).
        past_limits: (N,) True if a joint left its limits, which the motion does not enforce.
        time: (N,) simulated time at the end of the run, s or cycles.
        contacts: (N,) first contact of each run, None without contact; None if contacts were not checked.
    """

    law: str
    failure: str
    code: NDArray[np.uint8]
    reason: NDArray[np.uint8]
    reachable: BoolArray
    error: FloatArray
    position_error: FloatArray
    angle_error: FloatArray
    excess: FloatArray
    closest: FloatArray
    path_length: FloatArray
    path_ratio: FloatArray
    excursion: FloatArray
    past_limits: BoolArray
    time: FloatArray
    contacts: tuple[Contact | None, ...] | None = None

    @property
    def has_contact(self) -> BoolArray:
        """(N,) array that is True for runs with a contact on the way, as far as contacts were checked."""
        return np.array([contact is not None for contact in self.contacts or ()] or np.zeros(len(self.code)), dtype=bool)

    def has_outcome(self, outcome: str) -> BoolArray:
        """Return a mask (N,) of the runs with the ``outcome`` ``converged``, ``stuck``, ``moving``, or ``undecided``.

        Raises:
            InputError: The outcome is not known.
        """
        if outcome.upper() not in RunOutcome.__members__:
            raise InputError(f"outcome '{outcome}' is not known; use converged, stuck, moving or undecided")
        return np.asarray(self.code == RunOutcome[outcome.upper()])

    def share(self, outcome: str = "converged", among_reachable: bool = False) -> Interval | None:
        """Return the fraction of the runs with an outcome, with its exact 95 % interval; None if there are no runs.

        Args:
            outcome: ``converged``, ``stuck``, ``moving`` or ``undecided``.
            among_reachable: True to count only the runs whose target is still within reach.
        """
        is_hit = self.has_outcome(outcome)
        if among_reachable:
            is_hit = is_hit[self.reachable]
        return Interval.from_counts(int(is_hit.sum()), is_hit.size) if is_hit.size else None


@dataclass(frozen=True, eq=False, kw_only=True)
class LawComparison(Result):
    """Comparison of several control laws on the same N motions, healthy and with F - 1 locked joints; see :func:`compare_laws`.

    Attributes:
        laws: The control laws. The others are compared with the first law.
        names: Names of the laws.
        failures: ``healthy``, and the names of the joints that were locked, each alone.
        runs: (F N) runs of each law: all motions without failure, then all with the first joint locked, and so on.
        least_error: (F, N) least error that was found for the failed arm, m and rad; it is the same for all laws.
        way: (N,) straight distance from start to target in the directions of the task, m.
        healthy: Cost of each law for the healthy arm.
        about: Phrase that describes the motions.
    """

    laws: tuple[Law, ...]
    names: tuple[str, ...]
    failures: tuple[str, ...]
    runs: tuple[Runs, ...]
    least_error: FloatArray
    way: FloatArray
    healthy: tuple[HealthyCost, ...]
    about: str = field(default="", kw_only=True)

    def __len__(self) -> int:
        return len(self.way)

    @property
    def arm(self) -> Arm:
        """The arm."""
        return self.laws[0].arm

    @property
    def clearance(self) -> Clearance | None:
        """Collision model with which the runs were checked for contacts; None if they were not. The check changes no run."""
        return self.runs[0].clearance

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints that were locked."""
        return self.failures[1:]

    @property
    def accuracy(self) -> float:
        """Error at which a target counts as reached, m and rad."""
        first_runs = self.runs[0]
        return first_runs._settings.accuracy if first_runs.cycles else target_error_threshold(first_runs.law)

    def _law_index(self, name: str) -> int:
        if name not in self.names:
            raise InputError(f"law '{name}' is not in this comparison; use {', '.join(self.names)}")
        return self.names.index(name)

    def _failure_index(self, failure: str | int) -> int:
        joint_name = self.arm.joint_names[self.arm.joint_index(failure)] if isinstance(failure, int) else failure
        if joint_name not in self.failures:
            raise InputError(f"failure '{joint_name}' is not in this comparison; use {', '.join(self.failures)}")
        return self.failures.index(joint_name)

    def case(self, law: str, failure: str | int = HEALTHY_CASE) -> Case:
        """Return the runs of one law with one joint locked.

        Args:
            law: Name of the law.
            failure: ``healthy``, or the name or index from 0 of the locked joint.

        Raises:
            InputError: The law or the failure is not in the comparison.
        """
        law_runs, failure_number = self.runs[self._law_index(law)], self._failure_index(failure)
        rows = slice(failure_number * len(self), (failure_number + 1) * len(self))
        least_errors = self.least_error[failure_number]
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.where(self.way > 1e-9, law_runs.path_length[rows] / self.way, np.nan)
        return Case(
            law=law,
            failure=self.failures[failure_number],
            code=law_runs.code[rows],
            reason=law_runs.reason[rows],
            reachable=least_errors <= self.accuracy,
            error=law_runs.error[rows],
            position_error=law_runs.position_error[rows],
            angle_error=law_runs.angle_error[rows],
            excess=law_runs.error[rows] - np.fmin(least_errors, law_runs.error[rows]),
            closest=law_runs.closest[rows],
            path_length=law_runs.path_length[rows],
            path_ratio=ratio,
            excursion=(law_runs.q_high[rows] - law_runs.q_low[rows]).sum(axis=1),
            past_limits=np.asarray(law_runs.limits_passed[rows].any(axis=1)),
            time=law_runs.time[rows],
            contacts=None if law_runs.contacts is None else law_runs.first_contacts[rows],
        )

    def pool_values(self, law: str, of: str) -> NDArray[Any]:
        """Return the values (K, N) of an attribute for K locked joints.

        Args:
            law: Name of the law.
            of: Name of an attribute (N,) of :class:`holdfast.control.convergence.Case`.

        Raises:
            InputError: The law is not in the comparison, or no joint was locked.
        """
        if not self.joints:
            raise InputError("no joint was locked here; give failures='single' or a list of joints")
        return np.array([getattr(self.case(law, joint), of) for joint in self.joints])

    def share_any(self, law: str, outcome: str = "converged") -> Interval:
        """Return the fraction of an outcome if each joint is equally likely to lock, with its 95 % interval.

        The runs of one motion with different joints locked are not independent samples. The sampling unit is therefore the
        motion, and the interval is that of a mean of fractions, which always covers
        (:meth:`holdfast.core.probability.Interval.of_fractions`).

        Args:
            law: Name of the law.
            outcome: ``converged``, ``stuck``, ``moving`` or ``undecided``.
        """
        return Interval.of_fractions((self.pool_values(law, "code") == RunOutcome[outcome.upper()]).mean(axis=0))

    def touched_any(self, law: str) -> Interval:
        """Return the fraction of runs with a contact under ``law``, with the weights and the interval of :meth:`share_any`.

        Distances are lower bounds, so the fraction is an upper bound.
        """
        return Interval.of_fractions(self.pool_values(law, "touched").mean(axis=0))

    def gain(
        self,
        law: str,
        failure: str | int = ANY_JOINT,
        than: str | None = None,
        *,
        among_reachable: bool = False,
        undecided: Literal["lost", "for", "against"] = "lost",
    ) -> Difference:
        """Return the difference between the fractions of motions that converge under two laws, with its 95 % interval.

        The difference is paired. For one joint, its interval is Newcombe's with exact limits
        (:meth:`holdfast.core.probability.Difference.of_pairs` documents its coverage). For ``any joint`` it is that of the
        means over the joints of each motion, because the runs of a motion are correlated; this interval always covers.

        Args:
            law: Name of the law.
            failure: ``healthy``, ``any joint``, or the name or index from 0 of the locked joint.
            than: Name of the law whose fraction is subtracted. Default: the first law.
            among_reachable: True to count only motions whose target is still within reach; not for ``any joint``.
            undecided: Assumption on undecided runs with a target within reach, which may still converge: they converge under
                neither law (``lost``), all under this law (``for``), or all under the other law (``against``).

        Raises:
            InputError: A law or joint is not in the comparison, or there is no motion to compare.
        """
        other = self.names[0] if than is None else than
        counts_undecided = {"lost": (False, False), "for": (False, True), "against": (True, False)}[undecided]
        if failure == ANY_JOINT:
            if not self.joints:
                raise InputError("a mean over the joints takes a locked joint; give failures='single' or name one joint")
            other_converged, law_converged = (
                np.array([_has_converged(self.case(law_name, joint), is_generous) for joint in self.joints])
                for law_name, is_generous in zip((other, law), counts_undecided, strict=True)
            )
            return Difference.of_fractions(law_converged.mean(axis=0) - other_converged.mean(axis=0))
        other_case, law_case = self.case(other, failure), self.case(law, failure)
        is_compared = other_case.reachable if among_reachable else np.ones(len(self), dtype=bool)
        if not is_compared.any():
            raise InputError(f"no target is within reach with '{other_case.failure}' locked; leave out among_reachable")
        return Difference.of_pairs(
            _has_converged(other_case, counts_undecided[0])[is_compared],
            _has_converged(law_case, counts_undecided[1])[is_compared],
        )

    def change(self, law: str, of: ErrorOf, failure: str | int = ANY_JOINT, *, than: str | None = None) -> Difference:
        """Return the mean change of an error at the end of the same motions between two laws, with its 95 % interval.

        The change is paired: it uses the difference of each motion, or, for ``any joint``, its mean over the joints. Runs that
        still move count with their error at the time limit. Errors have no upper bound, so the interval is Student's t, which
        may cover too little if there are few motions and a few differ strongly
        (:meth:`holdfast.core.probability.Difference.of_means`).

        Args:
            law: Name of the law.
            of: Name of an error of :class:`holdfast.control.convergence.Case`, m or rad.
            failure: ``healthy``, ``any joint``, or the name or index from 0 of the locked joint.
            than: Name of the law whose error is subtracted. Default: the first law.

        Raises:
            InputError: A law or joint is not in the comparison, or there are fewer than two motions.
        """
        law_names = (self.names[0] if than is None else than, law)
        if failure == ANY_JOINT:
            other_errors, law_errors = (self.pool_values(law_name, of).mean(axis=0) for law_name in law_names)
        else:
            other_errors, law_errors = (getattr(self.case(law_name, failure), of) for law_name in law_names)
        difference = (law_errors - other_errors)[np.isfinite(law_errors - other_errors)]
        if len(difference) < 2:
            raise InputError("a mean change takes two motions or more")
        return Difference.of_means(difference)

    def cost(
        self, law: str, of: Literal["deviation", "angle", "time"], levels: Sequence[float] = QUANTILE_LEVELS
    ) -> FloatArray:
        """Return the quantiles (L,) of the cost of a law for the healthy arm, over the motions that converge under every law.

        Args:
            law: Name of the law.
            of: Name of an attribute of :class:`holdfast.control.convergence.HealthyCost`, in m, rad, or s.
            levels: (L,) levels of the quantiles, from 0 to 1.
        """
        values = getattr(self.healthy[self._law_index(law)], of)[self.comparable]
        values = values[np.isfinite(values)]
        return np.quantile(values, levels) if values.size else np.full(len(levels), np.nan)

    @cached_property
    def comparable(self) -> BoolArray:
        """(N,) array that is True for the motions that converge under every law without a failure."""
        return np.asarray(np.all([self.case(name).has_outcome("converged") for name in self.names], axis=0))

    @cached_property
    def table(self) -> list[dict[str, Any]]:
        """Table of the results with one dictionary for each law and failure; fractions refer to all motions.

        The keys are ``law, failure, motions``; ``converged`` and its 95 % interval ``converged_low, converged_high``, and the
        same for ``stuck``, ``moving`` and ``undecided``; ``reachable`` (fraction of targets still within reach) and
        ``converged_reachable`` among them; ``converged_within_limits`` (converged, and no joint passed a limit);
        ``position_error_m_*`` and ``angle_error_rad_*`` (quantiles at the end, if the task prescribes them),
        ``position_error_m_astray`` and ``angle_error_rad_astray`` (medians of the runs that did not converge), ``path_ratio``
        and ``excursion`` (medians), and ``past_limits`` (fraction of runs with a joint beyond a limit). For a task in one unit
        there are also ``excess_*`` (quantiles of the final error above the least) and ``closest`` (median of the least error
        during the run), m or rad. If contacts were checked, there are also ``touched`` (fraction of runs with a contact, with
        its interval) and ``converged_clear`` (converged without a contact).
        """
        return [self._table_row(self.case(name, failure)) for name in self.names for failure in self.failures]

    def _table_row(self, case: Case) -> dict[str, Any]:
        row: dict[str, Any] = {"law": case.law, "failure": case.failure, "motions": len(self)}
        for outcome in RunOutcome:
            name = outcome.name.lower()
            row |= _interval_columns(name, case.share(name))
        row["reachable"] = float(case.reachable.mean())
        row |= _interval_columns("converged_reachable", case.share(among_reachable=True))
        row["converged_within_limits"] = float((case.has_outcome("converged") & ~case.past_limits).mean())
        kinds = error_kinds(self.laws[0])
        has_one_kind = len(kinds) == 1
        for column, values in [
            *((kind.key, getattr(case, kind.name)) for kind in kinds),
            *[("excess", case.excess)] * has_one_kind,
        ]:
            for level in QUANTILE_LEVELS:
                row[f"{column}_{round(100 * level):02d}"] = _finite_quantile(values, level)
        for kind in kinds:
            row[f"{kind.key}_astray"] = _finite_quantile(getattr(case, kind.name)[~case.has_outcome("converged")], 0.5)
        for column in (*["closest"] * has_one_kind, "path_ratio", "excursion"):
            row[column] = _finite_quantile(getattr(case, column), 0.5)
        row["past_limits"] = float(case.past_limits.mean())
        if case.contacts is not None:
            row |= _interval_columns("touched", Interval.from_counts(int(case.has_contact.sum()), len(self)))
            row["converged_clear"] = float((case.has_outcome("converged") & ~case.has_contact).mean())
        return row

    def reasons(self, law: str) -> dict[str, int]:
        """Return the number of undecided runs of ``law``, healthy and failed, for each reason."""
        reason = self.runs[self._law_index(law)].reason
        return {cause.name.lower(): int((reason == cause).sum()) for cause in UNDECIDED_REASONS if (reason == cause).any()}


def target_error_threshold(law: Law) -> float:
    """Return the norm of the error, m and rad, below which a target counts as reached at rest."""
    return CONVERGENCE_TOLERANCE if law.task.angular else CONVERGENCE_TOLERANCE * law.arm.length_unit


def _has_converged(case: Case, counts_undecided: bool) -> BoolArray:
    """Return a mask (N,) of runs that converged and, if ``counts_undecided``, of undecided runs that may converge."""
    return case.has_outcome("converged") | (counts_undecided & case.has_outcome("undecided") & case.reachable)


def _finite_quantile(values: FloatArray, level: float) -> float | None:
    finite = values[np.isfinite(values)]
    return float(np.quantile(finite, level)) if finite.size else None


def _interval_columns(name: str, interval: Interval | None) -> dict[str, float | None]:
    if interval is None:
        return {name: None, f"{name}_low": None, f"{name}_high": None}
    return {name: interval.value, f"{name}_low": interval.low, f"{name}_high": interval.high}
