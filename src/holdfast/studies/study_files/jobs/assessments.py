"""Assessments as cells of a study, each of which is a run of :func:`holdfast.assess` in chunks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from holdfast.core.status import Status
from holdfast.core.sweeps.job import Chunk
from holdfast.core.sweeps.samples import Column
from holdfast.core.typing import Rows
from holdfast.studies.assessment.bins import FACT_NAMES, IndexCounts, compute_bin_edges
from holdfast.studies.assessment.block import compile_plan, evaluate_block, evaluate_worst_cases
from holdfast.studies.assessment.plan import AssessmentPlan
from holdfast.studies.study_files.jobs.process import PlannedJob

Keep = Literal["rows", "counts"]
_JOINT_BLOCKS_PER_STEP = 8  # blocks of configurations; only the last digits of sums depend on it
_SAMPLE_COLUMNS = (("", "index", "worst"), ("optimised_", "optimised_index", "optimised_worst"))


@dataclass(frozen=True, eq=False)
class AssessJob(PlannedJob[AssessmentPlan]):
    """Job that solves and evaluates poses of a region.

    Attributes:
        plan: Data of :meth:`holdfast.studies.assessment.plan.AssessmentPlan.to_dict`.
        rows, chunk: Number of all poses, and of the poses in a chunk.
        keep: ``rows`` to store every pose in a folder for :func:`holdfast.load`; ``counts`` to store only distributions.
    """

    rows: int
    chunk: int
    keep: Keep = "rows"

    def compile_plan(self) -> AssessmentPlan:
        """Return the plan after compiling its equations."""
        plan = AssessmentPlan.from_dict(self.plan, self.rows)
        compile_plan(plan)
        if self.keep == "counts" and plan.region.kind == "joints":
            plan.index.worst_case(np.zeros((1, plan.arm.n)))
        return plan

    def columns(self) -> list[Column]:
        """Return the columns of the results; see :class:`holdfast.core.sweeps.SweepJob`."""
        plan = self.compiled_parts
        if self.keep == "rows":
            return plan.columns()
        table = [
            ("bins", "int64", ("bin", len(compute_bin_edges(plan.index)) - 1), "values in each bin of the index"),
            ("facts", "float64", ("fact", len(FACT_NAMES)), ", ".join(FACT_NAMES)),
            ("worst_counts", "int64", ("failure", len(plan.index.failures)), "how often each failure is the worst"),
        ]
        prefixes = [prefix for prefix, _, _ in _SAMPLE_COLUMNS[: 1 + plan.optimise]]
        return [Column(prefix + name, kind, (dim,), about=about) for prefix in prefixes for name, kind, dim, about in table]

    def run(self, chunk: Chunk) -> Rows:
        """Compute the rows of a chunk; see :class:`holdfast.core.sweeps.SweepJob`."""
        plan = self.compiled_parts
        if self.keep == "rows":
            parts = list(self._iterate_blocks(plan, chunk))
            return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
        samples = [
            (IndexCounts(plan.index), np.zeros(len(plan.index.failures), np.int64))
            for _ in _SAMPLE_COLUMNS[: 1 + plan.optimise]
        ]
        for rows in self._iterate_blocks(plan, chunk):
            reached = (rows["status"] == Status.OK) | (rows["status"] == Status.SINGULAR)
            for (prefix, index, worst), (counts, worst_counts) in zip(_SAMPLE_COLUMNS, samples, strict=False):
                is_counted = reached
                if prefix and "optimised_status" in rows:
                    is_counted = reached & (rows["optimised_status"] != Status.INFEASIBLE)
                values, singular = rows[index], int(np.count_nonzero(is_counted & (rows[worst] < 0)))
                counts.add(values if is_counted.all() else values[is_counted], int(np.count_nonzero(~is_counted)), singular)
                worst_counts += np.bincount(rows[worst] + 1, minlength=worst_counts.size + 1)[1:]  # -1 stands for no failure
        result: Rows = {}
        for (prefix, _, _), (counts, worst_counts) in zip(_SAMPLE_COLUMNS, samples, strict=False):
            result |= {
                f"{prefix}bins": counts.bins[None],
                f"{prefix}facts": counts.facts[None],
                f"{prefix}worst_counts": worst_counts[None],
            }
        return result

    def _iterate_blocks(self, plan: AssessmentPlan, chunk: Chunk) -> Iterator[Rows]:
        """Yield the rows of a chunk, one or several blocks at a time; for chunks of whole blocks they equal an assessment's.

        Configurations of joints need no further random numbers, so many blocks are computed at once, and in the same memory if
        only the worst cases are counted. Threads that exchange Python's lock, and pages of new arrays, after every block are
        hardly 1.4 times as fast as one thread.
        """
        block_size, joints = plan.region.block, plan.region.kind == "joints"
        first, step = chunk.number * -(-self.chunk // block_size), _JOINT_BLOCKS_PER_STEP * block_size if joints else block_size
        buffer = np.empty((min(step, chunk.stop - chunk.start), plan.arm.n)) if joints and self.keep == "counts" else None
        for start in range(chunk.start, chunk.stop, step):
            stop, number = min(start + step, chunk.stop), first + (start - chunk.start) // block_size
            output = None if buffer is None else buffer[: stop - start]
            samples = plan.region.samples(
                start, stop, number, seed=plan.seed, sampling=plan.sampling, count=self.rows, out=output
            )
            yield evaluate_block(plan, samples, number) if output is None else evaluate_worst_cases(plan, samples)
