"""The program: its commands, and what it does when something is wrong."""

from __future__ import annotations

import sys
from typing import Annotated

import typer
from typer.exceptions import TyperException

from holdfast.cli import (
    arm_commands,
    assess_commands,
    compare_commands,
    configure_commands,
    design_commands,
    export_commands,
    follow_commands,
    index_commands,
    recover_commands,
    self_motion_commands,
    simulate_commands,
    stationary_commands,
    studio_commands,
    study_commands,
    susceptibility_commands,
    swing_commands,
    teleop_commands,
    trade_off_commands,
    workspace_commands,
)
from holdfast.errors import HoldfastError

app = typer.Typer(
    name="holdfast",
    help="Fault tolerance of redundant robot arms: what happens to the task when a joint fails.\n\n"
    "ARM is a built-in name (see 'holdfast arms'), a URDF or MJCF file, or a DH table in YAML. "
    "Joints are given by name, or by number from 1.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _version(value: bool) -> None:
    if value:
        from holdfast import __version__

        typer.echo(f"holdfast {__version__}")
        raise typer.Exit


@app.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    del version


arm_commands.add(app)
index_commands.add(app)
susceptibility_commands.add(app)
configure_commands.add(app)
assess_commands.add(app)
design_commands.add(app)
follow_commands.add(app)
swing_commands.add(app)
simulate_commands.add(app)
recover_commands.add(app)
compare_commands.add(app)
self_motion_commands.add(app)
workspace_commands.add(app)
stationary_commands.add(app)
trade_off_commands.add(app)
studio_commands.add(app)
study_commands.add(app)
teleop_commands.add(app)
export_commands.add(app)


def main() -> None:
    """Run the program: exit code 0 if it worked, 2 and one sentence on stderr if not, 130 if it was stopped."""
    try:
        code = app(standalone_mode=False)
    except HoldfastError as error:
        _fail(str(error))
    except TyperException as error:  # an unknown command or option, a missing argument
        context = getattr(error, "ctx", None)
        hint = f" (see '{context.command_path} --help')" if context is not None else ""
        message = getattr(error, "format_message", error.__str__)().rstrip(".")
        if not message:  # no arguments: the help was shown
            sys.exit(2)
        _fail(message + hint)
    except (KeyboardInterrupt, typer.Abort):
        typer.echo("holdfast: stopped", err=True)
        sys.exit(130)
    except SystemExit:  # typer's answer to a closed pipe: the reader, for example head, has seen enough
        sys.exit(0)
    except OSError as error:
        _fail(f"cannot write the output: {error.strerror or error}")
    if code == 130:
        typer.echo("holdfast: stopped", err=True)
    sys.exit(code if isinstance(code, int) else 0)


def _fail(message: str) -> None:
    typer.echo(f"holdfast: {message}", err=True)
    sys.exit(2)
