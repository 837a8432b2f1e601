"""Table, JSON document, and page of the planner benchmark."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
from benchmarks.planners.suite import FailActive, Score
from matplotlib.figure import Figure

from holdfast.core.formatting import format_count, format_interval, format_percent
from holdfast.core.probability import Interval
from holdfast.interface.report import Page, Picture, Section, Stack, Table, Text, stack_figure, svg, write

DEFT_PAPER = "arXiv 2602.02895"
_OUTCOME_LABELS = ("solved", "proved infeasible", "argued infeasible", "undecided", "refused by the judge")
_HEAD = (
    *("task", "planner", "cases", "solved", "proved infeasible", "so within tolerance", "argued infeasible", "undecided"),
    *("refused", "solved of those not proved infeasible", "decided", "median, s of processor", "95 %, s of processor"),
)
_NUMBER_COLUMNS = frozenset(range(2, len(_HEAD)))


def to_dict(suite: FailActive) -> dict[str, Any]:
    """Return every score, with intervals and times."""
    return {"folder": str(suite.study.path), "seed": suite.study.seed, "complete": suite.complete, "scores": score_rows(suite)}


def score_rows(suite: FailActive) -> list[dict[str, Any]]:
    """Return one row for each task and planner."""
    return [
        {
            "task": score.task,
            "in_cell": score.in_cell,
            "planner": score.method,
            "cases": score.cases,
            **{
                name: getattr(score, name)
                for name in ("solved", "refused", "proved", "within", "argued", "undecided", "contradictions")
            },
            **_interval_entries("success", score.success),
            "feasible": score.feasible,
            **_interval_entries("success_of_feasible", score.success_of_feasible),
            **_interval_entries("decided", score.decided_fraction),
            "seconds_median": float(np.median(score.seconds)),
            "seconds_95": float(np.quantile(score.seconds, 0.95)),
            "processor_median": float(np.median(score.processor)),
            "processor_95": float(np.quantile(score.processor, 0.95)),
        }
        for score in suite.scores
    ]


def _interval_entries(name: str, probability: Interval | None) -> dict[str, float | None]:
    values = (None, None, None) if probability is None else (probability.value, probability.low, probability.high)
    return dict(zip((name, f"{name}_low", f"{name}_high"), values, strict=True))


def name_task(score: Score) -> str:
    """Return the task of a score, and whether it is in the cell."""
    return f"{score.task}, in the cell" if score.in_cell else score.task


def table_rows(suite: FailActive) -> list[list[str]]:
    """Return the cells of one row for each task and planner."""
    return [
        [
            name_task(score),
            score.method,
            *map(str, (score.cases, score.solved, score.proved, score.within, score.argued, score.undecided, score.refused)),
            "–" if score.success_of_feasible is None else format_interval(score.success_of_feasible),
            format_interval(score.decided_fraction),
            f"{np.median(score.processor):.2g}",
            f"{np.quantile(score.processor, 0.95):.2g}",
        ]
        for score in suite.scores
    ]


def format_text(suite: FailActive) -> str:
    """Return the sentences and the table, in Markdown."""
    lines: Sequence[Sequence[str]] = [_HEAD, ["---"] * len(_HEAD), *table_rows(suite)]
    return "\n".join([*suite.describe(), "", *(f"| {' | '.join(cells)} |" for cells in lines)])


def draw_outcomes(suite: FailActive) -> Figure:
    """Draw the outcomes of the cases of each task under each planner."""
    stacks = []
    for name, group in groupby(suite.scores, name_task):
        scores = list(group)
        counts = np.array(
            [[score.solved, score.proved, score.argued, score.undecided, score.refused] for score in scores], dtype=np.float64
        )
        success_rates = [score.success for score in scores]
        stacks.append(
            Stack(
                name=name,
                bars=[score.method for score in scores],
                shares=counts / counts.sum(axis=1, keepdims=True),
                low=np.array([rate.low for rate in success_rates]),
                high=np.array([rate.high for rate in success_rates]),
            )
        )
    return stack_figure(stacks, _OUTCOME_LABELS, "fraction of the cases of the task")


def write_page(suite: FailActive, file: Path, command: str) -> Path:
    """Write the page: the score of ``recover``, the outcomes, and the method."""
    recover_scores = [score for score in suite.scores if score.method == "recover"]
    solved, cases, feasible = (
        sum(getattr(score, name) for score in recover_scores) for name in ("solved", "cases", "feasible")
    )
    answer = "Nothing was computed yet."
    if cases:
        answer = (
            f"recover finishes {solved} of {cases} cases, and {format_percent(solved / feasible) if feasible else 'none'} of "
            f"the {feasible} that are not proved infeasible."
        )
    attempts = format_count(sum(score.cases for score in suite.scores), "attempt")
    contradictions = sum(score.contradictions for score in suite.scores)
    remarks = (
        f"Failures, tasks, and tolerances are rebuilt from the public part of DEFT ({DEFT_PAPER}). Its own cases were not "
        "available, so its success rates and these cannot be compared one to one.",
        "A motion counts only if it meets the rows within 1 mm and 0.5 deg along its whole length, keeps limits and locks, and "
        "is collision-free by the exact sign, checked every 2 mrad by code that shares only the arm and the cell with the "
        "planner.",
        "A proof holds for the exact poses; a column counts the proofs that also hold within these tolerances.",
        f"Cases solved although they were proved infeasible within the tolerances: {contradictions or 'none'}.",
    )
    caption = "By task and planner; the line is the exact 95 % interval of the fraction that is solved."
    picture = [Picture(svg(draw_outcomes(suite), "outcomes", "Outcomes of the cases"), caption)] if suite.scores else []
    page = Page(
        "Fail-active suite",
        answer,
        [
            Section("", [Text(remark) for remark in remarks]),
            Section("Outcomes of the cases", picture),
            Section("In numbers", [Table(table_rows(suite), _HEAD, _NUMBER_COLUMNS, wide=True)]),
        ],
        subtitle=suite.describe()[0],
        facts=[
            (format_percent(success.value), f"{name_task(score)}, not proved infeasible")
            for score in recover_scores[:4]
            if (success := score.success_of_feasible) is not None and success.value
        ],
        method=[
            Text(f"{attempts}, seed {suite.study.seed}; the cases are in cases.jsonl."),
            Text("Times are processor times on one thread."),
        ],
        again=command,
    )
    return write(page, file)


def save(suite: FailActive, command: str) -> list[Path]:
    """Write ``scores.csv`` and ``report.html`` into the folder of the suite."""
    file, rows = suite.study.path / "scores.csv", score_rows(suite)
    with file.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, list(rows[0]) if rows else [])
        writer.writeheader()
        writer.writerows(rows)
    return [file, write_page(suite, suite.study.path / "report.html", command)]


def format_json(suite: FailActive) -> str:
    """Return every score as one JSON document."""
    return json.dumps(to_dict(suite), indent=2, allow_nan=False)
