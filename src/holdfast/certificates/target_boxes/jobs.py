"""The search for a proof as jobs: one for each part of a claim, or one for each box of a part that takes very many cells.

What a job finds depends on its claim, its box and the seed alone: not on how many processes there are, nor on what was found
before by a search that was stopped.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from holdfast.certificates import verifier
from holdfast.certificates.claims import ReachClaim
from holdfast.certificates.search_pool import StopCheck
from holdfast.certificates.target_boxes.search import TargetBoxSearch
from holdfast.certificates.taylor import ReachSolver
from holdfast.certificates.tree import SPLIT_TOKEN, UNDECIDED_TOKEN, SearchState, compute_undecided_fraction
from holdfast.core.errors import InputError
from holdfast.core.formatting import format_duration
from holdfast.core.sweeps.memory import Parts
from holdfast.core.typing import FloatArray, IndexArray

_WARN_UNREACHED_FRACTION = 0.1  # of the targets drawn first: where no configuration is found of so many, it is said
# _SPLIT_ABOVE_CELLS and _CELLS_PER_JOB: cells: of a part that is cut, and of each job of it
_SPLIT_ABOVE_CELLS = 1 << 16
_CELLS_PER_JOB = 1 << 14


@dataclass(frozen=True, eq=False)
class TargetBoxResult:
    """Result of a target box job.

    Attributes:
        tree: Its bisection, in pre-order.
        centers: (leaves, n) in units of 2^-24.
        nodes: Cells that were looked at.
        finished: The smallest cells were reached.
        seconds: Measured.
        split_axes: Axes along which the box is to be halved one after the other, each half another job: nothing was looked for.
        estimated_cells: That it would take, estimated.
        advice: What is said of that where they are too many.
        failure_reason: Why the search does not begin: no configuration of any sampled target is found; or empty.
    """

    tree: bytes
    centers: IndexArray
    nodes: int
    finished: bool
    seconds: float
    split_axes: tuple[int, ...] = ()
    estimated_cells: float = 0.0
    advice: str = ""
    failure_reason: str = ""

    @property
    def has_too_many_cells(self) -> bool:
        """True if the search would take more cells than a certificate can have."""
        return verifier.MAX_LEAVES < self.estimated_cells < np.inf

    def check_cell_limit(self) -> None:
        """Raise an error if the search would take too many cells, or has no configurations.

        Raises:
            InputError: With the estimate.
        """
        if self.failure_reason:
            raise InputError(self.failure_reason)
        if self.has_too_many_cells:
            raise InputError(
                f"single configurations prove so little of this box that it would take some {self.estimated_cells:.0e} "
                f"cells{self.advice}"
            )

    @property
    def state(self) -> SearchState:
        """Progress of a finished search; a search that is split reports nothing because its boxes have states of their own."""
        if self.split_axes:
            return SearchState(proved=0.0, undecided=0.0, open=1.0, nodes=0)
        remainder = float(compute_undecided_fraction(self.tree))
        return SearchState(proved=1 - remainder, undecided=remainder, open=0.0, nodes=self.nodes)

    def to_arrays(self) -> Parts:
        """Return the result as arrays for the search memory."""
        counts = np.array([self.nodes, *self.split_axes], dtype=np.int64)
        tree = np.frombuffer(self.tree, dtype=np.uint8)
        return {
            "tree": tree,
            "centres": self.centers,
            "counts": counts,
            "times": np.array([self.seconds, self.estimated_cells]),
        }


@dataclass(frozen=True, eq=False)
class TargetBoxJob:
    """Search over a box of a claim.

    Attributes:
        claim: The claim.
        halvings: Of each axis of all of the claim, at most.
        seed: Of all random draws.
        part_number: Number of the claim.
        split_axes: Axes along which its box was halved, one after the other.
        box_number: Of this box among them.
    """

    claim: ReachClaim
    halvings: int
    seed: int
    part_number: int = 0
    split_axes: tuple[int, ...] = ()
    box_number: int = 0

    @property
    def name(self) -> str:
        """Name in the search memory."""
        return f"part {self.part_number} box {self.box_number} of {1 << len(self.split_axes)}"

    @property
    def claim_fraction(self) -> float:
        """Fraction of the claim part that this job covers."""
        return 0.5 ** len(self.split_axes)

    def empty_result(self) -> TargetBoxResult:
        """Return a result in which everything is undecided."""
        return TargetBoxResult(bytes([UNDECIDED_TOKEN]), np.empty((0, self.claim.arm.n), dtype=np.int64), 0, False, 0.0)

    def result_from_arrays(self, arrays: Parts) -> TargetBoxResult:
        """Rebuild a result from the arrays of :meth:`TargetBoxResult.to_arrays`."""
        tree, counts = arrays["tree"].astype(np.uint8).tobytes(), [int(value) for value in arrays["counts"]]
        seconds, cells = (float(value) for value in arrays["times"])
        return TargetBoxResult(tree, arrays["centres"].astype(np.int64), counts[0], True, seconds, tuple(counts[1:]), cells)

    def child_jobs(self, result: TargetBoxResult) -> list[TargetBoxJob]:
        """Return the jobs of the boxes of a split search, in the order of a tree."""
        count = 1 << len(result.split_axes) if result.split_axes else 0
        return [
            TargetBoxJob(self.claim, self.halvings, self.seed, self.part_number, result.split_axes, number)
            for number in range(count)
        ]

    def merge_child_results(self, result: TargetBoxResult, child_results: Sequence[TargetBoxResult]) -> TargetBoxResult:
        """Merge the results of the child jobs into the result of a split search."""
        if not result.split_axes:
            return result
        trees = [part.tree for part in child_results]
        for axis in reversed(result.split_axes):
            trees = [bytes([SPLIT_TOKEN + axis]) + lower + upper for lower, upper in zip(trees[::2], trees[1::2], strict=True)]
        return TargetBoxResult(
            trees[0],
            np.concatenate([part.centers for part in child_results]),
            sum(part.nodes for part in child_results),
            all(part.finished for part in child_results),
            sum(part.seconds for part in child_results),
        )

    def _box_and_axis_depths(self) -> tuple[FloatArray, IndexArray]:
        """Return the box (A, 2) of the job, and how often each axis was halved (A,)."""
        root = self.claim.box if self.claim.angle is None else np.vstack([self.claim.box, self.claim.angle])
        position, depth = np.zeros(len(root), dtype=np.int64), np.zeros(len(root), dtype=np.int64)
        for level, axis in enumerate(self.split_axes):
            is_upper = self.box_number >> (len(self.split_axes) - 1 - level) & 1
            position[axis], depth[axis] = 2 * position[axis] + is_upper, depth[axis] + 1
        width = (root[:, 1] - root[:, 0]) * 0.5**depth
        lower = root[:, 0] + width * position
        return (np.column_stack([lower, lower + width]) if self.split_axes else root), depth

    def start(self, deadline: float) -> RunningTargetBoxJob:
        """Start the search and build its pool of configurations until the monotonic time ``deadline``."""
        return RunningTargetBoxJob(self, *self._box_and_axis_depths(), deadline)


class RunningTargetBoxJob:
    """A started target box job.

    Attributes:
        job: Which.
        finished: The smallest cells were reached, or it is cut, or to be refused.
    """

    def __init__(self, job: TargetBoxJob, box: FloatArray, depth: IndexArray, deadline: float) -> None:
        started, claim = perf_counter(), job.claim
        self.job, self.finished, self._seconds = job, False, 0.0
        reach = ReachSolver(claim.arm, claim.task, claim.locked, claim.limits, claim.rotation, claim.angle)
        seed = job.seed if not job.split_axes else [job.seed, job.box_number, *job.split_axes]
        self._search = TargetBoxSearch(reach, box, job.halvings - depth, seed, deadline)
        self._advice, (self._failure_reason, self._warning) = "", self._unreached_target_messages()
        self._estimated_cells, self._split_axes = (
            0.0 if job.split_axes else self._search.pool.estimated_cells,
            tuple[int, ...](),
        )
        if _SPLIT_ABOVE_CELLS < self._estimated_cells <= verifier.MAX_LEAVES:
            self._split_axes = self._search.pool.choose_split_axes(
                int(np.ceil(np.log2(self._estimated_cells / _CELLS_PER_JOB))), job.halvings
            )
        if verifier.MAX_LEAVES < self._estimated_cells < np.inf:
            axis_count, lock_note = (
                int((box[:, 1] > box[:, 0]).sum()),
                " and of the interval of the lock" * (claim.angle is not None),
            )
            edge_divisor = int(np.ceil((self._estimated_cells / verifier.MAX_LEAVES) ** (1 / axis_count)))
            self._advice = (
                f" and {format_duration(self._search.pool.estimated_seconds)}; with 1/{edge_divisor} of each "
                f"edge{lock_note} it would fit"
            )
        self.finished = bool(self._split_axes or self._failure_reason) or self.result().has_too_many_cells
        self._seconds = perf_counter() - started

    def run(self, deadline: float, should_stop: StopCheck, report_progress: Callable[[], None]) -> None:
        """Continue the search until the monotonic time ``deadline``, or until ``should_stop()`` is true."""
        started = perf_counter()
        self.finished = self._search.run(deadline, should_stop, lambda closed: report_progress())
        self._seconds += perf_counter() - started

    @property
    def state(self) -> SearchState:
        """Progress, as fractions of the job's box."""
        search = self._search
        open_fraction = min(max(search.open_fraction, 0.0), 1.0)
        remainder = max(1 - open_fraction - search.proved_fraction, 0.0)
        return SearchState(
            proved=search.proved_fraction, undecided=remainder, open=open_fraction, nodes=search.nodes, warning=self._warning
        )

    def result(self) -> TargetBoxResult:
        """Return the result so far."""
        tree, centers = self._search.tree.preorder_tokens_and_centers()
        center_rows = np.array(centers, dtype=np.int64).reshape(-1, self.job.claim.arm.n)
        messages = self._advice, self._failure_reason
        return TargetBoxResult(
            tree,
            center_rows,
            self._search.nodes,
            self.finished,
            self._seconds,
            self._split_axes,
            self._estimated_cells,
            *messages,
        )

    def _unreached_target_messages(self) -> tuple[str, str]:
        """Return why nothing can be proved, and a warning that much cannot, judging by the first sampled targets of the whole
        box.
        """
        claim, (sampled, unreached) = self.job.claim, (self._search.pool.sampled_targets, self._search.pool.unreached_targets)
        if self.job.split_axes or not sampled or unreached < _WARN_UNREACHED_FRACTION * sampled:
            return "", ""
        lock_note = f"with {claim.arm.joint_names[claim.locked]} locked, " if claim.locked >= 0 else ""
        if unreached == sampled:
            is_point = not (claim.box[:, 1] > claim.box[:, 0]).any()
            subject = "this target" if is_point else f"any of {sampled} sampled targets of the box"
            return (
                f"{lock_note}no configuration was found for {subject}; try to prove the opposite with certify out-of-reach",
                "",
            )
        return "", f"{lock_note}no configuration was found for {unreached} of {sampled} sampled targets"
