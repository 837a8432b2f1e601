"""Section of the report that compares the laws, with the failed arm and with the healthy arm."""

from __future__ import annotations

import numpy as np

from holdfast.core.formatting import format_decimals, format_number, format_percent
from holdfast.interface.presentation.teleop import figures as drawing
from holdfast.interface.presentation.teleop.captions import caption_figure, format_p_value, label_table
from holdfast.interface.report.page import Block, Cell, Table, Text
from holdfast.teleop.analysis.mixed_model import MixedModel
from holdfast.teleop.analysis.observations import MEASURE_NAMES
from holdfast.teleop.analysis.result import Analysis
from holdfast.teleop.analysis.variance import Anova


def build_law_blocks(analysis: Analysis) -> list[Block]:
    """Build the comparison of the laws with the failed arm: means, tests, and every measure."""
    blocks: list[Block] = []
    count = (
        f"{analysis.subject_phrase}, tasks grouped by the "
        f"{'computer' if analysis.groups.by == 'computer' else 'median operator'}'s CPM"
    )
    caption = f"Mean CPM of each subject (dots), over subjects (large) with {100 * analysis.confidence:g} % intervals; {count}."
    blocks.append(caption_figure(analysis, drawing.draw_cell_means(analysis), "cells", caption))
    means = analysis.table("means")
    rows: list[list[Cell]] = []
    for law in analysis.cells.laws:
        law_rows = means[means["law"] == law]
        cells: list[Cell] = [f"{format_number(r['mean'])} ± {format_number(r['sd'])}" for _, r in law_rows.iterrows()]
        rows.append([law, *cells, format_number(analysis.law_means()[law])])
    rows.append(["all laws", *(format_number(mean) for mean in analysis.group_means().values()), ""])
    header: list[Cell] = ["law", *analysis.cells.groups, "all tasks"]
    blocks.append(
        Table(
            rows,
            header,
            frozenset(range(1, len(header))),
            caption=label_table(analysis, "Mean CPM ± standard deviation over subjects"),
        )
    )
    if analysis.anova is not None:
        blocks.append(_tabulate_anova(analysis, analysis.anova))
    if analysis.mixed is not None:
        blocks += _tabulate_mixed_model(analysis, analysis.mixed)
    blocks.append(_tabulate_comparisons(analysis))
    if "anova_other_groups" in analysis.tables:
        grouping = "computer's" if analysis.groups.by == "operators" else "median operator's"
        effect_texts = "; ".join(
            f"{r['effect']} F({r['df']}, {r['df_error']}) = {format_number(r['F'])}"
            for _, r in analysis.table("anova_other_groups").iterrows()
        )
        blocks.append(Text(f"With the tasks grouped by the {grouping} CPM instead: {effect_texts}.", quiet=True))
    blocks.append(_tabulate_measures(analysis, "failed", "The laws with the failed arm, measure by measure"))
    return blocks


def _tabulate_anova(analysis: Analysis, anova: Anova) -> Table:
    rows: list[list[Cell]] = [
        [
            effect.name,
            f"{effect.df}, {effect.df_error}",
            format_number(effect.F),
            format_p_value(effect.p),
            format_decimals(effect.gg, 3),
            format_p_value(effect.p_gg),
            format_decimals(effect.hf, 3),
            format_p_value(effect.p_hf),
            format_decimals(effect.partial_eta2, 3),
            format_decimals(effect.generalised_eta2, 3),
        ]
        for effect in anova.effects
    ]
    header = ("effect", "df", "F", "p", "ε GG", "p GG", "ε HF", "p HF", "partial η²", "generalised η²")
    caption = (
        "Within-subjects ANOVA of CPM; GG and HF: corrected for departures from sphericity after Greenhouse and Geisser, and "
        "Huynh and Feldt"
    )
    return Table(rows, header, frozenset(range(1, 10)), caption=label_table(analysis, caption), wide=True)


def _tabulate_mixed_model(analysis: Analysis, mixed_model: MixedModel) -> list[Block]:
    rows: list[list[Cell]] = [
        [test.name, str(test.df), format_number(test.chi2), format_p_value(test.p)] for test in mixed_model.tests
    ]
    variances = mixed_model.variances
    deviations = ", ".join(f"{name} {format_number(float(np.sqrt(variance)))}" for name, variance in variances.items())
    text = (
        f"Linear mixed model of {mixed_model.trials:,} single trials, restricted maximum likelihood ({mixed_model.optimiser}, "
        f"{'converged' if mixed_model.converged else 'NOT converged'}); standard deviations of the random intercepts: "
        f"{deviations}. The tests "
        "are asymptotic. Tasks are random here: the model speaks of other tasks too, so difficulty is tested "
        "more strictly than "
        "in an ANOVA."
    )
    if mixed_model.messages:
        text += f" The software said: {'; '.join(mixed_model.messages)}."
    return [
        Table(
            rows, ("effect", "df", "χ²", "p"), frozenset({1, 2, 3}), caption=label_table(analysis, "Mixed model: Wald tests")
        ),
        Text(text, quiet=True),
    ]


def _tabulate_comparisons(analysis: Analysis) -> Table:
    rows: list[list[Cell]] = [
        [
            str(record["difficulty"]),
            f"{record['first']} − {record['second']}",
            f"{format_number(record['difference'])} ({format_number(record['low'])} to {format_number(record['high'])})",
            f"{format_number(record['t'])} ({record['df']})",
            format_p_value(record["p_holm"]),
            f"{format_decimals(record['dz'], 2)} ({format_decimals(record['dz_low'], 2)} to "
            f"{format_decimals(record['dz_high'], 2)})",
            format_p_value(record["wilcoxon"]),
            format_decimals(record["rank_biserial"], 2),
        ]
        for _, record in analysis.table("comparisons").iterrows()
    ]
    header = ("tasks", "difference", "mean", "t (df)", "p Holm", "dz", "p Wilcoxon", "rank-biserial")
    caption = (
        f"Paired comparisons of CPM, two-sided, with {100 * analysis.confidence:g} % intervals; above 0 the second "
        f"law is better"
    )
    return Table(rows, header, frozenset(range(2, 8)), caption=label_table(analysis, caption), wide=True)


def _tabulate_measures(analysis: Analysis, name: str, title: str) -> Table:
    table = analysis.table(name)
    rows: list[list[Cell]] = []
    for _, record in table.iterrows():
        label, factor = (
            ("CPM", 1.0) if record["measure"] == "CPM" else drawing.label_measure(MEASURE_NAMES.index(record["measure"]))
        )
        first, second, mean, lower, upper = (
            format_number(factor * record[column]) for column in ("first_mean", "second_mean", "difference", "low", "high")
        )
        dz = format_decimals(record["dz"], 2) if np.isfinite(record["dz"]) else "–"
        laws: list[Cell] = [f"{record['first']} − {record['second']}"] if len(analysis.conditions) > 2 else []
        rows.append(
            [
                label,
                *laws,
                first,
                second,
                f"{mean} ({lower} to {upper})",
                format_p_value(record["p_holm"]),
                dz,
                format_p_value(record["wilcoxon"]),
            ]
        )
    first, second = (str(table[column].iloc[0]) if len(analysis.conditions) == 2 else column for column in ("first", "second"))
    header = [
        "measure",
        *(["laws"] if len(analysis.conditions) > 2 else []),
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
    return Table(
        rows, header, frozenset(range(len(header) - 6, len(header))), caption=label_table(analysis, caption), wide=True
    )


def build_healthy_blocks(analysis: Analysis) -> list[Block]:
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
                    f"With the healthy arm, tasks take {format_percent(abs(change))} {comparison} under "
                    f"{record['second']} than "
                    f"under {record['first']} "
                    f"({format_number(record['second_mean'])} against {format_number(record['first_mean'])} cycles)."
                )
            )
    return [*blocks, _tabulate_measures(analysis, "healthy", "The laws with the healthy arm")]
