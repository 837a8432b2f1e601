"""Rows of the records: subjects and trials."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.teleop.trials.recordings import End

# Columns that the functions below read, in their order.
SUBJECT_COLUMNS = "code, number, row, kind, state, since, answers, note"
ENTRY_COLUMNS = "id, subject, kind, position, task, scenario, joint, q0, target, began, ended, end, rating, answers"


class TrialKind(StrEnum):
    """Purpose of a trial."""

    PILOT = "pilot"
    TRAINING = "training"
    TRIAL = "trial"


class SubjectState(StrEnum):
    """State of a subject's session."""

    OPEN = "open"
    COMPLETED = "completed"
    DROPPED = "dropped"


class SubjectKind(StrEnum):
    """Kind of a subject; simulated subjects stay distinguishable from people."""

    PERSON = "person"
    SIMULATED = "simulated"
    COMPUTER = "computer"


@dataclass(frozen=True, kw_only=True)
class Subject:
    """Subject of an experiment.

    Attributes:
        code: Code of the subject in the laboratory, not a name.
        number: Number of the subject, from 0; with the protocol's seed it determines the order of the scenarios.
        row: Row of the balanced square, from 0.
        kind: Person, simulated person, or computer.
        state: State of the session.
        since: Time at which the subject was added, UTC, ISO 8601.
        answers: Answers other than ratings, for example to the initial questions.
        note: Note of the experimenter.
    """

    code: str
    number: int
    row: int
    kind: SubjectKind
    state: SubjectState
    since: str
    answers: Mapping[str, Any]
    note: str


@dataclass(frozen=True, kw_only=True)
class TrialRecord:
    """Trial as recorded, without its cycles.

    Attributes:
        id: Number of the trial in the records.
        subject: Code of the subject.
        kind: Purpose of the trial.
        position: Position in the session, from 0, counted separately for each kind.
        task: Index from 0 of the protocol's task; -1 in training.
        scenario: Index from 0 of the protocol's scenario.
        joint: Index from 0 of the joint that fails in the task; -1 for none.
        q0: (n,) start configuration, rad and m.
        target: (m,) centre of the target circle, m.
        began: Start time, UTC, ISO 8601.
        ended: End time, UTC, ISO 8601; None for a trial that was broken off or is in progress.
        end: End of the trial.
        rating: Rating, from 0; None without one.
        answers: Answers to further questions after the trial.
    """

    id: int
    subject: str
    kind: TrialKind
    position: int
    task: int
    scenario: int
    joint: int
    q0: FloatArray
    target: FloatArray
    began: str
    ended: str | None
    end: End
    rating: int | None
    answers: Mapping[str, Any]


def parse_subject_row(row: tuple[Any, ...]) -> Subject:
    """Read a subject from the columns ``SUBJECT_COLUMNS``."""
    code, number, square_row, kind, state, since, answers, note = row
    return Subject(
        code=code,
        number=number,
        row=square_row,
        kind=SubjectKind(kind),
        state=SubjectState(state),
        since=since,
        answers=json.loads(answers),
        note=note,
    )


def parse_trial_row(row: tuple[Any, ...]) -> TrialRecord:
    """Read a trial from the columns ``ENTRY_COLUMNS``."""
    number, subject, kind, position, task, scenario, joint, q0, target, began, ended, end, rating, answers = row
    trial_end = End.BROKEN_OFF if end is None else End(end)
    parsed_answers: dict[str, Any] = json.loads(answers)
    return TrialRecord(
        id=number,
        subject=subject,
        kind=TrialKind(kind),
        position=position,
        task=task,
        scenario=scenario,
        joint=joint,
        q0=_unpack_array(q0),
        target=_unpack_array(target),
        began=began,
        ended=ended,
        end=trial_end,
        rating=rating,
        answers=parsed_answers,
    )


def pack_array(values: FloatArray) -> bytes:
    """Pack numbers in the stored format."""
    return np.ascontiguousarray(values, dtype="<f8").tobytes()


def _unpack_array(blob: bytes) -> FloatArray:
    return np.frombuffer(blob, dtype="<f8").astype(np.float64)
