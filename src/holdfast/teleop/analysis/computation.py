"""The analysis of an experiment, from its table of trials.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, section 7.
"""

from __future__ import annotations

from importlib.util import find_spec
from itertools import combinations
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import HoldfastError, InputError
from holdfast.notice import says
from holdfast.teleop.analysis import sample_sizes as sufficient
from holdfast.teleop.analysis import tables
from holdfast.teleop.analysis.correlations import Correlation, correlation
from holdfast.teleop.analysis.groups import Cells, Groups, in_groups
from holdfast.teleop.analysis.mixed_model import mixed
from holdfast.teleop.analysis.observations import Observed
from holdfast.teleop.analysis.remarks import notes
from holdfast.teleop.analysis.result import Analysis
from holdfast.teleop.analysis.variance import anova, empty_cells
from holdfast.teleop.trials.performance import RECORDED

if TYPE_CHECKING:
    from pandas import DataFrame

Array = NDArray[np.float64]
Missing = Literal["refuse", "complete", "mixed"]

FACTORS = ("law", "difficulty")
_LAW = "pseudoinverse"


@says("analysing the trials")
def analyse(
    table: DataFrame,
    computer: DataFrame | None = None,
    *,
    missing: Missing = "refuse",
    groups: int = 3,
    difficulty: Literal["operators", "computer"] = "operators",
    normalise: Literal["apart", "together"] = "apart",
    reference: int | None = None,
    limit: float = 0.05,
    power: float = 0.8,
    confidence: float = 0.95,
    seed: int = 0,
) -> Analysis:
    """Analyse the trials of an experiment: what does the control law do to how well people cope with a failed joint?

    With the scenarios in which the arm has failed: a within-subjects ANOVA of CPM (law x difficulty), paired comparisons of the
    laws in each group of tasks, and how anticipated, actual and perceived difficulty go together. With those in which it is
    healthy: what each law costs before a failure. Training trials do not belong in the table.

    Args:
        table: One row for each trial. Columns ``subject``, ``task``, ``scenario``, ``law``, ``failed``, ``end`` (``arrived``,
            ``still``, ``time``, ``aborted``, ``broken_off``) and ``M1`` to ``M11`` as ``measures`` gives them
            (NaN unless the target was reached); if there are, ``M12`` (the rating, NaN for none), ``kind`` (``person`` or
            ``simulated``) and ``number`` (the order of subjects).
        computer: The same of the computer operator, one row for each task and scenario.
        missing: What to do if a subject has no trial at all of a law in a group of tasks: ``refuse``; ``complete`` leaves such
            subjects out of everything, and lists them; ``mixed`` fits a linear mixed model of single trials in place of the
            ANOVA. In any case cell means are over the trials that reached the target, and ``notes`` count the others.
        groups: Number of groups of difficulty.
        difficulty: Whose CPM of the reference scenario tasks are sorted by: the operators' median, or the computer's.
        normalise: Whether CPM of operators and computer are each divided by their own largest measures or by common ones.
        reference: Scenario with the failed arm that others are compared with; that of the pseudoinverse, or the first, if not
            given.
        limit: p below which an effect is called significant.
        power: Asked for where numbers of subjects are given.
        confidence: Of the intervals.
        seed: Of the resampling.

    Raises:
        InputError: A table that cannot be analysed, an option that there is not, or empty cells; the message names them.
        HoldfastError: statsmodels is not installed.

    Source: Goel et al. 2003, section 7. Holm's correction, sphericity corrections, effect sizes, power and the mixed model are
    additions.
    """
    if find_spec("statsmodels") is None:
        raise HoldfastError(
            "statsmodels is needed here and is not installed; install holdfast[stats] (pip install 'holdfast[stats]')"
        )
    for name, value, known in (
        ("missing", missing, ("refuse", "complete", "mixed")),
        ("difficulty", difficulty, ("operators", "computer")),
        ("normalise", normalise, ("apart", "together")),
    ):
        if value not in known:
            raise InputError(f"{name} is '{value}'; it is one of {', '.join(known)}")
    if not (0 < limit < power < 1 and 0 < confidence < 1):
        raise InputError(
            f"limit is {limit:g}, power {power:g}, confidence {confidence:g}; give 0 < limit < power < 1 and 0 < confidence < 1"
        )
    observed = Observed.of(table)
    machine = None if computer is None else _matched(Observed.of(computer, "computer's table"), observed)
    if difficulty == "computer" and machine is None:
        raise InputError("tasks cannot be sorted by the computer's difficulty without its trials; give them as computer")
    left_out: tuple[str, ...] = ()
    while True:
        who, it = _together(observed, machine) if normalise == "together" else (observed, machine)
        conditions = _laws(who, reference)
        grouped = _grouped(who, it, conditions[0], groups, difficulty)
        cells = Cells.of(who, conditions, grouped)
        if not (lacking := cells.empty()) or missing == "mixed":
            break
        if missing == "refuse":
            raise InputError(
                f"the ANOVA needs every subject in every cell, and {empty_cells(lacking)}; missing='complete' leaves these "
                "subjects out, missing='mixed' fits a mixed model"
            )
        full = np.asarray((cells.tasks > 0).all(axis=(1, 2)))
        left_out += tuple(s for s, ok in zip(observed.subjects, full, strict=True) if not ok)
        if full.sum() < 2:
            raise InputError(
                f"only {int(full.sum())} of the subjects have trials in every cell; missing='mixed' needs none complete"
            )
        # Without them the medians change, and with these the groups: look again.
        observed = observed.keep(np.flatnonzero(full).tolist())
    if len(who.subjects) < 2:
        raise InputError("the table has one subject; statistics between subjects need 2 or more")
    by_laws = None
    if missing != "mixed":
        by_laws = anova(cells.values, FACTORS, (cells.laws, cells.groups), subjects=cells.subjects)
    model = mixed(who, conditions, grouped.of_task) if missing == "mixed" else None
    correlations = _correlations(who, it, conditions, confidence)
    parts = {
        "trials": tables.trials(who, grouped),
        **({} if it is None else {"computer": tables.trials(it, grouped)}),
        "cells": cells.long(),
        "cells_wide": cells.wide(),
        "means": tables.means(cells),
        **({} if by_laws is None else {"anova": by_laws.table()}),
        **({} if model is None else {"mixed": model.table()}),
        "comparisons": tables.comparisons(cells, confidence),
        "correlations": tables.rows(correlations),
        "tasks": tables.tasks(who, it, conditions, grouped),
        "measures": tables.measures(who, it),
        "failed": tables.by_measure(who, conditions, confidence),
    }
    if len(healthy := who.with_arm(failed=False)) > 1:
        parts["healthy"] = tables.by_measure(who, _first(healthy, who, conditions[0]), confidence)
    parts |= {
        "ends": tables.ends(who, it),
        "missing": who.missing(),
        "normalisers": tables.normalisers(who, it),
    }
    if it is not None:
        parts["gains"] = tables.gains(parts["tasks"], who, conditions, grouped)
    parts |= sufficient.tables(cells, by_laws, parts["comparisons"], limit, power, confidence, seed)
    other = _other_groups(who, it, conditions, grouped)
    if by_laws is not None and other is not None:
        parts["anova_other_groups"] = other
    return Analysis(
        observed=who,
        computer=it,
        conditions=tuple(who.conditions[k] for k in conditions),
        groups=grouped,
        cells=cells,
        anova=by_laws,
        mixed=model,
        correlations=correlations,
        tables={name: t.assign(data=who.kind) for name, t in parts.items()},
        missing=missing,
        left_out=left_out,
        limit=limit,
        power=power,
        confidence=confidence,
        notes=tuple(notes(who, it, conditions, grouped, cells, left_out, normalise)),
    )


def _laws(observed: Observed, reference: int | None) -> list[int]:
    """The positions of the scenarios with the failed arm, the reference first."""
    failed = observed.with_arm(failed=True)
    if len(failed) < 2:
        raise InputError(
            f"the table has {len(failed)} scenarios with the failed arm; comparing laws needs 2 or more, with different laws"
        )
    if reference is None:
        named = [k for k in failed if observed.conditions[k].law == _LAW]
        return _front(failed, named[0] if named else failed[0])
    chosen = observed.index(reference)
    if chosen not in failed:
        raise InputError(f"the reference is scenario {reference}, with the healthy arm; give one with the failed arm")
    return _front(failed, chosen)


def _front(rows: list[int], one: int) -> list[int]:
    return [one, *(k for k in rows if k != one)]


def _first(healthy: list[int], observed: Observed, reference: int) -> list[int]:
    """The scenarios with the healthy arm, that with the reference's law first."""
    same = [k for k in healthy if observed.conditions[k].law == observed.conditions[reference].law]
    return _front(healthy, same[0] if same else healthy[0])


def _matched(machine: Observed, observed: Observed) -> Observed:
    """The computer's trials in the order of the operators' tasks and scenarios."""
    if len(machine.subjects) > 1:
        raise InputError(f"the computer's table has {len(machine.subjects)} subjects; there is one computer")
    there = {c.scenario: c for c in machine.conditions}
    for c in observed.conditions:
        if there.get(c.scenario) != c:
            raise InputError(f"the computer's table has no scenario {c.label}; give its trials in the same scenarios")
    lacking = [t for t in observed.tasks if t not in machine.tasks]
    if lacking:
        raise InputError(f"the computer's table has no task {lacking[0]}; give its trials with the same tasks")
    return machine.pick(
        [machine.tasks.index(t) for t in observed.tasks], [machine.index(c.scenario) for c in observed.conditions]
    )


def _together(observed: Observed, machine: Observed | None) -> tuple[Observed, Observed | None]:
    """Both with the largest measures of both."""
    if machine is None:
        return observed, None
    common = observed.normalisers.copy()
    common[:RECORDED] = np.maximum(common[:RECORDED], machine.normalisers[:RECORDED])
    return observed.normalised(common), machine.normalised(common[: len(machine.normalisers)])


def _grouped(observed: Observed, machine: Observed | None, reference: int, count: int, by: str) -> Groups:
    known = observed.middle()[:, reference] if machine is None or by == "operators" else machine.cpm[0, :, reference]
    return in_groups(np.asarray(known), count, by)


def _other_groups(observed: Observed, machine: Observed | None, conditions: list[int], grouped: Groups) -> DataFrame | None:
    """The ANOVA with tasks sorted by the other's difficulty, if there is one and no cell is empty then."""
    if machine is None:
        return None
    by = "computer" if grouped.by == "operators" else "operators"
    cells = Cells.of(observed, conditions, _grouped(observed, machine, conditions[0], len(grouped.names), by))
    return None if cells.empty() else anova(cells.values, FACTORS).table()


def _correlations(
    observed: Observed, machine: Observed | None, conditions: list[int], confidence: float
) -> tuple[Correlation, ...]:
    labels = [f"task {t}" for t in observed.tasks]
    middle, reference = observed.middle(), conditions[0]
    levels = {"actual": middle[:, reference]}
    if machine is not None:
        levels = {"anticipated": machine.cpm[0, :, reference], **levels}
    if observed.rated:
        levels["perceived"] = observed.median_rating()[:, reference]
    found = [
        correlation(levels[a], levels[b], (a, b), labels=labels, confidence=confidence) for a, b in combinations(levels, 2)
    ]
    if machine is not None:
        of = observed.conditions
        for k in conditions[1:]:
            with np.errstate(divide="ignore", invalid="ignore"):
                ours, its = (np.asarray(x[:, k] / x[:, reference]) for x in (middle, machine.cpm[0]))
            ratio = f"CPM{of[k].scenario}/CPM{of[reference].scenario}"
            found.append(
                correlation(ours, its, (f"operators' {ratio}", f"computer's {ratio}"), labels=labels, confidence=confidence)
            )
    return tuple(found)
