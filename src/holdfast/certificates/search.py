"""Which part of a box of targets and locked angles is proved: cells halved until one configuration does for each of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from heapq import heappop, heappush
from time import monotonic

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.taylor import UNIT, Form, Reach

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.int64]
Tell = Callable[[float], None]

PROVED, UNDECIDED, SPLIT = 0, 2, 16  # tokens of the tree
_POOL, _STARTS = 1000, 12  # targets, and random starts of each
_NEAR = 3, 6  # of the pool, tried for a cell; for one that is as small as it may be
_STEPS, _STRIDE = 6, 0.5  # along self-motions, rad
_CLIMB, _TYPICAL = 10, 16  # such steps of the pool, to prove more of cells that are so many times smaller than the root
_AT_ONCE = 512
_LOST = 1e6  # m: the error where the arm is singular
_HOPELESS = 0.35  # of its cell that a configuration proves: others are tried


@dataclass
class Cells:
    """Cells of one level: halves as integers, cell k of 2^depth along each axis, and what it inherits.

    Attributes:
        place, depth: (N, A).
        name: (N,) number of each in the tree.
        q: (N, n) a configuration to begin from, rad.
    """

    place: Index
    depth: Index
    name: Index
    q: Array

    def take(self, which: NDArray[np.intp] | Flags) -> Cells:
        """Some of them."""
        return Cells(self.place[which], self.depth[which], self.name[which], self.q[which])


class Tree:
    """A bisection tree that grows level by level.

    Attributes:
        token: Of each node: proved, undecided, or 16 and the axis that is halved.
        below: The lower child of each node that is split; the upper one is the next.
        centre: (n,) of each proved node, in units of 2^-24 rad.
        depth: Halvings above each node.
    """

    def __init__(self) -> None:
        self.token: list[int] = [UNDECIDED]
        self.below: list[int] = [0]
        self.depth: list[int] = [0]
        self.centre: dict[int, Index] = {}

    def split(self, name: int, axis: int) -> int:
        """The lower child."""
        self.token[name], self.below[name] = SPLIT + axis, len(self.token)
        self.token += [UNDECIDED] * 2
        self.below += [0] * 2
        self.depth += [self.depth[name] + 1] * 2
        return self.below[name]

    def volume(self, token: int) -> Fraction:
        """Exact share of the root of the leaves with this token."""
        counts: dict[int, int] = {}
        for found, depth in zip(self.token, self.depth, strict=True):
            if found == token:
                counts[depth] = counts.get(depth, 0) + 1
        return sum((Fraction(count, 1 << depth) for depth, count in counts.items()), Fraction(0))

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


class Search:
    """The search over one root box.

    Args:
        reach: What must be reached.
        root: (A, 2) targets along each axis, m, then the locked angle, rad.
        halvings: Of each axis, at most.
        seed: Of all random draws.
    """

    def __init__(self, reach: Reach, root: Array, halvings: int, seed: int) -> None:
        self.reach, self.root, self.halvings = reach, root, halvings
        from scipy.spatial import KDTree

        self.rng = np.random.default_rng(seed)
        self.tree, self.nodes = Tree(), 0
        self.width = root[:, 1] - root[:, 0]
        self._unit = np.where(self.width > 0, self.width, 1.0)
        at = self.root[:, 0] + self.rng.random((_POOL, len(root))) * self.width
        starts = np.repeat(at, _STARTS, axis=0)
        low, high = np.clip(reach.limits.T, -np.pi, np.pi)
        q = self._at(self.rng.uniform(low, high, (len(starts), reach.n)), starts)
        q = reach.solved(q, starts[:, : reach.m], 40)
        met = reach.missed(q, starts[:, : reach.m]) < 1e-9
        self.pool = q[met]
        self._pool_at = starts[met, : reach.m]
        self._near = KDTree(starts[met] / self._unit) if met.any() else None
        self._climb(starts[met])
        self.open = 0.0  # share of the root that nobody has looked at
        self._open: list[tuple[int, int, Index, Index, Array]] = []
        start = self.pool[:1] if len(self.pool) else np.clip(np.zeros((1, reach.n)), *reach.limits.T)
        whole = np.zeros((1, len(root)), dtype=np.int64)
        self._push(Cells(whole, whole, np.zeros(1, dtype=np.int64), start))

    def _climb(self, at: Array) -> None:
        """In place: the pool moves along its self-motions to where configurations prove more."""
        half, best = np.tile(self.width / _TYPICAL, (len(at), 1)), np.full(len(at), -1.0)
        for k in range(1 + _CLIMB * self._redundant):
            q = self.reach.solved(self._stepped(self.pool), self._pool_at) if k else self.pool
            size = Form.at(self.reach, q, self._pool_at).scale(half)
            better = size > best
            self.pool[better], best[better] = q[better], size[better]

    @property
    def _redundant(self) -> bool:
        return bool(self.reach.free.sum() > self.reach.m)

    def _stepped(self, q: Array) -> Array:
        """A random step along the self-motion from each q (N, n)."""
        move = np.nan_to_num(self.reach.along(q, self.rng.normal(size=q.shape)))
        size = self.rng.uniform(0, _STRIDE, len(q)) / np.maximum(np.abs(move).max(axis=1), 1e-9)
        return np.asarray(q + move * size[:, None])

    def estimate(self) -> float:
        """Cells that the whole would take, from how much of it single configurations prove."""
        if not len(self.pool):
            return float("inf")
        some = self.rng.permutation(len(self.pool))[:_POOL]
        # The largest part of the root, by width, that each of them proves: a power of 2 down to 1/1024.
        form, half = Form.at(self.reach, self.pool[some], self._pool_at[some]), self.width / 2
        sizes = np.array([2.0**-k for k in range(11)])
        best = np.full(len(some), sizes[-1] / 2)
        for size in sizes[::-1]:
            good, _ = form.proved(np.broadcast_to(half * size, (len(some), len(half))))
            best = np.where(good, size, best)
        axes = int((self.width > 0).sum())
        return float(np.median(1 / best) ** axes)

    def run(self, until: float = np.inf, stop: Callable[[], bool] = lambda: False, tell: Tell = lambda closed: None) -> bool:
        """Down to the smallest cells, the largest first; or, to go on from another time, until it is time or to stop.

        Args:
            until: ``monotonic``.
            stop: Asked before each batch of cells.
            tell: Is told what share of the root is closed, of each batch.

        Returns:
            Whether nothing is left to do.
        """
        while self._open and monotonic() < until and not stop():
            taken = [heappop(self._open) for _ in range(min(_AT_ONCE, len(self._open)))]
            _, names, places, depths, starts = zip(*taken, strict=True)
            self._halved(Cells(np.array(places), np.array(depths), np.array(names), np.array(starts)))
            tell(1 - self.open)
        return not self._open

    def _push(self, cells: Cells) -> None:
        """To be looked at."""
        halvings = cells.depth.sum(axis=1)
        self.open += float((0.5**halvings).sum())
        for row in zip(halvings.tolist(), cells.name.tolist(), cells.place, cells.depth, cells.q, strict=True):
            heappush(self._open, row)

    # ---- a batch of cells --------------------------------------------------------------------------------------

    def _at(self, q: Array, at: Array) -> Array:
        """With the locked joint where it is locked."""
        if self.reach.locked < 0:
            return q
        q = q.copy()
        q[:, self.reach.locked] = at[:, -1]
        return q

    def _halved(self, cells: Cells) -> None:
        """Those that are proved are leaves; the halves of the others are to be looked at."""
        self.nodes += len(cells.name)
        self.open -= float((0.5 ** cells.depth.sum(axis=1)).sum())
        scale = 0.5 ** (cells.depth + 1)
        half, centre = self.width * scale, self.root[:, 0] + self.width * (2 * cells.place + 1) * scale
        q, found, part = self._tried(cells.q, centre, half)
        smallest = np.asarray((cells.depth >= self.halvings)[:, self.width > 0].all(axis=1))
        self._from_pool(q, found, part, smallest, centre, half)
        self._along_self_motions(q, found, part, smallest, centre, half)
        places = np.round(q / UNIT).astype(np.int64)
        places[:, ~self.reach.free] = 0
        for k in np.flatnonzero(found):
            self.tree.token[cells.name[k]], self.tree.centre[int(cells.name[k])] = PROVED, places[k]
        # Where no configuration comes nearer to the middle than the cell is wide, none is looked for in its parts.
        off = self.reach.missed(q, centre[:, : self.reach.m])
        turn = half[:, self.reach.m :].sum(axis=1) * self.reach.lengths.sum()
        lost = off > 2 * (np.linalg.norm(half[:, : self.reach.m], axis=1) + turn)
        some = np.flatnonzero(~found & ~smallest & ~lost)
        rest, q = cells.take(some), q[some]
        axis = self._worst_axis(q, centre[some], half[some], rest.depth)
        below = np.array([self.tree.split(int(n), int(a)) for n, a in zip(rest.name, axis, strict=True)], dtype=np.int64)
        place, depth = np.repeat(rest.place, 2, axis=0), np.repeat(rest.depth, 2, axis=0)
        rows, twice = np.arange(2 * len(some)), np.repeat(axis, 2)
        place[rows, twice] = 2 * place[rows, twice] + rows % 2
        depth[rows, twice] += 1
        self._push(Cells(place, depth, np.repeat(below, 2) + rows % 2, np.repeat(q, 2, axis=0)))

    def _from_pool(self, q: Array, found: Flags, part: Array, smallest: Flags, centre: Array, half: Array) -> None:
        """In place: cells of which little is proved try the nearest of the pool, the smallest more of them."""
        some = np.flatnonzero(~found & ((part < _HOPELESS) | smallest))
        if self._near is None or not some.size:
            return
        count = min(_NEAR[1], len(self.pool))
        near = np.asarray(self._near.query(centre[some] / self._unit, k=np.arange(1, count + 1), p=np.inf)[1])
        for k in range(count):
            still = ~found[some] & ((part[some] < _HOPELESS) & (k < _NEAR[0]) | smallest[some])
            if still.any():
                self._improve(q, found, part, some[still], self.pool[near[still, k]], centre, half)

    def _along_self_motions(self, q: Array, found: Flags, part: Array, smallest: Flags, centre: Array, half: Array) -> None:
        """In place: cells that are nearly proved, and the smallest, try configurations on the self-motions of theirs."""
        for _ in range(_STEPS * self._redundant):
            which = np.flatnonzero(~found & ((part > 0.5) | smallest))
            if not which.size:
                break
            self._improve(q, found, part, which, self._stepped(q[which]), centre, half)

    def _improve(
        self, q: Array, found: Flags, part: Array, which: NDArray[np.intp], begin: Array, centre: Array, half: Array
    ) -> None:
        """In place: what is found from other configurations is taken where it proves more."""
        other, good, more = self._tried(begin, centre[which], half[which])
        better = good | (more > part[which])
        q[which[better]], found[which[better]], part[which[better]] = other[better], good[better], more[better]

    def _tried(self, q: Array, centre: Array, half: Array) -> tuple[Array, Flags, Array]:
        """Rounded configurations near q (N, n), which of the cells they prove, and how much of the others, by width."""
        m = self.reach.m
        q = self._rounded(self.reach.solved(self._at(q, centre), centre[:, :m]), centre)
        form = Form.at(self.reach, q, centre[:, :m])
        found, sections = form.proved(half)
        part = found.astype(float)
        rest = np.flatnonzero(~found)
        if rest.size:
            part[rest] = form.take(rest).scale(half[rest])
            # The error in the middle may cancel half of the curvature.
            near = rest[part[rest] > 0.5]
            above, below, _ = form.take(near).sides(half[near], sections[near])
            moved = self._rounded(self.reach.solved(q[near], centre[near, :m] - (above - below) / 2, 3), centre[near])
            good, _ = Form.at(self.reach, moved, centre[near, :m]).proved(half[near])
            q[near[good]], found[near[good]], part[near[good]] = moved[good], True, 1.0
        return q, found, part

    def _rounded(self, q: Array, centre: Array) -> Array:
        return self._at(np.round(q / UNIT) * UNIT, centre)

    def _worst_axis(self, q: Array, centre: Array, half: Array, depth: Index) -> Index:
        """The axis of each cell (N,) whose halving leaves least error and least beyond the limits."""
        form = Form.at(self.reach, q, centre[:, : self.reach.m])
        low, high = self.reach.limits.T
        price = np.full(half.shape, np.inf)
        for axis in np.flatnonzero(self.width > 0):
            narrow = half.copy()
            narrow[:, axis] /= 2
            above, below, _ = form.sides(narrow, np.zeros((len(q), self.reach.m)))
            e = np.nan_to_num(np.maximum(above, below), nan=_LOST)
            _, _, far = form.sides(narrow, np.maximum(e, 0))
            beyond = np.maximum(np.maximum(low - (q - far), q + far - high), 0) * self.reach.free
            price[:, axis] = np.where(depth[:, axis] < self.halvings, e.sum(axis=1) + beyond.sum(axis=1), np.inf)
        return np.asarray(np.where(np.isfinite(price).any(axis=1), price.argmin(axis=1), 0), dtype=np.int64)
