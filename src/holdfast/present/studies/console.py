"""A study on the terminal: how far it is, what verifying and merging found, and what it would take."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from holdfast.engine.study import Study
from holdfast.engine.union import Merged
from holdfast.kernels.threads import thread_count
from holdfast.present.printing import Rows, print_rows
from holdfast.studies.estimate import Estimate
from holdfast.words import counted, duration

if TYPE_CHECKING:
    from rich.console import Console

_MOST = 40  # cells in a table


def to_dict(study: Study) -> dict[str, Any]:
    """How far it is, cell by cell."""
    cells = study.status()
    return {
        "folder": str(study.path),
        "name": study.name,
        "seed": study.seed,
        "digest": study.digest,
        "complete": all(s.complete for s in cells),
        "chunks": sum(s.chunks for s in cells),
        "chunks_done": sum(s.chunks_done for s in cells),
        "thread_seconds": sum(s.seconds for s in cells),
        "cells": [
            {"name": s.name, "chunks": s.chunks, "chunks_done": s.chunks_done, "rows": s.rows, "rows_done": s.rows_done}
            for s in cells
        ],
        "made_by": study.makers,
    }


def next_steps(found: Study | Merged, name: str) -> list[str]:
    """Whether what is there is sound."""
    study = f"{name}.study" if isinstance(found, Merged) else name
    return [f"{study}.verify()  # an empty list: everything that was computed is sound"]


def tables(found: Study | Merged) -> list[Rows]:
    """A row for each cell; of many cells those that are not complete."""
    cells = (found.study if isinstance(found, Merged) else found).status()
    shown = [s for s in cells if not s.complete] if len(cells) > _MOST else cells
    rows = [
        (s.name, f"{s.rows_done:,} of {s.rows:,}", f"{s.chunks_done:,} of {s.chunks:,}", duration(s.seconds))
        for s in shown[:_MOST]
    ]
    title = f"{_MOST} of {len(shown)} cells that are not complete" if len(shown) > _MOST else ""
    return [Rows(("cell", "rows", "chunks", "processor time"), rows, title)] if rows else []


def estimated(found: Sequence[Estimate]) -> dict[str, Any]:
    """What a study would take, cell by cell."""
    return {
        "cells": [
            {"name": e.cell.name, "rows": e.cell.rows, "chunks": e.cell.count, "thread_seconds": e.seconds, "bytes": e.size}
            for e in found
        ],
        "chunks": sum(e.cell.count for e in found),
        "thread_seconds": sum(e.seconds for e in found),
        "bytes": sum(e.size for e in found),
        "threads": thread_count(),
    }


def show_estimates(found: Sequence[Estimate], out: Console) -> None:
    """The same for people."""
    whole, threads = estimated(found), thread_count()
    rows = [
        (
            e.cell.name,
            f"{e.cell.rows:,}",
            f"{e.cell.count:,}",
            duration(e.seconds),
            duration(e.seconds / e.cell.count),
            _bytes(e.size),
        )
        for e in found
    ]
    print_rows(out, Rows(("cell", "rows", "chunks", "processor time", "a chunk", "size, at most"), rows))
    seconds = whole["thread_seconds"]
    out.print(
        f"{counted(len(found), 'cell')}, {whole['chunks']:,} chunks: about {duration(seconds)} of processor time, "
        f"{duration(seconds / threads)} with the {threads} of this machine; at most {_bytes(whole['bytes'])} on the disk "
        f"(estimated from up to {max(e.tried for e in found)} rows of each cell)",
        soft_wrap=True,
    )


def _bytes(count: float) -> str:
    for unit in ("B", "kB", "MB", "GB"):
        if count < 1000:
            return f"{count:.3g} {unit}"
        count /= 1000
    return f"{count:.3g} TB"
