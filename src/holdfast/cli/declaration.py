"""What a command declares, as typer takes it.

A parameter whose type is ``Annotated[int, "What it is for."]`` is the option of its name; a second text is what the help shows
as its default. One whose type is a dataclass is a group: the command takes the options that are its fields, at the same place,
with the values of its default as theirs, or with those of the class if it has none.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import wraps
from inspect import Parameter, Signature, signature
from typing import Annotated, Any, get_origin, get_type_hints

import typer

from holdfast.grammar import is_number


def as_typer(command: Callable[..., Any]) -> Callable[..., Any]:
    """The command with each option on its own, declared by ``typer.Option``."""
    if hasattr(command, "__signature__"):  # it is that already
        return command
    options, groups = list[Parameter](), dict[str, tuple[Any, list[str]]]()
    for each in signature(command, eval_str=True).parameters.values():
        group = each.annotation
        if not is_dataclass(group):
            options.append(_option(each.name, group, each.default))
            continue
        hints, names = get_type_hints(group, include_extras=True), [field.name for field in fields(group)]
        groups[each.name] = group, names
        given = group if each.default is Parameter.empty else each.default
        options += [_option(name, hints[name], getattr(given, name, Parameter.empty)) for name in names]

    @wraps(command)
    def whole(**given: Any) -> Any:
        for name, (group, names) in groups.items():
            given[name] = group(**{each: given.pop(each) for each in names})
        return command(**given)

    whole.__annotations__ = {each.name: each.annotation for each in options}
    whole.__signature__ = Signature(options)  # type: ignore[attr-defined]
    return whole


def _option(name: str, kind: Any, default: Any) -> Parameter:
    if get_origin(kind) is Annotated and isinstance(kind.__metadata__[0], str):
        about, *shown = kind.__metadata__
        whole: dict[str, Any] = {}
        if kind.__origin__ in (int, int | None):
            whole = {"parser": read_whole_number, "metavar": "INTEGER"}
        option = typer.Option(
            f"--{name.strip('_').replace('_', '-')}", help=about, show_default=shown[0] if shown else True, **whole
        )
        kind = Annotated[kind.__origin__, option]
    return Parameter(name, Parameter.KEYWORD_ONLY, default=default, annotation=kind)


def read_whole_number(text: str | int) -> int:
    """Read ``2000`` or ``1e7``.

    Raises:
        typer.BadParameter: The text is not a whole number.
    """
    try:
        return int(text)
    except ValueError:
        pass
    number = float(text) if is_number(str(text)) else math.nan
    if not number.is_integer():
        raise typer.BadParameter(f"'{text}' is not a whole number; write for example 2000 or 1e7")
    return int(number)
