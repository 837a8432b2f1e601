"""Presentation of the tasks chosen from a bank."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.files.output import write_files
from holdfast.core.files.spreadsheet import write_csv_text
from holdfast.core.formatting import format_percent
from holdfast.interface import report
from holdfast.interface.presentation.presentation import Column, FigureSpec, Presentation, TableSpec, make_headers
from holdfast.interface.presentation.teleop.bank import bank_figure
from holdfast.model import arms
from holdfast.teleop.bank.selection import TaskChoice
from holdfast.teleop.bank.tasks import TaskBank
from holdfast.teleop.protocol.protocol import Protocol, read_protocol
from holdfast.teleop.records.tables import bank_table


def to_dict(choice: TaskChoice) -> dict[str, Any]:
    """Return the chosen tasks, numbered from 1, and medians over the tasks for each scenario, as JSON data."""
    return {
        **choice.arm.entry(),
        "tasks": len(choice.bank),
        "cells_occupied": len(choice.cells.occupied_cells),
        "chosen": choice.chosen + 1,
        "most_disorienting": None if choice.disorienting is None else choice.disorienting + 1,
        "trapped": None if choice.trapped is None else choice.trapped + 1,
        "scenarios": _summarize_scenarios(choice.bank),
    }


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


def present(choice: TaskChoice) -> Presentation:
    """Present the chosen tasks, numbered from 1, and medians over the tasks for each scenario."""
    bank, completed = choice.bank, choice.bank.is_completed()
    cell_count = (len(choice.cells.difficulty) - 1) * (len(choice.cells.ratio) - 1)
    lines = [
        "The scale of CPM depends on the most extreme trial, so compare only ratios.",
        f"{len(choice.cells.occupied_cells)} of {cell_count} cells of CPM3 and CPM4/CPM3 contain a task. Chosen, by CPM3: "
        f"{' '.join(str(task + 1) for task in choice.chosen)}.",
    ]
    if choice.disorienting is not None:
        trapped = (
            "In no task of the bank does the failed arm converge to a stationary point under the pseudoinverse although the "
            "target can be reached by steering; another seed may have such a task, and the protocol goel2003 contains one."
            if choice.trapped is None
            else f"Task that converges to a stationary point but can be completed by steering: {choice.trapped + 1}."
        )
        lines += [f"Most disorienting of the other tasks: {choice.disorienting + 1}.", trapped]
    measures = ("time, cycles", "path, m", "velocity error", "peak direction error, deg", "CPM")
    columns: list[Column] = ["scenario", "", "not completed", *make_headers(*measures, digits=3)]
    summaries = [
        summary | {"peak_direction_error_rad": np.degrees(summary["peak_direction_error_rad"])}
        for summary in _summarize_scenarios(bank)
    ]
    rows = [list(summary.values()) for summary in summaries]
    draw_bank = partial(bank_figure, bank, choice.cells, choice.chosen, special=choice.special_tasks)
    return Presentation(
        f"Tasks chosen from a bank for {choice.arm.name}",
        f"With the failed arm, the failure-tolerant inverse is better (CPM4/CPM3 below 1) in "
        f"{format_percent(float((bank.ratio[completed] < 1).mean()))} of the tasks.",
        about=f"Arm {choice.arm.title}: {len(bank)} tasks in {len(bank.scenarios)} scenarios under computer control",
        lines=lines,
        tables=[TableSpec("Medians over the completed tasks", columns, rows)],
        figures={"bank": FigureSpec(draw_bank, "The bank and the chosen tasks")},
        arm=choice.arm,
    )


def save(choice: TaskChoice, folder: Path, spec: str) -> list[Path]:
    """Write bank.csv, protocol.yaml with the chosen tasks, and bank.png into a folder, which is created if it does not exist.

    ``spec`` is the arm as named in the protocol: a built-in name or a file.
    """
    files = write_files(folder, {"bank.csv": write_csv_text(bank_table(choice.bank, choice.arm, choice.cells))})
    protocol = _make_protocol(choice, spec).write(folder / "protocol.yaml")
    return [*files, protocol, report.save_png(choice.figures()["bank"], folder / "bank.png", 150)]


def _make_protocol(choice: TaskChoice, spec: str) -> Protocol:
    """Return the protocol of the paper with this arm and the chosen tasks."""
    bank, tasks = choice.bank, np.append(choice.chosen, choice.special_tasks)
    file = None if spec in arms.names() else Path(spec)
    protocol = replace(
        read_protocol(),
        name=f"{choice.arm.name}, {len(tasks)} tasks of a bank of {len(bank)}, seed {choice.seed}",
        arm=choice.arm,
        arm_spec=spec if file is None else file.name,
        arm_file=file,
        rows=choice.task,
    )
    with np.errstate(invalid="ignore"):
        notes = [
            f"bank task {task + 1}, CPM3 {bank.difficulty[task]:.3f}, CPM4/CPM3 {bank.ratio[task]:.3f}"
            if np.isfinite(bank.ratio[task])
            else f"bank task {task + 1}, not completed by the computer in every scenario"
            for task in tasks
        ]
    return protocol.with_tasks(bank.tasks.take(tasks), notes)
