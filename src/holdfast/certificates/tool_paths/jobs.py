"""The search for motions in jobs: one for each lock, which leaves slabs to others once it has looked at very many cells.

What a job finds depends on its claim and its slabs alone: not on how many processes there are, nor on what was found before by
a search that was stopped.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.claims import ROWS
from holdfast.certificates.crew import Stop
from holdfast.certificates.taylor import Chain
from holdfast.certificates.tool_paths.cells import SEGMENT
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.forms import Following
from holdfast.certificates.tool_paths.march import March
from holdfast.certificates.tool_paths.rings import Never, rings_of
from holdfast.certificates.tool_paths.slabs import Slab
from holdfast.certificates.tree import SearchState
from holdfast.engine.memory import Parts

_JOB, _PARTS = 1 << 12, 8  # cells that a job looks at; jobs that it leaves


@dataclass(frozen=True, eq=False)
class Found:
    """What a job found.

    Attributes:
        slabs: Intervals of lock instants that are proved, in order, each with its cells.
        never: Those that are refuted, in order.
        left: Those that are left to other jobs.
        closed: Instants of slabs that are done with.
        nodes: Cells that were looked at.
        finished: Nothing is open, but for what is left.
        seconds: Measured.
        whole: Instants of the claim.
    """

    slabs: Sequence[Slab]
    never: Sequence[Never]
    left: Sequence[Slab]
    closed: int
    nodes: int
    finished: bool
    seconds: float
    whole: int

    @property
    def state(self) -> SearchState:
        """Of the lock."""
        done, gone = (sum(one.stop - one.begin for one in ours) for ours in (self.slabs, self.never))
        proved, refuted, rest = (x / self.whole for x in (done, gone, self.closed - done - gone))
        left = 1 - self.closed / self.whole
        return SearchState(proved=proved, refuted=refuted, undecided=rest, open=left, nodes=self.nodes)

    def stored(self) -> Parts:
        """As a memory keeps it."""
        cells = [x for slab in self.slabs for x in (slab.begin, slab.stop, slab.halvings, len(slab.ends), *slab.ends)]
        left = [x for slab in self.left for x in (slab.begin, slab.stop, slab.halvings)]
        made: dict[str, NDArray[np.int64]] = {
            "cells": np.array(cells, dtype=np.int64),
            "centres": np.array([row for slab in self.slabs for row in slab.centres], dtype=np.int64),
            "left": np.array(left, dtype=np.int64),
            "never": np.array(
                [x for one in self.never for x in (one.begin, one.stop, one.at, len(one.tree), *one.tree)], dtype=np.int64
            ),
            "counts": np.array([self.closed, self.nodes, self.whole], dtype=np.int64),
        }
        return {**made, "seconds": np.array([self.seconds])}

    def need_room(self) -> None:
        """There always is: a slab is one of a claim, halved so often at most."""


@dataclass(frozen=True, eq=False)
class Job:
    """The march of some slabs of one lock.

    Attributes:
        claim: The claim.
        joint: The one that locks.
        followers: Joints that go on with the healthy motion.
        halvings: Of slabs, at most.
        slabs: Which.
        most: Cells that it looks at, and each of those that it leaves some to.
        name: For a memory.
    """

    claim: PathClaim
    joint: int
    followers: tuple[int, ...]
    halvings: int
    slabs: tuple[Slab, ...]
    most: int
    name: str

    @classmethod
    def whole(cls, claim: PathClaim, joint: int, followers: tuple[int, ...], halvings: int) -> Job:
        """All lock instants of a joint."""
        first, last = claim.during
        faces = [first, *range((first // SEGMENT + 1) * SEGMENT, last, SEGMENT), last]
        slabs = tuple(Slab(begin, stop) for begin, stop in pairwise(faces))
        return cls(claim, joint, followers, halvings, slabs, _JOB, f"lock {joint + 1}")

    @property
    def share(self) -> float:
        """States are about the lock."""
        return 1.0

    @property
    def instants(self) -> int:
        """Of the claim."""
        return self.claim.during[1] - self.claim.during[0]

    def begun(self, until: float) -> Running:
        """At work."""
        return Running(self)

    def nothing(self) -> Found:
        """All undecided."""
        return Found((), (), (), 0, 0, False, 0.0, self.instants)

    def read(self, stored: Parts) -> Found:
        """What :meth:`Found.stored` kept."""
        numbers, rows, slabs = stored["cells"].tolist(), iter(stored["centres"]), list[Slab]()
        while numbers:
            begin, stop, halvings, count = numbers[:4]
            ends, numbers = numbers[4 : 4 + count], numbers[4 + count :]
            slabs.append(Slab(begin, stop, halvings, ends, [next(rows) for _ in ends]))
        given, never = stored["never"].tolist(), list[Never]()
        while given:
            (begin, stop, at, size), given = given[:4], given[4:]
            never.append(Never(begin, stop, at, bytes(given[:size])))
            given = given[size:]
        left = [Slab(*numbers) for numbers in stored["left"].reshape(-1, 3).tolist()]
        closed, nodes, whole = stored["counts"].tolist()
        return Found(slabs, never, left, closed, nodes, True, float(stored["seconds"][0]), whole)

    def parted(self, found: Found) -> list[Job]:
        """The jobs of slabs that are left."""
        parts = np.array_split(np.arange(len(found.left)), min(_PARTS, len(found.left))) if found.left else []
        return [
            replace(self, slabs=tuple(found.left[k] for k in some), name=f"{self.name} {number}")
            for number, some in enumerate(parts, 1)
        ]

    def joined(self, found: Found, parts: Sequence[Found]) -> Found:
        """With what is found of slabs that were left."""
        every = [found, *parts]
        slabs = sorted((slab for one in every for slab in one.slabs), key=lambda slab: slab.begin)
        never = sorted((one for part in every for one in part.never), key=lambda one: one.begin)
        return Found(
            slabs, never, (), sum(one.closed for one in every), sum(one.nodes for one in every),
            all(one.finished for one in every), sum(one.seconds for one in every), found.whole,
        )  # fmt: skip


class Running:
    """A job at work.

    Attributes:
        job: Which.
        finished: Nothing is open, but for what is left to others.
    """

    def __init__(self, job: Job) -> None:
        self.job, self.finished, self._seconds = job, False, 0.0
        claim = job.claim
        tube = claim.tube[[int(row > 2) for row in ROWS[claim.task]]] if claim.tube.any() else np.empty(0)
        limits = np.column_stack([claim.arm.lower, claim.arm.upper])
        following = Following(
            Chain.of(claim.arm), claim.knots, claim.task, still=[job.joint, *job.followers], tube=tube, limits=limits,
            slides=claim.arm.prismatic,
        )  # fmt: skip
        self._march = March(following, job.slabs, job.halvings, job.most, rings_of(claim, job.joint))

    def run(self, until: float, stop: Stop, tell: Callable[[], None]) -> None:
        """On with it until it is time (``monotonic``), or to stop."""
        began = perf_counter()
        self.finished = self._march.run(until, stop, tell)
        self._seconds += perf_counter() - began

    @property
    def state(self) -> SearchState:
        """How far it is."""
        return self.found().state

    def found(self) -> Found:
        """What is found so far."""
        march = self._march
        slabs = sorted(march.proved, key=lambda slab: slab.begin)
        left = march.left if self.finished else []
        never = sorted(march.never, key=lambda one: one.begin)
        return Found(slabs, never, left, march.closed, march.nodes, self.finished, self._seconds, self.job.instants)
