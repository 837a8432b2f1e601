"""Search for proofs that the path of a tool is finished after a lock."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations, pairwise
from typing import Any, Self

import numpy as np

from holdfast.certificates import documents
from holdfast.certificates.claims import TASK_ROWS
from holdfast.certificates.kinds import ClaimKind
from holdfast.certificates.proof import CompositeResult
from holdfast.certificates.search_pool import JobResult, SearchBudget, SearchJob
from holdfast.certificates.tool_paths.cells import PATH_CENTER_UNIT, SEGMENT_INSTANTS, LockSlab
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.forms import LockedTrackingEnclosure
from holdfast.certificates.tool_paths.loop_closure import RefutedInterval, make_loop_closure_exclusion
from holdfast.certificates.tool_paths.march import LockSlabSearch
from holdfast.certificates.tree import SearchState
from holdfast.certificates.verifier_parts import paths
from holdfast.core.sweeps.memory import Parts

_CELLS_PER_JOB = 1 << 12  # cells that a job examines
_MAX_CHILD_JOBS = 8  # jobs to which it defers the rest
Span = tuple[int, int]


@dataclass(frozen=True, eq=False, kw_only=True)
class ToolPathResult(JobResult):
    """Result of a tool path job.

    Attributes:
        slabs: Proved intervals of lock instants in order, each with its cells.
        refuted_intervals: Refuted intervals of lock instants in order.
        deferred: Intervals of lock instants that are deferred to other jobs.
    """

    slabs: tuple[LockSlab, ...] = ()
    refuted_intervals: tuple[RefutedInterval, ...] = ()
    deferred: tuple[LockSlab, ...] = ()

    def to_arrays(self) -> Parts:
        """Return the result as arrays for the search memory, in which a slab without cells is deferred."""
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
        slabs = [
            LockSlab(begin, stop, halvings, ends, [np.array(center) for center in centers])
            for begin, stop, halvings, ends, centers in entries
        ]
        proved, deferred = (tuple(slab for slab in slabs if bool(slab.ends) == has_cells) for has_cells in (True, False))
        intervals = tuple(RefutedInterval(begin, stop, instant, bytes(tree)) for begin, stop, instant, tree in refuted)
        return super().from_arrays(arrays, slabs=proved, refuted_intervals=intervals, deferred=deferred, **values)


@dataclass(frozen=True, eq=False)
class ToolPathJob(SearchJob):
    """Job that marches through some slabs of one lock; its states refer to all instants of this lock.

    Attributes:
        claim: The claim.
        joint: Index of the joint that locks.
        followers: Indices of the joints that continue the healthy motion.
        halvings: Largest number of bisections of a slab.
        slabs: Slabs through which this job marches.
        max_cells: Number of cells that this job and each of its child jobs examine.
        name: Name in the search memory.
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
        slabs, refuted = tuple(sorted(search.proved, key=_begin)), tuple(sorted(search.refuted, key=_begin))
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


@dataclass(frozen=True, eq=False, kw_only=True)
class LockedPath(ToolPathResult):
    """Result of the search for the lock of one joint.

    Attributes:
        joint: Index of the locked joint.
        followers: Indices of the joints that continue the healthy motion because the task has fewer rows than free joints.
        proved, refuted: Exact proved and refuted fractions of the lock instants.
    """

    joint: int
    followers: tuple[int, ...]
    proved: Fraction
    refuted: Fraction

    @property
    def proved_lock_intervals(self) -> list[Span]:
        """Proved intervals of lock instants."""
        return [(slab.begin, slab.stop) for slab in self.slabs]

    @property
    def refuted_lock_intervals(self) -> list[Span]:
        """Refuted intervals of lock instants."""
        return [(interval.begin, interval.stop) for interval in self.refuted_intervals]

    @property
    def undecided(self) -> Fraction:
        """Exact fraction of the lock instants that is neither proved nor refuted."""
        return 1 - self.proved - self.refuted

    @property
    def leaves(self) -> int:
        """Number of cells of proved slabs and of joint boxes that refute other slabs."""
        joint_boxes = sum(1 + len(interval.tree) for interval in self.refuted_intervals) // 2
        return sum(len(slab.ends) for slab in self.slabs) + joint_boxes


@dataclass(frozen=True, kw_only=True)
class PathProof(CompositeResult):
    """Result of the prover for a path claim, which is not verified until :func:`check_certificate` checks it.

    Attributes:
        claim: Claim that was searched.
        parts: Results for each lock, in the order of the claim.
        document: The certificate in the form of its file.
    """

    claim: PathClaim
    parts: tuple[LockedPath, ...]
    document: dict[str, Any]

    @property
    def ok(self) -> bool:
        """True if every lock instant is proved."""
        return self.proved == 1

    @property
    def refuted(self) -> Fraction:
        """Exact fraction of the lock instants after which no motion finishes the path, for the lock with the largest one."""
        return max(part.refuted for part in self.parts)

    @property
    def undecided(self) -> Fraction:
        """Exact fraction of the lock instants that is neither proved nor refuted, for the lock with the largest one."""
        return max(part.undecided for part in self.parts)

    @property
    def tolerant(self) -> Fraction:
        """Exact fraction of the lock instants at which all locks are proved."""
        unproved_spans = [
            gap for part in self.parts for gap in paths.find_uncovered_intervals(part.proved_lock_intervals, self.document)
        ]
        return 1 - paths.measure_coverage(unproved_spans, self.document)

    def gaps(self, part: LockedPath) -> list[Span]:
        """Return the undecided intervals of lock instants of ``part``, in units of 2^-20 of a segment."""
        return paths.find_uncovered_intervals(part.proved_lock_intervals + part.refuted_lock_intervals, self.document)


def prove_path(claim: PathClaim, halvings: int, budget: SearchBudget) -> PathProof:
    """Prove as much of a path claim as possible."""
    jobs = [ToolPathJob.for_lock(claim, joint, _choose_followers(claim, joint), halvings) for joint in claim.locks]

    def measure(intervals: Sequence[LockSlab | RefutedInterval]) -> Fraction:
        return Fraction(sum(span.stop - span.begin for span in intervals), claim.during[1] - claim.during[0])

    parts = tuple(
        LockedPath(
            joint=job.joint, followers=job.followers, proved=measure(result.slabs), refuted=measure(result.refuted_intervals),
            **vars(result),
        )
        for job, result in zip(jobs, budget.run_jobs(jobs), strict=True)
    )  # fmt: skip
    return PathProof(claim=claim, parts=parts, document=_build_document(claim, parts))


def _build_document(claim: PathClaim, parts: Sequence[LockedPath]) -> documents.Document:
    """Build the certificate of slabs of lock instants for all locks; its volumes are those of the worst lock."""
    locks = []
    for part in parts:
        numbers = [number for slab in part.slabs for number in (slab.begin, slab.stop, len(slab.ends), *slab.ends)]
        centers = np.array([center for slab in part.slabs for center in slab.centers], "<i4")
        refutations = [
            {"begin": span.begin, "stop": span.stop, "at": span.path_instant, "tree": documents.compress_bytes(span.tree)}
            for span in part.refuted_intervals
        ]
        lock = {"joint": part.joint, "followers": list(part.followers), "refutations": refutations}
        lock |= {key: paths.format_fraction(getattr(part, key)) for key in ("proved", "refuted")}
        cells = documents.compress_bytes(np.array(numbers, "<i8").tobytes())
        locks.append(lock | {"cells": cells, "centres": documents.compress_bytes(centers.tobytes())})
    points, pairs = list[Any](), list[Any]()
    if refuted_joints := [part.joint for part in parts if part.refuted_intervals]:  # all locks use the same points
        exclusion = make_loop_closure_exclusion(claim, refuted_joints[0])
        assert exclusion is not None
        points = [{"link": link, "place": documents.encode_floats(position)} for link, position in exclusion.points]
        pairs = [list(pair) for pair in exclusion.pairs]
    volumes = paths.format_worst_fractions([(part.proved, part.refuted) for part in parts])
    fields = {"unit": PATH_CENTER_UNIT.hex(), "locks": locks, "points": points, "pairs": pairs, "volumes": volumes}
    seconds, nodes = sum(part.seconds for part in parts), sum(part.nodes for part in parts)
    return documents.build_document(claim, fields, seconds=seconds, nodes=nodes)


def _choose_followers(claim: PathClaim, joint: int) -> tuple[int, ...]:
    """Choose the joints that continue the healthy motion, so that the other joints stay farthest from singularities on it."""
    task_rows = TASK_ROWS[claim.task]
    others = [other for other in range(claim.arm.n) if other != joint]
    if len(others) == len(task_rows):
        return ()
    jacobians = claim.arm.jacobian(claim.knots)
    if claim.task == "pointing":  # rotations about the tool's axes
        rotations = claim.arm.forward_kinematics(claim.knots)[:, :3, :3]
        jacobians = np.concatenate([jacobians[:, :3], rotations.transpose(0, 2, 1) @ jacobians[:, 3:]], axis=1)
    jacobians = jacobians[:, task_rows]
    choices = list(combinations(others, len(others) - len(task_rows)))
    remaining = (np.delete(jacobians, [joint, *followers], axis=2) for followers in choices)
    return choices[int(np.argmax([np.linalg.svd(matrices, compute_uv=False)[:, -1].min() for matrices in remaining]))]


def _encode_path_claim(claim: PathClaim) -> dict[str, Any]:
    knots, tube = (documents.encode_floats(values) for values in (claim.knots, claim.tube))
    locks = [{"joint": joint} for joint in claim.locks]
    limits = documents.encode_limits(claim.arm)
    return {"knots": knots, "tube": tube, "limits": limits, "during": list(claim.during), "locks": locks}


PATH_KIND = ClaimKind(
    "path", lambda claim, halvings, seed, budget: prove_path(claim, halvings, budget), _encode_path_claim, halvings=6
)
