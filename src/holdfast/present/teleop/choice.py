"""Tasks chosen from a bank, in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.present.printing import Rows, number, plain
from holdfast.teleop.bank.selection import TaskChoice
from holdfast.teleop.bank.tasks import TaskBank

if TYPE_CHECKING:
    from rich.console import Console


def to_dict(choice: TaskChoice) -> dict[str, Any]:
    """What was chosen, tasks from 1, and medians over the tasks for each scenario."""
    data = {
        **choice.arm.entry(),
        "tasks": len(choice.bank),
        "cells_occupied": len(choice.cells.occupied),
        "chosen": choice.chosen + 1,
        "most_disorienting": None if choice.disorienting is None else choice.disorienting + 1,
        "trapped": None if choice.trapped is None else choice.trapped + 1,
        "scenarios": _summary(choice.bank),
    }
    made: dict[str, Any] = plain(data)
    return made


def _summary(bank: TaskBank) -> list[dict[str, Any]]:
    lines: list[dict[str, Any]] = []
    for k, s in enumerate(bank.scenarios):
        completed = ~np.isnan(bank.cpm[k])
        middle = np.nanmedian(bank.measures[k], axis=0) if completed.any() else np.full(bank.measures.shape[2], np.nan)
        lines.append(
            {
                "scenario": s.number,
                "label": s.label,
                "not_reached": int((~completed).sum()),
                "time_cycles": middle[0],
                "path_m": middle[1],
                "velocity_error": middle[6],
                "peak_direction_error_rad": middle[9],
                "cpm": np.median(bank.cpm[k][completed]) if completed.any() else np.nan,
            }
        )
    return lines


def key_table(choice: TaskChoice) -> Rows:
    """Medians over the tasks for each scenario."""
    rows = [
        [r["label"], str(r["not_reached"]), number(r["time_cycles"], 3), number(r["cpm"], 3)] for r in _summary(choice.bank)
    ]
    return Rows(["scenario", "not completed", "time, cycles", "CPM"], rows)


def next_steps(choice: TaskChoice, name: str) -> list[str]:
    """Which tasks those are."""
    del choice
    return [f"{name}.chosen + 1  # the tasks, from 1"]


def show(choice: TaskChoice, out: Console) -> None:
    """A row for each scenario, and what was chosen."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    first, *rest = choice.describe()
    out.print(escape(first), soft_wrap=True)
    columns = ("time, cycles", "path, m", "velocity error", "peak direction error, deg", "CPM")
    table = Grid("scenario", "", "not completed", *columns)
    for r in _summary(choice.bank):
        cells = [number(r[k], 3) for k in ("time_cycles", "path_m", "velocity_error")]
        turn = f"{np.degrees(r['peak_direction_error_rad']):.1f}"
        table.add_row(str(r["scenario"]), r["label"], str(r["not_reached"]), *cells, turn, number(r["cpm"], 3))
    out.print(table)
    caption = "medians over the tasks that are completed; the level of CPM is set by the most extreme trial, compare ratios"
    for line in (caption, *rest):
        out.print(line, soft_wrap=True)
