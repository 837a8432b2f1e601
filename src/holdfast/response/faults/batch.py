"""Episodes of faults as arrays, for simulators that run many at once and for reports."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.result import Result
from holdfast.core.typing import FloatArray
from holdfast.response.faults.events import FaultEvents
from holdfast.response.faults.kind import MAX_PARAMETERS, find_kind


@dataclass(frozen=True, eq=False, kw_only=True)
class FaultBatch(Result):
    """Faults of N episodes, at most one for each of the n joints in an episode: the first.

    Attributes:
        joints: Names of the n joints.
        seed: Of the draws.
        first: Number of the first episode.
        episodes: The faults of each, all of them.
        kind: (N, n) index into ``holdfast.response.faults.KINDS``, -1 where the joint has no fault.
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
    onset: FloatArray
    end: FloatArray
    parameter: FloatArray
    left_out: int

    def __len__(self) -> int:
        return len(self.episodes)

    def times_of(self, joints: Sequence[str]) -> FloatArray:
        """Return the times (N, n) at which these joints lock, s: an episode for each run of :func:`holdfast.simulate`.

        Raises:
            InputError: See :meth:`holdfast.response.faults.FaultEvents.times_of`.
        """
        return np.array([events.times_of(joints) for events in self.episodes])


def make_batch(joints: tuple[str, ...], episodes: Sequence[FaultEvents], *, seed: int, first: int) -> FaultBatch:
    """Return the faults of episodes as arrays."""
    shape = len(episodes), len(joints)
    kinds, onsets, ends = np.full(shape, -1), np.full(shape, np.inf), np.full(shape, np.inf)
    parameters, omitted_count = np.full((*shape, MAX_PARAMETERS), np.nan), 0
    for row, events in enumerate(episodes):
        for event in events:
            column = joints.index(event.joint)
            if kinds[row, column] >= 0:
                omitted_count += 1
                continue
            kind = find_kind(event.kind)
            kinds[row, column], onsets[row, column], ends[row, column] = kind.code, event.onset, event.end
            parameter_names = list(kind.parameters_by_name)
            for name, value in event.parameters.items():
                if not isinstance(value, str):
                    parameters[row, column, parameter_names.index(name)] = value
    arrays: dict[str, Any] = {"kind": kinds, "onset": onsets, "end": ends, "parameter": parameters}
    return FaultBatch(joints=joints, seed=seed, first=first, episodes=tuple(episodes), left_out=omitted_count, **arrays)
