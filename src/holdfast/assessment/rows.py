"""Running a plan: blocks in the pool of threads, chunks in a folder, and what is counted on the way."""

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

from holdfast.assessment.block import evaluate
from holdfast.assessment.plan import Plan, Rows
from holdfast.engine.store import Store
from holdfast.errors import StoreError
from holdfast.kernels.threads import pool, thread_count
from holdfast.probability.collector import Collector
from holdfast.probability.distribution import Distribution
from holdfast.provenance import versions
from holdfast.status import Status

Progress = Callable[[int, int], None]


def blocks(plan: Plan, first: int, stop: int) -> Generator[tuple[int, Rows], None, None]:
    """Blocks in order from number ``first`` up to row ``stop``; a few ahead of the consumer are at work in the pool."""
    size = plan.region.block
    source = plan.region.blocks(first, plan.seed, plan.sampling, count=plan.poses)
    numbers = iter(range(first, -(-stop // size)))
    waiting: deque[tuple[int, Future[Rows]]] = deque()

    def submit() -> None:
        number = next(numbers, None)
        if number is not None:
            samples = next(source)[: stop - number * size]
            waiting.append((number * size, pool().submit(evaluate, plan, samples, number)))

    try:
        for _ in range(2 * thread_count()):
            submit()
        while waiting:
            start, task = waiting.popleft()
            rows = task.result()
            submit()
            yield start, rows
    finally:
        for _, task in waiting:
            task.cancel()


def fill(store: Store, plan: Plan, progress: Progress | None) -> None:
    """Compute and commit the chunks that are missing."""
    missing, chunks = store.missing, store.chunks
    done = plan.poses - sum(chunks[k][1] - chunks[k][0] for k in missing)
    if progress is not None:
        progress(done, plan.poses)
    while missing:
        # Chunks that follow one another share one stream of blocks, so that the workers never wait for a chunk's end.
        length = next((i for i, k in enumerate(missing) if k != missing[0] + i), len(missing))
        span, missing = missing[:length], missing[length:]
        stream = blocks(plan, chunks[span[0]][0] // plan.region.block, chunks[span[-1]][1])
        with closing(stream):
            for k in span:
                start, stop = chunks[k]
                parts = [next(stream)[1] for _ in range(-(-(stop - start) // plan.region.block))]
                kept = [c.name for c in store.columns]
                store.write(k, {name: np.concatenate([p[name] for p in parts]) for name in parts[0] if name in kept})
                done += stop - start
                if progress is not None:
                    progress(done, plan.poses)


def stored(store: Store, plan: Plan) -> Iterator[Rows]:
    """The committed chunks of a folder.

    Raises:
        StoreError: A chunk is damaged or lost.
    """
    names = [c.name for c in store.columns]  # an older folder has no 'lock_angle'
    for k in store.done:
        rows = store.read(k, names)
        lost = _lost(rows, list(plan.locks))
        if lost is not None:
            raise StoreError(
                f"'{store.path}' is damaged: chunk {k + 1} is marked done but its '{lost}' is lost; "
                "start the run again in a new folder"
            )
        yield rows


def _lost(rows: Rows, locks: list[int]) -> str | None:
    """A column whose values are the fill value where there must be one: its file is gone."""
    status = rows["status"]
    if (status == Status.NOT_COMPUTED).any():
        return "status"
    reached = (status == Status.OK) | (status == Status.SINGULAR)
    best, usable = reached, rows["clear"] == 1 if "clear" in rows else reached
    if "optimised_status" in rows:
        if (rows["optimised_status"] == Status.NOT_COMPUTED).any():
            return "optimised_status"
        if (rows["blocked"] < 0).any():
            return "blocked"
        best = reached & (rows["optimised_status"] != Status.INFEASIBLE)
    for name, values in rows.items():
        if name in ("position", "quaternion", "weight"):
            there = values
        elif name == "lock_angle":  # joints not asked for have NaN everywhere
            there = values[usable][:, locks]
        else:
            there = values[best if name.startswith("optimised_") else reached]
        if values.dtype.kind == "f" and np.isnan(there).any():
            return name
    # Whole numbers are -1 where there is nothing; at an ordinary configuration, which the best one never undercuts, there is.
    for name in ("worst", "optimised_worst", "survives", "clear"):
        if name in rows:
            values = rows[name][:, locks] if name == "survives" else rows[name]  # joints not asked for have -1 everywhere
            asked = {"optimised_worst": best, "survives": usable}.get(name, reached)
            if (values[(status == Status.OK) & asked] < 0).any():
                return name
    return None


class Count:
    """Distribution of one index column and how often each failure is the worst."""

    def __init__(self, plan: Plan, index: str, worst: str) -> None:
        self._collector = Collector(plan.index.better, plan.index.bound, heaviest=plan.region.heaviest)
        self._index, self._worst = index, worst
        self.worst: NDArray[Any] = np.zeros(len(plan.index.failures), dtype=np.float64 if plan.weighted else np.int64)

    def add(self, rows: Rows, reached: NDArray[np.bool_]) -> None:
        """Count a block of rows."""
        worst, weight = rows[self._worst], rows.get("weight")
        weights = () if weight is None else (weight[reached], weight[~reached])
        self._collector.add(rows[self._index][reached], int((~reached).sum()), int((worst[reached] < 0).sum()), *weights)
        some = worst >= 0
        self.worst += np.bincount(worst[some], None if weight is None else weight[some], minlength=self.worst.size)

    def finish(self) -> Distribution:
        """The distribution of everything added."""
        return self._collector.finish()


@dataclass(frozen=True)
class Collisions:
    """Configurations that bring the arm into collision with itself or its cell, counted without weights.

    Attributes:
        found: Of those that inverse kinematics found.
        blocked: Poses whose best configuration, if one does not look, would; a clear one was taken instead where there is one.
        hopeless: Of these, poses for which every configuration found does: they count as not reached when optimised.
        reached: Poses with a configuration.
        margin: Smallest clearance asked of the best configurations, m.
        with_each: With a cell, how many of those in ``found`` are with the arm itself and with each object; else empty.
            Distances from objects are lower bounds, so these are at most so many.
        blocked_by: With a cell, by what those in ``blocked`` are barred: what is nearest there; else empty.
    """

    found: int
    blocked: int
    hopeless: int
    reached: int
    margin: float
    with_each: dict[str, int]
    blocked_by: dict[str, int]


class Tally:
    """What is counted over all rows of a plan, added one block at a time.

    Attributes:
        found: At the configurations that inverse kinematics found.
        optimised: At the best configurations, if the plan asks for them.
        collisions: Of the arm with itself and its cell, if the plan has a clearance.
        clear: Poses of which a configuration clear of itself and the cell was found, or their weights, if there is a cell.
        survivors: (n,) poses still reached once each joint has locked, or their weights, if the plan asks for them.
    """

    def __init__(self, plan: Plan) -> None:
        self._margin = plan.margin
        self._collisions = None if plan.clearance is None else np.zeros(4, dtype=np.int64)
        self._others = plan.others
        self._with_each, self._blocked_by = np.zeros((2, len(plan.others)), dtype=np.int64)
        self.clear: float | None = None if plan.cell is None or plan.region.kind == "joints" else 0.0
        self.found = Count(plan, "index", "worst")
        self.optimised = Count(plan, "optimised_index", "optimised_worst") if plan.optimise else None
        self.survivors: NDArray[Any] | None = None
        if plan.locks:
            self.survivors = np.zeros(plan.arm.n, dtype=np.float64 if plan.weighted else np.int64)

    def add(self, rows: Rows) -> None:
        """Count a block of rows."""
        reached = (rows["status"] == Status.OK) | (rows["status"] == Status.SINGULAR)
        self.found.add(rows, reached)
        if self.optimised is not None:
            hopeless = np.zeros(reached.size, dtype=bool)
            if "optimised_status" in rows:
                hopeless = rows["optimised_status"] == Status.INFEASIBLE
            self.optimised.add(rows, reached & ~hopeless)
            if self._collisions is not None:
                self._collisions[1:3] += [(rows["blocked"][reached] == 1).sum(), hopeless[reached].sum()]
        if self._collisions is not None:
            self._collisions[[0, 3]] += [(rows["clearance"][reached] < 0).sum(), reached.sum()]
        if self._others:
            self._with_each += (rows["from_each"][reached] < 0).sum(axis=0)
        if "blocked_by" in rows:
            barred = rows["blocked_by"][reached & (rows["blocked"] == 1)]
            self._blocked_by += np.bincount(barred, minlength=len(self._others))
        if self.clear is not None:
            clear = rows["clear"] == 1
            self.clear += float(rows["weight"] @ clear) if "weight" in rows else int(clear.sum())
        if self.survivors is not None:
            left = rows["survives"] == 1
            self.survivors += rows["weight"] @ left if "weight" in rows else left.sum(axis=0)

    @property
    def collisions(self) -> Collisions | None:
        """What was counted of collisions, or None if the plan has no clearance."""
        if self._collisions is None:
            return None
        found, blocked, hopeless, reached = self._collisions.tolist()
        each = [dict(zip(self._others, n.tolist(), strict=True)) for n in (self._with_each, self._blocked_by)]
        return Collisions(found, blocked, hopeless, reached, self._margin, *each)


def provenance(seconds: float | None) -> dict[str, Any]:
    """When, with what and on what a run was computed; none of it defines the rows."""
    return {
        "seconds": seconds,
        "finished": datetime.now(UTC).isoformat(timespec="seconds"),
        "versions": versions("holdfast", "numpy", "scipy", "casadi", "llvmlite", "xarray", "zarr"),
        "python": platform.python_version(),
        "machine": platform.machine(),
        "threads": thread_count(),
    }
