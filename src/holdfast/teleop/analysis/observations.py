"""Observed trials: a checked table of trials as arrays over subjects, tasks and scenarios, with the missing ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.teleop.trials.performance import PERFORMANCE_MEASURES, RECORDED_MEASURES, compute_cpm
from holdfast.teleop.trials.recordings import End

if TYPE_CHECKING:
    from pandas import DataFrame

Words = NDArray[Any]

MEASURE_NAMES = tuple(m.name for m in PERFORMANCE_MEASURES)
REQUIRED_COLUMNS = ("subject", "task", "scenario", "law", "failed", "end", *MEASURE_NAMES[:RECORDED_MEASURES])
END_NAMES = tuple(e.name.lower() for e in End)
UNRATED_CAUSE = "no rating"
ABSENT_CAUSE = "not recorded"
CAUSE_SENTENCES = {
    **{e.name.lower(): e.sentence for e in End if e != End.ARRIVED},
    UNRATED_CAUSE: "the end effector reached the target, but the operator did not rate the trial",
    ABSENT_CAUSE: "the table has no such trial",
}
"""Reason why a trial has no CPM, by its cause."""
_FAILED_ENDS = tuple(e.name.lower() for e in (End.STILL, End.TIME, End.ABORTED))


@dataclass(frozen=True)
class Condition:
    """Scenario in a table of trials.

    Attributes:
        scenario: Number of the scenario.
        law: Control law, followed by the scenario's number if two scenarios have the same law and failure.
        failed: True if the arm had a locked joint.
    """

    scenario: int
    law: str
    failed: bool

    @property
    def label(self) -> str:
        """Label of the scenario: ``3: failed, pseudoinverse``."""
        return f"{self.scenario}: {'failed' if self.failed else 'healthy'}, {self.law}"


@dataclass(frozen=True, eq=False, kw_only=True)
class TrialTable:
    """Trials of P subjects with T tasks in S scenarios.

    Attributes:
        kind: ``person``, ``simulated`` or ``computer``.
        subjects: (P,) codes of the subjects.
        tasks: (T,) numbers of the tasks.
        conditions: (S,) scenarios.
        measures: (P, T, S, 12) M1 to M12, NaN in trials without a CPM.
        ratings: (P, T, S) M12 of every rated trial, also if the end effector did not reach the target.
        cause: (P, T, S) cause of a missing CPM; empty if there is a CPM.
        has_ratings: True if operators rated any trials. If not, CPM is the sum of eleven measures.
        cpm: (P, T, S) combined performance measures.
        normalisers: (11 or 12,) normalisers of the CPM.
    """

    kind: str
    subjects: tuple[str, ...]
    tasks: tuple[int, ...]
    conditions: tuple[Condition, ...]
    measures: FloatArray
    ratings: FloatArray
    cause: Words
    has_ratings: bool
    cpm: FloatArray
    normalisers: FloatArray

    @classmethod
    def from_table(cls, table: DataFrame, table_name: str = "table") -> TrialTable:
        """Read the trials from a table with one row for each trial.

        Args:
            table: Table with the columns of :func:`holdfast.teleop.analysis.analyse`.
            table_name: Name of the table in error messages.

        Raises:
            InputError: A column or value is missing, duplicate or impossible; the message names it.
        """
        _check_table(table, table_name)
        kind = str(table["kind"].iloc[0]) if "kind" in table else "person"
        subjects = tuple(dict.fromkeys(_to_strings(_sort_by_number(table)["subject"])))
        tasks = tuple(sorted({int(task) for task in table["task"]}))
        conditions = _read_conditions(table, table_name)
        positions = tuple(
            np.array([{level: index for index, level in enumerate(levels)}[value] for value in values], dtype=np.int64)
            for levels, values in (
                (subjects, _to_strings(table["subject"])),
                (tasks, [int(task) for task in table["task"]]),
                (tuple(condition.scenario for condition in conditions), [int(scenario) for scenario in table["scenario"]]),
            )
        )
        shape = (len(subjects), len(tasks), len(conditions))
        measured, causes = np.full((*shape, len(MEASURE_NAMES)), np.nan), np.full(shape, ABSENT_CAUSE, dtype="<U16")
        for index, name in enumerate(MEASURE_NAMES):
            if name in table:
                measured[(*positions, np.full(len(table), index))] = table[name].to_numpy(dtype=np.float64)
        ends = np.array(_to_strings(table["end"]))
        causes[positions] = np.where(ends == "arrived", "", ends)
        ratings = measured[..., RECORDED_MEASURES].copy()
        is_rated = bool(np.isfinite(ratings).any())
        if is_rated:
            causes[(causes == "") & np.isnan(ratings)] = UNRATED_CAUSE
        measured[causes != ""] = np.nan
        combined = compute_cpm(measured if is_rated else measured[..., :RECORDED_MEASURES])
        return cls(
            kind=kind,
            subjects=subjects,
            tasks=tasks,
            conditions=conditions,
            measures=measured,
            ratings=ratings,
            cause=causes,
            has_ratings=is_rated,
            cpm=combined.values,
            normalisers=combined.normalisers,
        )

    def normalise_by(self, normalisers: FloatArray) -> TrialTable:
        """Return the same trials with other ``normalisers`` of the CPM, as many as there are measures."""
        included = self.measures[..., : len(self.normalisers)]
        return replace(self, cpm=compute_cpm(included, normalisers).values, normalisers=normalisers)

    def condition_index(self, scenario: int) -> int:
        """Return the index in ``conditions`` of the scenario with the number ``scenario``.

        Raises:
            InputError: There is no such scenario.
        """
        for position, condition in enumerate(self.conditions):
            if condition.scenario == scenario:
                return position
        numbers = ", ".join(str(condition.scenario) for condition in self.conditions)
        raise InputError(f"there is no scenario {scenario}; there are {numbers}")

    def find_conditions(self, failed: bool) -> list[int]:
        """Return the indices of the scenarios with the ``failed`` arm, or with the healthy arm."""
        return [position for position, condition in enumerate(self.conditions) if condition.failed == failed]

    def select_subjects(self, rows: Sequence[int]) -> TrialTable:
        """Return the trials of the subjects with indices ``rows``, with their CPM normalised again."""
        rows = list(rows)
        measured = self.measures[rows]
        combined = compute_cpm(measured[..., : len(self.normalisers)])
        return replace(
            self,
            subjects=tuple(self.subjects[row] for row in rows),
            measures=measured,
            ratings=self.ratings[rows],
            cause=self.cause[rows],
            cpm=combined.values,
            normalisers=combined.normalisers,
        )

    def select_trials(self, tasks: Sequence[int], conditions: Sequence[int]) -> TrialTable:
        """Return the trials with these ``tasks`` and ``conditions`` (indices), in this order, and normalise CPM again."""
        selection = np.ix_(range(len(self.subjects)), list(tasks), list(conditions))
        measured = self.measures[selection]
        combined = compute_cpm(measured[..., : len(self.normalisers)])
        return replace(
            self,
            tasks=tuple(self.tasks[task] for task in tasks),
            conditions=tuple(self.conditions[condition] for condition in conditions),
            measures=measured,
            ratings=self.ratings[selection],
            cause=self.cause[selection],
            cpm=combined.values,
            normalisers=combined.normalisers,
        )

    def median_cpm(self) -> FloatArray:
        """Return the median CPM (T, S) over subjects, in which a failed trial is worse than any other.

        The median is infinite if it is a failed trial, and NaN without trials. Trials that were not recorded, broken off or not
        rated contain no information about difficulty and are left out.
        """
        ranked = np.where(np.isin(self.cause, _FAILED_ENDS), np.inf, self.cpm)
        medians = np.full(ranked.shape[1:], np.nan)
        for task, scenario in np.ndindex(*medians.shape):
            known = np.sort(ranked[:, task, scenario][~np.isnan(ranked[:, task, scenario])])
            if known.size:
                medians[task, scenario] = (known[(known.size - 1) // 2] + known[known.size // 2]) / 2
        return medians

    def median_rating(self) -> FloatArray:
        """Return the median rating (T, S) over subjects; NaN where no subject rated a trial."""
        medians = np.full(self.ratings.shape[1:], np.nan)
        for task, scenario in np.ndindex(*medians.shape):
            ratings = self.ratings[:, task, scenario]
            if np.isfinite(ratings).any():
                medians[task, scenario] = np.nanmedian(ratings)
        return medians

    def list_missing(self) -> DataFrame:
        """Return a table of the trials without a CPM: subject, task, scenario, law, failed, cause."""
        from pandas import DataFrame

        rows = [
            (
                self.subjects[subject],
                self.tasks[task],
                condition.scenario,
                condition.law,
                int(condition.failed),
                str(self.cause[subject, task, scenario]),
            )
            for subject, task, scenario in np.argwhere(self.cause != "")
            for condition in [self.conditions[scenario]]
        ]
        return DataFrame(rows, columns=["subject", "task", "scenario", "law", "failed", "cause"])


def _to_strings(column: Any) -> list[str]:
    return [str(value) for value in column]


def _sort_by_number(table: DataFrame) -> DataFrame:
    return table.sort_values("number", kind="stable") if "number" in table else table


def _check_table(table: DataFrame, table_name: str) -> None:
    lacking = [c for c in REQUIRED_COLUMNS if c not in table]
    if lacking:
        raise InputError(f"the {table_name} has no column '{lacking[0]}'; a table of trials has {', '.join(REQUIRED_COLUMNS)}")
    if not len(table):
        raise InputError(f"the {table_name} has no trials; there is nothing to analyse")
    if "kind" in table and table["kind"].nunique() > 1:
        kinds = " and ".join(sorted({str(kind) for kind in table["kind"]}))
        raise InputError(f"the {table_name} has trials of kind {kinds}; analyse one kind at a time")
    unknown_ends = sorted({str(end) for end in table["end"]} - set(END_NAMES))
    if unknown_ends:
        raise InputError(
            f"the {table_name} has a trial that ended '{unknown_ends[0]}'; the end must be one of {', '.join(END_NAMES)}"
        )
    duplicates = table.duplicated(["subject", "task", "scenario"])
    if duplicates.any():
        subject, task, c = table.loc[duplicates, ["subject", "task", "scenario"]].iloc[0]
        raise InputError(
            f"the {table_name} has subject {subject}, task {task}, scenario {c} twice; give each trial once, and no "
            f"training trials"
        )
    arrived = (table["end"] == "arrived").to_numpy()
    for measure in MEASURE_NAMES:
        if measure not in table:
            continue
        values = table[measure].to_numpy(dtype=np.float64)
        invalid = np.isinf(values) | (values < 0)
        if measure != MEASURE_NAMES[-1]:
            invalid |= arrived & np.isnan(values)
        if invalid.any():
            subject, task, c = table.loc[invalid, ["subject", "task", "scenario"]].iloc[0]
            raise InputError(
                f"the {table_name} has {measure} = {values[invalid][0]:g} for subject {subject}, task {task}, scenario {c}; a "
                "measure of a trial that reached the target is a number of 0 or more"
            )


def _read_conditions(table: DataFrame, table_name: str) -> tuple[Condition, ...]:
    scenarios: dict[int, tuple[str, bool]] = {}
    for number, law, failed in zip(table["scenario"], table["law"], table["failed"], strict=True):
        if scenarios.setdefault(int(number), (str(law), bool(failed))) != (str(law), bool(failed)):
            raise InputError(
                f"the {table_name} has scenario {number} with different laws or failures; it must have one of each"
            )
    repeated = [pair for pair in scenarios.values() if list(scenarios.values()).count(pair) > 1]
    return tuple(
        Condition(number, f"{law} ({number})" if (law, failed) in repeated else law, failed)
        for number, (law, failed) in sorted(scenarios.items())
    )
