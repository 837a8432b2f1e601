"""The command reference: a page for each command, written from the program itself before the pages are read.

Nothing in ``docs/commands`` is written by hand or kept in git. A page has the command's help, its examples and every option
with its default, under the panel in which ``--help`` has it; the role ``option`` refers to one, ``holdfast-assess --poses``.
``command-examples`` is the first example of each.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import typer
from docutils import nodes
from generated import keep
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from holdfast.interface.cli.layout import choose_panel, type_label
from holdfast.interface.cli.program import COMMAND_MODULES, PANEL_TITLES, build_app

EXAMPLE = re.compile(r"^Examples?:\s*", re.M)


def escaped(text: str) -> str:
    """Text that reStructuredText leaves alone."""
    return re.sub(r"([\\*`|_<>])", r"\\\1", " ".join(text.split()))


def paragraphs(text: str) -> Iterator[str]:
    """The help of a command: paragraphs, and examples as a terminal has them."""
    for part in re.split(r"\n\s*\n", text.replace("\b", "").strip()):
        if not EXAMPLE.match(part):
            yield escaped(part) + "\n"
            continue
        lines = [line.strip() for line in EXAMPLE.sub("", part).replace("\\\n", " ").splitlines()]
        shown = [f"$ {line}" if line.startswith("holdfast") else line for line in lines if line]
        yield ".. code-block:: console\n\n" + textwrap.indent("\n".join(shown), "   ") + "\n"


def default(parameter: Any, context: Any) -> str:
    """What holds if the option is not given, in the words of ``--help``."""
    if parameter.required:
        return "Required."
    value, shown = parameter.get_default(context), parameter.show_default
    if isinstance(shown, str):
        return f"Default: {escaped(shown)}."
    if "Default:" in (parameter.help or "") or value is None or value == () or (parameter.is_flag and not value):
        return ""
    return f"Default: ``{value}``."


def options(command: Any, context: Any, program: str) -> Iterator[str]:
    """Arguments, then options, in the panels of ``--help``."""
    yield f".. program:: {program}\n"
    shown: dict[str, list[Any]] = {"Arguments": [], "Options": []}
    for parameter in command.params:
        where = "Arguments" if parameter.param_type_name == "argument" else choose_panel(parameter, command) or "Options"
        if not parameter.hidden:
            shown.setdefault(where, []).append(parameter)
    for where, parameters in shown.items():
        if parameters:
            yield f".. rubric:: {where}\n"
        for parameter in parameters:
            yield described(parameter, context)


def described(parameter: Any, context: Any) -> str:
    """An argument or option with what it takes, what it is for, and its default."""
    if parameter.param_type_name == "argument":
        return f".. describe:: {parameter.metavar or parameter.name.upper()}\n\n   {escaped(parameter.help or '')}\n"
    value = "" if parameter.is_flag else f" {type_label(parameter)}"
    names = ", ".join([f"{name}{value}" for name in parameter.opts] + parameter.secondary_opts)
    words = " ".join(filter(None, [escaped(parameter.help or ""), default(parameter, context)]))
    return f".. option:: {names}\n\n   {words}\n"


def page(name: str, command: Any, context: Any, level: str = "=") -> Iterator[str]:
    """A command with all it takes; of a group its commands, each with a heading."""
    here = typer._click.Context(command, info_name=name, parent=context)
    title = here.command_path
    yield f"{title}\n{level * len(title)}\n"
    yield from paragraphs(command.help or "")
    commands = getattr(command, "commands", {})
    if not commands:
        usage = " ".join(command.collect_usage_pieces(here))
        yield f".. code-block:: text\n\n   {title} {usage}\n"
    yield from options(command, here, title.replace(" ", "-"))
    for sub, each in commands.items():
        yield from page(sub, each, here, "-")


def first(text: str, plain: bool = False) -> str:
    part = " ".join(re.split(r"\n\s*\n", text.strip())[0].split())
    return part if plain else escaped(part)


def written() -> dict[str, str]:
    """The text of every page by its name."""
    program = typer.main.get_command(build_app())
    context = typer._click.Context(program, info_name="holdfast")
    pages = {f"holdfast-{name}": "\n".join(page(name, command, context)) for name, command in program.commands.items()}
    index = ["Commands\n========\n", *paragraphs(program.help), "Every command has ``--help`` with an example.\n"]
    for folder, title in PANEL_TITLES.items():
        index += [f"{title}\n{'-' * len(title)}\n", ".. list-table::\n   :widths: 25 75\n"]
        for name in COMMAND_MODULES:
            if COMMAND_MODULES[name].startswith(f"{folder}."):
                index.append(f"   * - :doc:`{name} <holdfast-{name}>`\n     - {first(program.commands[name].help)}")
        index.append("")
    index += [".. toctree::\n   :hidden:\n", *(f"   {name} <holdfast-{name}>" for name in COMMAND_MODULES), ""]
    return {**pages, "index": "\n".join(index)}


class Examples(SphinxDirective):
    """The first example of every command, with what the command does."""

    def run(self) -> list[nodes.Node]:
        self.env.note_reread()  # what it shows is not in this page
        program = typer.main.get_command(build_app())
        lines = []
        for folder, title in PANEL_TITLES.items():
            lines += [f"**{title}**", "", ".. code-block:: sh", ""]
            for name in (name for name in COMMAND_MODULES if COMMAND_MODULES[name].startswith(f"{folder}.")):
                command = program.commands[name]
                for each in getattr(command, "commands", {name: command}).values():
                    example = EXAMPLE.split(each.help or "")[1:2]
                    shown = " ".join(example[0].split("\n\n")[0].split()) if example else ""
                    lines += [f"   # {first(each.help, plain=True)}", f"   {shown}", ""] if shown else []
            lines.append("")
        return self.parse_text_to_nodes("\n".join(lines))


def write(app: Sphinx) -> None:
    keep(Path(app.srcdir) / "commands", written())


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_directive("command-examples", Examples)
    app.connect("builder-inited", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
