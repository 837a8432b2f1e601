"""Execution of a plan: blocks in the pool of threads, chunks in a folder, and the counts over all rows."""

from __future__ import annotations

import platform
from collections import deque
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import Future
from contextlib import closing
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.probability.collector import DistributionCollector
from holdfast.core.probability.distribution import Distribution
from holdfast.core.provenance import versions
from holdfast.core.status import Status
from holdfast.core.sweeps.store import Store
from holdfast.core.typing import Rows
from holdfast.kernels.threads import shared_pool, thread_count
from holdfast.studies.assessment.block import evaluate_block
from holdfast.studies.assessment.plan import AssessmentPlan

Progress = Callable[[int, int], None]


def compute_blocks(plan: AssessmentPlan, first_block: int, end_row: int) -> Generator[tuple[int, Rows], None, None]:
    """Yield blocks in order from number ``first_block`` up to row ``end_row``, with a few computed ahead in the pool."""
    block_size = plan.region.block
    source = plan.region.blocks(first_block, plan.seed, plan.sampling, count=plan.poses)
    numbers = iter(range(first_block, -(-end_row // block_size)))
    waiting: deque[tuple[int, Future[Rows]]] = deque()

    def submit_next() -> None:
        number = next(numbers, None)
        if number is not None:
            samples = next(source)[: end_row - number * block_size]
            waiting.append((number * block_size, shared_pool().submit(evaluate_block, plan, samples, number)))

    try:
        for _ in range(2 * thread_count()):
            submit_next()
        while waiting:
            start, task = waiting.popleft()
            rows = task.result()
            submit_next()
            yield start, rows
    finally:
        for _, task in waiting:
            task.cancel()


def compute_chunks(store: Store, plan: AssessmentPlan, chunks: list[int]) -> Iterator[tuple[int, Rows]]:
    """Yield the rows of chunks of a folder, each with its number."""
    block_size = plan.region.block
    while chunks:
        # Consecutive chunks share one stream of blocks, so that the workers never wait for the end of a chunk.
        length = next((offset for offset, chunk in enumerate(chunks) if chunk != chunks[0] + offset), len(chunks))
        span, chunks = chunks[:length], chunks[length:]
        stream = compute_blocks(plan, store.chunk_span(span[0])[0] // block_size, store.chunk_span(span[-1])[1])
        with closing(stream):
            for chunk in span:
                start, stop = store.chunk_span(chunk)
                parts = [next(stream)[1] for _ in range(-(-(stop - start) // block_size))]
                yield chunk, {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


class IndexStatistics:
    """Distribution of one index column, and number of poses for which each failure is the worst."""

    def __init__(self, plan: AssessmentPlan, index: str, worst: str) -> None:
        self._collector = DistributionCollector(plan.index.better, plan.index.bound, heaviest=plan.region.heaviest)
        self._index_column, self._worst_column = index, worst
        self.worst_counts: NDArray[Any] = np.zeros(len(plan.index.failures), dtype=np.float64 if plan.has_weights else np.int64)

    def add(self, rows: Rows, reached: NDArray[np.bool_]) -> None:
        """Count a block of rows."""
        worst, weight = rows[self._worst_column], rows.get("weight")
        weights = () if weight is None else (weight[reached], weight[~reached])
        self._collector.add(rows[self._index_column][reached], int((~reached).sum()), int((worst[reached] < 0).sum()), *weights)
        has_worst = worst >= 0
        self.worst_counts += np.bincount(
            worst[has_worst], None if weight is None else weight[has_worst], minlength=self.worst_counts.size
        )

    def finish(self) -> Distribution:
        """Return the distribution of everything added."""
        return self._collector.make_distribution()


@dataclass(frozen=True)
class Collisions:
    """Counts, without weights, of configurations in which the arm collides with itself or its cell.

    Attributes:
        found: Number of colliding configurations among those that inverse kinematics found.
        blocked: Number of poses whose best configuration collides; a collision-free one replaces it if there is one.
        hopeless: Number of these poses without a collision-free configuration, which count as not reached when optimised.
        reached: Number of poses with a configuration.
        margin: Smallest clearance of the best configurations, m.
        with_each: Number of configurations in ``found`` that collide with the arm itself and with each object of a cell; empty
            without a cell. Distances from objects are lower bounds, so these numbers are upper bounds.
        blocked_by: Number of poses in ``blocked`` by the nearest collision partner in a cell; empty without a cell.
    """

    found: int
    blocked: int
    hopeless: int
    reached: int
    margin: float
    with_each: dict[str, int]
    blocked_by: dict[str, int]


class AssessmentTally:
    """Counts over all rows of a plan, added one block at a time.

    Attributes:
        unoptimised: Statistics at the configurations that inverse kinematics found.
        optimised: Statistics at the best configurations, if the plan requests them.
        collisions: Collisions of the arm with itself and its cell, if the plan has a clearance.
        clear: Number of poses, or their weight, with a collision-free configuration, if there is a cell.
        survivors: (n,) number of poses, or their weight, still reached after each joint has locked, if the plan requests it.
    """

    def __init__(self, plan: AssessmentPlan) -> None:
        self._margin = plan.margin
        self._collisions = None if plan.clearance is None else np.zeros(4, dtype=np.int64)
        self._partner_names = plan.collision_partners
        self._with_each, self._blocked_by = np.zeros((2, len(plan.collision_partners)), dtype=np.int64)
        self.clear: float | None = None if plan.cell is None or plan.region.kind == "joints" else 0.0
        self.unoptimised = IndexStatistics(plan, "index", "worst")
        self.optimised = IndexStatistics(plan, "optimised_index", "optimised_worst") if plan.optimise else None
        self.survivors: NDArray[Any] | None = None
        if plan.locks:
            self.survivors = np.zeros(plan.arm.n, dtype=np.float64 if plan.has_weights else np.int64)

    def add(self, rows: Rows) -> None:
        """Count a block of rows."""
        reached = (rows["status"] == Status.OK) | (rows["status"] == Status.SINGULAR)
        self.unoptimised.add(rows, reached)
        if self.optimised is not None:
            hopeless = np.zeros(reached.size, dtype=bool)
            if "optimised_status" in rows:
                hopeless = rows["optimised_status"] == Status.INFEASIBLE
            self.optimised.add(rows, reached & ~hopeless)
            if self._collisions is not None:
                self._collisions[1:3] += [(rows["blocked"][reached] == 1).sum(), hopeless[reached].sum()]
        if self._collisions is not None:
            self._collisions[[0, 3]] += [(rows["clearance"][reached] < 0).sum(), reached.sum()]
        if self._partner_names:
            self._with_each += (rows["from_each"][reached] < 0).sum(axis=0)
        if "blocked_by" in rows:
            barred = rows["blocked_by"][reached & (rows["blocked"] == 1)]
            self._blocked_by += np.bincount(barred, minlength=len(self._partner_names))
        if self.clear is not None:
            is_clear = rows["clear"] == 1
            self.clear += float(rows["weight"] @ is_clear) if "weight" in rows else int(is_clear.sum())
        if self.survivors is not None:
            survives = rows["survives"] == 1
            self.survivors += rows["weight"] @ survives if "weight" in rows else survives.sum(axis=0)

    @property
    def collisions(self) -> Collisions | None:
        """Counts of collisions; None if the plan has no clearance."""
        if self._collisions is None:
            return None
        colliding, blocked, hopeless, reached = self._collisions.tolist()
        partner_counts = [
            dict(zip(self._partner_names, counts.tolist(), strict=True)) for counts in (self._with_each, self._blocked_by)
        ]
        return Collisions(colliding, blocked, hopeless, reached, self._margin, *partner_counts)


def describe_provenance(seconds: float | None) -> dict[str, Any]:
    """Return the date, versions, and machine of a computation; none of these define the rows."""
    return {
        "seconds": seconds,
        "finished": datetime.now(UTC).isoformat(timespec="seconds"),
        "versions": versions("holdfast", "numpy", "scipy", "casadi", "llvmlite", "xarray", "zarr"),
        "python": platform.python_version(),
        "machine": platform.machine(),
        "threads": thread_count(),
    }
