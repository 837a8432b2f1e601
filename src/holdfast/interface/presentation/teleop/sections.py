"""Sections of the report of an experiment."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from holdfast.core.formatting import format_decimals, format_number, format_percent
from holdfast.interface import report
from holdfast.interface.presentation.presentation import TableSpec
from holdfast.interface.presentation.renderers import build_table_block
from holdfast.interface.presentation.teleop import figures as drawing
from holdfast.interface.presentation.teleop.examples import build_example_blocks
from holdfast.interface.presentation.teleop.report_tables import build_tables, format_p_value, format_range, make_table
from holdfast.interface.report.page import Block, Picture, Section, Text
from holdfast.teleop.analysis.observations import MEASURE_NAMES
from holdfast.teleop.analysis.result import Analysis, Paths
from holdfast.teleop.protocol.protocol import Protocol

_DIFFICULTY_LABELS = {
    "anticipated": "anticipated difficulty: CPM of the computer",
    "actual": "actual difficulty: median CPM of operators",
    "perceived": "perceived difficulty: median rating",
}
_CAUSE_COLUMNS = ("still", "time", "aborted", "broken_off", "no_rating", "not_recorded")
_MAX_LISTED = 30  # subjects or tasks with missing trials


def build_sections(
    analysis: Analysis, protocol: Protocol | None, paths: Paths | None, shown_tasks: Sequence[int]
) -> list[Section]:
    """Build the sections of the report."""
    return [
        Section("Control laws with the failed arm", _build_law_blocks(analysis)),
        Section("Anticipated, actual and perceived difficulty", _build_difficulty_blocks(analysis)),
        Section("Operators and computer control, by task", _build_task_blocks(analysis)),
        Section("Distributions of all measures", _build_distribution_blocks(analysis)),
        *(Section(f"Task {task}", build_example_blocks(analysis, task, protocol, paths)) for task in shown_tasks),
        Section("Control laws with the healthy arm", _build_healthy_blocks(analysis)),
        Section("Sufficient number of subjects", _build_power_blocks(analysis)),
        Section("Missing data", _build_missing_trial_blocks(analysis)),
        Section("Normalisers of CPM", [build_table_block(_tabulate_normalisers(analysis).texts())]),
    ]


def draw_figure(analysis: Analysis, name: str) -> report.Figure:
    """Draw a figure, by name, that depends only on the analysis."""
    if name == "cells":
        return drawing.draw_cell_means(analysis)
    if name == "difficulty":
        return drawing.scatter_figure(_make_correlation_panels(analysis), analysis.groups.names)
    if name == "tasks":
        prefix = "Simulated operators: " if analysis.is_simulated else "Operators: "
        return drawing.tasks_figure(analysis, (f"{prefix}the median operator of each task", "Computer"))
    return drawing.draw_power(analysis) if name == "power" else _draw_measures(analysis)


def _draw_with_caption(analysis: Analysis, name: str, about: str) -> Picture:
    """Draw a figure with its caption, which marks simulated operators."""
    text = f"Simulated operators. {about}" if analysis.is_simulated else about
    return Picture(report.svg(draw_figure(analysis, name), name, text), text)


def _build_law_blocks(analysis: Analysis) -> list[Block]:
    """Build the comparison of the laws with the failed arm: means, tests, and every measure."""
    grouping = "computer" if analysis.groups.by == "computer" else "median operator"
    caption = (
        f"Mean CPM of each subject (dots), and mean over subjects (large) with {100 * analysis.confidence:g} % intervals; "
        f"{analysis.subject_phrase}, tasks grouped by the {grouping}'s CPM."
    )
    blocks: list[Block] = [_draw_with_caption(analysis, "cells", caption)]
    blocks += [build_table_block(table.texts()) for table in build_tables(analysis)]
    if "anova_other_groups" in analysis.tables:
        grouping = "computer's" if analysis.groups.by == "operators" else "median operator's"
        effect_texts = "; ".join(
            f"{r['effect']} F({r['df']}, {r['df_error']}) = {format_number(r['F'])}"
            for _, r in analysis.table("anova_other_groups").iterrows()
        )
        blocks.append(Text(f"With the tasks grouped by the {grouping} CPM instead: {effect_texts}.", quiet=True))
    table = _tabulate_measures(analysis, "failed", "The laws with the failed arm, measure by measure")
    return [*blocks, build_table_block(table.texts())]


def _tabulate_measures(analysis: Analysis, name: str, title: str) -> TableSpec:
    table, names_laws = analysis.table(name), len(analysis.conditions) > 2
    rows = []
    for _, record in table.iterrows():
        label, factor = (
            ("CPM", 1.0) if record["measure"] == "CPM" else drawing.label_measure(MEASURE_NAMES.index(record["measure"]))
        )
        rows.append(
            [
                label,
                *[f"{record['first']} − {record['second']}"] * names_laws,
                *(format_number(factor * record[column]) for column in ("first_mean", "second_mean")),
                format_range(record, "difference", "low", "high", factor=factor),
                format_p_value(record["p_holm"]),
                format_decimals(record["dz"], 2) if np.isfinite(record["dz"]) else "–",
                format_p_value(record["wilcoxon"]),
            ]
        )
    laws = ["first", "second"] if names_laws else [str(table[column].iloc[0]) for column in ("first", "second")]
    head = ["measure", *["laws"] * names_laws, *laws, "first − second", "p Holm", "dz", "p Wilcoxon"]
    title += (
        f": mean of each subject over the tasks completed under both laws, {int(table['trials'].iloc[0]):,} pairs of trials; "
        f"smaller is better"
    )
    return make_table(analysis, title, head, rows)


def _build_healthy_blocks(analysis: Analysis) -> list[Block]:
    """Build the comparison of the laws with the healthy arm."""
    if "healthy" not in analysis.tables:
        return []
    table = analysis.table("healthy")
    blocks: list[Block] = []
    for _, record in table[table["measure"] == "M1"].iterrows():
        change = record["second_mean"] / record["first_mean"] - 1 if record["first_mean"] > 0 else float("nan")
        if np.isfinite(change):
            comparison = "longer" if change > 0 else "shorter"
            blocks.append(
                Text(
                    f"With the healthy arm, tasks take {format_percent(abs(change))} {comparison} under {record['second']} "
                    f"than under {record['first']} ({format_number(record['second_mean'])} instead of "
                    f"{format_number(record['first_mean'])} cycles)."
                )
            )
    table_block = build_table_block(_tabulate_measures(analysis, "healthy", "The laws with the healthy arm").texts())
    return [*blocks, table_block]


def _make_correlation_panels(analysis: Analysis) -> list[drawing.Scatter]:
    table = analysis.table("tasks").sort_values("task")
    panels = []
    for correlation in analysis.correlations:
        if correlation.first in _DIFFICULTY_LABELS:
            abscissa, ordinate = (table[name].to_numpy(dtype=np.float64) for name in (correlation.first, correlation.second))
            panels.append(
                drawing.Scatter(
                    x=abscissa,
                    y=ordinate,
                    xlabel=_DIFFICULTY_LABELS[correlation.first],
                    ylabel=_DIFFICULTY_LABELS[correlation.second],
                    correlation=correlation,
                    groups=analysis.groups.of_task,
                )
            )
    return panels


def _build_difficulty_blocks(analysis: Analysis) -> list[Block]:
    if not _make_correlation_panels(analysis):
        return []
    caption = f"Each dot is a task in scenario {analysis.conditions[0].label}. " + " ".join(
        f"{correlation}; Spearman {correlation.spearman:.3f}."
        for correlation in analysis.correlations
        if correlation.first in _DIFFICULTY_LABELS
    )
    left_out = sorted({task_name for correlation in analysis.correlations for task_name in correlation.left_out})
    if left_out:
        caption += f" Without a value on one of the axes: {', '.join(left_out)}."
    return [_draw_with_caption(analysis, "difficulty", caption)]


def _build_task_blocks(analysis: Analysis) -> list[Block]:
    caption = (
        f"CPM of each task with the failed arm ({len(analysis.observed.tasks)} tasks). The median operator of a task is the "
        f"operator whose CPM under the reference law is nearest to the median of all. Coloured stems: the other law is better "
        f"than the reference."
    )
    blocks: list[Block] = [_draw_with_caption(analysis, "tasks", caption)]
    if "gains" in analysis.tables:
        columns = ("operators_gain", "computer_gains", "same_direction")
        rows = [
            [
                *(str(record["difficulty"]), str(record["law"])),
                *(f"{record[column]} of {record['tasks']}" for column in columns),
                *(format_number(record[column]) for column in ("operators_median_ratio", "computer_median_ratio")),
            ]
            for _, record in analysis.table("gains").iterrows()
        ]
        head = ("tasks", "law", "gain, operators", "gain, computer", "same direction")
        law = analysis.conditions[0].law
        title = f"Tasks with a gain relative to {law} (CPM ratio below 1), of the tasks completed under both laws"
        table = make_table(analysis, title, (*head, "median ratio, operators", "median ratio, computer"), rows)
        blocks.append(build_table_block(table.texts()))
        for correlation in analysis.correlations:
            if correlation.first.startswith("operators'"):
                blocks.append(Text(f"Correlation over tasks: {correlation}; Spearman {correlation.spearman:.3f}.", quiet=True))
    return blocks


def _draw_measures(analysis: Analysis) -> report.Figure:
    observed, computer = analysis.observed, analysis.computer
    values = drawing.list_measure_values(observed)
    computer_medians = None
    if computer is not None:
        table = analysis.table("measures")
        names = ["CPM", *MEASURE_NAMES[:-1]]
        computer_medians = [table.loc[table["measure"] == name, "computer_median"].to_numpy(dtype=np.float64) for name in names]
    return drawing.measures_figure(values, computer_medians, [condition.scenario for condition in observed.conditions])


def _build_distribution_blocks(analysis: Analysis) -> list[Block]:
    observed = analysis.observed
    caption = (
        f"CPM and all measures over {observed.cpm.size:,} trials in {len(observed.tasks)} tasks, without trials that did not "
        f"reach the target. Scenarios: {'; '.join(condition.label for condition in observed.conditions)}. Circles: median over "
        "tasks under computer control. Unless the notes state otherwise, operators and computer have different CPM normalisers."
    )
    return [_draw_with_caption(analysis, "measures", caption)]


def _build_power_blocks(analysis: Analysis) -> list[Block]:
    rows = [
        [
            *(record["test"], record["kind"], format_p_value(record["p_below"])),
            *(f"{record['effect']} {format_number(record['observed'])}", format_number(record["least"])),
            *(
                str(int(record[name])) if np.isfinite(record[name]) else "> 10,000"
                for name in ("sufficient", "sufficient_for_least")
            ),
        ]
        for _, record in analysis.table("power").iterrows()
    ]
    head = ("test", "kind", "p below", "observed effect", "lower end", "subjects", "subjects for the lower end")
    title = (
        f"Smallest number of subjects with a power of {analysis.power:g}. Observed here: {analysis.subject_phrase}. "
        "t-tests: noncentral t distribution, at the p that Holm's correction requires of the smallest one. F tests: noncentral "
        "F distribution with the epsilon of Greenhouse and Geisser. Assumptions: normal differences, and an effect as large as "
        f"observed, or as large as the lower end of its {100 * analysis.confidence:g} % interval, which should be used to plan"
    )
    blocks: list[Block] = [build_table_block(make_table(analysis, title, head, rows).texts())]
    if "power_curve" in analysis.tables:
        caption = (
            f"Lines: noncentral F distribution. Circles: fraction of 2000 random subsets of the {analysis.subject_phrase}, "
            f"sampled without replacement, in which the effect has p < {analysis.limit:g}. Subsets with nearly all subjects "
            f"hardly differ."
        )
        blocks.append(_draw_with_caption(analysis, "power", caption))
    return blocks


def _build_missing_trial_blocks(analysis: Analysis) -> list[Block]:
    endings, missing_trials = analysis.table("ends"), analysis.table("missing")
    causes = [cause for cause in endings.columns if cause in _CAUSE_COLUMNS and endings[cause].sum() > 0]
    rows = [
        [
            f"{record['scenario']}: {'failed' if record['failed'] else 'healthy'}, {record['law']}",
            *(int(record[column]) for column in ("trials", "with_cpm", *causes)),
        ]
        for _, record in endings.iterrows()
    ]
    head = ["scenario", "trials", "with a CPM", *(cause.replace("_", " ") for cause in causes)]
    table = make_table(analysis, f"How the {analysis.observed.cause.size:,} trials ended", head, rows)
    blocks: list[Block] = [build_table_block(table.texts())]
    for grouping in ("subject", "task") if len(missing_trials) else ():
        count = missing_trials[grouping].value_counts()
        texts = ", ".join(f"{name} ({trial_count})" for name, trial_count in count.head(_MAX_LISTED).items())
        remainder = "" if len(count) <= _MAX_LISTED else f" and {len(count) - _MAX_LISTED} more"
        text = f"Trials without a CPM by {grouping}: {texts}{remainder}. All of them are listed in missing.csv."
        blocks.append(Text(text, quiet=True))
    return blocks


def _tabulate_normalisers(analysis: Analysis) -> TableSpec:
    table = analysis.table("normalisers")
    sources = [source for source in ("operators", "computer") if source in table]
    rows = [
        [
            *(str(record["measure"]), *(format_number(float(record[source])) for source in sources)),
            "" if record["unit"] == "1" else str(record["unit"]),
        ]
        for _, record in table.iterrows()
    ]
    return make_table(analysis, "Largest values, by which the measures in CPM are divided", ("measure", *sources, "unit"), rows)
