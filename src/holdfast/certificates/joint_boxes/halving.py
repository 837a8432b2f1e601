"""Boxes halved until each is decided, many at once: a bisection tree as certificates write it."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from time import monotonic

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.tree import SPLIT, UNDECIDED, SearchState, Tell
from holdfast.certificates.verifier import MOST_LEAVES
from holdfast.errors import InputError

Array = NDArray[np.float64]
Index = NDArray[np.int64]
Test = Callable[[Array, Array], tuple[Index, Array]]

OPEN = -1  # what is not decided yet
_AT_ONCE = 4096
_PATHS, _FAR = 101, 60  # for an estimate; halvings after which nobody asks


class Halving:
    """The halving of one box.

    Args:
        box: (A, 2), low and high along each axis.
        halvings: Of each axis, at most.
    """

    def __init__(self, box: Array, halvings: int) -> None:
        self.box, self.halvings = box, halvings
        self.width = box[:, 1] - box[:, 0]
        self._token, self._below = np.full(1 << 10, UNDECIDED, dtype=np.uint8), np.zeros(1 << 10, dtype=np.int64)
        self._depth = np.zeros(1 << 10, dtype=np.int64)
        self.nodes = 1
        self.tested = 0

    def run(
        self,
        test: Test,
        until: float = np.inf,
        stop: Callable[[], bool] = lambda: False,
        tell: Tell = lambda now: None,
        most: int = 1 << 24,
    ) -> bool:
        """Halve until all is decided, a time (``monotonic``) or ``stop`` comes, or so many nodes are made: then False.

        The test takes middles and half widths (N, A) and gives a token or OPEN for each (N,), and what halving each axis would
        gain (N, A). ``tell`` is told what part of the box is closed.
        """
        axes, closed, proved = len(self.box), 0.0, 0.0
        waiting = [(np.zeros(1, dtype=np.int64), self.box.mean(axis=1)[None], np.zeros((1, axes), dtype=np.int64))]
        while waiting:
            if monotonic() > until or stop() or self.nodes > most:
                return False
            name, middle, depth = waiting.pop()
            if len(name) > _AT_ONCE:
                waiting.append((name[_AT_ONCE:], middle[_AT_ONCE:], depth[_AT_ONCE:]))
                name, middle, depth = name[:_AT_ONCE], middle[:_AT_ONCE], depth[:_AT_ONCE]
            half = self.width * 0.5 ** (depth + 1)
            self.tested += len(name)
            found, gain = test(middle, half)
            done = found != OPEN
            self._token[name[done]] = found[done]
            gain = np.where((depth < self.halvings) & (half > 0), np.nan_to_num(gain, nan=0.0), -1.0)
            split = ~done & (gain.max(axis=1) > 0)
            closed += float((0.5 ** depth[~split].sum(axis=1)).sum())
            proved += float((0.5 ** depth[done].sum(axis=1)).sum())
            tell(SearchState(proved=proved, undecided=closed - proved, open=1 - closed, nodes=self.tested))
            if split.any():
                waiting.append(self._split(name[split], middle[split], depth[split], half[split], gain[split].argmax(axis=1)))
        return True

    def _split(self, name: Index, middle: Array, depth: Index, half: Array, axis: Index) -> tuple[Index, Array, Index]:
        """The halves."""
        count = len(name)
        while self.nodes + 2 * count > len(self._token):
            for key in ("_token", "_below", "_depth"):
                old = getattr(self, key)
                setattr(self, key, np.concatenate([old, np.full_like(old, UNDECIDED if key == "_token" else 0)]))
        below = self.nodes + 2 * np.arange(count)
        self._token[name], self._below[name] = SPLIT + axis, below
        self.nodes += 2 * count
        names, rows = np.repeat(below, 2) + np.arange(2 * count) % 2, np.arange(2 * count)
        self._depth[names] = np.repeat(self._depth[name], 2) + 1
        middles, depths, axes = np.repeat(middle, 2, axis=0), np.repeat(depth, 2, axis=0), np.repeat(axis, 2)
        depths[rows, axes] += 1
        middles[rows, axes] += np.where(rows % 2, 0.5, -0.5) * np.repeat(half, 2, axis=0)[rows, axes]
        return names, middles, depths

    @property
    def leaves(self) -> int:
        """How many are decided."""
        token = self._token[: self.nodes]
        return int(((token != UNDECIDED) & ~self._is_split(token)).sum())

    def _is_split(self, token: NDArray[np.uint8]) -> NDArray[np.bool_]:
        return (token >= SPLIT) & (token < SPLIT + len(self.box))

    @property
    def undecided(self) -> Fraction:
        """Exact part of the box."""
        depths = np.bincount(self._depth[: self.nodes][self._token[: self.nodes] == UNDECIDED])
        return sum((Fraction(int(count), 1 << depth) for depth, count in enumerate(depths)), Fraction(0))

    def in_order(self) -> bytes:
        """Tokens in pre-order, lower half first."""
        token, below, depth = self._token[: self.nodes], self._below, self._depth[: self.nodes]
        size, place = np.ones(self.nodes, dtype=np.int64), np.zeros(self.nodes, dtype=np.int64)
        split = self._is_split(token)
        levels = [np.flatnonzero(split & (depth == k)) for k in range(int(depth.max()) + 1)]
        for name in levels[::-1]:
            size[name] += size[below[name]] + size[below[name] + 1]
        for name in levels:
            place[below[name]] = place[name] + 1
            place[below[name] + 1] = place[name] + 1 + size[below[name]]
        ordered = np.zeros(self.nodes, dtype=np.uint8)
        ordered[place] = token
        return ordered.tobytes()


def need_room(test: Test, box: Array, halvings: int, seed: int, advice: str) -> None:
    """Refuse what would take more boxes than a certificate may have: by paths from the whole to where points are decided.

    As many boxes as 2 to the halvings of a path fill the whole; the median counts.

    Raises:
        InputError: With the estimate, and with the advice.
    """
    rng = np.random.default_rng([seed, _PATHS])
    middle, half = np.tile(box.mean(axis=1), (_PATHS, 1)), np.tile(np.diff(box)[:, 0] / 2, (_PATHS, 1))
    depth, left = np.zeros(middle.shape, dtype=np.int64), np.arange(_PATHS)
    while left.size > _PATHS // 2 and depth.sum(axis=1).max() < _FAR:
        found, gain = test(middle[left], half[left])
        gain = np.where((depth[left] < halvings) & (half[left] > 0), np.nan_to_num(gain, nan=0.0), -1.0)
        split = (found == OPEN) & (gain.max(axis=1) > 0)
        left, axis = left[split], gain[split].argmax(axis=1)
        depth[left, axis] += 1
        half[left, axis] /= 2
        middle[left, axis] += half[left, axis] * rng.choice([-1.0, 1.0], len(left))
    typical = float(np.median(depth.sum(axis=1)))
    if 2**typical > MOST_LEAVES:
        more = " or more" if typical >= _FAR else ""
        raise InputError(
            f"single boxes decide so little of this that it would take some {2**typical:.0e} boxes{more}; {advice}"
        )
