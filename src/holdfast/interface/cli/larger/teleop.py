"""``holdfast teleop``: an experiment from its protocol to the report."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from holdfast.core.errors import InputError, StoreError
from holdfast.core.files import reading
from holdfast.interface.cli.larger import teleop_serve, teleop_tasks
from holdfast.interface.cli.progress import show_status
from holdfast.interface.presentation.printing import make_console
from holdfast.interface.presentation.results import print_result
from holdfast.interface.presentation.teleop.console import show_allocation, show_experiment, show_protocol, show_subjects

DIFFERS_EXIT_CODE = 3  # exit code: the command worked, and a trial differs from its record

FolderArgument = Annotated[Path, typer.Argument(metavar="DIR", help="Folder of the experiment.")]
ProtocolArgument = Annotated[
    str, typer.Argument(metavar="PROTOCOL", help="Protocol: goel2003, goel2003-smooth, or a protocol file (YAML).")
]

command = typer.Typer(
    no_args_is_help=True, help="Run teleoperation experiments: tasks, sessions, records and statistics.", add_completion=False
)


@command.command()
def run(
    out: Annotated[Path, "Folder for the records; the same command resumes a stopped experiment."],
    simulated: Annotated[bool, "Use simulated operators (required)."] = False,
    operators: Annotated[int, typer.Option("--operators", min=1, help="Number of simulated operators.")] = 24,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed; the same seed gives the same experiment.")] = 0,
    protocol: Annotated[str, "Protocol: goel2003, goel2003-smooth, or a file (YAML)."] = "goel2003",
) -> None:
    """Run an experiment with simulated operators.

    Ctrl-C stops the run; the same command resumes it, with the same results.

    Example: holdfast teleop run --simulated --operators 24 --seed 1 --out experiment
    """
    if not simulated:
        raise InputError("--simulated is missing; add it, or use 'holdfast teleop serve --data DIR' for people in a browser")
    from holdfast.teleop import read_protocol, simulate_experiment

    with (
        show_status(f"compiling the laws of {protocol}") as update_status,
        simulate_experiment(out, read_protocol(protocol), operators, seed=seed, progress=update_status) as records,
    ):
        show_experiment(records, make_console())


@command.command()
def analyse(
    folder: FolderArgument,
    groups: Annotated[int, typer.Option("--groups", min=2, help="Number of difficulty groups.")] = 3,
    missing: Annotated[
        str,
        "Treatment of subjects without a completed trial in a cell of the design: refuse, complete (exclude such subjects) or "
        "mixed (a mixed model of single trials).",
    ] = "refuse",
    difficulty: Annotated[str, "Performance that sorts the tasks: operators (their median) or computer."] = "operators",
) -> None:
    """Compute the statistics and write a report.

    Example: holdfast teleop analyse experiment
    """
    from holdfast.teleop.analysis.eligibility import analyse_records
    from holdfast.teleop.records.tables import tool_paths
    from holdfast.teleop.records.verification import open_undamaged_records

    with open_undamaged_records(folder) as records, show_status("computing") as update_status:
        result = analyse_records(records, missing, groups, difficulty)  # type: ignore[arg-type]
        update_status("drawing")
        report = result.save(folder, records.protocol, tool_paths(records))[0]
    print_result(result, False)
    typer.echo(f"written: {report}, and {len(list(folder.glob('*.csv')))} CSV tables in the same folder")


@command.command()
def replay(folder: FolderArgument) -> None:
    """Replay recorded commands and compare the paths.

    Exit code: 0 if every path agrees with its record, else 3.

    Example: holdfast teleop replay experiment
    """
    from holdfast.teleop.records.check import replay_trials as again
    from holdfast.teleop.records.verification import open_undamaged_records

    with open_undamaged_records(folder) as records, show_status("replaying"):
        result = again(records)
    print_result(result, False)
    if result.differing_entries:
        raise typer.Exit(DIFFERS_EXIT_CODE)


@command.command()
def verify(folder: FolderArgument) -> None:
    """Check all records against their digests.

    Exit code: 0 if all digests agree, else 3. The first damaged trial is printed first.

    Example: holdfast teleop verify experiment
    """
    from holdfast.teleop.records.verification import verify_records as checked

    with show_status("comparing"):
        verification = checked(folder)
    for line in verification.describe():
        typer.echo(line)
    if verification.damages:
        raise typer.Exit(DIFFERS_EXIT_CODE)


@command.command()
def backup(
    folder: FolderArgument, out: Annotated[Path, typer.Argument(metavar="OUT", help="New folder for the copy.")]
) -> None:
    """Copy an experiment and verify the copy.

    The server of the experiment may run at the same time.

    Example: holdfast teleop backup experiment experiment-2026-11-22
    """
    from holdfast.teleop.records.copies import copy_experiment as copy

    with show_status("copying"):
        copied = copy(folder, out)
    typer.echo(f"written: {out}; sound: {copied.trials} trials, {copied.links} digests")


@command.command()
def export(
    folder: FolderArgument,
    out: Annotated[Path | None, "Folder for the tables.", "DIR/export"] = None,
    parquet: Annotated[bool, "Write Parquet instead of CSV (needs pyarrow)."] = False,
) -> None:
    """Export all tables with a data dictionary.

    Example: holdfast teleop export experiment
    """
    from holdfast.teleop.records.tables import export_tables as write
    from holdfast.teleop.records.verification import open_undamaged_records

    with open_undamaged_records(folder) as records, show_status("writing"):
        files = write(records, folder / "export" if out is None else out, parquet)
    for file in files:
        typer.echo(f"written: {file}")


@command.command()
def allocation(
    protocol: ProtocolArgument = "goel2003",
    subjects: Annotated[
        int | None,
        typer.Option("--subjects", min=1, help="Number of sheets, one per subject.", show_default="the protocol's number"),
    ] = None,
    out: Annotated[Path | None, "HTML file for sheets to print."] = None,
) -> None:
    """Print the task order of each subject.

    Example: holdfast teleop allocation --out allocation.html
    """
    from holdfast.teleop.protocol.protocol import read_protocol

    chosen = read_protocol(protocol)
    if out is not None:
        from holdfast.interface.presentation.teleop.allocation import write_allocation

        typer.echo(f"written: {write_allocation(chosen, out, subjects)}")
        return
    show_allocation(chosen, subjects, make_console())


@command.command()
def subjects(
    folder: FolderArgument,
    drop: Annotated[str | None, "Subject who will not come back; another subject gets the row."] = None,
    delete: Annotated[str | None, "Subject to delete permanently, with all recorded trials."] = None,
) -> None:
    """List, drop or delete subjects.

    Example: holdfast teleop subjects experiment
    """
    from holdfast.teleop.records.verification import open_undamaged_records

    if drop is not None and delete is not None:
        raise InputError("give --drop or --delete, not both")
    with open_undamaged_records(folder) as records:
        if delete is not None:
            count = len(records.entries(delete))
            records.delete_subject(delete)
            typer.echo(f"deleted: subject {delete} and {count} recorded trials; older exports and reports still contain them")
        if drop is not None:
            from holdfast.teleop.records.entries import SubjectState

            records.set_state(drop, SubjectState.DROPPED)
            typer.echo(f"dropped: subject {drop}; the recorded trials are kept")
        show_subjects(records, make_console())


@command.command("protocol")
def protocol_(
    protocol: ProtocolArgument = "goel2003",
    write: Annotated[Path | None, "File for a copy of the protocol, to be edited."] = None,
) -> None:
    """Check and summarise a protocol.

    Example: holdfast teleop protocol --write mine.yaml
    """
    from holdfast.teleop.protocol.protocol import read_protocol

    chosen = read_protocol(protocol)
    if write is not None and reading.path_exists(write):
        raise StoreError(f"--write: '{write}' exists already; choose another name")
    show_protocol(chosen, make_console())
    if write is not None:
        typer.echo(f"written: {chosen.write(write)}")


command.command()(teleop_serve.serve)
command.command()(teleop_serve.texts)
command.command()(teleop_tasks.tasks)
