"""Tables of the means and the statistical tests of an experiment, for the console and the page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from holdfast.core.formatting import format_decimals, format_number
from holdfast.interface.presentation.presentation import TableSpec, make_headers
from holdfast.teleop.analysis.result import Analysis
from holdfast.teleop.analysis.variance import Anova

_SMALLEST_PRINTED_P = 1e-4


def format_p_value(probability: float) -> str:
    """Format a p value."""
    if np.isnan(probability):
        return "–"
    return "< 0.0001" if probability < _SMALLEST_PRINTED_P else format_decimals(probability, 4)


def format_p_relation(probability: float) -> str:
    """Format a p value with a leading "=" or "<"."""
    return format_p_value(probability) if probability < _SMALLEST_PRINTED_P else f"= {format_p_value(probability)}"


def make_table(analysis: Analysis, title: str, head: Sequence[str], rows: Sequence[Sequence[Any]]) -> TableSpec:
    """Make a table, whose title marks simulated operators; a section of the page contains it."""
    title = f"{title} (simulated operators)" if analysis.is_simulated else title
    return TableSpec(title, make_headers(*head, aligned=False), rows, on_page=False)


def build_tables(analysis: Analysis) -> list[TableSpec]:
    """Build the tables of the means and of the statistical tests."""
    tables = [_tabulate_means(analysis)]
    if analysis.anova is not None:
        tables.append(_tabulate_anova(analysis, analysis.anova))
    if analysis.mixed is not None:
        rows = [[test.name, test.df, test.chi2, format_p_value(test.p)] for test in analysis.mixed.tests]
        tables.append(make_table(analysis, "Mixed model: Wald tests", ("effect", "df", "χ²", "p"), rows))
    return [*tables, _tabulate_comparisons(analysis)]


def _tabulate_means(analysis: Analysis) -> TableSpec:
    means = analysis.table("means")
    rows: list[list[Any]] = []
    for law in analysis.cells.laws:
        law_rows = means[means["law"] == law]
        cells = [f"{format_number(r['mean'])} ± {format_number(r['sd'])}" for _, r in law_rows.iterrows()]
        rows.append([law, *cells, analysis.law_means()[law]])
    rows.append(["all laws", *analysis.group_means().values(), ""])
    head = ["law", *analysis.cells.groups, "all tasks"]
    return make_table(analysis, "Mean CPM with the failed arm ± standard deviation over subjects", head, rows)


def _tabulate_anova(analysis: Analysis, anova: Anova) -> TableSpec:
    rows = [
        [
            *(effect.name, f"{effect.df}, {effect.df_error}", effect.F, format_p_value(effect.p), effect.gg),
            *(format_p_value(effect.p_gg), effect.hf, format_p_value(effect.p_hf)),
            *(effect.partial_eta2, effect.generalised_eta2),
        ]
        for effect in anova.effects
    ]
    head = ("effect", "df", "F", "p", "ε GG", "p GG", "ε HF", "p HF", "partial η²", "generalised η²")
    title = (
        "Within-subjects ANOVA of CPM; GG and HF: corrected for departures from sphericity after Greenhouse and Geisser, and "
        "Huynh and Feldt"
    )
    return make_table(analysis, title, head, rows)


def _tabulate_comparisons(analysis: Analysis) -> TableSpec:
    rows = [
        [
            str(record["difficulty"]),
            f"{record['first']} − {record['second']}",
            format_range(record, "difference", "low", "high"),
            f"{format_number(record['t'])} ({record['df']})",
            format_p_value(record["p_holm"]),
            format_range(record, "dz", "dz_low", "dz_high", partial(format_decimals, digits=2)),
            format_p_value(record["wilcoxon"]),
            format_decimals(record["rank_biserial"], 2),
        ]
        for _, record in analysis.table("comparisons").iterrows()
    ]
    head = ("tasks", "difference", "mean", "t (df)", "p Holm", "dz", "p Wilcoxon", "rank-biserial")
    intervals = f"{100 * analysis.confidence:g} % intervals"
    title = f"Paired comparisons of CPM, two-sided, with {intervals}; above 0 the second law is better"
    return make_table(analysis, title, head, rows)


def format_range(
    record: Any, value: str, low: str, high: str, format_value: Callable[[float], str] = format_number, factor: float = 1.0
) -> str:
    """Format a value of a record with its interval."""
    texts = [format_value(factor * record[name]) for name in (value, low, high)]
    return f"{texts[0]} ({texts[1]} to {texts[2]})"
