"""``holdfast upper-bound``."""

from __future__ import annotations

from typing import Annotated

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.labels import TASK_SIZES, is_count
from holdfast.interface.cli.options import JsonOption
from holdfast.interface.presentation.results import print_result


def command(
    joints: Annotated[int | None, typer.Argument(metavar="JOINTS", help="Joints of the arm.")] = None,
    rows: Annotated[str | None, typer.Argument(metavar="ROWS", help="Rows of the task, or its name.")] = None,
    failures: Annotated[int, typer.Argument(metavar="FAILURES", help="Joints that fail at once.")] = 1,
    table: Annotated[bool, "All sizes that are stored instead."] = False,
    task: Annotated[str | None, "Those of one task in --table."] = None,
    verify: Annotated[bool, "Compute the value of the stored null space again and compare it with the bound."] = False,
    singular_value: Annotated[
        float | None,
        typer.Option(
            "--singular-value",
            metavar="LEVER",
            help="Of the least singular value instead, for a mean lever of the joints, m (for a pose in lengths, or inf).",
        ),
    ] = None,
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
    print_result(upper_bound.verify() if verify else upper_bound, json_)


def _read_row_count(text: str) -> int:
    if text in TASK_SIZES:
        return TASK_SIZES[text]
    if not is_count(text):
        raise InputError(f"'{text}' is neither a number of rows nor a task; tasks are {', '.join(TASK_SIZES)}")
    return int(text)
