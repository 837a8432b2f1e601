"""The search for motions as jobs: one for each lock, which defers slabs to child jobs after it has examined very many cells.

What a job finds depends on its claim and its slabs alone: not on how many processes there are, nor on what was found before by
a search that was stopped.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.claims import TASK_ROWS
from holdfast.certificates.search_pool import StopCheck
from holdfast.certificates.taylor import CertificateChain
from holdfast.certificates.tool_paths.cells import SEGMENT_INSTANTS
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.forms import LockedTrackingEnclosure
from holdfast.certificates.tool_paths.loop_closure import RefutedInterval, make_loop_closure_exclusion
from holdfast.certificates.tool_paths.march import LockSlabSearch
from holdfast.certificates.tool_paths.slabs import LockSlab
from holdfast.certificates.tree import SearchState
from holdfast.core.sweeps.memory import Parts

_CELLS_PER_JOB = 1 << 12  # cells that a job looks at
_MAX_CHILD_JOBS = 8  # jobs that it leaves


@dataclass(frozen=True, eq=False)
class ToolPathResult:
    """Result of a tool path job.

    Attributes:
        slabs: Intervals of lock instants that are proved, in order, each with its cells.
        never: Those that are refuted, in order.
        deferred: Those that are left to other jobs.
        closed_instants: Instants of slabs that are done with.
        nodes: Cells that were looked at.
        finished: Nothing is open, but for what is left.
        seconds: Measured.
        claimed_instants: Instants of the claim.
    """

    slabs: Sequence[LockSlab]
    never: Sequence[RefutedInterval]
    deferred: Sequence[LockSlab]
    closed_instants: int
    nodes: int
    finished: bool
    seconds: float
    claimed_instants: int

    @property
    def state(self) -> SearchState:
        """Progress, as fractions of the lock instants of one joint."""
        proved_instants, refuted_instants = (
            sum(interval.stop - interval.begin for interval in intervals) for intervals in (self.slabs, self.never)
        )
        proved, refuted, undecided = (
            instants / self.claimed_instants
            for instants in (proved_instants, refuted_instants, self.closed_instants - proved_instants - refuted_instants)
        )
        open_fraction = 1 - self.closed_instants / self.claimed_instants
        return SearchState(proved=proved, refuted=refuted, undecided=undecided, open=open_fraction, nodes=self.nodes)

    def to_arrays(self) -> Parts:
        """Return the result as arrays for the search memory."""
        cells = [number for slab in self.slabs for number in (slab.begin, slab.stop, slab.halvings, len(slab.ends), *slab.ends)]
        deferred = [number for slab in self.deferred for number in (slab.begin, slab.stop, slab.halvings)]
        arrays: dict[str, NDArray[np.int64]] = {
            "cells": np.array(cells, dtype=np.int64),
            "centres": np.array([center for slab in self.slabs for center in slab.centers], dtype=np.int64),
            "left": np.array(deferred, dtype=np.int64),
            "never": np.array(
                [
                    number
                    for interval in self.never
                    for number in (interval.begin, interval.stop, interval.path_instant, len(interval.tree), *interval.tree)
                ],
                dtype=np.int64,
            ),
            "counts": np.array([self.closed_instants, self.nodes, self.claimed_instants], dtype=np.int64),
        }
        return {**arrays, "seconds": np.array([self.seconds])}

    def check_cell_limit(self) -> None:
        """Do nothing: the cells always fit, since a slab is one of the claim, halved a limited number of times."""


@dataclass(frozen=True, eq=False)
class ToolPathJob:
    """The march through some slabs of one lock.

    Attributes:
        claim: The claim.
        joint: The one that locks.
        followers: Joints that go on with the healthy motion.
        halvings: Of slabs, at most.
        slabs: Which.
        max_cells: Cells that it looks at, and each of those that it leaves some to.
        name: For a memory.
    """

    claim: PathClaim
    joint: int
    followers: tuple[int, ...]
    halvings: int
    slabs: tuple[LockSlab, ...]
    max_cells: int
    name: str

    @classmethod
    def for_lock(cls, claim: PathClaim, joint: int, followers: tuple[int, ...], halvings: int) -> ToolPathJob:
        """Make the job of all lock instants of a joint."""
        first, last = claim.during
        faces = [first, *range((first // SEGMENT_INSTANTS + 1) * SEGMENT_INSTANTS, last, SEGMENT_INSTANTS), last]
        slabs = tuple(LockSlab(begin, stop) for begin, stop in pairwise(faces))
        return cls(claim, joint, followers, halvings, slabs, _CELLS_PER_JOB, f"lock {joint + 1}")

    @property
    def claim_fraction(self) -> float:
        """Fraction of the claim part to which the states refer: the whole lock."""
        return 1.0

    @property
    def claimed_instant_count(self) -> int:
        """Number of lock instants of the claim."""
        return self.claim.during[1] - self.claim.during[0]

    def start(self, deadline: float) -> RunningToolPathJob:
        """Start the job."""
        return RunningToolPathJob(self)

    def empty_result(self) -> ToolPathResult:
        """Return a result in which everything is undecided."""
        return ToolPathResult((), (), (), 0, 0, False, 0.0, self.claimed_instant_count)

    def result_from_arrays(self, arrays: Parts) -> ToolPathResult:
        """Rebuild a result from the arrays of :meth:`ToolPathResult.to_arrays`."""
        numbers, centers, slabs = arrays["cells"].tolist(), iter(arrays["centres"]), list[LockSlab]()
        while numbers:
            begin, stop, halvings, count = numbers[:4]
            ends, numbers = numbers[4 : 4 + count], numbers[4 + count :]
            slabs.append(LockSlab(begin, stop, halvings, ends, [next(centers) for _ in ends]))
        values, refuted = arrays["never"].tolist(), list[RefutedInterval]()
        while values:
            (begin, stop, path_instant, tree_bytes), values = values[:4], values[4:]
            refuted.append(RefutedInterval(begin, stop, path_instant, bytes(values[:tree_bytes])))
            values = values[tree_bytes:]
        deferred = [LockSlab(*numbers) for numbers in arrays["left"].reshape(-1, 3).tolist()]
        closed, nodes, total = arrays["counts"].tolist()
        return ToolPathResult(slabs, refuted, deferred, closed, nodes, True, float(arrays["seconds"][0]), total)

    def child_jobs(self, result: ToolPathResult) -> list[ToolPathJob]:
        """Return the child jobs of the deferred slabs."""
        row_groups = (
            np.array_split(np.arange(len(result.deferred)), min(_MAX_CHILD_JOBS, len(result.deferred)))
            if result.deferred
            else []
        )
        return [
            replace(self, slabs=tuple(result.deferred[index] for index in rows), name=f"{self.name} {number}")
            for number, rows in enumerate(row_groups, 1)
        ]

    def merge_child_results(self, result: ToolPathResult, child_results: Sequence[ToolPathResult]) -> ToolPathResult:
        """Merge the results of the deferred slabs into this result."""
        results = [result, *child_results]
        slabs = sorted((slab for entry in results for slab in entry.slabs), key=lambda slab: slab.begin)
        refuted = sorted((entry for partial_result in results for entry in partial_result.never), key=lambda entry: entry.begin)
        return ToolPathResult(
            slabs, refuted, (), sum(entry.closed_instants for entry in results), sum(entry.nodes for entry in results),
            all(entry.finished for entry in results), sum(entry.seconds for entry in results), result.claimed_instants,
        )  # fmt: skip


class RunningToolPathJob:
    """A started tool path job.

    Attributes:
        job: Which.
        finished: Nothing is open, but for what is left to others.
    """

    def __init__(self, job: ToolPathJob) -> None:
        self.job, self.finished, self._seconds = job, False, 0.0
        claim = job.claim
        tube = claim.tube[[int(row > 2) for row in TASK_ROWS[claim.task]]] if claim.tube.any() else np.empty(0)
        limits = np.column_stack([claim.arm.lower, claim.arm.upper])
        enclosure = LockedTrackingEnclosure(
            CertificateChain.from_arm(claim.arm), claim.knots, claim.task, driven=[job.joint, *job.followers], tube=tube,
            limits=limits, slides=claim.arm.prismatic,
        )  # fmt: skip
        self._march = LockSlabSearch(
            enclosure, job.slabs, job.halvings, job.max_cells, make_loop_closure_exclusion(claim, job.joint)
        )

    def run(self, deadline: float, should_stop: StopCheck, report_progress: Callable[[], None]) -> None:
        """Continue the search until the monotonic time ``deadline``, or until ``should_stop()`` is true."""
        started = perf_counter()
        self.finished = self._march.run(deadline, should_stop, report_progress)
        self._seconds += perf_counter() - started

    @property
    def state(self) -> SearchState:
        """Current progress of the job."""
        return self.result().state

    def result(self) -> ToolPathResult:
        """Return the result so far."""
        march = self._march
        slabs = sorted(march.proved, key=lambda slab: slab.begin)
        deferred = march.deferred_slabs if self.finished else []
        refuted = sorted(march.refuted, key=lambda interval: interval.begin)
        return ToolPathResult(
            slabs,
            refuted,
            deferred,
            march.closed_instants,
            march.nodes,
            self.finished,
            self._seconds,
            self.job.claimed_instant_count,
        )
