"""Program with its commands, and its error handling."""

from __future__ import annotations

import os
import re
import shlex
import sys
from importlib import import_module
from io import BufferedWriter, FileIO, TextIOWrapper
from shutil import get_terminal_size
from textwrap import fill
from typing import Annotated, Any

import typer
from typer.exceptions import TyperException

from holdfast.core.errors import ArmError, HoldfastError
from holdfast.core.renamed import COMMAND_SUCCESSORS, OPTION_SUCCESSORS, REPOSITORY_COMMANDS
from holdfast.interface.cli.completion import find_command_name
from holdfast.interface.cli.declaration import as_typer
from holdfast.interface.cli.interrupt import STOPPED_EXIT_CODE
from holdfast.interface.cli.layout import PanelCommand, PanelGroup

PANEL_TITLES = {  # panels of the help in their order, by the folder of their commands
    "start": "Start here",
    "before": "Prepare for a failure",
    "unnoticed": "Undetected failures: simulate and diagnose",
    "known": "Known failures: recover",
    "larger": "Studies, experiments, export",
}
COMMAND_MODULES = {  # module of each command, in the order of the help; it defines `command`, or the name after the colon
    "assess": "start.assess",
    "page": "start.page",
    "studio": "start.studio",
    "describe": "start.arms:describe",
    "arms": "start.arms",
    "cell": "start.cell",
    "report": "start.assess:report",
    "index": "before.measures:index",
    "upper-bound": "before.upper_bound",
    "compare-arms": "before.compare_arms",
    "susceptibility": "before.measures:susceptibility",
    "holds": "before.holds",
    "stow": "before.stow",
    "optimise": "before.optimise",
    "follow": "before.follow",
    "plan-motion": "before.plan_motion",
    "certify": "before.certify",
    "certificate": "before.certificate",
    "trade-off": "before.measures:trade_off",
    "design": "before.design",
    "record-designs": "before.record_designs",
    "simulate": "unnoticed.simulate",
    "compare-laws": "unnoticed.compare_laws",
    "stationary-points": "unnoticed.equilibria:stationary_points",
    "basins": "unnoticed.equilibria:basins",
    "workspace": "unnoticed.workspace",
    "convergence-map": "unnoticed.convergence_map",
    "faults": "unnoticed.faults",
    "simulate-logs": "unnoticed.monitoring:simulate_logs",
    "calibrate": "unnoticed.monitoring:calibrate",
    "diagnose": "unnoticed.monitoring:diagnose",
    "predict-detection": "unnoticed.monitoring:predict_detection",
    "recover": "known.recover",
    "identify": "known.identify",
    "self-motion": "known.self_motion",
    "tolerant-workspace": "known.tolerant_workspace",
    "reachability-map": "known.reachability_map",
    "power-loss": "known.power_loss",
    "study": "larger.study",
    "teleop": "larger.teleop",
    "export": "larger.export",
}


class _OrderedGroup(PanelGroup):
    """Group that lists its commands in the order of the table; typer would list groups of commands last."""

    def list_commands(self, ctx: Any) -> list[str]:
        return [name for name in COMMAND_MODULES if name in self.commands]


def build_app(command: str | None = None) -> typer.Typer:
    """Build the program with all commands, or with ``command`` alone to save the time of the others."""
    app = typer.Typer(
        name="holdfast",
        cls=_OrderedGroup,
        help="Assess, prepare for, simulate, diagnose and recover from joint failures of redundant arms.\n\n"
        "ARM is a built-in name (see 'holdfast arms'), a URDF or MJCF file, or a DH table in YAML. "
        "Joints are given by name, or by number from 1.",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    app.callback()(_handle_root_options)
    for name in [command] if command in COMMAND_MODULES else COMMAND_MODULES:
        module, _, function = COMMAND_MODULES[name].partition(":")
        panel = PANEL_TITLES[module.partition(".")[0]]
        declared = getattr(import_module(f"holdfast.interface.cli.{module}"), function or "command")
        if isinstance(declared, typer.Typer):
            for subcommand in declared.registered_commands:
                subcommand.cls, subcommand.callback = PanelCommand, as_typer(subcommand.callback)  # type: ignore[arg-type]
            app.add_typer(declared, name=name, cls=PanelGroup, rich_help_panel=panel)
        else:
            app.command(name, rich_help_panel=panel, cls=PanelCommand)(as_typer(declared))
    return app


def _print_version(requested: bool) -> None:
    if requested:
        from holdfast import __version__

        typer.echo(f"holdfast {__version__}")
        raise typer.Exit


def _handle_root_options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    del version


class _PipeSafeOutput(FileIO):
    """Standard output that drops text after its reader has ended, so that the command keeps its own exit code."""

    def write(self, content: Any, /) -> int:
        """Write to the output, or discard the content once its reader has ended."""
        try:
            return super().write(content)
        except BrokenPipeError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
            return super().write(content)


def main() -> None:
    """Run the program; the exit code is 0 on success, 2 after an error (with a message on stderr), and 130 after Ctrl-C."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # for encodings with few characters, such as that of files on Windows
            stream.reconfigure(errors="backslashreplace")
    if isinstance(sys.stdout, TextIOWrapper) and sys.stdout is sys.__stdout__:
        original_output = sys.stdout
        sys.stdout = TextIOWrapper(
            BufferedWriter(_PipeSafeOutput(1, "w", closefd=False)),
            sys.stdout.encoding,
            "backslashreplace",
            line_buffering=sys.stdout.line_buffering,
        )
        original_output.flush()
    try:
        exit_code = build_app(find_command_name(sys.argv[1:]))(prog_name="holdfast", standalone_mode=False)
    except HoldfastError as error:
        _exit_with_error(f"{error}{_suggest_tip(error)}")
    except TyperException as error:  # for example an unknown command or a missing argument
        context = getattr(error, "ctx", None)
        hint = f" (see '{context.command_path} --help')" if context is not None else ""
        message = getattr(error, "format_message", error.__str__)().rstrip(".")
        if not message:  # without arguments, typer has shown the help
            sys.exit(2)
        _exit_with_error(message + (_format_renaming_hint(message) or hint))
    except (KeyboardInterrupt, typer.Abort):
        _exit_stopped()
    except ValueError as error:
        if type(error).__name__ != "LinAlgError":  # compared by name, so that not every command imports numpy
            raise
        from holdfast.core.validation import factorisation_message

        _exit_with_error(factorisation_message(error))
    except MemoryError as error:
        _exit_with_error(f"there is not enough memory ({error}); compute less at once")
    except SystemExit:  # raised by typer for a closed pipe, for example after head
        sys.exit(0)
    except OSError as error:
        # Python would write the rest of the buffer again at exit, and Python 3.13 exits with 120 if that fails.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        _exit_with_error(f"cannot write the output: {error.strerror or error}")
    if exit_code == STOPPED_EXIT_CODE:  # returned by typer after Ctrl-C
        _exit_stopped()
    sys.exit(exit_code if isinstance(exit_code, int) else 0)


def _format_renaming_hint(message: str) -> str:
    """Return the clause with the new name of a command or option that the error message calls unknown, or an empty text."""
    unknown = re.search(r"No such (?:command|option):? '?([\w-]+)", message)
    name = unknown.group(1) if unknown else ""
    if name in REPOSITORY_COMMANDS:
        return f"; it is now '{REPOSITORY_COMMANDS[name]}' in a checkout of the repository"
    successor = COMMAND_SUCCESSORS.get(name) or OPTION_SUCCESSORS.get(name)
    return f"; it is now '{successor}'" if successor else ""


def _exit_stopped() -> None:
    typer.echo("holdfast: stopped", err=True)
    sys.exit(STOPPED_EXIT_CODE)


def _suggest_tip(error: HoldfastError) -> str:
    """Return the command with an added --tip, if it is missing and the command names a single arm file."""
    arguments = sys.argv[1:]
    files = [position for position, word in enumerate(arguments) if word.lower().endswith((".urdf", ".xml", ".mjcf"))]
    if not isinstance(error, ArmError) or error.tip is None or len(files) != 1:
        return ""
    arguments[files[0] + 1 : files[0] + 1] = ["--tip", error.tip]
    return f", for example: holdfast {shlex.join(arguments)}"


def _exit_with_error(message: str) -> None:
    text = f"holdfast: {message}"
    if sys.stderr.isatty():  # a terminal would break a line inside a word
        text = fill(text, get_terminal_size().columns, break_long_words=False, break_on_hyphens=False)
    typer.echo(text, err=True)
    sys.exit(2)
