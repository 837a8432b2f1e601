"""Figures and CSV table of benchmark suites."""

from __future__ import annotations

from itertools import groupby
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from holdfast.core.files.csv_table import write_rows
from holdfast.core.files.output import make_folder
from holdfast.interface.presentation.planner_benchmark.console import name_task, score_rows
from holdfast.interface.report.outcomes import Stack, stack_figure
from holdfast.studies.planner_benchmark.suite import FailActive

_OUTCOME_LABELS = ("solved", "proved infeasible", "argued infeasible", "undecided", "refused by the judge")


def figures(suite: FailActive) -> dict[str, Figure]:
    """Draw ``endings``: the outcomes of the cases of each task under each planner."""
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
    return {"endings": stack_figure(stacks, _OUTCOME_LABELS, "fraction of the cases of the task")} if stacks else {}


def save(suite: FailActive, folder: Path, command: str = "") -> list[Path]:
    """Write ``scores.csv`` and the report page."""
    file, table = make_folder(folder) / "scores.csv", score_rows(suite)
    write_rows(file, table[0] if table else [], (row.values() for row in table))
    return [file, suite.report(folder / "report.html", command=command)]
