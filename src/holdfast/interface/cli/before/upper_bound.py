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
    joints: Annotated[int | None, typer.Argument(metavar="JOINTS", help="Number of joints of the arm.")] = None,
    rows: Annotated[str | None, typer.Argument(metavar="ROWS", help="Number of task components, or name of the task.")] = None,
    failures: Annotated[int, typer.Argument(metavar="FAILURES", help="Number of joints that fail at once.")] = 1,
    table: Annotated[bool, "Print the bounds of all stored sizes instead."] = False,
    task: Annotated[str | None, "Restrict --table to this task or number of components. Default: all."] = None,
    verify: Annotated[bool, "Recompute the value of the stored null space, and compare it with the bound."] = False,
    singular_value: Annotated[
        float | None,
        typer.Option(
            "--singular-value",
            metavar="LEVER",
            help="Print the bound on the smallest singular value instead, for this mean distance of the tool from the joint "
            "axes in m (for a pose: in characteristic lengths, or inf).",
        ),
    ] = None,
    json_: JsonOption = False,
) -> None:
    """Look up the upper bound on relative manipulability for an arm of a given size.

    The bound depends only on the three numbers. It holds for every arm of this size, with revolute and prismatic joints.

    Example: holdfast upper-bound 9 6 2
    """
    if table:
        print_result(hf.index_bounds.bound_table(None if task is None else _read_row_count(task)), json_)
        return
    if joints is None or rows is None:
        raise InputError("give the number of joints and of task components, for example 9 6 2, or --table")
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
        raise InputError(f"'{text}' is neither a number of task components nor a task; tasks are {', '.join(TASK_SIZES)}")
    return int(text)
