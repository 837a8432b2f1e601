"""Gaps in a log: short ones are interpolated linearly, and long ones are not monitored."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.response.diagnosis.observer import FILTER_BANDWIDTH_RAD_S, low_pass
from holdfast.response.faults.log import Log

MAX_BRIDGED_GAP_S = 0.050  # longest gap without a value, s, that is interpolated


@dataclass(frozen=True, eq=False)
class LogSegment:
    """R rows of a log without a long gap; short gaps are interpolated linearly."""

    rows: slice
    q: FloatArray  # (R, n) rad and m
    tau: FloatArray | None  # (R, n) N m and N
    settling: int  # rows until residuals begin; every segment but the first one begins while the arm moves


def count_cycles(seconds: float, dt: float) -> int:
    """Return the number of cycles of ``dt`` s in a time in s, at least one."""
    return max(1, round(seconds / dt))


def complete_row_mask(log: Log) -> NDArray[np.bool_]:
    """Return the mask (T,) of the rows in which all joint signals have numbers, or raise an error if there are none."""
    parts = [part for part in (log.q, log.q_ref, log.tau) if part is not None]
    is_complete = np.all([np.isfinite(part).all(axis=1) for part in parts], axis=0)
    if not is_complete.any():
        raise InputError("the log has no row in which every joint signal has a value; leave out a signal that is never there")
    return np.asarray(is_complete)


def split_at_gaps(log: Log, is_complete: NDArray[np.bool_]) -> Iterator[LogSegment]:
    """Yield the segments of a log between its long gaps; ``is_complete`` is the mask of :func:`complete_row_mask`."""
    period, rows = 1 / log.rate, np.flatnonzero(is_complete)
    max_gap = count_cycles(MAX_BRIDGED_GAP_S, period)
    for index, segment_rows in enumerate(np.split(rows, np.flatnonzero(np.diff(rows) > max_gap + 1) + 1)):
        row_range = slice(int(segment_rows[0]), int(segment_rows[-1]) + 1)
        all_rows = np.arange(row_range.start, row_range.stop)
        q = np.stack([np.interp(all_rows, segment_rows, column) for column in log.q[segment_rows].T], axis=1)
        tau = None if log.tau is None else _fill_torque_gaps(log.tau[row_range], is_complete[row_range], period)
        yield LogSegment(row_range, q, tau, settling=max_gap + 2 if index else 1)


def _fill_torque_gaps(tau: FloatArray, is_known: NDArray[np.bool_], dt: float) -> FloatArray:
    """Fill gaps in torques with the state of their filter, or with their mean over gaps in which all torques are known."""
    filled, filter_state, filtered_to = tau.copy(), tau[0], 0
    edges = np.flatnonzero(np.diff(is_known)) + 1
    for start, stop in zip(edges[::2], edges[1::2], strict=True):
        filter_state = low_pass(filled[filtered_to:start], dt, FILTER_BANDWIDTH_RAD_S, filter_state)[-1]
        missing = filled[start:stop]
        filled[start:stop] = missing.mean(axis=0) if np.isfinite(missing).all() else filter_state
        filtered_to = start
    return filled
