"""What a suite found, in numbers and words."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.bench.suite import FailActive, Score
from holdfast.present.printing import Rows, number
from holdfast.present.story import Story
from holdfast.probability.intervals import Interval
from holdfast.words import counted, interval, percent

DEFT = "arXiv 2602.02895"
_COUNTS = ("solved", "refused", "proved", "within", "argued", "undecided", "contradictions")


def to_dict(found: FailActive) -> dict[str, Any]:
    """Every score, with intervals and times."""
    return {"folder": str(found.study.path), "seed": found.study.seed, "complete": found.complete, "scores": rows(found)}


def rows(found: FailActive) -> list[dict[str, Any]]:
    """One for each task and planner."""
    return [
        {
            "task": s.task,
            "in_cell": s.in_cell,
            "planner": s.method,
            "cases": s.cases,
            **{
                name: getattr(s, name)
                for name in ("solved", "refused", "proved", "within", "argued", "undecided", "contradictions")
            },
            **_ends("success", s.success),
            "feasible": s.feasible,
            **_ends("success_of_feasible", s.success_of_feasible),
            **_ends("decided", s.decided),
            "seconds_median": float(np.median(s.seconds)),
            "seconds_95": float(np.quantile(s.seconds, 0.95)),
            "processor_median": float(np.median(s.processor)),
            "processor_95": float(np.quantile(s.processor, 0.95)),
        }
        for s in found.scores
    ]


def _ends(name: str, p: Interval | None) -> dict[str, float | None]:
    ends = (None, None, None) if p is None else (p.value, p.low, p.high)
    return dict(zip((name, f"{name}_low", f"{name}_high"), ends, strict=True))


def _of_feasible(score: Score) -> str:
    return "–" if score.success_of_feasible is None else interval(score.success_of_feasible)


def key_table(found: FailActive) -> Rows:
    """How much each planner finishes."""
    return Rows(
        ["task", "planner", "solved", "of those not proved infeasible"],
        [[place(s), s.method, f"{s.solved} of {s.cases}", _of_feasible(s)] for s in found.scores],
    )


def place(score: Score) -> str:
    """The task, and where."""
    return f"{score.task}, in the cell" if score.in_cell else score.task


def tables(found: FailActive) -> list[Rows]:
    """A row for each task and planner."""
    head = ["task", "planner", "cases", "solved", "proved infeasible", "so within tolerance", "argued infeasible", "undecided"]
    head += ["refused", "solved of those not proved infeasible", "decided", "median, s of processor", "95 %, s of processor"]
    lines = [
        [
            place(s),
            s.method,
            *map(str, (s.cases, s.solved, s.proved, s.within, s.argued, s.undecided, s.refused)),
            _of_feasible(s),
            interval(s.decided),
            number(float(np.median(s.processor)), 2),
            number(float(np.quantile(s.processor, 0.95)), 2),
        ]
        for s in found.scores
    ]
    return [Rows(head, lines)]


def next_steps(found: FailActive, name: str) -> list[str]:
    """The page, and whether the folder is sound."""
    del found
    return [f'{name}.report("report.html")', f"{name}.study.verify()  # an empty list: everything that was computed is sound"]


def story(found: FailActive) -> Story:
    """What the page says."""
    best = [s for s in found.scores if s.method == "recover"]
    solved, cases = (sum(getattr(s, name) for s in best) for name in ("solved", "cases"))
    feasible = sum(s.feasible for s in best)
    answer = "Nothing was computed yet."
    if cases:
        answer = (
            f"recover finishes {solved} of {cases} cases, and {percent(solved / feasible) if feasible else 'none'} of the "
            f"{feasible} that are not proved infeasible."
        )
    wrong = sum(s.contradictions for s in found.scores)
    lines = [
        f"Failures, tasks and tolerances are rebuilt from what is public of DEFT ({DEFT}); its own cases could not be read, so "
        "that its shares and these are not comparable one to one.",
        "A motion counts only if it meets the rows within 1 mm and 0.5 deg on its whole way, keeps limits and locks, and is "
        "clear by the exact sign, looked at every 2 mrad by code that shares only the arm and the cell with the planner.",
        "Proofs are about the exact poses; how many hold for all that is within these tolerances too is beside them.",
        f"Cases solved although they were proved infeasible within them: {wrong or 'none'}.",
    ]
    facts = [
        (percent(p.value), f"{place(s)}, not proved infeasible")
        for s in best[:4]
        if (p := s.success_of_feasible) is not None and p.value
    ]
    figure = ("How the cases ended", "By task and planner; the line is the exact 95 % interval of the share that is solved.")
    method = [
        (
            "Cases",
            f"{counted(sum(s.cases for s in found.scores), 'attempt')}, seed {found.study.seed}; in cases.jsonl",
        ),
        ("Times", "of the processor, measured, on one thread"),
    ]
    return Story(
        "Fail-active suite",
        answer,
        about=found.describe()[0],
        facts=facts,
        lines=lines,
        figures={"endings": figure},
        method=method,
    )
