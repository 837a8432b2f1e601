"""Where a failed arm may end: configurations of the goal, and the rows to give up if there is none."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.converge.recover_route import Metric, Space
from holdfast.converge.recover_rows import RowSolver, preferred, subsets

Array = NDArray[np.float64]

_MOST = 48  # configurations of a goal that are kept, the nearest ones
_SLIDES = 25
_SAME = 1e-4  # rad and m
_STARTS_PER_SET = 96


@dataclass(frozen=True)
class RowsGivenUp:
    """Rows without which the rest of the goal is met, none of which can be kept beside the others.

    Attributes:
        names: As people call them: ``about tool z``, ``x``, or a joint.
        misses: (k,) by how much each misses, absolute, m or rad: at the configurations found at which their norm is least.
        units: ``m`` or ``rad`` of each.
    """

    names: tuple[str, ...]
    misses: tuple[float, ...]
    units: tuple[str, ...]

    def __str__(self) -> str:
        parts = [
            f"{name} by {miss:.4g} m" if unit == "m" else f"{name} by {np.rad2deg(miss):.4g} deg"
            for name, miss, unit in zip(self.names, self.misses, self.units, strict=True)
        ]
        return ", ".join(parts)

    def __add__(self, other: RowsGivenUp) -> RowsGivenUp:
        return RowsGivenUp(self.names + other.names, self.misses + other.misses, self.units + other.units)


@dataclass(frozen=True)
class Relaxed:
    """A set of rows to give up and configurations (K, n) that meet the others."""

    rows: RowsGivenUp
    q: Array


def configurations_of(
    solver: RowSolver, space: Space, metric: Metric, pose: Array, at: Array, starts: int, rng: np.random.Generator
) -> Array:
    """Configurations (K, n) that meet every row of a pose (4, 4), those on the way from ``at`` first; maybe none.

    From random starts and from ``at``; each is then moved along the self-motion of the pose towards ``at``.
    """
    begin = np.concatenate([at[None], solver.starts(starts, at, space.free, rng)])
    poses = np.repeat(pose[None], len(begin), axis=0)
    kept = np.ones((len(begin), solver.rows.m))
    q = solver.run(begin, poses, kept, space.free)
    q = q[_good(solver, space, q, poses, kept)]
    q = at + space.difference(q, at)
    moving = np.arange(len(q))
    for _ in range(_SLIDES):
        some = q[moving]
        trial = solver.run(some + 0.3 * space.difference(at, some), poses[moving], kept[moving], space.free, 20)
        nearer = metric.length(trial - at) < metric.length(some - at) * (1 - 1e-6)
        nearer &= _good(solver, space, trial, poses[moving], kept[moving])
        q[moving[nearer]] = trial[nearer]
        moving = moving[nearer]
        if not moving.size:
            break
    return _distinct(q[np.argsort(metric.length(q - at), kind="stable")])


def _good(solver: RowSolver, space: Space, q: Array, poses: Array, kept: Array) -> NDArray[np.bool_]:
    good = solver.meets(q, poses, kept, space.free)
    some = np.flatnonzero(good)
    good[some] = space.clear(q[some])
    return good


def _distinct(q: Array) -> Array:
    """The first of configurations that are the same, the nearest ones only."""
    keep: list[int] = []
    for k in range(len(q)):
        if all(np.abs(q[k] - q[i]).max() > _SAME for i in keep):
            keep.append(k)
        if len(keep) == _MOST:
            break
    return q[keep]


def rows_to_give_up(
    solver: RowSolver, space: Space, metric: Metric, pose: Array, at: Array, rng: np.random.Generator
) -> list[Relaxed]:
    """Every minimal set of rows without which a pose is met, as far as found: few rows first, turns before positions."""
    rows, found, minimal = solver.rows, [], list[tuple[int, ...]]()
    for size in range(1, rows.m):
        sets = subsets(rows.m, size, minimal)
        if not sets:
            break
        begin = np.concatenate([at[None], solver.starts(_STARTS_PER_SET - 1, at, space.free, rng)])
        owner = np.repeat(np.arange(len(sets)), len(begin))
        kept = np.ones((len(sets), rows.m))
        for one, given_up in zip(kept, sets, strict=True):
            one[list(given_up)] = 0.0
        poses = np.repeat(pose[None], len(owner), axis=0)
        q = solver.nearest(np.tile(begin, (len(sets), 1)), poses, kept[owner], space.free)
        good = _good(solver, space, q, poses, kept[owner])
        missed = np.linalg.norm(solver.errors(q, poses), axis=1)
        for k, given_up in enumerate(sets):
            some = np.flatnonzero(good & (owner == k))
            if not some.size:
                continue
            minimal.append(given_up)
            least = missed[some].min()
            some = some[missed[some] <= least * (1 + 1e-3) + 1e-6]
            ends = at + space.difference(q[some], at)
            ends = _distinct(ends[np.argsort(metric.length(ends - at), kind="stable")])
            error = np.abs(solver.errors(q[some[:1]], poses[:1])[0, list(given_up)])
            names, units = ([x[i] for i in given_up] for x in (rows.names, rows.units))
            found.append((given_up, Relaxed(RowsGivenUp(tuple(names), tuple(error.tolist()), tuple(units)), ends)))
    found.sort(key=lambda x: (*preferred(rows, x[0]), float(np.linalg.norm(x[1].rows.misses))))
    return [relaxed for _, relaxed in found]
