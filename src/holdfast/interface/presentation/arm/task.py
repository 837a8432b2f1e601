"""Notebook view of a task."""

from __future__ import annotations

from holdfast.core.labels import TASK_ROW_NAMES
from holdfast.interface.presentation.presentation import Column, Presentation, TableSpec, make_headers
from holdfast.model.arm.task import Task


def present(task: Task) -> Presentation:
    """Present the rows of the task, each of which selects a component of the tool twist."""
    columns: list[Column] = ["row", *make_headers(*TASK_ROW_NAMES, aligned=False)]
    rows = [(number, *row) for number, row in enumerate(task.rows.tolist(), 1)]
    return Presentation(task.name, task.describe(), tables=[TableSpec(f"Task rows in the {task.frame} frame", columns, rows)])
