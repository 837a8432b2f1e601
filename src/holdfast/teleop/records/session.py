"""What a subject does next: training until the criterion is met, then every task in every scenario, from where it stopped."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from holdfast.teleop.bank.tasks import random_tasks
from holdfast.teleop.protocol.order import Indices
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.entries import Entry, Kind, State
from holdfast.teleop.records.records import Records
from holdfast.teleop.trials.recordings import End
from holdfast.teleop.trials.scenarios import PointTasks


@dataclass(frozen=True, eq=False, kw_only=True)
class Next:
    """The next trial of a session.

    Attributes:
        kind: Training, or a trial that counts.
        position: In the session, from 0, counted for each kind.
        task: Index from 0 of the protocol's task; -1 in training.
        scenario: Index from 0.
        tasks: The one task.
    """

    kind: Kind
    position: int
    task: int
    scenario: int
    tasks: PointTasks


@lru_cache(maxsize=256)  # a fifth of a second, and asked for at every trial of a training
def training_tasks(protocol: Protocol, subject: int) -> PointTasks:
    """The training tasks of a subject, in order: random over the workspace, so far apart as the protocol says.

    Args:
        protocol: The protocol.
        subject: Running number, which with the protocol's seed makes them.

    Source: Goel et al. 2003, section 6: pseudoinverse, no failure.
    """
    most, joints = protocol.training.most, protocol.arm.n
    seed = int(np.random.SeedSequence([protocol.seed, subject, 1]).generate_state(1)[0])
    each = -(-most // joints)
    tasks = random_tasks(protocol.arm, each, distance=protocol.training.distance, task=protocol.rows, seed=seed)
    mixed = np.arange(len(tasks)).reshape(joints, each).T.ravel()[:most]
    return tasks.take(mixed)


def training_scenario(protocol: Protocol) -> int:
    """Index of the scenario of the training: the first without a failure."""
    return next((k for k, s in enumerate(protocol.scenarios) if not s.failed), 0)


class Session:
    """One subject's session as the records have it.

    Args:
        records: The records.
        code: The subject.

    Raises:
        InputError: There is no such subject.
    """

    def __init__(self, records: Records, code: str) -> None:
        self.records, self.subject = records, records.subject(code)
        protocol = records.protocol
        self._order: Indices = protocol.session(self.subject.row, self.subject.number)

    def next(self) -> Next | None:
        """The next trial; None when the session is over, or the subject failed the training.

        A trial that was broken off is done again; one that was aborted is not. The state of a subject whose last trial is
        done becomes *completed*.
        """
        protocol, code = self.records.protocol, self.subject.code
        if self.subject.state == State.DROPPED:
            return None
        training = done(self.records.entries(code, Kind.TRAINING))
        criterion = protocol.training
        trials = done(self.records.entries(code, Kind.TRIAL))
        if not trials and not criterion.trained(completion_times(self.records, training)):
            if len(training) >= criterion.most:
                return None
            k = len(training)
            task = training_tasks(protocol, self.subject.number).take(np.array([k]))
            return Next(kind=Kind.TRAINING, position=k, task=-1, scenario=training_scenario(protocol), tasks=task)
        position = len(trials)
        if position >= len(self._order):
            if self.subject.state != State.COMPLETED:
                self.records.set_state(code, State.COMPLETED)
                self.subject = self.records.subject(code)
            return None
        number, scenario = (int(v) for v in self._order[position])
        return Next(
            kind=Kind.TRIAL, position=position, task=number, scenario=scenario, tasks=protocol.tasks.take(np.array([number]))
        )

    def progress(self) -> str:
        """One phrase for people."""
        trained, trials = (len(done(self.records.entries(self.subject.code, kind))) for kind in (Kind.TRAINING, Kind.TRIAL))
        return f"{trained} training tasks, {trials} of {len(self._order)} trials"


def completion_times(records: Records, entries: list[Entry]) -> list[float]:
    """Return the completion time of each trial in cycles; NaN for trials that were not completed."""
    return [float(records.count(e)) if e.end == End.ARRIVED else np.nan for e in entries]


def done(entries: list[Entry]) -> list[Entry]:
    """The trials that were not broken off, the last of each position."""
    found = {e.position: e for e in entries if e.end != End.BROKEN_OFF}
    return [found[k] for k in sorted(found)]
