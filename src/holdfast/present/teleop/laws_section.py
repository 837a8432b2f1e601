"""The laws against each other: with the failed arm, and with the healthy one."""

from __future__ import annotations

import numpy as np

from holdfast.present.teleop import figures as drawing
from holdfast.present.teleop.captions import captioned, labelled, p_value
from holdfast.report.page import Block, Cell, Table, Text
from holdfast.teleop.analysis.mixed_model import Mixed
from holdfast.teleop.analysis.observations import NAMES
from holdfast.teleop.analysis.result import Analysis
from holdfast.teleop.analysis.variance import Anova
from holdfast.words import fixed, number, percent


def laws(a: Analysis) -> list[Block]:
    """The laws with the failed arm: means, tests and every measure."""
    blocks: list[Block] = []
    count = f"{a.who}, tasks grouped by the {'computer' if a.groups.by == 'computer' else 'median operator'}'s CPM"
    caption = f"Mean CPM of each subject (dots), over subjects (large) with {100 * a.confidence:g} % intervals; {count}."
    blocks.append(captioned(a, drawing.cells_figure(a), "cells", caption))
    means = a.table("means")
    rows: list[list[Cell]] = []
    for law in a.cells.laws:
        mine = means[means["law"] == law]
        cells: list[Cell] = [f"{number(r['mean'])} ± {number(r['sd'])}" for _, r in mine.iterrows()]
        rows.append([law, *cells, number(a.law_means()[law])])
    rows.append(["all laws", *(number(v) for v in a.group_means().values()), ""])
    head: list[Cell] = ["law", *a.cells.groups, "all tasks"]
    blocks.append(
        Table(rows, head, frozenset(range(1, len(head))), caption=labelled(a, "Mean CPM ± standard deviation over subjects"))
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
    return Table(rows, head, frozenset(range(1, 10)), caption=labelled(a, caption), wide=True)


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
        Table(rows, ("effect", "df", "χ²", "p"), frozenset({1, 2, 3}), caption=labelled(a, "Mixed model: Wald tests")),
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
    return Table(rows, head, frozenset(range(2, 8)), caption=labelled(a, caption), wide=True)


def _measures(a: Analysis, name: str, title: str) -> Table:
    table = a.table(name)
    rows: list[list[Cell]] = []
    for _, r in table.iterrows():
        label, factor = ("CPM", 1.0) if r["measure"] == "CPM" else drawing.shown(NAMES.index(r["measure"]))
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
    return Table(rows, head, frozenset(range(len(head) - 6, len(head))), caption=labelled(a, caption), wide=True)


def healthy(a: Analysis) -> list[Block]:
    """The laws with the healthy arm."""
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
