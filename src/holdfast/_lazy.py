"""Packages that import what they offer when it is first asked for, so that a program waits only for what it uses."""

from __future__ import annotations

import re
import sys
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import Any

_OFFERED = re.compile(r"^from ([\w.]+) import (\w+) as \2$", re.MULTILINE)


def offer(package: str) -> None:
    """Let a package offer its modules and the names that its stub ``__init__.pyi`` re-exports.

    The stub, a line ``from MODULE import NAME as NAME`` for each, is the only list of what a package offers: type checkers
    and editors read it too. A function keeps its name when the module that is called like it (``assess``) is imported:
    Python would put the module in its place.

    Args:
        package: Its ``__name__``.
    """
    module = sys.modules[package]
    stub = Path(str(module.__file__)).with_suffix(".pyi").read_text(encoding="utf-8")
    homes = {name: home for home, name in _OFFERED.findall(stub)}
    module.__dict__.update(_homes=homes, __all__=sorted(homes))
    module.__class__ = _Lazy


class _Lazy(ModuleType):
    _homes: dict[str, str]

    def __getattr__(self, name: str) -> Any:
        home = self._homes.get(name, self.__name__)
        if home != self.__name__:
            value = getattr(import_module(home), name)
        elif not name.startswith("_") and find_spec(f"{home}.{name}") is not None:
            value = import_module(f"{home}.{name}")
        else:
            raise AttributeError(f"module '{home}' has no attribute '{name}'")
        setattr(self, name, value)
        return value

    def __setattr__(self, name: str, value: object) -> None:
        taken = name in self._homes and isinstance(value, ModuleType) and value.__name__ == f"{self.__name__}.{name}"
        if not taken or self._homes[name] == self.__name__:
            super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self.__all__})
