"""Result of an analysis of the experiment."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from holdfast.core.errors import InputError
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.teleop.analysis.correlations import Correlation
from holdfast.teleop.analysis.groups import CellMeans, TaskGroups
from holdfast.teleop.analysis.mixed_model import MixedModel
from holdfast.teleop.analysis.observations import Condition, TrialTable
from holdfast.teleop.analysis.variance import Anova

if TYPE_CHECKING:
    from pandas import DataFrame

Paths = Callable[[str | None, int, int], FloatArray | None]
"""(subject, task, scenario) to the (K, m) tool points of that trial, m; subject None is the computer; None if not recorded."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Analysis(Result):
    """Result of the analysis of an experiment, returned by :func:`holdfast.teleop.analysis.analyse`.

    Attributes:
        observed: Analysed trials of the operators, with their CPM and normalisers.
        computer: Trials of the computer; None if not given.
        conditions: Scenarios with the failed arm. The first is the reference, with which the others are compared, and its CPM
            is the difficulty of a task.
        groups: Groups of the tasks by difficulty.
        cells: Cell means of the ANOVA.
        anova: ANOVA of law x difficulty with the failed arm; None if ``mixed`` was requested.
        mixed: Mixed model; None if it was not requested.
        correlations: Available correlations of anticipated (the computer's CPM), actual (the median operator CPM) and perceived
            (the median rating) difficulty.
        tables: All results as data frames, by name; see :meth:`save`.
        missing: Requested treatment of empty cells: ``refuse``, ``complete`` or ``mixed``.
        left_out: Subjects that were left out because of empty cells.
        limit: p-value below which an effect is called significant.
        power: Power for which numbers of subjects are computed.
        confidence: Confidence level of the intervals.
        notes: Limits of these numbers that a reader must know.
    """

    observed: TrialTable
    computer: TrialTable | None
    conditions: tuple[Condition, ...]
    groups: TaskGroups
    cells: CellMeans
    anova: Anova | None
    mixed: MixedModel | None
    correlations: tuple[Correlation, ...]
    tables: Mapping[str, DataFrame]
    missing: str
    left_out: tuple[str, ...]
    limit: float
    power: float
    confidence: float
    notes: tuple[str, ...]

    @property
    def is_simulated(self) -> bool:
        """True if the operators are simulated."""
        return self.observed.kind == "simulated"

    @property
    def subject_phrase(self) -> str:
        """Number and kind of the subjects for use in a sentence, for example ``24 simulated subjects``."""
        count = len(self.observed.subjects)
        return f"{count} {'simulated ' if self.is_simulated else ''}subject{'' if count == 1 else 's'}"

    def law_means(self) -> dict[str, float]:
        """Return the mean CPM with the failed arm under each law, over subjects and groups (NaN with empty cells)."""
        return dict(zip(self.cells.laws, self.cells.values.mean(axis=(0, 2)).tolist(), strict=True))

    def group_means(self) -> dict[str, float]:
        """Return the mean CPM with the failed arm in each group of tasks, over subjects and laws (NaN with empty cells)."""
        return dict(zip(self.cells.groups, self.cells.values.mean(axis=(0, 1)).tolist(), strict=True))

    def correlation(self, first: str, second: str) -> Correlation:
        """Return the correlation of ``first`` and ``second``: ``anticipated``, ``actual`` or ``perceived`` difficulty.

        Raises:
            InputError: It was not computed. Without a computer nothing is anticipated, and without ratings nothing perceived.
        """
        for candidate in self.correlations:
            if {candidate.first, candidate.second} == {first, second}:
                return candidate
        available = "; ".join(f"{candidate.first} and {candidate.second}" for candidate in self.correlations) or "none"
        raise InputError(f"there is no correlation of '{first}' and '{second}'; there are: {available}")

    def table(self, name: str) -> DataFrame:
        """Return the table with the name ``name``.

        Raises:
            InputError: There is no table of this name.
        """
        if name not in self.tables:
            raise InputError(f"there is no table '{name}'; there are {', '.join(self.tables)}")
        return self.tables[name]
