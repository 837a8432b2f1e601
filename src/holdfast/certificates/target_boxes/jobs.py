"""Jobs of the search for a proof: one for each part of a claim, or one for each box of a part with very many cells.

The result of a job depends only on its claim, its box and the seed, not on the number of processes or on the results of an
earlier, stopped search.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from holdfast.certificates import verifier
from holdfast.certificates.claims import ReachClaim
from holdfast.certificates.search_pool import JobResult, SearchJob
from holdfast.certificates.target_boxes.search import TargetBoxSearch
from holdfast.certificates.taylor import ReachSolver
from holdfast.certificates.tree import SPLIT_TOKEN, UNDECIDED_TOKEN, SearchState
from holdfast.core.errors import InputError
from holdfast.core.formatting import format_duration
from holdfast.core.typing import FloatArray, IndexArray

_WARN_UNREACHED_FRACTION = 0.1  # fraction of the first targets without a configuration above which a warning is given
# Estimated cells of a part above which it is split, and cells of each of its jobs.
_SPLIT_ABOVE_CELLS = 1 << 16
_CELLS_PER_JOB = 1 << 14


@dataclass(frozen=True, eq=False, kw_only=True)
class TargetBoxResult(JobResult):
    """Result of a target box job.

    Attributes:
        tree: Bisection tree in pre-order.
        centers: (leaves, n) centers in units of 2^-24.
        split_axes: Axes along which the box is halved successively into further jobs, if the job did not search.
        refusal: Reason why the search does not begin (no configuration at any sampled target, or too many cells), or empty.
    """

    tree: bytes = bytes([UNDECIDED_TOKEN])
    centers: IndexArray
    split_axes: tuple[int, ...] = ()
    refusal: str = ""

    def check_cell_limit(self) -> None:
        """Raise an error if the search would take too many cells, or has no configurations.

        Raises:
            InputError: The search cannot begin; the message states the reason.
        """
        if self.refusal:
            raise InputError(self.refusal)


@dataclass(frozen=True, eq=False)
class TargetBoxJob(SearchJob):
    """Search over a box of a claim.

    Attributes:
        claim: The claim.
        halvings: Largest number of bisections of each axis of the whole claim.
        seed: Seed of all random samples.
        part_number: Number of the part of the claim.
        split_axes: Axes along which the box of the part was halved successively.
        box_number: Number of this box among the results.
    """

    result_type = TargetBoxResult
    claim: ReachClaim
    halvings: int
    seed: int
    part_number: int = 0
    split_axes: tuple[int, ...] = ()
    box_number: int = 0

    @property
    def name(self) -> str:  # type: ignore[override]
        """Name in the search memory."""
        return f"part {self.part_number} box {self.box_number} of {1 << len(self.split_axes)}"

    @property
    def claim_fraction(self) -> float:  # type: ignore[override]
        """Fraction of the claim part that this job covers."""
        return 0.5 ** len(self.split_axes)

    def empty_result(self) -> TargetBoxResult:
        """Return a result in which everything is undecided."""
        return TargetBoxResult(centers=np.empty((0, self.claim.arm.n), dtype=np.int64), state=SearchState())

    def child_jobs(self, result: TargetBoxResult) -> list[TargetBoxJob]:
        """Return the jobs of the boxes of a split search, in the order of a tree."""
        count = 1 << len(result.split_axes) if result.split_axes else 0
        return [replace(self, split_axes=result.split_axes, box_number=number) for number in range(count)]

    def merge_child_results(self, result: TargetBoxResult, child_results: Sequence[TargetBoxResult]) -> TargetBoxResult:
        """Merge the results of the child jobs into the result of a split search."""
        if not result.split_axes:
            return result
        trees = [part.tree for part in child_results]
        for axis in reversed(result.split_axes):
            trees = [bytes([SPLIT_TOKEN + axis]) + lower + upper for lower, upper in zip(trees[::2], trees[1::2], strict=True)]
        return result.merge(child_results, tree=trees[0], centers=np.concatenate([part.centers for part in child_results]))

    def _box_and_axis_depths(self) -> tuple[FloatArray, IndexArray]:
        """Return the box (A, 2) of the job, and the number of bisections of each axis (A,)."""
        root = self.claim.box if self.claim.angle is None else np.vstack([self.claim.box, self.claim.angle])
        position, depth = np.zeros(len(root), dtype=np.int64), np.zeros(len(root), dtype=np.int64)
        for level, axis in enumerate(self.split_axes):
            is_upper = self.box_number >> (len(self.split_axes) - 1 - level) & 1
            position[axis], depth[axis] = 2 * position[axis] + is_upper, depth[axis] + 1
        width = (root[:, 1] - root[:, 0]) * 0.5**depth
        lower = root[:, 0] + width * position
        return (np.column_stack([lower, lower + width]) if self.split_axes else root), depth

    def make_search(self, deadline: float) -> TargetBoxSearch:
        """Make the search and its pool of configurations until the monotonic time ``deadline``."""
        claim, (box, depth) = self.claim, self._box_and_axis_depths()
        reach = ReachSolver(claim.arm, claim.task, claim.locked, claim.limits, claim.rotation, claim.angle)
        if self.split_axes:
            seed = [self.seed, self.box_number, *self.split_axes]
            return TargetBoxSearch(reach, box, self.halvings - depth, seed, deadline)
        search = TargetBoxSearch(reach, box, self.halvings, self.seed, deadline)
        search.refusal, search.warning = self._unreached_target_messages(search)
        cells = search.pool.estimated_cells
        if _SPLIT_ABOVE_CELLS < cells <= verifier.MAX_LEAVES:
            search.split_axes = search.pool.choose_split_axes(int(np.ceil(np.log2(cells / _CELLS_PER_JOB))), self.halvings)
        elif verifier.MAX_LEAVES < cells < np.inf and not search.refusal:
            edge_divisor = int(np.ceil((cells / verifier.MAX_LEAVES) ** (1 / int((box[:, 1] > box[:, 0]).sum()))))
            search.refusal = (
                f"single configurations prove so little of this box that it would take about {cells:.0e} cells and "
                f"{format_duration(search.pool.estimated_seconds)}; with 1/{edge_divisor} of each "
                f"edge{' and of the interval of the lock' * (claim.angle is not None)} it would fit"
            )
        search.is_settled = bool(search.split_axes or search.refusal)
        return search

    def read_result(self, search: TargetBoxSearch, **values: Any) -> TargetBoxResult:
        """Return the result so far, in which open cells are undecided unless other jobs search them."""
        if not search.split_axes:
            remainder = 1 - search.proved_fraction
            values["state"] = replace(values["state"], undecided=remainder, open=0.0)
        return TargetBoxResult(
            tree=search.tree.preorder_tokens(), centers=search.centers, split_axes=search.split_axes, refusal=search.refusal,
            **values,
        )  # fmt: skip

    def _unreached_target_messages(self, search: TargetBoxSearch) -> tuple[str, str]:
        """Return the reason why nothing can be proved, and a warning if much cannot, from the first sampled targets."""
        claim, sampled, unreached = self.claim, search.pool.sampled_targets, search.pool.unreached_targets
        if not sampled or unreached < _WARN_UNREACHED_FRACTION * sampled:
            return "", ""
        lock_note = f"with {claim.arm.joint_names[claim.locked]} locked, " if claim.locked >= 0 else ""
        if unreached < sampled:
            return "", f"{lock_note}no configuration was found for {unreached} of {sampled} sampled targets"
        is_point = not (claim.box[:, 1] > claim.box[:, 0]).any()
        subject = "this target" if is_point else f"any of {sampled} sampled targets of the box"
        advice = "try to prove the opposite with certify out-of-reach"
        return f"{lock_note}no configuration was found for {subject}; {advice}", ""
