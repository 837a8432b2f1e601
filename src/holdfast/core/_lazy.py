"""Packages that import a name only when it is first used, so that a program waits only for the names that it uses."""

from __future__ import annotations

import re
import sys
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from holdfast.core.renamed import find_successor

_OFFERED_NAME = re.compile(r"^from ([\w.]+) import (?:\*|(?:\(\s*)?(\w+) as \2\b)", re.MULTILINE)


def offer(package: str) -> None:
    """Let a package offer its modules and the names that its stub ``__init__.pyi`` re-exports.

    The stub is the only list of these names, and type checkers and editors read it too. It contains a line ``from MODULE import
    NAME as NAME`` for each name, or ``from PACKAGE import *`` for all names of another package. No module has the name of an
    object that its package offers, because Python would put the module in its place (``make house`` counts such cases).

    Args:
        package: ``__name__`` of the package.
    """
    module = sys.modules[package]
    homes = read_offered_names(package)

    def get(name: str) -> Any:
        home = homes.get(name, package)
        if home != package:
            value = getattr(import_module(home), name)
        elif not name.startswith("_") and find_spec(f"{home}.{name}") is not None:
            value = import_module(f"{home}.{name}")
        else:
            successor = find_successor(package, name)
            hint = f"; it is now {successor}" if successor else ""
            raise AttributeError(f"module '{package}' has no attribute '{name}'{hint}")
        setattr(module, name, value)
        return value

    vars(module).update(__all__=sorted(homes), __getattr__=get, __dir__=lambda: sorted({*vars(module), *homes}))


def read_offered_names(package: str) -> dict[str, str]:
    """Return the names that the stub of a package re-exports, each with the module that it comes from."""
    stub = Path(__file__).parents[2].joinpath(*package.split("."), "__init__.pyi").read_text(encoding="utf-8")
    homes: dict[str, str] = {}
    for home, name in _OFFERED_NAME.findall(stub):
        homes |= {name: home} if name else dict.fromkeys(read_offered_names(home), home)
    return homes
