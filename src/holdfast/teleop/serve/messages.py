"""Messages between page and server, defined once for both sides.

Every message is a JSON object with a ``type``. Unknown keys, NaN, and sizes beyond the bounds here are refused.
``page/src/messages.ts`` is printed from these models by ``python -m tools.typescript_messages``.

The page's messages after the first carry ``seq`` 1, 2, 3 ... of the session, whatever the connection; the server acknowledges
them when they are on the disk.
"""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError, model_validator

from holdfast.core.errors import InputError

MESSAGE_FORMAT = 1
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
    """Message with its own keys, no others, and finite numbers."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, frozen=True)


# ---- from the page -----------------------------------------------------------------------------------------------------


class Hello(Message):
    """First message of a connection: a new session, or one that is resumed.

    A new session may bring its key, ``fresh``: said again where the answer was lost, it resumes what was begun then.
    """

    type: Literal["hello"]
    format: Count
    session: Key | None
    code: Code | None
    kind: Literal["person", "simulated"]
    fresh: Key | None = None


class AnswersMessage(Message):
    """Answers of a form."""

    type: Literal["answers"]
    seq: Seq
    form: Name
    answers: Answers


class Begin(Message):
    """Beginning of the next trial of the plan."""

    type: Literal["begin"]
    seq: Seq
    kind: Literal["training", "trial"]
    position: Count


class Cycles(Message):
    """Control cycles of the current trial: time (s since it began), commands, m/cycle, and joints when each cycle began."""

    type: Literal["cycles"]
    seq: Seq
    first: Count
    time: Annotated[list[Annotated[float, Field(ge=0, le=1e9)]], Field(min_length=1, max_length=MOST_CYCLES)]
    velocity: Annotated[list[Vector], Field(min_length=1, max_length=MOST_CYCLES)]
    q: Annotated[list[Vector], Field(min_length=1, max_length=MOST_CYCLES)]

    @model_validator(mode="after")
    def _check_equal_lengths(self) -> Self:
        if not len(self.time) == len(self.velocity) == len(self.q):
            raise ValueError("time, velocity and q must have as many entries")
        return self


class EndMessage(Message):
    """End of the current trial; ``q`` is the final configuration of the arm."""

    type: Literal["end"]
    seq: Seq
    end: Literal["arrived", "aborted", "time", "broken-off"]
    q: Vector


class Rate(Message):
    """Rating of the last trial, a step from 0."""

    type: Literal["rate"]
    seq: Seq
    rating: Annotated[int, Field(ge=0, le=1000)]
    answers: Answers


class EventMessage(Message):
    """Event in the page: dropped frames, a hidden tab, a lost gamepad."""

    type: Literal["event"]
    seq: Seq
    kind: Name
    data: Answers


# ---- from the server ---------------------------------------------------------------------------------------------------


class TrainingTask(Message):
    """Task of the training; ``joint`` as in a trial: -1 unless every scenario of the protocol has a failure."""

    q0: list[float]
    target: list[float]
    joint: int


class PlannedTrial(Message):
    """Trial of the plan; ``joint`` is the locked joint, from 0, or -1 for none; ``law`` is a code of the arm's, see /arm.js."""

    task: int
    law: int
    q0: list[float]
    target: list[float]
    joint: int


class Plan(Message):
    """Plan of the whole session, so that the page can continue without the network."""

    training: list[TrainingTask]
    trials: list[PlannedTrial]


class Done(Message):
    """Progress on record: cycles of each training task, null where it was not completed, and the number of trials."""

    training: list[int | None]
    trials: int


class Welcome(Message):
    """Answer to hello; ``seq`` is the last message on record, ``unrated`` is true if the last trial has no rating yet."""

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
    """Acknowledgement that all messages up to ``seq`` are on the disk."""

    type: Literal["ack"] = "ack"
    seq: int


class Refused(Message):
    """Refusal of a message that changed nothing, with the reason; ``last`` is the last on record. A ``seq`` up to ``last`` is
    on record already.
    """

    type: Literal["refused"] = "refused"
    seq: int | None
    reason: str
    last: int


class Pause(Message):
    """Message that the experimenter pauses the session after the current trial, or resumes it."""

    type: Literal["pause"] = "pause"
    paused: bool


class Unstored(Message):
    """Message that the records cannot be written: the disk is full, or the folder was deleted. Acknowledgements resume after
    welcome.
    """

    type: Literal["unstored"] = "unstored"


class Bye(Message):
    """Last message before the server closes the connection for good, with the reason; the page does not reconnect by itself."""

    type: Literal["bye"] = "bye"
    reason: str


Sequenced = AnswersMessage | Begin | Cycles | EndMessage | Rate | EventMessage
FromPage = Annotated[Hello | Sequenced, Field(discriminator="type")]

_FROM_PAGE: TypeAdapter[Hello | Sequenced] = TypeAdapter(FromPage)


def parse_message(text: str | bytes) -> Hello | Sequenced:
    """Parse a message of a page.

    Raises:
        InputError: It is malformed; the sentence says where.
    """
    try:
        return _FROM_PAGE.validate_json(text)
    except ValidationError as error:
        raise InputError(describe_error(error)) from None
    except ValueError as error:  # not Unicode
        raise InputError(f"the message is malformed: {error}") from None


def describe_error(error: ValidationError) -> str:
    """Describe the first error in a message; its content is not repeated, because it may be long, or not text."""
    first_error = error.errors(include_url=False, include_context=False, include_input=False)[0]
    location = ".".join(str(step) for step in first_error["loc"])[:100]
    return f"the message is malformed{f' at {location}' if location else ''}: {first_error['msg'][:200]}"
