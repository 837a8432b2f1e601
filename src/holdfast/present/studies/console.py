"""A study on the terminal: how far it is, what verifying and merging found, and what it would take."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.engine.study import Damage, Study
from holdfast.engine.union import Merged
from holdfast.kernels.threads import thread_count
from holdfast.present.printing import Rows
from holdfast.studies.estimate import Estimate

if TYPE_CHECKING:
    from rich.console import Console

_MOST = 40  # cells in a table


def status(study: Study) -> dict[str, Any]:
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


def sentences(study: Study) -> list[str]:
    """How far it is."""
    cells = study.status()
    done, total = sum(s.chunks_done for s in cells), sum(s.chunks for s in cells)
    return [f"{study.name} ({study.path}): {done:,} of {total:,} chunks, seed {study.seed}"]


def key_table(study: Study) -> Rows:
    """How far each cell is."""
    return Rows(["cell", "rows"], [[s.name, f"{s.rows_done:,} of {s.rows:,}"] for s in study.status()])


def next_steps(study: Study, name: str) -> list[str]:
    """Whether what is there is sound."""
    del study
    return [f"{name}.verify()  # an empty list: everything that was computed is sound"]


def show_status(study: Study, out: Console) -> None:
    """The same for people; of many cells those that are not complete."""
    from rich.markup import escape

    cells = study.status()
    done, total = sum(s.chunks_done for s in cells), sum(s.chunks for s in cells)
    spent = _duration(sum(s.seconds for s in cells))
    word = "complete" if done == total else f"{100 * done / total:.1f} %" if total else "empty"
    line = f"{study.name} ({study.path}): {done:,} of {total:,} chunks, {word}, {spent} of one thread"
    out.print(escape(line), soft_wrap=True)
    shown = [s for s in cells if not s.complete] if len(cells) > _MOST else cells
    rows = (
        (s.name, f"{s.rows_done:,} of {s.rows:,}", f"{s.chunks_done:,} of {s.chunks:,}", _duration(s.seconds))
        for s in shown[:_MOST]
    )
    if shown:
        _show(("cell", "rows", "chunks", "thread time"), rows, out)
    if len(shown) > _MOST:
        out.print(f"and {len(shown) - _MOST} more cells that are not complete")


def damaged(folder: Path, found: Sequence[Damage]) -> list[dict[str, Any]]:
    """Chunks that verifying found damaged, from 1."""
    return [
        {"folder": str(folder), "cell": d.cell, "chunk": None if d.chunk is None else d.chunk + 1, "what": d.what}
        for d in found
    ]


def sentence(d: dict[str, Any]) -> str:
    """One of them for people."""
    lost = d["chunk"] is None
    which = f"cell '{d['cell']}' is lost" if lost else f"chunk {d['chunk']} of cell '{d['cell']}' is damaged"
    return f"{d['folder']}: {which}: {d['what']}"


def sound(folder: Path, study: Study) -> list[str]:
    """What verifying found where nothing is damaged, and what was not there to be looked at."""
    cells = study.status()
    done, total = sum(s.chunks_done for s in cells), sum(s.chunks for s in cells)
    rest = "" if done == total else f"; {total - done} of {total} are not computed"
    empty = [s.name for s in cells if not s.chunks_done]
    more = f" and {len(empty) - 3} more" if len(empty) > 3 else ""
    nothing = f"nothing is computed of {len(empty)} cell{'s' * (len(empty) > 1)}: {', '.join(empty[:3])}{more}"
    return [f"{folder}: {done} chunks, all sound{rest}", *([nothing] if empty else [])]


def merged(found: Merged, makers: list[dict[str, Any]]) -> dict[str, Any]:
    """What a merge did."""
    apart = [{"cell": c, "chunk": k + 1} for c, k in found.apart]
    return {"added": found.added, "same": found.both, "within_1e-12": found.close, "different": apart, "made_by": makers}


def show_merged(study: Study, found: Merged, out: Console, err: Console) -> None:
    """The same for people, and how far the study is now."""
    lines = [f"{study.path}: {found.added} chunks added, {found.both} were there already, bit for bit the same"]
    if found.close:
        lines.append(f"{found.close} chunks were there already, alike to 1e-12")
    if found.apart:
        cell, k = found.apart[0]
        err.print(
            f"{len(found.apart)} chunks were there already with other values (first: chunk {k + 1} of '{cell}'); those of "
            f"'{study.path}' are kept",
            markup=False,
            soft_wrap=True,
        )
    for maker in study.makers:
        packages = ", ".join(f"{name} {version}" for name, version in maker["versions"].items())
        lines.append(f"computed on {maker['processor']}: Python {maker['python']}, {packages}")
    if len(study.makers) > 1:
        lines.append(
            "versions or processors differ: the same study computed on one of them alone agrees to 1e-12, not in every bit"
        )
    for line in lines:
        out.print(line, markup=False, soft_wrap=True)
    show_status(study, out)


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
    rows = (
        (
            e.cell.name,
            f"{e.cell.rows:,}",
            f"{e.cell.count:,}",
            _duration(e.seconds),
            _duration(e.seconds / e.cell.count),
            _bytes(e.size),
        )
        for e in found
    )
    _show(("cell", "rows", "chunks", "of one thread", "a chunk", "size, at most"), rows, out)
    seconds = whole["thread_seconds"]
    out.print(
        f"{len(found)} cells, {whole['chunks']:,} chunks: about {_duration(seconds)} of one thread, "
        f"{_duration(seconds / threads)} with the {threads} of this machine; at most {_bytes(whole['bytes'])} on the disk "
        f"(estimated from up to {max(e.tried for e in found)} rows of each cell)",
        soft_wrap=True,
    )


def _show(head: Sequence[str], rows: Iterable[Sequence[str]], out: Console) -> None:
    from rich.markup import escape
    from rich.table import Table

    table = Table(*head, box=None, pad_edge=False)
    for name, *others in rows:
        table.add_row(escape(name), *others)
    out.print(table)


def _duration(seconds: float) -> str:
    if seconds < 60:
        return f"{seconds:.2g} s" if seconds < 10 else f"{seconds:.0f} s"
    if seconds < 5400:
        return f"{seconds / 60:.0f} min"
    return f"{seconds / 3600:.1f} h" if seconds < 172_800 else f"{seconds / 86_400:.1f} days"


def _bytes(count: float) -> str:
    for unit in ("B", "kB", "MB", "GB"):
        if count < 1000:
            return f"{count:.3g} {unit}"
        count /= 1000
    return f"{count:.3g} TB"
