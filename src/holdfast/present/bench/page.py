"""Figures of suites, and their table as CSV."""

from __future__ import annotations

import csv
from itertools import groupby
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from holdfast.bench.suite import FailActive
from holdfast.files.output import made, writing
from holdfast.files.spreadsheet import cell
from holdfast.present.bench.console import place, rows
from holdfast.report.outcomes import Stack, stack_figure

_ENDINGS = ("solved", "proved infeasible", "argued infeasible", "undecided", "refused by the judge")


def figures(found: FailActive) -> dict[str, Figure]:
    """``endings``: how the cases of each task ended under each planner."""
    stacks = []
    for name, group in groupby(found.scores, place):
        scores = list(group)
        counts = np.array([[s.solved, s.proved, s.argued, s.undecided, s.refused] for s in scores], dtype=np.float64)
        ends = [s.success for s in scores]
        stacks.append(
            Stack(
                name=name,
                bars=[s.method for s in scores],
                shares=counts / counts.sum(axis=1, keepdims=True),
                low=np.array([p.low for p in ends]),
                high=np.array([p.high for p in ends]),
            )
        )
    return {"endings": stack_figure(stacks, _ENDINGS, "fraction of the cases of the task")} if stacks else {}


def save(found: FailActive, folder: Path, command: str = "") -> list[Path]:
    """``scores.csv`` and the page."""
    file, table = made(folder) / "scores.csv", rows(found)
    with writing(file) as stream:
        writer = csv.writer(stream)
        writer.writerow(map(cell, table[0] if table else []))
        writer.writerows([cell(v) for v in row.values()] for row in table)
    return [file, found.report(folder / "report.html", command=command)]
