"""Conversion of the parameters of a command to typer options.

A parameter of type ``Annotated[int, "Help text."]`` becomes the option of the same name; the help shows a second text as the
default. A function before the texts is the callback of the option. A parameter whose type is a dataclass is a group: its fields
become options at the same place, with their defaults from the default of the parameter, or from the class if the parameter has
none.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import wraps
from inspect import Parameter, Signature, signature
from pathlib import Path
from typing import Annotated, Any, get_origin, get_type_hints

import typer

from holdfast.core.extras import require_module
from holdfast.core.labels import is_number


def require_matplotlib(option: typer.CallbackParam, path: Path | None) -> Path | None:
    """Check that the package that draws figures is installed if ``path`` is given, before the command begins its work."""
    if path is not None:
        require_module("matplotlib", option.opts[0])
    return path


FigurePath = Annotated[Path | None, require_matplotlib]


def as_typer(command: Callable[..., Any]) -> Callable[..., Any]:
    """Return the command with separate options, each declared by ``typer.Option``."""
    if hasattr(command, "__signature__"):  # already converted
        return command
    options, groups = list[Parameter](), dict[str, tuple[Any, list[str]]]()
    for parameter in signature(command, eval_str=True).parameters.values():
        group = parameter.annotation
        if not is_dataclass(group):
            options.append(_declare_option(parameter.name, group, parameter.default))
            continue
        hints, names = get_type_hints(group, include_extras=True), [field.name for field in fields(group)]
        groups[parameter.name] = group, names
        group_default = group if parameter.default is Parameter.empty else parameter.default
        options += [_declare_option(name, hints[name], getattr(group_default, name, Parameter.empty)) for name in names]

    @wraps(command)
    def call_with_groups(**values: Any) -> Any:
        for name, (group, names) in groups.items():
            values[name] = group(**{field_name: values.pop(field_name) for field_name in names})
        return command(**values)

    call_with_groups.__annotations__ = {parameter.name: parameter.annotation for parameter in options}
    call_with_groups.__signature__ = Signature(options)  # type: ignore[attr-defined]
    return call_with_groups


def _declare_option(name: str, annotation: Any, default: Any) -> Parameter:
    if get_origin(annotation) is Annotated and isinstance(annotation.__metadata__[-1], str):
        callback = next(filter(callable, annotation.__metadata__), None)
        help_text, *default_text = filter(lambda item: item is not callback, annotation.__metadata__)
        number_settings: dict[str, Any] = {}
        if annotation.__origin__ in (int, int | None):
            number_settings = {"parser": read_whole_number, "metavar": "INTEGER"}
        option = typer.Option(
            f"--{name.strip('_').replace('_', '-')}",
            help=help_text,
            callback=callback,
            show_default=default_text[0] if default_text else True,
            **number_settings,
        )
        annotation = Annotated[annotation.__origin__, option]
    return Parameter(name, Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


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
