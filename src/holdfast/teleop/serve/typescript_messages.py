"""The messages as TypeScript: ``python -m holdfast.teleop.serve.typescript_messages`` writes page/src/messages.ts."""

from __future__ import annotations

import types
from pathlib import Path
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel

from holdfast.teleop.serve import messages

_PLAIN = {str: "string", int: "number", float: "number", bool: "boolean", type(None): "null"}
_FROM_PAGE = (
    messages.Hello,
    messages.AnswersMessage,
    messages.Begin,
    messages.Cycles,
    messages.EndMessage,
    messages.Rate,
    messages.EventMessage,
)
_PARTS = (messages.TrainingTask, messages.PlannedTrial, messages.Plan, messages.Done)
_FROM_SERVER = (messages.Welcome, messages.Ack, messages.Refused, messages.Pause, messages.Unstored, messages.Bye)
_HEAD = (
    "// Generated from src/holdfast/teleop/serve/messages.py by "
    '"python -m holdfast.teleop.serve.typescript_messages"; do not edit.\n'
)


def typescript() -> str:
    """The text of ``messages.ts``: an interface for each message, and the two unions."""
    parts = [
        _HEAD,
        f"export const FORMAT = {messages.FORMAT};\n"
        f"export const MOST_CYCLES = {messages.MOST_CYCLES}; // in one message\n"
        f"export const MOST_BYTES = {messages.MOST_BYTES}; // of one message\n",
        *(_interface(model) for model in (*_FROM_PAGE, *_PARTS, *_FROM_SERVER)),
        f"export type FromPage = {' | '.join(m.__name__ for m in _FROM_PAGE)};\n",
        f"export type FromServer = {' | '.join(m.__name__ for m in _FROM_SERVER)};\n",
    ]
    return "\n".join(parts)


def _interface(model: type[BaseModel]) -> str:
    about = " ".join((model.__doc__ or "").split())
    fields = "".join(f"  {name}: {_type(field.annotation)};\n" for name, field in model.model_fields.items())
    return f"/** {about} */\nexport interface {model.__name__} {{\n{fields}}}\n"


def _type(annotation: Any) -> str:
    """A Python annotation in TypeScript."""
    if annotation in _PLAIN:
        return str(_PLAIN[annotation])
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return _type(arguments[0])
    if origin is Literal:
        return " | ".join(f'"{value}"' for value in arguments)
    if origin in (Union, types.UnionType):
        return " | ".join(dict.fromkeys(_type(a) for a in arguments))
    if origin is list:
        inner = _type(arguments[0])
        return f"({inner})[]" if " | " in inner else f"{inner}[]"
    if origin is dict:
        return f"Record<{_type(arguments[0])}, {_type(arguments[1])}>"
    assert issubclass(annotation, BaseModel), annotation
    return str(annotation.__name__)


if __name__ == "__main__":
    file = Path(__file__).parents[4] / "page" / "src" / "messages.ts"
    file.write_text(typescript(), encoding="utf-8")
    print(f"written: {file}")
