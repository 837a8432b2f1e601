"""``holdfast study``: new, run, status, verify, merge and report."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer

from holdfast.cli.groups import Chains
from holdfast.cli.options import JsonOption
from holdfast.cli.progress import progress_bar
from holdfast.errors import InputError
from holdfast.grammar import is_count
from holdfast.notice import working
from holdfast.present.printing import console, print_json
from holdfast.present.results import printed, printed_each

command = typer.Typer(
    name="study",
    help="Run parameter sweeps that can be stopped, resumed and distributed.",
    no_args_is_help=True,
)

FileArgument = Annotated[Path, typer.Argument(metavar="FILE.yaml", help="Study file.")]
FoldersArgument = Annotated[list[Path], typer.Argument(metavar="DIR...", help="Folders that 'holdfast study run --out' wrote.")]


@command.command()
def new(
    file: FileArgument,
    arm: Annotated[list[str], "Built-in name or arm file; may be given again."],
    poses: Annotated[int, "Samples of each cell."] = 2000,
    chunk: Annotated[int | None, "Samples computed and committed together.", "500, more above 500,000 samples"] = None,
    seed: Annotated[int, "The same seed gives the same bits."] = 0,
    index: Annotated[list[str] | None, "May be given again.", "relative-manipulability"] = None,
    law: Annotated[list[str] | None, "Also maps of convergence under this control law; may be given again."] = None,
    optimise: Annotated[bool, "Also the best configuration of each pose."] = False,
    chains: Chains = Chains(),
) -> None:
    """Write a commented study file.

    Example: holdfast study new tools.yaml --arm panda --arm iiwa14 --poses 2000 --chunk 500 --seed 1
    """
    from holdfast.studies.template import write

    usual = ["relative-manipulability"]
    indices = usual if index is None else index
    files = chains.arms(arm)
    written = write(file, files, poses, chunk, seed, indices, law or [], optimise)
    typer.echo(f"written: {written}")


@command.command()
def run(
    file: FileArgument,
    out: Annotated[Path | None, "Folder for the results; a stopped study resumes."] = None,
    scheduler: Annotated[
        str | None,
        "Compute on Dask: the address of its scheduler (tcp://HOST:8786), its scheduler file, or local:4 for four "
        "worker processes of this machine.",
        "threads of this process",
    ] = None,
    threads: Annotated[
        int | None, typer.Option("--threads", min=1, help="Threads, without --scheduler.", show_default="all processors")
    ] = None,
    part: Annotated[str, "1/3: only the first of three parts, for machines that share no folder; see merge."] = "1/1",
    dry_run: Annotated[bool, "Say what would be computed, how long it takes and how large it is."] = False,
    json_: JsonOption = False,
) -> None:
    """Compute the missing parts of a study.

    Ctrl-C stops the run after the current chunks; the same command resumes it.

    Example: holdfast study run tools.yaml --out tools

    Example: holdfast study run tools.yaml --out tools --scheduler tcp://10.0.0.5:8786
    """
    from holdfast.engine.study import Study
    from holdfast.kernels.threads import set_threads
    from holdfast.studies.estimate import estimates
    from holdfast.studies.study_file import read

    share = _share(part)
    if threads is not None:
        set_threads(threads)
    asked = read(file)
    if dry_run:
        found = []
        with progress_bar(json_, "cells") as progress, working("trying rows of each cell", progress) as advance:
            for each in estimates(asked.cells, asked.seed):
                found.append(each)
                advance(len(found), len(asked.cells))
        from holdfast.present.studies import console as said

        if json_:
            print_json(said.estimated(found))
        else:
            said.show_estimates(found, console())
        return
    if out is None:
        raise InputError("--out is missing; give a folder for the results, or --dry-run")
    with _runner(scheduler) as runner, stopping() as stop, chunks_progress(json_) as progress:
        study = Study.create(out, asked.name, asked.seed, cells=asked.cells, source=asked.text)
        problems = study.run(asked.cells, runner, progress, stop=stop, part=share)
    printed(study, json_)
    if problems:
        name, problem = next(iter(problems.items()))
        more = f" (and {len(problems) - 1} more)" if len(problems) > 1 else ""
        raise InputError(f"{len(problems)} of {len(asked.cells)} cells were not computed: '{name}': {problem}{more}")
    if stop():
        raise KeyboardInterrupt


@command.command()
def status(folders: FoldersArgument, json_: JsonOption = False) -> None:
    """Show the progress of a study.

    Example: holdfast study status tools
    """
    from holdfast.engine.study import Study

    printed_each([Study.open(folder) for folder in folders], json_)


@command.command()
def verify(folders: FoldersArgument, json_: JsonOption = False) -> None:
    """Check the checksums of all chunks.

    Damaged chunks are named, and the next run computes them again.

    Example: holdfast study verify tools
    """
    from holdfast.engine.verification import verify as verified

    with chunks_progress(json_) as progress:
        found = verified(folders, progress)
    printed(found, json_)
    found.require_ok()


@command.command()
def merge(
    folders: FoldersArgument,
    out: Annotated[Path | None, "Folder to merge into.", "the first DIR"] = None,
    json_: JsonOption = False,
) -> None:
    """Merge folders computed on different machines.

    The first folder gets what it lacks from the others; it is made if it does not exist.

    Example: holdfast study merge whole machine1/tools machine2/tools
    """
    from holdfast.engine.union import merge as join

    target, others = (folders[0], folders[1:]) if out is None else (out, folders)
    if not others:
        raise InputError("there is nothing to merge; name the folder to merge into and one or more to take from")
    with chunks_progress(json_) as progress:
        found = join(target, others, progress)
    printed(found, json_)


@command.command()
def report(
    folders: FoldersArgument,
    to: Annotated[Path | None, "HTML file. Default: DIR/report.html."] = None,
    json_: JsonOption = False,
) -> None:
    """Write the HTML report.

    The page has a table of arms, indices and laws with intervals, distributions next to each other, and how they were computed.

    Example: holdfast study report tools
    """
    from holdfast.engine.study import Study

    if to is not None and len(folders) > 1:
        raise InputError(f"--to names one file and there are {len(folders)} folders; leave it out")
    pages = [Study.open(folder).report(to or folder / "report.html") for folder in folders]
    if json_:
        print_json({"reports": [str(p) for p in pages]})
        return
    for page in pages:
        typer.echo(f"report: {page}")


# ---- running ---------------------------------------------------------------------------------------------------------


def _share(text: str) -> tuple[int, int]:
    """--part: which part, of how many."""
    which, _, many = text.partition("/")
    if not (is_count(which) and is_count(many) and 1 <= int(which) <= int(many)):
        raise InputError(f"--part '{text}' is not a part; write 1/3 for the first of three")
    return int(which), int(many)


@contextmanager
def _runner(scheduler: str | None) -> Iterator[Any]:
    from holdfast.engine.cluster import Cluster
    from holdfast.engine.runner import Threads
    from holdfast.kernels.threads import pool, thread_count

    if scheduler is None:
        yield Threads(thread_count(), pool())
        return
    with Cluster(scheduler) as cluster:
        yield cluster


@contextmanager
def stopping(said: str = "stopping after the chunks in hand; again to stop at once") -> Iterator[Callable[[], bool]]:
    """Ctrl-C and SIGTERM (as cluster managers send it) stop the study once, and that is said; the second stops the program."""
    asked = False

    def stop(number: int, _: object) -> None:
        nonlocal asked
        if asked:
            raise KeyboardInterrupt
        asked = True
        if said:
            typer.echo(said, err=True)

    before = {s: signal.signal(s, stop) for s in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield lambda: asked
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@contextmanager
def chunks_progress(quiet: bool) -> Iterator[Any]:
    """A bar while a person looks; it says how much time is left, as does the line on stderr where there is none."""
    with progress_bar(quiet, "chunks") as bar:
        yield None if bar is None else lambda done, total, _: bar(done, total)
