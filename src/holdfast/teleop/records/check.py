"""Recorded trials again through the same arm: does every command lead where the record says?"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.notice import says
from holdfast.result import Result
from holdfast.teleop.records.entries import Entry
from holdfast.teleop.records.records import Records
from holdfast.teleop.trials.recordings import Trials

Array = NDArray[np.float64]

SAME = 1e-6  # rad and m; a browser, or a computer of another kind, rounds differently, by less


@dataclass(frozen=True, eq=False)
class Replay(Result):
    """What replaying showed.

    Attributes:
        entries: The N trials.
        trials: What was recorded of them.
        difference: (N,) largest difference of a joint, in any cycle, from what was recorded, rad and m; infinite where the
            end effector was in the target circle without a command and the trial continued.
    """

    entries: list[Entry]
    trials: Trials
    difference: Array

    @property
    def differs(self) -> list[Entry]:
        """The trials that do not come out as recorded."""
        return [e for e, d in zip(self.entries, self.difference, strict=True) if not d <= SAME]

    @property
    def largest(self) -> float:
        """Largest difference of all, rad or m; 0 if there are no trials."""
        return float(self.difference.max(initial=0.0))

    def to_dict(self) -> dict[str, Any]:
        """Which trials differ, and by how much at most; None if that is infinite."""
        largest = self.largest if np.isfinite(self.largest) else None
        return {"trials": len(self.entries), "differ": [e.id for e in self.differs], "largest_difference": largest}

    def describe(self) -> list[str]:
        """How many trials differ, and a line for each of them."""
        first = (
            f"{len(self.entries)} trials, {len(self.differs)} differ; largest difference of a joint {self.largest:.2g} rad or m"
        )
        return [first] + [
            f"  trial {e.id}: subject {e.subject}, {e.kind.value} {e.position + 1}, task {e.task + 1}, by more than {SAME:g}"
            for e in self.differs
        ]


@says("replaying the trials")
def replay(records: Records, entries: list[Entry] | None = None) -> Replay:
    """Drive the arm with the recorded commands, and compare configurations cycle by cycle.

    Each cycle begins at the recorded configuration, the first at the task's start: where a motion is unstable, the last
    digits in which two computers differ would grow from cycle to cycle and say nothing about the record.

    Args:
        records: The records.
        entries: Which trials; all if not given.
    """
    chosen = records.entries() if entries is None else entries
    protocol, trials, tasks = records.protocol, records.trials(chosen), records.tasks(chosen)
    scenario = np.array([e.scenario for e in chosen], dtype=np.int64)
    healthy = tasks.healthy(np.array([s.failed for s in protocol.scenarios], dtype=bool)[scenario])
    of = np.repeat(np.arange(len(chosen)), trials.cycles)
    reached = np.empty_like(trials.q)
    for k, plant in enumerate(protocol.plants):
        mine = np.flatnonzero(scenario[of] == k)
        if mine.size:
            reached[mine] = plant.cycles(trials.q[mine], trials.velocity[mine], healthy[of[mine]])[0]
    inside = np.linalg.norm(trials.target[of] - trials.x, axis=1) <= protocol.radius
    over = inside & ~trials.velocity.any(axis=1)
    difference = np.zeros(len(chosen))
    for i in range(len(chosen)):
        cycles = slice(trials.first[i], trials.first[i + 1])
        path = np.concatenate([tasks.q0[i : i + 1], reached[cycles]])
        difference[i] = np.inf if over[cycles].any() else np.abs(path - trials.configurations(i)).max()
    return Replay(chosen, trials, difference)
