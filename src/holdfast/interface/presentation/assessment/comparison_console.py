"""Numbers and console text of a comparison of assessments."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.interface.presentation.assessment.console import Thresholds, collect_numbers
from holdfast.interface.presentation.printing import TextTable, format_significant, to_json_types

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.studies.assessment.comparison import Comparison


def to_dict(comparison: Comparison, thresholds: Thresholds = None, report: Path | None = None) -> dict[str, Any]:
    """Return every candidate as an assessment of its own, and the comparison table, as JSON data."""
    optimised = all(assessment.optimised is not None for assessment in comparison.assessments)
    candidates = zip(comparison.names, comparison.tools, comparison.assessments, strict=True)
    threshold_values = thresholds or [comparison.threshold]
    data: dict[str, Any] = to_json_types(
        {
            "candidates": [
                {"name": name, "tool": tool, **collect_numbers(assessment, threshold_values)}
                for name, tool, assessment in candidates
            ],
            "comparison": {
                "threshold": comparison.threshold,
                "table": comparison.table,
                "ranking": comparison.ranking(),
                "optimised_ranking": comparison.ranking(optimised=True) if optimised else None,
                "notes": comparison.notes,
                "report": None if report is None else str(report),
            },
        }
    )
    return data


def key_table(comparison: Comparison) -> TextTable:
    """Return a row for each candidate: the probability, the median and the worst joint."""
    relation = "at least" if comparison.assessments[0].index.better == "larger" else "at most"
    table_rows = [
        [
            r["name"],
            _as_decimal(r["reached"]),
            f"{_as_decimal(r['probability'])} ({_as_decimal(r['probability_low'])} to {_as_decimal(r['probability_high'])})",
            "none" if r["median"] is None else format_significant(r["median"], 3),
            r["worst_joint"] or "none",
        ]
        for r in comparison.table
    ]
    return TextTable(
        ["candidate", "reached", f"P({relation} {comparison.threshold:g}), 95 %", "median", "worst joint"], table_rows
    )


def show(comparison: Comparison, out: Console, thresholds: Thresholds = None, report: Path | None = None) -> None:
    """Print the differences between the candidates, the table, and the joint of each whose protection gains most."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    del thresholds, report
    first = comparison.assessments[0]
    out.print(f"{escape(first.region.name)}: {escape(first.region.describe())}", soft_wrap=True)
    out.print(f"{first.distribution.samples} poses of each candidate; worst-case {escape(first.index.name)}", soft_wrap=True)
    for remark in comparison.notes:
        out.print(f"[yellow]{escape(remark)}[/]", soft_wrap=True)
    table = comparison.table
    optimised = any(row["optimised_probability"] is not None for row in table)
    survival = any(row["expected_survival"] is not None for row in table)
    relation = "at least" if first.index.better == "larger" else "at most"
    key_prefixes = ("", "optimised_")[: 1 + optimised]
    titles = ["candidate", "task", "reached", f"{relation} {comparison.threshold:g}", "95 % interval"]
    titles += ["optimised", "95 % interval"] * optimised + ["median", *["optimised"] * optimised]
    number_table = BandedTable(*titles, *["left after a lock"] * survival)
    titles = ["candidate", "worst failure", *["optimised"] * optimised, "single point of failure", "protect first", "gain"]
    joint_table = BandedTable(*titles)
    for row in table:
        cells = [escape(row["name"]), escape(row["task"]), _as_decimal(row["reached"])]
        for key_prefix in key_prefixes:
            lower, upper = _as_decimal(row[f"{key_prefix}probability_low"]), _as_decimal(row[f"{key_prefix}probability_high"])
            cells += [_as_decimal(row[f"{key_prefix}probability"]), f"{lower} to {upper}"]
        cells += [
            "none" if row[f"{key_prefix}median"] is None else format_significant(row[f"{key_prefix}median"], 3)
            for key_prefix in key_prefixes
        ]
        number_table.add_row(*cells, *[_as_decimal(row["expected_survival"])] * survival)
        worst_joints = [
            "none"
            if not row[f"{key_prefix}worst_joint"]
            else f"{row[f'{key_prefix}worst_joint']} ({row[f'{key_prefix}worst_fraction']:.0%})"
            for key_prefix in key_prefixes
        ]
        joint_cells = [*worst_joints, ", ".join(row["single_points_of_failure"]) or "none", row["upgrade"] or "none"]
        gain_text = "" if row["upgrade"] is None else f"{row['upgrade_gain']:+.3f}"
        joint_table.add_row(escape(row["name"]), *map(escape, joint_cells), gain_text)
    out.print(number_table)
    out.print(joint_table)
    out.print("protect first: the joint that gains most if it never fails, by a redundant motor or brake", soft_wrap=True)


def _as_decimal(fraction: float | None) -> str:
    return "none" if fraction is None else f"{fraction:.3f}"
