"""Text, tables, and JSON of the tasks chosen from a bank."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.interface.presentation.printing import TextTable, format_significant, to_json_types
from holdfast.teleop.bank.selection import TaskChoice
from holdfast.teleop.bank.tasks import TaskBank

if TYPE_CHECKING:
    from rich.console import Console


def to_dict(choice: TaskChoice) -> dict[str, Any]:
    """Return the chosen tasks, numbered from 1, and medians over the tasks for each scenario."""
    data = {
        **choice.arm.entry(),
        "tasks": len(choice.bank),
        "cells_occupied": len(choice.cells.occupied_cells),
        "chosen": choice.chosen + 1,
        "most_disorienting": None if choice.disorienting is None else choice.disorienting + 1,
        "trapped": None if choice.trapped is None else choice.trapped + 1,
        "scenarios": _summarize_scenarios(choice.bank),
    }
    json_data: dict[str, Any] = to_json_types(data)
    return json_data


def _summarize_scenarios(bank: TaskBank) -> list[dict[str, Any]]:
    summaries: list[dict[str, Any]] = []
    for index, scenario in enumerate(bank.scenarios):
        completed = ~np.isnan(bank.cpm[index])
        medians = np.nanmedian(bank.measures[index], axis=0) if completed.any() else np.full(bank.measures.shape[2], np.nan)
        summaries.append(
            {
                "scenario": scenario.number,
                "label": scenario.label,
                "not_reached": int((~completed).sum()),
                "time_cycles": medians[0],
                "path_m": medians[1],
                "velocity_error": medians[6],
                "peak_direction_error_rad": medians[9],
                "cpm": np.median(bank.cpm[index][completed]) if completed.any() else np.nan,
            }
        )
    return summaries


def key_table(choice: TaskChoice) -> TextTable:
    """Tabulate medians over the tasks for each scenario."""
    rows = [
        [
            summary["label"],
            str(summary["not_reached"]),
            format_significant(summary["time_cycles"], 3),
            format_significant(summary["cpm"], 3),
        ]
        for summary in _summarize_scenarios(choice.bank)
    ]
    return TextTable(["scenario", "not completed", "time, cycles", "CPM"], rows)


def show(choice: TaskChoice, out: Console) -> None:
    """Print a row for each scenario, and the chosen tasks."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    headline, *remarks = choice.describe()
    out.print(escape(headline), soft_wrap=True)
    columns = ("time, cycles", "path, m", "velocity error", "peak direction error, deg", "CPM")
    table = BandedTable("scenario", "", "not completed", *columns)
    for summary in _summarize_scenarios(choice.bank):
        cells = [format_significant(summary[key], 3) for key in ("time_cycles", "path_m", "velocity_error")]
        peak_error_deg = f"{np.degrees(summary['peak_direction_error_rad']):.1f}"
        table.add_row(
            str(summary["scenario"]),
            summary["label"],
            str(summary["not_reached"]),
            *cells,
            peak_error_deg,
            format_significant(summary["cpm"], 3),
        )
    out.print(table)
    caption = "medians over the tasks that are completed; the level of CPM is set by the most extreme trial, compare ratios"
    for remark in (caption, *remarks):
        out.print(remark, soft_wrap=True)
