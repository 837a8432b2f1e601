"""Indices in a user's own file, named ``module:function``, with a digest of their source."""

from __future__ import annotations

import ast
import hashlib
import importlib.util
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

from holdfast.core.errors import InputError, StoreError
from holdfast.kinematics.indices.formula import CustomIndex, Formula
from holdfast.kinematics.indices.index import Index
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.model.failure_modes import FailureSpec


class FileIndex(CustomIndex):
    """Index whose formula is a function of a Python file.

    Attributes:
        digest: SHA-256 of the source of the function and of all definitions in the file that it uses.
    """

    slug = ""

    def __init__(self, label: str, formula: Formula, digest: str, arm: Arm, task: Any, **options: Any) -> None:
        facts = {key: getattr(formula, key) for key in ("better", "unit", "bound") if hasattr(formula, key)}
        super().__init__(formula, arm, task, name=label, **facts, **options)
        self.slug, self.digest = label, digest

    def with_failures(self, failures: FailureSpec) -> FileIndex:
        """Return the same index over other failures; see :meth:`Index.with_failures`."""
        return FileIndex(self.slug, self._formula, self.digest, self.arm, self.task, failures=failures)


def load_index(
    arm: Arm,
    task: str | Task | Sequence[str] = "pose",
    *,
    function: str,
    failures: FailureSpec = "single",
    length: float | None = None,
) -> FileIndex:
    """Load the index ``module:function`` from the current folder, or else from an installed module.

    Raises:
        InputError: There is no such file or function, or the file raises an error.
    """
    module, _, name = function.partition(":")
    file = _find_module_file(module, function)
    try:
        text = file.read_text(encoding="utf-8")
        digest = source_digest(text, name)
        module_object = ModuleType(module)
        module_object.__file__ = str(file)
        sys.path.insert(0, str(Path.cwd()))
        try:
            exec(compile(text, file, "exec"), module_object.__dict__)
        finally:
            sys.path.remove(str(Path.cwd()))
    except Exception as error:  # a user's file may raise any error
        raise InputError(f"index '{function}': '{file.name}' cannot be run ({type(error).__name__}: {error})") from error
    formula = getattr(module_object, name, None)
    if not callable(formula):
        raise InputError(f"index '{function}': '{file.name}' has no function '{name}'; define it there")
    return FileIndex(function, formula, digest, arm, task, failures=failures, length=length)


def plan_entries(index: Index) -> dict[str, str]:
    """Return the entries of a stored plan that define an index: its label, and the digest of a function from a file."""
    return {"index": index.label} | ({"index_digest": index.digest} if isinstance(index, FileIndex) else {})


def check_function_digest(index: Index, plan: Mapping[str, Any]) -> None:
    """Compare the function of an index with the function of a stored plan.

    Raises:
        StoreError: The function differs.
    """
    if isinstance(index, FileIndex) and index.digest != plan["index_digest"]:
        raise StoreError(
            f"the function of index '{index.label}' has changed since these results were computed; restore it, or compute "
            "into a new folder"
        )


def _find_module_file(module: str, label: str) -> Path:
    if module.endswith(".py"):
        raise InputError(f"index '{label}' is written with the module, without .py: {label.replace('.py:', ':', 1)}")
    local = Path.cwd() / (module.replace(".", "/") + ".py")
    if local.is_file():
        return local
    try:
        spec = importlib.util.find_spec(module)
    except (ImportError, ValueError):
        spec = None
    if spec is None or spec.origin is None or not spec.origin.endswith(".py"):
        raise InputError(f"index '{label}' is not built in, and there is no '{local.name}' in the current folder; run it there")
    return Path(spec.origin)


def source_digest(text: str, name: str) -> str:
    """Return the SHA-256 of a function and of every statement of its file that it uses, directly or indirectly."""
    body = ast.parse(text).body
    needed, used_names = {name}, set[int]()
    while True:
        added = {k for k, node in enumerate(body) if k not in used_names and _concerns_names(node, needed)}
        if not added:
            break
        used_names |= added
        needed |= {x.id for k in added for x in ast.walk(body[k]) if isinstance(x, ast.Name)}
    parts = [ast.get_source_segment(text, body[k]) or "" for k in sorted(used_names)]
    parts += [ast.unparse(digest) for k in sorted(used_names) for digest in getattr(body[k], "decorator_list", [])]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def _concerns_names(node: ast.stmt, needed: set[str]) -> bool:
    """Return whether a statement defines or imports one of the names or, for any other statement, contains one."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        return node.name in needed
    if isinstance(node, ast.If) and "__name__" in ast.unparse(node.test):
        return False
    names = {x.id for x in ast.walk(node) if isinstance(x, ast.Name)}
    aliases = [x for x in ast.walk(node) if isinstance(x, ast.alias)]
    return bool(names & needed) or any(x.name == "*" or (x.asname or x.name.split(".")[0]) in needed for x in aliases)
