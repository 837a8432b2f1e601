"""Configurations from which a search begins, all over its root box."""

from __future__ import annotations

from time import monotonic, perf_counter
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.taylor import Form, Reach

Array = NDArray[np.float64]
Index = NDArray[np.int64]

_TARGETS, _MOST, _STARTS = 250, 1000, 10  # targets at first and at most, and random starts of each
_EACH = 64  # cells for each target: where there are more, there are more targets
_STRIDE = 0.5  # along self-motions, rad
_CLIMB, _BEST, _WIDER = 10, 30, 2.0  # such steps, of the best more, to prove more of cells so many times wider than without,
_MUCH, _WIDTHS = 0.75, (2.0**-10, 2.0**10)  # or twice as wide after so much of them is, in such a range
_ASKED, _ENOUGH = 200, 60  # for the estimate: so many, until so many halvings
_TRIED = 11  # configurations for each cell that is proved (measured: a Panda's cubes)
_MET = 1e-9  # m and rad


def stepped(reach: Reach, q: Array, rng: np.random.Generator) -> Array:
    """A random step along the self-motion from each q (N, n)."""
    move = np.nan_to_num(reach.along(q, rng.normal(size=q.shape)))
    size = rng.uniform(0, _STRIDE, len(q)) / np.maximum(np.abs(move).max(axis=1), 1e-9)
    return np.asarray(q + move * size[:, None])


class Pool:
    """Configurations of random targets and locked angles of a root box, moved to where they prove much.

    Args:
        reach: What must be reached.
        root: (A, 2) targets along each axis, then the locked angle.
        rng: Of all draws.
        until: When to stop (``monotonic``), with what there is.

    Attributes:
        q: (N, n) rad or m, those of the first targets.
        cells: That the whole would take, estimated; infinite where nobody knows.
        seconds: That this would take here.
        halved: (A,) how often each axis is halved for them, in the mean.
        wanted: How many more times as many targets the claim asks for; more where there was no time for the first.
        drawn, lost: Targets that were drawn first, and those of them of which no configuration was found.
    """

    def __init__(self, reach: Reach, root: Array, rng: np.random.Generator, until: float) -> None:
        self._reach, self._root, self._rng = reach, root, rng
        self._width = root[:, 1] - root[:, 0]
        self._unit = np.where(self._width > 0, self._width, 1.0)
        self._all, self._count, self._until = np.empty((0, reach.n)), 0, until
        self._added: list[tuple[Array, Array]] = []
        self._best, self._tree = list[tuple[Array, Array]](), cast(Any, None)
        self._half = np.zeros(len(root))
        self.drawn = self.lost = 0
        self.q, self._at = self._grown()
        self.cells, self.halved, self.seconds = self._estimate(self.q, self._at)
        self.wanted = int(monotonic() >= until) + max(int(min(_MOST, self.cells / _EACH)) // _TARGETS - 1, 0)

    def enlarge(self, until: float) -> None:
        """As large as the claim asks, or as there is time for (``monotonic``); an estimate does without."""
        self._until = max(self._until, until)
        while self.wanted and monotonic() < self._until:
            self._grown()
            self.wanted -= monotonic() < self._until

    def draw(self, low: Array, width: Array, until: float) -> None:
        """Configurations of targets and locked angles in some of these cells (N, A), too, if there is time (``monotonic``)."""
        self._until, some = max(self._until, until), np.resize(self._rng.permutation(len(low)), _TARGETS)
        self._grown(low[some] + self._rng.random(low[some].shape) * width[some])

    def _grown(self, drawn: Array | None = None) -> tuple[Array, Array]:
        """Configurations of some targets more, where one is found, and these; added, too."""
        reach = self._reach
        if drawn is None:
            drawn = self._root[:, 0] + self._rng.random((_TARGETS, len(self._root))) * self._width
        at = np.repeat(drawn, _STARTS, axis=0)[: None if monotonic() < self._until else 0]
        low, high = reach.spans.T
        q = reach.placed(self._rng.uniform(low, high, (len(at), reach.n)), at)
        q = reach.solved(q, at[:, : reach.axes], 40)
        met = (reach.missed(q, at[:, : reach.axes]) < _MET).all(axis=1)
        if not self.drawn:
            self.drawn, self.lost = len(at) // _STARTS, int((~met.reshape(-1, _STARTS).any(axis=1)).sum())
        q, at = q[met], at[met]
        if not self._half.any():
            self._half = _WIDER / 2 * self._width * 0.5 ** self._estimate(q, at)[1]
        q, size, wide = self._climbed(q, at, np.ones(len(q)), _CLIMB)
        self.add(at, q)
        # Arms reach a target in several ways, and cells halved in one that proves little stay with it: of each target the best.
        order = np.argsort(-size, kind="stable")
        best = order[np.unique(at[order], axis=0, return_index=True)[1]]
        found, _, _ = self._climbed(q[best], at[best], wide[best], _BEST)
        self._best.append((at[best] / self._unit, found))
        return q, at

    def _climbed(self, q: Array, at: Array, wide: Array, steps: int) -> tuple[Array, Array, Array]:
        """Moved along self-motions to where configurations prove more, and how much: parts of cells so many times as wide."""
        q, best, targets = q.copy(), np.full(len(q), -1.0), at[:, : self._reach.axes]
        for k in range(1 + steps * self._reach.redundant):
            if monotonic() > self._until:
                break
            other = self._reach.solved(stepped(self._reach, q, self._rng), targets) if k else q
            half = np.minimum(self._half * wide[:, None], self._width / 2)
            size = wide * Form.at(self._reach, other, targets).scale(half, best / wide if k else None)
            better = size > best
            q[better], best[better] = other[better], size[better]
            wide = np.clip(np.where(best > _MUCH * wide, 2 * wide, np.where(best > 0, wide, wide / 2)), *_WIDTHS)
        return q, best, wide

    def add(self, centre: Array, q: Array) -> None:
        """Configurations q (N, n) that proved cells around centres (N, A): cells near them may need the same."""
        self._added.append((centre / self._unit, q))

    def _nearest(self, centre: Array, count: int) -> tuple[Array, Index]:
        """(N, count) how far away in parts of the root, and which, of fewer if there are fewer."""
        if 2 * self._count < sum(len(q) for _, q in self._added):  # else the tree is made anew too often
            from scipy.spatial import KDTree

            at, self._all = (np.concatenate(x) for x in zip(*self._added, strict=True))
            self._added, self._count, self._near = [(at, self._all)], len(at), KDTree(at)
        count = min(count, self._count)
        if not count:
            return np.empty((len(centre), 0)), np.empty((len(centre), 0), dtype=np.int64)
        away, nearest = self._near.query(centre / self._unit, k=np.arange(1, count + 1), p=np.inf)
        return np.asarray(away), np.asarray(nearest)

    def near(self, centre: Array, count: int) -> Array:
        """(N, count, n) the nearest configurations by target and locked angle of centres (N, A), fewer if there are fewer."""
        _, nearest = self._nearest(centre, count)
        return np.asarray(self._all[nearest])

    def best(self, centre: Array) -> Array:
        """(N, n) of the target that was drawn nearest to each centre (N, A), what proves most; (0, n) if there is none."""
        at, q = (np.concatenate(x) for x in zip(*self._best, strict=True))
        if not len(q):
            return np.empty((0, self._reach.n))
        from scipy.spatial import KDTree

        if self._tree is None or self._tree.n != len(q):
            self._tree = KDTree(at)
        return np.asarray(q[self._tree.query(centre / self._unit, p=np.inf)[1]])

    def known(self, centre: Array, half: Array) -> NDArray[np.bool_]:
        """(N,) whether one is known in cells (N, A), or in what is beside them where they are longer than wide."""
        away, _ = self._nearest(centre, 1)
        return np.asarray((away <= (half / self._unit).max(axis=1, keepdims=True)).any(axis=1))

    def cut(self, count: int, most: int) -> tuple[int, ...]:
        """Axes along which to halve the root so often, each not more than ``most`` times: those that are halved anyway."""
        left, axes = self.halved.copy(), list[int]()
        for _ in range(count):
            axis = int(np.argmax(left))
            if left[axis] > 0 and axes.count(axis) < most:
                axes.append(axis)
            left[axis] -= 1
        return tuple(axes)

    def _estimate(self, q: Array, at: Array) -> tuple[float, Array, float]:
        """The cells, of each axis the halvings, and the seconds, from some of configurations (N, n) of targets (N, A).

        Of the cells the median of 2 to the halvings until a configuration proves its cell.
        """
        if not len(q):
            return np.inf, np.zeros(len(self._root)), np.inf
        some = self._rng.permutation(len(q))[:_ASKED]
        targets, half = at[some, : self._reach.axes], np.tile(self._width / 2, (len(some), 1))
        form = Form.at(self._reach, q[some], targets)
        halvings, may = np.zeros(half.shape), np.broadcast_to(self._width > 0, half.shape)
        left = np.arange(len(some))
        for _ in range(_ENOUGH):
            left = left[~form.take(left).proved(half[left])]
            if not left.size:
                break
            axis = form.take(left).worst_axis(half[left], may[left])
            halvings[left, axis] += 1
            half[left, axis] /= 2
        began = perf_counter()
        Form.at(self._reach, self._reach.solved(form.q, targets), targets).scale(half)
        each = (perf_counter() - began) / len(some)
        done = halvings[np.setdiff1d(np.arange(len(some)), left)]  # one at a limit proves nothing, however small the cell
        if not len(done):
            return np.inf, np.zeros(len(self._root)), np.inf
        cells = float(2 ** np.median(done.sum(axis=1)))
        return cells, done.mean(axis=0), _TRIED * each * cells
