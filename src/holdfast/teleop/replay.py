"""Recorded trials again through the same arm: does the same path come out?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.teleop.drive import Recorded, Rules
from holdfast.teleop.entries import Entry
from holdfast.teleop.records import Records
from holdfast.teleop.tasks import drive_tasks

Array = NDArray[np.float64]

SAME = 1e-9  # rad and m; a computer of another kind rounds differently, by less


@dataclass(frozen=True, eq=False)
class Replay:
    """What replaying showed.

    Attributes:
        entries: The N trials.
        difference: (N,) largest difference of a joint, in any cycle, from what was recorded, rad and m; infinite where the
            replayed trial has another number of cycles.
    """

    entries: list[Entry]
    difference: Array

    @property
    def differs(self) -> list[Entry]:
        """The trials that do not come out as recorded."""
        return [e for e, d in zip(self.entries, self.difference, strict=True) if not d <= SAME]


def replay(records: Records, entries: list[Entry] | None = None) -> Replay:
    """Drive the arm with the recorded commands, from the recorded start, and compare configurations cycle by cycle.

    Args:
        records: The records.
        entries: Which trials; all if not given.
    """
    chosen = records.entries() if entries is None else entries
    protocol, trials = records.protocol, records.trials(chosen)
    scenario = np.array([e.scenario for e in chosen], dtype=np.int64)
    # The rules play no part: a trial is over when its record is.
    rules = Rules(radius=protocol.radius, at_rest=True, cycle_limit=int(trials.cycles.max(initial=1)), patience=10**9)
    tasks = records.tasks(chosen)
    again = drive_tasks(protocol.plants, protocol.scenarios, scenario, tasks, Recorded(trials), None, rules)
    difference = np.full(len(chosen), np.inf)
    for i in range(len(chosen)):
        old, new = trials.configurations(i), again.configurations(i)
        if len(old) == len(new):
            difference[i] = np.abs(old - new).max()
    return Replay(chosen, difference)
