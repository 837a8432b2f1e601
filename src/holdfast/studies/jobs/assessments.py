"""Assessments as cells of a study: each is the run that :func:`holdfast.assess` would make, in chunks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from holdfast.assessment.bins import FACTS, Counts, edges
from holdfast.assessment.block import compile_for, evaluate, worst_cases
from holdfast.assessment.plan import Plan, Rows
from holdfast.engine.job import Chunk
from holdfast.engine.store import Column
from holdfast.status import Status
from holdfast.studies.jobs.process import PlannedJob

Keep = Literal["rows", "counts"]
_TOGETHER = 8  # blocks of joints; no value depends on it but the last digits of sums
_SAMPLES = (("", "index", "worst"), ("optimised_", "optimised_index", "optimised_worst"))


@dataclass(frozen=True, eq=False)
class AssessJob(PlannedJob[Plan]):
    """Poses of a region, solved and evaluated.

    Attributes:
        plan: As :meth:`holdfast.assessment.plan.Plan.to_dict` gives it.
        rows, chunk: Poses, in all and of a chunk.
        keep: ``rows``: every pose, a folder that :func:`holdfast.load` reads; ``counts``: only how values are distributed.
    """

    rows: int
    chunk: int
    keep: Keep = "rows"

    def compiled(self) -> Plan:
        """The plan, with what its equations became."""
        plan = Plan.from_dict(self.plan, self.rows)
        compile_for(plan)
        if self.keep == "counts" and plan.region.kind == "joints":
            plan.index.worst_case(np.zeros((1, plan.arm.n)))
        return plan

    def columns(self) -> list[Column]:
        """See :class:`holdfast.engine.Job`."""
        plan = self.made
        if self.keep == "rows":
            return plan.columns()
        found = []
        bins, failures = len(edges(plan.index)) - 1, len(plan.index.failures)
        for before, _, _ in _SAMPLES[: 1 + plan.optimise]:
            found += [
                Column(f"{before}bins", "int64", (("bin", bins),), units="1", about="values in each bin of the index"),
                Column(f"{before}facts", "float64", (("fact", len(FACTS)),), units="1", about=", ".join(FACTS)),
                Column(
                    f"{before}worst_counts",
                    "int64",
                    (("failure", failures),),
                    units="1",
                    about="how often each failure is the worst",
                ),
            ]
        return found

    def run(self, chunk: Chunk) -> Rows:
        """See :class:`holdfast.engine.Job`."""
        plan = self.made
        if self.keep == "rows":
            parts = list(self._blocks(plan, chunk))
            return {name: np.concatenate([p[name] for p in parts]) for name in parts[0]}
        samples = [(Counts(plan.index), np.zeros(len(plan.index.failures), np.int64)) for _ in _SAMPLES[: 1 + plan.optimise]]
        for rows in self._blocks(plan, chunk):
            reached = (rows["status"] == Status.OK) | (rows["status"] == Status.SINGULAR)
            for (before, index, worst), (counts, often) in zip(_SAMPLES, samples, strict=False):
                good = reached
                if before and "optimised_status" in rows:
                    good = reached & (rows["optimised_status"] != Status.INFEASIBLE)
                values, singular = rows[index], int(np.count_nonzero(good & (rows[worst] < 0)))
                counts.add(values if good.all() else values[good], int(np.count_nonzero(~good)), singular)
                often += np.bincount(rows[worst] + 1, minlength=often.size + 1)[1:]  # -1: there is none
        found: Rows = {}
        for (before, _, _), (counts, often) in zip(_SAMPLES, samples, strict=False):
            found |= {
                f"{before}bins": counts.bins[None],
                f"{before}facts": counts.facts[None],
                f"{before}worst_counts": often[None],
            }
        return found

    def _blocks(self, plan: Plan, chunk: Chunk) -> Iterator[Rows]:
        """Rows of a chunk, one or some blocks at a time: those of an assessment where chunks are whole blocks.

        Nothing else is drawn for configurations of joints, so many blocks go at once; where only the worst cases are counted,
        through the same memory again and again. Threads that pass Python, and the pages of new arrays, to one another after
        every block are hardly 1.4 times as fast as one.
        """
        size, joints = plan.region.block, plan.region.kind == "joints"
        first, step = chunk.number * -(-self.chunk // size), _TOGETHER * size if joints else size
        place = np.empty((min(step, chunk.stop - chunk.start), plan.arm.n)) if joints and self.keep == "counts" else None
        for start in range(chunk.start, chunk.stop, step):
            stop, number = min(start + step, chunk.stop), first + (start - chunk.start) // size
            drawn = None if place is None else place[: stop - start]
            samples = plan.region.samples(
                start, stop, number, seed=plan.seed, sampling=plan.sampling, count=self.rows, out=drawn
            )
            yield evaluate(plan, samples, number) if drawn is None else worst_cases(plan, samples)
