"""One session over its messages: what each changes in the records, and what is refused.

A station keeps nothing between messages but the subject's code: everything else is in the records, so that a rolled back
transaction, or a killed server, leaves nothing behind that is not true.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatchmethod

import numpy as np

from holdfast.errors import InputError
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.entries import Entry, Kind, State, Who
from holdfast.teleop.records.file import now
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import Session, done, training_scenario, training_tasks
from holdfast.teleop.serve import messages
from holdfast.teleop.serve.messages import Ack, Bye, Hello, Refused, Sequenced, Welcome
from holdfast.teleop.trials.recordings import End

_ENDS = {"arrived": End.ARRIVED, "aborted": End.ABORTED, "time": End.TIME, "broken-off": End.BROKEN_OFF}
_ROUNDING = 1e-9  # of the stick's limit
_MOST_ANSWERS = 1000
_LONGEST = 8 * 3600  # s
_FRAME, _DIGITS = 80, 25  # bytes of a message about one cycle, and of each of its numbers


@dataclass(frozen=True)
class Taken:
    """What became of a message.

    Attributes:
        reply: To the page.
        entry: The trial that it was about, as it was before; None for none.
        finished: Number of the trial that it ended; None for none.
    """

    reply: Ack | Refused | Bye
    entry: Entry | None = None
    finished: int | None = None


@dataclass(frozen=True)
class Entered:
    """Who came in with a hello.

    Attributes:
        code: The subject.
        key: Of the session.
    """

    code: str
    key: str


def enter(records: Records, hello: Hello) -> Entered | Refused | Bye:
    """A page says hello: a new subject, or a session that is resumed.

    A code that is taken may be given again as long as nothing is on record of it: the page never saw the answer to its hello.
    """
    if hello.format != messages.FORMAT:
        reason = f"the page speaks format {hello.format} and the server {messages.FORMAT}; reload the page"
        return Refused(seq=None, reason=reason, last=0)
    key = hello.session
    if key is None and hello.fresh is not None and records.key_holder(hello.fresh) is not None:
        key = hello.fresh  # the answer to the first hello was lost
    if key is not None:
        code = records.key_holder(key)
        if code is None:
            return Bye(reason="this session is not known here: it was deleted, or given to another page")
        subject = records.subject(code)
        if subject.state == State.DROPPED:
            return Bye(reason=f"the session of {code} was ended by the experimenter")
        if subject.kind != hello.kind:
            return Bye(reason=f"the session of {code} is that of a {subject.kind} subject, and this page's is {hello.kind}")
        return Entered(code, key)
    try:
        with records.together():
            return _new(records, hello)
    except InputError as error:
        return Refused(seq=None, reason=str(error), last=0)


def _new(records: Records, hello: Hello) -> Entered:
    known = {s.code: s for s in records.subjects()}.get(hello.code or "")
    if known is None:
        known = records.add_subject(hello.code, Who(hello.kind))
    elif known.state != State.OPEN or known.kind != hello.kind or known.answers or records.last_seq(known.code):
        raise InputError(
            f"the session of {known.code} has begun already; give another code, or ask the experimenter to move it to this page"
        )
    return Entered(known.code, records.give_key(known.code, hello.fresh))


class Station:
    """One subject's session.

    Args:
        records: The records.
        code: The subject.
    """

    def __init__(self, records: Records, code: str) -> None:
        self.records, self.code = records, code

    def welcome(self, key: str, paused: bool) -> Welcome:
        """The answer to a hello."""
        records = self.records
        with records.together():
            subject = records.subject(self.code)
            training, trials = (done(records.entries(self.code, kind)) for kind in (Kind.TRAINING, Kind.TRIAL))
            over = Session(records, self.code).next() is None
            latest = records.latest(self.code)
        return Welcome(
            session=key,
            subject=self.code,
            seq=records.last_seq(self.code),
            plan=_plan(records, subject.row, subject.number),
            done=messages.Done(
                training=[records.count(e) if e.end == End.ARRIVED else None for e in training], trials=len(trials)
            ),
            unrated=latest is not None and latest.kind == Kind.TRIAL and _finished(latest) and latest.rating is None,
            answered=[key for key in subject.answers if "." not in key],
            paused=paused,
            over=over,
        )

    def take(self, message: Sequenced, size: int = 0) -> Taken:
        """Apply a message of so many bytes; all of it is in the records, with its number, or nothing."""
        records = self.records
        try:
            subject = records.subject(self.code)
        except InputError:
            return Taken(Bye(reason="this session was deleted"))
        if subject.state == State.DROPPED:
            return Taken(Bye(reason=f"the session of {self.code} was ended by the experimenter"))
        last, seq = records.last_seq(self.code), message.seq
        most = quota(records.protocol)
        if records.received(self.code) + size > most:
            reason = f"the session has sent {most // 2**20} MiB, the most that one may; tell the experimenter"
            return Taken(Refused(seq=seq, reason=reason, last=last))
        if seq <= last:
            return Taken(Refused(seq=seq, reason=f"message {seq} is on record already", last=last))
        if seq > last + 1:
            return Taken(Refused(seq=seq, reason=f"message {seq} came, and {last + 1} is the next", last=last))
        entry = records.latest(self.code)
        try:
            with records.together():
                finished = self._apply(message, entry)
                records.set_last_seq(self.code, seq, size)
        except InputError as error:
            return Taken(Refused(seq=seq, reason=str(error), last=last))
        return Taken(Ack(seq=seq), entry, finished)

    # ---- each message ----------------------------------------------------------------------------------------------

    @singledispatchmethod
    def _apply(self, message: Sequenced, entry: Entry | None) -> int | None:
        """Change the records; the number of a trial that is over now."""
        raise AssertionError(message)

    @_apply.register
    def _(self, message: messages.AnswersMessage, entry: Entry | None) -> int | None:
        # The newest answers are the subject's; the events keep all of them, also where a form is filled in twice.
        subject = self.records.subject(self.code)
        said = {f"{message.form}.{key}": value for key, value in message.answers.items()}
        earlier = {key: value for key, value in subject.answers.items() if key.split(".")[0] != message.form}
        if len(earlier) + len(said) > _MOST_ANSWERS:
            raise InputError(f"a subject has at most {_MOST_ANSWERS} answers")
        self.records.set_answers(self.code, {**earlier, message.form: now(), **said})
        self.records.event("answers", self.code, None, k=None, data={"form": message.form, **said})
        return None

    @_apply.register
    def _(self, message: messages.Begin, entry: Entry | None) -> int | None:
        todo = Session(self.records, self.code).next()
        if todo is None:
            raise InputError("the session is over; there is no trial to begin")
        if (todo.kind, todo.position) != (message.kind, message.position):
            raise InputError(
                f"{message.kind} {message.position + 1} was begun, and {todo.kind.value} {todo.position + 1} is the next"
            )
        self.records.begin_trial(self.code, todo.kind, todo.position, scenario=todo.scenario, tasks=todo.tasks, task=todo.task)
        return None

    @_apply.register
    def _(self, message: messages.Cycles, entry: Entry | None) -> int | None:
        trial = _under_way(entry)
        protocol = self.records.protocol
        n, m = protocol.arm.n, protocol.rows.m
        if {len(v) for v in message.velocity} != {m} or {len(q) for q in message.q} != {n}:
            raise InputError(f"each cycle needs a command of {m} numbers and a configuration of {n}")
        velocity = np.array(message.velocity)
        fastest = float(np.linalg.norm(velocity, axis=1).max())
        if fastest > protocol.stick.limit * (1 + _ROUNDING):
            raise InputError(f"a command of {fastest:g} m/cycle is beyond the stick's limit of {protocol.stick.limit:g}")
        if protocol.cycle_limit is not None and message.first + len(velocity) > protocol.cycle_limit:
            raise InputError(f"a trial has at most {protocol.cycle_limit} cycles")
        self.records.append(trial.id, message.first, np.array(message.time), velocity=velocity, q=np.array(message.q))
        return None

    @_apply.register
    def _(self, message: messages.EndMessage, entry: Entry | None) -> int | None:
        trial = _under_way(entry)
        protocol = self.records.protocol
        if len(message.q) != protocol.arm.n:
            raise InputError(f"the end of a trial needs a configuration of {protocol.arm.n} numbers")
        if message.end == "time" and self.records.count(trial) != protocol.cycle_limit:
            raise InputError("the time of this trial is not over")
        self.records.finish(trial.id, _ENDS[message.end], np.array(message.q))
        Session(self.records, self.code).next()  # after the last one the session is completed
        return trial.id

    @_apply.register
    def _(self, message: messages.Rate, entry: Entry | None) -> int | None:
        if entry is None or not _finished(entry):
            raise InputError("there is no finished trial to rate")
        if entry.kind == Kind.TRAINING:
            raise InputError("the last trial is one of the training, which has no rating")
        if entry.rating is not None:
            raise InputError("the trial has its rating already")
        self.records.rate(entry.id, message.rating, message.answers)
        return None

    @_apply.register
    def _(self, message: messages.EventMessage, entry: Entry | None) -> int | None:
        trial = None if entry is None or entry.ended is not None else entry.id
        self.records.event(message.kind, self.code, trial, k=None, data=message.data)
        return None


def _finished(entry: Entry) -> bool:
    """Whether a trial is over and counts: one that was broken off is done again."""
    return entry.ended is not None and entry.end != End.BROKEN_OFF


def _under_way(entry: Entry | None) -> Entry:
    if entry is None or entry.ended is not None:
        raise InputError("no trial is under way")
    return entry


def quota(protocol: Protocol) -> int:
    """How many bytes of messages a session may send: those of eight hours of steering, and 16 MiB at least."""
    numbers = protocol.arm.n + protocol.rows.m + 1
    return max(16 * 2**20, int(_LONGEST * protocol.rate * (_FRAME + _DIGITS * numbers)))


def _plan(records: Records, row: int, number: int) -> messages.Plan:
    from holdfast.teleop.protocol.printed_arm import law_of  # it knows how /arm.js counts them

    protocol = records.protocol
    training = training_tasks(protocol, number)
    laws = law_of(protocol)
    failed = protocol.scenarios[training_scenario(protocol)].failed
    order = protocol.session(row, number)
    tasks = protocol.tasks
    return messages.Plan(
        training=[
            messages.TrainingTask(
                q0=training.q0[k].tolist(), target=training.target[k].tolist(), joint=int(training.joint[k]) if failed else -1
            )
            for k in range(len(training))
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
