"""Text, tables, and JSON of a benchmark suite."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.core.formatting import format_count, format_interval, format_percent
from holdfast.core.probability.intervals import Interval
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_significant
from holdfast.studies.planner_benchmark.suite import FailActive, Score

DEFT_PAPER = "arXiv 2602.02895"
_COUNT_FIELDS = ("solved", "refused", "proved", "within", "argued", "undecided", "contradictions")


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


def _format_feasible_success(score: Score) -> str:
    return "–" if score.success_of_feasible is None else format_interval(score.success_of_feasible)


def key_table(suite: FailActive) -> TextTable:
    """Tabulate the number of cases that each planner finishes."""
    return TextTable(
        ["task", "planner", "solved", "of those not proved infeasible"],
        [
            [name_task(score), score.method, f"{score.solved} of {score.cases}", _format_feasible_success(score)]
            for score in suite.scores
        ],
    )


def name_task(score: Score) -> str:
    """Return the task of a score, and whether it is in the cell."""
    return f"{score.task}, in the cell" if score.in_cell else score.task


def tables(suite: FailActive) -> list[TextTable]:
    """Tabulate the scores with a row for each task and planner."""
    header = [
        "task",
        "planner",
        "cases",
        "solved",
        "proved infeasible",
        "so within tolerance",
        "argued infeasible",
        "undecided",
    ]
    header += ["refused", "solved of those not proved infeasible", "decided", "median, s of processor", "95 %, s of processor"]
    table_rows = [
        [
            name_task(score),
            score.method,
            *map(str, (score.cases, score.solved, score.proved, score.within, score.argued, score.undecided, score.refused)),
            _format_feasible_success(score),
            format_interval(score.decided_fraction),
            format_significant(float(np.median(score.processor)), 2),
            format_significant(float(np.quantile(score.processor, 0.95)), 2),
        ]
        for score in suite.scores
    ]
    return [TextTable(header, table_rows)]


def next_steps(suite: FailActive, name: str) -> list[str]:
    """Suggest the page, and a check of the results folder."""
    del suite
    return [f'{name}.report("report.html")', f"{name}.study.verify()  # an empty list: everything that was computed is sound"]


def story(suite: FailActive) -> PageContent:
    """Compose the report: the headline score, the facts, and the method."""
    recover_scores = [score for score in suite.scores if score.method == "recover"]
    solved, cases = (sum(getattr(score, name) for score in recover_scores) for name in ("solved", "cases"))
    feasible = sum(score.feasible for score in recover_scores)
    answer = "Nothing was computed yet."
    if cases:
        answer = (
            f"recover finishes {solved} of {cases} cases, and "
            f"{format_percent(solved / feasible) if feasible else 'none'} of the "
            f"{feasible} that are not proved infeasible."
        )
    contradictions = sum(score.contradictions for score in suite.scores)
    lines = [
        f"Failures, tasks and tolerances are rebuilt from what is public of DEFT ({DEFT_PAPER}); its own cases could not "
        f"be read, so "
        "that its shares and these are not comparable one to one.",
        "A motion counts only if it meets the rows within 1 mm and 0.5 deg on its whole way, keeps limits and locks, and is "
        "clear by the exact sign, looked at every 2 mrad by code that shares only the arm and the cell with the planner.",
        "Proofs are about the exact poses; how many hold for all that is within these tolerances too is beside them.",
        f"Cases solved although they were proved infeasible within them: {contradictions or 'none'}.",
    ]
    facts = [
        (format_percent(success.value), f"{name_task(score)}, not proved infeasible")
        for score in recover_scores[:4]
        if (success := score.success_of_feasible) is not None and success.value
    ]
    figure = ("How the cases ended", "By task and planner; the line is the exact 95 % interval of the share that is solved.")
    method = [
        (
            "Cases",
            f"{format_count(sum(score.cases for score in suite.scores), 'attempt')}, seed {suite.study.seed}; in cases.jsonl",
        ),
        ("Times", "of the processor, measured, on one thread"),
    ]
    return PageContent(
        "Fail-active suite",
        answer,
        about=suite.describe()[0],
        facts=facts,
        lines=lines,
        figures={"endings": figure},
        method=method,
    )
