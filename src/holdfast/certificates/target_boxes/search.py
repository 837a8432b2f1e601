"""Which part of a box of targets and locked angles is proved: cells halved until one configuration does for each of them."""

from __future__ import annotations

from collections.abc import Callable
from heapq import heappop, heappush
from time import monotonic

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.target_boxes.pool import Pool, stepped
from holdfast.certificates.taylor import UNIT, Form, Reach
from holdfast.certificates.tree import Cells, Tree

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.int64]
Tell = Callable[[float], None]

_NEAR = 3, 6  # of the pool, tried for a cell; for one that is as small as it may be
_STEPS = 4  # along self-motions
_AT_ONCE = 4096
_LEAST_TURN = 1e-3  # rad: a tool turned away by less may come to its target
_HOPELESS = 0.35  # of its cell that a configuration proves: others are tried
_MOVED = 14 / 16  # of its cell: where a configuration proves more, it is moved to prove all
_FAIR = 0.5  # of its cell: where one proves more, others on its self-motion are tried
_LEAST = 1 / 32  # of a cell of which nothing was proved, for its worth

_SMALL = 0.75  # of all halvings
_DEEPER = 0.25  # of a halving: so much is a cell worth more for being smaller
_LITTLE = 0.01  # of the root: where no more is left at the end, what was given up is looked at once more,
_FEW = 16  # of its cells at first


class Search:
    """The search over one root box, resumed as often as one likes.

    Args:
        reach: What must be reached.
        root: (A, 2) targets along each axis, m, then the locked angle, rad.
        halvings: Of each axis, at most; (A,) of one of them each.
        seed: Of all random draws.
        until: When the pool must be there (``monotonic``).

    Attributes:
        tree: What is found.
        pool: Where it began.
        nodes: Cells that were looked at.
        open, proved: Shares of the root: still to be looked at, and proved.
    """

    def __init__(self, reach: Reach, root: Array, halvings: int | Index, seed: int | list[int], until: float = np.inf) -> None:
        self.reach, self.root, self.halvings = reach, root, np.broadcast_to(halvings, len(root))
        self.rng, self.tree, self.nodes = np.random.default_rng(seed), Tree(), 0
        self.width = root[:, 1] - root[:, 0]
        self.pool = Pool(reach, root, self.rng, until)
        self.open = self.proved = 0.0
        self._open: list[tuple[float, int, Index, Index, Array, int]] = []
        self._given_up: list[Cells] = []
        self._again: float | None = None  # what must be proved of the root by the end of such a second look
        start = self.pool.q[:1] if len(self.pool.q) else np.clip(np.zeros((1, reach.n)), *reach.limits.T)
        whole = np.zeros((1, len(root)), dtype=np.int64)
        none = np.zeros(1, dtype=np.int64)
        self._push(Cells(whole, whole, none, start, none), np.ones(1))

    def run(self, until: float = np.inf, stop: Callable[[], bool] = lambda: False, tell: Tell = lambda closed: None) -> bool:
        """Down to the smallest cells, or until it is time or to stop: first where most is proved by a configuration.

        Args:
            until: ``monotonic``.
            stop: Asked before each batch of cells.
            tell: Is told what share of the root is closed, of each batch.

        Returns:
            Whether nothing is left to do.
        """
        if self.pool.wanted:
            self.pool.enlarge((monotonic() + until) / 2)
        while (self._open or (self._given_up and self._once_more(until))) and monotonic() < until and not stop():
            taken = [heappop(self._open) for _ in range(min(_AT_ONCE, len(self._open)))]
            _, names, *parts, barren = map(np.array, zip(*taken, strict=True))
            self._look(Cells(parts[0], parts[1], names, parts[2], barren))
            tell(1 - self.open)
        return not self._open

    def _once_more(self, until: float) -> bool:
        """Whether cells that were given up, a few and then all, are looked at again: while more than half of them is proved.

        They cannot be proved, or all that was near them was bad: configurations are drawn for them alone.
        """
        cells = self.tree.whole_again(Cells.of(self._given_up))
        order, few = self.rng.permutation(len(cells.name)), _FEW if self._again is None else len(cells.name)
        if cells.share > _LITTLE if self._again is None else self.proved <= self._again:
            self._given_up = [cells]
            return False
        self._given_up = [cells.take(order[few:])] if few < len(order) else []
        cells = cells.take(order[:few])
        self._again = self.proved + cells.share / 2
        width = self.width * 0.5**cells.depth
        self.pool.draw(self.root[:, 0] + width * cells.place, width, until)
        cells.barren[:] = 0
        self._push(cells, np.ones(len(cells.name)))
        return True

    def _push(self, cells: Cells, part: Array) -> None:
        """To be looked at; of the cells around them these parts (N,), by width, were proved by one configuration.

        A cell takes as many configurations as such parts fill it: what each of them proves is the same for cells of all
        sizes where the arm is the same, so that smaller cells, which are nearer to being proved, come first by a little.
        """
        self.open += cells.share
        axes, halvings = int((self.width > 0).sum()), cells.depth.sum(axis=1)
        worth = (_DEEPER - 1) * halvings + axes * np.log2(np.maximum(part, _LEAST))
        first = (-worth).tolist(), cells.name.tolist()
        for row in zip(*first, cells.place, cells.depth, cells.q, cells.barren.tolist(), strict=True):
            heappush(self._open, row)

    # ---- a batch of cells --------------------------------------------------------------------------------------

    def _look(self, cells: Cells) -> None:
        """Those that are proved are leaves; the halves of the others are to be looked at."""
        self.nodes += len(cells.name)
        self.open -= cells.share
        scale = 0.5 ** (cells.depth + 1)
        half, centre = self.width * scale, self.root[:, 0] + self.width * (2 * cells.place + 1) * scale
        q, found, part = self._tried(cells.q, centre, half)
        smallest = np.asarray((cells.depth >= self.halvings)[:, self.width > 0].all(axis=1))
        self._from_pool(q, found, part, smallest, centre, half)
        self._along_self_motions(q, found, part, smallest, centre, half)
        places = np.round(q / UNIT).astype(np.int64)
        places[:, ~self.reach.free] = 0
        self.proved += cells.take(np.flatnonzero(found)).share
        for k in np.flatnonzero(found):
            self.tree.prove(int(cells.name[k]), places[k])
        self.pool.add(centre[found], q[found])
        # Where no configuration comes nearer to the middle than the cell is wide, and none is known of another part of it, none
        # is looked for in its parts.
        away, turned = self.reach.missed(q, centre[:, : self.reach.axes]).T
        turn = half[:, self.reach.axes :].sum(axis=1)
        lost = away > 2 * (np.linalg.norm(half[:, : self.reach.linear], axis=1) + turn * self.reach.swing)
        lost |= turned > 2 * half[:, self.reach.linear :].sum(axis=1) + _LEAST_TURN
        lost[lost] = ~self.pool.known(centre[lost], half[lost])
        # Nor in small cells after nothing was proved of as many around each other as there are axes.
        barren = np.where(part > 0, 0, cells.barren + 1)
        axes = int((self.width > 0).sum())
        lost |= (barren >= axes) & (cells.depth.sum(axis=1) >= _SMALL * self.halvings[self.width > 0].sum())
        some = np.flatnonzero(~found & ~smallest & ~lost)
        if (gone := np.flatnonzero(~found & (smallest | lost))).size:
            self._given_up.append(cells.take(gone))
        rest = cells.take(some)
        rest.q, rest.barren = q[some], barren[some]
        form = Form.at(self.reach, rest.q, centre[some, : self.reach.axes])
        axis = form.worst_axis(half[some], (rest.depth < self.halvings) & (self.width > 0))
        self._push(self.tree.halved(rest, axis), np.repeat(part[some], 2))

    def _from_pool(self, q: Array, found: Flags, part: Array, smallest: Flags, centre: Array, half: Array) -> None:
        """In place: all try what proves most near them, those of which little is proved the nearest of the pool, too."""
        which = np.flatnonzero(~found)
        best = self.pool.best(centre[which])
        if len(best):
            self._improve(q, found, part, which, best, centre, half)
        some = np.flatnonzero(~found & ((part < _HOPELESS) | smallest))
        near = self.pool.near(centre[some], _NEAR[1])
        for k in range(near.shape[1]):
            still = ~found[some] & ((part[some] < _HOPELESS) & (k < _NEAR[0]) | smallest[some])
            if still.any():
                self._improve(q, found, part, some[still], near[still, k], centre, half)

    def _along_self_motions(self, q: Array, found: Flags, part: Array, smallest: Flags, centre: Array, half: Array) -> None:
        """In place: cells nearly proved or not at all, and the smallest, try configurations on the self-motions of theirs."""
        for _ in range(_STEPS * self.reach.redundant):
            which = np.flatnonzero(~found & ((part > _FAIR) | smallest | (part == 0)))
            if not which.size:
                break
            self._improve(q, found, part, which, stepped(self.reach, q[which], self.rng), centre, half)

    def _improve(
        self, q: Array, found: Flags, part: Array, which: NDArray[np.intp], begin: Array, centre: Array, half: Array
    ) -> None:
        """In place: what is found from other configurations is taken where it proves more."""
        other, good, more = self._tried(begin, centre[which], half[which], np.minimum(part[which], _MOVED))
        better = good | (more > part[which])
        q[which[better]], found[which[better]], part[which[better]] = other[better], good[better], more[better]

    def _tried(self, q: Array, centre: Array, half: Array, least: Array | None = None) -> tuple[Array, Flags, Array]:
        """Rounded configurations near q (N, n), which of the cells they prove, and how much of the others, by width.

        ``least`` (N,): Less than that is told to be that.
        """
        targets = centre[:, : self.reach.axes]
        q = self._rounded(self.reach.solved(self.reach.placed(q, centre), targets), centre)
        form = Form.at(self.reach, q, targets)
        found = form.proved(half)
        part = found.astype(float)
        rest = np.flatnonzero(~found)
        if rest.size:
            part[rest] = form.take(rest).scale(half[rest], None if least is None else least[rest])
            # The error in the middle may cancel half of the curvature.
            near = rest[part[rest] > _MOVED]
            form, none = form.take(near), np.zeros((near.size, self.reach.m))
            above, below, _ = form.sides(half[near], none)
            above, below, _ = form.sides(half[near], np.maximum(above, below))
            moved = self._rounded(self.reach.solved(q[near], targets[near], 3, (below - above) / 2), centre[near])
            good = Form.at(self.reach, moved, targets[near]).proved(half[near])
            q[near[good]], found[near[good]], part[near[good]] = moved[good], True, 1.0
        return q, found, part

    def _rounded(self, q: Array, centre: Array) -> Array:
        return self.reach.placed(np.round(q / UNIT) * UNIT, centre)
