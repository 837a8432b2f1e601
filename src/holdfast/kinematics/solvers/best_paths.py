"""Dynamic program over the nodes of the poses of a path, which finds the motion of greatest gain to each node."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray, IndexArray

_RELATIVE_TIE_TOLERANCE = 1e-12  # relative to the total gain: smaller differences are rounding


@dataclass(frozen=True, eq=False)
class NodeMoves:
    """The M sufficiently short moves from the nodes of a pose to the nodes of the next pose, ordered by their targets.

    Attributes:
        targets, sources: (M,) indices of nodes.
        squared_distances: (M,) squared distances.
        excesses: (M,) amount by which a joint moves farther than allowed, rad and m; at most 0 if none does.
    """

    targets: IndexArray
    sources: IndexArray
    squared_distances: FloatArray
    excesses: FloatArray


class BestPathTable:
    """Best motions up to a pose, one to each of its nodes; among equal motions the shortest, by its squared steps.

    Attributes:
        gains: (P,) gain of each node of each pose; -inf forbids the node.
        allowed_excess: Amount by which a joint may move farther than allowed from pose to pose, rad and m.
        last_pose: Last pose to which any motion leads, if it is not the last of all.
    """

    def __init__(
        self,
        gains: Sequence[FloatArray],
        allowed_excess: float = 0.0,
        *,
        move_weight: float | None = None,
        combine_gains: Callable[[FloatArray, FloatArray], FloatArray] = np.add,
    ) -> None:
        """Start at the first pose. A weight of the squared moves is taken from the gain; without it, they only decide ties."""
        self.gains, self.allowed_excess = gains, allowed_excess
        self.last_pose: int | None = None
        self._move_weight, self._combine_gains = move_weight, combine_gains
        self._tie_tolerance = _RELATIVE_TIE_TOLERANCE * sum(float(gain.max()) for gain in gains) if move_weight is None else 0.0
        self._totals, self._path_lengths = gains[0], np.zeros(len(gains[0]))
        self._predecessors: list[IndexArray] = []

    def advance_to_next_pose(self, moves: NodeMoves) -> None:
        """Advance the best motions to the next pose."""
        if self.last_pose is not None:
            return
        node_gains = self.gains[len(self._predecessors) + 1]
        is_allowed = (moves.excesses <= self.allowed_excess) & np.isfinite(self._totals[moves.sources])
        is_allowed &= np.isfinite(node_gains[moves.targets])
        targets, sources, squares = moves.targets[is_allowed], moves.sources[is_allowed], moves.squared_distances[is_allowed]
        if not targets.size:
            self.last_pose = len(self._predecessors)
            return
        source_totals = self._totals[sources]
        if self._move_weight is not None:
            source_totals = source_totals - self._move_weight * squares
        best_totals = _max_by_group(source_totals, targets, len(node_gains))
        is_best = source_totals >= best_totals[targets] - self._tie_tolerance
        targets, sources = targets[is_best], sources[is_best]
        lengths = self._path_lengths[sources] + squares[is_best]
        shortest = -_max_by_group(-lengths, targets, len(node_gains))
        predecessors = np.zeros(len(node_gains), dtype=np.int64)
        cheapest = np.flatnonzero(lengths == shortest[targets])[::-1]
        predecessors[targets[cheapest]] = sources[cheapest]  # the last write stays: the first
        self._totals, self._path_lengths = self._combine_gains(best_totals, node_gains), shortest
        self._predecessors.append(predecessors)

    @property
    def best_total(self) -> float:
        """Total gain of the best motion; NaN if none leads to the last pose."""
        return float(self._totals.max()) if self.last_pose is None else float("nan")

    def trace_best_motion(self) -> IndexArray:
        """Return the node of every pose (T,) along the best motion, up to the last pose to which any motion leads."""
        best = np.flatnonzero(self._totals >= self._totals.max() - self._tie_tolerance)
        return trace_back(self._predecessors, int(best[self._path_lengths[best].argmin()]))


def trace_back(predecessors: Sequence[IndexArray], last_node: int) -> IndexArray:
    """Return the node of every pose (T,) on the way to a node of the last one, from T - 1 arrays of predecessors."""
    nodes = [last_node]
    for previous in reversed(predecessors):
        nodes.append(int(previous[nodes[-1]]))
    return np.array(nodes[::-1])


def bound_move_length(spacing: float, nearest_distances: FloatArray) -> float:
    """Return the greatest length of a move without velocity limits, from the distances (P,) of nodes to the next pose."""
    return 3 * spacing + 2 * float(np.median(nearest_distances))


def _max_by_group(values: FloatArray, group_indices: IndexArray, group_count: int) -> FloatArray:
    """Return the largest value (G,) of each group (M,), in sorted order; -inf for an empty group."""
    maxima = np.full(group_count, -np.inf)
    if group_indices.size:
        group_starts = np.flatnonzero(np.diff(group_indices, prepend=-1))
        maxima[group_indices[group_starts]] = np.maximum.reduceat(values, group_starts)
    return maxima
