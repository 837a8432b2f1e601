"""The built-in arms in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from holdfast import arms

if TYPE_CHECKING:
    from rich.console import Console


def to_dict() -> list[dict[str, Any]]:
    """Each of them."""
    entries = [arms.about(name) for name in arms.names()]
    return [{"name": e.name, "joints": e.n, "summary": e.summary, "source": e.source, "licence": e.licence} for e in entries]


def show(out: Console) -> None:
    """A table."""
    from rich.table import Table

    table = Table("name", "joints", "what it is", "licence", box=None, pad_edge=False)
    for e in to_dict():
        table.add_row(e["name"], str(e["joints"]), e["summary"], e["licence"])
    out.print(table)
