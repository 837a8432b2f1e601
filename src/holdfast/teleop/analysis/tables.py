"""Tables of an analysis, as data frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.teleop.analysis.comparisons import compare_pairs, correct_by_holm
from holdfast.teleop.analysis.correlations import Correlation
from holdfast.teleop.analysis.groups import CellMeans, TaskGroups
from holdfast.teleop.analysis.observations import CAUSE_SENTENCES, MEASURE_NAMES, TrialTable
from holdfast.teleop.trials.performance import PERFORMANCE_MEASURES, RECORDED_MEASURES

if TYPE_CHECKING:
    from pandas import DataFrame


_ZERO_TOLERANCE = 1e-9


def tabulate_trials(observed: TrialTable, grouped: TaskGroups) -> DataFrame:
    """Return a table with a row for each planned trial: its measures, its CPM, and the cause of a missing CPM."""
    from pandas import DataFrame

    subjects, task_indices, scenarios = (index.ravel() for index in np.indices(observed.cause.shape))
    columns: dict[str, Any] = {
        "subject": [observed.subjects[index] for index in subjects],
        "task": [observed.tasks[index] for index in task_indices],
        "difficulty": [grouped.names[grouped.of_task[index]] for index in task_indices],
        "scenario": [observed.conditions[index].scenario for index in scenarios],
        "law": [observed.conditions[index].law for index in scenarios],
        "failed": [int(observed.conditions[index].failed) for index in scenarios],
        "cause": [str(cause) for cause in observed.cause.ravel()],
        **{name: observed.measures[..., index].ravel() for index, name in enumerate(MEASURE_NAMES[:RECORDED_MEASURES])},
        MEASURE_NAMES[RECORDED_MEASURES]: observed.ratings.ravel(),
        "cpm": observed.cpm.ravel(),
    }
    return DataFrame(columns)


def tabulate_means(cells: CellMeans) -> DataFrame:
    """Return the mean, standard deviation and standard error over subjects of each law in each group of tasks."""
    from pandas import DataFrame

    mean_rows = []
    for law, group in np.ndindex(len(cells.laws), len(cells.groups)):
        values = cells.values[:, law, group]
        values = values[np.isfinite(values)]
        deviation = float(values.std(ddof=1)) if len(values) > 1 else float("nan")
        mean = float(values.mean()) if len(values) else float("nan")
        standard_error = deviation / np.sqrt(max(len(values), 1))
        mean_rows.append(
            (
                cells.laws[law],
                cells.groups[group],
                len(values),
                mean,
                deviation,
                standard_error,
                int(cells.tasks[:, law, group].sum()),
            )
        )
    return DataFrame(mean_rows, columns=["law", "difficulty", "subjects", "mean", "sd", "se", "trials"])


def compare_laws(cells: CellMeans, confidence: float) -> DataFrame:
    """Compare the laws in pairs within each group of tasks; Holm's correction is over all rows."""
    from pandas import DataFrame

    comparison_rows = []
    for first, second in combinations(range(len(cells.laws)), 2):
        for index, group in enumerate(cells.groups):
            comparison = asdict(compare_pairs(cells.values[:, first, index], cells.values[:, second, index], confidence))
            comparison_rows.append(
                {"difficulty": group, "first": cells.laws[first], "second": cells.laws[second], **comparison}
            )
    return _add_holm_column(DataFrame(comparison_rows))


def compare_measures(observed: TrialTable, conditions: Sequence[int], confidence: float) -> DataFrame:
    """Compare scenarios in pairs by CPM and each measure, over the tasks that a subject completed in both.

    Holm's correction is over all rows.
    """
    from pandas import DataFrame

    comparison_rows = []
    all_values = np.concatenate([observed.cpm[..., None], observed.measures], axis=-1)
    # Rounding errors of zero values, such as errors of the healthy pseudoinverse, must not become significant differences.
    all_values[np.abs(all_values) < _ZERO_TOLERANCE] = 0.0
    for first_scenario, second_scenario in combinations(conditions, 2):
        completed = np.isfinite(observed.cpm[:, :, first_scenario]) & np.isfinite(observed.cpm[:, :, second_scenario])
        for index, name in enumerate(("CPM", *MEASURE_NAMES)):
            if index == len(MEASURE_NAMES) and not observed.has_ratings:
                continue
            first, second = (
                _average_over_tasks(np.where(completed, all_values[:, :, scenario, index], np.nan))
                for scenario in (first_scenario, second_scenario)
            )
            about, unit = (
                ("combined performance measure", "1")
                if index == 0
                else (PERFORMANCE_MEASURES[index - 1].about, PERFORMANCE_MEASURES[index - 1].unit)
            )
            comparison_rows.append(
                {
                    "measure": name,
                    "about": about,
                    "unit": unit,
                    "first": observed.conditions[first_scenario].law,
                    "second": observed.conditions[second_scenario].law,
                    "first_mean": _average_over_subjects(first),
                    "second_mean": _average_over_subjects(second),
                    "trials": int(completed.sum()),
                    **asdict(compare_pairs(first, second, confidence)),
                }
            )
    return _add_holm_column(DataFrame(comparison_rows))


def _average_over_tasks(values: FloatArray) -> FloatArray:
    """Return the mean (P,) over the tasks that have a value; NaN without such tasks."""
    finite = np.isfinite(values)
    counts = finite.sum(axis=1)
    return np.where(counts > 0, np.where(finite, values, 0.0).sum(axis=1) / np.maximum(counts, 1), np.nan)


def _average_over_subjects(values: FloatArray) -> float:
    return float(np.nanmean(values)) if np.isfinite(values).any() else float("nan")


def _add_holm_column(table: DataFrame) -> DataFrame:
    table.insert(table.columns.get_loc("p") + 1, "p_holm", correct_by_holm(table["p"].to_numpy()))
    return table


def tabulate_correlations(correlations: Sequence[Correlation]) -> DataFrame:
    """Return a table with a row for each correlation."""
    from pandas import DataFrame

    return DataFrame([{**asdict(entry), "left_out": "; ".join(entry.left_out)} for entry in correlations])


def tabulate_tasks(
    observed: TrialTable, computer: TrialTable | None, conditions: Sequence[int], grouped: TaskGroups
) -> DataFrame:
    """Return a table with a row for each task, easiest first: difficulty, and CPM of operators and computer (failed arm).

    The median operator of a task is the one whose CPM of the reference scenario is closest to the median of all.
    """
    from pandas import DataFrame

    medians, ratings, reference = observed.median_cpm(), observed.median_rating(), conditions[0]
    numbers = [condition.scenario for condition in observed.conditions]
    task_rows = []
    for task in np.lexsort((np.nan_to_num(medians[:, reference], nan=np.inf), grouped.of_task)):
        operator = median_operator(observed, int(task), reference)
        row: dict[str, Any] = {
            "task": observed.tasks[task],
            "difficulty": grouped.names[grouped.of_task[task]],
            "anticipated": float("nan") if computer is None else computer.cpm[0, task, reference],
            "actual": medians[task, reference],
            "perceived": ratings[task, reference],
            "median_operator": "" if operator is None else observed.subjects[operator],
        }
        for scenario in conditions:
            row[f"cpm_{numbers[scenario]}"] = medians[task, scenario]
            row[f"median_operator_cpm_{numbers[scenario]}"] = (
                float("nan") if operator is None else observed.cpm[operator, task, scenario]
            )
            row[f"computer_cpm_{numbers[scenario]}"] = float("nan") if computer is None else computer.cpm[0, task, scenario]
            row[f"reached_{numbers[scenario]}"] = int(np.isfinite(observed.measures[:, task, scenario, 0]).sum())
        for scenario in conditions[1:]:
            ratio_name = f"{numbers[scenario]}_{numbers[reference]}"
            row[f"ratio_{ratio_name}"] = _divide_or_nan(medians[task, scenario], medians[task, reference])
            row[f"computer_ratio_{ratio_name}"] = float("nan")
            if computer is not None:
                row[f"computer_ratio_{ratio_name}"] = _divide_or_nan(
                    computer.cpm[0, task, scenario], computer.cpm[0, task, reference]
                )
        task_rows.append(row)
    return DataFrame(task_rows)


def median_operator(observed: TrialTable, task: int, reference: int) -> int | None:
    """Return the index of the subject whose CPM of a ``task`` (index) is closest to the median of all subjects.

    ``observed`` are the trials, and ``reference`` is the index of the scenario. None if no subject reached the target.
    """
    task_cpm, median = observed.cpm[:, task, reference], observed.median_cpm()[task, reference]
    if not np.isfinite(task_cpm).any():
        return None
    if not np.isfinite(median):
        return int(np.nanargmax(task_cpm))  # the median operator failed: the worst one who did not
    return int(np.nanargmin(np.abs(task_cpm - median)))


def _divide_or_nan(numerator: float, denominator: float) -> float:
    return (
        float(numerator / denominator)
        if np.isfinite(numerator) and np.isfinite(denominator) and denominator > 0
        else float("nan")
    )


def tabulate_improved_tasks(
    task_table: DataFrame, observed: TrialTable, conditions: Sequence[int], grouped: TaskGroups
) -> DataFrame:
    """Return how many tasks of each group improve with another law than the reference, for operators and for the computer."""
    from pandas import DataFrame

    gain_rows = []
    reference = observed.conditions[conditions[0]]
    for scenario in conditions[1:]:
        condition = observed.conditions[scenario]
        column = f"ratio_{condition.scenario}_{reference.scenario}"
        for group in (*grouped.names, "all"):
            selected = task_table if group == "all" else task_table[task_table["difficulty"] == group]
            operator_ratios, computer_ratios = (
                selected[header].to_numpy(dtype=np.float64) for header in (column, f"computer_{column}")
            )
            finite = np.isfinite(operator_ratios) & np.isfinite(computer_ratios)
            operator_ratios, computer_ratios = operator_ratios[finite], computer_ratios[finite]
            gain_rows.append(
                {
                    "law": condition.law,
                    "against": reference.law,
                    "difficulty": group,
                    "tasks": int(finite.sum()),
                    "operators_gain": int((operator_ratios < 1).sum()),
                    "computer_gains": int((computer_ratios < 1).sum()),
                    "same_direction": int(((operator_ratios < 1) == (computer_ratios < 1)).sum()),
                    "operators_median_ratio": float(np.median(operator_ratios)) if len(operator_ratios) else float("nan"),
                    "computer_median_ratio": float(np.median(computer_ratios)) if len(computer_ratios) else float("nan"),
                }
            )
    return DataFrame(gain_rows)


def tabulate_measure_distributions(observed: TrialTable, computer: TrialTable | None) -> DataFrame:
    """Return the distribution of CPM and each measure in each scenario, over all trials that reached the target."""
    from pandas import DataFrame

    measure_rows = []
    for scenario, condition in enumerate(observed.conditions):
        for measure, name in enumerate(("CPM", *MEASURE_NAMES)):
            values = _select_values(observed, scenario, measure)
            computer_values = np.empty(0) if computer is None else _select_values(computer, scenario, measure)
            quantiles = np.quantile(values, [0, 0.25, 0.5, 0.75, 1]).tolist() if values.size else [float("nan")] * 5
            measure_rows.append(
                {
                    "scenario": condition.scenario,
                    "law": condition.law,
                    "failed": int(condition.failed),
                    "measure": name,
                    "unit": "1" if measure == 0 else PERFORMANCE_MEASURES[measure - 1].unit,
                    "trials": int(values.size),
                    "mean": float(values.mean()) if values.size else float("nan"),
                    "sd": float(values.std(ddof=1)) if values.size > 1 else float("nan"),
                    **dict(zip(("lowest", "quarter", "median", "three_quarters", "highest"), quantiles, strict=True)),
                    "computer_median": float(np.median(computer_values)) if computer_values.size else float("nan"),
                }
            )
    return DataFrame(measure_rows)


def _select_values(observed: TrialTable, scenario: int, measure: int) -> FloatArray:
    """Return the CPM (0) or a measure (from 1) of all trials of a scenario that have a value."""
    all_values = (
        observed.cpm
        if measure == 0
        else observed.ratings
        if measure == len(MEASURE_NAMES)
        else observed.measures[..., measure - 1]
    )
    chosen = all_values[:, :, scenario]
    return chosen[np.isfinite(chosen)]


def tabulate_trial_outcomes(observed: TrialTable, computer: TrialTable | None) -> DataFrame:
    """Count for each scenario the trials that reached the target and were rated, and the causes of a missing CPM."""
    from pandas import DataFrame

    end_rows = []
    for scenario, condition in enumerate(observed.conditions):
        causes = observed.cause[:, :, scenario]
        row: dict[str, Any] = {
            "scenario": condition.scenario,
            "law": condition.law,
            "failed": int(condition.failed),
            "trials": int(causes.size),
        }
        row["with_cpm"] = int((causes == "").sum())
        row |= {cause.replace(" ", "_"): int((causes == cause).sum()) for cause in CAUSE_SENTENCES}
        if computer is not None:
            row["computer_with_cpm"] = int((computer.cause[:, :, scenario] == "").sum())
        end_rows.append(row)
    return DataFrame(end_rows)


def tabulate_normalisers(observed: TrialTable, computer: TrialTable | None) -> DataFrame:
    """Return the normaliser of each measure in the CPM."""
    from pandas import DataFrame

    columns: dict[str, Any] = {"measure": MEASURE_NAMES, "unit": [measure.unit for measure in PERFORMANCE_MEASURES]}
    for name, source in (("operators", observed), ("computer", computer)):
        if source is not None:
            columns[name] = np.concatenate([source.normalisers, np.full(len(MEASURE_NAMES) - len(source.normalisers), np.nan)])
    return DataFrame(columns)
