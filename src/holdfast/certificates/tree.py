"""Bisection tree of a search, and batches of its cells."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from typing import Self

import numpy as np

from holdfast.core.typing import FloatArray, IndexArray

# Tokens of trees in the format of the verifier; the token of a split node is SPLIT_TOKEN plus the axis.
PROVED_TOKEN = 0
UNDECIDED_TOKEN = 2
SPLIT_TOKEN = 16
_MAX_AXES = 112


@dataclass(frozen=True, kw_only=True)
class SearchState:
    """Progress of a search.

    Attributes:
        proved: Proved fraction of all parts of the claim together.
        undecided: Undecided fraction of all parts together.
        open: Fraction that is not examined yet.
        nodes: Number of examined boxes.
        refuted: Refuted fraction of a path claim; one witness refutes the whole of another claim.
        warning: Warning with the number of sampled targets for which no configuration was found, if there are many; or empty.
    """

    proved: float = 0.0
    undecided: float = 0.0
    open: float = 0.0
    nodes: int = 0
    refuted: float = 0.0
    warning: str = ""


StateCallback = Callable[[SearchState], None]


class RowBatch:
    """Base of dataclasses whose arrays have one row for each of N objects."""

    def select(self, rows: IndexArray) -> Self:
        """Return the objects in some rows."""
        return type(self)(*(getattr(self, field.name)[rows] for field in fields(self)))  # type: ignore[arg-type]

    @classmethod
    def concatenate(cls, batches: Sequence[Self]) -> Self:
        """Concatenate batches of objects."""
        names = [field.name for field in fields(cls)]  # type: ignore[arg-type]
        return cls(*(np.concatenate([getattr(batch, name) for batch in batches]) for name in names))


@dataclass
class CellBatch(RowBatch):
    """Batch of N cells of a root box with A axes, and inherited data.

    Attributes:
        place, depth: (N, A) index along each axis, from 0 to 2^depth - 1, and depth.
        name: (N,) number of the cell in the tree.
        q: (N, n) configuration at which the search begins, rad.
        barren: (N,) number of consecutive enclosing cells of which no measurable fraction was proved.
    """

    place: IndexArray
    depth: IndexArray
    name: IndexArray
    q: FloatArray
    barren: IndexArray

    @property
    def root_fraction(self) -> float:
        """Fraction of the root box that the cells cover together."""
        return float((0.5 ** self.depth.sum(axis=1)).sum())


class BisectionTree:
    """Growing bisection tree, or several parallel trees.

    Args:
        roots: Number of trees; their roots are the first nodes.
        initial_token: Token of new nodes.

    Attributes:
        nodes: Number of nodes.
        tokens: Token of each node, with space for further nodes; see :func:`is_split`.
        lower_children: Number of the lower child of each split node, else 0; the upper child has the next number.
    """

    def __init__(self, roots: int = 1, initial_token: int = UNDECIDED_TOKEN) -> None:
        self.nodes = self._roots = roots
        self._initial_token, capacity = initial_token, 1 << 10 + roots.bit_length()
        self.tokens = np.full(capacity, initial_token, dtype=np.uint8)
        self.lower_children = np.zeros(capacity, dtype=np.int64)

    def split_nodes(self, nodes: IndexArray, axes: IndexArray) -> IndexArray:
        """Split nodes along axes, and return the halves (2N,) of all nodes, the lower one of each first."""
        lower = self.nodes + 2 * np.arange(len(nodes))
        self.nodes += 2 * len(nodes)
        while self.nodes > len(self.tokens):
            self.tokens = np.concatenate([self.tokens, np.full_like(self.tokens, self._initial_token)])
            self.lower_children = np.concatenate([self.lower_children, np.zeros_like(self.lower_children)])
        self.tokens[nodes], self.lower_children[nodes] = SPLIT_TOKEN + axes, lower
        return np.repeat(lower, 2) + np.arange(2 * len(nodes)) % 2

    def preorder_nodes(self) -> list[int]:
        """Return the nodes of each tree in pre-order, lower half first."""
        children, order, waiting = self.lower_children[: self.nodes].tolist(), list[int](), [*range(self._roots)][::-1]
        while waiting:
            order.append(waiting.pop())
            if child := children[order[-1]]:
                waiting += [child + 1, child]
        return order

    def preorder_tokens(self) -> bytes:
        """Return the tokens of each tree in pre-order."""
        return self.tokens[self.preorder_nodes()].tobytes()

    def halve_cells(self, cells: CellBatch, axis: IndexArray) -> CellBatch:
        """Return both halves of each cell along its axis, next to each other."""
        halves = cells.select(np.repeat(np.arange(len(axis)), 2))
        rows, axes = np.arange(2 * len(axis)), np.repeat(axis, 2)
        halves.place[rows, axes] = 2 * halves.place[rows, axes] + rows % 2
        halves.depth[rows, axes] += 1
        return replace(halves, name=self.split_nodes(cells.name, axis))

    def merge_undecided_siblings(self, cells: CellBatch) -> CellBatch:
        """Merge sibling cells that are both undecided into their parent, which becomes an undecided leaf."""
        split_nodes, parents = np.flatnonzero(self.lower_children), np.full(self.nodes, -1)
        parents[self.lower_children[split_nodes]] = parents[self.lower_children[split_nodes] + 1] = split_nodes
        while True:
            cell_parents = parents[cells.name]
            parent_ids, first_rows, counts = np.unique(cell_parents, return_index=True, return_counts=True)
            is_pair = (counts == 2) & (parent_ids >= 0)
            if not is_pair.any():
                return cells
            merged = cells.select(first_rows[is_pair])
            merged.name = parent_ids[is_pair]
            rows, axis = np.arange(len(merged.name)), self.tokens[merged.name] - SPLIT_TOKEN
            merged.place[rows, axis] //= 2
            merged.depth[rows, axis] -= 1
            self.tokens[merged.name], self.lower_children[merged.name] = UNDECIDED_TOKEN, 0
            cells = CellBatch.concatenate([merged, cells.select(np.flatnonzero(~np.isin(cell_parents, merged.name)))])


def is_split(token: int) -> bool:
    """Return whether a token marks a node with two halves; tokens from 128 on mark boxes that a lock decides."""
    return SPLIT_TOKEN <= token < SPLIT_TOKEN + _MAX_AXES


def compute_depths(tokens: bytes) -> list[int]:
    """Return the depth of each node of consecutive trees in pre-order; the depth of a root is 0."""
    depths, waiting = list[int](), list[int]()
    for token in tokens:
        depths.append(waiting.pop() if waiting else 0)
        if is_split(token):
            waiting += [depths[-1] + 1] * 2
    return depths


def compute_undecided_fraction(tokens: bytes, searched_token: int = UNDECIDED_TOKEN) -> Fraction:
    """Return the exact undecided fraction of a tree in pre-order, or that of another token."""
    counts = Counter(depth for token, depth in zip(tokens, compute_depths(tokens), strict=True) if token == searched_token)
    return sum((Fraction(count, 1 << depth) for depth, count in counts.items()), Fraction(0))
