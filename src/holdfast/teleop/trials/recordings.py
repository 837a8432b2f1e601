"""Recorded trials: what was commanded, where the arm was, and how each trial ended."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class End(IntEnum):
    """How one trial ended."""

    ARRIVED = 0
    STILL = 1
    TIME = 2
    ABORTED = 3
    BROKEN_OFF = 4

    @property
    def sentence(self) -> str:
        """What it means, for people."""
        return _SENTENCES[self]


_SENTENCES = {
    End.ARRIVED: "the end effector reached the target circle",
    End.STILL: "the end effector was still although it was commanded to move",
    End.TIME: "the cycles allowed were over",
    End.ABORTED: "the operator gave up",
    End.BROKEN_OFF: "the recording stops before the trial was over",
}


@dataclass(frozen=True, eq=False, kw_only=True)
class RecordedCycles:
    """Rows of N trials as they are in the records, trial i's at ``first[i]`` to ``first[i + 1]``, the last of them its end.

    Attributes:
        time: (R,) s since the trial began, by the clock of who held the stick; NaN at the end.
        velocity: (R, m) commanded in each cycle, after dead zone and limit, m/cycle; NaN at the end.
        q: (R, n) configuration when the cycle began, and when the trial ended, rad and m.
        first: (N + 1,) where each trial begins; the last entry is R.
    """

    time: Array
    velocity: Array
    q: Array
    first: NDArray[np.int64]


@dataclass(frozen=True, eq=False, kw_only=True)
class Trials:
    """N recorded trials; their C cycles lie one after the other, trial i's at ``first[i]`` to ``first[i + 1]``.

    Attributes:
        velocity: (C, m) commanded in each cycle, after dead zone and limit, m/cycle.
        q: (C, n) configuration when the cycle began, rad and m.
        x: (C, m) tool point then, m.
        actual: (C, m) the tool point's velocity then, m/cycle.
        first: (N + 1,) where each trial begins; the last entry is C.
        q_end: (N, n) configuration when the trial ended.
        x_end: (N, m) tool point then.
        target: (N, m) centre of the target circle, m.
        end: (N,) :class:`holdfast.teleop.End`.
    """

    velocity: Array
    q: Array
    x: Array
    actual: Array
    first: NDArray[np.int64]
    q_end: Array
    x_end: Array
    target: Array
    end: NDArray[np.uint8]

    def __len__(self) -> int:
        return len(self.end)

    @property
    def cycles(self) -> NDArray[np.int64]:
        """(N,) number of cycles of each trial."""
        return np.diff(self.first)

    @property
    def completed(self) -> NDArray[np.bool_]:
        """(N,) True where the end effector reached the target circle."""
        return np.asarray(self.end == End.ARRIVED)

    def of_cycle(self) -> NDArray[np.int64]:
        """(C,) which trial each cycle belongs to."""
        return np.repeat(np.arange(len(self)), self.cycles)

    def start(self) -> Array:
        """(N, m) tool point at the start, m."""
        begun = self.cycles > 0
        out = self.x_end.copy()
        out[begun] = self.x[self.first[:-1][begun]]
        return out

    def path(self, i: int) -> Array:
        """(K + 1, m) the tool point of trial i, from start to end, m."""
        return np.vstack([self.x[self.first[i] : self.first[i + 1]], self.x_end[i]])

    def configurations(self, i: int) -> Array:
        """(K + 1, n) the configurations of trial i, from start to end, rad and m."""
        return np.vstack([self.q[self.first[i] : self.first[i + 1]], self.q_end[i]])

    def take(self, rows: Sequence[int] | NDArray[np.int64]) -> Trials:
        """Some of the trials, in the order given."""
        chosen = np.asarray(rows, dtype=np.int64)
        sizes = self.cycles[chosen]
        first = np.concatenate([[0], np.cumsum(sizes)])
        cycles = np.repeat(self.first[chosen] - first[:-1], sizes) + np.arange(first[-1])
        return Trials(
            velocity=self.velocity[cycles],
            q=self.q[cycles],
            x=self.x[cycles],
            actual=self.actual[cycles],
            first=first,
            q_end=self.q_end[chosen],
            x_end=self.x_end[chosen],
            target=self.target[chosen],
            end=self.end[chosen],
        )

    @staticmethod
    def joined(parts: Sequence[Trials]) -> Trials:
        """The trials of several sets, one set after the other."""
        starts = np.cumsum([0, *(len(p.velocity) for p in parts)])
        first = np.concatenate([*(p.first[:-1] + s for p, s in zip(parts, starts, strict=False)), starts[-1:]])
        names = ("velocity", "q", "x", "actual", "q_end", "x_end", "target", "end")
        arrays = {name: np.concatenate([getattr(p, name) for p in parts]) for name in names}
        return Trials(first=first, **arrays)
