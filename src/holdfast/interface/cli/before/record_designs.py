"""``holdfast record-designs``: list, show, check."""

from __future__ import annotations

from typing import Annotated

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.cli.declaration import FigurePath
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.options import NOT_MET_EXIT_CODE, ArmArgument, JsonOption
from holdfast.interface.cli.values import read_configuration
from holdfast.interface.presentation.results import print_result, print_results

command = typer.Typer(
    name="record-designs", help="Browse, check and submit the best known arms and null spaces.", no_args_is_help=True
)

NameArgument = Annotated[str, typer.Argument(metavar="RECORD", help="Id of a record, or a record file.")]


@command.command("list")
def list_(
    out: Annotated[FigurePath, "Folder for an HTML page with pictures, and for each record as YAML and URDF."] = None,
    json_: JsonOption = False,
) -> None:
    """List the best known arms with their upper bounds.

    Example: holdfast record-designs list
    """
    record_book = hf.designs.record_designs()
    print_result(record_book, json_, [] if out is None else record_book.save(out)[-1:])


@command.command()
def show(
    record: NameArgument, urdf: Annotated[bool, "Print the arm as URDF, for simulators, instead of YAML."] = False
) -> None:
    """Print one record as YAML or URDF.

    Example: holdfast record-designs show pose-9R-k2-001
    """
    best_known = hf.designs.record_design(record)
    typer.echo(best_known.urdf() if urdf else best_known.text, nl=False)


@command.command()
def new(
    arm: ArmArgument,
    task: Annotated[str, "Task of the record: planar, position or pose."] = "pose",
    failures: Annotated[int, "Number of joints that lock at once."] = 1,
    at: Annotated[str | None, "Joint values in rad, separated by commas or spaces. Default: zeros."] = None,
    name: Annotated[str, "Id of the record. Default: derived from its class."] = "",
    by: Annotated[str, "Name of the finder."] = "anonymous",
    how: Annotated[str, "Method by which the arm was found, so that others can reproduce it. Default: not stated."] = "",
) -> None:
    """Create a record file for an arm.

    Example: holdfast record-designs new planar-3r --task planar --at "0 0.6 0.9"
    """
    model = ArmSourceOptions().resolve_arm(arm)
    q = None if at is None else read_configuration(model, at, False, "--at")
    typer.echo(hf.designs.new_record(model, task, failures, q=q, name=name, by=by, how=how).text, nl=False)


@command.command()
def check(
    record: Annotated[str | None, typer.Argument(metavar="RECORD", help="Id of a record, or a record file.")] = None,
    all_: Annotated[bool, "Check all stored records."] = False,
    json_: JsonOption = False,
) -> None:
    """Recompute the value of a record with independent code.

    Exit code: 0 if every claim holds, else 3. A file is also compared with the current record of its class.

    Example: holdfast record-designs check pose-9R-k2-001
    """
    if (record is None) != all_:
        raise InputError("give either a record or --all")
    checks = [
        entry.check() for entry in (hf.designs.record_designs().values() if all_ else [hf.designs.record_design(str(record))])
    ]
    print_results(checks, json_)
    if not all(entry.ok for entry in checks):
        raise typer.Exit(NOT_MET_EXIT_CODE)
