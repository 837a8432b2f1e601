"""HTML report of an experiment, which begins with the effect of the law on the operators."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from holdfast.core.errors import InputError
from holdfast.core.formatting import format_count, format_number
from holdfast.core.progress import reports_progress
from holdfast.interface.presentation.teleop import figures as drawing
from holdfast.interface.presentation.teleop.captions import caption_figure, format_p_relation, format_p_value, label_table
from holdfast.interface.presentation.teleop.examples import build_example_blocks
from holdfast.interface.presentation.teleop.laws_section import build_healthy_blocks, build_law_blocks
from holdfast.interface.presentation.teleop.tables import TABLE_DESCRIPTIONS, write_tables
from holdfast.interface.report import page
from holdfast.interface.report.page import Block, Callout, Cell, Page, Section, Table, Text
from holdfast.teleop.analysis.observations import MEASURE_NAMES
from holdfast.teleop.analysis.result import Analysis, Paths

if TYPE_CHECKING:
    from pandas import DataFrame

    from holdfast.teleop.protocol.protocol import Protocol

_DIFFICULTY_LABELS = {
    "anticipated": "anticipated difficulty: CPM of the computer",
    "actual": "actual difficulty: median CPM of operators",
    "perceived": "perceived difficulty: median rating",
}


@reports_progress("drawing the report")
def write(
    analysis: Analysis,
    path: Path,
    protocol: Protocol | None = None,
    paths: Paths | None = None,
    show: Sequence[int] | None = None,
) -> Path:
    """Write the analysis as a page.

    Args:
        analysis: What was found.
        path: The file.
        protocol: Of the experiment: the workspace, the targets and what a failure takes away are drawn from it.
        paths: Gives the tool points of recorded trials; without it no motions are drawn.
        show: Tasks, by number, whose motions and distributions are drawn; the middle one of each group if not given.

    Raises:
        InputError: A task to show that there is not.
    """
    return page.write(build(analysis, protocol, paths, show), path)


def save(
    analysis: Analysis,
    folder: Path,
    protocol: Protocol | None = None,
    paths: Paths | None = None,
    show: Sequence[int] | None = None,
) -> list[Path]:
    """Write report.html as :func:`write` does, and every table as CSV with a data dictionary; files with other names stay."""
    tables = write_tables(analysis, folder)
    return [write(analysis, folder / "report.html", protocol, paths, show), *tables]


def figures(analysis: Analysis) -> dict[str, Figure]:
    """Draw the figures of the page that depend on the analysis alone, by name."""
    panels, power_curve = (
        _make_correlation_panels(analysis),
        {"power": drawing.draw_power(analysis)} if "power_curve" in analysis.tables else {},
    )
    return {
        "cells": drawing.draw_cell_means(analysis),
        **({"difficulty": drawing.scatter_figure(panels, analysis.groups.names)} if panels else {}),
        "tasks": _draw_tasks(analysis),
        "measures": _draw_measures(analysis),
        **power_curve,
    }


def build(
    analysis: Analysis, protocol: Protocol | None = None, paths: Paths | None = None, show: Sequence[int] | None = None
) -> Page:
    """Build the report as blocks, before it becomes HTML."""
    result = analysis
    shown_tasks = middle_tasks(result) if show is None else list(show)
    for task in shown_tasks:
        if task not in result.observed.tasks:
            raise InputError(
                f"there is no task {task} to show; there are {result.observed.tasks[0]} to {result.observed.tasks[-1]}"
            )
    alerts = []
    if result.is_simulated:
        alerts.append(Callout("Every operator is a program; nothing here is measured on people.", "bad", "Simulated."))
    if result.left_out:
        alerts.append(Callout(f"Left out because of empty cells: {', '.join(result.left_out)}.", "bad", "Not all subjects."))
    if result.mixed is not None and not result.mixed.converged:
        alerts.append(Callout("Its numbers must not be used.", "bad", "The mixed model did not converge."))
    sections = [
        Section("The failed arm under each law", build_law_blocks(result)),
        Section("Anticipated, actual and perceived difficulty", _build_difficulty_blocks(result)),
        Section("Task by task: operators and computer", _build_task_blocks(result)),
        Section("Distributions of all measures", _build_distribution_blocks(result)),
        *(Section(f"Task {task}", build_example_blocks(result, task, protocol, paths)) for task in shown_tasks),
        Section("The healthy arm: what tolerance costs before a failure", build_healthy_blocks(result)),
        Section("How many subjects would have been enough", _build_power_blocks(result)),
        Section("What is missing", _build_missing_trial_blocks(result)),
    ]
    name = "" if protocol is None else protocol.name
    return Page(
        f"Teleoperation with a failed joint: {result.subject_phrase}",
        _compose_headline(result),
        sections,
        subtitle=name,
        warnings=alerts,
        method=_build_method_blocks(result),
    )


def middle_tasks(analysis: Analysis) -> list[int]:
    """Return the task of middle difficulty of each group."""
    table = analysis.table("tasks")
    chosen = []
    for group in analysis.groups.names:
        group_tasks = table.loc[table["difficulty"] == group, "task"].tolist()
        chosen.append(int(group_tasks[(len(group_tasks) - 1) // 2]))
    return chosen


def _compose_headline(analysis: Analysis) -> str:
    means = sorted(analysis.law_means().items(), key=lambda law_mean: law_mean[1])
    text = (
        f"With a failed joint the {means[0][0]} law makes {analysis.subject_phrase} perform best on average: mean CPM "
        f"{format_number(means[0][1])}, "
    )
    text += f"against {' and '.join(f'{format_number(mean)} ({law})' for law, mean in means[1:])}"
    if analysis.anova is not None:
        effect = analysis.anova.effects[0]
        text += f"; F({effect.df}, {effect.df_error}) = {format_number(effect.F)}, p {format_p_relation(effect.p_gg)}"
        if effect.p_gg >= analysis.limit:
            text += ", which may be chance"
    elif analysis.mixed is not None:
        wald_test = analysis.mixed.tests[0]
        text += f"; mixed model, chi²({wald_test.df}) = {format_number(wald_test.chi2)}, p {format_p_relation(wald_test.p)}"
    rows = analysis.table("comparisons")
    if len(analysis.conditions) == 2:
        findings = []
        for _, record in rows.iterrows():
            if not record["p_holm"] < analysis.limit:
                findings.append(f"for {record['difficulty']} tasks no difference was found")
            else:
                better = record["first"] if record["difference"] < 0 else record["second"]
                findings.append(
                    f"for {record['difficulty']} tasks {better} is better by {format_number(abs(record['difference']))}"
                )
        text += f". {'; '.join(findings).capitalize()}"
    return text + "."


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
    panels = _make_correlation_panels(analysis)
    blocks: list[Block] = []
    if panels:
        caption = f"Each dot is a task in scenario {analysis.conditions[0].label}. " + " ".join(
            f"{correlation}; Spearman {correlation.spearman:.3f}."
            for correlation in analysis.correlations
            if correlation.first in _DIFFICULTY_LABELS
        )
        left_out = sorted({task_name for correlation in analysis.correlations for task_name in correlation.left_out})
        if left_out:
            caption += f" Without a value on one of the axes: {', '.join(left_out)}."
        blocks.append(caption_figure(analysis, drawing.scatter_figure(panels, analysis.groups.names), "difficulty", caption))
    return blocks


def _draw_tasks(analysis: Analysis) -> Figure:
    prefix = "Simulated operators: " if analysis.is_simulated else "Operators: "
    return drawing.tasks_figure(analysis, (f"{prefix}the median operator of each task", "Computer"))


def _build_task_blocks(analysis: Analysis) -> list[Block]:
    caption = (
        f"CPM of each task with the failed arm ({len(analysis.observed.tasks)} tasks). The median operator of a task is "
        f"the one whose CPM under "
        "the reference law is nearest to the median of all. Coloured stems: another law than the reference is better."
    )
    blocks: list[Block] = [caption_figure(analysis, _draw_tasks(analysis), "tasks", caption)]
    if "gains" in analysis.tables:
        rows: list[list[Cell]] = [
            [
                str(record["difficulty"]),
                str(record["law"]),
                *(
                    f"{record[column]} of {record['tasks']}"
                    for column in ("operators_gain", "computer_gains", "same_direction")
                ),
                format_number(record["operators_median_ratio"]),
                format_number(record["computer_median_ratio"]),
            ]
            for _, record in analysis.table("gains").iterrows()
        ]
        header = (
            "tasks",
            "law",
            "operators gain",
            "computer gains",
            "same direction",
            "median ratio, operators",
            "median ratio, computer",
        )
        caption = (
            f"Gain and loss against {analysis.conditions[0].law}: a CPM ratio below 1 is a gain. Tasks that both completed"
        )
        blocks.append(Table(rows, header, frozenset(range(2, 7)), caption=label_table(analysis, caption), wide=True))
        for correlation in analysis.correlations:
            if correlation.first.startswith("operators'"):
                blocks.append(Text(f"Correlation over tasks: {correlation}; Spearman {correlation.spearman:.3f}.", quiet=True))
    return blocks


def _draw_measures(analysis: Analysis) -> Figure:
    observed, computer = analysis.observed, analysis.computer
    measures = np.concatenate([observed.cpm[..., None], observed.measures], axis=-1)[
        ..., : len(MEASURE_NAMES) + observed.has_ratings
    ]
    values = [
        [measures[:, :, scenario, measure].ravel() for scenario in range(len(observed.conditions))]
        for measure in range(measures.shape[-1])
    ]
    computer_medians = None
    if computer is not None:
        table = analysis.table("measures")
        names = ["CPM", *MEASURE_NAMES[:-1]]
        computer_medians = [table.loc[table["measure"] == name, "computer_median"].to_numpy(dtype=np.float64) for name in names]
    return drawing.measures_figure(values, computer_medians, [condition.scenario for condition in observed.conditions])


def _build_distribution_blocks(analysis: Analysis) -> list[Block]:
    observed = analysis.observed
    legend = "; ".join(condition.label for condition in observed.conditions)
    caption = (
        f"CPM and all measures over {observed.cpm.size:,} trials in {len(observed.tasks)} tasks, without those that did "
        f"not reach the "
        f"target. Scenarios: {legend}. "
        "Circles: the computer's median over tasks. CPM of operators and computer have different normalisers unless the notes "
        "say otherwise."
    )
    return [caption_figure(analysis, _draw_measures(analysis), "measures", caption)]


def _build_power_blocks(analysis: Analysis) -> list[Block]:
    rows: list[list[Cell]] = []
    for _, record in analysis.table("power").iterrows():
        subject_counts: list[Cell] = []
        for name in ("sufficient", "sufficient_for_least"):
            subject_counts.append(str(int(record[name])) if np.isfinite(record[name]) else "> 10,000")
        rows.append(
            [
                record["test"],
                record["kind"],
                format_p_value(record["p_below"]),
                f"{record['effect']} {format_number(record['observed'])}",
                format_number(record["least"]),
                *subject_counts,
            ]
        )
    header = ("test", "kind", "p below", "observed effect", "lower end", "subjects", "subjects for the lower end")
    caption = (
        f"Smallest number of subjects with a power of {analysis.power:g}. Observed here: {analysis.subject_phrase}. "
        f"t-tests by the noncentral t "
        "distribution, at the p that Holm's correction asks of the first; F by the noncentral F distribution with the "
        "epsilon of Greenhouse and Geisser. Assumed: normal differences, and an effect as large as the one observed, or as the "
        f"lower end of its {100 * analysis.confidence:g} % interval; plan with that"
    )
    blocks: list[Block] = [Table(rows, header, frozenset({2, 3, 4, 5, 6}), caption=label_table(analysis, caption), wide=True)]
    if "power_curve" in analysis.tables:
        figure_caption = (
            f"Lines: noncentral F. Circles: of 2000 random subsets of the {analysis.subject_phrase}, drawn without "
            f"replacement, the fraction in "
            f"which the effect has p < {analysis.limit:g}; near all of them the subsets hardly differ."
        )
        blocks.append(caption_figure(analysis, drawing.draw_power(analysis), "power", figure_caption))
    return blocks


def _build_missing_trial_blocks(analysis: Analysis) -> list[Block]:
    observed, endings, missing_trials = analysis.observed, analysis.table("ends"), analysis.table("missing")
    causes = [
        cause for cause in endings.columns if cause in {"still", "time", "aborted", "broken_off", "no_rating", "not_recorded"}
    ]
    used_causes = [cause for cause in causes if endings[cause].sum() > 0]
    rows: list[list[Cell]] = [
        [
            f"{record['scenario']}: {'failed' if record['failed'] else 'healthy'}, {record['law']}",
            str(record["trials"]),
            str(record["with_cpm"]),
            *(str(record[cause]) for cause in used_causes),
        ]
        for _, record in endings.iterrows()
    ]
    header = ["scenario", "trials", "with a CPM", *(cause.replace("_", " ") for cause in used_causes)]
    blocks: list[Block] = [
        Table(
            rows,
            header,
            frozenset(range(1, len(header))),
            caption=label_table(analysis, f"How the {observed.cause.size:,} trials ended"),
        )
    ]
    if len(missing_trials):
        for grouping, max_listed in (("subject", 30), ("task", 30)):
            count = missing_trials[grouping].value_counts()
            count_texts = ", ".join(f"{name} ({trial_count})" for name, trial_count in count.head(max_listed).items())
            remainder = "" if len(count) <= max_listed else f" and {len(count) - max_listed} more"
            blocks.append(
                Text(f"Trials without a CPM by {grouping}: {count_texts}{remainder}. Every one is in missing.csv.", quiet=True)
            )
    return blocks


def _build_method_blocks(analysis: Analysis) -> list[Block]:
    observed = analysis.observed
    blocks: list[Block] = [
        Callout(Markup("<br>").join(f"• {note}" for note in analysis.notes), title="Read this before using these numbers")
    ]
    count = len(observed.normalisers)
    blocks.append(
        Text(
            f"CPM is the sum of {count} measures, each divided by its largest value over all trials compared "
            f"(eq. 11). The measures are "
            "a reconstruction: the table of the paper is lost. The ANOVA, the "
            "sphericity corrections "
            "and effect sizes are computed here. Training trials are not analysed."
        )
    )
    table: DataFrame = analysis.table("normalisers")
    sources = [source for source in ("operators", "computer") if source in table]
    rows: list[list[Cell]] = [
        [
            f"{record['measure']}",
            *(format_number(float(record[source])) for source in sources),
            "" if record["unit"] == "1" else str(record["unit"]),
        ]
        for _, record in table.iterrows()
    ]
    blocks.append(
        Table(
            rows,
            ("largest value", *sources, "unit"),
            frozenset(range(1, 1 + len(sources))),
            caption=label_table(analysis, "Normalisers of CPM"),
        )
    )
    files: list[list[Cell]] = [[f"{name}.csv", TABLE_DESCRIPTIONS[name]] for name in (*analysis.tables, "data_dictionary")]
    blocks.append(
        Table(files, ("file", "what is in it"), caption=f"{format_count(len(files), 'table')} written next to this report")
    )
    return blocks
