"""What an analysis of the experiment found."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError
from holdfast.result import Result
from holdfast.teleop.analysis.correlations import Correlation
from holdfast.teleop.analysis.groups import Cells, Groups
from holdfast.teleop.analysis.mixed_model import Mixed
from holdfast.teleop.analysis.observations import Condition, Observed
from holdfast.teleop.analysis.variance import Anova

if TYPE_CHECKING:
    from pandas import DataFrame

Array = NDArray[np.float64]
Paths = Callable[[str | None, int, int], Array | None]
"""(subject, task, scenario) to the (K, m) tool points of that trial, m; subject None is the computer; None if not recorded."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Analysis(Result):
    """An experiment analysed: :func:`holdfast.teleop.analysis.analyse` makes it.

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

    observed: Observed
    computer: Observed | None
    conditions: tuple[Condition, ...]
    groups: Groups
    cells: Cells
    anova: Anova | None
    mixed: Mixed | None
    correlations: tuple[Correlation, ...]
    tables: Mapping[str, DataFrame]
    missing: str
    left_out: tuple[str, ...]
    limit: float
    power: float
    confidence: float
    notes: tuple[str, ...]

    @property
    def simulated(self) -> bool:
        """The operators are no people."""
        return self.observed.kind == "simulated"

    @property
    def who(self) -> str:
        """``24 simulated subjects``: how a sentence must call them."""
        count = len(self.observed.subjects)
        return f"{count} {'simulated ' if self.simulated else ''}subject{'' if count == 1 else 's'}"

    def law_means(self) -> dict[str, float]:
        """Mean CPM with the failed arm under each law, over subjects and groups (NaN with empty cells)."""
        return dict(zip(self.cells.laws, self.cells.values.mean(axis=(0, 2)).tolist(), strict=True))

    def group_means(self) -> dict[str, float]:
        """Mean CPM with the failed arm in each group of tasks, over subjects and laws (NaN with empty cells)."""
        return dict(zip(self.cells.groups, self.cells.values.mean(axis=(0, 1)).tolist(), strict=True))

    def correlation(self, first: str, second: str) -> Correlation:
        """The correlation of two of ``anticipated``, ``actual`` and ``perceived`` difficulty.

        Raises:
            InputError: It was not computed: without a computer nothing is anticipated, without ratings nothing perceived.
        """
        for c in self.correlations:
            if {c.first, c.second} == {first, second}:
                return c
        there = "; ".join(f"{c.first} and {c.second}" for c in self.correlations) or "none"
        raise InputError(f"there is no correlation of '{first}' and '{second}'; there are: {there}")

    def table(self, name: str) -> DataFrame:
        """One of the tables.

        Raises:
            InputError: There is none of that name.
        """
        if name not in self.tables:
            raise InputError(f"there is no table '{name}'; there are {', '.join(self.tables)}")
        return self.tables[name]

    def describe(self) -> list[str]:
        """The result in a few lines for people."""
        o = self.observed
        missing = int((o.cause != "").sum())
        lines = [
            f"{self.who}, {len(o.tasks)} tasks, {len(o.conditions)} scenarios: {o.cause.size} trials, {missing} without a CPM"
        ]
        means = ", ".join(f"{law} {value:.3f}" for law, value in self.law_means().items())
        lines.append(f"mean CPM with the failed arm: {means}")
        if self.anova is not None:
            lines += [
                f"{e}, Greenhouse-Geisser p = {e.p_gg:.2g}, partial eta squared {e.partial_eta2:.3f}"
                for e in self.anova.effects
            ]
        if self.mixed is not None:
            state = "converged" if self.mixed.converged else "did NOT converge: do not use it"
            lines.append(f"mixed model of {self.mixed.trials} trials, {state}")
            lines += [f"{t.name}: chi2({t.df}) = {t.chi2:.2f}, p = {t.p:.2g}" for t in self.mixed.tests]
        for _, r in self.tables["comparisons"].iterrows():
            lines.append(
                f"{r['difficulty']}: {r['first']} - {r['second']} = {r['difference']:.3f}, t({r['df']}) = {r['t']:.2f}, "
                f"Holm p = {r['p_holm']:.2g}, dz {r['dz']:.2f}"
            )
        lines += [str(c) for c in self.correlations]
        return lines + [f"note: {n}" for n in self.notes]
