"""What a study computes: cells, each a job over rows that are split into chunks with seeds of their own."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, field
from hashlib import sha256
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from holdfast.caching import cached_property
from holdfast.engine.folder import by_content
from holdfast.engine.store import Column


@dataclass(frozen=True, slots=True)
class Chunk:
    """Rows that are computed and committed together.

    Attributes:
        number: From 0, in its cell.
        start: Its first row.
        stop: The row after its last.
        seed: Of the study.
    """

    number: int
    start: int
    stop: int
    _: KW_ONLY
    seed: int

    @property
    def sequence(self) -> np.random.SeedSequence:
        """Its own source of random numbers: of one study and number, the same in every cell, so that cells are paired."""
        return np.random.SeedSequence(self.seed, spawn_key=(self.number,))

    @property
    def own_seed(self) -> int:
        """A whole number from :attr:`sequence`, for what takes no more than that."""
        low, high = self.sequence.generate_state(2, np.uint32).tolist()
        return int(low) | int(high & 0x7FFFFFFF) << 32

    def __len__(self) -> int:
        return self.stop - self.start


class Job(Protocol):
    """How the rows of a cell are computed. It is pickled and sent to workers, so it holds data, not compiled things.

    Its values depend on the job and the chunk alone: not on the thread, the process or what was computed before.
    """

    def prepare(self, alone: bool) -> None:
        """Compile, once in a process; ``alone``: each chunk has one thread and others are at work beside it.

        Raises:
            HoldfastError: The job cannot be done.
        """

    def columns(self) -> list[Column]:
        """What each stored row holds."""

    def run(self, chunk: Chunk) -> Mapping[str, NDArray[Any]]:
        """The columns of a chunk: a row for each of its rows, or one row that sums them up.

        Raises:
            HoldfastError: It cannot be done; the study continues with its other cells.
        """


@dataclass(frozen=True)
class Cell:
    """One cell of a sweep.

    Attributes:
        name: Unique in the study, fit for a folder.
        job: What computes it.
        plan: JSON data that defines its values.
        rows: How many are computed.
        chunk: Of them in a chunk.
        summed: A chunk is stored as one row that sums it up.
        labels: What it is in the sweep, for people: ``arm``, ``index``, ...
    """

    name: str
    job: Job
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
    def stored(self) -> tuple[int, int]:
        """Rows that are stored, in all and of a chunk."""
        return (self.count, 1) if self.summed else (self.rows, self.chunk)

    @cached_property
    def digest(self) -> str:
        """Of all that defines its values."""
        text = json.dumps([by_content(self.plan), self.rows, self.chunk, self.summed], sort_keys=True)
        return sha256(text.encode()).hexdigest()[:16]

    def part(self, number: int, seed: int) -> Chunk:
        """A chunk by its number."""
        return Chunk(number, number * self.chunk, min((number + 1) * self.chunk, self.rows), seed=seed)

    def smaller(self, rows: int) -> Cell:
        """The same with fewer rows, to try it."""
        return Cell(self.name, self.job, self.plan, rows=rows, chunk=rows, summed=self.summed, labels=self.labels)
