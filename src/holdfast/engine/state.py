"""How far a cell of a study is, and what of it is damaged."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, kw_only=True)
class CellStatus:
    """How far a cell is.

    Attributes:
        name: Of the cell.
        labels: What it is in the sweep.
        chunks, rows: In all.
        chunks_done, rows_done: Committed.
        seconds: Time that these took where they were computed.
        makers: Numbers of what computed them, of :attr:`holdfast.engine.Study.makers`.
    """

    name: str
    labels: Mapping[str, Any]
    chunks: int
    rows: int
    chunks_done: int
    rows_done: int
    seconds: float
    makers: tuple[int, ...]

    @property
    def complete(self) -> bool:
        """All of it is there."""
        return self.chunks_done == self.chunks


@dataclass(frozen=True)
class Damage:
    """A committed chunk that is not as it was written; number from 0, None for all of a cell that was begun and is gone."""

    cell: str
    chunk: int | None
    what: str
