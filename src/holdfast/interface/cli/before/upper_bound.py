"""``holdfast upper-bound``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.labels import TASK_SIZES, is_count
from holdfast.interface.cli.options import JsonOption, SeedOption
from holdfast.interface.cli.progress import show_status
from holdfast.interface.presentation.printing import make_console, print_written_files
from holdfast.interface.presentation.results import print_result, print_results

if TYPE_CHECKING:
    from holdfast.core.result import Result


def command(
    joints: Annotated[int | None, typer.Argument(metavar="JOINTS", help="Joints of the arm.")] = None,
    rows: Annotated[str | None, typer.Argument(metavar="ROWS", help="Rows of the task, or its name.")] = None,
    failures: Annotated[int, typer.Argument(metavar="FAILURES", help="Joints that fail at once.")] = 1,
    table: Annotated[bool, "All sizes that are stored instead."] = False,
    task: Annotated[str | None, "Those of one task in --table."] = None,
    verify: Annotated[bool, "Measure the stored null space anew; replay certificates."] = False,
    search: Annotated[float | None, "Seconds to search for a better null space."] = None,
    arm: Annotated[Path | None, "Write a revolute arm that attains the best known value, or what --search found."] = None,
    singular_value: Annotated[
        float | None,
        typer.Option(
            "--singular-value",
            metavar="LEVER",
            help="Of the least singular value instead, for a mean lever of the joints, m (for a pose in lengths, or inf).",
        ),
    ] = None,
    seed: SeedOption = 0,
    json_: JsonOption = False,
) -> None:
    """Look up the upper bound on relative manipulability for an arm of a given size.

    It holds for every arm of so many joints, revolute or prismatic: only these three numbers count.

    Example: holdfast upper-bound 9 6 2
    """
    if table:
        print_result(hf.index_bounds.bound_table(None if task is None else _read_row_count(task)), json_)
        return
    if joints is None or rows is None:
        raise InputError("give the joints and the rows of the task, for example 9 6 2, or --table")
    if singular_value is not None:
        mixed = rows in set(TASK_SIZES) - {"position", "planar"}  # lengths and angles
        m = _read_row_count(rows)
        print_result(
            hf.index_bounds.bound_singular_value(n=joints, m=m, k=failures, lever=singular_value, angular=mixed), json_
        )
        return
    upper_bound = hf.index_bounds.upper_bound(n=joints, m=_read_row_count(rows), k=failures)
    if arm is None and search is None:
        print_result(upper_bound.verify(proof=True) if verify else upper_bound, json_)
        return
    results: list[Result] = []
    files, null_space = list[Path](), None
    if search is not None:
        problem_size = {"n": upper_bound.n, "m": upper_bound.m, "k": upper_bound.k}
        with show_status("searching") as update_status:
            better = hf.index_bounds.search_null_space(
                **problem_size, seed=seed, seconds=search, progress=lambda value: update_status(f"best so far {value:.8f}")
            )
        results.append(better)
        null_space = better.null_space
    if arm is not None:
        task_name = _choose_task_name(rows, upper_bound.m)
        synthesis = hf.designs.synthesise(
            None if search else upper_bound, null_space=null_space, task=task_name, failures=upper_bound.k, seed=seed
        )
        results.append(synthesis)
        files = [hf.designs.write_dh_table(synthesis.arms[int(np.argmin(synthesis.losses))], arm)]
    print_results(results, json_)
    if not json_:
        print_written_files(make_console(), files)


def _choose_task_name(text: str, row_count: int) -> str:
    """Return the name of the task for which arms are constructed, from its name or its number of rows."""
    return text if text in TASK_SIZES else {2: "planar", 3: "position", 6: "pose"}.get(row_count, text)


def _read_row_count(text: str) -> int:
    if text in TASK_SIZES:
        return TASK_SIZES[text]
    if not is_count(text):
        raise InputError(f"'{text}' is neither a number of rows nor a task; tasks are {', '.join(TASK_SIZES)}")
    return int(text)
