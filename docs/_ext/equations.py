"""Equations of the papers and what computes them, from the docstrings: ``equations`` writes the list where it stands.

A docstring names an equation as people cite it, "Goel et al. 2005, eq. (18) to (20)", or "eq. (8)" alone where the docstring of
its class or module names one paper. Each equation is in the search index as somebody may type it.
"""

from __future__ import annotations

import ast
import inspect
import json
import re
import sys
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from docstrings import thing
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util.docutils import SphinxDirective

import holdfast

PAPERS = {  # as the list of references has them: how people write them, and the title
    "Abdi2012": ("Abdi 2012", "Abdi et al. 2012"),
    "English1998": ("English 1998", "English and Maciejewski 1998"),
    "Goel2003": ("Goel 2003", "Goel et al. 2003"),
    "Goel2005": ("Goel 2005", "Goel et al. 2005"),
}
CITED = re.compile(r"(Abdi|English|Goel)\b[^.;()]*?(?:et al\. )?\(?(1998|2003|2005|2012)\)?")
NUMBERS = re.compile(r"eq(?:\.|uations?)\s*(\(\d+\)(?:(?:,| and| to|-|, and)?\s*\(\d+\))*)")


def numbers(text: str) -> list[int]:
    """``(8), (9)`` and ``(18) to (20)``, written out."""
    found: list[int] = []
    for join, number in re.findall(r"( to |-)?\((\d+)\)", re.sub(r"\s+", " ", text)):
        found += range(found[-1] + 1, int(number) + 1) if join else [int(number)]
    return found


def cited(text: str) -> Iterator[tuple[str | None, int]]:
    """Every equation that a text names, with its paper if that is named before it."""
    paper = None
    for match in re.finditer(f"{CITED.pattern}|{NUMBERS.pattern}", " ".join(text.split())):
        if match[1]:
            paper = match[1] + match[2] if match[1] + match[2] in PAPERS else None
        else:
            yield from ((paper, number) for number in numbers(match[3]))


def only(text: str) -> str | None:
    """The paper of a text that names one."""
    papers = {author + year for author, year in CITED.findall(" ".join(text.split()))} & set(PAPERS)
    return papers.pop() if len(papers) == 1 else None


def public() -> Iterator[str]:
    """The full name of everything that a stub exports, and of what a class of these defines."""
    root = Path(holdfast.__file__).parent
    for stub in sorted(root.rglob("__init__.pyi")):
        package = ".".join(["holdfast", *stub.parent.relative_to(root).parts])
        for name in import_module(package).__all__:
            found = thing(f"{package}.{name}")
            if inspect.isfunction(found) or inspect.isclass(found):
                yield f"{package}.{name}"
            if inspect.isclass(found):
                yield from (f"{package}.{name}.{key}" for key in vars(found) if not key.startswith("_"))


def inner() -> Iterator[tuple[str, str, str]]:
    """Functions of modules whatever they are called: the name, its docstring, and that of its module."""
    root = Path(holdfast.__file__).parent
    for path in sorted(root.rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        tree = ast.parse(text) if "eq. (" in text else ast.Module([], [])
        for each in tree.body:
            if isinstance(each, ast.FunctionDef):
                name = ".".join(["holdfast", *path.relative_to(root).with_suffix("").parts, each.name])
                yield name, ast.get_docstring(each) or "", ast.get_docstring(tree) or ""


@cache
def table() -> dict[str, dict[int, dict[str, str]]]:
    """For each paper and equation the names of what computes it, with the first sentence of each."""
    out: dict[str, dict[int, dict[str, str]]] = {paper: defaultdict(dict) for paper in PAPERS}
    seen = set()
    for name in public():
        found = thing(name)
        found = found.fget if isinstance(found, property) else found
        text = inspect.getdoc(found)
        if id(found) in seen or not text or not callable(found):
            continue
        seen |= {id(found), f"{found.__module__}.{found.__qualname__}"}
        owner = inspect.getdoc(thing(name.rpartition(".")[0])) or ""
        module = sys.modules[found.__module__].__doc__ or ""
        for paper, number in cited(text):
            paper = paper or only(text) or only(owner) or only(module)
            if paper is not None:
                out[paper][number][f":py:obj:`{name}`"] = " ".join(text.split("\n\n")[0].split())
    for name, text, module in inner():
        for paper, number in cited(text) if name not in seen else ():
            paper = paper or only(text) or only(module)
            if paper is not None:
                out[paper][number][f"``{name}``, inside"] = " ".join(text.split("\n\n")[0].split())
    return out


def spellings(paper: str, number: int) -> Iterator[str]:
    """What somebody may type who looks for an equation."""
    forms = [f"eq. ({number})", f"eq. {number}", f"equation ({number})", f"equation {number}", f"({number})"]
    yield from (f"{who} {form}" for who in PAPERS[paper] for form in forms)
    yield from forms[:-1]


class Equations(SphinxDirective):
    def run(self) -> list[nodes.Node]:
        self.env.note_reread()  # what it shows is not in this page
        lines = []
        for paper, found in table().items():
            title = PAPERS[paper][1]
            lines += [title, "-" * len(title), "", ".. list-table::", "   :widths: 12 88", "   :class: equations", ""]
            for number, names in sorted(found.items()):
                lines += [
                    "   * - .. index::",
                    *(f"          ! {text}" for text in spellings(paper, number)),
                    "",
                    f"       \\({number})",
                ]
                about = [f"{name}: {text}" for name, text in sorted(names.items())]
                lines += [f"     - {about[0]}", *(line for text in about[1:] for line in ("", f"       {text}"))]
            lines.append("")
        return self.parse_text_to_nodes("\n".join(lines), allow_section_headings=True)


def check(app: Sphinx, exception: Exception | None) -> None:
    """The search finds every equation, however it is typed."""
    index = Path(app.outdir) / "searchindex.js"
    if exception is not None or not index.exists():
        return
    found = json.loads(index.read_text(encoding="utf-8").removeprefix("Search.setIndex(").removesuffix(")"))
    if len(found["docnames"]) < len(app.env.found_docs):  # some pages were built alone
        return
    entries = found["indexentries"]
    for paper, known in table().items():
        missing = [text for number in known for text in spellings(paper, number) if text.lower() not in entries]
        if missing:
            raise ExtensionError(f"the search does not find {missing[:3]}")


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_directive("equations", Equations)
    app.connect("build-finished", check)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
