"""Measures of performance of recorded trials, M1 to M12, and the combined performance measure CPM.

The table of the source is lost: the twelve are a reconstruction from its text. All are "larger is worse"; all but M12, the
operator's own rating, are computed from the recorded trial alone, so that they exist for the computer too.

Source: Goel, Maciejewski, Balakrishnan, Proctor 2003, eq. (11) for CPM; the measures are reconstructed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.errors import InputError
from holdfast.teleop.trials.recordings import Trials

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Measure:
    """One measure.

    Attributes:
        name: M1 to M12.
        about: What it is, for people.
        unit: As it is stored.
    """

    name: str
    about: str
    unit: str


MEASURES = (
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
RECORDED = 11  # of them: all but the rating
_STILL = 1e-12  # of the command: below it the end effector has no direction


def measures(trials: Trials) -> Array:
    """M1 to M11 of each trial.

    With the commanded velocity v, its actual velocity a at the beginning of a cycle, its position x, and the straight
    segment from the start to the target:

    * M1 number of cycles; M2 length of the polygon through the x; M3, M4 largest and mean distance of the x from the segment;
      M5 sum of all increases of the distance to the target; M6 sum of all changes of all joints (rad; and m, of prismatic
      joints);
    * M7, M8 mean and largest ``|v - a| / |v|`` over the cycles with a command; M9, M10 mean and largest angle between v and a
      over those in which the end effector moved as well; M11 sum of the changes of v.

    Means over no cycle are 0.

    Args:
        trials: N recorded trials.

    Returns:
        (N, 11). NaN in the rows of trials that did not reach it, as their time, path and errors are cut off, not performed.

    Source: reconstruction of the lost table of Goel et al. 2003.
    """
    count, first, of = len(trials), trials.first[:-1], trials.of_cycle()
    sizes = trials.cycles
    out = np.zeros((count, RECORDED))
    begun = np.flatnonzero(sizes > 0)

    def total(values: Array) -> Array:
        return np.asarray(np.bincount(of, weights=values, minlength=count), dtype=np.float64)

    def largest(values: Array) -> Array:
        found = np.zeros(count)
        if begun.size:
            found[begun] = np.maximum.reduceat(values, first[begun])
        return found

    def after(here: Array, end: Array) -> Array:
        """The same quantity one cycle later."""
        later = np.empty_like(here)
        later[:-1] = here[1:]
        later[first[begun] + sizes[begun] - 1] = end[begun]
        return later

    x, x_after = trials.x, after(trials.x, trials.x_end)
    start, target = trials.start(), trials.target
    aside, aside_end = _distance(x, start[of], target[of]), _distance(trials.x_end, start, target)
    away = np.linalg.norm(x_after - target[of], axis=1) - np.linalg.norm(x - target[of], axis=1)
    out[:, 0] = sizes
    out[:, 1] = total(np.linalg.norm(x_after - x, axis=1))
    out[:, 2] = np.maximum(largest(aside), aside_end)
    out[:, 3] = (total(aside) + aside_end) / (sizes + 1)
    out[:, 4] = total(np.maximum(away, 0.0))
    out[:, 5] = total(np.abs(after(trials.q, trials.q_end) - trials.q).sum(axis=1))

    v, a = trials.velocity, trials.actual
    speed, done = np.linalg.norm(v, axis=1), np.linalg.norm(a, axis=1)
    commanded = speed > 0
    moved = commanded & (done > _STILL * speed)
    with np.errstate(divide="ignore", invalid="ignore"):
        error = np.where(commanded, np.linalg.norm(v - a, axis=1) / speed, 0.0)
        unit, done_unit = v / speed[:, None], a / done[:, None]
        # Exact also for small angles and for those close to pi, unlike the arc cosine.
        apart, along = np.linalg.norm(unit - done_unit, axis=1), np.linalg.norm(unit + done_unit, axis=1)
        angle = np.where(moved, 2 * np.arctan2(apart, along), 0.0)
    out[:, 6] = total(error) / np.maximum(total(commanded.astype(float)), 1)
    out[:, 7] = largest(error)
    out[:, 8] = total(angle) / np.maximum(total(moved.astype(float)), 1)
    out[:, 9] = largest(angle)
    change = np.zeros(len(v))
    if len(v):
        change[:-1] = np.linalg.norm(np.diff(v, axis=0), axis=1)
        change[first[begun] + sizes[begun] - 1] = 0.0
    out[:, 10] = total(change)
    out[~trials.completed] = np.nan
    return out


@dataclass(frozen=True, eq=False)
class CPM:
    """Combined performance measures with the normalisers they were made with.

    Attributes:
        values: CPM of each trial, in the shape of the trials; NaN where a measure is.
        normalisers: (k,) the largest value of each measure over all trials compared.
    """

    values: Array
    normalisers: Array


def cpm(values: ArrayLike, normalisers: ArrayLike | None = None) -> CPM:
    """The combined performance measure (11): the sum of all measures, each divided by its largest value.

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
    m = np.asarray(values, dtype=np.float64)
    if m.ndim < 1 or (m.size and np.nanmin(m, initial=0.0) < 0):
        raise InputError("measures must be a list of numbers of 0 or more, a row for each trial")
    flat = m.reshape(-1, m.shape[-1])
    if normalisers is None:
        largest = np.nanmax(flat, axis=0, initial=0.0, where=~np.isnan(flat)) if flat.size else np.zeros(m.shape[-1])
    else:
        largest = np.asarray(normalisers, dtype=np.float64)
        if largest.shape != m.shape[-1:]:
            raise InputError(f"there are {largest.size} normalisers for {m.shape[-1]} measures; give one for each")
    terms = np.where(largest > 0, m / np.where(largest > 0, largest, 1.0), np.where(np.isnan(m), np.nan, 0.0))
    return CPM(terms.sum(axis=-1), np.asarray(largest))


def _distance(x: Array, start: Array, end: Array) -> Array:
    """(K,) distances of points (K, m) from segments."""
    along = end - start
    size = np.einsum("ij,ij->i", along, along)
    fraction = np.einsum("ij,ij->i", x - start, along) / np.where(size > 0, size, 1.0)
    return np.asarray(np.linalg.norm(x - start - np.clip(fraction, 0.0, 1.0)[:, None] * along, axis=1))
