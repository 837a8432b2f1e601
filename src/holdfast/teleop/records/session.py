"""Next trial of a subject: training until the criterion is met, then every task in every scenario, continued after a break."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from holdfast.core.typing import IndexArray
from holdfast.teleop.bank.tasks import sample_tasks
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.entries import SubjectState, TrialKind, TrialRecord
from holdfast.teleop.records.records import Records
from holdfast.teleop.trials.recordings import End
from holdfast.teleop.trials.scenarios import PointTasks


@dataclass(frozen=True, eq=False, kw_only=True)
class NextTrial:
    """Next trial of a session.

    Attributes:
        kind: Purpose of the trial: training, or a trial that counts.
        position: Position in the session, from 0, counted separately for each kind.
        task: Index from 0 of the protocol's task; -1 in training.
        scenario: Index of the scenario, from 0.
        tasks: Exactly one task.
    """

    kind: TrialKind
    position: int
    task: int
    scenario: int
    tasks: PointTasks


@lru_cache(maxsize=256)  # computing takes 0.2 s, and every training trial calls it
def training_tasks(protocol: Protocol, subject: int) -> PointTasks:
    """Return the training tasks of a subject, in order: random over the workspace, at the distance of the protocol.

    Args:
        protocol: Protocol of the experiment.
        subject: Number of the subject, which with the protocol's seed determines the tasks.

    Source: Goel et al. 2003, section 6: pseudoinverse, no failure.
    """
    task_count, joints = protocol.training.most, protocol.arm.n
    seed = int(np.random.SeedSequence([protocol.seed, subject, 1]).generate_state(1)[0])
    tasks_per_joint = -(-task_count // joints)
    tasks = sample_tasks(protocol.arm, tasks_per_joint, distance=protocol.training.distance, task=protocol.rows, seed=seed)
    interleaved = np.arange(len(tasks)).reshape(joints, tasks_per_joint).T.ravel()[:task_count]
    return tasks.take(interleaved)


def find_training_scenario(protocol: Protocol) -> int:
    """Return the index of the scenario of the training: the first without a failure."""
    return next((index for index, scenario in enumerate(protocol.scenarios) if not scenario.failed), 0)


class Session:
    """Session of one subject, from the records.

    Args:
        records: Records of the experiment.
        code: Code of the subject.

    Raises:
        InputError: There is no such subject.
    """

    def __init__(self, records: Records, code: str) -> None:
        self.records, self.subject = records, records.subject(code)
        protocol = records.protocol
        self._order: IndexArray = protocol.session_order(self.subject.row, self.subject.number)

    def next_trial(self) -> NextTrial | None:
        """Return the next trial; None when the session is over, or the subject failed the training.

        A trial that was broken off is repeated; one that was aborted is not. After the last trial, the state of the subject
        becomes *completed*.
        """
        protocol, code = self.records.protocol, self.subject.code
        if self.subject.state == SubjectState.DROPPED:
            return None
        training = select_valid_trials(self.records.entries(code, TrialKind.TRAINING))
        criterion = protocol.training
        trials = select_valid_trials(self.records.entries(code, TrialKind.TRIAL))
        if not trials and not criterion.is_met_by(completion_times(self.records, training)):
            if len(training) >= criterion.most:
                return None
            index = len(training)
            training_task = training_tasks(protocol, self.subject.number).take(np.array([index]))
            return NextTrial(
                kind=TrialKind.TRAINING, position=index, task=-1, scenario=find_training_scenario(protocol), tasks=training_task
            )
        position = len(trials)
        if position >= len(self._order):
            if self.subject.state != SubjectState.COMPLETED:
                self.records.set_state(code, SubjectState.COMPLETED)
                self.subject = self.records.subject(code)
            return None
        number, scenario = (int(value) for value in self._order[position])
        return NextTrial(
            kind=TrialKind.TRIAL,
            position=position,
            task=number,
            scenario=scenario,
            tasks=protocol.tasks.take(np.array([number])),
        )

    def progress(self) -> str:
        """Describe the progress in one phrase."""
        trained, trials = (
            len(select_valid_trials(self.records.entries(self.subject.code, kind)))
            for kind in (TrialKind.TRAINING, TrialKind.TRIAL)
        )
        return f"{trained} training tasks, {trials} of {len(self._order)} trials"


def completion_times(records: Records, entries: list[TrialRecord]) -> list[float]:
    """Return the completion time of each trial in cycles; NaN for trials that were not completed."""
    return [float(records.count_cycles(e)) if e.end == End.ARRIVED else np.nan for e in entries]


def select_valid_trials(entries: list[TrialRecord]) -> list[TrialRecord]:
    """Return the trials that were not broken off, the last of each position."""
    latest = {entry.position: entry for entry in entries if entry.end != End.BROKEN_OFF}
    return [latest[position] for position in sorted(latest)]
