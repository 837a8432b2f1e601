"""Measures of performance of recorded trials, M1 to M12, and the combined performance measure CPM.

The table of the source is lost, and the twelve measures are a reconstruction from its text. All are "larger is worse". All but
M12, the operator's own rating, are computed from the recorded trial alone, so that they exist for the computer too.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (11) for CPM; the measures are reconstructed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.teleop.trials.recordings import Trials


@dataclass(frozen=True)
class Measure:
    """Measure of performance of a trial.

    Attributes:
        name: Name, M1 to M12.
        about: Name of the measured quantity.
        unit: Unit of the stored value.
    """

    name: str
    about: str
    unit: str


PERFORMANCE_MEASURES = (
    Measure("M1", "completion time", "cycle"),
    Measure("M2", "path length", "m"),
    Measure("M3", "peak path deviation", "m"),
    Measure("M4", "mean path deviation", "m"),
    Measure("M5", "retreat", "m"),
    Measure("M6", "joint travel", "rad"),
    Measure("M7", "mean velocity error", "1"),
    Measure("M8", "peak velocity error", "1"),
    Measure("M9", "mean direction error", "rad"),
    Measure("M10", "peak direction error", "rad"),
    Measure("M11", "command variation", "m/cycle"),
    Measure("M12", "subjective operator assessment", "1"),
)
RECORDED_MEASURES = 11  # number of measures without the rating
_MIN_SPEED_FRACTION = 1e-12  # of the command: a slower end effector has no direction


def compute_measures(trials: Trials) -> FloatArray:
    """Compute the measures M1 to M11 of each trial.

    v is the commanded velocity, a the actual velocity at the beginning of a cycle, x the position, and the segment is the
    straight line from the start to the target:

    * M1 number of cycles; M2 length of the polygon through all x; M3, M4 largest and mean distance of x from the segment;
      M5 sum of all increases of the distance to the target; M6 sum of all changes of all joints (rad, and m for prismatic
      joints);
    * M7, M8 mean and largest ``|v - a| / |v|`` over the cycles with a command; M9, M10 mean and largest angle between v and a
      over those in which the end effector moved as well; M11 sum of the changes of v.

      over those in which the end effector moved as well; M11 sum of the changes of v.

    Means over no cycle are 0.

    Args:
        trials: N recorded trials.

    Returns:
        (N, 11). NaN in the rows of trials that did not reach it, as their time, path and errors are cut off, not performed.

    Source: reconstruction of the lost table of Goel et al. 2003.
    """
    count, first, trial_of_cycle = len(trials), trials.first[:-1], trials.of_cycle()
    cycle_counts = trials.cycles
    result = np.zeros((count, RECORDED_MEASURES))
    started = np.flatnonzero(cycle_counts > 0)

    def sum_by_trial(values: FloatArray) -> FloatArray:
        return np.asarray(np.bincount(trial_of_cycle, weights=values, minlength=count), dtype=np.float64)

    def max_by_trial(values: FloatArray) -> FloatArray:
        maxima = np.zeros(count)
        if started.size:
            maxima[started] = np.maximum.reduceat(values, first[started])
        return maxima

    def shift_by_cycle(values: FloatArray, end: FloatArray) -> FloatArray:
        """Return the same quantity one cycle later."""
        shifted = np.empty_like(values)
        shifted[:-1] = values[1:]
        shifted[first[started] + cycle_counts[started] - 1] = end[started]
        return shifted

    x, x_after = trials.x, shift_by_cycle(trials.x, trials.x_end)
    start, target = trials.start(), trials.target
    deviation = _distance_to_segment(x, start[trial_of_cycle], target[trial_of_cycle])
    deviation_end = _distance_to_segment(trials.x_end, start, target)
    distance_change = np.linalg.norm(x_after - target[trial_of_cycle], axis=1) - np.linalg.norm(
        x - target[trial_of_cycle], axis=1
    )
    result[:, 0] = cycle_counts
    result[:, 1] = sum_by_trial(np.linalg.norm(x_after - x, axis=1))
    result[:, 2] = np.maximum(max_by_trial(deviation), deviation_end)
    result[:, 3] = (sum_by_trial(deviation) + deviation_end) / (cycle_counts + 1)
    result[:, 4] = sum_by_trial(np.maximum(distance_change, 0.0))
    result[:, 5] = sum_by_trial(np.abs(shift_by_cycle(trials.q, trials.q_end) - trials.q).sum(axis=1))

    v, a = trials.velocity, trials.actual
    speed, actual_speed = np.linalg.norm(v, axis=1), np.linalg.norm(a, axis=1)
    commanded = speed > 0
    has_moved = commanded & (actual_speed > _MIN_SPEED_FRACTION * speed)
    with np.errstate(divide="ignore", invalid="ignore"):
        error = np.where(commanded, np.linalg.norm(v - a, axis=1) / speed, 0.0)
        direction, actual_direction = v / speed[:, None], a / actual_speed[:, None]
        # Exact also for small angles and for those close to pi, unlike the arc cosine.
        difference_norm = np.linalg.norm(direction - actual_direction, axis=1)
        sum_norm = np.linalg.norm(direction + actual_direction, axis=1)
        angle = np.where(has_moved, 2 * np.arctan2(difference_norm, sum_norm), 0.0)
    result[:, 6] = sum_by_trial(error) / np.maximum(sum_by_trial(commanded.astype(float)), 1)
    result[:, 7] = max_by_trial(error)
    result[:, 8] = sum_by_trial(angle) / np.maximum(sum_by_trial(has_moved.astype(float)), 1)
    result[:, 9] = max_by_trial(angle)
    change = np.zeros(len(v))
    if len(v):
        change[:-1] = np.linalg.norm(np.diff(v, axis=0), axis=1)
        change[first[started] + cycle_counts[started] - 1] = 0.0
    result[:, 10] = sum_by_trial(change)
    result[~trials.is_completed] = np.nan
    return result


@dataclass(frozen=True, eq=False)
class CPM:
    """Combined performance measures with their normalisers.

    Attributes:
        values: CPM of each trial, in the shape of the trials; NaN where a measure is.
        normalisers: (k,) the largest value of each measure over all trials compared.
    """

    values: FloatArray
    normalisers: FloatArray


def compute_cpm(values: ArrayLike, normalisers: ArrayLike | None = None) -> CPM:
    """Compute the combined performance measure (11): the sum of all measures, each divided by its largest value.

    One extreme trial sets a normaliser, and with it the level of all CPM: compare ratios and raw measures, not levels of
    different sets.

    Args:
        values: (..., k) measures: eleven without, twelve with the operator's rating. Trials that did not reach it are NaN.
        normalisers: (k,) to use in place of the largest values, to put other trials on the same scale.

    Returns:
        A :class:`holdfast.teleop.CPM`.

    Raises:
        InputError: Negative measures, or another number of normalisers than of measures.

    Source: Goel et al. 2003, eq. (11); a term whose largest value is 0 is 0.
    """
    measured = np.asarray(values, dtype=np.float64)
    if measured.ndim < 1 or (measured.size and np.nanmin(measured, initial=0.0) < 0):
        raise InputError("measures must be a list of numbers of 0 or more, a row for each trial")
    by_trial = measured.reshape(-1, measured.shape[-1])
    if normalisers is None:
        largest = (
            np.nanmax(by_trial, axis=0, initial=0.0, where=~np.isnan(by_trial))
            if by_trial.size
            else np.zeros(measured.shape[-1])
        )
    else:
        largest = np.asarray(normalisers, dtype=np.float64)
        if largest.shape != measured.shape[-1:]:
            raise InputError(f"there are {largest.size} normalisers for {measured.shape[-1]} measures; give one for each")
    terms = np.where(largest > 0, measured / np.where(largest > 0, largest, 1.0), np.where(np.isnan(measured), np.nan, 0.0))
    return CPM(terms.sum(axis=-1), np.asarray(largest))


def _distance_to_segment(x: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the (K,) distances of points (K, m) from segments."""
    segment = end - start
    squared_length = np.einsum("ij,ij->i", segment, segment)
    fraction = np.einsum("ij,ij->i", x - start, segment) / np.where(squared_length > 0, squared_length, 1.0)
    return np.asarray(np.linalg.norm(x - start - np.clip(fraction, 0.0, 1.0)[:, None] * segment, axis=1))
