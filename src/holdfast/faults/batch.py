"""Episodes of faults as arrays: for simulators that run many at once, and for people to look at."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.faults.entry import KINDS, PARAMETERS
from holdfast.faults.events import FaultEvents
from holdfast.result import Result

Array = NDArray[np.float64]
_MOST = 3  # parameters of a kind


@dataclass(frozen=True, eq=False, kw_only=True)
class FaultBatch(Result):
    """The faults of N episodes, at most one for each of the n joints in an episode: the first.

    Attributes:
        joints: Names of the n joints.
        seed: Of the draws.
        first: Number of the first episode.
        episodes: The faults of each, all of them.
        kind: (N, n) index into ``holdfast.faults.KINDS``, -1 where the joint has no fault.
        onset: (N, n) s, infinite where there is none.
        end: (N, n) s, infinite where it stays or there is none.
        parameter: (N, n, 3) numbers of the kind in the order of its function's arguments, NaN where there is none.
        left_out: Faults that are not in the arrays, because the joint had one before.
    """

    joints: tuple[str, ...]
    seed: int
    first: int
    episodes: tuple[FaultEvents, ...]
    kind: NDArray[np.int64]
    onset: Array
    end: Array
    parameter: Array
    left_out: int

    def __len__(self) -> int:
        return len(self.episodes)

    def times_of(self, joints: Sequence[str]) -> Array:
        """(N, n) when each of these joints locks, s: an episode for each run of :func:`holdfast.simulate`.

        Raises:
            InputError: See :meth:`holdfast.faults.FaultEvents.times_of`.
        """
        return np.array([events.times_of(joints) for events in self.episodes])

    def describe(self) -> list[str]:
        """How many episodes have how many faults."""
        count = [len(events) for events in self.episodes]
        of = "1 episode" if len(count) == 1 else f"{len(count)} episodes"
        lines = [f"{sum(count)} faults in {of}, seed {self.seed}; {count.count(0)} without any"]
        if self.left_out:
            lines.append(f"{self.left_out} come after another of the same joint, and are not in the arrays")
        return lines


def batch_of(joints: tuple[str, ...], episodes: Sequence[FaultEvents], *, seed: int, first: int) -> FaultBatch:
    """The arrays of some episodes."""
    shape = len(episodes), len(joints)
    kind, onset, end = np.full(shape, -1), np.full(shape, np.inf), np.full(shape, np.inf)
    parameter, left_out = np.full((*shape, _MOST), np.nan), 0
    for e, events in enumerate(episodes):
        for event in events:
            j = joints.index(event.joint)
            if kind[e, j] >= 0:
                left_out += 1
                continue
            kind[e, j], onset[e, j], end[e, j] = KINDS.index(event.kind), event.onset, event.end
            known = [name for names in PARAMETERS.get(event.kind, ()) for name in names]
            for name, value in event.parameters.items():
                if not isinstance(value, str):
                    parameter[e, j, known.index(name)] = value
    arrays: dict[str, Any] = {"kind": kind, "onset": onset, "end": end, "parameter": parameter}
    return FaultBatch(joints=joints, seed=seed, first=first, episodes=tuple(episodes), left_out=left_out, **arrays)
