"""Annotations of checked functions: each is understood, and classes are compared, not their names."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import subprocess
import sys
from functools import cache
from typing import TYPE_CHECKING

import pytest

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.validation import check_arguments, read_kinds

if TYPE_CHECKING:
    from collections.abc import Iterator

# jax and torch may be missing
OPTIONAL_MODULES = {"holdfast.kernels.frameworks.jax_rows", "holdfast.kernels.frameworks.torch_rows"}


def functions_of(module: object) -> Iterator[object]:
    """Yield the functions and methods of a module, each with those that it wraps."""
    for thing in vars(module).values():
        for member in vars(thing).values() if inspect.isclass(thing) else [thing]:
            function = getattr(member, "__func__", member)
            while callable(function) and not inspect.isclass(function):
                yield function
                function = getattr(function, "__wrapped__", None)


@cache
def checked_functions() -> dict[str, object]:
    """Functions within :func:`check_arguments`, by their names with modules."""
    found = {}
    for module in pkgutil.walk_packages(hf.__path__, "holdfast."):
        if module.name.endswith("__main__") or module.name in OPTIONAL_MODULES:
            continue
        for function in functions_of(importlib.import_module(module.name)):
            if getattr(getattr(function, "__code__", None), "co_name", "") == "call_checked":
                wrapped = function.__wrapped__
                found[f"{wrapped.__module__}.{wrapped.__qualname__}"] = wrapped
    return found


def test_every_annotation_of_a_checked_function_is_understood():
    """An unknown annotation would leave its argument unchecked; write an alias on one line, and mark protocols."""
    functions = checked_functions()
    assert len(functions) > 150
    unknown = []
    for name, function in functions.items():
        for parameter in inspect.signature(function).parameters.values():
            try:
                for kind in read_kinds(function, parameter):
                    kind.accepts(object())  # a protocol must be runtime-checkable
            except (LookupError, SyntaxError, TypeError) as error:
                unknown.append(f"{name}: {parameter}: {error}")
    assert unknown == []


def test_only_what_takes_anything_is_unchecked():
    anything = {
        str(parameter.annotation)
        for function in checked_functions().values()
        for parameter in inspect.signature(function).parameters.values()
        if not read_kinds(function, parameter) and parameter.name not in ("self", "cls")
    }
    assert anything <= {"Any", "object"}


def test_a_class_of_the_same_name_is_refused():
    class Cell:
        pass

    with pytest.raises(InputError, match=r"check_cell: cell is <.*; it must be a Cell or text or a path"):
        hf.check_cell(Cell())


def test_a_path_of_the_end_effector_is_no_file_name(tmp_path):
    with pytest.raises(InputError, match="it must be a Path"):
        hf.paths.TimedPath(tmp_path, hf.paths.Constant(1.0))


@check_arguments
def take_unknown(value: Unheard, number: int) -> None:  # noqa: F821
    """Take an argument whose annotation names nothing."""


def test_an_unknown_annotation_leaves_its_argument_unchecked():
    take_unknown("anything", 1)
    with pytest.raises(InputError, match="number is 'one'; it must be a whole number"):
        take_unknown("anything", "one")


def test_a_check_imports_no_class():
    code = (
        "import sys, holdfast as hf\n"
        "arm = hf.arms.load('planar-3r')\n"
        "assess, before = hf.assess, set(sys.modules)\n"
        "try: assess(arm, region='everywhere')\n"
        "except hf.InputError as error: print(error, set(sys.modules) - before, sep='\\n')"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.splitlines() == ["assess: region is 'everywhere'; it must be a Region or None", "set()"]
