"""The search for a proof in jobs: one for each part of a claim, or for each box of a part that takes very many cells.

What a job finds depends on its claim, its box and the seed alone: not on how many processes there are, nor on what was found
before by a search that was stopped.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates import verifier
from holdfast.certificates.claims import ReachClaim
from holdfast.certificates.crew import Stop
from holdfast.certificates.target_boxes.search import Search
from holdfast.certificates.taylor import Reach
from holdfast.certificates.tree import SPLIT, UNDECIDED, SearchState, undecided
from holdfast.engine.memory import Parts
from holdfast.errors import InputError
from holdfast.words import duration

Array = NDArray[np.float64]
Index = NDArray[np.int64]

_MANY = 0.1  # of the targets drawn first: where no configuration is found of so many, it is said
_LARGE, _JOB = 1 << 16, 1 << 14  # cells: of a part that is cut, and of each job of it


@dataclass(frozen=True, eq=False)
class Found:
    """What a job found.

    Attributes:
        tree: Its bisection, in pre-order.
        centres: (leaves, n) in units of 2^-24.
        nodes: Cells that were looked at.
        finished: The smallest cells were reached.
        seconds: Measured.
        cut: Axes along which the box is to be halved one after the other, each half another job: nothing was looked for.
        cells: That it would take, estimated.
        advice: What is said of that where they are too many.
        nowhere: Why the search does not begin: no configuration of any sampled target is found; or empty.
    """

    tree: bytes
    centres: Index
    nodes: int
    finished: bool
    seconds: float
    cut: tuple[int, ...] = ()
    cells: float = 0.0
    advice: str = ""
    nowhere: str = ""

    @property
    def too_many(self) -> bool:
        """A certificate cannot have so many cells."""
        return verifier.MOST_LEAVES < self.cells < np.inf

    def need_room(self) -> None:
        """Refuse what would take too many cells, or has no configurations.

        Raises:
            InputError: With the estimate.
        """
        if self.nowhere:
            raise InputError(self.nowhere)
        if self.too_many:
            raise InputError(
                f"single configurations prove so little of this box that it would take some {self.cells:.0e} cells{self.advice}"
            )

    @property
    def state(self) -> SearchState:
        """Of a search that has ended; of one that is cut nothing, as its boxes have states of their own."""
        if self.cut:
            return SearchState(proved=0.0, undecided=0.0, open=1.0, nodes=0)
        rest = float(undecided(self.tree))
        return SearchState(proved=1 - rest, undecided=rest, open=0.0, nodes=self.nodes)

    def stored(self) -> Parts:
        """As a memory keeps it."""
        counts = np.array([self.nodes, *self.cut], dtype=np.int64)
        tree = np.frombuffer(self.tree, dtype=np.uint8)
        return {"tree": tree, "centres": self.centres, "counts": counts, "times": np.array([self.seconds, self.cells])}


@dataclass(frozen=True, eq=False)
class Job:
    """The search over a box of a claim.

    Attributes:
        claim: The claim.
        halvings: Of each axis of all of the claim, at most.
        seed: Of all random draws.
        part: Number of the claim.
        cut: Axes along which its box was halved, one after the other.
        number: Of this box among them.
    """

    claim: ReachClaim
    halvings: int
    seed: int
    part: int = 0
    cut: tuple[int, ...] = ()
    number: int = 0

    @property
    def name(self) -> str:
        """For a memory."""
        return f"part {self.part} box {self.number} of {1 << len(self.cut)}"

    @property
    def share(self) -> float:
        """Of the part."""
        return 0.5 ** len(self.cut)

    def nothing(self) -> Found:
        """Undecided."""
        return Found(bytes([UNDECIDED]), np.empty((0, self.claim.arm.n), dtype=np.int64), 0, False, 0.0)

    def read(self, stored: Parts) -> Found:
        """What :meth:`Found.stored` kept."""
        tree, counts = stored["tree"].astype(np.uint8).tobytes(), [int(x) for x in stored["counts"]]
        seconds, cells = (float(x) for x in stored["times"])
        return Found(tree, stored["centres"].astype(np.int64), counts[0], True, seconds, tuple(counts[1:]), cells)

    def parted(self, found: Found) -> list[Job]:
        """The jobs of the boxes of one that is cut, in the order of a tree."""
        count = 1 << len(found.cut) if found.cut else 0
        return [Job(self.claim, self.halvings, self.seed, self.part, found.cut, k) for k in range(count)]

    def joined(self, found: Found, parts: Sequence[Found]) -> Found:
        """Of what is cut, what the jobs of its boxes found."""
        if not found.cut:
            return found
        trees = [one.tree for one in parts]
        for axis in reversed(found.cut):
            trees = [bytes([SPLIT + axis]) + low + high for low, high in zip(trees[::2], trees[1::2], strict=True)]
        return Found(
            trees[0],
            np.concatenate([one.centres for one in parts]),
            sum(one.nodes for one in parts),
            all(one.finished for one in parts),
            sum(one.seconds for one in parts),
        )

    def _box(self) -> tuple[Array, Index]:
        """(A, 2) its box, and (A,) how often each axis was halved."""
        root = self.claim.box if self.claim.angle is None else np.vstack([self.claim.box, self.claim.angle])
        place, depth = np.zeros(len(root), dtype=np.int64), np.zeros(len(root), dtype=np.int64)
        for level, axis in enumerate(self.cut):
            upper = self.number >> (len(self.cut) - 1 - level) & 1
            place[axis], depth[axis] = 2 * place[axis] + upper, depth[axis] + 1
        width = (root[:, 1] - root[:, 0]) * 0.5**depth
        low = root[:, 0] + width * place
        return (np.column_stack([low, low + width]) if self.cut else root), depth

    def begun(self, until: float) -> Running:
        """The search, which has configurations to begin with, for which there is time ``until`` (``monotonic``)."""
        return Running(self, *self._box(), until)


class Running:
    """A job at work.

    Attributes:
        job: Which.
        finished: The smallest cells were reached, or it is cut, or to be refused.
    """

    def __init__(self, job: Job, box: Array, depth: Index, until: float) -> None:
        began, claim = perf_counter(), job.claim
        self.job, self.finished, self._seconds = job, False, 0.0
        reach = Reach(claim.arm, claim.task, claim.locked, claim.limits, claim.rotation, claim.angle)
        seed = job.seed if not job.cut else [job.seed, job.number, *job.cut]
        self._search = Search(reach, box, job.halvings - depth, seed, until)
        self._advice, (self._nowhere, self._warning) = "", self._beforehand()
        self._cells, self._cut = 0.0 if job.cut else self._search.pool.cells, tuple[int, ...]()
        if _LARGE < self._cells <= verifier.MOST_LEAVES:
            self._cut = self._search.pool.cut(int(np.ceil(np.log2(self._cells / _JOB))), job.halvings)
        if verifier.MOST_LEAVES < self._cells < np.inf:
            axes, lock = int((box[:, 1] > box[:, 0]).sum()), " and of the interval of the lock" * (claim.angle is not None)
            part = int(np.ceil((self._cells / verifier.MOST_LEAVES) ** (1 / axes)))
            self._advice = f" and {duration(self._search.pool.seconds)}; with 1/{part} of each edge{lock} it would fit"
        self.finished = bool(self._cut or self._nowhere) or self.found().too_many
        self._seconds = perf_counter() - began

    def run(self, until: float, stop: Stop, tell: Callable[[], None]) -> None:
        """On with it until it is time (``monotonic``), or to stop."""
        began = perf_counter()
        self.finished = self._search.run(until, stop, lambda closed: tell())
        self._seconds += perf_counter() - began

    @property
    def state(self) -> SearchState:
        """How far it has come, as shares of its box."""
        search = self._search
        left = min(max(search.open, 0.0), 1.0)
        rest = max(1 - left - search.proved, 0.0)
        return SearchState(proved=search.proved, undecided=rest, open=left, nodes=search.nodes, warning=self._warning)

    def found(self) -> Found:
        """What is found so far."""
        tree, centres = self._search.tree.in_order()
        rows = np.array(centres, dtype=np.int64).reshape(-1, self.job.claim.arm.n)
        said = self._advice, self._nowhere
        return Found(tree, rows, self._search.nodes, self.finished, self._seconds, self._cut, self._cells, *said)

    def _beforehand(self) -> tuple[str, str]:
        """Say of how many targets that were drawn first no configuration was found: of all (no search), and of many."""
        claim, (drawn, lost) = self.job.claim, (self._search.pool.drawn, self._search.pool.lost)
        if self.job.cut or not drawn or lost < _MANY * drawn:
            return "", ""
        who = f"with {claim.arm.joint_names[claim.locked]} locked, " if claim.locked >= 0 else ""
        if lost == drawn:
            one = not (claim.box[:, 1] > claim.box[:, 0]).any()
            what = "this target" if one else f"any of {drawn} sampled targets of the box"
            return f"{who}no configuration was found for {what}; try to prove the opposite with certify out-of-reach", ""
        return "", f"{who}no configuration was found for {lost} of {drawn} sampled targets"
