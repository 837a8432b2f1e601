"""Tables of an analysis as CSV files that R, JASP, and spreadsheets open, with a dictionary of every column."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from holdfast.core.files.output import write_files
from holdfast.core.files.spreadsheet import write_csv_text
from holdfast.teleop.analysis.observations import CAUSE_SENTENCES
from holdfast.teleop.analysis.result import Analysis
from holdfast.teleop.trials.performance import PERFORMANCE_MEASURES

if TYPE_CHECKING:
    from pandas import DataFrame

TABLE_DESCRIPTIONS = {
    "trials": "one row for each planned trial (long format)",
    "computer": "one row for each trial under computer control (long format)",
    "cells": "mean CPM of each subject, law and group of tasks, with the failed arm (long format: R)",
    "cells_wide": "the means of cells.csv, one row for each subject (wide format: repeated measures ANOVA in JASP)",
    "means": "means over subjects of each law and group of tasks",
    "anova": "within-subjects ANOVA, law x difficulty",
    "anova_other_groups": "within-subjects ANOVA with tasks grouped by the other difficulty (of the computer instead of the "
    "operators, or the reverse)",
    "mixed": "linear mixed model: Wald tests",
    "comparisons": "paired comparisons of the laws within each group of tasks",
    "correlations": "correlations over tasks",
    "tasks": "one row for each task, from the easiest",
    "measures": "distributions of CPM and each measure in each scenario",
    "failed": "the laws with the failed arm, measure by measure",
    "healthy": "the laws with the healthy arm, measure by measure: the cost of failure tolerance before a failure",
    "ends": "outcomes of the trials of each scenario",
    "missing": "every trial without a CPM",
    "normalisers": "largest value of each measure, by which it is divided in CPM",
    "gains": "tasks in which another law performed better than the reference, for operators and computer",
    "power": "sufficient number of subjects",
    "power_curve": "power of each effect of the ANOVA against the number of subjects",
    "data_dictionary": "this table",
}

_COLUMN_MEANINGS = (
    ("data", "simulated: operators are programs; person: operators are people", ""),
    ("subject", "code", ""),
    ("task", "number, from 1", ""),
    ("scenario", "number, from 1", ""),
    ("law|first|second|against", "control law", ""),
    ("failed", "1: a joint is locked; 0: healthy", ""),
    ("difficulty", "group of tasks, or all", ""),
    (
        "cause",
        f"why the trial has no CPM; empty if it has one. {'; '.join(f'{k}: {v}' for k, v in CAUSE_SENTENCES.items())}",
        "",
    ),
    ("cpm", "combined performance measure; smaller is better", "1"),
    ("tasks|trials|subjects|n", "number of these", ""),
    (
        "mean|sd|se|lowest|quarter|median|three_quarters|highest",
        "mean, standard deviation and error, and quartiles",
        "as measured",
    ),
    ("first_mean|second_mean", "mean over subjects under each of the two laws", "as measured"),
    ("effect|test|kind|about|measure|unit", "subject of the row", ""),
    ("F|df|df_error|p", "F, degrees of freedom, and p with sphericity assumed; for a paired t-test its df and p", "1"),
    ("gg|p_gg|hf|p_hf", "epsilon of Greenhouse and Geisser, of Huynh and Feldt, and p corrected by them", "1"),
    ("partial_eta2|generalised_eta2", "partial and generalised eta squared", "1"),
    ("ss|ss_error", "sums of squares of the effect and of its error", "1"),
    ("chi2|converged", "Wald's statistic; 1 if the optimiser found the maximum", "1"),
    ("difference|low|high", "mean of first minus second, with its confidence interval", "as measured"),
    ("t|p_holm", "paired t; p corrected by Holm for all rows of the table", "1"),
    ("dz|dz_low|dz_high", "Cohen's dz with its confidence interval", "1"),
    (
        "median_difference|wilcoxon|rank_biserial",
        "median of first minus second; p of Wilcoxon's test; its effect size",
        "as measured",
    ),
    (
        "r|spearman|p_spearman|left_out",
        "Pearson's r (low, high: its interval), Spearman's, its p, and tasks without a value",
        "1",
    ),
    (
        "anticipated|actual|perceived",
        "CPM of the computer, median CPM of the operators, and their median rating, in the reference scenario",
        "1",
    ),
    ("median_operator", "subject whose CPM of the reference scenario is nearest to the median", ""),
    (
        r"(median_operator_|computer_)?cpm_\d+",
        "CPM in that scenario: median of the operators, of the median operator, or of the computer",
        "1",
    ),
    (r"reached_\d+", "operators who reached the target in that scenario", ""),
    (r"(computer_)?ratio_\d+_\d+", "CPM of the first scenario divided by that of the second; below 1 the first is better", "1"),
    ("computer_median", "median of the computer's trials", "as measured"),
    ("with_cpm|computer_with_cpm", "trials with a CPM, of operators and computer", ""),
    ("|".join(k.replace(" ", "_") for k in CAUSE_SENTENCES), "trials without a CPM by cause", ""),
    ("operators|computer", "largest measure", "as measured"),
    (
        "operators_gain|computer_gains|same_direction",
        "tasks in which the law performed better than the other; tasks in which operators and computer agree",
        "",
    ),
    ("operators_median_ratio|computer_median_ratio", "median of CPM under the law divided by CPM under the other", "1"),
    ("p_below|observed|least", "required p; the observed effect, and the lower end of its interval", "1"),
    ("sufficient|sufficient_for_least", "number of subjects that reaches the required power; NA if above 10,000", ""),
    (
        "power|power_for_least",
        "power with this number of subjects, for the observed effect and for the lower end of its interval",
        "1",
    ),
    ("fraction_of_subsets", "fraction of random subsets of this number of subjects with a significant effect", "1"),
    *((m.name, m.about, m.unit) for m in PERFORMANCE_MEASURES),
    ("table|column|meaning", "table, column, and meaning of the column", ""),
    (r"[a-z0-9_]+", "mean of the law and group of tasks in the name of the column", "1"),
)


def write_tables(analysis: Analysis, folder: Path) -> list[Path]:
    """Write every table and the data dictionary as CSV; a missing number is NA, and the decimal separator is a point.

    Raises:
        StoreError: The folder or a file cannot be written.
    """
    tables = {**analysis.tables, "data_dictionary": describe_columns(analysis)}
    return write_files(folder, {f"{name}.csv": write_csv_text(table, "NA") for name, table in tables.items()})


def describe_columns(analysis: Analysis) -> DataFrame:
    """Return a row for each column of each table: table, column, meaning, unit."""
    from pandas import DataFrame

    rows = []
    for name, table in analysis.tables.items():
        rows.append((name, "", TABLE_DESCRIPTIONS[name], ""))
        for column in map(str, table.columns):
            meaning, unit = next((about, unit) for pattern, about, unit in _COLUMN_MEANINGS if re.fullmatch(pattern, column))
            rows.append((name, column, meaning, unit))
    return DataFrame(rows, columns=["table", "column", "meaning", "unit"])
