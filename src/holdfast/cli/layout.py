"""How the help of a command is laid out: paragraphs, examples to copy, and options in panels by what they are about."""

from __future__ import annotations

import re
from shutil import get_terminal_size
from typing import Any

from typer.core import TyperCommand, TyperGroup

from holdfast.cli.completion import offer

_FEW = 8  # options that stay in one panel
_PANELS = {
    "The arm": "base tip hold name tool mount gravity payload capsules radius margin clearance cell",
    "How it is computed": "seed poses samples sampling restarts starts tries configurations points method time-limit threads "
    "climbs fresh designs chunk rotation spacing metric",
    "Output": "out json csv parquet plot at-least",
}
_PANEL = {f"--{name}": panel for panel, names in _PANELS.items() for name in names.split()}
_TYPES = {"bool": "", "int": "INTEGER", "float": "NUMBER", "list[float]": "NUMBER", "path": "PATH", "Path": "PATH"}


class LaidOut(TyperCommand):
    """A command with its options in panels, that lays out its help when it is asked for; and tells a shell what it takes."""

    def __init__(self, name: str | None, **settings: Any) -> None:
        super().__init__(name, **settings)
        panels = {id(each): panel(each, self) for each in self.params}
        self.params.sort(key=lambda each: [None, *_PANELS].index(panels[id(each)]))

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write it."""
        _lay_out(self, ctx)
        super().format_help(ctx, formatter)

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """As typer does."""
        if ctx.resilient_parsing:  # a shell asks
            offer(list(self.params))
        return super().parse_args(ctx, args)


class LaidOutGroup(TyperGroup):
    """A group of commands that does so."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write it."""
        _lay_out(self, ctx)
        super().format_help(ctx, formatter)


def panel(option: Any, command: Any) -> str | None:
    """The panel of an option: by what it is about, where a command has many."""
    many = sum(each.param_type_name == "option" for each in command.params) >= _FEW  # and --help
    return _PANEL.get(option.opts[0]) if many else None


def kind(option: Any) -> str:
    """What an option takes, in capitals; nothing where it takes nothing."""
    return str(option.metavar or _TYPES.get(option.bare_type(), "TEXT"))


def _lay_out(command: Any, ctx: Any) -> None:
    parameters = command.get_params(ctx)
    options = [each for each in parameters if each.param_type_name == "option"]
    for each in parameters:
        each.help = _literal(each.help or "")
        each.display_type_rich = lambda ctx: ""
    for each in options:
        each.display_type_rich = lambda ctx, shown=kind(each): shown
        each.rich_help_panel = panel(each, command)
    command.help = _literal(_flowing(command.help or ""))


def _flowing(text: str) -> str:
    """Paragraphs without the line ends of the source, and examples as a shell takes them."""
    paragraphs = [" ".join(each.split()) for each in text.split("\n\n")]
    examples = [each.removeprefix("Example: ") for each in paragraphs if each.startswith("Example: ")]
    said = [each for each in paragraphs if not each.startswith("Example: ")]
    if examples:
        said.append("\n".join([f"Example{'s' * (len(examples) > 1)}:", *map(_command, examples)]))
    return "\n\n".join(said)


def _command(text: str) -> str:
    """A command on lines that the window holds."""
    lines, most = [""], get_terminal_size().columns - 6
    for word in re.findall(r"(?:\"[^\"]*\"|\S)+", text):
        if len(lines[-1]) + len(word) > most:
            lines[-1] += "\\"
            lines.append("    ")
        lines[-1] += f"{word} "
    return "\n".join(map(str.rstrip, lines))


def _literal(text: str) -> str:
    """``holdfast[parquet]`` with its brackets, which rich would take for a style."""
    return re.sub(r"(?<!\\)\[(?=[a-zA-Z/@#])", r"\\[", text)
