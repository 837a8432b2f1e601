"""Packages that import what they offer when it is first asked for, so that a program waits only for what it uses."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import Any


def offer(package: str, names: Mapping[str, str]) -> None:
    """Let a package offer names of its modules, and the modules.

    A function keeps its name when the module that is called like it (``assess``) is imported: Python would put the module
    in its place.

    Args:
        package: Its ``__name__``; ``__all__`` says what it offers.
        names: Of each module, relative to the package (``.arm.poses`` is beside it), the names in it, separated by spaces.
    """
    module = sys.modules[package]
    module.__dict__["_homes"] = {name: home for home, several in names.items() for name in several.split()}
    module.__class__ = _OnDemand


class _OnDemand(ModuleType):
    _homes: dict[str, str]

    def __getattr__(self, name: str) -> Any:
        if name in self._homes:
            value = getattr(import_module(f".{self._homes[name]}", self.__name__), name)
        elif not name.startswith("_") and find_spec(f"{self.__name__}.{name}") is not None:
            value = import_module(f"{self.__name__}.{name}")
        else:
            raise AttributeError(f"module '{self.__name__}' has no attribute '{name}'")
        setattr(self, name, value)
        return value

    def __setattr__(self, name: str, value: object) -> None:
        taken = name in self._homes and isinstance(value, ModuleType) and value.__name__ == f"{self.__name__}.{name}"
        if not taken:
            super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self.__all__})
