"""Pages that run what they show, so that no number in them can be out of date.

Every page has one Python session and one temporary folder, shared by its directives:

``run``: Python code and what it prints, the value of a last expression included; a figure is drawn, and ``:about:`` says
    for people who cannot see it what it shows. A page is shown in a frame.
``shell``: command lines (``$ ...``) and what they print; ``:exit:`` is the exit code expected (0), ``:head:`` the number
    of lines shown of each output.
``drawing``: a figure that ``docs/_figures`` draws, with its caption.
``file``: text that is shown and saved under the name given.
``module-example``: the example in a module's docstring.
``casadi-operations``: the CasADi operations that the compiled backend translates, found by trying.
``registered``: the documented constructors of a kind (``index``, ``law`` or ``susceptibility``).
``registry``: a table of all registered names of a kind.

The role ``cite`` refers to an entry of the list of references. ``-D live_run=0`` runs nothing, to look at pages while writing.
"""

from __future__ import annotations

import ast
import contextlib
import importlib
import inspect
import io
import os
import re
import shlex
import subprocess
import sys
import tempfile
import textwrap
import traceback
from functools import cache
from pathlib import Path
from typing import Any, ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from forked import Program
from pygments.lexers.special import TextLexer
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective, SphinxRole

from holdfast import registry

WIDTH = 92
TERMINAL: dict[str, Any] = {"drop_whitespace": True, "replace_whitespace": False, "break_on_hyphens": False, "tabsize": 8}

# What a person writes in CasADi; tried one by one when the pages are built.
SPELLINGS = """
a + b | a - b | -a | a * b | a / b | 1 / a | 2 * a | a**2 | a**3.5 | a**b
ca.sqrt(a) | ca.hypot(a, b) | ca.exp(a) | ca.expm1(a) | ca.log(a) | ca.log1p(a) | ca.erf(a)
ca.sin(a) | ca.cos(a) | ca.tan(a) | ca.asin(a) | ca.acos(a) | ca.atan(a) | ca.atan2(a, b)
ca.sinh(a) | ca.cosh(a) | ca.tanh(a) | ca.asinh(a) | ca.acosh(a) | ca.atanh(a)
a < b | a <= b | a == b | a != b | ca.logic_not(a) | ca.logic_and(a, b) | ca.logic_or(a, b) | ca.if_else(a < b, a, b)
ca.fabs(a) | ca.sign(a) | ca.fmin(a, b) | ca.fmax(a, b)
ca.floor(a) | ca.ceil(a) | ca.fmod(a, b) | ca.remainder(a, b) | ca.copysign(a, b) | ca.erfinv(a)
"""


def continued(command: str) -> list[str]:
    """A long command line on several, broken between its words as a shell reads them."""
    lines: list[str] = [""]
    for word in re.findall(r"""(?:"[^"]*"|'[^']*'|[^\s"'])+""", command):
        if lines[-1] and len(lines[-1]) + len(word) > WIDTH - 3:
            lines[-1] += " \\"
            lines.append("   ")
        lines[-1] += f" {word}" if lines[-1] else word
    return lines


def wrapped(text: str, width: int) -> list[str]:
    """The lines of a text as a window of this width has them."""
    return [part for line in text.rstrip().splitlines() for part in textwrap.wrap(line, width, **TERMINAL) or [""]]


def environment() -> dict[str, str]:
    """Of every command line."""
    path = str(Path(sys.executable).parent) + os.pathsep + os.environ.get("PATH", "")
    return {**os.environ, "PATH": path, "COLUMNS": str(WIDTH), "NO_COLOR": "1", "TERM": "dumb"}


@cache
def program(process: int) -> Program:
    """The program of a process: one that Sphinx forks to read pages has its own."""
    return Program(environment())


def executed(line: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """A command line, as a shell runs it."""
    words = list(shlex.shlex(line, posix=True, punctuation_chars=True))
    if words[0] == "holdfast" and not any(word[:1] in tuple("();<>|&") for word in words):
        return program(os.getpid())(shlex.split(line)[1:], folder)
    return subprocess.run(line, shell=True, cwd=folder, env=environment(), capture_output=True, text=True)


class _Live(SphinxDirective):
    has_content = True

    @property
    def folder(self) -> Path:
        made = self.env.temp_data.get("live-folder")
        if made is None:
            made = self.env.temp_data["live-folder"] = tempfile.TemporaryDirectory(prefix="holdfast-docs-")
        return Path(made.name)

    @property
    def names(self) -> dict[str, Any]:
        return self.env.temp_data.setdefault("live-names", {"__name__": "docs"})  # type: ignore[no-any-return]

    def block(self, text: str, language: str, kind: str) -> nodes.Node:
        node = nodes.literal_block(text, text, language=language, classes=[kind])
        self.set_source_info(node)
        return node


class Run(_Live):
    option_spec: ClassVar = {"about": directives.unchanged_required}

    def run(self) -> list[nodes.Node]:
        code = "\n".join(self.content)
        if not self.config.live_run:
            return [self.block(code, "python", "live-code")]
        out = io.StringIO()
        tree = ast.parse(code)
        last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        before, drawn = Path.cwd(), None
        try:
            os.chdir(self.folder)
            with contextlib.redirect_stdout(out):
                exec(compile(tree, self.env.docname, "exec"), self.names)
                if last is not None:
                    value = eval(compile(ast.Expression(last.value), self.env.docname, "eval"), self.names)
                    if hasattr(value, "savefig"):
                        drawn = self.drawn(value)
                    elif type(value).__name__ == "Html":
                        drawn = nodes.raw("", value._repr_html_(), format="html")
                    elif value is not None:
                        print(repr(value))
        except Exception as error:
            raise self.error(f"code of '{self.env.docname}' fails:\n{traceback.format_exc()}") from error
        finally:
            os.chdir(before)
        shown = [self.block(code, "python", "live-code")]
        if out.getvalue():
            shown.append(self.block("\n".join(wrapped(out.getvalue(), WIDTH - 8)), "text", "live-output"))
        return shown if drawn is None else [*shown, drawn]

    def drawn(self, figure: Any) -> nodes.Node:
        """A figure inside the page, so that there is no file to carry."""
        from holdfast.interface.report import svg

        if "about" not in self.options:
            raise self.error("a figure needs the option :about:, what it shows")
        number = self.env.temp_data["live-figures"] = self.env.temp_data.get("live-figures", 0) + 1
        picture = nodes.raw("", svg(figure, f"figure-{number}", self.options["about"]), format="html")
        return nodes.container("", picture, classes=["live-figure"])


class Drawing(SphinxDirective):
    """A figure of ``docs/_figures``: ``{drawing} MODULE.FUNCTION`` with its caption as the content."""

    required_arguments = 1
    has_content = True

    def run(self) -> list[nodes.Node]:
        from holdfast.interface.report import svg

        module, _, function = self.arguments[0].partition(".")
        caption = " ".join(self.content)
        picture: list[nodes.Node] = []
        if self.config.live_run:
            figure = getattr(importlib.import_module(module), function)()
            picture.append(nodes.raw("", svg(figure, self.arguments[0].replace(".", "-"), caption), format="html"))
        parsed, messages = self.parse_inline(caption)
        text = nodes.paragraph("", "", *parsed, classes=["drawing-caption"])
        return [nodes.container("", *picture, text, classes=["live-figure"]), *messages]


class Shell(_Live):
    option_spec: ClassVar = {"exit": int, "head": int}

    def run(self) -> list[nodes.Node]:
        if not self.config.live_run:
            return [self.block("\n".join(self.content), "console", "live-shell")]
        expected, head = self.options.get("exit", 0), self.options.get("head")
        shown = []
        for line in self.content:
            if not line.startswith("$ "):
                raise self.error(f"every line of a shell block must begin with '$ ', got: {line}")
            done = executed(line[2:], self.folder)
            if done.returncode != expected:
                raise self.error(f"'{line}' ended with {done.returncode} instead of {expected}:\n{done.stdout}{done.stderr}")
            lines = wrapped(done.stderr + done.stdout, WIDTH)
            if head is not None and len(lines) > head:
                lines = [*lines[:head], "..."]
            shown += [*continued(line), *lines]
        return [self.block("\n".join(shown), "console", "live-shell")]


class File(_Live):
    required_arguments = 1
    option_spec: ClassVar = {"language": directives.unchanged}

    def run(self) -> list[nodes.Node]:
        text = "\n".join(self.content)
        name = self.arguments[0]
        (self.folder / name).write_text(text + "\n", encoding="utf-8")
        default = {".yaml": "yaml", ".urdf": "xml", ".py": "python"}.get(Path(name).suffix, "text")
        caption = nodes.caption("", "", nodes.literal(name, name))
        box = nodes.container("", classes=["literal-block-wrapper"], literal_block=True)
        box += [caption, self.block(text, self.options.get("language", default), "live-file")]
        return [box]


class ModuleExample(SphinxDirective):
    """The indented example in the docstring of a module, so that a format is written down once."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        lines = inspect.getdoc(importlib.import_module(self.arguments[0])).splitlines()
        text = inspect.cleandoc("\n".join(x for x in lines if x.startswith("    ") or not x).strip("\n"))
        return [nodes.literal_block(text, text, language="yaml", classes=["module-example"])]


class CasadiOperations(SphinxDirective):
    def run(self) -> list[nodes.Node]:
        import casadi as ca

        from holdfast import KernelError
        from holdfast.kernels import Kernel

        names = {"a": ca.SX.sym("a"), "b": ca.SX.sym("b"), "ca": ca}
        have, lack = [], []
        for spelling in SPELLINGS.replace("\n", "|").split("|"):
            if not spelling.strip():
                continue
            operation = eval(spelling.strip(), names)
            try:
                Kernel("operation", [names["a"], names["b"]], [operation], backend="llvm")(0.5, 0.5)
                have.append(spelling.strip())
            except KernelError:
                lack.append(spelling.strip())
        return [_codes(have), nodes.paragraph("", "Not available:"), _codes(lack)]


def registry_of_kind(kind: str) -> registry.Registry:
    """The registry of indices, control laws, or susceptibilities."""
    registries = {
        "index": registry.INDEX_REGISTRY,
        "law": registry.LAW_REGISTRY,
        "susceptibility": registry.SUSCEPTIBILITY_REGISTRY,
    }
    return registries[kind]


class Registered(SphinxDirective):
    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        known = registry_of_kind(self.arguments[0])
        formulas = any(entry.formula for entry in known.values())
        lines = ["| name | equation | |", "|---|---|---|"] if formulas else ["| name | |", "|---|---|"]
        for entry in known.values():
            settings = "".join(f"<br>`{p.name}`: {p.describe()}" for p in entry.parameters)
            formula = [entry.formula] if formulas else []
            lines.append(" | ".join(["", f"`{entry.usage}`", *formula, entry.help + settings, ""]).strip())
        return self.parse_text_to_nodes("\n".join(lines))


class Constructors(SphinxDirective):
    """The constructors of everything that is registered, documented."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        known = registry_of_kind(self.arguments[0])
        text = "\n\n".join(f".. autofunction:: {known.package}.{entry.function}" for entry in known.values())
        return self.parse_text_to_nodes(text)


class FaultKinds(SphinxDirective):
    """The constructors of all kinds of faults, documented."""

    def run(self) -> list[nodes.Node]:
        from holdfast.response.faults import KINDS

        return self.parse_text_to_nodes("\n\n".join(f".. autofunction:: holdfast.response.faults.{name}" for name in KINDS))


def _codes(texts: list[str]) -> nodes.Node:
    items = nodes.bullet_list(classes=["operations"])
    for text in texts:
        items += nodes.list_item("", nodes.paragraph("", "", nodes.literal(text, text)))
    return items


class Cite(SphinxRole):
    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        reference = addnodes.pending_xref(
            "", nodes.inline("", f"[{self.text}]"), refdomain="citation", reftype="ref", reftarget=self.text, refwarn=True
        )
        self.set_source_info(reference)
        self.env.get_domain("citation").note_citation_reference(reference)  # type: ignore[attr-defined]
        return [reference], []


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_config_value("live_run", True, "env", bool)
    app.add_lexer("mermaid", TextLexer)  # CONTRIBUTING has a diagram, which GitHub draws
    app.add_directive("run", Run)
    app.add_directive("drawing", Drawing)
    app.add_directive("shell", Shell)
    app.add_directive("file", File)
    app.add_directive("module-example", ModuleExample)
    app.add_directive("casadi-operations", CasadiOperations)
    app.add_directive("registry", Registered)
    app.add_directive("registered", Constructors)
    app.add_directive("fault-kinds", FaultKinds)
    app.add_role("cite", Cite())
    return {"parallel_read_safe": True, "parallel_write_safe": True}
