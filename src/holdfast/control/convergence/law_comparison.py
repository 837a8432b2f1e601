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
    """The N motions of one law with one joint locked, or with none.

    Attributes:
        law: Name of the law.
        failure: ``healthy``, or the name of the joint.
        code: (N,) :class:`holdfast.control.simulation.RunOutcome`.
        reason: (N,) :class:`holdfast.control.simulation.Reason`.
        reachable: (N,) True where the target can still be reached with the joint locked, as far as was found
            and joint limits left aside.
        error: (N,) norm of the task's error at the end, m and rad, as the law's own command has it.
        position_error: (N,) distance of the tool point from the target at the end in the directions of the task, m.
        angle_error: (N,) angle of the end effector from the target at the end in the directions of the task, rad.
        excess: (N,) that minus the least error that the failed arm could have, as far as was found.
        closest: (N,) least error on the way.
        path_length: (N,) m, of the tool point.
        path_ratio: (N,) that by the straight way from start to target in the directions that the task prescribes.
        excursion: (N,) sum over the joints of the range that each went through, rad (and m).
        past_limits: (N,) True where a joint left its limits, which the motion does not heed.
        time: (N,) s, or cycles, when the run ended.
        contacts: (N,) what each run touches first, None for nothing; None if nobody looked.
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
        """Return (N,) True for the runs that are ``converged``, ``stuck``, ``moving``, or ``undecided``.

        Raises:
            InputError: No such outcome.
        """
        if outcome.upper() not in RunOutcome.__members__:
            raise InputError(f"outcome '{outcome}' is not known; use converged, stuck, moving or undecided")
        return np.asarray(self.code == RunOutcome[outcome.upper()])

    def share(self, outcome: str = "converged", among_reachable: bool = False) -> Interval | None:
        """Return the fraction of the runs that ended so, with its exact 95 % interval; None of no runs.

        Args:
            outcome: ``converged``, ``stuck``, ``moving`` or ``undecided``.
            among_reachable: Of the runs whose target is still within reach only.
        """
        is_hit = self.has_outcome(outcome)
        if among_reachable:
            is_hit = is_hit[self.reachable]
        return Interval.from_counts(int(is_hit.sum()), is_hit.size) if is_hit.size else None


@dataclass(frozen=True, eq=False, kw_only=True)
class LawComparison(Result):
    """Laws on the same N motions; see :func:`compare_laws`.

    Attributes:
        laws: The laws, of which the first is the one that the others are compared with.
        names: Of the laws.
        failures: ``healthy`` and the names of the joints that were locked, each alone.
        runs: Of each law, (F N) runs: all motions healthy, then all with the first joint locked, and so on.
        least_error: (F, N) least error that was found for the failed arm, the same for all laws.
        way: (N,) straight way from start to target in the directions that the task prescribes, m.
        healthy: Of each law, what it costs the arm before a failure.
        about: What the motions are, a phrase for people.
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
        """Collision model with which the runs were checked for contacts, or None if they were not. It changes no run."""
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
            raise InputError(f"there is no law '{name}' here; there are {', '.join(self.names)}")
        return self.names.index(name)

    def _failure_index(self, failure: str | int) -> int:
        joint_name = self.arm.joint_names[self.arm.joint_index(failure)] if isinstance(failure, int) else failure
        if joint_name not in self.failures:
            raise InputError(f"'{joint_name}' was not locked here; there are {', '.join(self.failures)}")
        return self.failures.index(joint_name)

    def case(self, law: str, failure: str | int = HEALTHY_CASE) -> Case:
        """Return the runs of one law with one joint locked.

        Args:
            law: Its name.
            failure: ``healthy``, or a joint by name or index from 0.

        Raises:
            InputError: It was not part of the comparison.
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
        """Return (K, N) the values of an attribute of :class:`holdfast.control.convergence.Case` for K locked joints.

        Raises:
            InputError: No such law, or no joint was locked.
        """
        if not self.joints:
            raise InputError("no joint was locked here; give failures='single' or a list of joints")
        return np.array([getattr(self.case(law, joint), of) for joint in self.joints])

    def share_any(self, law: str, outcome: str = "converged") -> Interval:
        """Return the fraction of an outcome where each joint is equally likely to lock, with its 95 % interval.

        The runs of one motion with different joints locked are not independent samples: the unit is the motion, and the
        interval that of a mean of fractions, which always covers (:meth:`holdfast.core.probability.Interval.of_fractions`).
        """
        return Interval.of_fractions((self.pool_values(law, "code") == RunOutcome[outcome.upper()]).mean(axis=0))

    def touched_any(self, law: str) -> Interval:
        """Return the fraction of the runs with a contact where each joint is equally likely to lock; as :meth:`share_any`.

        Distances are lower bounds, so it is at most so many.
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
        """Return how many more of the same motions converge under a law than under another, as a fraction with its 95 %
        interval.

        Paired: for one joint by the method of Newcombe with exact limits
        (:meth:`holdfast.core.probability.Difference.of_pairs`, which says how well it covers). For ``any joint`` it is the
        mean over the joints of each motion, because the runs of a motion go together, with the interval of fractions, which
        always covers.

        Args:
            law: Its name.
            failure: ``healthy``, ``any joint``, or a joint by name or index from 0.
            than: The other law; the first if not given.
            among_reachable: Of the motions whose target is still within reach only; not for ``any joint``.
            undecided: What undecided runs with a target within reach count as, for they may yet converge: ``lost`` under either
                law, as if they all converged under this law (``for``), or as if they all did under the other (``against``).

        Raises:
            InputError: A law or a joint that was not part of the comparison, or no motion to compare.
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

        Paired, from the differences of each motion, for ``any joint`` from their means over the joints. Runs that are still
        moving count as they were when time was up. Errors have no bound, so the interval is Student's t, which may cover too
        little for few motions of which a few differ much (:meth:`holdfast.core.probability.Difference.of_means`).

        Args:
            law: Its name.
            of: Which error of :class:`holdfast.control.convergence.Case`, m or rad.
            failure: ``healthy``, ``any joint``, or a joint by name or index from 0.
            than: The other law; the first if not given.

        Raises:
            InputError: A law or a joint that was not part of the comparison, or fewer than two motions.
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
        """Return (L,) quantiles of the cost of a law for the healthy arm, over the motions that converge under every law.

        Args:
            law: Its name.
            of: An attribute of :class:`holdfast.control.convergence.HealthyCost`.
            levels: 0 to 1.
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
        """One dictionary for each law and failure, for people, files and tables; shares are of all motions.

        ``law, failure, motions, converged`` and its 95 % interval ``converged_low, converged_high``; the same of ``stuck``,
        ``moving`` and ``undecided``; ``reachable`` (share of targets still within reach) and ``converged_reachable`` among
        them; ``converged_within_limits`` (converged, and no joint passed a limit on the way); ``position_error_m_*`` and
        ``angle_error_rad_*`` (quantiles at the end, as far as the task prescribes them), ``position_error_m_astray`` and
        ``angle_error_rad_astray`` (medians of the runs that did not converge), ``path_ratio`` and ``excursion`` (medians), and
        ``past_limits`` (share of runs with a joint beyond a limit). Of a task in one unit also ``excess_*`` (quantiles of the
        end error above the least) and ``closest`` (median of the least error on the way), m or rad. Where somebody looked,
        also ``touched`` (share of runs that touch something, with its interval) and ``converged_clear`` (converged, and
        touched nothing on the way).
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
        """Return the number of undecided runs of a law, healthy and failed, for each reason."""
        reason = self.runs[self._law_index(law)].reason
        return {cause.name.lower(): int((reason == cause).sum()) for cause in UNDECIDED_REASONS if (reason == cause).any()}


def target_error_threshold(law: Law) -> float:
    """Return the norm of the error, m and rad, below which a target counts as reached at rest."""
    return CONVERGENCE_TOLERANCE if law.task.angular else CONVERGENCE_TOLERANCE * law.arm.length_unit


def _has_converged(case: Case, counts_undecided: bool) -> BoolArray:
    """Return (N,) True for the runs that converged, and if generous also for those that may still converge."""
    return case.has_outcome("converged") | (counts_undecided & case.has_outcome("undecided") & case.reachable)


def _finite_quantile(values: FloatArray, level: float) -> float | None:
    finite = values[np.isfinite(values)]
    return float(np.quantile(finite, level)) if finite.size else None


def _interval_columns(name: str, interval: Interval | None) -> dict[str, float | None]:
    if interval is None:
        return {name: None, f"{name}_low": None, f"{name}_high": None}
    return {name: interval.value, f"{name}_low": interval.low, f"{name}_high": interval.high}
