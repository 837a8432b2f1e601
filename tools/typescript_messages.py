"""Messages as TypeScript: ``python -m tools.typescript_messages`` writes page/src/messages.ts."""

from __future__ import annotations

import types
from pathlib import Path
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel

from holdfast.teleop.serve import messages

_PLAIN_TYPES = {str: "string", int: "number", float: "number", bool: "boolean", type(None): "null"}
_FROM_PAGE = (
    messages.Hello,
    messages.AnswersMessage,
    messages.Begin,
    messages.Cycles,
    messages.EndMessage,
    messages.Rate,
    messages.EventMessage,
)
_PART_MODELS = (messages.TrainingTask, messages.PlannedTrial, messages.Plan, messages.Done)
_FROM_SERVER = (messages.Welcome, messages.Ack, messages.Refused, messages.Pause, messages.Unstored, messages.Bye)
_FILE_HEADER = (
    '// Generated from src/holdfast/teleop/serve/messages.py by "python -m tools.typescript_messages"; do not edit.\n'
)


def format_messages() -> str:
    """Return the text of ``messages.ts``: an interface for each message, and the two unions."""
    parts = [
        _FILE_HEADER,
        f"export const FORMAT = {messages.MESSAGE_FORMAT};\n"
        f"export const MOST_CYCLES = {messages.MOST_CYCLES}; // in one message\n",
        *(_format_interface(model) for model in (*_FROM_PAGE, *_PART_MODELS, *_FROM_SERVER)),
        f"export type FromPage = {' | '.join(union_member.__name__ for union_member in _FROM_PAGE)};\n",
        f"export type FromServer = {' | '.join(union_member.__name__ for union_member in _FROM_SERVER)};\n",
    ]
    return "\n".join(parts)


def _format_interface(model: type[BaseModel]) -> str:
    description = " ".join((model.__doc__ or "").split())
    fields = "".join(f"  {name}: {_format_type(field.annotation)};\n" for name, field in model.model_fields.items())
    return f"/** {description} */\nexport interface {model.__name__} {{\n{fields}}}\n"


def _format_type(annotation: Any) -> str:
    """Return a Python annotation as TypeScript."""
    if annotation in _PLAIN_TYPES:
        return str(_PLAIN_TYPES[annotation])
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return _format_type(arguments[0])
    if origin is Literal:
        return " | ".join(f'"{value}"' for value in arguments)
    if origin in (Union, types.UnionType):
        return " | ".join(dict.fromkeys(_format_type(argument) for argument in arguments))
    if origin is list:
        item_type = _format_type(arguments[0])
        return f"({item_type})[]" if " | " in item_type else f"{item_type}[]"
    if origin is dict:
        return f"Record<{_format_type(arguments[0])}, {_format_type(arguments[1])}>"
    assert issubclass(annotation, BaseModel), annotation
    return str(annotation.__name__)


if __name__ == "__main__":
    file = Path(__file__).parents[1] / "page" / "src" / "messages.ts"
    file.write_text(format_messages(), encoding="utf-8")
    print(f"written: {file}")
