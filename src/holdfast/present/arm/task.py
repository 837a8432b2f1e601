"""A task, as a notebook shows it."""

from __future__ import annotations

from holdfast.arm.task import Task
from holdfast.grammar import ROWS
from holdfast.present.printing import Rows, number


def key_table(task: Task) -> Rows:
    """The twist of each row."""
    return Rows(
        ["row", *ROWS], [[str(k), *map(number, row)] for k, row in enumerate(task.rows, 1)], f"in the {task.frame} frame"
    )


def next_steps(task: Task, name: str) -> list[str]:
    """An index of it."""
    return [f'hf.indices.relative_manipulability(hf.arms.load("pa10-9dof"), {name})'] if task.m < 9 else []
