"""Analysis of an experiment, from its table of trials.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, section 7.
"""

from __future__ import annotations

from importlib.util import find_spec
from itertools import combinations
from typing import TYPE_CHECKING, Literal

import numpy as np

from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.progress import reports_progress
from holdfast.teleop.analysis import sample_sizes as sufficient
from holdfast.teleop.analysis import tables
from holdfast.teleop.analysis.correlations import Correlation, correlate
from holdfast.teleop.analysis.groups import CellMeans, TaskGroups, group_by_difficulty
from holdfast.teleop.analysis.mixed_model import fit_mixed_model
from holdfast.teleop.analysis.observations import TrialTable
from holdfast.teleop.analysis.remarks import compose_analysis_notes
from holdfast.teleop.analysis.result import Analysis
from holdfast.teleop.analysis.variance import anova, describe_empty_cells
from holdfast.teleop.trials.performance import RECORDED_MEASURES

if TYPE_CHECKING:
    from pandas import DataFrame

Missing = Literal["refuse", "complete", "mixed"]

FACTOR_NAMES = ("law", "difficulty")
_REFERENCE_LAW = "pseudoinverse"


@reports_progress("analysing the trials")
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
    """Analyse the trials of an experiment for the effect of the control law on the performance with a failed joint.

    The scenarios with a failed arm give a within-subjects ANOVA of CPM (law x difficulty), paired comparisons of the laws in
    each group of tasks, and the correlations of anticipated, actual and perceived difficulty. The scenarios with a healthy arm
    give the penalty of each law before a failure. Training trials do not belong in the table.

    Args:
        table: One row for each trial. Columns ``subject``, ``task``, ``scenario``, ``law``, ``failed``, ``end`` (``arrived``,
            ``still``, ``time``, ``aborted``, ``broken_off``) and ``M1`` to ``M11`` from ``compute_measures`` (NaN unless the
            target was reached). Optional: ``M12`` (the rating, NaN for none), ``kind`` (``person`` or ``simulated``) and
            ``number`` (the order of subjects).
        computer: Table of the computer operator, one row for each task and scenario. None: no comparison with it.
        missing: Treatment of subjects without any trial of a law in a group of tasks: ``refuse`` raises an error; ``complete``
            leaves such subjects out of everything, and lists them; ``mixed`` fits a linear mixed model of single trials instead
            of the ANOVA. Cell means are always over the trials that reached the target, and ``notes`` count the others.
        groups: Number of groups of difficulty.
        difficulty: Source of the CPM of the reference scenario by which tasks are sorted: the operators' median, or the
            computer.
        normalise: ``apart``: CPM of operators and computer are each divided by their own largest measures; ``together``: by
            common ones.
        reference: Number of the scenario with the failed arm that others are compared with. Default: the pseudoinverse, else
            the first.
        limit: p-value below which an effect is called significant.
        power: Power for which numbers of subjects are computed.
        confidence: Confidence level of the intervals.
        seed: Seed of the resampling.

    Raises:
        InputError: The table cannot be analysed, an option is unknown, or cells are empty; the message names them.
        HoldfastError: statsmodels is not installed.

    Source: Goel et al. 2003, section 7. Holm's correction, sphericity corrections, effect sizes, power and the mixed model are
    additions.
    """
    if find_spec("statsmodels") is None:
        raise HoldfastError(
            "statsmodels is needed here and is not installed; install holdfast-arms[stats] (pip install 'holdfast-arms[stats]')"
        )
    for name, value, choices in (
        ("missing", missing, ("refuse", "complete", "mixed")),
        ("difficulty", difficulty, ("operators", "computer")),
        ("normalise", normalise, ("apart", "together")),
    ):
        if value not in choices:
            raise InputError(f"{name} is '{value}'; it is one of {', '.join(choices)}")
    if not (0 < limit < power < 1 and 0 < confidence < 1):
        raise InputError(
            f"limit is {limit:g}, power {power:g}, confidence {confidence:g}; give 0 < limit < power < 1 and 0 < confidence < 1"
        )
    observed = TrialTable.from_table(table)
    matched_computer = (
        None if computer is None else _match_to_operators(TrialTable.from_table(computer, "computer's table"), observed)
    )
    if difficulty == "computer" and matched_computer is None:
        raise InputError("tasks cannot be sorted by the computer's difficulty without its trials; give them as computer")
    left_out: tuple[str, ...] = ()
    while True:
        operator_trials, computer_trials = (
            _normalise_by_common_maxima(observed, matched_computer) if normalise == "together" else (observed, matched_computer)
        )
        conditions = _list_failed_arm_scenarios(operator_trials, reference)
        task_groups = _group_tasks(operator_trials, computer_trials, conditions[0], groups, difficulty)
        cells = CellMeans.from_trials(operator_trials, conditions, task_groups)
        if not (lacking_cells := cells.list_empty()) or missing == "mixed":
            break
        if missing == "refuse":
            raise InputError(
                f"the ANOVA needs every subject in every cell, and {describe_empty_cells(lacking_cells)}; missing='complete' "
                "leaves these subjects out, missing='mixed' fits a mixed model"
            )
        complete = np.asarray((cells.tasks > 0).all(axis=(1, 2)))
        left_out += tuple(subject for subject, is_complete in zip(observed.subjects, complete, strict=True) if not is_complete)
        if complete.sum() < 2:
            raise InputError(
                f"only {int(complete.sum())} of the subjects have trials in every cell; missing='mixed' requires none"
            )
        # Leaving subjects out changes the medians and therefore the groups, so the cells are checked again.
        observed = observed.select_subjects(np.flatnonzero(complete).tolist())
    if len(operator_trials.subjects) < 2:
        raise InputError("the table has one subject; statistics between subjects need 2 or more")
    law_anova = None
    if missing != "mixed":
        law_anova = anova(cells.values, FACTOR_NAMES, (cells.laws, cells.groups), subjects=cells.subjects)
    mixed_model = fit_mixed_model(operator_trials, conditions, task_groups.of_task) if missing == "mixed" else None
    correlations = _correlate_difficulties(operator_trials, computer_trials, conditions, confidence)
    tables_by_name = {
        "trials": tables.tabulate_trials(operator_trials, task_groups),
        **({} if computer_trials is None else {"computer": tables.tabulate_trials(computer_trials, task_groups)}),
        "cells": cells.to_long_table(),
        "cells_wide": cells.to_wide_table(),
        "means": tables.tabulate_means(cells),
        **({} if law_anova is None else {"anova": law_anova.table()}),
        **({} if mixed_model is None else {"mixed": mixed_model.table()}),
        "comparisons": tables.compare_laws(cells, confidence),
        "correlations": tables.tabulate_correlations(correlations),
        "tasks": tables.tabulate_tasks(operator_trials, computer_trials, conditions, task_groups),
        "measures": tables.tabulate_measure_distributions(operator_trials, computer_trials),
        "failed": tables.compare_measures(operator_trials, conditions, confidence),
    }
    if len(healthy := operator_trials.find_conditions(failed=False)) > 1:
        tables_by_name["healthy"] = tables.compare_measures(
            operator_trials, _list_healthy_arm_scenarios(healthy, operator_trials, conditions[0]), confidence
        )
    tables_by_name |= {
        "ends": tables.tabulate_trial_outcomes(operator_trials, computer_trials),
        "missing": operator_trials.list_missing(),
        "normalisers": tables.tabulate_normalisers(operator_trials, computer_trials),
    }
    if computer_trials is not None:
        tables_by_name["gains"] = tables.tabulate_improved_tasks(
            tables_by_name["tasks"], operator_trials, conditions, task_groups
        )
    tables_by_name |= sufficient.tabulate_sample_sizes(
        cells, law_anova, tables_by_name["comparisons"], limit, power, confidence, seed
    )
    other_anova = _analyse_by_other_difficulty(operator_trials, computer_trials, conditions, task_groups)
    if law_anova is not None and other_anova is not None:
        tables_by_name["anova_other_groups"] = other_anova
    return Analysis(
        observed=operator_trials,
        computer=computer_trials,
        conditions=tuple(operator_trials.conditions[position] for position in conditions),
        groups=task_groups,
        cells=cells,
        anova=law_anova,
        mixed=mixed_model,
        correlations=correlations,
        tables={name: frame.assign(data=operator_trials.kind) for name, frame in tables_by_name.items()},
        missing=missing,
        left_out=left_out,
        limit=limit,
        power=power,
        confidence=confidence,
        notes=tuple(
            compose_analysis_notes(operator_trials, computer_trials, conditions, task_groups, cells, left_out, normalise)
        ),
    )


def _list_failed_arm_scenarios(observed: TrialTable, reference: int | None) -> list[int]:
    """Return the positions of the scenarios with the failed arm, the reference first."""
    failed = observed.find_conditions(failed=True)
    if len(failed) < 2:
        raise InputError(
            f"the table has {len(failed)} scenarios with the failed arm; comparing laws needs 2 or more, with different laws"
        )
    if reference is None:
        with_reference_law = [position for position in failed if observed.conditions[position].law == _REFERENCE_LAW]
        return _move_to_front(failed, with_reference_law[0] if with_reference_law else failed[0])
    chosen = observed.condition_index(reference)
    if chosen not in failed:
        raise InputError(f"the reference is scenario {reference}, with the healthy arm; give one with the failed arm")
    return _move_to_front(failed, chosen)


def _move_to_front(positions: list[int], first: int) -> list[int]:
    return [first, *(position for position in positions if position != first)]


def _list_healthy_arm_scenarios(healthy: list[int], observed: TrialTable, reference: int) -> list[int]:
    """Return the positions of the scenarios with the healthy arm, the one with the reference's law first."""
    same_law = [position for position in healthy if observed.conditions[position].law == observed.conditions[reference].law]
    return _move_to_front(healthy, same_law[0] if same_law else healthy[0])


def _match_to_operators(computer: TrialTable, observed: TrialTable) -> TrialTable:
    """Return the computer's trials in the order of the operators' tasks and scenarios."""
    if len(computer.subjects) > 1:
        raise InputError(f"the computer's table has {len(computer.subjects)} subjects; it must have one, the computer")
    by_scenario = {condition.scenario: condition for condition in computer.conditions}
    for condition in observed.conditions:
        if by_scenario.get(condition.scenario) != condition:
            raise InputError(f"the computer's table has no scenario {condition.label}; give its trials in the same scenarios")
    lacking = [task for task in observed.tasks if task not in computer.tasks]
    if lacking:
        raise InputError(f"the computer's table has no task {lacking[0]}; give its trials with the same tasks")
    return computer.select_trials(
        [computer.tasks.index(task) for task in observed.tasks],
        [computer.condition_index(condition.scenario) for condition in observed.conditions],
    )


def _normalise_by_common_maxima(observed: TrialTable, computer: TrialTable | None) -> tuple[TrialTable, TrialTable | None]:
    """Normalise the trials of operators and computer by the largest measures of both."""
    if computer is None:
        return observed, None
    common = observed.normalisers.copy()
    common[:RECORDED_MEASURES] = np.maximum(common[:RECORDED_MEASURES], computer.normalisers[:RECORDED_MEASURES])
    return observed.normalise_by(common), computer.normalise_by(common[: len(computer.normalisers)])


def _group_tasks(
    observed: TrialTable, computer: TrialTable | None, reference: int, group_count: int, difficulty_source: str
) -> TaskGroups:
    difficulty = (
        observed.median_cpm()[:, reference]
        if computer is None or difficulty_source == "operators"
        else computer.cpm[0, :, reference]
    )
    return group_by_difficulty(np.asarray(difficulty), group_count, difficulty_source)


def _analyse_by_other_difficulty(
    observed: TrialTable, computer: TrialTable | None, conditions: list[int], grouped: TaskGroups
) -> DataFrame | None:
    """Return the ANOVA with tasks grouped by the other source of difficulty; None without one, or with an empty cell."""
    if computer is None:
        return None
    other_source = "computer" if grouped.by == "operators" else "operators"
    cells = CellMeans.from_trials(
        observed, conditions, _group_tasks(observed, computer, conditions[0], len(grouped.names), other_source)
    )
    return None if cells.list_empty() else anova(cells.values, FACTOR_NAMES).table()


def _correlate_difficulties(
    observed: TrialTable, computer: TrialTable | None, conditions: list[int], confidence: float
) -> tuple[Correlation, ...]:
    labels = [f"task {task}" for task in observed.tasks]
    medians, reference = observed.median_cpm(), conditions[0]
    levels = {"actual": medians[:, reference]}
    if computer is not None:
        levels = {"anticipated": computer.cpm[0, :, reference], **levels}
    if observed.has_ratings:
        levels["perceived"] = observed.median_rating()[:, reference]
    correlations = [
        correlate(levels[first], levels[second], (first, second), labels=labels, confidence=confidence)
        for first, second in combinations(levels, 2)
    ]
    if computer is not None:
        scenarios = observed.conditions
        for position in conditions[1:]:
            with np.errstate(divide="ignore", invalid="ignore"):
                operator_ratios, computer_ratios = (
                    np.asarray(levels_of[:, position] / levels_of[:, reference]) for levels_of in (medians, computer.cpm[0])
                )
            ratio = f"CPM{scenarios[position].scenario}/CPM{scenarios[reference].scenario}"
            correlations.append(
                correlate(
                    operator_ratios,
                    computer_ratios,
                    (f"operators' {ratio}", f"computer's {ratio}"),
                    labels=labels,
                    confidence=confidence,
                )
            )
    return tuple(correlations)
