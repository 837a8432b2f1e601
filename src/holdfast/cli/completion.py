"""What a shell is offered when it asks how a word goes on: arms, tasks, and what the registry holds."""

from __future__ import annotations

import os
from functools import partial
from typing import Any

from typer import core


def asked(arguments: list[str]) -> str | None:
    """The command on the line; a shell that asks gives the line in its environment."""
    line = os.environ.get("COMP_WORDS", os.environ.get("_TYPER_COMPLETE_ARGS"))
    if "_HOLDFAST_COMPLETE" not in os.environ or line is None:
        return next(iter(arguments), None)
    words = line.split()
    return words[1] if len(words) > 2 or (len(words) == 2 and line[-1:].isspace()) else None


def offer(parameters: list[Any]) -> None:
    """Have each parameter offer the names that it takes; files and folders are left to the shell."""
    for each in parameters:
        what = (each.metavar or "").strip("[].") if each.param_type_name == "argument" else each.opts[0]
        if what in _NAMES:
            each.shell_complete = partial(_completed, _NAMES[what].split())


def _completed(kinds: list[str], context: Any, word: str) -> list[Any]:
    item: Any = core.CompletionItem  # type: ignore[attr-defined]
    return [item(name) for kind in kinds for name in _names(kind) if name.startswith(word)]


_NAMES = {
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


def _names(kind: str) -> list[str]:
    from holdfast import arms, grammar, registry

    known: dict[str, Any] = {
        "arms": arms.names,
        "protocols": lambda: ["goel2003", "goel2003-smooth"],
        "tasks": lambda: grammar.TASKS,
        "indices": lambda: registry.INDICES,
        "susceptibilities": lambda: registry.SUSCEPTIBILITIES,
        "laws": lambda: registry.LAWS,
    }
    return list(known[kind]())
