"""The bisection of a box as jobs; a job that has made very many boxes defers the open ones to child jobs.

What a job finds depends on its boxes alone: not on how many processes there are, nor on what was found before by a search that
was stopped.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from holdfast.certificates.joint_boxes.halving import DEFERRED_TOKEN, BoxBatch, BoxBisection, BoxTest, root_box
from holdfast.certificates.search_pool import JobResult, SearchBudget, SearchJob, StopCheck
from holdfast.certificates.tree import (
    SPLIT_TOKEN,
    UNDECIDED_TOKEN,
    SearchState,
    compute_depths,
    compute_undecided_fraction,
    is_split,
)
from holdfast.certificates.verifier_parts.tree import MAX_LEAVES
from holdfast.core.typing import FloatArray, IndexArray

_BOXES_PER_JOB = 1 << 14  # boxes that a job makes
_MAX_CHILD_JOBS = 16  # jobs that it leaves


@dataclass(frozen=True, eq=False, kw_only=True)
class JointBoxResult(JobResult):
    """Result of a bisection job.

    Attributes:
        trees: Of its boxes, one after the other, in pre-order.
    """

    trees: bytes


@dataclass(frozen=True, eq=False)
class JointBoxJob(SearchJob):
    """Bisection of some boxes of a root box, to the whole of which its states refer.

    Attributes:
        test: Of boxes, as of :class:`holdfast.certificates.joint_boxes.halving.BoxBisection`.
        box: (A, 2) the whole.
        halvings: Of each axis of it, at most.
        max_boxes: Boxes that it makes, and each of those that it leaves some to.
        name: For a memory.
        boxes: Middles and how often they were halved; None: the whole.
    """

    result_type = JointBoxResult
    test: BoxTest
    box: FloatArray
    halvings: int
    max_boxes: int
    name: str = "boxes"
    boxes: BoxBatch | None = None

    @property
    def _roots(self) -> BoxBatch:
        return root_box(self.box) if self.boxes is None else self.boxes

    def make_search(self, deadline: float) -> BoxBisection:
        """Make the search."""
        return BoxBisection(self.box, self.halvings, self.boxes)

    def run_search(
        self, search: BoxBisection, deadline: float, should_stop: StopCheck, report_progress: Callable[[], None]
    ) -> bool:
        """Continue the search until the boxes of this job are made."""
        max_nodes = len(self._roots[0]) + self.max_boxes
        is_done = search.run(self.test, deadline, should_stop, report_progress, max_nodes)
        return is_done or search.tree.nodes > max_nodes

    def read_result(self, search: BoxBisection, **values: Any) -> JointBoxResult:
        """Return the result so far."""
        return JointBoxResult(trees=search.tree.preorder_tokens(), **values)

    def empty_result(self) -> JointBoxResult:
        """Return a result in which everything is undecided."""
        return JointBoxResult(trees=bytes([UNDECIDED_TOKEN]) * len(self._roots[0]), state=SearchState())

    def child_jobs(self, result: JointBoxResult) -> list[JointBoxJob]:
        """Return the child jobs for the deferred boxes."""
        if not result.finished or DEFERRED_TOKEN not in result.trees:
            return []
        middle, depth = (np.array(column) for column in zip(*self._deferred_boxes(result.trees), strict=True))
        row_groups = np.array_split(np.arange(len(middle)), min(_MAX_CHILD_JOBS, len(middle)))
        return [
            replace(self, name=f"{self.name} {number}", boxes=(middle[rows], depth[rows]))
            for number, rows in enumerate(row_groups, 1)
        ]

    def _deferred_boxes(self, trees: bytes) -> Iterator[tuple[FloatArray, IndexArray]]:
        """Yield the middles of the deferred boxes and how often each axis was halved."""
        width, waiting = self.box[:, 1] - self.box[:, 0], list(zip(*self._roots, strict=True))[::-1]
        for token in trees:
            middle, depth = waiting.pop()
            if token == DEFERRED_TOKEN:
                yield middle, depth
            elif is_split(token):
                axis, child_depth, step = token - SPLIT_TOKEN, depth.copy(), np.zeros(len(width))
                child_depth[axis] += 1
                step[axis] = width[axis] * 0.5 ** (child_depth[axis] + 1)
                waiting += [(middle + step, child_depth), (middle - step, child_depth)]

    def merge_child_results(self, result: JointBoxResult, child_results: Sequence[JointBoxResult]) -> JointBoxResult:
        """Merge the results of the deferred boxes into this result."""
        child_trees, deferred = b"".join(part.trees for part in child_results), bytes([DEFERRED_TOKEN])
        starts = [index for index, depth in enumerate(compute_depths(child_trees)) if not depth]
        subtrees = [child_trees[start:stop] for start, stop in zip(starts, [*starts, None][1:], strict=True)]
        first, *others = result.trees.split(deferred)
        subtrees = subtrees or [bytes([UNDECIDED_TOKEN])] * len(others)
        merged = first + b"".join(subtree + tree for subtree, tree in zip(subtrees, others, strict=True))
        return result.merge(child_results, trees=merged)


@dataclass(frozen=True, eq=False)
class Bisection:
    """A bisected box.

    Attributes:
        tree: In pre-order.
        undecided: Exact part of it.
        leaves: Boxes that are decided.
        nodes: Boxes that were looked at.
        finished: False if it was stopped.
    """

    tree: bytes
    undecided: Fraction
    leaves: int
    nodes: int
    finished: bool


def bisect_box(test: BoxTest, box: FloatArray, halvings: int, budget: SearchBudget) -> Bisection:
    """Decide as much of a box as possible with at most as many boxes as a certificate may have."""
    (result,) = budget.run_jobs([JointBoxJob(test, box, halvings, _BOXES_PER_JOB)], MAX_LEAVES)
    return summarize_tree(result.trees, result.nodes, result.finished)


def summarize_tree(tree: bytes, nodes: int, finished: bool) -> Bisection:
    """Return the bisection that a tree in pre-order describes."""
    leaves = sum(not is_split(token) and token != UNDECIDED_TOKEN for token in tree)
    return Bisection(tree, compute_undecided_fraction(tree), leaves, nodes, finished)
