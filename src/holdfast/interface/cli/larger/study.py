"""``holdfast study``: new, run, status, verify, merge and report."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer

from holdfast.core.errors import InputError
from holdfast.core.labels import is_count
from holdfast.core.progress import report_work
from holdfast.interface.cli.groups import ArmSourcesOptions
from holdfast.interface.cli.options import JsonOption
from holdfast.interface.cli.progress import ProgressBar
from holdfast.interface.presentation.printing import make_console, print_json
from holdfast.interface.presentation.results import print_result, print_results

command = typer.Typer(
    name="study", help="Run parameter sweeps that can be stopped, resumed and distributed.", no_args_is_help=True
)

FileArgument = Annotated[Path, typer.Argument(metavar="FILE.yaml", help="Study file.")]
FoldersArgument = Annotated[list[Path], typer.Argument(metavar="DIR", help="Folders that 'holdfast study run --out' wrote.")]


@command.command()
def new(
    file: FileArgument,
    arm: Annotated[list[str], "Arm: built-in name or arm file. Repeatable."],
    poses: Annotated[int, "Number of samples per combination."] = 2000,
    chunk: Annotated[int | None, "Number of samples computed and stored together.", "500, more above 500,000 samples"] = None,
    seed: Annotated[int, "Seed; the same seed gives bit-identical results."] = 0,
    index: Annotated[list[str] | None, "Index, as in 'holdfast assess'. Repeatable.", "relative-manipulability"] = None,
    law: Annotated[list[str] | None, "Control law of a convergence map to compute as well. Repeatable."] = None,
    optimise: Annotated[bool, "Also find the best configuration of each pose."] = False,
    chains: ArmSourcesOptions = ArmSourcesOptions(),
) -> None:
    """Write a commented study file.

    Example: holdfast study new tools.yaml --arm panda --arm iiwa14 --poses 2000 --chunk 500 --seed 1
    """
    from holdfast.studies.study_files.template import write

    default_indices = ["relative-manipulability"]
    indices = default_indices if index is None else index
    files = chains.resolve_arms(arm)
    written = write(file, files, poses, chunk, seed, indices, law or [], optimise)
    typer.echo(f"written: {written}")


@command.command()
def run(
    file: FileArgument,
    out: Annotated[Path | None, "Folder for the results; the same command resumes a stopped study."] = None,
    scheduler: Annotated[
        str | None,
        "Dask scheduler: its address (tcp://HOST:8786), its scheduler file, or local:4 for four worker processes on this "
        "machine.",
        "threads of this process",
    ] = None,
    threads: Annotated[
        int | None,
        typer.Option("--threads", min=1, help="Number of threads without --scheduler.", show_default="all processors"),
    ] = None,
    part: Annotated[str, "Part to compute, such as 1/3, for machines without a common folder; see 'study merge'."] = "1/1",
    dry_run: Annotated[bool, "Print the combinations with their estimated time and size, without computing them."] = False,
    json_: JsonOption = False,
) -> None:
    """Compute the missing parts of a study.

    Ctrl-C stops the run after the current chunks; the same command resumes it.

    Example: holdfast study run tools.yaml --out tools

    Example: holdfast study run tools.yaml --out tools --scheduler tcp://10.0.0.5:8786
    """
    from holdfast.core.sweeps.study import Study
    from holdfast.kernels.threads import set_threads
    from holdfast.studies.study_files.estimate import estimate_cells
    from holdfast.studies.study_files.study_file import read_study_file

    study_part = _read_part(part)
    if threads is not None:
        set_threads(threads)
    study_file = read_study_file(file)
    if dry_run:
        cell_estimates = []
        with ProgressBar(json_, "cells") as progress, report_work("timing a sample of each combination", progress) as advance:
            for estimate in estimate_cells(study_file.cells, study_file.seed):
                cell_estimates.append(estimate)
                advance(len(cell_estimates), len(study_file.cells))
        from holdfast.interface.presentation.studies import estimates

        if json_:
            print_json(estimates.summarize_estimates(cell_estimates))
        else:
            estimates.show_estimates(cell_estimates, make_console())
        return
    if out is None:
        raise InputError("--out is missing; give a folder for the results, or --dry-run")
    with _open_runner(scheduler) as runner, stop_on_signal() as stop, show_chunk_progress(json_) as progress:
        study = Study.create(out, study_file.name, study_file.seed, cells=study_file.cells, source=study_file.text)
        problems = study.run(study_file.cells, runner, progress, stop=stop, part=study_part)
    print_result(study, json_)
    if problems:
        name, problem = next(iter(problems.items()))
        others_note = f" (and {len(problems) - 1} more)" if len(problems) > 1 else ""
        raise InputError(f"{len(problems)} of {len(study_file.cells)} cells failed; '{name}': {problem}{others_note}")
    if stop():
        raise KeyboardInterrupt


@command.command()
def status(folders: FoldersArgument, json_: JsonOption = False) -> None:
    """Show the progress of a study.

    Example: holdfast study status tools
    """
    from holdfast.core.sweeps.study import Study

    print_results([Study.open(folder) for folder in folders], json_)


@command.command()
def verify(folders: FoldersArgument, json_: JsonOption = False) -> None:
    """Check the checksums of all chunks.

    Damaged chunks are listed, and the next run computes them again. DIR may also be a results folder, such as that of
    'holdfast assess --out'.

    Example: holdfast study verify tools
    """
    from holdfast.core.sweeps.verification import verify_studies as verified

    with show_chunk_progress(json_) as progress:
        verification = verified(folders, progress)
    print_result(verification, json_)
    verification.require_ok()


@command.command()
def merge(
    folders: FoldersArgument,
    out: Annotated[Path | None, "Folder to merge into.", "the first DIR"] = None,
    json_: JsonOption = False,
) -> None:
    """Merge folders computed on different machines.

    The first folder receives its missing parts from the others; it is created if it does not exist.

    Example: holdfast study merge whole machine1/tools machine2/tools
    """
    from holdfast.core.sweeps.study_merge import merge_studies as join

    target, sources = (folders[0], folders[1:]) if out is None else (out, folders)
    if not sources:
        raise InputError("there is nothing to merge; give the folder to merge into, and at least one folder to merge")
    with show_chunk_progress(json_) as progress:
        merge_result = join(target, sources, progress)
    print_result(merge_result, json_)


@command.command()
def report(
    folders: FoldersArgument,
    to: Annotated[Path | None, "HTML file for the report. Default: DIR/report.html."] = None,
    json_: JsonOption = False,
) -> None:
    """Write the HTML report.

    The report contains a table of arms, indices and laws with intervals, their distributions, and how they were computed.

    Example: holdfast study report tools
    """
    from holdfast.core.sweeps.study import Study

    if to is not None and len(folders) > 1:
        raise InputError(f"--to gives one file, and there are {len(folders)} folders; leave it out")
    pages = [Study.open(folder).report(to or folder / "report.html") for folder in folders]
    if json_:
        print_json({"reports": [str(written) for written in pages]})
        return
    for page in pages:
        typer.echo(f"report: {page}")


# ---- running ---------------------------------------------------------------------------------------------------------


def _read_part(text: str) -> tuple[int, int]:
    """Read ``--part``; return the number of the part and the count of parts."""
    number, _, count = text.partition("/")
    if not (is_count(number) and is_count(count) and 1 <= int(number) <= int(count)):
        raise InputError(f"--part '{text}' is not a part; write 1/3 for the first of three")
    return int(number), int(count)


@contextmanager
def _open_runner(scheduler: str | None) -> Iterator[Any]:
    from holdfast.core.sweeps.cluster import Cluster
    from holdfast.core.sweeps.runner import ThreadRunner
    from holdfast.kernels.threads import shared_pool, thread_count

    if scheduler is None:
        yield ThreadRunner(thread_count(), shared_pool())
        return
    with Cluster(scheduler) as cluster:
        yield cluster


@contextmanager
def stop_on_signal(
    notice: str = "stopping after the current chunks; press Ctrl-C again to stop at once",
) -> Iterator[Callable[[], bool]]:
    """Stop the study at the first Ctrl-C or SIGTERM (which cluster managers send), and the program at the second."""
    is_requested = False

    def request_stop(number: int, _: object) -> None:
        nonlocal is_requested
        if is_requested:
            raise KeyboardInterrupt
        is_requested = True
        if notice:
            typer.echo(notice, err=True)

    previous_handlers = {number: signal.signal(number, request_stop) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield lambda: is_requested
    finally:
        for number, handler in previous_handlers.items():
            signal.signal(number, handler)


@contextmanager
def show_chunk_progress(quiet: bool) -> Iterator[Any]:
    """Show a progress bar on a terminal with the remaining time; without a terminal stderr gets a line with it."""
    with ProgressBar(quiet, "chunks") as bar:
        yield None if bar is None else lambda done, total, _: bar(done, total)
