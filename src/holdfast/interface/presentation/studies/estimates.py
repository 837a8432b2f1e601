"""Console text and JSON of the estimated time and size of a study."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from holdfast.core.formatting import format_count, format_duration
from holdfast.interface.presentation.printing import TextTable, print_table
from holdfast.kernels.threads import thread_count
from holdfast.studies.study_files.estimate import CellEstimate

if TYPE_CHECKING:
    from rich.console import Console


def summarize_estimates(estimates: Sequence[CellEstimate]) -> dict[str, Any]:
    """Summarise the estimated time and size of a study, cell by cell, as JSON data."""
    return {
        "cells": [
            {
                "name": estimate.cell.name,
                "rows": estimate.cell.rows,
                "chunks": estimate.cell.count,
                "thread_seconds": estimate.seconds,
                "bytes": estimate.size,
            }
            for estimate in estimates
        ],
        "chunks": sum(estimate.cell.count for estimate in estimates),
        "thread_seconds": sum(estimate.seconds for estimate in estimates),
        "bytes": sum(estimate.size for estimate in estimates),
        "threads": thread_count(),
    }


def show_estimates(estimates: Sequence[CellEstimate], out: Console) -> None:
    """Print the estimated time and size of a study."""
    total, threads = summarize_estimates(estimates), thread_count()
    table_rows = [
        (
            estimate.cell.name,
            f"{estimate.cell.rows:,}",
            f"{estimate.cell.count:,}",
            format_duration(estimate.seconds),
            format_duration(estimate.seconds / estimate.cell.count),
            _format_size(estimate.size),
        )
        for estimate in estimates
    ]
    print_table(out, TextTable(("cell", "rows", "chunks", "processor time", "time per chunk", "size, at most"), table_rows))
    seconds = total["thread_seconds"]
    out.print(
        f"{format_count(len(estimates), 'cell')}, {total['chunks']:,} chunks: about {format_duration(seconds)} of processor "
        f"time, or {format_duration(seconds / threads)} with the {threads} threads of this machine; at most "
        f"{_format_size(total['bytes'])} on disk (estimated from up to {max(estimate.tried for estimate in estimates)} "
        "rows of each cell)",
        soft_wrap=True,
    )


def _format_size(count: float) -> str:
    for unit in ("B", "kB", "MB", "GB"):
        if count < 1000:
            return f"{count:.3g} {unit}"
        count /= 1000
    return f"{count:.3g} TB"
