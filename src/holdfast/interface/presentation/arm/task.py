"""Notebook view of a task."""

from __future__ import annotations

from holdfast.core.labels import TASK_ROW_NAMES
from holdfast.interface.presentation.printing import TextTable, format_significant
from holdfast.model.arm.task import Task


def key_table(task: Task) -> TextTable:
    """Tabulate the twist of each task row."""
    return TextTable(
        ["row", *TASK_ROW_NAMES],
        [[str(row_number), *map(format_significant, row)] for row_number, row in enumerate(task.rows, 1)],
        f"in the {task.frame} frame",
    )
