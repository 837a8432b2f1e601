"""What the rows of the records hold: subjects and trials."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.teleop.trials.recordings import End

Array = NDArray[np.float64]

# The columns that the readers below take, in their order.
SUBJECT = "code, number, row, kind, state, since, answers, note"
ENTRY = "id, subject, kind, position, task, scenario, joint, q0, target, began, ended, end, rating, answers"


class Kind(StrEnum):
    """What a trial is for."""

    PILOT = "pilot"
    TRAINING = "training"
    TRIAL = "trial"


class State(StrEnum):
    """The state of a subject's session."""

    OPEN = "open"
    COMPLETED = "completed"
    DROPPED = "dropped"


class Who(StrEnum):
    """What kind of subject it is: simulated ones are told from people for ever."""

    PERSON = "person"
    SIMULATED = "simulated"
    COMPUTER = "computer"


@dataclass(frozen=True, kw_only=True)
class Subject:
    """One subject.

    Attributes:
        code: As the laboratory calls it; no name.
        number: Running number, from 0: with the protocol's seed it makes the order of the scenarios.
        row: Of the balanced square.
        kind: A person, or not.
        state: Of the session.
        since: When the subject was added, UTC, ISO 8601.
        answers: What the subject answered besides the ratings, for example to the questions of the beginning.
        note: The experimenter's.
    """

    code: str
    number: int
    row: int
    kind: Who
    state: State
    since: str
    answers: Mapping[str, Any]
    note: str


@dataclass(frozen=True, kw_only=True)
class Entry:
    """One trial as recorded, without its cycles.

    Attributes:
        id: Its number in the records.
        subject: Code.
        kind: What it is for.
        position: In the session, from 0, counted for each kind.
        task: Index from 0 of the protocol's task; -1 in training.
        scenario: Index from 0 of the protocol's scenario.
        joint: Index from 0 of the joint that the task has fail; -1 for none.
        q0: (n,) start, rad and m.
        target: (m,) m.
        began: UTC, ISO 8601.
        ended: Likewise; None for a trial that was broken off or is under way.
        end: How it ended.
        rating: Step from 0; None where there is none.
        answers: To further questions after the trial.
    """

    id: int
    subject: str
    kind: Kind
    position: int
    task: int
    scenario: int
    joint: int
    q0: Array
    target: Array
    began: str
    ended: str | None
    end: End
    rating: int | None
    answers: Mapping[str, Any]


def read_subject(row: tuple[Any, ...]) -> Subject:
    """From the columns ``SUBJECT``."""
    code, number, square_row, kind, state, since, answers, note = row
    return Subject(
        code=code,
        number=number,
        row=square_row,
        kind=Who(kind),
        state=State(state),
        since=since,
        answers=json.loads(answers),
        note=note,
    )


def read_entry(row: tuple[Any, ...]) -> Entry:
    """From the columns ``ENTRY``."""
    number, subject, kind, position, task, scenario, joint, q0, target, began, ended, end, rating, answers = row
    how = End.BROKEN_OFF if end is None else End(end)
    said: dict[str, Any] = json.loads(answers)
    return Entry(
        id=number,
        subject=subject,
        kind=Kind(kind),
        position=position,
        task=task,
        scenario=scenario,
        joint=joint,
        q0=_array(q0),
        target=_array(target),
        began=began,
        ended=ended,
        end=how,
        rating=rating,
        answers=said,
    )


def blob(values: Array) -> bytes:
    """Numbers as they are stored."""
    return np.ascontiguousarray(values, dtype="<f8").tobytes()


def _array(blob: bytes) -> Array:
    return np.frombuffer(blob, dtype="<f8").astype(np.float64)
