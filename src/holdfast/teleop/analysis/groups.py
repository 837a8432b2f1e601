"""Tasks in groups of difficulty, and the cell means of the analysis of variance with what they are means of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError
from holdfast.teleop.analysis.observations import Observed

if TYPE_CHECKING:
    from pandas import DataFrame

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_NAMES = {2: ("easy", "difficult"), 3: ("easy", "medium", "difficult")}


@dataclass(frozen=True, eq=False, kw_only=True)
class Groups:
    """Tasks in groups of difficulty.

    Attributes:
        names: (B,) from the easiest.
        of_task: (T,) group of each task, from 0.
        difficulty: (T,) what they were sorted by; infinite where most failed, NaN where it is not known.
        by: Whose CPM that is: ``operators`` or ``computer``.
    """

    names: tuple[str, ...]
    of_task: Indices
    difficulty: Array
    by: str

    @property
    def sizes(self) -> Indices:
        """(B,) tasks in each."""
        return np.bincount(self.of_task, minlength=len(self.names))


def in_groups(difficulty: Array, count: int, by: str) -> Groups:
    """Sort tasks by difficulty and cut the list into equal parts; tasks left over go one each to the easiest groups.

    Tasks without a known difficulty are put behind all others: nobody, or not the computer, could do them.

    Args:
        difficulty: (T,) of each task.
        count: Number of groups.
        by: Whose.

    Raises:
        InputError: Fewer than two groups, or fewer tasks than groups.
    """
    if count < 2 or len(difficulty) < count:
        raise InputError(
            f"{len(difficulty)} tasks cannot be put in {count} groups of difficulty; give 2 groups or more, no more than tasks"
        )
    order = np.argsort(np.where(np.isnan(difficulty), np.inf, difficulty), kind="stable")
    of_task = np.empty(len(difficulty), dtype=np.int64)
    for k, part in enumerate(np.array_split(order, count)):
        of_task[part] = k
    names = _NAMES.get(count, tuple(f"level {k + 1} of {count}" for k in range(count)))
    return Groups(names=names, of_task=of_task, difficulty=difficulty, by=by)


@dataclass(frozen=True, eq=False, kw_only=True)
class Cells:
    """Mean CPM of each subject with each law in each group of tasks.

    Attributes:
        values: (P, A, B) means over the tasks available; NaN where there is none.
        tasks: (P, A, B) how many.
        subjects: (P,) codes.
        laws: (A,) names.
        groups: (B,) names.
    """

    values: Array
    tasks: Indices
    subjects: tuple[str, ...]
    laws: tuple[str, ...]
    groups: tuple[str, ...]

    @classmethod
    def of(cls, observed: Observed, conditions: list[int], grouped: Groups) -> Cells:
        """From the trials with some scenarios."""
        cpm = observed.cpm[:, :, conditions]
        there = np.isfinite(cpm)
        member = np.eye(len(grouped.names))[grouped.of_task]
        sums = np.einsum("pta,tb->pab", np.where(there, cpm, 0.0), member)
        tasks = np.einsum("pta,tb->pab", there, member).round().astype(np.int64)
        with np.errstate(invalid="ignore"):
            values = np.where(tasks > 0, sums / np.maximum(tasks, 1), np.nan)
        laws = tuple(observed.conditions[k].law for k in conditions)
        return cls(values=values, tasks=tasks, subjects=observed.subjects, laws=laws, groups=grouped.names)

    def empty(self) -> list[str]:
        """Cells without a task, as people read them."""
        return [f"{self.subjects[p]} / {self.laws[a]} / {self.groups[b]}" for p, a, b in np.argwhere(self.tasks == 0)]

    def long(self) -> DataFrame:
        """A row for each cell: subject, law, difficulty, cpm, tasks."""
        from pandas import DataFrame

        rows = [
            (self.subjects[p], self.laws[a], self.groups[b], self.values[p, a, b], int(self.tasks[p, a, b]))
            for p, a, b in np.ndindex(*self.values.shape)
        ]
        return DataFrame(rows, columns=["subject", "law", "difficulty", "cpm", "tasks"])

    def wide(self) -> DataFrame:
        """A row for each subject, a column for each cell, named ``law_difficulty`` in small letters and underscores."""
        from pandas import DataFrame

        columns = [slug(f"{law}_{group}") for law in self.laws for group in self.groups]
        table = DataFrame(self.values.reshape(len(self.subjects), -1), columns=columns)
        table.insert(0, "subject", list(self.subjects))
        return table


def slug(text: str) -> str:
    """A name that R and JASP take for a column: letters, digits and underscores."""
    return "_".join("".join(c if c.isascii() and c.isalnum() else " " for c in text.lower()).split())
