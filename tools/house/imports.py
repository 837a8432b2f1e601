"""Which file imports which, lazy and type-only imports included, read from the text of the files."""

from __future__ import annotations

import ast
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class File:
    """A file of Python.

    Attributes:
        path: Where it is.
        package: Whether it is the ``__init__`` of a package.
        lines: How many it has.
        imports: What it imports anywhere, as ``(module, name or None)``.
        offers: The names that it imports when it is imported or type-checked, with their modules and names there.
        defines: The names that it defines itself, with where.
        public: The names of a package for its users: those of its stub, or else ``__all__``.
        docstrings: Of everything in it, those of attributes included.
        strings: All others, pieces of f-strings included.
    """

    path: Path
    package: bool
    lines: int = 0
    imports: list[tuple[str, str | None]] = field(default_factory=list)
    offers: dict[str, tuple[str, str]] = field(default_factory=dict)
    defines: dict[str, ast.stmt] = field(default_factory=dict)
    public: list[str] = field(default_factory=list)
    docstrings: list[str] = field(default_factory=list)
    strings: list[str] = field(default_factory=list)


def read(folder: Path, package: str) -> dict[str, File]:
    """The files of a package by module; a stub ``__init__.pyi`` says what the file beside it offers."""
    files = {}
    for path in sorted(folder.rglob("*.py")):
        parts = [package, *path.relative_to(folder).with_suffix("").parts]
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        made = files[name] = _file(path, name)
        if path.with_suffix(".pyi").exists():
            stub = _file(path.with_suffix(".pyi"), name)
            made.offers |= stub.offers
            made.public = sorted(stub.offers)
    for file in files.values():
        if "*" in file.offers:  # all that another package offers
            package_offered, _ = file.offers.pop("*")
            names = files[package_offered].public
            file.offers |= {name: (package_offered, name) for name in names}
            file.public = sorted({*file.public, *names} - {"*"})
    return files


def _file(path: Path, name: str) -> File:
    text = path.read_text(encoding="utf-8")
    tree = ast.parse(text)
    file = File(path, path.stem == "__init__", text.count("\n"))
    above = name.split(".") if file.package else name.split(".")[:-1]
    top = set(map(id, _top(tree.body)))
    documentation = set()
    for node in ast.walk(tree):  # parents before children
        if isinstance(node, ast.Constant):
            if isinstance(node.value, str):
                (file.docstrings if id(node) in documentation else file.strings).append(node.value)
        elif isinstance(node, ast.Expr):
            documentation.add(id(node.value))
        elif isinstance(node, ast.Import):
            file.imports += [(alias.name, None) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            module = node.module or ""
            if node.level:
                module = ".".join([*above[: len(above) + 1 - node.level], *([module] if module else [])])
            file.imports += [(module, alias.name) for alias in node.names]
            if id(node) in top:
                file.offers |= {alias.asname or alias.name: (module, alias.name) for alias in node.names}
        elif id(node) in top:
            file.defines |= dict.fromkeys(_named(node), node)
    listed = file.defines.get("__all__")
    if file.package and isinstance(listed, ast.Assign):
        file.public = ast.literal_eval(listed.value)
    return file


def _top(body: list[ast.stmt]) -> list[ast.stmt]:
    """The statements that run when the file is imported or type-checked, those of its ``if`` and ``try`` included."""
    found = []
    for node in body:
        if isinstance(node, ast.If | ast.Try):
            found += _top([*node.body, *node.orelse, *(line for each in getattr(node, "handlers", []) for line in each.body)])
        else:
            found.append(node)
    return found


def _named(node: ast.AST) -> list[str]:
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return [node.name]
    targets = node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AnnAssign) else []
    return [name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name)]


def home(files: dict[str, File], module: str, name: str | None) -> str | None:
    """The module of a name, followed through the packages that only offer it; None for what is not in ``files``."""
    seen = set()
    while name is not None and module in files and (module, name) not in seen:
        seen.add((module, name))
        if files[module].package and name in files[module].offers and files[module].offers[name] != (module, name):
            module, name = files[module].offers[name]
        elif f"{module}.{name}" in files:
            module, name = f"{module}.{name}", None
        else:
            name = None
    return module if module in files else None


def graph(files: dict[str, File]) -> dict[str, set[str]]:
    """What each module imports of the others; the packages around a module, which Python runs as well, are left aside."""
    homes = {name: {home(files, *each) for each in file.imports} for name, file in files.items()}
    return {name: {target for target in found if target is not None} - {name} for name, found in homes.items()}


def circles(imports: dict[str, set[str]]) -> list[list[str]]:
    """The groups of modules that import each other, directly or through others (strongly connected components; Tarjan 1972)."""
    number: dict[str, int] = {}
    lowest: dict[str, int] = {}
    stack: list[str] = []
    found = []

    def visit(name: str) -> None:
        number[name] = lowest[name] = len(number)
        stack.append(name)
        for target in sorted(imports[name]):
            if target not in number:
                visit(target)
            if target in stack:
                lowest[name] = min(lowest[name], lowest[target])
        if lowest[name] == number[name]:
            group = [stack.pop()]
            while group[-1] != name:
                group.append(stack.pop())
            if len(group) > 1:
                found.append(sorted(group))

    for name in sorted(imports):
        if name not in number:
            visit(name)
    return sorted(found)
