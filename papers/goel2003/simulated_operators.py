"""The experiment with simulated operators: run, replayed and analysed."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.teleop import simulate_experiment
from holdfast.teleop.analysis import Analysis, analyse
from holdfast.teleop.protocol import Protocol, read_protocol
from holdfast.teleop.records import Records, TrialKind, computer_table, replay_trials, tool_paths, trial_table

if TYPE_CHECKING:
    from pandas import DataFrame

Array = NDArray[np.float64]
Paths = Callable[[str | None, int, int], Array | None]  # of a subject (None: the computer), task and scenario

SUBJECTS, SEED = 24, 1


@dataclass(frozen=True, eq=False)
class Study:
    """The experiment with simulated operators.

    Attributes:
        protocol: The shipped one.
        table: A row for each trial.
        analysis: Tasks grouped by the operators' CPM3, as the paper probably did.
        by_computer: Grouped by the computer's.
        training: (P,) training tasks of each operator.
        differs: Trials that replay differently.
        recorded: Trials recorded.
        paths: Where the end effector was, of the tasks that are drawn.
    """

    protocol: Protocol
    table: DataFrame
    analysis: Analysis
    by_computer: Analysis
    training: NDArray[np.int64]
    differs: int
    recorded: int
    paths: Paths

    def end(self, task: int, scenario: int) -> str:
        """How the operators' trials ended, in words."""
        mine = self.table[(self.table["task"] == task) & (self.table["scenario"] == scenario)]
        arrived = int((mine["end"] == "arrived").sum())
        return f"{arrived} of {len(mine)}"


@cache
def study() -> Study:
    """Run it, replay it, analyse it."""
    protocol = read_protocol()
    with (
        tempfile.TemporaryDirectory() as folder,
        simulate_experiment(Path(folder) / "study", protocol, SUBJECTS, seed=SEED) as records,
    ):
        again = replay_trials(records)
        table, machine = trial_table(records), computer_table(protocol)
        found = analyse(table, machine)
        counts = [len(records.entries(s.code, TrialKind.TRAINING)) for s in records.subjects()]
        paths = _kept(records, found)
    return Study(
        protocol,
        table,
        found,
        analyse(table, machine, difficulty="computer"),
        np.array(counts),
        len(again.differing_entries),
        len(again.entries),
        paths,
    )


def shown(a: Analysis) -> dict[str, int]:
    """The middle task, by number, of each group: those that Figs 5 to 7 show."""
    from holdfast.interface.presentation.teleop import middle_tasks

    return dict(zip(a.groups.names, middle_tasks(a), strict=True))


def _kept(records: Records, a: Analysis) -> Paths:
    """The paths of the tasks that are drawn, without the records."""
    from holdfast.teleop.analysis import median_operator

    path = tool_paths(records)
    kept: dict[tuple[str | None, int, int], Array | None] = {}
    for task in shown(a).values():
        k = median_operator(a.observed, a.observed.tasks.index(task), a.observed.condition_index(a.conditions[0].scenario))
        for who in (None, *([] if k is None else [a.observed.subjects[k]])):
            for c in a.observed.conditions:
                kept[who, task, c.scenario] = path(who, task, c.scenario)
    return lambda who, task, scenario: kept.get((who, task, scenario))
