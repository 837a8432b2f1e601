"""What page and server say to each other: one definition for both sides.

Every message is a JSON object with a ``type``. Unknown keys, NaN, and sizes beyond the bounds here are refused.
``page/src/messages.ts`` is printed from these models by :mod:`holdfast.teleop.serve.typescript_messages`.

The page's messages after the first carry ``seq`` 1, 2, 3 ... of the session, whatever the connection; the server acknowledges
them when they are on the disk.
"""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError, model_validator

from holdfast.errors import InputError

FORMAT = 1
MOST_CYCLES = 256  # in one message
MOST_BYTES = 128 * 1024  # of one message: the most cycles of an arm with 16 joints fit

Number = Annotated[float, Field(ge=-1e9, le=1e9)]
Count = Annotated[int, Field(ge=0, le=2**31)]
Seq = Annotated[int, Field(ge=1, le=2**53)]
Name = Annotated[str, Field(pattern=r"^[a-z][a-z0-9-]{0,39}$")]
Key = Annotated[str, Field(pattern=r"^[A-Za-z0-9_-]{16,64}$")]
Code = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_-]{0,39}$")]
Answer = Annotated[str, Field(max_length=4000)] | Number | bool
Answers = Annotated[dict[Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_.-]{0,63}$")], Answer], Field(max_length=100)]
Vector = Annotated[list[Number], Field(min_length=1, max_length=32)]


class Message(BaseModel):
    """A message: its keys, no others; numbers are finite."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)


# ---- from the page -----------------------------------------------------------------------------------------------------


class Hello(Message):
    """The first message of a connection: a new session, or one that is resumed.

    A new session may bring its key, ``fresh``: said again where the answer was lost, it resumes what was begun then.
    """

    type: Literal["hello"]
    format: Count
    session: Key | None
    code: Code | None
    kind: Literal["person", "simulated"]
    fresh: Key | None = None


class AnswersMessage(Message):
    """A form was filled in."""

    type: Literal["answers"]
    seq: Seq
    form: Name
    answers: Answers


class Begin(Message):
    """A trial begins: the next of the plan."""

    type: Literal["begin"]
    seq: Seq
    kind: Literal["training", "trial"]
    position: Count


class Cycles(Message):
    """Control cycles of the trial under way: when (s since it began), commands, m/cycle, and joints when each began."""

    type: Literal["cycles"]
    seq: Seq
    first: Count
    time: Annotated[list[Annotated[float, Field(ge=0, le=1e9)]], Field(min_length=1, max_length=MOST_CYCLES)]
    velocity: Annotated[list[Vector], Field(min_length=1, max_length=MOST_CYCLES)]
    q: Annotated[list[Vector], Field(min_length=1, max_length=MOST_CYCLES)]

    @model_validator(mode="after")
    def _as_many(self) -> Self:
        if not len(self.time) == len(self.velocity) == len(self.q):
            raise ValueError("time, velocity and q must have as many entries")
        return self


class EndMessage(Message):
    """The trial under way is over; ``q`` is where the arm is."""

    type: Literal["end"]
    seq: Seq
    end: Literal["arrived", "aborted", "time", "broken-off"]
    q: Vector


class Rate(Message):
    """The rating of the last trial, a step from 0."""

    type: Literal["rate"]
    seq: Seq
    rating: Annotated[int, Field(ge=0, le=1000)]
    answers: Answers


class EventMessage(Message):
    """Something happened in the page: dropped frames, a hidden tab, a lost pad."""

    type: Literal["event"]
    seq: Seq
    kind: Name
    data: Answers


# ---- from the server ---------------------------------------------------------------------------------------------------


class TrainingTask(Message):
    """A task of the training; ``joint`` as in a trial: -1 unless every scenario of the protocol has a failure."""

    q0: list[float]
    target: list[float]
    joint: int


class PlannedTrial(Message):
    """A trial; ``joint`` is the one that is locked in it, from 0, -1 for none; ``law`` is a code of the arm's, see /arm.js."""

    task: int
    law: int
    q0: list[float]
    target: list[float]
    joint: int


class Plan(Message):
    """The whole session, so that the page can continue without the network."""

    training: list[TrainingTask]
    trials: list[PlannedTrial]


class Done(Message):
    """What is on record: cycles of each training task, null where it was not completed, and how many trials."""

    training: list[int | None]
    trials: int


class Welcome(Message):
    """The answer to hello; ``seq`` is the last message on record, ``unrated`` says that the last trial has no rating yet."""

    type: Literal["welcome"] = "welcome"
    session: str
    subject: str
    seq: int
    plan: Plan
    done: Done
    unrated: bool
    answered: list[str]
    paused: bool
    over: bool


class Ack(Message):
    """All messages up to ``seq`` are on the disk."""

    type: Literal["ack"] = "ack"
    seq: int


class Refused(Message):
    """A message changed nothing, and why; ``last`` is the last on record. A ``seq`` up to ``last`` is on record already."""

    type: Literal["refused"] = "refused"
    seq: int | None
    reason: str
    last: int


class Pause(Message):
    """The experimenter stops the session after the trial under way, or resumes it."""

    type: Literal["pause"] = "pause"
    paused: bool


class Unstored(Message):
    """The records cannot be written: the disk is full, or the folder was deleted. Nothing more is acknowledged till welcome."""

    type: Literal["unstored"] = "unstored"


class Bye(Message):
    """The server closes the connection for good, and why; the page does not come back by itself."""

    type: Literal["bye"] = "bye"
    reason: str


Sequenced = AnswersMessage | Begin | Cycles | EndMessage | Rate | EventMessage
FromPage = Annotated[Hello | Sequenced, Field(discriminator="type")]

_FROM_PAGE: TypeAdapter[Hello | Sequenced] = TypeAdapter(FromPage)


def read(text: str | bytes) -> Hello | Sequenced:
    """A message of a page.

    Raises:
        InputError: It is malformed; the sentence says where.
    """
    try:
        return _FROM_PAGE.validate_json(text)
    except ValidationError as error:
        raise InputError(sentence(error)) from None
    except ValueError as error:  # not Unicode
        raise InputError(f"the message is malformed: {error}") from None


def sentence(error: ValidationError) -> str:
    """The first complaint about a message. What was sent is not repeated: it may be long, or not text."""
    first = error.errors(include_url=False, include_context=False, include_input=False)[0]
    place = ".".join(str(step) for step in first["loc"])[:100]
    return f"the message is malformed{f' at {place}' if place else ''}: {first['msg'][:200]}"
