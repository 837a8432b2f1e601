"""Bisection tree of a search, and batches of its cells."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray, IndexArray

# PROVED_TOKEN, UNDECIDED_TOKEN and SPLIT_TOKEN: tokens of the tree
PROVED_TOKEN = 0
UNDECIDED_TOKEN = 2
SPLIT_TOKEN = 16


@dataclass(frozen=True, kw_only=True)
class SearchState:
    """Progress of a search.

    Attributes:
        proved, undecided: Shares of all parts of the claim together.
        refuted: Likewise, of a path; of other claims all is refuted by one witness.
        open: The share that is still to be looked at.
        nodes: Boxes that were looked at.
        warning: Of how many sampled targets no configuration was found, if of many; or empty.
    """

    proved: float
    undecided: float
    open: float
    nodes: int
    refuted: float = 0.0
    warning: str = ""


StateCallback = Callable[[SearchState], None]


@dataclass
class CellBatch:
    """Cells of the root box: index k of 2^depth along each axis, and inherited data.

    Attributes:
        place, depth: (N, A).
        name: (N,) number of each in the tree.
        q: (N, n) a configuration to begin from, rad.
        barren: (N,) how many cells in a row around this one were not proved to a measurable part.
    """

    place: IndexArray
    depth: IndexArray
    name: IndexArray
    q: FloatArray
    barren: IndexArray

    @classmethod
    def concatenate(cls, batches: Sequence[CellBatch]) -> CellBatch:
        """Concatenate batches of cells."""
        return cls(*(np.concatenate([getattr(cells, field.name) for cells in batches]) for field in fields(cls)))

    def select(self, rows: NDArray[np.intp]) -> CellBatch:
        """Return the cells of some rows."""
        return CellBatch(self.place[rows], self.depth[rows], self.name[rows], self.q[rows], self.barren[rows])

    @property
    def root_fraction(self) -> float:
        """Fraction of the root box that the cells cover together."""
        return float((0.5 ** self.depth.sum(axis=1)).sum())


class BisectionTree:
    """A growing bisection tree.

    Attributes:
        tokens: Of each node: proved, undecided, or 16 and the axis that is halved.
        lower_children: The lower child of each node that is split; the upper one is the next.
        centers: (n,) of each proved node, in units of 2^-24 rad.
    """

    def __init__(self) -> None:
        self.tokens: list[int] = [UNDECIDED_TOKEN]
        self.lower_children: list[int] = [0]
        self.centers: dict[int, IndexArray] = {}

    def mark_proved(self, node: int, center: IndexArray) -> None:
        """Mark a node as proved by the configuration ``center``."""
        self.tokens[node], self.centers[node] = PROVED_TOKEN, center

    def split_node(self, node: int, axis: int) -> int:
        """Split a node along an axis and return its lower child."""
        self.tokens[node], self.lower_children[node] = SPLIT_TOKEN + axis, len(self.tokens)
        self.tokens += [UNDECIDED_TOKEN] * 2
        self.lower_children += [0] * 2
        return self.lower_children[node]

    def halve_cells(self, cells: CellBatch, axis: IndexArray) -> CellBatch:
        """Return both halves of each cell along its axis, one after the other."""
        children = np.array(
            [self.split_node(*pair) for pair in zip(cells.name.tolist(), axis.tolist(), strict=True)], dtype=np.int64
        )
        place, depth = np.repeat(cells.place, 2, axis=0), np.repeat(cells.depth, 2, axis=0)
        rows, axes = np.arange(2 * len(axis)), np.repeat(axis, 2)
        place[rows, axes] = 2 * place[rows, axes] + rows % 2
        depth[rows, axes] += 1
        return CellBatch(
            place, depth, np.repeat(children, 2) + rows % 2, np.repeat(cells.q, 2, axis=0), np.repeat(cells.barren, 2)
        )

    def merge_undecided_siblings(self, cells: CellBatch) -> CellBatch:
        """Merge sibling cells that are both undecided into their parent, which becomes an undecided leaf."""
        tokens, children = np.array(self.tokens), np.array(self.lower_children, dtype=np.int64)
        split_nodes, parents = np.flatnonzero(tokens >= SPLIT_TOKEN), np.full(len(tokens), -1)
        parents[children[split_nodes]] = parents[children[split_nodes] + 1] = split_nodes
        while True:
            cell_parents = parents[cells.name]
            parent_ids, first_rows, counts = np.unique(cell_parents, return_index=True, return_counts=True)
            is_pair = (counts == 2) & (parent_ids >= 0)
            if not is_pair.any():
                return cells
            merged = cells.select(first_rows[is_pair])
            axis = tokens[parent_ids[is_pair]] - SPLIT_TOKEN
            merged.place[np.arange(len(axis)), axis] //= 2
            merged.depth[np.arange(len(axis)), axis] -= 1
            merged.name = parent_ids[is_pair]
            for node in merged.name.tolist():
                self.tokens[node] = UNDECIDED_TOKEN
            cells = CellBatch.concatenate([merged, cells.select(np.flatnonzero(~np.isin(cell_parents, merged.name)))])

    def preorder_tokens_and_centers(self) -> tuple[bytes, list[IndexArray]]:
        """Return the tokens in pre-order, lower half first, and the centers of the proved leaves in this order."""
        tokens, centers, waiting = bytearray(), [], [0]
        while waiting:
            node = waiting.pop()
            tokens.append(self.tokens[node])
            if self.tokens[node] >= SPLIT_TOKEN:
                waiting += [self.lower_children[node] + 1, self.lower_children[node]]
            elif self.tokens[node] == PROVED_TOKEN:
                centers.append(self.centers[node])
        return bytes(tokens), centers


def compute_undecided_fraction(tokens: bytes) -> Fraction:
    """Return the exact undecided fraction of a tree in pre-order."""
    counts, depth, waiting = dict[int, int](), 0, list[int]()
    for token in tokens:
        if token >= SPLIT_TOKEN:
            depth += 1
            waiting.append(depth)
            continue
        if token == UNDECIDED_TOKEN:
            counts[depth] = counts.get(depth, 0) + 1
        depth = waiting.pop() if waiting else 0
    return sum((Fraction(count, 1 << depth) for depth, count in counts.items()), Fraction(0))
