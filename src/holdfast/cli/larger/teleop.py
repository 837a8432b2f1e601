"""``holdfast teleop``: an experiment from its protocol to the report."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from holdfast.cli.larger import teleop_serve, teleop_tasks
from holdfast.cli.larger.stages import working
from holdfast.errors import HoldfastError, InputError, StoreError
from holdfast.files import reading
from holdfast.present.printing import console

if TYPE_CHECKING:
    from holdfast.teleop.protocol.protocol import Protocol
    from holdfast.teleop.records.entries import Subject
    from holdfast.teleop.records.records import Records

DIFFERS = 3  # exit code: it worked, and not every trial came out as it was recorded

FolderArgument = Annotated[Path, typer.Argument(metavar="DIR", help="Folder of the experiment.", show_default=False)]
ProtocolArgument = Annotated[
    str, typer.Argument(metavar="[PROTOCOL]", help="goel2003, goel2003-smooth, or a protocol file (YAML).")
]

command = typer.Typer(
    no_args_is_help=True, help="With a person at the stick: tasks, protocol, sessions and statistics.", add_completion=False
)


@command.command()
def run(
    out: Annotated[Path, typer.Option("--out", help="New folder for the records.", show_default=False)],
    simulated: Annotated[bool, typer.Option("--simulated", help="With simulated people.")] = False,
    operators: Annotated[int, typer.Option("--operators", min=1, help="How many.")] = 24,
    seed: Annotated[int, typer.Option("--seed", min=0, help="The same seed gives the same experiment.")] = 0,
    protocol: Annotated[str, typer.Option("--protocol", help="goel2003, goel2003-smooth, or a file (YAML).")] = "goel2003",
) -> None:
    """Run a whole experiment with simulated people, from training to the last rating, and record it.

    Example: holdfast teleop run --simulated --operators 24 --seed 1 --out experiment
    """
    if not simulated:
        raise InputError(
            "people take part in a browser: use 'holdfast teleop serve --data DIR'; add --simulated for simulated ones"
        )
    from holdfast.teleop.protocol.protocol import read_protocol
    from holdfast.teleop.rehearsal import simulate_experiment

    if reading.exists(out) and (not out.is_dir() or any(out.iterdir())):
        raise StoreError(f"--out: '{out}' exists and is not an empty folder; give a new one")
    with (
        working(f"compiling the laws of {protocol}") as say,
        simulate_experiment(out, read_protocol(protocol), operators, seed, say) as r,
    ):
        _print_experiment(r)


@command.command()
def analyse(
    folder: FolderArgument,
    groups: Annotated[int, typer.Option("--groups", min=2, help="Groups of difficulty that the tasks are sorted into.")] = 3,
    missing: Annotated[
        str,
        typer.Option(
            "--missing",
            help="If a subject has no completed trial in a cell: refuse, complete (leave such subjects out) or mixed (a mixed "
            "model of single trials).",
        ),
    ] = "refuse",
    difficulty: Annotated[
        str, typer.Option("--difficulty", help="Whose CPM the tasks are sorted by: operators (their median) or computer.")
    ] = "operators",
) -> None:
    """Statistics of an experiment: writes DIR/report.html, and every table as CSV beside it.

    Example: holdfast teleop analyse experiment
    """
    from holdfast.teleop.analysis.eligibility import analyse_records
    from holdfast.teleop.records.tables import hand_paths

    with _opened(folder) as records, working("computing") as say:
        result = analyse_records(records, missing, groups, difficulty)  # type: ignore[arg-type]
        say("drawing")
        report = result.write(folder, records.protocol, hand_paths(records))
    for line in result.describe():
        typer.echo(line)
    typer.echo(f"written: {report}, and {len(list(folder.glob('*.csv')))} tables as CSV beside it")


@command.command()
def replay(folder: FolderArgument) -> None:
    """Drive the arm with the recorded commands again: does every trial give the same path?

    Exit code 0 if all do; 3 if one does not.

    Example: holdfast teleop replay experiment
    """
    from holdfast.teleop.records.check import SAME
    from holdfast.teleop.records.check import replay as again

    with _opened(folder) as records, working("replaying"):
        result = again(records)
    most = float(result.difference.max(initial=0.0))
    typer.echo(f"{len(result.entries)} trials, {len(result.differs)} differ; largest difference of a joint {most:.2g} rad or m")
    for e in result.differs:
        typer.echo(
            f"  trial {e.id}: subject {e.subject}, {e.kind.value} {e.position + 1}, task {e.task + 1}, by more than {SAME:g}"
        )
    if result.differs:
        raise typer.Exit(DIFFERS)


@command.command()
def verify(folder: FolderArgument) -> None:
    """Is every trial, rating, answer and event as it was written? Compares the records with their digests.

    Exit code 0 if all is; 3 if something is not, and then the first damaged trial is named first.

    Example: holdfast teleop verify experiment
    """
    from holdfast.teleop.records.verification import verify as checked

    with working("comparing"):
        found = checked(folder)
    if found.without:
        typer.echo(
            f"{len(found.without)} trials have no digest, as they were recorded before there were any: "
            f"{', '.join(map(str, found.without))}"
        )
    for sentence in found.damaged[:20]:
        typer.echo(f"damaged: {sentence}")
    if len(found.damaged) > 20:
        typer.echo(f"damaged: {len(found.damaged) - 20} more")
    if found.damaged:
        raise typer.Exit(DIFFERS)
    typer.echo(f"sound: {found.trials} trials, {found.links} digests; all together {found.whole or 'none'}")


@command.command()
def backup(
    folder: FolderArgument,
    out: Annotated[Path, typer.Argument(metavar="OUT", help="New folder for the copy.", show_default=False)],
) -> None:
    """Copy the folder of an experiment, also while it is served, and verify the copy.

    Example: holdfast teleop backup experiment experiment-2026-11-22
    """
    from holdfast.teleop.records.copies import backup as copy

    with working("copying"):
        found = copy(folder, out)
    typer.echo(f"written: {out}; sound: {found.trials} trials, {found.links} digests")


@command.command()
def export(
    folder: FolderArgument,
    out: Annotated[Path | None, typer.Option("--out", help="Folder for the tables.", show_default="DIR/export")] = None,
    parquet: Annotated[bool, typer.Option("--parquet", help="Parquet in place of CSV; needs pyarrow.")] = False,
) -> None:
    """Write trials, cycles, subjects and events as tables, with a data dictionary and the protocol.

    Example: holdfast teleop export experiment
    """
    from holdfast.teleop.records.tables import export as write

    with _opened(folder) as records, working("writing"):
        files = write(records, folder / "export" if out is None else out, parquet)
    for file in files:
        typer.echo(f"written: {file}")


@command.command()
def allocation(
    protocol: ProtocolArgument = "goel2003",
    subjects: Annotated[
        int | None, typer.Option("--subjects", min=1, help="How many sheets.", show_default="the protocol's number")
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", help="Write a sheet to print (HTML).", show_default=False)] = None,
) -> None:
    """Who does which task when, in which order of scenarios: to print and to tick.

    Example: holdfast teleop allocation --out allocation.html
    """
    from holdfast.teleop.protocol.protocol import read_protocol

    chosen = read_protocol(protocol)
    if out is not None:
        from holdfast.present.teleop.allocation import write_allocation

        typer.echo(f"written: {write_allocation(chosen, out, subjects)}")
        return
    order = chosen.order()
    typer.echo("subject  row  tasks in order, each with its scenarios in order")
    for k in range(chosen.subjects if subjects is None else subjects):
        session = chosen.session(k % len(order), k).reshape(len(chosen.tasks), -1, 2) + 1
        words = " ".join(f"{of[0, 0]}:{'/'.join(map(str, of[:, 1]))}" for of in session)
        typer.echo(f"{k + 1:7d}  {k % len(order) + 1:3d}  {words}")


@command.command()
def subjects(
    folder: FolderArgument,
    drop: Annotated[
        str | None,
        typer.Option("--drop", help="This subject does not come back: the row goes to somebody else.", show_default=False),
    ] = None,
    delete: Annotated[
        str | None, typer.Option("--delete", help="Delete this subject and everything recorded, for good.", show_default=False)
    ] = None,
) -> None:
    """The subjects of an experiment and where their sessions stand.

    Example: holdfast teleop subjects experiment
    """
    if drop is not None and delete is not None:
        raise InputError("give --drop or --delete, not both")
    with _opened(folder) as records:
        if delete is not None:
            count = len(records.entries(delete))
            records.delete_subject(delete)
            typer.echo(
                f"deleted: subject {delete} and {count} recorded trials; exports and reports written before still hold them"
            )
        if drop is not None:
            from holdfast.teleop.records.entries import State

            records.set_state(drop, State.DROPPED)
            typer.echo(f"dropped: subject {drop}; what was recorded stays")
        _print_subjects(records)


@command.command("protocol")
def protocol_(
    protocol: ProtocolArgument = "goel2003",
    write: Annotated[
        Path | None, typer.Option("--write", help="Copy it to this file, to start from.", show_default=False)
    ] = None,
) -> None:
    """Check a protocol and say what it holds.

    Example: holdfast teleop protocol --write mine.yaml
    """
    from holdfast.teleop.protocol.protocol import read_protocol

    chosen = read_protocol(protocol)
    if write is not None and reading.exists(write):
        raise StoreError(f"--write: '{write}' exists already; choose another name")
    _print_protocol(chosen)
    if write is not None:
        typer.echo(f"written: {chosen.write(write)}")


command.command()(teleop_serve.serve)
command.command()(teleop_serve.texts)
command.command()(teleop_tasks.tasks)


# ---- out -----------------------------------------------------------------------------------------------------------------


@contextmanager
def _opened(folder: Path) -> Iterator[Records]:
    """The records; where damage makes them impossible to read, a sentence says what is damaged."""
    import sqlite3

    from holdfast.teleop.records.records import Records
    from holdfast.teleop.records.verification import verify

    try:
        with Records.open(folder) as records:
            yield records
    except HoldfastError:
        raise
    except (sqlite3.Error, ValueError, TypeError, LookupError, OverflowError) as error:
        damaged = verify(folder).damaged
        if not damaged:
            raise
        raise StoreError(f"'{folder}' is damaged: {damaged[0]}; restore it from a backup") from error


def _table(*head: str) -> Any:
    from rich.table import Table

    return Table(*head, box=None, pad_edge=False)


def _print_experiment(records: Records) -> None:
    from holdfast.teleop.records.entries import Kind
    from holdfast.teleop.trials.recordings import End

    out, protocol = console(), records.protocol
    people = records.subjects()
    done = [s for s in people if s.state == "completed"]
    training = len(records.entries(kind=Kind.TRAINING))
    out.print(f"{len(people)} simulated operators, {len(done)} trained and done; {training} training tasks", soft_wrap=True)
    table = _table("scenario", "", "arrived", "aborted", "time over")
    entries = records.entries(kind=Kind.TRIAL)
    for k, s in enumerate(protocol.scenarios):
        ends = [e.end for e in entries if e.scenario == k]
        table.add_row(str(s.number), s.label, *(str(ends.count(e)) for e in (End.ARRIVED, End.ABORTED, End.TIME)))
    out.print(table)
    typer.echo(f"written: {records.folder}; next: holdfast teleop analyse {records.folder}")


def _print_subjects(records: Records) -> None:
    from rich.markup import escape

    from holdfast.teleop.records.session import Session

    table = _table("subject", "kind", "row", "session", "done", "since")
    people: list[Subject] = records.subjects()
    for s in people:
        progress = Session(records, s.code).progress()
        table.add_row(escape(s.code), s.kind.value, str(s.row + 1), s.state.value, progress, s.since[:10])
    if people:
        console().print(table)
    else:
        typer.echo("no subjects yet")


def _print_protocol(p: Protocol) -> None:
    from rich.markup import escape

    out = console()
    training = p.training
    limit = "no limit" if p.cycle_limit is None else f"at most {p.cycle_limit} cycles"
    for line in (
        f"{p.name}",
        f"arm {p.arm.name}, task {p.rows.name}, {p.rate:g} cycles/s, {p.substeps} sub-steps in each",
        f"stick: up to {p.stick.limit:g} m/cycle ({p.stick.limit * p.rate:g} m/s), dead zone {p.stick.dead_zone:g} m/cycle",
        f"a trial ends at rest within {p.radius:g} m of the target; {limit}",
        f"training: {training.at_least} tasks or more of {training.distance:g} m, the last {training.in_a_row} in a row within "
        f"{training.limit:g} cycles ({training.limit / p.rate:.3g} s), at most {training.most}",
        f"{p.subjects} subjects, {len(p.order())} rows of the balanced square, {len(p.tasks) * len(p.scenarios)} trials each",
        f"rating: {', '.join(p.rating)}",
    ):
        out.print(escape(line), soft_wrap=True)
    table = _table("scenario", "")
    for s in p.scenarios:
        options = ", ".join(f"{k} {v:g}" if isinstance(v, float) else f"{k} {v}" for k, v in s.options.items())
        table.add_row(str(s.number), escape(s.label + (f" ({options})" if options else "")))
    out.print(table)
    tasks = _table("task", "joint that fails", "from start to target, m", "note")
    start = p.arm.forward_kinematics(p.tasks.q0)[:, :3, 3] @ p.rows.rows[:, :3].T
    for k, note in enumerate(p.notes):
        joint = p.arm.joint_names[p.tasks.joint[k]] if p.tasks.joint[k] >= 0 else "none"
        away = float(((p.tasks.target[k] - start[k]) ** 2).sum() ** 0.5)
        tasks.add_row(str(k + 1), escape(joint), f"{away:.3f}", escape(note))
    out.print(tasks)
