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
    """Faults of N episodes as arrays, with at most one fault per joint and episode: the first.

    Attributes:
        joints: Names of the n joints.
        seed: Seed of all random numbers.
        first: Index of the first episode.
        episodes: All faults of each episode, including those that are not in the arrays.
        kind: (N, n) index into ``holdfast.response.faults.KINDS``; -1 where the joint has no fault.
        onset: (N, n) time of the onset, s; infinite without a fault.
        end: (N, n) time of the end, s; infinite for a permanent fault or without a fault.
        parameter: (N, n, 3) parameters of the kind in the order of its function's arguments; NaN where there is none.
        left_out: Number of faults that are not in the arrays, because the joint had an earlier one.
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
        """Return the lock times (N, n) of these joints, s, one row per run of :func:`holdfast.simulate`.

        Args:
            joints: Names of the n joints, in the order of the columns.

        Raises:
            InputError: The faults are not locks; see :meth:`holdfast.response.faults.FaultEvents.times_of`.
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
