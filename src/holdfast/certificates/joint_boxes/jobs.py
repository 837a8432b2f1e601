"""The halving of a box in jobs: one that has made very many boxes leaves what is open to others.

What a job finds depends on its boxes alone: not on how many processes there are, nor on what was found before by a search that
was stopped.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.crew import Effort, Stop
from holdfast.certificates.joint_boxes.halving import LEFT, Halving, Test
from holdfast.certificates.tree import SPLIT, UNDECIDED, SearchState
from holdfast.certificates.verified.tree import MOST_LEAVES
from holdfast.engine.memory import Parts

Array = NDArray[np.float64]
Index = NDArray[np.int64]
Boxes = tuple[Array, Index]

_JOB, _PARTS = 1 << 14, 16  # boxes that a job makes; jobs that it leaves


@dataclass(frozen=True, eq=False)
class Found:
    """What a job found.

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
        """Of the whole."""
        left = 1 - self.proved - self.undecided
        return SearchState(proved=self.proved, undecided=self.undecided, open=left, nodes=self.tested)

    def stored(self) -> Parts:
        """As a memory keeps it."""
        parts = np.array([self.proved, self.undecided, self.seconds])
        return {"trees": np.frombuffer(self.trees, dtype=np.uint8), "tested": np.array([self.tested]), "parts": parts}

    def need_room(self) -> None:
        """That is asked of the whole beforehand."""


@dataclass(frozen=True, eq=False)
class Job:
    """The halving of some boxes of one.

    Attributes:
        test: Of boxes, as of :class:`holdfast.certificates.joint_boxes.halving.Halving`.
        box: (A, 2) the whole.
        halvings: Of each axis of it, at most.
        most: Boxes that it makes, and each of those that it leaves some to.
        name: For a memory.
        boxes: Middles and how often they were halved; None: the whole.
    """

    test: Test
    box: Array
    halvings: int
    most: int
    name: str = "boxes"
    boxes: Boxes | None = None

    @property
    def share(self) -> float:
        """States are about the whole."""
        return 1.0

    def begun(self, until: float) -> Running:
        """At work."""
        return Running(self)

    def nothing(self) -> Found:
        """All undecided."""
        return Found(bytes([UNDECIDED]) * (len(self.boxes[0]) if self.boxes else 1), 0, False, 0.0, 0.0, 0.0)

    def read(self, stored: Parts) -> Found:
        """What :meth:`Found.stored` kept."""
        proved, undecided, seconds = (float(x) for x in stored["parts"])
        return Found(stored["trees"].tobytes(), int(stored["tested"][0]), True, proved, undecided, seconds)

    def parted(self, found: Found) -> list[Job]:
        """The jobs of what it leaves."""
        if not found.finished or LEFT not in found.trees:
            return []
        middle, depth = (np.array(x) for x in zip(*self._left(found.trees), strict=True))
        parts = np.array_split(np.arange(len(middle)), min(_PARTS, len(middle)))
        return [
            Job(self.test, self.box, self.halvings, self.most, f"{self.name} {k}", (middle[some], depth[some]))
            for k, some in enumerate(parts, 1)
        ]

    def _left(self, trees: bytes) -> Iterator[tuple[Array, Index]]:
        """Middles of what is left, and how often each axis was halved."""
        width = self.box[:, 1] - self.box[:, 0]
        roots = self.boxes or (self.box.mean(axis=1)[None], np.zeros((1, len(width)), dtype=np.int64))
        waiting = list(zip(*roots, strict=True))[::-1]
        for token in trees:
            middle, depth = waiting.pop()
            if token == LEFT:
                yield middle, depth
            elif SPLIT <= token < SPLIT + len(width):
                deeper = depth.copy()
                deeper[token - SPLIT] += 1
                step = np.zeros(len(width))
                step[token - SPLIT] = width[token - SPLIT] * 0.5 ** (deeper[token - SPLIT] + 1)
                waiting += [(middle + step, deeper), (middle - step, deeper)]

    def joined(self, found: Found, parts: Sequence[Found]) -> Found:
        """With what is found of what was left."""
        every = b"".join(one.trees for one in parts)
        left, trees = iter(_each(every, len(self.box))), found.trees.split(bytes([LEFT]))
        whole = trees[0] + b"".join((next(left) if parts else bytes([UNDECIDED])) + tree for tree in trees[1:])
        all_of = [found, *parts]
        return Found(
            whole, sum(one.tested for one in all_of), all(one.finished for one in all_of),
            sum(one.proved for one in all_of), sum(one.undecided for one in all_of), sum(one.seconds for one in all_of),
        )  # fmt: skip


class Running:
    """A job at work.

    Attributes:
        job: Which.
        finished: All is decided, or left to others.
    """

    def __init__(self, job: Job) -> None:
        self.job, self.finished, self._seconds = job, False, 0.0
        self._halving = Halving(job.box, job.halvings, job.boxes)
        self._most = self._halving.nodes + job.most

    def run(self, until: float, stop: Stop, tell: Callable[[], None]) -> None:
        """On with it until it is time (``monotonic``), or to stop."""
        began = perf_counter()
        done = self._halving.run(self.job.test, until, stop, tell, self._most)
        self.finished = done or self._halving.nodes > self._most
        self._seconds += perf_counter() - began

    @property
    def state(self) -> SearchState:
        """How far it is."""
        proved, undecided = self._halving.proved, self._halving.undecided
        return SearchState(proved=proved, undecided=undecided, open=1 - proved - undecided, nodes=self._halving.tested)

    def found(self) -> Found:
        """What is found so far."""
        halving = self._halving
        trees = halving.in_order()
        return Found(trees, halving.tested, self.finished, halving.proved, halving.undecided, self._seconds)


@dataclass(frozen=True, eq=False)
class Bisection:
    """A box that was halved.

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


def halved(test: Test, box: Array, halvings: int, effort: Effort) -> Bisection:
    """As much of a box as can be decided, in at most as many boxes as a certificate may have."""
    (found,) = effort.found([Job(test, box, halvings, _JOB)], MOST_LEAVES)
    return summed(found.trees, len(box), found.tested, found.finished)


def summed(tree: bytes, axes: int, nodes: int, finished: bool) -> Bisection:
    """What a tree in pre-order says."""
    counts, waiting, leaves = dict[int, int](), [0], 0
    for token in tree:
        depth = waiting.pop()
        if SPLIT <= token < SPLIT + axes:
            waiting += [depth + 1, depth + 1]
        elif token == UNDECIDED:
            counts[depth] = counts.get(depth, 0) + 1
        else:
            leaves += 1
    rest = sum((Fraction(count, 1 << depth) for depth, count in counts.items()), Fraction(0))
    return Bisection(tree, rest, leaves, nodes, finished)


def _each(trees: bytes, axes: int) -> Iterator[bytes]:
    """One after the other."""
    begin, waiting = 0, 1
    for at, token in enumerate(trees, 1):
        waiting += 1 if SPLIT <= token < SPLIT + axes else -1
        if not waiting:
            yield trees[begin:at]
            begin, waiting = at, 1
