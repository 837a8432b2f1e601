"""Presentation of the analysis of an experiment: the effect of the control law on operators with the failed arm."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.formatting import format_number
from holdfast.interface import report
from holdfast.interface.presentation import renderers
from holdfast.interface.presentation.presentation import FigureSpec, Notice, Presentation
from holdfast.interface.presentation.teleop.report_tables import build_tables, format_p_relation
from holdfast.interface.presentation.teleop.tables import write_tables
from holdfast.interface.report.page import Section
from holdfast.teleop.analysis.mixed_model import MixedModel
from holdfast.teleop.analysis.result import Analysis, Paths
from holdfast.teleop.protocol.protocol import Protocol


def to_dict(analysis: Analysis) -> dict[str, Any]:
    """Return the subjects, and the rows of every table, as JSON data."""
    return {
        "subjects": list(analysis.observed.subjects),
        "simulated": analysis.is_simulated,
        "left_out": analysis.left_out,
        "notes": analysis.notes,
        "tables": {name: table.to_dict("records") for name, table in analysis.tables.items()},
    }


def write(
    analysis: Analysis,
    path: Path,
    protocol: Protocol | None = None,
    paths: Paths | None = None,
    show: Sequence[int] | None = None,
) -> Path:
    """Write the report; see :func:`present` for the arguments."""
    return renderers.write(analysis, path, protocol=protocol, paths=paths, shown_tasks=show)


def save(
    analysis: Analysis,
    folder: Path,
    protocol: Protocol | None = None,
    paths: Paths | None = None,
    show: Sequence[int] | None = None,
) -> list[Path]:
    """Write report.html as :func:`write` does, and every table as CSV with a data dictionary; other files are not changed."""
    tables = write_tables(analysis, folder)
    return [write(analysis, folder / "report.html", protocol, paths, show), *tables]


def present(
    analysis: Analysis, protocol: Protocol | None = None, paths: Paths | None = None, shown_tasks: Sequence[int] | None = None
) -> Presentation:
    """Present the effect of the control law on operators with the failed arm, and its statistical tests.

    Args:
        analysis: Analysis to present.
        protocol: Protocol of the experiment, from which workspace and targets are drawn; None if not available.
        paths: Function that returns the tool positions of recorded trials; no motions are drawn if None.
        shown_tasks: Numbers of the tasks whose motions and distributions are drawn; the middle task of each group if None.

    Raises:
        InputError: A task in ``shown_tasks`` does not exist.
    """
    observed = analysis.observed
    tasks = middle_tasks(analysis) if shown_tasks is None else list(shown_tasks)
    for task in tasks:
        if task not in observed.tasks:
            raise InputError(f"there is no task {task}; the tasks are {observed.tasks[0]} to {observed.tasks[-1]}")
    missing = int((observed.cause != "").sum())
    lines = [
        f"{analysis.subject_phrase}, {len(observed.tasks)} tasks, {len(observed.conditions)} scenarios: "
        f"{observed.cause.size} trials, {missing} without a CPM."
    ]
    if analysis.mixed is not None:
        lines.append(_describe_mixed_model(analysis.mixed))
    names = ["cells", *["difficulty"] * bool(analysis.correlations), "tasks", "measures"]
    names += ["power"] * ("power_curve" in analysis.tables)
    return Presentation(
        f"Teleoperation with a failed joint: {analysis.subject_phrase}",
        _compose_answer(analysis),
        about="" if protocol is None else protocol.name,
        lines=lines,
        notices=_list_notices(analysis),
        tables=partial(build_tables, analysis),
        figures={name: FigureSpec(partial(_draw, analysis, name), on_page=False) for name in names},
        sections=partial(_build_sections, analysis, protocol, paths, tasks),
        method=[
            (
                "CPM",
                f"sum of {len(observed.normalisers)} measures, each divided by its largest value over all compared trials "
                f"(eq. 11). The measures are a reconstruction, because the table of the paper is lost",
            ),
            ("Tests", "The ANOVA, the sphericity corrections and the effect sizes are computed by holdfast"),
            ("Trials", "without training trials"),
            ("Tables", "each table is a CSV file next to this report; data_dictionary.csv explains every column"),
        ],
    )


def middle_tasks(analysis: Analysis) -> list[int]:
    """Return the number of the task of median difficulty in each group of tasks."""
    table = analysis.table("tasks")
    chosen = []
    for group in analysis.groups.names:
        group_tasks = table.loc[table["difficulty"] == group, "task"].tolist()
        chosen.append(int(group_tasks[(len(group_tasks) - 1) // 2]))
    return chosen


def _list_notices(analysis: Analysis) -> list[Notice]:
    notices = []
    if analysis.is_simulated:
        notices.append(Notice("Every operator is a program; no number was measured on people.", "bad", "Simulated"))
    if analysis.left_out:
        text = f"Excluded because of empty cells: {', '.join(analysis.left_out)}."
        notices.append(Notice(text, "bad", "Not all subjects"))
    if analysis.mixed is not None and not analysis.mixed.converged:
        notices.append(Notice("Do not use its numbers.", "bad", "The mixed model did not converge"))
    if analysis.notes:
        text = " ".join(f"{note.removesuffix('.')}." for note in analysis.notes)
        notices.append(Notice(text, "note", "Before using these numbers"))
    return notices


def _compose_answer(analysis: Analysis) -> str:
    means = sorted(analysis.law_means().items(), key=lambda law_mean: law_mean[1])
    text = (
        f"With a failed joint, {analysis.subject_phrase} perform best on average under the {means[0][0]} law: mean CPM "
        f"{format_number(means[0][1])}, "
    )
    text += f"compared with {' and '.join(f'{format_number(mean)} ({law})' for law, mean in means[1:])}"
    if analysis.anova is not None:
        effect = analysis.anova.effects[0]
        text += f"; F({effect.df}, {effect.df_error}) = {format_number(effect.F)}, p {format_p_relation(effect.p_gg)}"
        if effect.p_gg >= analysis.limit:
            text += ", which is not significant"
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


def _describe_mixed_model(model: MixedModel) -> str:
    deviations = ", ".join(f"{name} {format_number(float(np.sqrt(variance)))}" for name, variance in model.variances.items())
    text = (
        f"Linear mixed model of {model.trials:,} single trials, restricted maximum likelihood ({model.optimiser}, "
        f"{'converged' if model.converged else 'NOT converged'}); standard deviations of the random intercepts: {deviations}. "
        f"The tests are asymptotic. Tasks are a random effect, so the model generalises to other tasks, and difficulty is "
        f"tested more strictly than in an ANOVA."
    )
    return text + (f" Messages of the software: {'; '.join(model.messages)}." if model.messages else "")


# ---- page ----------------------------------------------------------------------------------------------------------------


def _build_sections(
    analysis: Analysis, protocol: Protocol | None, paths: Paths | None, shown_tasks: Sequence[int]
) -> Sequence[Section]:
    from holdfast.interface.presentation.teleop.sections import build_sections

    return build_sections(analysis, protocol, paths, shown_tasks)


def _draw(analysis: Analysis, name: str) -> report.Figure:
    from holdfast.interface.presentation.teleop.sections import draw_figure

    return draw_figure(analysis, name)
