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
        observed: The operators' trials that were analysed, with their CPM and normalisers.
        computer: The computer's; None if not given.
        conditions: The scenarios with the failed arm. The first is the reference: the others are compared with it, and its
            CPM is the difficulty of a task.
        groups: The tasks in groups of difficulty.
        cells: The means that the ANOVA is made of.
        anova: Law x difficulty, with the failed arm; None if ``mixed`` was asked for.
        mixed: The mixed model; None if not asked for.
        correlations: Of anticipated (the computer's CPM), actual (the median operator CPM) and perceived (the median rating)
            difficulty, as far as there are any.
        tables: Everything as data frames, by name; see :meth:`save`.
        missing: "refuse", "complete" or "mixed": what was asked for in case of empty cells.
        left_out: Subjects that were left out because of empty cells.
        limit: p below which an effect is called significant.
        power: Asked for where numbers of subjects are given.
        confidence: Of the intervals.
        notes: What a reader must know about these numbers.
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
        """Return the correlation of two of ``anticipated``, ``actual`` and ``perceived`` difficulty.

        Raises:
            InputError: It was not computed: without a computer nothing is anticipated, without ratings nothing perceived.
        """
        for candidate in self.correlations:
            if {candidate.first, candidate.second} == {first, second}:
                return candidate
        available = "; ".join(f"{candidate.first} and {candidate.second}" for candidate in self.correlations) or "none"
        raise InputError(f"there is no correlation of '{first}' and '{second}'; there are: {available}")

    def table(self, name: str) -> DataFrame:
        """Return one of the tables.

        Raises:
            InputError: There is none of that name.
        """
        if name not in self.tables:
            raise InputError(f"there is no table '{name}'; there are {', '.join(self.tables)}")
        return self.tables[name]
