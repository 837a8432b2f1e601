"""What a dry run says of the time, with a clock that only the job moves."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pytest

from holdfast.core.sweeps import Column, SweepCell
from holdfast.studies.study_files import estimate


@dataclass(eq=False)
class Costs:
    """A job that takes known times: once, for each chunk, for each row."""

    once: float
    a_chunk: float
    a_row: float
    now: float = 0.0
    runs: list[int] = field(default_factory=list)

    def prepare(self, alone):
        pass

    def columns(self):
        return [Column("x", "float64", (("a", 3),))]

    def run(self, chunk):
        self.now += (0 if self.runs else self.once) + self.a_chunk + self.a_row * len(chunk)
        self.runs.append(len(chunk))
        return {"x": np.zeros((len(chunk), 3))}


def watch(job, monkeypatch):
    for clock in ("thread_time", "process_time"):
        monkeypatch.setattr(estimate.time, clock, lambda: job.now)


@pytest.mark.parametrize(
    ("once", "a_chunk", "a_row", "rows", "chunk"),
    [
        (20.0, 0.1, 0.01, 10_000, 64),
        (0.0, 0.0, 0.02, 1000, 500),
        (5.0, 1.0, 0.0, 640, 64),
        (5.0, 0.0, 0.5, 100, 50),
        (9.0, 0.0, 1.0, 3, 1),
    ],
)
def test_what_is_compiled_once_is_not_counted_with_every_row(once, a_chunk, a_row, rows, chunk, monkeypatch):
    """A sweep of designs compiled its kernels in the first eight rows: their time times all designs was announced."""
    job = Costs(once, a_chunk, a_row)
    watch(job, monkeypatch)
    (found,) = estimate.estimate_cells([SweepCell("c", job, {}, rows=rows, chunk=chunk)], 0)
    chunks = -(-rows // chunk)
    assert found.size == 24 * rows
    if a_chunk * 4 > 3:  # one try says nothing of how rows and chunks share it
        assert found.seconds >= a_chunk * chunks
    else:
        assert found.seconds == pytest.approx(a_chunk * chunks + a_row * rows)
    assert max(job.runs) <= chunk


def test_writing_a_chunk_counts(monkeypatch):
    """Chunks of a counts study are quickly computed: writing 4,000 of them took most of the time."""
    job = Costs(0.0, 0.001, 0.0)
    write = estimate.Store.commit_chunk

    def slow(self, *given, **options):
        job.now += 0.25
        write(self, *given, **options)

    watch(job, monkeypatch)
    monkeypatch.setattr(estimate.Store, "commit_chunk", slow)
    (found,) = estimate.estimate_cells([SweepCell("c", job, {}, rows=1000, chunk=10)], 0)
    assert found.seconds == pytest.approx(100 * 0.251)
