"""``holdfast ceiling``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

import holdfast as hf
from holdfast.cli.options import JsonOption, SeedOption
from holdfast.cli.progress import working
from holdfast.errors import InputError
from holdfast.grammar import TASKS, is_count
from holdfast.present.printing import console, print_written
from holdfast.present.results import printed, printed_each

if TYPE_CHECKING:
    from holdfast.result import Result


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

    Example: holdfast ceiling 9 6 2
    """
    if table:
        printed(hf.ceilings.table(None if task is None else _rows(task)), json_)
        return
    if joints is None or rows is None:
        raise InputError("give the joints and the rows of the task, for example 9 6 2, or --table")
    if singular_value is not None:
        mixed = rows in set(TASKS) - {"position", "planar"}  # lengths and angles
        m = _rows(rows)
        printed(hf.ceilings.singular_value(n=joints, m=m, k=failures, lever=singular_value, angular=mixed), json_)
        return
    found = hf.ceilings.look_up(n=joints, m=_rows(rows), k=failures)
    if arm is None and search is None:
        printed(found.verify(proof=True) if verify else found, json_)
        return
    results: list[Result] = []
    files, null = list[Path](), None
    if search is not None:
        size = {"n": found.n, "m": found.m, "k": found.k}
        with working("searching") as now:
            better = hf.ceilings.search(
                **size, seed=seed, seconds=search, progress=lambda value: now(f"best so far {value:.8f}")
            )
        results.append(better)
        null = better.null_space
    if arm is not None:
        called = _task(rows, found.m)
        made = hf.designs.synthesise(None if search else found, null_space=null, task=called, failures=found.k, seed=seed)
        results.append(made)
        files = [hf.designs.written(made.arms[int(np.argmin(made.losses))], arm)]
    printed_each(results, json_)
    if not json_:
        print_written(console(), files)


def _task(text: str, rows: int) -> str:
    """The task that arms are made for, by its name or its rows."""
    return text if text in TASKS else {2: "planar", 3: "position", 6: "pose"}.get(rows, text)


def _rows(text: str) -> int:
    if text in TASKS:
        return TASKS[text]
    if not is_count(text):
        raise InputError(f"'{text}' is neither a number of rows nor a task; tasks are {', '.join(TASKS)}")
    return int(text)
