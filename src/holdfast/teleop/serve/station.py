"""Session of a subject over its messages: the changes of the records by each message, and the refusals.

A station stores only the subject's code between messages. Everything else is in the records, so that a rolled back
transaction, or a killed server, leaves no wrong state behind.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatchmethod

import numpy as np

from holdfast.core.errors import InputError
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.entries import SubjectKind, SubjectState, TrialKind, TrialRecord
from holdfast.teleop.records.file import format_utc_now
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import Session, find_training_scenario, select_valid_trials, training_tasks
from holdfast.teleop.serve import messages
from holdfast.teleop.serve.messages import Ack, Bye, Hello, Refused, Sequenced, Welcome
from holdfast.teleop.trials.recordings import End

_TRIAL_ENDS = {"arrived": End.ARRIVED, "aborted": End.ABORTED, "time": End.TIME, "broken-off": End.BROKEN_OFF}
_LIMIT_TOLERANCE = 1e-9  # of the joystick's limit
_MAX_ANSWERS = 1000
_MAX_SESSION_S = 8 * 3600  # longest session, s
# _BYTES_PER_CYCLE and _BYTES_PER_NUMBER: bytes of a message about one cycle, and of each of its numbers
_BYTES_PER_CYCLE = 80
_BYTES_PER_NUMBER = 25


@dataclass(frozen=True)
class MessageOutcome:
    """Outcome of a message.

    Attributes:
        reply: Reply to the page.
        entry: Trial of the message, in its state before; None for none.
        finished: Number of the trial that the message ended; None for none.
    """

    reply: Ack | Refused | Bye
    entry: TrialRecord | None = None
    finished: int | None = None


@dataclass(frozen=True)
class Admission:
    """Subject and key of an admitted page.

    Attributes:
        code: Code of the subject.
        key: Key of the session.
    """

    code: str
    key: str


def admit_page(records: Records, hello: Hello) -> Admission | Refused | Bye:
    """Admit a page that sends hello: as a new subject, or to a session that is resumed.

    A code without records may be used again, because the page never received the answer to its hello.
    """
    if hello.format != messages.MESSAGE_FORMAT:
        reason = f"the page speaks format {hello.format} and the server {messages.MESSAGE_FORMAT}; reload the page"
        return Refused(seq=None, reason=reason, last=0)
    key = hello.session
    if key is None and hello.fresh is not None and records.key_holder(hello.fresh) is not None:
        key = hello.fresh  # the answer to the first hello was lost
    if key is not None:
        code = records.key_holder(key)
        if code is None:
            return Bye(reason="this session is not known here: it was deleted, or given to another page")
        subject = records.subject(code)
        if subject.state == SubjectState.DROPPED:
            return Bye(reason=f"the session of {code} was ended by the experimenter")
        if subject.kind != hello.kind:
            return Bye(reason=f"the session of {code} is that of a {subject.kind} subject, and this page's is {hello.kind}")
        return Admission(code, key)
    try:
        with records.transaction():
            return _admit_new_subject(records, hello)
    except InputError as error:
        return Refused(seq=None, reason=str(error), last=0)


def _admit_new_subject(records: Records, hello: Hello) -> Admission:
    subject = {listed.code: listed for listed in records.subjects()}.get(hello.code or "")
    if subject is None:
        subject = records.add_subject(hello.code, SubjectKind(hello.kind))
    elif subject.state != SubjectState.OPEN or subject.kind != hello.kind or subject.answers or records.last_seq(subject.code):
        raise InputError(
            f"the session of {subject.code} has begun already; give another code, or ask the experimenter to move it "
            f"to this page"
        )
    return Admission(subject.code, records.give_key(subject.code, hello.fresh))


class Station:
    """Session of one subject.

    Args:
        records: Records of the experiment.
        code: Code of the subject.
    """

    def __init__(self, records: Records, code: str) -> None:
        self.records, self.code = records, code

    def make_welcome(self, key: str, paused: bool) -> Welcome:
        """Return the answer to a hello."""
        records = self.records
        with records.transaction():
            subject = records.subject(self.code)
            training, trials = (
                select_valid_trials(records.entries(self.code, kind)) for kind in (TrialKind.TRAINING, TrialKind.TRIAL)
            )
            is_over = Session(records, self.code).next_trial() is None
            latest_trial = records.latest_trial(self.code)
        return Welcome(
            session=key,
            subject=self.code,
            seq=records.last_seq(self.code),
            plan=_build_plan(records, subject.row, subject.number),
            done=messages.Done(
                training=[records.count_cycles(entry) if entry.end == End.ARRIVED else None for entry in training],
                trials=len(trials),
            ),
            unrated=latest_trial is not None
            and latest_trial.kind == TrialKind.TRIAL
            and _is_finished(latest_trial)
            and latest_trial.rating is None,
            answered=[key for key in subject.answers if "." not in key],
            paused=paused,
            over=is_over,
        )

    def apply_message(self, message: Sequenced, size: int = 0) -> MessageOutcome:
        """Apply a message of ``size`` bytes: all of it is recorded, with its number, or nothing."""
        records = self.records
        try:
            subject = records.subject(self.code)
        except InputError:
            return MessageOutcome(Bye(reason="this session was deleted"))
        if subject.state == SubjectState.DROPPED:
            return MessageOutcome(Bye(reason=f"the session of {self.code} was ended by the experimenter"))
        last_seq, seq = records.last_seq(self.code), message.seq
        max_bytes = message_quota_bytes(records.protocol)
        if records.received_bytes(self.code) + size > max_bytes:
            reason = f"the session has sent {max_bytes // 2**20} MiB, the largest amount; tell the experimenter"
            return MessageOutcome(Refused(seq=seq, reason=reason, last=last_seq))
        if seq <= last_seq:
            return MessageOutcome(Refused(seq=seq, reason=f"message {seq} is on record already", last=last_seq))
        if seq > last_seq + 1:
            return MessageOutcome(Refused(seq=seq, reason=f"message {seq} arrived, but {last_seq + 1} is next", last=last_seq))
        entry = records.latest_trial(self.code)
        try:
            with records.transaction():
                finished = self._apply(message, entry)
                records.set_last_seq(self.code, seq, size)
        except InputError as error:
            return MessageOutcome(Refused(seq=seq, reason=str(error), last=last_seq))
        return MessageOutcome(Ack(seq=seq), entry, finished)

    # ---- each message ----------------------------------------------------------------------------------------------

    @singledispatchmethod
    def _apply(self, message: Sequenced, entry: TrialRecord | None) -> int | None:
        """Change the records, and return the number of a trial that this ends."""
        raise AssertionError(message)

    @_apply.register
    def _(self, message: messages.AnswersMessage, entry: TrialRecord | None) -> int | None:
        # The newest answers are those of the subject; the events keep all of them, even if a form is filled in twice.
        subject = self.records.subject(self.code)
        new_answers = {f"{message.form}.{key}": value for key, value in message.answers.items()}
        earlier = {key: value for key, value in subject.answers.items() if key.split(".")[0] != message.form}
        if len(earlier) + len(new_answers) > _MAX_ANSWERS:
            raise InputError(f"a subject has at most {_MAX_ANSWERS} answers")
        self.records.set_answers(self.code, {**earlier, message.form: format_utc_now(), **new_answers})
        self.records.add_event("answers", self.code, None, k=None, data={"form": message.form, **new_answers})
        return None

    @_apply.register
    def _(self, message: messages.Begin, entry: TrialRecord | None) -> int | None:
        next_trial = Session(self.records, self.code).next_trial()
        if next_trial is None:
            raise InputError("the session is over; there is no trial to begin")
        if (next_trial.kind, next_trial.position) != (message.kind, message.position):
            raise InputError(
                f"{message.kind} {message.position + 1} was begun, and {next_trial.kind.value} {next_trial.position + 1} "
                f"is the next"
            )
        self.records.begin_trial(
            self.code,
            next_trial.kind,
            next_trial.position,
            scenario=next_trial.scenario,
            tasks=next_trial.tasks,
            task=next_trial.task,
        )
        return None

    @_apply.register
    def _(self, message: messages.Cycles, entry: TrialRecord | None) -> int | None:
        trial = _require_running_trial(entry)
        protocol = self.records.protocol
        n, m = protocol.arm.n, protocol.rows.m
        if {len(v) for v in message.velocity} != {m} or {len(q) for q in message.q} != {n}:
            raise InputError(f"each cycle needs a command of {m} numbers and a configuration of {n}")
        velocity = np.array(message.velocity)
        top_speed = float(np.linalg.norm(velocity, axis=1).max())
        if top_speed > protocol.stick.limit * (1 + _LIMIT_TOLERANCE):
            raise InputError(f"a command of {top_speed:g} m/cycle is beyond the joystick's limit of {protocol.stick.limit:g}")
        if protocol.cycle_limit is not None and message.first + len(velocity) > protocol.cycle_limit:
            raise InputError(f"a trial has at most {protocol.cycle_limit} cycles")
        self.records.append_cycles(trial.id, message.first, np.array(message.time), velocity=velocity, q=np.array(message.q))
        return None

    @_apply.register
    def _(self, message: messages.EndMessage, entry: TrialRecord | None) -> int | None:
        trial = _require_running_trial(entry)
        protocol = self.records.protocol
        if len(message.q) != protocol.arm.n:
            raise InputError(f"the end of a trial needs a configuration of {protocol.arm.n} numbers")
        if message.end == "time" and self.records.count_cycles(trial) != protocol.cycle_limit:
            raise InputError("the time of this trial is not over")
        self.records.finish_trial(trial.id, _TRIAL_ENDS[message.end], np.array(message.q))
        Session(self.records, self.code).next_trial()  # completes the session after its last trial
        return trial.id

    @_apply.register
    def _(self, message: messages.Rate, entry: TrialRecord | None) -> int | None:
        if entry is None or not _is_finished(entry):
            raise InputError("there is no finished trial to rate")
        if entry.kind == TrialKind.TRAINING:
            raise InputError("the last trial is a training trial, which has no rating")
        if entry.rating is not None:
            raise InputError("the trial already has a rating")
        self.records.rate_trial(entry.id, message.rating, message.answers)
        return None

    @_apply.register
    def _(self, message: messages.EventMessage, entry: TrialRecord | None) -> int | None:
        trial = None if entry is None or entry.ended is not None else entry.id
        self.records.add_event(message.kind, self.code, trial, k=None, data=message.data)
        return None


def _is_finished(entry: TrialRecord) -> bool:
    """Return True if a trial is over and counts; a trial that was broken off is repeated."""
    return entry.ended is not None and entry.end != End.BROKEN_OFF


def _require_running_trial(entry: TrialRecord | None) -> TrialRecord:
    if entry is None or entry.ended is not None:
        raise InputError("no trial is in progress")
    return entry


def message_quota_bytes(protocol: Protocol) -> int:
    """Return the number of message bytes that a session may send: enough for eight hours of steering, and at least 16 MiB."""
    numbers_per_cycle = protocol.arm.n + protocol.rows.m + 1
    return max(16 * 2**20, int(_MAX_SESSION_S * protocol.rate * (_BYTES_PER_CYCLE + _BYTES_PER_NUMBER * numbers_per_cycle)))


def _build_plan(records: Records, row: int, number: int) -> messages.Plan:
    from holdfast.teleop.protocol.printed_arm import number_scenario_laws  # defines the indices of the laws in /arm.js

    protocol = records.protocol
    training = training_tasks(protocol, number)
    laws = number_scenario_laws(protocol)
    failed = protocol.scenarios[find_training_scenario(protocol)].failed
    order = protocol.session_order(row, number)
    tasks = protocol.tasks
    return messages.Plan(
        training=[
            messages.TrainingTask(
                q0=training.q0[index].tolist(),
                target=training.target[index].tolist(),
                joint=int(training.joint[index]) if failed else -1,
            )
            for index in range(len(training))
        ],
        trials=[
            messages.PlannedTrial(
                task=task,
                law=laws[scenario],
                q0=tasks.q0[task].tolist(),
                target=tasks.target[task].tolist(),
                joint=int(tasks.joint[task]) if protocol.scenarios[scenario].failed else -1,
            )
            for task, scenario in order.tolist()
        ],
    )
