"""Cells of a sweep: each cell is a job over rows that are split into chunks with their own seeds."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, field, replace
from hashlib import sha256
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from holdfast.core.caching import cached_property
from holdfast.core.sweeps.folder import plan_content
from holdfast.core.sweeps.samples import Column


@dataclass(frozen=True, slots=True)
class Chunk:
    """Rows that are computed and committed together.

    Attributes:
        number: Number in its cell, from 0.
        start: First row.
        stop: Row after the last.
        seed: Seed of the study.
    """

    number: int
    start: int
    stop: int
    _: KW_ONLY
    seed: int

    @property
    def sequence(self) -> np.random.SeedSequence:
        """Random source of the chunk. It depends only on the study and the number, so that the samples of cells are paired."""
        return np.random.SeedSequence(self.seed, spawn_key=(self.number,))

    @property
    def own_seed(self) -> int:
        """Integer seed from :attr:`sequence`, for functions that take only an integer."""
        low, high = self.sequence.generate_state(2, np.uint32).tolist()
        return int(low) | int(high & 0x7FFFFFFF) << 32

    def __len__(self) -> int:
        return self.stop - self.start


class SweepJob(Protocol):
    """Computation of the rows of a cell; it is pickled and sent to workers, so it contains data and nothing compiled.

    Its values depend only on the job and the chunk, not on the thread, the process or earlier chunks.
    """

    def prepare(self, alone: bool) -> None:
        """Compile, once per process; ``alone`` means that each chunk has one thread and other chunks run in parallel.

        Raises:
            HoldfastError: The job cannot run.
        """

    def columns(self) -> list[Column]:
        """Return the columns of a stored row."""

    def run(self, chunk: Chunk) -> Mapping[str, NDArray[Any]]:
        """Return the columns of ``chunk`` by name: one row for each of its rows, or one row that sums them up.

        Raises:
            HoldfastError: The chunk cannot be computed; the study continues with its other cells.
        """


@dataclass(frozen=True)
class SweepCell:
    """One cell of a sweep.

    Attributes:
        name: Name that is unique in the study and valid for a folder.
        job: Computation of the rows.
        plan: JSON data that defines its values.
        rows: Number of rows.
        chunk: Number of rows in a chunk.
        summed: A chunk is stored as one row that sums it up.
        labels: Position in the sweep, for people: ``arm``, ``index``, ...
    """

    name: str
    job: SweepJob
    plan: Mapping[str, Any]
    _: KW_ONLY
    rows: int
    chunk: int
    summed: bool = False
    labels: Mapping[str, Any] = field(default_factory=dict)

    @property
    def count(self) -> int:
        """Number of chunks."""
        return -(-self.rows // self.chunk)

    @property
    def stored_shape(self) -> tuple[int, int]:
        """Number of stored rows, in all and per chunk."""
        return (self.count, 1) if self.summed else (self.rows, self.chunk)

    @cached_property
    def digest(self) -> str:
        """Digest of everything that defines the values of the cell."""
        text = json.dumps([plan_content(self.plan), self.rows, self.chunk, self.summed], sort_keys=True)
        return sha256(text.encode()).hexdigest()[:16]

    def chunk_at(self, number: int, seed: int) -> Chunk:
        """Return the chunk with this ``number`` (from 0) of a study with this ``seed``."""
        return Chunk(number, number * self.chunk, min((number + 1) * self.chunk, self.rows), seed=seed)

    def with_rows(self, rows: int) -> SweepCell:
        """Return the same cell with only ``rows`` rows, for a trial."""
        return replace(self, rows=rows, chunk=rows)


@dataclass(frozen=True, kw_only=True)
class CellStatus:
    """Progress of a cell.

    Attributes:
        name: Name of the cell.
        labels: Position of the cell in the sweep.
        chunks, rows: Total numbers.
        chunks_done, rows_done: Numbers of committed chunks and rows.
        seconds: Computation time of the committed chunks, s.
        makers: Numbers of the machines that computed the chunks; see :attr:`holdfast.core.sweeps.Study.makers`.
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
    """Committed chunk that differs from the chunk that was written.

    Attributes:
        cell: Name of its cell; None in a folder that is not part of a study.
        chunk: Number from 0; None for a whole cell that is missing although it was begun.
        what: Description of the damage.
    """

    cell: str | None
    chunk: int | None
    what: str
