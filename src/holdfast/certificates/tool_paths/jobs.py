"""The search for motions as jobs: one for each lock, which defers slabs to child jobs after it has examined very many cells.

What a job finds depends on its claim and its slabs alone: not on how many processes there are, nor on what was found before by
a search that was stopped.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Self

import numpy as np

from holdfast.certificates.claims import TASK_ROWS
from holdfast.certificates.search_pool import JobResult, SearchJob
from holdfast.certificates.tool_paths.cells import SEGMENT_INSTANTS, LockSlab
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.forms import LockedTrackingEnclosure
from holdfast.certificates.tool_paths.loop_closure import RefutedInterval, make_loop_closure_exclusion
from holdfast.certificates.tool_paths.march import LockSlabSearch
from holdfast.certificates.tree import SearchState
from holdfast.core.sweeps.memory import Parts

_CELLS_PER_JOB = 1 << 12  # cells that a job looks at
_MAX_CHILD_JOBS = 8  # jobs that it leaves


@dataclass(frozen=True, eq=False, kw_only=True)
class ToolPathResult(JobResult):
    """Result of a tool path job.

    Attributes:
        slabs: Intervals of lock instants that are proved, in order, each with its cells.
        refuted_intervals: Those that are refuted, in order.
        deferred: Those that are left to other jobs.
    """

    slabs: tuple[LockSlab, ...] = ()
    refuted_intervals: tuple[RefutedInterval, ...] = ()
    deferred: tuple[LockSlab, ...] = ()

    def to_arrays(self) -> Parts:
        """Return the result as arrays for the search memory; a slab without cells is a deferred one."""
        slabs = [
            (slab.begin, slab.stop, slab.halvings, slab.ends, np.array(slab.centers).tolist())
            for slab in (*self.slabs, *self.deferred)
        ]
        refuted = [(entry.begin, entry.stop, entry.path_instant, [*entry.tree]) for entry in self.refuted_intervals]
        return super().to_arrays() | {"intervals": np.frombuffer(json.dumps([slabs, refuted]).encode(), dtype=np.uint8)}

    @classmethod
    def from_arrays(cls, arrays: Parts, **values: Any) -> Self:
        """Rebuild a result from the arrays of :meth:`to_arrays`."""
        entries, refuted = json.loads(arrays["intervals"].tobytes())
        slabs = [LockSlab(*numbers, [np.array(center) for center in centers]) for *numbers, centers in entries]
        return super().from_arrays(
            arrays,
            slabs=tuple(slab for slab in slabs if slab.ends),
            refuted_intervals=tuple(RefutedInterval(*numbers, bytes(tree)) for *numbers, tree in refuted),
            deferred=tuple(slab for slab in slabs if not slab.ends),
            **values,
        )


@dataclass(frozen=True, eq=False)
class ToolPathJob(SearchJob):
    """The march through some slabs of one lock, to all instants of which its states refer.

    Attributes:
        claim: The claim.
        joint: The one that locks.
        followers: Joints that go on with the healthy motion.
        halvings: Of slabs, at most.
        slabs: Which.
        max_cells: Cells that it looks at, and each of those that it leaves some to.
        name: For a memory.
    """

    result_type = ToolPathResult
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

    def make_search(self, deadline: float) -> LockSlabSearch:
        """Make the search."""
        claim = self.claim
        tube = claim.tube[[int(row > 2) for row in TASK_ROWS[claim.task]]] if claim.tube.any() else np.empty(0)
        enclosure = LockedTrackingEnclosure.from_claim(claim, [self.joint, *self.followers], tube)
        exclusion = make_loop_closure_exclusion(claim, self.joint)
        return LockSlabSearch(
            enclosure, self.slabs, self.halvings, self.max_cells, exclusion, claim.during[1] - claim.during[0]
        )

    def read_result(self, search: LockSlabSearch, **values: Any) -> ToolPathResult:
        """Return the result so far."""
        slabs, refuted = (tuple(sorted(spans, key=_begin)) for spans in (search.proved, search.refuted))
        deferred = search.deferred_slabs if values["finished"] else ()
        return ToolPathResult(slabs=slabs, refuted_intervals=refuted, deferred=deferred, **values)

    def empty_result(self) -> ToolPathResult:
        """Return a result in which everything is undecided."""
        return ToolPathResult(state=SearchState(open=1.0))

    def child_jobs(self, result: ToolPathResult) -> list[ToolPathJob]:
        """Return the child jobs of the deferred slabs."""
        group_count = min(_MAX_CHILD_JOBS, len(result.deferred))
        row_groups = np.array_split(np.arange(len(result.deferred)), group_count) if group_count else []
        return [
            replace(self, slabs=tuple(result.deferred[index] for index in rows), name=f"{self.name} {number}")
            for number, rows in enumerate(row_groups, 1)
        ]

    def merge_child_results(self, result: ToolPathResult, child_results: Sequence[ToolPathResult]) -> ToolPathResult:
        """Merge the results of the deferred slabs into this result."""
        slabs, refuted = (
            tuple(sorted((span for part in (result, *child_results) for span in getattr(part, key)), key=_begin))
            for key in ("slabs", "refuted_intervals")
        )
        return result.merge(child_results, slabs=slabs, refuted_intervals=refuted, deferred=())


def _begin(span: LockSlab | RefutedInterval) -> int:
    return span.begin
