"""A comparison of assessments in numbers and words."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.present.assessment.console import Thresholds, numbers
from holdfast.present.printing import Rows, number, plain

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.assessment.comparison import Comparison


def to_dict(comparison: Comparison, thresholds: Thresholds = None, report: Path | None = None) -> dict[str, Any]:
    """Every candidate as an assessment alone, and the table."""
    optimised = all(a.optimised is not None for a in comparison.assessments)
    each = zip(comparison.names, comparison.tools, comparison.assessments, strict=True)
    wanted = thresholds or [comparison.threshold]
    found: dict[str, Any] = plain(
        {
            "candidates": [{"name": n, "tool": t, **numbers(a, wanted)} for n, t, a in each],
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
    return found


def key_table(comparison: Comparison) -> Rows:
    """A row for each candidate: the probability, the median and the worst joint."""
    sign = "at least" if comparison.assessments[0].index.better == "larger" else "at most"
    rows = [
        [
            r["name"],
            _cell(r["reached"]),
            f"{_cell(r['probability'])} ({_cell(r['probability_low'])} to {_cell(r['probability_high'])})",
            "none" if r["median"] is None else number(r["median"], 3),
            r["worst_joint"] or "none",
        ]
        for r in comparison.table
    ]
    return Rows(["candidate", "reached", f"P({sign} {comparison.threshold:g}), 95 %", "median", "worst joint"], rows)


def next_steps(comparison: Comparison, name: str) -> list[str]:
    """What to protect in the best of them, and the whole report."""
    best = comparison.best()
    steps = [f"{name}.upgrades({best!r})[0]  # what to protect first"] if comparison.assessment(best).kept else []
    return [*steps, f'{name}.report("comparison.html")']


def show(comparison: Comparison, out: Console, thresholds: Thresholds = None, report: Path | None = None) -> None:
    """What differs, the table, and which joint deserves most."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    del thresholds, report
    first = comparison.assessments[0]
    out.print(f"{escape(first.region.name)}: {escape(first.region.describe())}", soft_wrap=True)
    out.print(f"{first.distribution.samples} poses of each candidate; worst-case {escape(first.index.name)}", soft_wrap=True)
    for note in comparison.notes:
        out.print(f"[yellow]{escape(note)}[/]", soft_wrap=True)
    rows = comparison.table
    optimised = any(r["optimised_probability"] is not None for r in rows)
    survival = any(r["expected_survival"] is not None for r in rows)
    sign = "at least" if first.index.better == "larger" else "at most"
    samples = ("", "optimised_")[: 1 + optimised]
    titles = ["candidate", "task", "reached", f"{sign} {comparison.threshold:g}", "95 % interval"]
    titles += ["optimised", "95 % interval"] * optimised + ["median", *["optimised"] * optimised]
    numbers = Grid(*titles, *["left after a lock"] * survival)
    titles = ["candidate", "worst failure", *["optimised"] * optimised, "single point of failure", "protect first", "gain"]
    joints = Grid(*titles)
    for r in rows:
        cells = [escape(r["name"]), escape(r["task"]), _cell(r["reached"])]
        for b in samples:
            low, high = _cell(r[f"{b}probability_low"]), _cell(r[f"{b}probability_high"])
            cells += [_cell(r[f"{b}probability"]), f"{low} to {high}"]
        cells += ["none" if r[f"{b}median"] is None else number(r[f"{b}median"], 3) for b in samples]
        numbers.add_row(*cells, *[_cell(r["expected_survival"])] * survival)
        worst = [
            "none" if not r[f"{b}worst_joint"] else f"{r[f'{b}worst_joint']} ({r[f'{b}worst_fraction']:.0%})" for b in samples
        ]
        names = [*worst, ", ".join(r["single_points_of_failure"]) or "none", r["upgrade"] or "none"]
        gain = "" if r["upgrade"] is None else f"{r['upgrade_gain']:+.3f}"
        joints.add_row(escape(r["name"]), *map(escape, names), gain)
    out.print(numbers)
    out.print(joints)
    out.print("protect first: the joint that gains most if it never fails, by a redundant motor or brake", soft_wrap=True)


def _cell(x: float | None) -> str:
    return "none" if x is None else f"{x:.3f}"
