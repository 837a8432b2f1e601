"""Slabs of lock instants, each with cells from the lock to the end of the path, in which one motion goes on."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from time import monotonic

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.tool_paths.forms import SEGMENT, UNIT, Cells, Following, Forms

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

_AT_ONCE = 64  # slabs that march side by side
_SHORTEST = SEGMENT >> 7  # of cells, or a quarter of their slab


@dataclass
class Slab:
    """Lock instants from ``begin`` to ``stop``, and what is found behind them.

    Attributes:
        begin, stop: Instants in one segment.
        halvings: That made it.
        ends: Of its cells, in order.
        centres: (n,) of each, in units of the file; 0 of joints that are not free.
        step: Of the next cell.
    """

    begin: int
    stop: int
    halvings: int = 0
    ends: list[int] = field(default_factory=list)
    centres: list[Ints] = field(default_factory=list)
    step: int = 0

    @property
    def anew(self) -> Slab:
        """Without what is found, the first cell as long as it."""
        return Slab(self.begin, self.stop, self.halvings, step=self.stop - self.begin)

    @property
    def at(self) -> int:
        """How far it is proved."""
        return self.ends[-1] if self.ends else self.begin

    @property
    def next(self) -> int:
        """Where the next cell ends."""
        return self.at + self.step

    @property
    def shortest(self) -> bool:
        """Whether the next cell may not be shorter."""
        return not self.ends or self.step <= max(1, min(_SHORTEST, (self.stop - self.begin) // 4))

    def lengthened(self) -> None:
        """The next step: up to twice as long, but such that cells are halves of halves of a segment."""
        self.step = min(2 * self.step, self.at & -self.at, SEGMENT)


@dataclass(frozen=True, kw_only=True)
class LockedPath:
    """What was found for the lock of one joint.

    Attributes:
        joint: Index of it.
        followers: Of joints that go on with the healthy motion, as more are left than the task has rows.
        slabs: Intervals of lock instants that are proved, in order, each with its cells.
        proved: Exact part of the lock instants.
        nodes: Cells that were looked at.
        finished: False if the search was stopped.
        seconds: Measured.
    """

    joint: int
    followers: tuple[int, ...]
    slabs: tuple[Slab, ...]
    proved: Fraction
    nodes: int
    finished: bool
    seconds: float

    @property
    def spans(self) -> list[tuple[int, int]]:
        """Proved intervals of lock instants."""
        return [(slab.begin, slab.stop) for slab in self.slabs]

    @property
    def leaves(self) -> int:
        """Cells of proved slabs."""
        return sum(len(slab.ends) for slab in self.slabs)


class March:
    """The search of one lock.

    Args:
        following: The locked arm and the path.
        slabs: Of lock instants.
        halvings: Of slabs, at most.
        most: Cells that are looked at before no more slabs begin.

    Attributes:
        proved: Slabs, in no order.
        nodes: Cells that were looked at.
        closed: Instants of slabs that are done with.
    """

    def __init__(self, following: Following, slabs: Sequence[Slab], halvings: int, most: float = np.inf) -> None:
        self.following, self._halvings, self._most = following, halvings, most
        self._end = (len(following.knots) - 1) * SEGMENT
        self.proved: list[Slab] = []
        self.nodes, self.closed = 0, 0
        self._waiting = deque(slab.anew for slab in slabs)
        self._moving: list[Slab] = []
        self._failed: list[Slab] = []
        self._before: Forms | None = None

    def run(self, until: float, stop: Callable[[], bool], tell: Callable[[], None]) -> bool:
        """On with it until it is time (``monotonic``), or to stop; whether only slabs that have not begun are left."""
        while (self._moving or self._waiting or self._failed) and monotonic() < until and not stop():
            if not (self._moving or self._waiting):
                self._halved()
            if self.nodes < self._most:
                self._filled()
            elif not self._moving:
                break
            if self._moving:
                self._moved()
            tell()
        if self._failed and not self._moving and self.nodes >= self._most:
            self._halved()
        return not (self._moving or self._failed or (self._waiting and self.nodes < self._most))

    @property
    def left(self) -> list[Slab]:
        """Slabs that have not begun, in order."""
        return sorted(self._waiting, key=lambda slab: slab.begin)

    def _filled(self) -> None:
        """Slabs that wait begin where there is room."""
        new = [self._waiting.popleft() for _ in range(min(_AT_ONCE - len(self._moving), len(self._waiting)))]
        if not new:
            return
        self._moving += new
        f, count = self.following, len(new)
        columns = 2 + len(f.tube) + f.m
        none = Forms(
            np.zeros((count, f.n)), np.zeros((count, f.m, columns)), np.zeros((count, columns)), np.zeros((count, f.m)),
            np.zeros(count, dtype=bool),
        )  # fmt: skip
        self._before = none if self._before is None else self._before.joined(none)

    def _moved(self) -> None:
        """The next cell of each slab: found, or half as long, or given up."""
        assert self._before is not None
        f, slabs, before = self.following, self._moving, self._before
        cells = Cells(*(np.array([getattr(slab, key) for slab in slabs]) for key in ("begin", "stop", "at", "next")))
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
                if slab.at == self._end:
                    self.proved.append(slab)
                    self.closed += slab.stop - slab.begin
                    continue
                slab.lengthened()
            elif not slab.shortest:
                slab.step //= 2
            else:
                self._given_up(slab)
                continue
            kept.append(k)
        chosen = np.array(kept, dtype=np.int64)
        self._before = before.replaced(forms, good).take(chosen)
        self._moving = [slabs[k] for k in kept]

    def _given_up(self, slab: Slab) -> None:
        """To be halved, if that is of any use."""
        if slab.halvings == self._halvings:
            self.closed += slab.stop - slab.begin
        else:
            self._failed.append(slab)

    def _halved(self) -> None:
        """Those of slabs that were given up in which some lock instant, alone, is followed to the end."""
        slabs, self._failed = self._failed, []
        locks = np.array([(slab.begin, (slab.begin + slab.stop) // 2, slab.stop) for slab in slabs])
        ends = np.asarray(self.following.finishes(locks.ravel())).reshape(-1, 3)
        some = [bool(any(row)) for row in ends]
        for slab, (begin, middle, stop), good in zip(slabs, locks.tolist(), some, strict=True):
            if not good:
                self.closed += stop - begin
                continue
            for a, b in ((begin, middle), (middle, stop)):
                self._waiting.append(Slab(a, b, slab.halvings + 1, step=b - a))
