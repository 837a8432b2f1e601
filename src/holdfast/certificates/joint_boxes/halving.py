"""Bisection of many boxes in parallel until each is decided, with the tree that certificates contain."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic

import numpy as np

from holdfast.certificates.tree import SPLIT_TOKEN, UNDECIDED_TOKEN
from holdfast.certificates.verifier_parts.tree import MAX_LEAVES
from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray, IndexArray

BoxTest = Callable[[FloatArray, FloatArray], tuple[IndexArray, FloatArray]]

OPEN_TOKEN = -1  # what is not decided yet
DEFERRED_TOKEN = 1  # token of what others look at
_BATCH_BOXES = 4096
_ESTIMATE_PATHS = 101  # for an estimate
_MAX_ESTIMATE_DEPTH = 60  # halvings after which nobody asks


class BoxBisection:
    """Bisection of boxes.

    Args:
        box: (A, 2), low and high along each axis, of the whole.
        halvings: Of each axis, at most.
        boxes: Middles (N, A) and how often each axis was halved (N, A), of those to begin with; None: the whole.

    Attributes:
        tested: Boxes that were looked at.
        proved, undecided: Parts of the whole.
    """

    def __init__(self, box: FloatArray, halvings: int, boxes: tuple[FloatArray, IndexArray] | None = None) -> None:
        self.box, self.halvings = box, halvings
        self.width = box[:, 1] - box[:, 0]
        middle, depth = boxes or (box.mean(axis=1)[None], np.zeros((1, len(box)), dtype=np.int64))
        self._roots = self.nodes = len(middle)
        capacity = 1 << 10 + self.nodes.bit_length()
        self._token, self._below = np.full(capacity, UNDECIDED_TOKEN, dtype=np.uint8), np.zeros(capacity, dtype=np.int64)
        self._level = np.zeros(capacity, dtype=np.int64)
        self._waiting = [(np.arange(self.nodes), middle, depth)]
        self.tested, self.proved, self.undecided = 0, 0.0, 0.0

    def run(
        self,
        test: BoxTest,
        deadline: float = np.inf,
        should_stop: Callable[[], bool] = lambda: False,
        report_progress: Callable[[], None] = lambda: None,
        max_nodes: int = 1 << 24,
    ) -> bool:
        """Bisect until all is decided, or until a monotonic time, a stop request or ``max_nodes`` nodes; then return False.

        The test takes middles and half widths (N, A) and gives a token or OPEN for each (N,), and what halving each axis would
        gain (N, A). ``report_progress`` is called after each step. May be called again.
        """
        while self._waiting:
            if monotonic() > deadline or should_stop() or self.nodes > max_nodes:
                return False
            node_ids, middle, depth = self._waiting.pop()
            if len(node_ids) > _BATCH_BOXES:
                self._waiting.append((node_ids[_BATCH_BOXES:], middle[_BATCH_BOXES:], depth[_BATCH_BOXES:]))
                node_ids, middle, depth = node_ids[:_BATCH_BOXES], middle[:_BATCH_BOXES], depth[:_BATCH_BOXES]
            half = self.width * 0.5 ** (depth + 1)
            self.tested += len(node_ids)
            tokens, gain = test(middle, half)
            is_decided = tokens != OPEN_TOKEN
            self._token[node_ids[is_decided]] = tokens[is_decided]
            gain = np.where((depth < self.halvings) & (half > 0), np.nan_to_num(gain, nan=0.0), -1.0)
            is_split = ~is_decided & (gain.max(axis=1) > 0)
            fractions = 0.5 ** depth.sum(axis=1)
            self.proved += float(fractions[is_decided].sum())
            self.undecided += float(fractions[~is_decided & ~is_split].sum())
            if is_split.any():
                children = self._split_boxes(
                    node_ids[is_split], middle[is_split], depth[is_split], half[is_split], gain[is_split].argmax(axis=1)
                )
                self._waiting.append(children)
            report_progress()
        return True

    def _split_boxes(
        self, node_ids: IndexArray, middle: FloatArray, depth: IndexArray, half: FloatArray, axis: IndexArray
    ) -> tuple[IndexArray, FloatArray, IndexArray]:
        """Return the node numbers, middles and depths of the halves."""
        count = len(node_ids)
        while self.nodes + 2 * count > len(self._token):
            for key in ("_token", "_below", "_level"):
                values = getattr(self, key)
                setattr(self, key, np.concatenate([values, np.full_like(values, UNDECIDED_TOKEN if key == "_token" else 0)]))
        lower_children = self.nodes + 2 * np.arange(count)
        self._token[node_ids], self._below[node_ids] = SPLIT_TOKEN + axis, lower_children
        self.nodes += 2 * count
        child_ids, rows = np.repeat(lower_children, 2) + np.arange(2 * count) % 2, np.arange(2 * count)
        self._level[child_ids] = np.repeat(self._level[node_ids], 2) + 1
        middles, depths, axes = np.repeat(middle, 2, axis=0), np.repeat(depth, 2, axis=0), np.repeat(axis, 2)
        depths[rows, axes] += 1
        middles[rows, axes] += np.where(rows % 2, 0.5, -0.5) * np.repeat(half, 2, axis=0)[rows, axes]
        return child_ids, middles, depths

    def preorder_tokens(self) -> bytes:
        """Return the tokens of each tree in pre-order, lower half first; boxes that still wait have DEFERRED_TOKEN."""
        tokens, children, node_level = self._token[: self.nodes].copy(), self._below, self._level[: self.nodes]
        for node_ids, _, _ in self._waiting:
            tokens[node_ids] = DEFERRED_TOKEN
        subtree_sizes, positions = np.ones(self.nodes, dtype=np.int64), np.zeros(self.nodes, dtype=np.int64)
        is_split = (tokens >= SPLIT_TOKEN) & (tokens < SPLIT_TOKEN + len(self.box))
        levels = [np.flatnonzero(is_split & (node_level == depth)) for depth in range(int(node_level.max()) + 1)]
        for node_ids in levels[::-1]:
            subtree_sizes[node_ids] += subtree_sizes[children[node_ids]] + subtree_sizes[children[node_ids] + 1]
        positions[1 : self._roots] = np.cumsum(subtree_sizes[: self._roots - 1])
        for node_ids in levels:
            positions[children[node_ids]] = positions[node_ids] + 1
            positions[children[node_ids] + 1] = positions[node_ids] + 1 + subtree_sizes[children[node_ids]]
        ordered = np.zeros(self.nodes, dtype=np.uint8)
        ordered[positions] = tokens
        return ordered.tobytes()


def require_feasible_box_count(test: BoxTest, box: FloatArray, halvings: int, seed: int, advice: str) -> None:
    """Raise an error if the search would take more boxes than a certificate may have, estimated by paths from the root to
    decided points.

    As many boxes as 2 to the halvings of a path fill the whole; the median counts.

    Raises:
        InputError: With the estimate, and with the advice.
    """
    rng = np.random.default_rng([seed, _ESTIMATE_PATHS])
    middle, half = np.tile(box.mean(axis=1), (_ESTIMATE_PATHS, 1)), np.tile(np.diff(box)[:, 0] / 2, (_ESTIMATE_PATHS, 1))
    depth, open_rows = np.zeros(middle.shape, dtype=np.int64), np.arange(_ESTIMATE_PATHS)
    while open_rows.size > _ESTIMATE_PATHS // 2 and depth.sum(axis=1).max() < _MAX_ESTIMATE_DEPTH:
        tokens, gain = test(middle[open_rows], half[open_rows])
        gain = np.where((depth[open_rows] < halvings) & (half[open_rows] > 0), np.nan_to_num(gain, nan=0.0), -1.0)
        is_split = (tokens == OPEN_TOKEN) & (gain.max(axis=1) > 0)
        open_rows, axis = open_rows[is_split], gain[is_split].argmax(axis=1)
        depth[open_rows, axis] += 1
        half[open_rows, axis] /= 2
        middle[open_rows, axis] += half[open_rows, axis] * rng.choice([-1.0, 1.0], len(open_rows))
    typical_depth = float(np.median(depth.sum(axis=1)))
    if 2**typical_depth > MAX_LEAVES:
        suffix = " or more" if typical_depth >= _MAX_ESTIMATE_DEPTH else ""
        raise InputError(
            f"single boxes decide so little of this that it would take some {2**typical_depth:.0e} boxes{suffix}; {advice}"
        )
