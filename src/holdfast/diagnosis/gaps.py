"""Where a record holds numbers: lines are drawn over short gaps, and in long ones nothing was looked at."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.diagnosis.observer import BAND, low_passed
from holdfast.errors import InputError
from holdfast.faults.log import Log

Array = NDArray[np.float64]

STALE = 0.050  # s without a number; over shorter gaps lines are drawn


@dataclass(frozen=True, eq=False)
class Stretch:
    """Rows of a record without a long gap, R of them; lines are drawn over short ones."""

    rows: slice
    q: Array  # (R, n) rad and m
    tau: Array | None  # (R, n) N m and N
    settling: int  # rows until residuals begin: but for the first stretch it begins in the midst of motion


def cycles(seconds: float, dt: float) -> int:
    """So many cycles, at least one."""
    return max(1, round(seconds / dt))


def seen(log: Log) -> NDArray[np.bool_]:
    """(T,) rows whose joints have all of their numbers.

    Raises:
        InputError: There are none.
    """
    parts = [part for part in (log.q, log.q_ref, log.tau) if part is not None]
    there = np.all([np.isfinite(part).all(axis=1) for part in parts], axis=0)
    if not there.any():
        raise InputError("no row of the record has all numbers of the joints; leave a signal out that is never there")
    return np.asarray(there)


def stretches(log: Log, there: NDArray[np.bool_]) -> Iterator[Stretch]:
    """The parts of a record between its long gaps; ``there`` are the rows of :func:`seen`."""
    dt, rows = 1 / log.rate, np.flatnonzero(there)
    longest = cycles(STALE, dt)
    for k, part in enumerate(np.split(rows, np.flatnonzero(np.diff(rows) > longest + 1) + 1)):
        whole = slice(int(part[0]), int(part[-1]) + 1)
        every = np.arange(whole.start, whole.stop)
        q = np.stack([np.interp(every, part, column) for column in log.q[part].T], axis=1)
        tau = None if log.tau is None else _held(log.tau[whole], there[whole], dt)
        yield Stretch(whole, q, tau, settling=longest + 2 if k else 1)


def _held(tau: Array, there: NDArray[np.bool_], dt: float) -> Array:
    """Torques that leave their filter as it was in gaps; where they are known all along one, they count by their mean."""
    whole, level, last = tau.copy(), tau[0], 0
    edges = np.flatnonzero(np.diff(there)) + 1
    for start, stop in zip(edges[::2], edges[1::2], strict=True):
        level = low_passed(whole[last:start], dt, BAND, level)[-1]
        missing = whole[start:stop]
        whole[start:stop] = missing.mean(axis=0) if np.isfinite(missing).all() else level
        last = start
    return whole
