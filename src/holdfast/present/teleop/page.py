"""The report of an experiment: one HTML file that begins with what the law did to the operators."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from holdfast.errors import InputError
from holdfast.present.teleop import figures
from holdfast.present.teleop.examples import example_blocks
from holdfast.present.teleop.tables import ABOUT, write_tables
from holdfast.report import page
from holdfast.report.figures import svg
from holdfast.report.page import Block, Callout, Cell, Page, Picture, Section, Table, Text
from holdfast.teleop.analysis.mixed_model import Mixed
from holdfast.teleop.analysis.observations import NAMES
from holdfast.teleop.analysis.result import Analysis, Paths
from holdfast.teleop.analysis.variance import Anova
from holdfast.words import counted, fixed, number, percent

if TYPE_CHECKING:
    from pandas import DataFrame

    from holdfast.teleop.protocol.protocol import Protocol

_SMALL = 1e-4


def write(
    analysis: Analysis,
    folder: Path,
    protocol: Protocol | None = None,
    paths: Paths | None = None,
    show: Sequence[int] | None = None,
) -> Path:
    """Write the tables and the report as one HTML file; see :meth:`holdfast.teleop.analysis.Analysis.write`."""
    write_tables(analysis, folder)
    return page.write(build(analysis, protocol, paths, show), folder / "report.html")


def build(
    analysis: Analysis,
    protocol: Protocol | None = None,
    paths: Paths | None = None,
    show: Sequence[int] | None = None,
) -> Page:
    """The report as blocks, before it becomes HTML."""
    a = analysis
    shown = middle_tasks(a) if show is None else list(show)
    for t in shown:
        if t not in a.observed.tasks:
            raise InputError(f"there is no task {t} to show; there are {a.observed.tasks[0]} to {a.observed.tasks[-1]}")
    alerts = []
    if a.simulated:
        alerts.append(Callout("Every operator is a program. Nothing here is about people.", "bad", "Simulated."))
    if a.left_out:
        alerts.append(Callout(f"Left out because of empty cells: {', '.join(a.left_out)}.", "bad", "Not all subjects."))
    if a.mixed is not None and not a.mixed.converged:
        alerts.append(Callout("Its numbers must not be used.", "bad", "The mixed model did not converge."))
    sections = [
        Section("The failed arm under each law", _laws(a)),
        Section("Anticipated, actual and perceived difficulty", _difficulty(a)),
        Section("Task by task: operators and computer", _tasks(a)),
        Section("Distributions of all measures", _distributions(a)),
        *(Section(f"Task {t}", example_blocks(a, t, protocol, paths)) for t in shown),
        Section("The healthy arm: what tolerance costs before a failure", _healthy(a)),
        Section("How many subjects would have sufficed", _power(a)),
        Section("What is missing", _missing(a)),
        Section("How it was computed", _method(a)),
    ]
    name = "" if protocol is None else protocol.name
    return Page(
        f"Teleoperation with a failed joint: {a.who}",
        _headline(a),
        [s for s in sections if s.blocks],
        name,
        alerts,
        "Written by holdfast. This file needs no network and no other file.",
    )


def middle_tasks(a: Analysis) -> list[int]:
    """Of each group the task of middle difficulty."""
    table = a.table("tasks")
    found = []
    for group in a.groups.names:
        mine = table.loc[table["difficulty"] == group, "task"].tolist()
        found.append(int(mine[(len(mine) - 1) // 2]))
    return found


def picture(a: Analysis, figure: Figure, name: str, about: str) -> Picture:
    """A figure with its caption, which says "simulated" where it must."""
    text = f"Simulated operators. {about}" if a.simulated else about
    return Picture(svg(figure, name, text), text)


def p_value(p: float) -> str:
    """As reports write it."""
    return "–" if np.isnan(p) else "< 0.0001" if p < _SMALL else fixed(p, 4)


def _said(a: Analysis, text: str) -> str:
    return f"{text} (simulated operators)" if a.simulated else text


def _headline(a: Analysis) -> str:
    means = sorted(a.law_means().items(), key=lambda x: x[1])
    text = f"With a failed joint the {means[0][0]} law makes {a.who} perform best on average: mean CPM {number(means[0][1])}, "
    text += f"against {' and '.join(f'{number(v)} ({law})' for law, v in means[1:])}"
    if a.anova is not None:
        e = a.anova.effects[0]
        text += f"; F({e.df}, {e.df_error}) = {number(e.F)}, p {_equals(e.p_gg)}"
        if e.p_gg >= a.limit:
            text += ", which may be chance"
    elif a.mixed is not None:
        w = a.mixed.tests[0]
        text += f"; mixed model, chi²({w.df}) = {number(w.chi2)}, p {_equals(w.p)}"
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


def _equals(p: float) -> str:
    return p_value(p) if p < _SMALL else f"= {p_value(p)}"


def _laws(a: Analysis) -> list[Block]:
    blocks: list[Block] = []
    count = f"{a.who}, tasks grouped by the {'computer' if a.groups.by == 'computer' else 'median operator'}'s CPM"
    caption = f"Mean CPM of each subject (dots), over subjects (large) with {100 * a.confidence:g} % intervals; {count}."
    blocks.append(picture(a, figures.cells_figure(a), "cells", caption))
    means = a.table("means")
    rows: list[list[Cell]] = []
    for law in a.cells.laws:
        mine = means[means["law"] == law]
        cells: list[Cell] = [f"{number(r['mean'])} ± {number(r['sd'])}" for _, r in mine.iterrows()]
        rows.append([law, *cells, number(a.law_means()[law])])
    rows.append(["all laws", *(number(v) for v in a.group_means().values()), ""])
    head: list[Cell] = ["law", *a.cells.groups, "all tasks"]
    blocks.append(
        Table(rows, head, frozenset(range(1, len(head))), caption=_said(a, "Mean CPM ± standard deviation over subjects"))
    )
    if a.anova is not None:
        blocks.append(_anova(a, a.anova))
    if a.mixed is not None:
        blocks += _mixed(a, a.mixed)
    blocks.append(_comparisons(a))
    if "anova_other_groups" in a.tables:
        by = "computer's" if a.groups.by == "operators" else "median operator's"
        said = "; ".join(
            f"{r['effect']} F({r['df']}, {r['df_error']}) = {number(r['F'])}"
            for _, r in a.table("anova_other_groups").iterrows()
        )
        blocks.append(Text(f"With the tasks grouped by the {by} CPM instead: {said}.", quiet=True))
    blocks.append(_measures(a, "failed", "The laws with the failed arm, measure by measure"))
    return blocks


def _anova(a: Analysis, found: Anova) -> Table:
    rows: list[list[Cell]] = [
        [
            e.name,
            f"{e.df}, {e.df_error}",
            number(e.F),
            p_value(e.p),
            fixed(e.gg, 3),
            p_value(e.p_gg),
            fixed(e.hf, 3),
            p_value(e.p_hf),
            fixed(e.partial_eta2, 3),
            fixed(e.generalised_eta2, 3),
        ]
        for e in found.effects
    ]
    head = ("effect", "df", "F", "p", "ε GG", "p GG", "ε HF", "p HF", "partial η²", "generalised η²")
    caption = (
        "Within-subjects ANOVA of CPM; GG and HF: corrected for departures from sphericity after Greenhouse and Geisser, and "
        "Huynh and Feldt"
    )
    return Table(rows, head, frozenset(range(1, 10)), caption=_said(a, caption), wide=True)


def _mixed(a: Analysis, found: Mixed) -> list[Block]:
    rows: list[list[Cell]] = [[t.name, str(t.df), number(t.chi2), p_value(t.p)] for t in found.tests]
    v = found.variances
    spread = ", ".join(f"{name} {number(float(np.sqrt(x)))}" for name, x in v.items())
    text = (
        f"Linear mixed model of {found.trials:,} single trials, restricted maximum likelihood ({found.optimiser}, "
        f"{'converged' if found.converged else 'NOT converged'}); standard deviations of the random intercepts: "
        f"{spread}. The tests "
        "are asymptotic. Tasks are random here: the model speaks of other tasks too, so difficulty is tested "
        "more strictly than "
        "in an ANOVA."
    )
    if found.messages:
        text += f" The software said: {'; '.join(found.messages)}."
    return [
        Table(rows, ("effect", "df", "χ²", "p"), frozenset({1, 2, 3}), caption=_said(a, "Mixed model: Wald tests")),
        Text(text, quiet=True),
    ]


def _comparisons(a: Analysis) -> Table:
    rows: list[list[Cell]] = [
        [
            str(r["difficulty"]),
            f"{r['first']} − {r['second']}",
            f"{number(r['difference'])} ({number(r['low'])} to {number(r['high'])})",
            f"{number(r['t'])} ({r['df']})",
            p_value(r["p_holm"]),
            f"{fixed(r['dz'], 2)} ({fixed(r['dz_low'], 2)} to {fixed(r['dz_high'], 2)})",
            p_value(r["wilcoxon"]),
            fixed(r["rank_biserial"], 2),
        ]
        for _, r in a.table("comparisons").iterrows()
    ]
    head = ("tasks", "difference", "mean", "t (df)", "p Holm", "dz", "p Wilcoxon", "rank-biserial")
    caption = f"Paired comparisons of CPM, two-sided, with {100 * a.confidence:g} % intervals; above 0 the second law is better"
    return Table(rows, head, frozenset(range(2, 8)), caption=_said(a, caption), wide=True)


def _measures(a: Analysis, name: str, title: str) -> Table:
    table = a.table(name)
    rows: list[list[Cell]] = []
    for _, r in table.iterrows():
        label, factor = ("CPM", 1.0) if r["measure"] == "CPM" else figures.shown(NAMES.index(r["measure"]))
        first, second, mean, low, high = (
            number(factor * r[x]) for x in ("first_mean", "second_mean", "difference", "low", "high")
        )
        dz = fixed(r["dz"], 2) if np.isfinite(r["dz"]) else "–"
        laws: list[Cell] = [f"{r['first']} − {r['second']}"] if len(a.conditions) > 2 else []
        rows.append(
            [label, *laws, first, second, f"{mean} ({low} to {high})", p_value(r["p_holm"]), dz, p_value(r["wilcoxon"])]
        )
    first, second = (str(table[x].iloc[0]) if len(a.conditions) == 2 else x for x in ("first", "second"))
    head = [
        "measure",
        *(["laws"] if len(a.conditions) > 2 else []),
        first,
        second,
        "first − second",
        "p Holm",
        "dz",
        "p Wilcoxon",
    ]
    caption = (
        f"{title}: subjects' means over the tasks they completed under both, {int(table['trials'].iloc[0]):,} "
        f"pairs of trials; smaller "
        "is better"
    )
    return Table(rows, head, frozenset(range(len(head) - 6, len(head))), caption=_said(a, caption), wide=True)


def _difficulty(a: Analysis) -> list[Block]:
    table = a.table("tasks").sort_values("task")
    scales = {
        "anticipated": "anticipated difficulty: CPM of the computer",
        "actual": "actual difficulty: median CPM of operators",
        "perceived": "perceived difficulty: median rating",
    }
    panels = []
    for c in a.correlations:
        if c.first in scales:
            x, y = (table[name].to_numpy(dtype=np.float64) for name in (c.first, c.second))
            panels.append(figures.Scatter(x, y, scales[c.first], scales[c.second], c, a.groups.of_task))
    blocks: list[Block] = []
    if panels:
        caption = f"Each dot is a task in scenario {a.conditions[0].label}. " + " ".join(
            f"{c}; Spearman {c.spearman:.3f}." for c in a.correlations if c.first in scales
        )
        lost = sorted({x for c in a.correlations for x in c.left_out})
        if lost:
            caption += f" Without a value on one of the axes: {', '.join(lost)}."
        blocks.append(picture(a, figures.scatter_figure(panels, a.groups.names), "difficulty", caption))
    return blocks


def _tasks(a: Analysis) -> list[Block]:
    prefix = "Simulated operators: " if a.simulated else "Operators: "
    titles = (f"{prefix}the median operator of each task", "Computer")
    caption = (
        f"CPM of each task with the failed arm ({len(a.observed.tasks)} tasks). The median operator of a task is "
        f"the one whose CPM under "
        "the reference law is nearest to the median of all. Coloured stems: another law than the reference is better."
    )
    blocks: list[Block] = [picture(a, figures.tasks_figure(a, titles), "tasks", caption)]
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
        blocks.append(Table(rows, head, frozenset(range(2, 7)), caption=_said(a, caption), wide=True))
        for c in a.correlations:
            if c.first.startswith("operators'"):
                blocks.append(Text(f"Correlation over tasks: {c}; Spearman {c.spearman:.3f}.", quiet=True))
    return blocks


def _distributions(a: Analysis) -> list[Block]:
    o, machine = a.observed, a.computer
    every = np.concatenate([o.cpm[..., None], o.measures], axis=-1)[..., : len(NAMES) + o.rated]
    values = [[every[:, :, s, k].ravel() for s in range(len(o.conditions))] for k in range(every.shape[-1])]
    its = None
    if machine is not None:
        table = a.table("measures")
        names = ["CPM", *NAMES[:-1]]
        its = [table.loc[table["measure"] == name, "computer_median"].to_numpy(dtype=np.float64) for name in names]
    figure = figures.measures_figure(values, its, [c.scenario for c in o.conditions])
    key = "; ".join(c.label for c in o.conditions)
    caption = (
        f"CPM and all measures over {o.cpm.size:,} trials in {len(o.tasks)} tasks, less those that did not "
        f"arrive. Scenarios: {key}. "
        "Circles: the computer's median over tasks. CPM of operators and computer have different normalisers unless the notes "
        "say otherwise."
    )
    return [picture(a, figure, "measures", caption)]


def _healthy(a: Analysis) -> list[Block]:
    if "healthy" not in a.tables:
        return []
    table = a.table("healthy")
    blocks: list[Block] = []
    for _, r in table[table["measure"] == "M1"].iterrows():
        change = r["second_mean"] / r["first_mean"] - 1 if r["first_mean"] > 0 else float("nan")
        if np.isfinite(change):
            more = "longer" if change > 0 else "shorter"
            blocks.append(
                Text(
                    f"With the healthy arm, tasks take {percent(abs(change))} {more} under {r['second']} than "
                    f"under {r['first']} "
                    f"({number(r['second_mean'])} against {number(r['first_mean'])} cycles)."
                )
            )
    return [*blocks, _measures(a, "healthy", "The laws with the healthy arm")]


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
    blocks: list[Block] = [Table(rows, head, frozenset({2, 3, 4, 5, 6}), caption=_said(a, caption), wide=True)]
    if "power_curve" in a.tables:
        about = (
            f"Lines: noncentral F. Circles: of 2000 random subsets of the {a.who}, drawn without replacement, the share in "
            f"which the effect has p < {a.limit:g}; near all of them the subsets hardly differ."
        )
        blocks.append(picture(a, figures.power_figure(a), "power", about))
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
        Table(rows, head, frozenset(range(1, len(head))), caption=_said(a, f"How the {o.cause.size:,} trials ended"))
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
    blocks: list[Block] = [Callout(Markup("<br>").join(f"• {n}" for n in a.notes), title="To know before using these numbers")]
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
        Table(rows, ("largest value", *who, "unit"), frozenset(range(1, 1 + len(who))), caption=_said(a, "Normalisers of CPM"))
    )
    files: list[list[Cell]] = [[f"{name}.csv", ABOUT[name]] for name in (*a.tables, "data_dictionary")]
    blocks.append(
        Table(files, ("file", "what is in it"), caption=f"{counted(len(files), 'table')} written next to this report")
    )
    return blocks
