"""Bisection of many boxes in parallel until each is decided, with the tree that certificates contain."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from time import monotonic
from typing import Any

import numpy as np

from holdfast.certificates.search_pool import JobResult, SearchBudget, SearchJob, StopCheck
from holdfast.certificates.tree import (
    SPLIT_TOKEN,
    UNDECIDED_TOKEN,
    BisectionTree,
    SearchState,
    compute_depths,
    compute_undecided_fraction,
    is_split,
)
from holdfast.certificates.verifier_parts.tree import MAX_LEAVES, REFUTED_TOKEN
from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray, IndexArray

BoxTest = Callable[[FloatArray, FloatArray], tuple[IndexArray, FloatArray]]
BoxBatch = tuple[FloatArray, IndexArray]  # middles, and number of bisections of each axis

OPEN_TOKEN = -1  # token of a box that is not decided yet
DEFERRED_TOKEN = 1  # token of a box that is deferred to other jobs
DISTANCE_MARGIN_M = 1e-7  # m: margin for the verifier's rounding
_BATCH_BOXES = 4096
_ESTIMATE_PATHS = 101  # sampled paths of an estimate
_MAX_ESTIMATE_DEPTH = 60  # bisections at which an estimate stops
_BOXES_PER_JOB = 1 << 14  # boxes that a job makes
_MAX_CHILD_JOBS = 16  # jobs to which it defers the rest


class BoxBisection:
    """Search that bisects boxes until each is decided.

    Args:
        box: (A, 2) low and high end of the whole box along each axis.
        halvings: Largest number of bisections of each axis.
        boxes: Middles (N, A) and numbers of bisections (N, A) of the first boxes; None: the whole box.

    Attributes:
        tree: Bisection tree, in which waiting boxes have DEFERRED_TOKEN.
        tested: Number of tested boxes.
        proved, refuted, undecided: Proved, refuted and undecided fraction of the whole box.
    """

    def __init__(self, box: FloatArray, halvings: int, boxes: BoxBatch | None = None) -> None:
        self.box, self.halvings, self.width = box, halvings, box[:, 1] - box[:, 0]
        middle, depth = root_box(box) if boxes is None else boxes
        self.tree = BisectionTree(len(middle), DEFERRED_TOKEN)
        self._waiting: list[tuple[IndexArray, FloatArray, IndexArray]] = [(np.arange(len(middle)), middle, depth)]
        self.tested, self.proved, self.refuted, self.undecided = 0, 0.0, 0.0, 0.0

    @property
    def state(self) -> SearchState:
        """Progress, as fractions of the whole box."""
        fractions = {key: getattr(self, key) for key in ("proved", "refuted", "undecided")}
        return SearchState(**fractions, open=1 - sum(fractions.values()), nodes=self.tested)

    def run(
        self,
        test: BoxTest,
        deadline: float = np.inf,
        should_stop: Callable[[], bool] = lambda: False,
        report_progress: Callable[[], None] = lambda: None,
        max_nodes: int = 1 << 24,
    ) -> bool:
        """Bisect until all boxes are decided, or return False at a monotonic time, a stop request or ``max_nodes`` nodes.

        The test takes middles and half widths (N, A), and returns a token or OPEN for each box (N,), and the gain of halving
        each axis (N, A). ``report_progress`` is called after each step. The method can be called again.
        """
        while self._waiting:
            if monotonic() > deadline or should_stop() or self.tree.nodes > max_nodes:
                return False
            node_ids, middle, depth = self._waiting.pop()
            if len(node_ids) > _BATCH_BOXES:
                self._waiting.append((node_ids[_BATCH_BOXES:], middle[_BATCH_BOXES:], depth[_BATCH_BOXES:]))
                node_ids, middle, depth = node_ids[:_BATCH_BOXES], middle[:_BATCH_BOXES], depth[:_BATCH_BOXES]
            half = self.width * 0.5 ** (depth + 1)
            self.tested += len(node_ids)
            tokens, axis = choose_halved_axes(test, middle, half, depth < self.halvings)
            is_decided, is_split = tokens != OPEN_TOKEN, axis >= 0
            self.tree.tokens[node_ids] = np.where(is_decided, tokens, UNDECIDED_TOKEN)
            fractions = 0.5 ** depth.sum(axis=1)
            self.proved += float(fractions[is_decided & (tokens != REFUTED_TOKEN)].sum())
            self.refuted += float(fractions[tokens == REFUTED_TOKEN].sum())
            self.undecided += float(fractions[~is_decided & ~is_split].sum())
            if is_split.any():
                axes, rows = np.repeat(axis[is_split], 2), np.arange(2 * is_split.sum())
                middle, half = (np.repeat(values[is_split], 2, axis=0) for values in (middle, half))
                depth = np.repeat(depth[is_split], 2, axis=0)
                depth[rows, axes] += 1
                middle[rows, axes] += np.where(rows % 2, 0.5, -0.5) * half[rows, axes]
                self._waiting.append((self.tree.split_nodes(node_ids[is_split], axes[::2]), middle, depth))
            report_progress()
        return True


def root_box(box: FloatArray) -> BoxBatch:
    """Return the whole box as a batch of one box."""
    return box.mean(axis=1)[None], np.zeros((1, len(box)), dtype=np.int64)


def choose_halved_axes(
    test: BoxTest, middle: FloatArray, half: FloatArray, is_allowed: BoolArray
) -> tuple[IndexArray, IndexArray]:
    """Test boxes, and return their tokens and the axis to halve of each (N,); -1 for decided boxes and without any gain."""
    tokens, gain = test(middle, half)
    gain = np.where(is_allowed & (half > 0), np.nan_to_num(gain, nan=0.0), -1.0)
    return tokens, np.where((tokens == OPEN_TOKEN) & (gain.max(axis=1) > 0), gain.argmax(axis=1), -1)


class BoxVerdicts:
    """Tokens of boxes after several tests, and the gain of halving each axis for the test that comes closest to a decision.

    Args:
        half: (N, A) half widths of the boxes.
    """

    def __init__(self, half: FloatArray) -> None:
        self.tokens, self.gain = np.full(len(half), OPEN_TOKEN, dtype=np.int64), np.zeros(half.shape)
        self._best_ratios = np.full(len(half), -np.inf)

    @property
    def open_rows(self) -> IndexArray:
        """Indices of the boxes that no test decides."""
        return np.flatnonzero(self.tokens == OPEN_TOKEN)

    def record(
        self, rows: IndexArray, token: int, margins: FloatArray, center_margins: FloatArray, axis_costs: FloatArray
    ) -> None:
        """Record one test of some boxes: its margins, the margins at the centers, and the cost of each of the first axes."""
        self.tokens[rows[margins > DISTANCE_MARGIN_M]] = token
        ratios = center_margins / np.maximum(center_margins - margins, 1e-12)  # 1: just excluded
        improved = ratios > self._best_ratios[rows]
        rows = rows[improved]
        self._best_ratios[rows], self.gain[rows] = ratios[improved], 0.0
        self.gain[rows, : axis_costs.shape[1]] = axis_costs[improved]


def require_feasible_box_count(test: BoxTest, box: FloatArray, halvings: int, seed: int, advice: str) -> None:
    """Raise an error if the search would take more boxes than a certificate can have.

    The number is estimated by paths from the root to decided points. The box of a path with k bisections fits 2^k times into
    the whole box; the estimate is the median.

    Raises:
        InputError: The estimate is too large; the message contains the advice.
    """
    rng = np.random.default_rng([seed, _ESTIMATE_PATHS])
    middle, half = np.tile(box.mean(axis=1), (_ESTIMATE_PATHS, 1)), np.tile(np.diff(box)[:, 0] / 2, (_ESTIMATE_PATHS, 1))
    depth, open_rows = np.zeros(middle.shape, dtype=np.int64), np.arange(_ESTIMATE_PATHS)
    while open_rows.size > _ESTIMATE_PATHS // 2 and depth.sum(axis=1).max() < _MAX_ESTIMATE_DEPTH:
        _, axis = choose_halved_axes(test, middle[open_rows], half[open_rows], depth[open_rows] < halvings)
        open_rows, axis = open_rows[axis >= 0], axis[axis >= 0]
        depth[open_rows, axis] += 1
        half[open_rows, axis] /= 2
        middle[open_rows, axis] += half[open_rows, axis] * rng.choice([-1.0, 1.0], len(open_rows))
    typical_depth = float(np.median(depth.sum(axis=1)))
    if 2**typical_depth > MAX_LEAVES:
        suffix = " or more" if typical_depth >= _MAX_ESTIMATE_DEPTH else ""
        raise InputError(
            f"single boxes decide so little that the search would take about {2**typical_depth:.0e} boxes{suffix}; {advice}"
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class JointBoxResult(JobResult):
    """Result of a bisection job.

    Attributes:
        trees: Trees of its boxes in pre-order, concatenated.
    """

    trees: bytes


@dataclass(frozen=True, eq=False)
class JointBoxJob(SearchJob):
    """Job that bisects some boxes of a root box; its states refer to the whole root box.

    Attributes:
        test: Test of boxes, as in :class:`holdfast.certificates.joint_boxes.halving.BoxBisection`.
        box: (A, 2) root box.
        halvings: Largest number of bisections of each axis of the root box.
        max_boxes: Number of boxes that this job and each of its child jobs make.
        name: Name in the search memory.
        boxes: Middles and numbers of bisections of the first boxes; None: the root box.
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
        """Yield the middles of the deferred boxes, and the number of bisections of each axis."""
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
    """Result of the bisection of a box.

    Attributes:
        tree: Tokens of the tree in pre-order.
        undecided: Exact undecided fraction of the box.
        leaves: Number of decided boxes.
        nodes: Number of examined boxes.
        finished: False if the bisection was stopped.
    """

    tree: bytes
    undecided: Fraction
    leaves: int
    nodes: int
    finished: bool


def bisect_box(test: BoxTest, box: FloatArray, halvings: int, budget: SearchBudget) -> Bisection:
    """Decide as much of a box as possible within the number of boxes that a certificate can have."""
    (result,) = budget.run_jobs([JointBoxJob(test, box, halvings, _BOXES_PER_JOB)], MAX_LEAVES)
    return summarize_tree(result.trees, result.nodes, result.finished)


def summarize_tree(tree: bytes, nodes: int, finished: bool) -> Bisection:
    """Return the bisection that a tree in pre-order describes."""
    leaves = sum(not is_split(token) and token != UNDECIDED_TOKEN for token in tree)
    return Bisection(tree, compute_undecided_fraction(tree), leaves, nodes, finished)
