"""Shell completion for the names of arms, tasks, and registry entries."""

from __future__ import annotations

import os
from functools import partial
from typing import Any

from typer import core


def find_command_name(arguments: list[str]) -> str | None:
    """Return the command on the line; during completion the shell passes the line in the environment."""
    line = os.environ.get("COMP_WORDS", os.environ.get("_TYPER_COMPLETE_ARGS"))
    if "_HOLDFAST_COMPLETE" not in os.environ or line is None:
        return next(iter(arguments), None)
    typed_words = line.split()
    return typed_words[1] if len(typed_words) > 2 or (len(typed_words) == 2 and line[-1:].isspace()) else None


def offer_names(parameters: list[Any]) -> None:
    """Attach name completion to each parameter; files and folders are left to the shell."""
    for parameter in parameters:
        option = (parameter.metavar or "").strip("[].") if parameter.param_type_name == "argument" else parameter.opts[0]
        if option in _NAME_KINDS:
            parameter.shell_complete = partial(_complete_word, _NAME_KINDS[option].split())


def _complete_word(kinds: list[str], context: Any, word: str) -> list[Any]:
    item: Any = core.CompletionItem  # type: ignore[attr-defined]
    return [item(name) for kind in kinds for name in _list_names(kind) if name.startswith(word)]


_NAME_KINDS = {
    "ARM": "arms",
    "PROTOCOL": "protocols",
    "--arm": "arms",
    "--protocol": "protocols",
    "--task": "tasks",
    "--index": "indices",
    "--objective": "indices susceptibilities",
    "--minimise": "susceptibilities indices",
    "--maximise": "indices susceptibilities",
    "--susceptibility": "susceptibilities",
    "--measure": "susceptibilities",
    "--law": "laws",
}


def _list_names(kind: str) -> list[str]:
    from holdfast.core import labels, registry
    from holdfast.model import arms

    listings: dict[str, Any] = {
        "arms": arms.names,
        "protocols": lambda: ["goel2003", "goel2003-smooth"],
        "tasks": lambda: labels.TASK_SIZES,
        "indices": lambda: registry.INDEX_REGISTRY,
        "susceptibilities": lambda: registry.SUSCEPTIBILITY_REGISTRY,
        "laws": lambda: registry.LAW_REGISTRY,
    }
    return list(listings[kind]())
