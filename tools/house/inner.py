"""What papers, benchmarks, documentation and examples use of holdfast that none of its packages offers."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from tools.house.imports import File

FOLDERS = ("benchmarks", "docs", "examples", "papers", "tools/recorded")
# Runs checkouts of any age in turn, each by the names that it had: their inner modules included.
OLD = {"benchmarks/side_by_side.py"}
# Measures planners with parts of the planner of holdfast in their place, so it uses inner modules as measurements do.
PARTS = "benchmarks/planners/"
_BLOCK = re.compile(r"^```(?:python|\{run\})\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_OPTION = re.compile(r"^:.*\n", re.MULTILINE)
_OF_THE_SOURCE = ("# src/", "# tests/")  # a block that shows a file of holdfast itself


def sources(root: Path) -> Iterator[tuple[str, str]]:
    """Python of users: where it is, and the text; of a page each block."""
    paths = [root / "README.md", *(path for folder in FOLDERS for path in sorted((root / folder).rglob("*")))]
    for path in paths:
        inside = path.relative_to(root)  # the checkout itself may lie anywhere
        name = inside.as_posix()
        if (
            path.suffix not in (".py", ".md")
            or name in OLD
            or name.startswith(PARTS)
            or {"_build", "gallery"} & set(inside.parts)
            or not path.exists()
        ):
            continue
        text = path.read_text(encoding="utf-8")
        blocks = [text] if path.suffix == ".py" else [_OPTION.sub("", found) for found in _BLOCK.findall(text)]
        yield from ((name, block) for block in blocks if not block.startswith(_OF_THE_SOURCE))


def inner_names(root: Path, files: dict[str, File]) -> dict[str, int]:
    """Each inner name with the file that uses it: a module is public if it is a package with public names, or one of them."""
    found, known = set(), dict[str, dict[str, str]]()
    for where, text in sources(root):
        names = known.setdefault(where, {})  # a page goes on with the imports of its blocks before
        found |= {f"{where}: {name}" for name in _inner(text, names, files)}
    return dict.fromkeys(sorted(found), 1)


def _inner(text: str, names: dict[str, str], files: dict[str, File]) -> Iterator[str]:
    with suppress(SyntaxError):  # a piece of code, or no code at all
        nodes = list(ast.walk(ast.parse(text)))
        for node in nodes:
            if isinstance(node, ast.Import):
                for alias in node.names:
                    if alias.name == "holdfast" or alias.name.startswith("holdfast."):
                        names[alias.asname or "holdfast"] = alias.name if alias.asname else "holdfast"
                        yield from _beyond("holdfast", alias.name.split(".")[1:], files)
            elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "holdfast":
                for alias in node.names:
                    chain = f"{node.module}.{alias.name}"
                    names[alias.asname or alias.name] = chain
                    yield from _beyond("holdfast", chain.split(".")[1:], files)
            elif isinstance(node, ast.Constant) and isinstance(node.value, str) and "holdfast" in node.value:
                yield from _inner(node.value, {}, files)  # what another process runs
        for node in nodes:
            if isinstance(node, ast.Attribute):
                head, *chain = ast.unparse(node).split(".") if _plain(node) else [""]
                if head in names:
                    yield from _beyond("holdfast", [*names[head].split(".")[1:], *chain], files)


def _plain(node: ast.expr) -> bool:
    return isinstance(node, ast.Name) or (isinstance(node, ast.Attribute) and _plain(node.value))


def _beyond(module: str, chain: list[str], files: dict[str, File]) -> Iterator[str]:
    """The name up to where a chain of attributes leaves what is public; of a module that is offered all but ``_names`` is."""
    for name in chain:
        inner, file = f"{module}.{name}", files[module]
        if name in file.public:
            module = inner if inner in files else ".".join(file.offers.get(name, ("", "")))
        elif inner in files and files[inner].package:
            module = inner
        elif not name.startswith("__") and (inner in files or file.package or name.startswith("_")):
            yield inner
            return
        if module not in files:
            return  # no module: what it has is its own affair
