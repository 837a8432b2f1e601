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
from holdfast.certificates.tool_paths.rings import Never, Rings

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

_AT_ONCE = 64  # slabs that march side by side
_TURNED, _NARROWER, _WIDEST, _REACH = 24, 16, 0.5, 0.8  # cells in a row; half widths; the middle of one, in half widths ahead
_PLAIN = 2  # halvings of a slab before its cells are turned
_SHORTEST = SEGMENT >> 7  # of cells, or a quarter of their slab


@dataclass
class Slab:
    """Lock instants from ``begin`` to ``stop``, and what is found behind them.

    Attributes:
        begin, stop: Instants in one segment.
        halvings: That made it.
        ends: Of its cells, in order; of one that is turned less its half width, in units of the file.
        centres: (n,) of each, in units of the file; 0 of joints that are not free. Of a cell that is turned, or the next
            one, that of the locked joint is the place on the path, in instants from the last knot.
        step: Of the next cell.
        found: In the last of its cells, while it waits.
    """

    begin: int
    stop: int
    halvings: int = 0
    ends: list[int] = field(default_factory=list)
    centres: list[Ints] = field(default_factory=list)
    step: int = 0
    found: Forms | None = None

    @property
    def anew(self) -> Slab:
        """Without what is found, the first cell as long as it."""
        return Slab(self.begin, self.stop, self.halvings, step=self.stop - self.begin)

    @property
    def halves(self) -> list[Slab]:
        """Two."""
        middle = (self.begin + self.stop) // 2
        return [Slab(a, b, self.halvings + 1).anew for a, b in ((self.begin, middle), (middle, self.stop))]

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


def led(f: Following, slab: Slab, before: Forms) -> tuple[list[int], list[Ints], Forms] | None:
    """Turned cells behind what a slab has, and one behind them that is not: ends, centres, and what is found in the last."""
    base, first = slab.at // SEGMENT * SEGMENT, not slab.ends
    lock = np.array([slab.begin]), np.array([slab.stop])
    q, place = f.healthy(lock[0] + lock[1], lock[1])[0][0], (slab.begin + slab.stop) / (2 * SEGMENT)
    if not first:
        there, at = f.end(before)
        q, place = there[0], float(at[0])
    ends, centres = list[int](), list[Ints]()
    for _ in range(_TURNED):
        by = np.asarray(_WIDEST * 0.5 ** np.arange(_NARROWER), dtype=np.float64)
        middles, places = f.ahead(q, place, base, _REACH * by)
        some = np.flatnonzero((places > base) & (places <= base + SEGMENT))
        if not some.size:
            return None
        width = np.rint(by[some] / UNIT).astype(np.int64)
        cells = Cells(np.repeat(lock[0], len(some)), np.repeat(lock[1], len(some)), places[some], places[some], width)
        forms = f.forms(f.placed(middles[some], cells), cells)
        from_there = before.take(np.zeros(len(some), dtype=np.int64))
        good = forms.good & (f.begins(forms, cells) if first else f.goes_on(from_there, forms))
        if not good.any():
            return None
        best = int(good.argmax())
        before, first = forms.take(np.array([best])), False
        ends.append(-int(width[best]))
        centres.append(_row(f, before, int(places[some][best]) - base))
        if (left := _straight(f, lock, base, before)) is not None:
            form, start, end = left
            return [*ends, end], [*centres, _row(f, form, start - base)], form
        end_q, end_place = f.end(before)
        q, place = end_q[0], float(end_place[0])
    return None


def _straight(f: Following, lock: tuple[Ints, Ints], base: int, before: Forms) -> tuple[Forms, int, int] | None:
    """The longest cell that is not turned behind one that is, with its start and end; None: there is none."""
    q, place = f.end(before)
    spread = np.abs(before.own[0, -1, 0]) * before.half[0, 0] + (np.abs(before.own[0, -1, 2:]) * before.half[0, 2:]).sum()
    low, high = (int(np.floor((place[0] + sign * 1.01 * spread) * SEGMENT)) + (sign > 0) for sign in (-1, 1))
    start = max(low - 1, base)
    tries = sorted({min((high >> k) + 1 << k, base + SEGMENT) for k in range(max(1, (high - low).bit_length() - 1), 20)})
    ends = np.array([end for end in tries if end > high], dtype=np.int64)
    if not ends.size:
        return None
    count = len(ends)
    cells = Cells(
        np.repeat(lock[0], count), np.repeat(lock[1], count), np.full(count, start), ends, np.zeros(count, dtype=np.int64)
    )
    forms = f.forms(f.solved(np.repeat(q, count, axis=0), cells), cells)
    good = np.flatnonzero(forms.good & f.goes_on(before.take(np.zeros(count, dtype=np.int64)), forms))
    return None if not good.size else (forms.take(good[-1:]), start, int(ends[good[-1]]))


def _row(f: Following, form: Forms, place: int) -> Ints:
    """A centre as the file has it."""
    row = np.round(form.q[0] / UNIT).astype(np.int64)
    row[f.still] = 0
    row[f.still[0]] = place
    return np.asarray(row)


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
            if self._moving:
                self._moved()
            elif self._failed:
                self._halved()
            elif self._hopeless:
                self._refuted(self._hopeless.pop())
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
        columns = 2 + len(f.tube) + f.m
        none = Forms(
            np.zeros((1, f.n)), np.zeros(1), np.zeros(1, dtype=bool), np.zeros((1, f.m + 1, columns)), np.zeros((1, columns)),
            np.zeros((1, f.m)), np.zeros(1, dtype=bool),
        )  # fmt: skip
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
        self._before = before.replaced(forms, good).take(np.array(kept, dtype=np.int64))
        self._moving = [slabs[k] for k in kept]

    def _done(self, slab: Slab) -> None:
        """Proved."""
        self.proved.append(slab)
        self.closed += slab.stop - slab.begin

    def _turned(self, slab: Slab) -> bool:
        """Whether turned cells lead on from a slab, and one behind them that is not."""
        f = self.following
        assert slab.found is not None
        found = None if len(f.tube) or slab.halvings < _PLAIN else led(f, slab, slab.found)
        if found is None:
            return False
        ends, centres, slab.found = found
        self.nodes += len(ends)
        slab.ends += ends
        slab.centres += centres
        slab.step = slab.at & -slab.at
        slab.lengthened()
        if slab.at < self._end:
            self._waiting.append(slab)
        else:
            self._done(slab)
        return True

    def _halved(self) -> None:
        """Slabs that came no further go on in turned cells, or are halved, if lock instants, alone, are followed to the end."""
        slabs, self._failed = self._failed, []
        locks = np.array([(slab.begin, (slab.begin + slab.stop) // 2, slab.stop) for slab in slabs])
        ends = np.asarray(self.following.finishes(locks.ravel())).reshape(-1, 3)
        for slab, good in zip(slabs, ends, strict=True):
            if good.all() and self._turned(slab):
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
