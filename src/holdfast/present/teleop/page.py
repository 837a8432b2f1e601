"""The report of an experiment: one HTML file that begins with what the law did to the operators."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from holdfast.errors import InputError
from holdfast.notice import says
from holdfast.present.teleop import figures as drawing
from holdfast.present.teleop.captions import captioned, equals, labelled, p_value
from holdfast.present.teleop.examples import example_blocks
from holdfast.present.teleop.laws_section import healthy, laws
from holdfast.present.teleop.tables import ABOUT, write_tables
from holdfast.report import page
from holdfast.report.page import Block, Callout, Cell, Page, Section, Table, Text
from holdfast.teleop.analysis.observations import NAMES
from holdfast.teleop.analysis.result import Analysis, Paths
from holdfast.words import counted, number

if TYPE_CHECKING:
    from pandas import DataFrame

    from holdfast.teleop.protocol.protocol import Protocol

_SCALES = {
    "anticipated": "anticipated difficulty: CPM of the computer",
    "actual": "actual difficulty: median CPM of operators",
    "perceived": "perceived difficulty: median rating",
}


@says("drawing the report")
def write(
    a: Analysis, path: Path, protocol: Protocol | None = None, paths: Paths | None = None, show: Sequence[int] | None = None
) -> Path:
    """The analysis as a page.

    Args:
        a: What was found.
        path: The file.
        protocol: Of the experiment: the workspace, the targets and what a failure takes away are drawn from it.
        paths: Gives the tool points of recorded trials; without it no motions are drawn.
        show: Tasks, by number, whose motions and distributions are drawn; the middle one of each group if not given.

    Raises:
        InputError: A task to show that there is not.
    """
    return page.write(build(a, protocol, paths, show), path)


def save(
    a: Analysis, folder: Path, protocol: Protocol | None = None, paths: Paths | None = None, show: Sequence[int] | None = None
) -> list[Path]:
    """report.html as :func:`write` has it, and every table as CSV with a data dictionary; files of other names stay."""
    tables = write_tables(a, folder)
    return [write(a, folder / "report.html", protocol, paths, show), *tables]


def figures(a: Analysis) -> dict[str, Figure]:
    """The figures of the page that need nothing but the analysis, by name."""
    panels, curve = _scatters(a), {"power": drawing.power_figure(a)} if "power_curve" in a.tables else {}
    return {
        "cells": drawing.cells_figure(a),
        **({"difficulty": drawing.scatter_figure(panels, a.groups.names)} if panels else {}),
        "tasks": _tasks_figure(a),
        "measures": _measures_figure(a),
        **curve,
    }


def build(
    analysis: Analysis, protocol: Protocol | None = None, paths: Paths | None = None, show: Sequence[int] | None = None
) -> Page:
    """The report as blocks, before it becomes HTML."""
    a = analysis
    shown = middle_tasks(a) if show is None else list(show)
    for t in shown:
        if t not in a.observed.tasks:
            raise InputError(f"there is no task {t} to show; there are {a.observed.tasks[0]} to {a.observed.tasks[-1]}")
    alerts = []
    if a.simulated:
        alerts.append(Callout("Every operator is a program; nothing here is measured on people.", "bad", "Simulated."))
    if a.left_out:
        alerts.append(Callout(f"Left out because of empty cells: {', '.join(a.left_out)}.", "bad", "Not all subjects."))
    if a.mixed is not None and not a.mixed.converged:
        alerts.append(Callout("Its numbers must not be used.", "bad", "The mixed model did not converge."))
    sections = [
        Section("The failed arm under each law", laws(a)),
        Section("Anticipated, actual and perceived difficulty", _difficulty(a)),
        Section("Task by task: operators and computer", _tasks(a)),
        Section("Distributions of all measures", _distributions(a)),
        *(Section(f"Task {t}", example_blocks(a, t, protocol, paths)) for t in shown),
        Section("The healthy arm: what tolerance costs before a failure", healthy(a)),
        Section("How many subjects would have been enough", _power(a)),
        Section("What is missing", _missing(a)),
    ]
    name = "" if protocol is None else protocol.name
    return Page(
        f"Teleoperation with a failed joint: {a.who}",
        _headline(a),
        sections,
        subtitle=name,
        warnings=alerts,
        method=_method(a),
    )


def middle_tasks(a: Analysis) -> list[int]:
    """Of each group the task of middle difficulty."""
    table = a.table("tasks")
    found = []
    for group in a.groups.names:
        mine = table.loc[table["difficulty"] == group, "task"].tolist()
        found.append(int(mine[(len(mine) - 1) // 2]))
    return found


def _headline(a: Analysis) -> str:
    means = sorted(a.law_means().items(), key=lambda x: x[1])
    text = f"With a failed joint the {means[0][0]} law makes {a.who} perform best on average: mean CPM {number(means[0][1])}, "
    text += f"against {' and '.join(f'{number(v)} ({law})' for law, v in means[1:])}"
    if a.anova is not None:
        e = a.anova.effects[0]
        text += f"; F({e.df}, {e.df_error}) = {number(e.F)}, p {equals(e.p_gg)}"
        if e.p_gg >= a.limit:
            text += ", which may be chance"
    elif a.mixed is not None:
        w = a.mixed.tests[0]
        text += f"; mixed model, chi²({w.df}) = {number(w.chi2)}, p {equals(w.p)}"
    rows = a.table("comparisons")
    if len(a.conditions) == 2:
        said = []
        for _, r in rows.iterrows():
            if not r["p_holm"] < a.limit:
                said.append(f"for {r['difficulty']} tasks no difference was found")
            else:
                better = r["first"] if r["difference"] < 0 else r["second"]
                said.append(f"for {r['difficulty']} tasks {better} is better by {number(abs(r['difference']))}")
        text += f". {'; '.join(said).capitalize()}"
    return text + "."


def _scatters(a: Analysis) -> list[drawing.Scatter]:
    table = a.table("tasks").sort_values("task")
    panels = []
    for c in a.correlations:
        if c.first in _SCALES:
            x, y = (table[name].to_numpy(dtype=np.float64) for name in (c.first, c.second))
            panels.append(
                drawing.Scatter(
                    x=x, y=y, xlabel=_SCALES[c.first], ylabel=_SCALES[c.second], correlation=c, groups=a.groups.of_task
                )
            )
    return panels


def _difficulty(a: Analysis) -> list[Block]:
    panels = _scatters(a)
    blocks: list[Block] = []
    if panels:
        caption = f"Each dot is a task in scenario {a.conditions[0].label}. " + " ".join(
            f"{c}; Spearman {c.spearman:.3f}." for c in a.correlations if c.first in _SCALES
        )
        lost = sorted({x for c in a.correlations for x in c.left_out})
        if lost:
            caption += f" Without a value on one of the axes: {', '.join(lost)}."
        blocks.append(captioned(a, drawing.scatter_figure(panels, a.groups.names), "difficulty", caption))
    return blocks


def _tasks_figure(a: Analysis) -> Figure:
    prefix = "Simulated operators: " if a.simulated else "Operators: "
    return drawing.tasks_figure(a, (f"{prefix}the median operator of each task", "Computer"))


def _tasks(a: Analysis) -> list[Block]:
    caption = (
        f"CPM of each task with the failed arm ({len(a.observed.tasks)} tasks). The median operator of a task is "
        f"the one whose CPM under "
        "the reference law is nearest to the median of all. Coloured stems: another law than the reference is better."
    )
    blocks: list[Block] = [captioned(a, _tasks_figure(a), "tasks", caption)]
    if "gains" in a.tables:
        rows: list[list[Cell]] = [
            [
                str(r["difficulty"]),
                str(r["law"]),
                *(f"{r[x]} of {r['tasks']}" for x in ("operators_gain", "computer_gains", "same_direction")),
                number(r["operators_median_ratio"]),
                number(r["computer_median_ratio"]),
            ]
            for _, r in a.table("gains").iterrows()
        ]
        head = (
            "tasks",
            "law",
            "operators gain",
            "computer gains",
            "same direction",
            "median ratio, operators",
            "median ratio, computer",
        )
        caption = f"Gain and loss against {a.conditions[0].law}: a CPM ratio below 1 is a gain. Tasks that both completed"
        blocks.append(Table(rows, head, frozenset(range(2, 7)), caption=labelled(a, caption), wide=True))
        for c in a.correlations:
            if c.first.startswith("operators'"):
                blocks.append(Text(f"Correlation over tasks: {c}; Spearman {c.spearman:.3f}.", quiet=True))
    return blocks


def _measures_figure(a: Analysis) -> Figure:
    o, machine = a.observed, a.computer
    every = np.concatenate([o.cpm[..., None], o.measures], axis=-1)[..., : len(NAMES) + o.rated]
    values = [[every[:, :, s, k].ravel() for s in range(len(o.conditions))] for k in range(every.shape[-1])]
    its = None
    if machine is not None:
        table = a.table("measures")
        names = ["CPM", *NAMES[:-1]]
        its = [table.loc[table["measure"] == name, "computer_median"].to_numpy(dtype=np.float64) for name in names]
    return drawing.measures_figure(values, its, [c.scenario for c in o.conditions])


def _distributions(a: Analysis) -> list[Block]:
    o = a.observed
    key = "; ".join(c.label for c in o.conditions)
    caption = (
        f"CPM and all measures over {o.cpm.size:,} trials in {len(o.tasks)} tasks, without those that did not reach the "
        f"target. Scenarios: {key}. "
        "Circles: the computer's median over tasks. CPM of operators and computer have different normalisers unless the notes "
        "say otherwise."
    )
    return [captioned(a, _measures_figure(a), "measures", caption)]


def _power(a: Analysis) -> list[Block]:
    rows: list[list[Cell]] = []
    for _, r in a.table("power").iterrows():
        enough: list[Cell] = []
        for name in ("sufficient", "sufficient_for_least"):
            enough.append(str(int(r[name])) if np.isfinite(r[name]) else "> 10,000")
        rows.append(
            [r["test"], r["kind"], p_value(r["p_below"]), f"{r['effect']} {number(r['observed'])}", number(r["least"]), *enough]
        )
    head = ("test", "kind", "p below", "observed effect", "lower end", "subjects", "subjects for the lower end")
    caption = (
        f"Smallest number of subjects with a power of {a.power:g}. Observed here: {a.who}. t-tests by the noncentral t "
        "distribution, at the p that Holm's correction asks of the first; F by the noncentral F distribution with the "
        "epsilon of Greenhouse and Geisser. Assumed: normal differences, and an effect as large as the one observed, or as the "
        f"lower end of its {100 * a.confidence:g} % interval; plan with that"
    )
    blocks: list[Block] = [Table(rows, head, frozenset({2, 3, 4, 5, 6}), caption=labelled(a, caption), wide=True)]
    if "power_curve" in a.tables:
        about = (
            f"Lines: noncentral F. Circles: of 2000 random subsets of the {a.who}, drawn without replacement, the fraction in "
            f"which the effect has p < {a.limit:g}; near all of them the subsets hardly differ."
        )
        blocks.append(captioned(a, drawing.power_figure(a), "power", about))
    return blocks


def _missing(a: Analysis) -> list[Block]:
    o, ends, lost = a.observed, a.table("ends"), a.table("missing")
    causes = [c for c in ends.columns if c in {"still", "time", "aborted", "broken_off", "no_rating", "not_recorded"}]
    used = [c for c in causes if ends[c].sum() > 0]
    rows: list[list[Cell]] = [
        [
            f"{r['scenario']}: {'failed' if r['failed'] else 'healthy'}, {r['law']}",
            str(r["trials"]),
            str(r["with_cpm"]),
            *(str(r[c]) for c in used),
        ]
        for _, r in ends.iterrows()
    ]
    head = ["scenario", "trials", "with a CPM", *(c.replace("_", " ") for c in used)]
    blocks: list[Block] = [
        Table(rows, head, frozenset(range(1, len(head))), caption=labelled(a, f"How the {o.cause.size:,} trials ended"))
    ]
    if len(lost):
        for by, most in (("subject", 30), ("task", 30)):
            count = lost[by].value_counts()
            said = ", ".join(f"{name} ({n})" for name, n in count.head(most).items())
            rest = "" if len(count) <= most else f" and {len(count) - most} more"
            blocks.append(Text(f"Trials without a CPM by {by}: {said}{rest}. Every one is in missing.csv.", quiet=True))
    return blocks


def _method(a: Analysis) -> list[Block]:
    o = a.observed
    blocks: list[Block] = [
        Callout(Markup("<br>").join(f"• {n}" for n in a.notes), title="Read this before using these numbers")
    ]
    count = len(o.normalisers)
    blocks.append(
        Text(
            f"CPM is the sum of {count} measures, each divided by its largest value over all trials compared "
            f"(eq. 11). The measures are "
            "a reconstruction: the table of the paper is lost. F and p of the ANOVA are those of statsmodels; "
            "sphericity corrections "
            "and effect sizes are computed here. Training trials are not analysed."
        )
    )
    table: DataFrame = a.table("normalisers")
    who = [x for x in ("operators", "computer") if x in table]
    rows: list[list[Cell]] = [
        [f"{r['measure']}", *(number(float(r[x])) for x in who), "" if r["unit"] == "1" else str(r["unit"])]
        for _, r in table.iterrows()
    ]
    blocks.append(
        Table(
            rows, ("largest value", *who, "unit"), frozenset(range(1, 1 + len(who))), caption=labelled(a, "Normalisers of CPM")
        )
    )
    files: list[list[Cell]] = [[f"{name}.csv", ABOUT[name]] for name in (*a.tables, "data_dictionary")]
    blocks.append(
        Table(files, ("file", "what is in it"), caption=f"{counted(len(files), 'table')} written next to this report")
    )
    return blocks
