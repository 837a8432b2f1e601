"""Slabs of lock instants, each with cells from the lock to the end of the path, in which one motion goes on."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from time import monotonic

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.tool_paths.cells import SEGMENT, UNIT, Cells, Forms
from holdfast.certificates.tool_paths.forms import Following
from holdfast.certificates.tool_paths.rings import Never, Rings
from holdfast.certificates.tool_paths.slabs import Slab
from holdfast.certificates.tool_paths.turned import PLAIN, led

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

_AT_ONCE = 64  # slabs that march side by side


@dataclass(frozen=True, kw_only=True)
class LockedPath:
    """What was found for the lock of one joint.

    Attributes:
        joint: Index of it.
        followers: Of joints that go on with the healthy motion, as more are left than the task has rows.
        slabs: Intervals of lock instants that are proved, in order, each with its cells.
        never: Those that are refuted, in order.
        proved, refuted: Exact parts of the lock instants.
        nodes: Cells that were looked at.
        finished: False if the search was stopped.
        seconds: Measured.
    """

    joint: int
    followers: tuple[int, ...]
    slabs: tuple[Slab, ...]
    never: tuple[Never, ...]
    proved: Fraction
    refuted: Fraction
    nodes: int
    finished: bool
    seconds: float

    @property
    def spans(self) -> list[tuple[int, int]]:
        """Proved intervals of lock instants."""
        return [(slab.begin, slab.stop) for slab in self.slabs]

    @property
    def refuted_spans(self) -> list[tuple[int, int]]:
        """Refuted ones."""
        return [(one.begin, one.stop) for one in self.never]

    @property
    def undecided(self) -> Fraction:
        """The rest."""
        return 1 - self.proved - self.refuted

    @property
    def leaves(self) -> int:
        """Cells of proved slabs, and boxes of joints that refute others."""
        return sum(len(slab.ends) for slab in self.slabs) + sum(1 + len(one.tree) for one in self.never) // 2


class March:
    """The search of one lock.

    Args:
        following: The locked arm and the path.
        slabs: Of lock instants.
        halvings: Of slabs, at most.
        most: Cells that are looked at before no more slabs begin.
        rings: What refutes slabs that lead nowhere; None: nothing does.

    Attributes:
        proved: Slabs, in no order.
        never: Refuted ones, in no order.
        nodes: Cells and boxes that were looked at.
        closed: Instants of slabs that are done with.
    """

    def __init__(
        self, following: Following, slabs: Sequence[Slab], halvings: int, most: float = np.inf, rings: Rings | None = None
    ) -> None:
        self.following, self._halvings, self._most, self._rings = following, halvings, most, rings
        self._end = (len(following.knots) - 1) * SEGMENT
        self.proved: list[Slab] = []
        self.never: list[Never] = []
        self.nodes, self.closed = 0, 0
        self._waiting = deque(slab.anew for slab in slabs)
        self._moving: list[Slab] = []
        self._failed: list[Slab] = []
        self._hopeless: list[Slab] = []
        self._before: Forms | None = None

    def run(self, until: float, stop: Callable[[], bool], tell: Callable[[], None]) -> bool:
        """On with it until it is time (``monotonic``), or to stop; whether only slabs that have not begun are left."""
        while monotonic() < until and not stop():
            if self.nodes < self._most:
                self._filled()
            if self._hopeless:  # it takes little
                self._refuted(self._hopeless.pop())
            elif self._moving:
                self._moved()
            elif self._failed:
                self._halved()
            else:
                break
            tell()
        return not (self._moving or self._failed or self._hopeless or (self._waiting and self.nodes < self._most))

    @property
    def left(self) -> list[Slab]:
        """Slabs that have not begun, in order."""
        return [slab.anew for slab in sorted(self._waiting, key=lambda slab: slab.begin)]

    def _filled(self) -> None:
        """Slabs that wait begin where there is room."""
        new = [self._waiting.popleft() for _ in range(min(_AT_ONCE - len(self._moving), len(self._waiting)))]
        if not new:
            return
        self._moving += new
        f = self.following
        none = Forms.none(f.n, f.m, 2 + len(f.tube) + f.m)
        for slab in new:
            found, slab.found = slab.found or none, None
            self._before = found if self._before is None else self._before.joined(found)

    def _moved(self) -> None:
        """The next cell of each slab: found, or half as long, or given up."""
        assert self._before is not None
        f, slabs, before = self.following, self._moving, self._before
        begin, stop, start, end = (np.array([getattr(slab, key) for slab in slabs]) for key in ("begin", "stop", "at", "next"))
        cells = Cells(begin, stop, start, end, np.zeros(len(slabs), dtype=np.int64))
        first = np.array([not slab.ends for slab in slabs])
        middle = before.half[:, 1] + cells.half[:, 1]
        q = f.guessed(before, cells, middle)
        q[first] = f.healthy(cells.start + cells.end, cells.end)[0][first]
        q = f.solved(q, cells)
        rows = np.round(q / UNIT).astype(np.int64)
        rows[:, f.still] = 0
        forms = f.forms(q, cells)
        self.nodes += len(slabs)
        goes_on = np.where(first, f.begins(forms, cells), f.goes_on(before, forms))
        good, kept = forms.good & goes_on, []
        for k, slab in enumerate(slabs):
            if good[k]:
                slab.ends.append(slab.next)
                slab.centres.append(rows[k])
                slab.lengthened()
            elif not slab.shortest:
                slab.step //= 2
            else:
                slab.found = before.take(np.array([k]))
                self._failed.append(slab)
                continue
            if slab.at < self._end:
                kept.append(k)
            else:
                self._done(slab)
        self._before = before.put(np.flatnonzero(good), forms.take(np.flatnonzero(good))).take(np.array(kept, dtype=np.int64))
        self._moving = [slabs[k] for k in kept]

    def _done(self, slab: Slab) -> None:
        """Proved."""
        self.proved.append(slab)
        self.closed += slab.stop - slab.begin

    def _turned(self, slabs: list[Slab]) -> list[Slab]:
        """Slabs, less those from which turned cells lead on, and one behind them that is not."""
        f = self.following
        some = [] if len(f.tube) else [slab for slab in slabs if slab.halvings >= PLAIN]
        for slab, found in zip(some, led(f, some), strict=True):
            if found is None:
                continue
            ends, centres, slab.found = found
            slabs = [one for one in slabs if one is not slab]
            self.nodes += len(ends)
            slab.ends += ends
            slab.centres += centres
            slab.step = slab.at & -slab.at
            slab.lengthened()
            if slab.at < self._end:
                self._waiting.append(slab)
            else:
                self._done(slab)
        return slabs

    def _halved(self) -> None:
        """Slabs that came no further go on in turned cells, or are halved, if lock instants, alone, are followed to the end."""
        slabs, self._failed = self._failed, []
        locks = np.array([(slab.begin, (slab.begin + slab.stop) // 2, slab.stop) for slab in slabs])
        ends = np.asarray(self.following.finishes(locks.ravel())).reshape(-1, 3)
        whole = [slab for slab, good in zip(slabs, ends, strict=True) if good.all()]
        left = {id(slab) for slab in self._turned(whole)}
        for slab, good in zip(slabs, ends, strict=True):
            if good.all() and id(slab) not in left:
                continue
            if not good.any():
                self._hopeless.append(slab)
            elif slab.halvings == self._halvings:
                self.closed += slab.stop - slab.begin
            else:
                self._waiting += slab.halves

    def _refuted(self, slab: Slab) -> None:
        """From no instant of a slab that was looked at a motion was found: it is refuted, or its halves may be."""
        never, parts, nodes = (None, False, 0) if self._rings is None else self._rings.tried(slab.begin, slab.stop)
        self.nodes += nodes
        if never is None and parts and slab.halvings < self._halvings:
            self._hopeless += slab.halves
            return
        self.never += [] if never is None else [never]
        self.closed += slab.stop - slab.begin
