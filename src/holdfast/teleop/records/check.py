"""Replay of recorded trials through the same arm, to check that the commands lead to the recorded configurations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.teleop.records.entries import TrialRecord
from holdfast.teleop.records.records import Records
from holdfast.teleop.trials.recordings import Trials

REPLAY_TOLERANCE = 1e-6  # rad and m; a browser, or another kind of computer, rounds differently by less than this


@dataclass(frozen=True, eq=False)
class Replay(Result):
    """Result of a replay of recorded trials.

    Attributes:
        entries: N replayed trials.
        trials: Recorded motions of the trials.
        difference: (N,) largest difference of a joint from the record in any cycle, rad and m; infinite where the end effector
            was in the target circle without a command and the trial continued.
    """

    entries: list[TrialRecord]
    trials: Trials
    difference: FloatArray

    @property
    def differing_entries(self) -> list[TrialRecord]:
        """Trials whose replay differs from the record."""
        return [
            entry for entry, difference in zip(self.entries, self.difference, strict=True) if not difference <= REPLAY_TOLERANCE
        ]

    @property
    def largest(self) -> float:
        """Largest difference of all trials, rad or m; 0 if there are no trials."""
        return float(self.difference.max(initial=0.0))

    def to_dict(self) -> dict[str, Any]:
        """Return the trials that differ, and the largest difference; None if that is infinite."""
        largest = self.largest if np.isfinite(self.largest) else None
        return {
            "trials": len(self.entries),
            "differ": [entry.id for entry in self.differing_entries],
            "largest_difference": largest,
        }

    def describe(self) -> list[str]:
        """Describe the number of trials that differ, with a line for each of them."""
        summary = (
            f"{len(self.entries)} trials, {len(self.differing_entries)} differ; largest difference of a joint "
            f"{self.largest:.2g} rad or m"
        )
        return [summary] + [
            f"  trial {entry.id}: subject {entry.subject}, {entry.kind.value} {entry.position + 1}, task "
            f"{entry.task + 1}, by more than {REPLAY_TOLERANCE:g}"
            for entry in self.differing_entries
        ]


@reports_progress("replaying the trials")
def replay_trials(records: Records, entries: list[TrialRecord] | None = None) -> Replay:
    """Drive the arm with the recorded commands, and compare configurations cycle by cycle.

    Each cycle begins at the recorded configuration, and the first one at the task's start. Otherwise, if a motion is unstable,
    rounding differences between two computers would grow from cycle to cycle and contain no information about the record.

    Args:
        records: Records of the experiment.
        entries: Trials to replay. Default: all.
    """
    chosen = records.entries() if entries is None else entries
    protocol, trials, tasks = records.protocol, records.read_trials(chosen), records.read_tasks(chosen)
    scenario = np.array([entry.scenario for entry in chosen], dtype=np.int64)
    healthy = tasks.healthy_mask(np.array([condition.failed for condition in protocol.scenarios], dtype=bool)[scenario])
    trial_of_cycle = np.repeat(np.arange(len(chosen)), trials.cycles)
    replayed = np.empty_like(trials.q)
    for index, plant in enumerate(protocol.plants):
        selected = np.flatnonzero(scenario[trial_of_cycle] == index)
        if selected.size:
            replayed[selected] = plant.step_batch(
                trials.q[selected], trials.velocity[selected], healthy[trial_of_cycle[selected]]
            )[0]
    inside = np.linalg.norm(trials.target[trial_of_cycle] - trials.x, axis=1) <= protocol.radius
    is_over = inside & ~trials.velocity.any(axis=1)
    difference = np.zeros(len(chosen))
    for trial in range(len(chosen)):
        cycles = slice(trials.first[trial], trials.first[trial + 1])
        configurations = np.concatenate([tasks.q0[trial : trial + 1], replayed[cycles]])
        difference[trial] = np.inf if is_over[cycles].any() else np.abs(configurations - trials.configurations(trial)).max()
    return Replay(chosen, trials, difference)
