"""What was observed: a table of trials, checked, as arrays over subjects, tasks and scenarios, and what is missing from it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError
from holdfast.teleop.trials.performance import MEASURES, RECORDED, cpm
from holdfast.teleop.trials.recordings import End

if TYPE_CHECKING:
    from pandas import DataFrame

Array = NDArray[np.float64]
Words = NDArray[Any]

NAMES = tuple(m.name for m in MEASURES)
NEEDED = ("subject", "task", "scenario", "law", "failed", "end", *NAMES[:RECORDED])
ENDS = tuple(e.name.lower() for e in End)
UNRATED, ABSENT = "no rating", "not recorded"
CAUSES = {
    **{e.name.lower(): e.sentence for e in End if e != End.ARRIVED},
    UNRATED: "the end effector reached the target, but the operator did not rate the trial",
    ABSENT: "the table has no such trial",
}
"""Why a trial has no CPM."""
_WORSE = tuple(e.name.lower() for e in (End.STILL, End.TIME, End.ABORTED))


@dataclass(frozen=True)
class Condition:
    """A scenario as the table has it.

    Attributes:
        scenario: Its number.
        law: The control law; with the scenario's number behind it where two scenarios have the same law and failure.
        failed: The arm had a locked joint.
    """

    scenario: int
    law: str
    failed: bool

    @property
    def label(self) -> str:
        """For people: ``3: failed, pseudoinverse``."""
        return f"{self.scenario}: {'failed' if self.failed else 'healthy'}, {self.law}"


@dataclass(frozen=True, eq=False, kw_only=True)
class Observed:
    """The trials of P subjects with T tasks in S scenarios.

    Attributes:
        kind: ``person``, ``simulated`` or ``computer``.
        subjects: (P,) codes.
        tasks: (T,) numbers.
        conditions: (S,) the scenarios.
        measures: (P, T, S, 12) M1 to M12, NaN in trials without a CPM.
        ratings: (P, T, S) M12 of every trial that was rated, whether or not the end effector reached the target.
        cause: (P, T, S) why there is no CPM; empty where there is one.
        rated: Operators rated trials at all. If not, CPM is made of eleven measures.
        cpm: (P, T, S) combined performance measures.
        normalisers: (11 or 12,) of the CPM.
    """

    kind: str
    subjects: tuple[str, ...]
    tasks: tuple[int, ...]
    conditions: tuple[Condition, ...]
    measures: Array
    ratings: Array
    cause: Words
    rated: bool
    cpm: Array
    normalisers: Array

    @classmethod
    def of(cls, table: DataFrame, what: str = "table") -> Observed:
        """From a table with one row for each trial.

        Raises:
            InputError: A column or value that is missing, twice there or impossible; the message says which.
        """
        _check(table, what)
        kind = str(table["kind"].iloc[0]) if "kind" in table else "person"
        subjects = tuple(dict.fromkeys(_words(_by_number(table)["subject"])))
        tasks = tuple(sorted({int(t) for t in table["task"]}))
        conditions = _conditions(table, what)
        at = tuple(
            np.array([{x: k for k, x in enumerate(levels)}[v] for v in values], dtype=np.int64)
            for levels, values in (
                (subjects, _words(table["subject"])),
                (tasks, [int(t) for t in table["task"]]),
                (tuple(c.scenario for c in conditions), [int(s) for s in table["scenario"]]),
            )
        )
        shape = (len(subjects), len(tasks), len(conditions))
        measured, cause = np.full((*shape, len(NAMES)), np.nan), np.full(shape, ABSENT, dtype="<U16")
        for k, name in enumerate(NAMES):
            if name in table:
                measured[(*at, np.full(len(table), k))] = table[name].to_numpy(dtype=np.float64)
        end = np.array(_words(table["end"]))
        cause[at] = np.where(end == "arrived", "", end)
        ratings = measured[..., RECORDED].copy()
        rated = bool(np.isfinite(ratings).any())
        if rated:
            cause[(cause == "") & np.isnan(ratings)] = UNRATED
        measured[cause != ""] = np.nan
        combined = cpm(measured if rated else measured[..., :RECORDED])
        return cls(
            kind=kind,
            subjects=subjects,
            tasks=tasks,
            conditions=conditions,
            measures=measured,
            ratings=ratings,
            cause=cause,
            rated=rated,
            cpm=combined.values,
            normalisers=combined.normalisers,
        )

    def normalised(self, normalisers: Array) -> Observed:
        """The same trials with other normalisers of the CPM, as many as they have."""
        used = self.measures[..., : len(self.normalisers)]
        return replace(self, cpm=cpm(used, normalisers).values, normalisers=normalisers)

    def index(self, scenario: int) -> int:
        """The position of a scenario in ``conditions``.

        Raises:
            InputError: There is no such scenario.
        """
        for k, c in enumerate(self.conditions):
            if c.scenario == scenario:
                return k
        numbers = ", ".join(str(c.scenario) for c in self.conditions)
        raise InputError(f"there is no scenario {scenario}; there are {numbers}")

    def with_arm(self, failed: bool) -> list[int]:
        """The positions of the scenarios with the failed or the healthy arm."""
        return [k for k, c in enumerate(self.conditions) if c.failed == failed]

    def keep(self, rows: Sequence[int]) -> Observed:
        """The same with some of the subjects; CPM are normalised again."""
        rows = list(rows)
        measured = self.measures[rows]
        combined = cpm(measured[..., : len(self.normalisers)])
        return replace(
            self,
            subjects=tuple(self.subjects[r] for r in rows),
            measures=measured,
            ratings=self.ratings[rows],
            cause=self.cause[rows],
            cpm=combined.values,
            normalisers=combined.normalisers,
        )

    def pick(self, tasks: Sequence[int], conditions: Sequence[int]) -> Observed:
        """Some of the tasks and scenarios, in the order given; CPM are normalised again."""
        at = np.ix_(range(len(self.subjects)), list(tasks), list(conditions))
        measured = self.measures[at]
        combined = cpm(measured[..., : len(self.normalisers)])
        return replace(
            self,
            tasks=tuple(self.tasks[t] for t in tasks),
            conditions=tuple(self.conditions[c] for c in conditions),
            measures=measured,
            ratings=self.ratings[at],
            cause=self.cause[at],
            cpm=combined.values,
            normalisers=combined.normalisers,
        )

    def middle(self) -> Array:
        """(T, S) the median CPM over subjects, where a trial that was seen to fail counts as worse than any other.

        Infinite where that is the median; NaN where there are no trials. Trials that were not recorded, broken off or not
        rated say nothing about difficulty and are left out.
        """
        ranked = np.where(np.isin(self.cause, _WORSE), np.inf, self.cpm)
        out = np.full(ranked.shape[1:], np.nan)
        for t, s in np.ndindex(*out.shape):
            seen = np.sort(ranked[:, t, s][~np.isnan(ranked[:, t, s])])
            if seen.size:
                out[t, s] = (seen[(seen.size - 1) // 2] + seen[seen.size // 2]) / 2
        return out

    def median_rating(self) -> Array:
        """(T, S) the median rating over subjects; NaN where nobody rated."""
        out = np.full(self.ratings.shape[1:], np.nan)
        for t, s in np.ndindex(*out.shape):
            given = self.ratings[:, t, s]
            if np.isfinite(given).any():
                out[t, s] = np.nanmedian(given)
        return out

    def missing(self) -> DataFrame:
        """The trials without a CPM: subject, task, scenario, law, failed, cause."""
        from pandas import DataFrame

        rows = [
            (
                self.subjects[p],
                self.tasks[t],
                c.scenario,
                c.law,
                int(c.failed),
                str(self.cause[p, t, s]),
            )
            for p, t, s in np.argwhere(self.cause != "")
            for c in [self.conditions[s]]
        ]
        return DataFrame(rows, columns=["subject", "task", "scenario", "law", "failed", "cause"])


def _words(column: Any) -> list[str]:
    return [str(x) for x in column]


def _by_number(table: DataFrame) -> DataFrame:
    return table.sort_values("number", kind="stable") if "number" in table else table


def _check(table: DataFrame, what: str) -> None:
    lacking = [c for c in NEEDED if c not in table]
    if lacking:
        raise InputError(f"the {what} has no column '{lacking[0]}'; a table of trials has {', '.join(NEEDED)}")
    if not len(table):
        raise InputError(f"the {what} has no trials; there is nothing to analyse")
    if "kind" in table and table["kind"].nunique() > 1:
        kinds = " and ".join(sorted({str(k) for k in table["kind"]}))
        raise InputError(f"the {what} has trials of kind {kinds}; analyse one kind at a time")
    wrong = sorted({str(e) for e in table["end"]} - set(ENDS))
    if wrong:
        raise InputError(f"the {what} has a trial that ended '{wrong[0]}'; an end is one of {', '.join(ENDS)}")
    twice = table.duplicated(["subject", "task", "scenario"])
    if twice.any():
        s, t, c = table.loc[twice, ["subject", "task", "scenario"]].iloc[0]
        raise InputError(
            f"the {what} has subject {s}, task {t}, scenario {c} twice; give each trial once, and no training trials"
        )
    arrived = (table["end"] == "arrived").to_numpy()
    for name in NAMES:
        if name not in table:
            continue
        values = table[name].to_numpy(dtype=np.float64)
        bad = np.isinf(values) | (values < 0)
        if name != NAMES[-1]:
            bad |= arrived & np.isnan(values)
        if bad.any():
            s, t, c = table.loc[bad, ["subject", "task", "scenario"]].iloc[0]
            raise InputError(
                f"the {what} has {name} = {values[bad][0]:g} for subject {s}, task {t}, scenario {c}; a measure of a trial "
                "that reached the target is a number of 0 or more"
            )


def _conditions(table: DataFrame, what: str) -> tuple[Condition, ...]:
    found: dict[int, tuple[str, bool]] = {}
    for number, law, failed in zip(table["scenario"], table["law"], table["failed"], strict=True):
        if found.setdefault(int(number), (str(law), bool(failed))) != (str(law), bool(failed)):
            raise InputError(f"the {what} has scenario {number} with different laws or failures; a scenario has one")
    same = [pair for pair in found.values() if list(found.values()).count(pair) > 1]
    return tuple(
        Condition(number, f"{law} ({number})" if (law, failed) in same else law, failed)
        for number, (law, failed) in sorted(found.items())
    )
