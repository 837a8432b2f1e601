"""One page a class: ``class-page`` takes the name and options of ``autoclass`` and leaves a line that links to the page.

The pages, in ``docs/api/classes``, are written before the others are read, and are not kept in git. ``api-summary`` is a table
of everything that its page describes, with the first sentence of each docstring.
"""

from __future__ import annotations

import inspect
import re
from pathlib import Path
from typing import Any, ClassVar

from docstrings import thing
from docutils import nodes
from docutils.parsers.rst import directives
from generated import keep
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util.docutils import SphinxDirective

DESCRIBED = re.compile(
    r"^\.\. (class-page|autofunction|autoclass|autoexception|automodule):: (\S+)\n(?:   :members: (.+)\n)?", re.M
)
ROLE = re.compile(r":(?:py:)?(?:func|class|meth|attr|obj|data|mod):`~?(?:[\w.]+\.)?(\w+)`")
ASKED = re.compile(r"^\.\. class-page:: (\S+)\n((?:   :.*\n)*)", re.M)


def summary(name: str) -> str:
    """The first sentence of a class's docstring, as reStructuredText."""
    found = thing(name)
    if found is None:
        raise ExtensionError(f"a page asks for the class '{name}', which is not there")
    return " ".join((inspect.getdoc(found) or "").split("\n\n")[0].split())


class ClassPage(SphinxDirective):
    required_arguments = 1
    option_spec: ClassVar = dict.fromkeys(
        ["members", "exclude-members", "inherited-members", "undoc-members", "show-inheritance"], directives.unchanged
    )

    def run(self) -> list[nodes.Node]:
        name = self.arguments[0]
        text = f":py:class:`~{name}`\n   {summary(name)}\n\n.. toctree::\n   :hidden:\n\n   classes/{name}\n"
        shown = self.parse_text_to_nodes(text)
        module, _, kind = name.rpartition(".")
        for each in shown:  # names in the sentence are those of the class, or beside it
            for reference in each.findall(addnodes.pending_xref):
                reference["py:module"], reference["py:class"] = module, kind
        return shown


def list_described_names(text: str) -> list[str]:
    """Return the names that the directives of a page describe, in their order."""
    names = []
    for directive, name, members in DESCRIBED.findall(text):
        if directive != "automodule":
            names.append(name)
        else:
            names += [f"{name}.{member.strip()}" for member in members.split(",") if member.strip()]
    return list(dict.fromkeys(names))


def extract_first_sentence(text: str) -> str:
    """Return the first sentence of a docstring's summary, with plain names in place of links."""
    sentence = re.split(r"(?<=[.])\s+(?=[A-Z`])", text)[0]
    return ROLE.sub(r"``\1``", sentence)


class ApiSummary(SphinxDirective):
    """Table of the names that the page describes."""

    def run(self) -> list[nodes.Node]:
        source = Path(self.env.doc2path(self.env.docname)).read_text(encoding="utf-8")
        rows = []
        for name in list_described_names(source):
            rows += [f"   * - :py:obj:`~{name}`", f"     - {extract_first_sentence(summary(name))}"]
        return self.parse_text_to_nodes("\n".join([".. list-table::", "   :widths: 35 65", "", *rows]))


def write(app: Sphinx) -> None:
    folder = Path(app.srcdir) / "api"
    pages = {}
    for source in sorted(folder.glob("*.md")):
        for name, options in ASKED.findall(source.read_text(encoding="utf-8")):
            title = name.rpartition(".")[2]
            pages[name] = f"{title}\n{'=' * len(title)}\n\n.. autoclass:: {name}\n{options}"
    keep(folder / "classes", pages)


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_directive("class-page", ClassPage)
    app.add_directive("api-summary", ApiSummary)
    app.connect("builder-inited", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
