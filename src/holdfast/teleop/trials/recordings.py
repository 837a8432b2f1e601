"""Recorded trials: the commands, the motion of the arm, and the end of each trial."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.core.status import SentenceEnum
from holdfast.core.typing import FloatArray


class End(SentenceEnum):
    """End of one trial."""

    ARRIVED = 0, "the end effector reached the target circle"
    STILL = 1, "the end effector was still although it was commanded to move"
    TIME = 2, "the cycle limit was reached"
    ABORTED = 3, "the operator gave up"
    BROKEN_OFF = 4, "the recording stops before the end of the trial"


@dataclass(frozen=True, eq=False, kw_only=True)
class RecordedCycles:
    """Recorded rows of N trials: trial i has rows ``first[i]`` to ``first[i + 1]``, the last of which is its end.

    Attributes:
        time: (R,) time since the trial began, s, by the clock of the operator's device; NaN at the end.
        velocity: (R, m) command in each cycle, after dead zone and limit, m/cycle; NaN at the end.
        q: (R, n) configuration at the beginning of each cycle, and at the end of the trial, rad and m.
        first: (N + 1,) index of the first row of each trial; the last entry is R.
    """

    time: FloatArray
    velocity: FloatArray
    q: FloatArray
    first: NDArray[np.int64]


@dataclass(frozen=True, eq=False, kw_only=True)
class Trials:
    """N recorded trials with C cycles in total: trial i has cycles ``first[i]`` to ``first[i + 1]``.

    Attributes:
        velocity: (C, m) command in each cycle, after dead zone and limit, m/cycle.
        q: (C, n) configuration at the beginning of each cycle, rad and m.
        x: (C, m) tool point at that time, m.
        actual: (C, m) velocity of the tool point at that time, m/cycle.
        first: (N + 1,) index of the first cycle of each trial; the last entry is C.
        q_end: (N, n) configuration at the end of each trial, rad and m.
        x_end: (N, m) tool point at the end of each trial, m.
        target: (N, m) centre of each target circle, m.
        end: (N,) :class:`holdfast.teleop.End`.
    """

    velocity: FloatArray
    q: FloatArray
    x: FloatArray
    actual: FloatArray
    first: NDArray[np.int64]
    q_end: FloatArray
    x_end: FloatArray
    target: FloatArray
    end: NDArray[np.uint8]

    def __len__(self) -> int:
        return len(self.end)

    @property
    def cycles(self) -> NDArray[np.int64]:
        """Number (N,) of cycles of each trial."""
        return np.diff(self.first)

    @property
    def is_completed(self) -> NDArray[np.bool_]:
        """(N,) True where the end effector reached the target circle."""
        return np.asarray(self.end == End.ARRIVED)

    def of_cycle(self) -> NDArray[np.int64]:
        """Return the index (C,) of the trial of each cycle."""
        return np.repeat(np.arange(len(self)), self.cycles)

    def start(self) -> FloatArray:
        """Return the tool point (N, m) at the start, m."""
        has_cycles = self.cycles > 0
        starts = self.x_end.copy()
        starts[has_cycles] = self.x[self.first[:-1][has_cycles]]
        return starts

    def path(self, i: int) -> FloatArray:
        """Return the tool point (K + 1, m) of trial ``i``, by its index, from start to end, m."""
        return np.vstack([self.x[self.first[i] : self.first[i + 1]], self.x_end[i]])

    def configurations(self, i: int) -> FloatArray:
        """Return the configurations (K + 1, n) of trial ``i``, by its index, from start to end, rad and m."""
        return np.vstack([self.q[self.first[i] : self.first[i + 1]], self.q_end[i]])

    def take(self, rows: Sequence[int] | NDArray[np.int64]) -> Trials:
        """Return the trials with indices ``rows`` (K,), in this order."""
        chosen = np.asarray(rows, dtype=np.int64)
        cycle_counts = self.cycles[chosen]
        first = np.concatenate([[0], np.cumsum(cycle_counts)])
        cycles = np.repeat(self.first[chosen] - first[:-1], cycle_counts) + np.arange(first[-1])
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
    def concatenate(parts: Sequence[Trials]) -> Trials:
        """Return the trials of all ``parts``, one after the other."""
        starts = np.cumsum([0, *(len(part.velocity) for part in parts)])
        first = np.concatenate([*(part.first[:-1] + start for part, start in zip(parts, starts, strict=False)), starts[-1:]])
        names = ("velocity", "q", "x", "actual", "q_end", "x_end", "target", "end")
        arrays = {name: np.concatenate([getattr(part, name) for part in parts]) for name in names}
        return Trials(first=first, **arrays)
