"""Groups of tasks by difficulty, and the cell means of the analysis of variance with their numbers of tasks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.teleop.analysis.observations import TrialTable

if TYPE_CHECKING:
    from pandas import DataFrame


_GROUP_NAMES = {2: ("easy", "difficult"), 3: ("easy", "medium", "difficult")}


@dataclass(frozen=True, eq=False, kw_only=True)
class TaskGroups:
    """Groups of tasks by difficulty.

    Attributes:
        names: (B,) names of the groups, from the easiest.
        of_task: (T,) index of the group of each task, from 0.
        difficulty: (T,) CPM by which the tasks were sorted; infinite where most operators failed, NaN where it is unknown.
        by: Source of this CPM: ``operators`` or ``computer``.
    """

    names: tuple[str, ...]
    of_task: IndexArray
    difficulty: FloatArray
    by: str

    @property
    def sizes(self) -> IndexArray:
        """Number of tasks in each group, (B,)."""
        return np.bincount(self.of_task, minlength=len(self.names))


def group_by_difficulty(difficulty: FloatArray, count: int, by: str) -> TaskGroups:
    """Group tasks by difficulty into equal parts of their sorted list; surplus tasks go one each to the easiest groups.

    Tasks without a known difficulty come after all others, because no operator, or not the computer, completed them.

    Args:
        difficulty: (T,) difficulty of each task.
        count: Number of groups.
        by: Source of the difficulty.

    Raises:
        InputError: There are fewer than two groups, or fewer tasks than groups.
    """
    if count < 2 or len(difficulty) < count:
        raise InputError(
            f"{len(difficulty)} tasks cannot be put in {count} groups of difficulty; give 2 groups or more, no more than tasks"
        )
    order = np.argsort(np.where(np.isnan(difficulty), np.inf, difficulty), kind="stable")
    of_task = np.empty(len(difficulty), dtype=np.int64)
    for group, members in enumerate(np.array_split(order, count)):
        of_task[members] = group
    names = _GROUP_NAMES.get(count, tuple(f"level {group + 1} of {count}" for group in range(count)))
    return TaskGroups(names=names, of_task=of_task, difficulty=difficulty, by=by)


@dataclass(frozen=True, eq=False, kw_only=True)
class CellMeans:
    """Mean CPM of each subject with each law in each group of tasks.

    Attributes:
        values: (P, A, B) mean CPM over the available tasks; NaN where there is none.
        tasks: (P, A, B) number of these tasks.
        subjects: (P,) codes of the subjects.
        laws: (A,) names of the laws.
        groups: (B,) names of the groups.
    """

    values: FloatArray
    tasks: IndexArray
    subjects: tuple[str, ...]
    laws: tuple[str, ...]
    groups: tuple[str, ...]

    @classmethod
    def from_trials(cls, observed: TrialTable, conditions: list[int], grouped: TaskGroups) -> CellMeans:
        """Compute the cell means of the trials ``observed`` with A scenarios (indices ``conditions``) and ``grouped`` tasks."""
        cpm = observed.cpm[:, :, conditions]
        finite = np.isfinite(cpm)
        membership = np.eye(len(grouped.names))[grouped.of_task]
        sums = np.einsum("pta,tb->pab", np.where(finite, cpm, 0.0), membership)
        tasks = np.einsum("pta,tb->pab", finite, membership).round().astype(np.int64)
        with np.errstate(invalid="ignore"):
            values = np.where(tasks > 0, sums / np.maximum(tasks, 1), np.nan)
        laws = tuple(observed.conditions[position].law for position in conditions)
        return cls(values=values, tasks=tasks, subjects=observed.subjects, laws=laws, groups=grouped.names)

    def list_empty(self) -> list[str]:
        """Return the names of the cells without a task."""
        return [
            f"{self.subjects[subject]} / {self.laws[law]} / {self.groups[group]}"
            for subject, law, group in np.argwhere(self.tasks == 0)
        ]

    def to_long_table(self) -> DataFrame:
        """Return a table with a row for each cell: subject, law, difficulty, cpm, tasks."""
        from pandas import DataFrame

        rows = [
            (
                self.subjects[subject],
                self.laws[law],
                self.groups[group],
                self.values[subject, law, group],
                int(self.tasks[subject, law, group]),
            )
            for subject, law, group in np.ndindex(*self.values.shape)
        ]
        return DataFrame(rows, columns=["subject", "law", "difficulty", "cpm", "tasks"])

    def to_wide_table(self) -> DataFrame:
        """Return a table with a row for each subject and a column for each cell, named ``law_difficulty`` in lower case."""
        from pandas import DataFrame

        columns = [make_column_name(f"{law}_{group}") for law in self.laws for group in self.groups]
        table = DataFrame(self.values.reshape(len(self.subjects), -1), columns=columns)
        table.insert(0, "subject", list(self.subjects))
        return table


def make_column_name(text: str) -> str:
    """Return a column name for R and JASP: letters, digits and underscores."""
    return "_".join(
        "".join(character if character.isascii() and character.isalnum() else " " for character in text.lower()).split()
    )
