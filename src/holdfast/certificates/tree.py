"""Boxes halved: the tree of a search, and cells of it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Index = NDArray[np.int64]

PROVED, UNDECIDED, SPLIT = 0, 2, 16  # tokens of the tree


@dataclass(frozen=True, kw_only=True)
class SearchState:
    """How far a search has come.

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


Tell = Callable[[SearchState], None]


@dataclass
class Cells:
    """Cells of the root: cell k of 2^depth along each axis, and what they inherit.

    Attributes:
        place, depth: (N, A).
        name: (N,) number of each in the tree.
        q: (N, n) a configuration to begin from, rad.
        barren: (N,) how many cells in a row around this one were not proved to a measurable part.
    """

    place: Index
    depth: Index
    name: Index
    q: Array
    barren: Index

    @classmethod
    def of(cls, several: Sequence[Cells]) -> Cells:
        """All of them."""
        return cls(*(np.concatenate([getattr(cells, one.name) for cells in several]) for one in fields(cls)))

    def take(self, which: NDArray[np.intp]) -> Cells:
        """Some of them."""
        return Cells(self.place[which], self.depth[which], self.name[which], self.q[which], self.barren[which])

    @property
    def share(self) -> float:
        """Of the root that they are together."""
        return float((0.5 ** self.depth.sum(axis=1)).sum())


class Tree:
    """A bisection tree that grows.

    Attributes:
        token: Of each node: proved, undecided, or 16 and the axis that is halved.
        below: The lower child of each node that is split; the upper one is the next.
        centre: (n,) of each proved node, in units of 2^-24 rad.
    """

    def __init__(self) -> None:
        self.token: list[int] = [UNDECIDED]
        self.below: list[int] = [0]
        self.centre: dict[int, Index] = {}

    def prove(self, name: int, centre: Index) -> None:
        """A configuration does for all of this node."""
        self.token[name], self.centre[name] = PROVED, centre

    def split(self, name: int, axis: int) -> int:
        """The lower child."""
        self.token[name], self.below[name] = SPLIT + axis, len(self.token)
        self.token += [UNDECIDED] * 2
        self.below += [0] * 2
        return self.below[name]

    def halved(self, cells: Cells, axis: Index) -> Cells:
        """Both halves of each cell along its axis, one after the other."""
        below = np.array([self.split(*pair) for pair in zip(cells.name.tolist(), axis.tolist(), strict=True)], dtype=np.int64)
        place, depth = np.repeat(cells.place, 2, axis=0), np.repeat(cells.depth, 2, axis=0)
        rows, twice = np.arange(2 * len(axis)), np.repeat(axis, 2)
        place[rows, twice] = 2 * place[rows, twice] + rows % 2
        depth[rows, twice] += 1
        return Cells(place, depth, np.repeat(below, 2) + rows % 2, np.repeat(cells.q, 2, axis=0), np.repeat(cells.barren, 2))

    def whole_again(self, cells: Cells) -> Cells:
        """Of undecided cells, two halves of one are that one, which is undecided and not halved."""
        token, below = np.array(self.token), np.array(self.below, dtype=np.int64)
        halved, parent = np.flatnonzero(token >= SPLIT), np.full(len(token), -1)
        parent[below[halved]] = parent[below[halved] + 1] = halved
        while True:
            above = parent[cells.name]
            names, first, count = np.unique(above, return_index=True, return_counts=True)
            pairs = (count == 2) & (names >= 0)
            if not pairs.any():
                return cells
            one = cells.take(first[pairs])
            axis = token[names[pairs]] - SPLIT
            one.place[np.arange(len(axis)), axis] //= 2
            one.depth[np.arange(len(axis)), axis] -= 1
            one.name = names[pairs]
            for name in one.name.tolist():
                self.token[name] = UNDECIDED
            cells = Cells.of([one, cells.take(np.flatnonzero(~np.isin(above, one.name)))])

    def in_order(self) -> tuple[bytes, list[Index]]:
        """Tokens in pre-order, lower half first, and the centres of the proved leaves in this order."""
        tokens, centres, waiting = bytearray(), [], [0]
        while waiting:
            name = waiting.pop()
            tokens.append(self.token[name])
            if self.token[name] >= SPLIT:
                waiting += [self.below[name] + 1, self.below[name]]
            elif self.token[name] == PROVED:
                centres.append(self.centre[name])
        return bytes(tokens), centres


def undecided(tokens: bytes) -> Fraction:
    """Exact share of a tree in pre-order that is undecided."""
    counts, depth, waiting = dict[int, int](), 0, list[int]()
    for token in tokens:
        if token >= SPLIT:
            depth += 1
            waiting.append(depth)
            continue
        if token == UNDECIDED:
            counts[depth] = counts.get(depth, 0) + 1
        depth = waiting.pop() if waiting else 0
    return sum((Fraction(count, 1 << depth) for depth, count in counts.items()), Fraction(0))
