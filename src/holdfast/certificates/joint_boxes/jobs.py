"""The bisection of a box as jobs; a job that has made very many boxes defers the open ones to child jobs.

What a job finds depends on its boxes alone: not on how many processes there are, nor on what was found before by a search that
was stopped.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from time import perf_counter

import numpy as np

from holdfast.certificates.joint_boxes.halving import DEFERRED_TOKEN, BoxBisection, BoxTest
from holdfast.certificates.search_pool import SearchBudget, StopCheck
from holdfast.certificates.tree import SPLIT_TOKEN, UNDECIDED_TOKEN, SearchState
from holdfast.certificates.verifier_parts.tree import MAX_LEAVES
from holdfast.core.sweeps.memory import Parts
from holdfast.core.typing import FloatArray, IndexArray

BoxBatch = tuple[FloatArray, IndexArray]

_BOXES_PER_JOB = 1 << 14  # boxes that a job makes
_MAX_CHILD_JOBS = 16  # jobs that it leaves


@dataclass(frozen=True, eq=False)
class JointBoxResult:
    """Result of a bisection job.

    Attributes:
        trees: Of its boxes, one after the other, in pre-order.
        tested: Boxes that were looked at.
        finished: Nothing waits, but for what is left to other jobs.
        proved, undecided: Parts of the whole.
        seconds: Measured.
    """

    trees: bytes
    tested: int
    finished: bool
    proved: float
    undecided: float
    seconds: float

    @property
    def state(self) -> SearchState:
        """Progress, as fractions of the whole box."""
        open_fraction = 1 - self.proved - self.undecided
        return SearchState(proved=self.proved, undecided=self.undecided, open=open_fraction, nodes=self.tested)

    def to_arrays(self) -> Parts:
        """Return the result as arrays for the search memory."""
        fractions = np.array([self.proved, self.undecided, self.seconds])
        return {"trees": np.frombuffer(self.trees, dtype=np.uint8), "tested": np.array([self.tested]), "parts": fractions}

    def check_cell_limit(self) -> None:
        """Do nothing, because the capacity is checked for the whole box beforehand."""


@dataclass(frozen=True, eq=False)
class JointBoxJob:
    """Bisection of some boxes of a root box.

    Attributes:
        test: Of boxes, as of :class:`holdfast.certificates.joint_boxes.halving.BoxBisection`.
        box: (A, 2) the whole.
        halvings: Of each axis of it, at most.
        max_boxes: Boxes that it makes, and each of those that it leaves some to.
        name: For a memory.
        boxes: Middles and how often they were halved; None: the whole.
    """

    test: BoxTest
    box: FloatArray
    halvings: int
    max_boxes: int
    name: str = "boxes"
    boxes: BoxBatch | None = None

    @property
    def claim_fraction(self) -> float:
        """Fraction of the claim to which the states refer: the whole."""
        return 1.0

    def start(self, deadline: float) -> RunningJointBoxJob:
        """Start the job."""
        return RunningJointBoxJob(self)

    def empty_result(self) -> JointBoxResult:
        """Return a result in which everything is undecided."""
        return JointBoxResult(bytes([UNDECIDED_TOKEN]) * (len(self.boxes[0]) if self.boxes else 1), 0, False, 0.0, 0.0, 0.0)

    def result_from_arrays(self, arrays: Parts) -> JointBoxResult:
        """Rebuild a result from the arrays of :meth:`JointBoxResult.to_arrays`."""
        proved, undecided, seconds = (float(value) for value in arrays["parts"])
        return JointBoxResult(arrays["trees"].tobytes(), int(arrays["tested"][0]), True, proved, undecided, seconds)

    def child_jobs(self, result: JointBoxResult) -> list[JointBoxJob]:
        """Return the child jobs for the deferred boxes."""
        if not result.finished or DEFERRED_TOKEN not in result.trees:
            return []
        middle, depth = (np.array(column) for column in zip(*self._deferred_boxes(result.trees), strict=True))
        row_groups = np.array_split(np.arange(len(middle)), min(_MAX_CHILD_JOBS, len(middle)))
        return [
            JointBoxJob(
                self.test, self.box, self.halvings, self.max_boxes, f"{self.name} {number}", (middle[rows], depth[rows])
            )
            for number, rows in enumerate(row_groups, 1)
        ]

    def _deferred_boxes(self, trees: bytes) -> Iterator[tuple[FloatArray, IndexArray]]:
        """Yield the middles of the deferred boxes and how often each axis was halved."""
        width = self.box[:, 1] - self.box[:, 0]
        roots = self.boxes or (self.box.mean(axis=1)[None], np.zeros((1, len(width)), dtype=np.int64))
        waiting = list(zip(*roots, strict=True))[::-1]
        for token in trees:
            middle, depth = waiting.pop()
            if token == DEFERRED_TOKEN:
                yield middle, depth
            elif SPLIT_TOKEN <= token < SPLIT_TOKEN + len(width):
                child_depth = depth.copy()
                child_depth[token - SPLIT_TOKEN] += 1
                step = np.zeros(len(width))
                step[token - SPLIT_TOKEN] = width[token - SPLIT_TOKEN] * 0.5 ** (child_depth[token - SPLIT_TOKEN] + 1)
                waiting += [(middle + step, child_depth), (middle - step, child_depth)]

    def merge_child_results(self, result: JointBoxResult, child_results: Sequence[JointBoxResult]) -> JointBoxResult:
        """Merge the results of the deferred boxes into this result."""
        child_trees = b"".join(part.trees for part in child_results)
        deferred, trees = iter(_split_trees(child_trees, len(self.box))), result.trees.split(bytes([DEFERRED_TOKEN]))
        merged = trees[0] + b"".join(
            (next(deferred) if child_results else bytes([UNDECIDED_TOKEN])) + tree for tree in trees[1:]
        )
        results = [result, *child_results]
        return JointBoxResult(
            merged, sum(part.tested for part in results), all(part.finished for part in results),
            sum(part.proved for part in results), sum(part.undecided for part in results),
            sum(part.seconds for part in results),
        )  # fmt: skip


class RunningJointBoxJob:
    """A started bisection job.

    Attributes:
        job: Which.
        finished: All is decided, or left to others.
    """

    def __init__(self, job: JointBoxJob) -> None:
        self.job, self.finished, self._seconds = job, False, 0.0
        self._halving = BoxBisection(job.box, job.halvings, job.boxes)
        self._max_nodes = self._halving.nodes + job.max_boxes

    def run(self, deadline: float, should_stop: StopCheck, report_progress: Callable[[], None]) -> None:
        """Continue the search until the monotonic time ``deadline``, or until ``should_stop()`` is true."""
        started = perf_counter()
        is_done = self._halving.run(self.job.test, deadline, should_stop, report_progress, self._max_nodes)
        self.finished = is_done or self._halving.nodes > self._max_nodes
        self._seconds += perf_counter() - started

    @property
    def state(self) -> SearchState:
        """Current progress of the job."""
        proved, undecided = self._halving.proved, self._halving.undecided
        return SearchState(proved=proved, undecided=undecided, open=1 - proved - undecided, nodes=self._halving.tested)

    def result(self) -> JointBoxResult:
        """Return the result so far."""
        halving = self._halving
        trees = halving.preorder_tokens()
        return JointBoxResult(trees, halving.tested, self.finished, halving.proved, halving.undecided, self._seconds)


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
    return summarize_tree(result.trees, len(box), result.tested, result.finished)


def summarize_tree(tree: bytes, axes: int, nodes: int, finished: bool) -> Bisection:
    """Return the bisection that a tree in pre-order describes."""
    counts, waiting, leaves = dict[int, int](), [0], 0
    for token in tree:
        depth = waiting.pop()
        if SPLIT_TOKEN <= token < SPLIT_TOKEN + axes:
            waiting += [depth + 1, depth + 1]
        elif token == UNDECIDED_TOKEN:
            counts[depth] = counts.get(depth, 0) + 1
        else:
            leaves += 1
    undecided = sum((Fraction(count, 1 << depth) for depth, count in counts.items()), Fraction(0))
    return Bisection(tree, undecided, leaves, nodes, finished)


def _split_trees(trees: bytes, axes: int) -> Iterator[bytes]:
    """Yield the trees of a sequence one by one."""
    begin, waiting = 0, 1
    for end, token in enumerate(trees, 1):
        waiting += 1 if SPLIT_TOKEN <= token < SPLIT_TOKEN + axes else -1
        if not waiting:
            yield trees[begin:end]
            begin, waiting = end, 1
