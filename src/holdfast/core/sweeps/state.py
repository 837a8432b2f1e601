"""Progress of a cell of a study, and its damaged chunks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, kw_only=True)
class CellStatus:
    """Progress of a cell.

    Attributes:
        name: Of the cell.
        labels: What it is in the sweep.
        chunks, rows: In all.
        chunks_done, rows_done: Committed.
        seconds: Time that these took where they were computed.
        makers: Numbers of what computed them, of :attr:`holdfast.core.sweeps.Study.makers`.
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
    def is_complete(self) -> bool:
        """True if all chunks of the cell are stored."""
        return self.chunks_done == self.chunks


@dataclass(frozen=True)
class DamagedChunk:
    """Committed chunk that differs from what was written; number from 0, None for a whole cell that was begun and
    is missing.
    """

    cell: str
    chunk: int | None
    what: str
