"""Layout of the help of a command: paragraphs, examples, and options in panels by topic."""

from __future__ import annotations

import re
from shutil import get_terminal_size
from typing import Any

from typer.core import TyperCommand, TyperGroup

from holdfast.interface.cli.completion import offer_names

_MIN_OPTIONS_FOR_PANELS = 8  # without --help
_PANEL_OPTIONS = {
    "Arm and environment": "base tip hold group xacro packages name tool mount gravity payload capsules radius meshes "
    "margin clearance cell",
    "Computation": "seed poses samples sampling restarts starts tries configurations points angles method time-limit threads "
    "workers local-searches check-poses designs chunk halvings store spacing metric",
    "Output": "out json csv rrd parquet plot report at-least",
}
_OTHER_MEANINGS = {("optimise", "--poses"), ("export", "--name")}  # commands whose option has no place in its panel
_PANEL_BY_OPTION = {f"--{name}": panel for panel, names in _PANEL_OPTIONS.items() for name in names.split()}
_TYPE_LABELS = {"bool": "", "int": "INTEGER", "float": "NUMBER", "list[float]": "NUMBER", "path": "PATH", "Path": "PATH"}


class PanelCommand(TyperCommand):
    """Command with its options in panels; lays out its help on request, and supports shell completion."""

    def __init__(self, name: str | None, **settings: Any) -> None:
        super().__init__(name, **settings)
        panels = {id(option): choose_panel(option, self) for option in self.params}
        self.params.sort(key=lambda option: [None, *_PANEL_OPTIONS].index(panels[id(option)]))

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help."""
        _lay_out_help(self, ctx)
        super().format_help(ctx, formatter)

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Parse the arguments like typer, after attaching name completion if a shell requests it."""
        if ctx.resilient_parsing:  # a shell requests completion
            offer_names(list(self.params))
        return super().parse_args(ctx, args)


class PanelGroup(TyperGroup):
    """Group of commands that lays out its help on request."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help."""
        _lay_out_help(self, ctx)
        super().format_help(ctx, formatter)


def choose_panel(option: Any, command: Any) -> str | None:
    """Return the panel of an option, for commands with many options."""
    has_panels = sum(parameter.param_type_name == "option" for parameter in command.params) >= _MIN_OPTIONS_FOR_PANELS
    belongs = has_panels and (command.name, option.opts[0]) not in _OTHER_MEANINGS
    return _PANEL_BY_OPTION.get(option.opts[0]) if belongs else None


def type_label(option: Any) -> str:
    """Return the type of an option's value in capitals, or an empty text for a flag."""
    return str(option.metavar or _TYPE_LABELS.get(option.bare_type(), "TEXT"))


def _lay_out_help(command: Any, ctx: Any) -> None:
    parameters = command.get_params(ctx)
    options = [parameter for parameter in parameters if parameter.param_type_name == "option"]
    for parameter in parameters:
        parameter.help = _escape_brackets(parameter.help or "")
        parameter.display_type_rich = lambda ctx: ""
    for parameter in options:
        parameter.display_type_rich = lambda ctx, label=type_label(parameter): label
        parameter.rich_help_panel = choose_panel(parameter, command)
    command.help = _escape_brackets(_reflow_help(command.help or ""))


def _reflow_help(text: str) -> str:
    """Join the lines of each paragraph, and format the examples for a shell."""
    paragraphs = [" ".join(paragraph.split()) for paragraph in text.split("\n\n")]
    examples = [paragraph.removeprefix("Example: ") for paragraph in paragraphs if paragraph.startswith("Example: ")]
    blocks = [paragraph for paragraph in paragraphs if not paragraph.startswith("Example: ")]
    if examples:
        blocks.append("\n".join([f"Example{'s' * (len(examples) > 1)}:", *map(_wrap_command, examples)]))
    return "\n\n".join(blocks)


def _wrap_command(text: str) -> str:
    """Wrap a command to the width of the terminal."""
    lines, max_letters = [""], get_terminal_size().columns - 6
    for word in re.findall(r"(?:\"[^\"]*\"|\S)+", text):
        if len(lines[-1]) + len(word) > max_letters:
            lines[-1] += "\\"
            lines.append("    ")
        lines[-1] += f"{word} "
    return "\n".join(map(str.rstrip, lines))


def _escape_brackets(text: str) -> str:
    """Escape brackets as in ``holdfast-arms[parquet]``, which rich would take for a style."""
    return re.sub(r"(?<!\\)\[(?=[a-zA-Z/@#])", r"\\[", text)
