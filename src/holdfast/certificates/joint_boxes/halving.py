"""Boxes halved until each is decided, many at once: a bisection tree as certificates write it."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.tree import SPLIT, UNDECIDED
from holdfast.certificates.verified.tree import MOST_LEAVES
from holdfast.errors import InputError

Array = NDArray[np.float64]
Index = NDArray[np.int64]
Test = Callable[[Array, Array], tuple[Index, Array]]

OPEN = -1  # what is not decided yet
LEFT = 1  # token of what others look at
_AT_ONCE = 4096
_PATHS, _FAR = 101, 60  # for an estimate; halvings after which nobody asks


class Halving:
    """The halving of boxes.

    Args:
        box: (A, 2), low and high along each axis, of the whole.
        halvings: Of each axis, at most.
        boxes: Middles (N, A) and how often each axis was halved (N, A), of those to begin with; None: the whole.

    Attributes:
        tested: Boxes that were looked at.
        proved, undecided: Parts of the whole.
    """

    def __init__(self, box: Array, halvings: int, boxes: tuple[Array, Index] | None = None) -> None:
        self.box, self.halvings = box, halvings
        self.width = box[:, 1] - box[:, 0]
        middle, depth = boxes or (box.mean(axis=1)[None], np.zeros((1, len(box)), dtype=np.int64))
        self._roots = self.nodes = len(middle)
        room = 1 << 10 + self.nodes.bit_length()
        self._token, self._below = np.full(room, UNDECIDED, dtype=np.uint8), np.zeros(room, dtype=np.int64)
        self._level = np.zeros(room, dtype=np.int64)
        self._waiting = [(np.arange(self.nodes), middle, depth)]
        self.tested, self.proved, self.undecided = 0, 0.0, 0.0

    def run(
        self,
        test: Test,
        until: float = np.inf,
        stop: Callable[[], bool] = lambda: False,
        tell: Callable[[], None] = lambda: None,
        most: int = 1 << 24,
    ) -> bool:
        """Halve until all is decided, a time (``monotonic``) or ``stop`` comes, or so many nodes are made: then False.

        The test takes middles and half widths (N, A) and gives a token or OPEN for each (N,), and what halving each axis would
        gain (N, A). ``tell`` is called after each step. May be called again.
        """
        while self._waiting:
            if monotonic() > until or stop() or self.nodes > most:
                return False
            name, middle, depth = self._waiting.pop()
            if len(name) > _AT_ONCE:
                self._waiting.append((name[_AT_ONCE:], middle[_AT_ONCE:], depth[_AT_ONCE:]))
                name, middle, depth = name[:_AT_ONCE], middle[:_AT_ONCE], depth[:_AT_ONCE]
            half = self.width * 0.5 ** (depth + 1)
            self.tested += len(name)
            found, gain = test(middle, half)
            done = found != OPEN
            self._token[name[done]] = found[done]
            gain = np.where((depth < self.halvings) & (half > 0), np.nan_to_num(gain, nan=0.0), -1.0)
            split = ~done & (gain.max(axis=1) > 0)
            share = 0.5 ** depth.sum(axis=1)
            self.proved += float(share[done].sum())
            self.undecided += float(share[~done & ~split].sum())
            if split.any():
                parts = self._split(name[split], middle[split], depth[split], half[split], gain[split].argmax(axis=1))
                self._waiting.append(parts)
            tell()
        return True

    def _split(self, name: Index, middle: Array, depth: Index, half: Array, axis: Index) -> tuple[Index, Array, Index]:
        """The halves."""
        count = len(name)
        while self.nodes + 2 * count > len(self._token):
            for key in ("_token", "_below", "_level"):
                old = getattr(self, key)
                setattr(self, key, np.concatenate([old, np.full_like(old, UNDECIDED if key == "_token" else 0)]))
        below = self.nodes + 2 * np.arange(count)
        self._token[name], self._below[name] = SPLIT + axis, below
        self.nodes += 2 * count
        names, rows = np.repeat(below, 2) + np.arange(2 * count) % 2, np.arange(2 * count)
        self._level[names] = np.repeat(self._level[name], 2) + 1
        middles, depths, axes = np.repeat(middle, 2, axis=0), np.repeat(depth, 2, axis=0), np.repeat(axis, 2)
        depths[rows, axes] += 1
        middles[rows, axes] += np.where(rows % 2, 0.5, -0.5) * np.repeat(half, 2, axis=0)[rows, axes]
        return names, middles, depths

    def in_order(self) -> bytes:
        """Tokens of each tree in pre-order, lower half first; what waits to be looked at is LEFT."""
        token, below, level = self._token[: self.nodes].copy(), self._below, self._level[: self.nodes]
        for name, _, _ in self._waiting:
            token[name] = LEFT
        size, place = np.ones(self.nodes, dtype=np.int64), np.zeros(self.nodes, dtype=np.int64)
        split = (token >= SPLIT) & (token < SPLIT + len(self.box))
        levels = [np.flatnonzero(split & (level == k)) for k in range(int(level.max()) + 1)]
        for name in levels[::-1]:
            size[name] += size[below[name]] + size[below[name] + 1]
        place[1 : self._roots] = np.cumsum(size[: self._roots - 1])
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
