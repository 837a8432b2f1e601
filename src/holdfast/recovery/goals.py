"""Where a failed arm may end: configurations of the goal, and the rows to give up if there is none."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.notice import each
from holdfast.recovery.rows import RowSolver, preferred, subsets
from holdfast.recovery.space import Metric, Space
from holdfast.solvers.descent import descend

Array = NDArray[np.float64]

_MOST = 48  # configurations of a goal that are kept, the nearest ones
_SLIDES = 25
_SAME = 1e-4  # rad and m
_STARTS_PER_SET = 96
_POLISHED = 4  # of the best configurations of a set, each another one


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
    q = met_from(solver, space, pose, np.concatenate([at[None], solver.starts(starts, at, space.free, rng)]))
    q = at + space.difference(q, at)
    poses, kept = np.repeat(pose[None], len(q), axis=0), np.ones((len(q), solver.rows.m))
    moving = np.arange(len(q))
    for _ in range(_SLIDES):
        some = q[moving]
        trial = solver.run(some + 0.3 * space.difference(at, some), poses[moving], kept[moving], space.free, 20)
        trial = kept_too(solver, space, trial, poses[moving], kept[moving])
        nearer = metric.length(trial - at) < metric.length(some - at) * (1 - 1e-6)
        nearer &= _good(solver, space, trial, poses[moving], kept[moving])
        q[moving[nearer]] = trial[nearer]
        moving = moving[nearer]
        if not moving.size:
            break
    return _distinct(q[np.argsort(metric.length(q - at), kind="stable")])


def met_from(solver: RowSolver, space: Space, pose: Array, begin: Array) -> Array:
    """Clear configurations (K, n) that meet every row of a pose (4, 4), from starts (N, n)."""
    poses, kept = np.repeat(pose[None], len(begin), axis=0), np.ones((len(begin), solver.rows.m))
    q = kept_too(solver, space, solver.run(begin, poses, kept, space.free), poses, kept)
    return np.asarray(q[_good(solver, space, q, poses, kept)])


def kept_too(solver: RowSolver, space: Space, q: Array, poses: Array, kept: Array) -> Array:
    """From q (N, n): rows of a goal with weights kept (N, m) above 0 are met, and with them what is kept all the way."""
    some = np.zeros(0, dtype=np.intp) if space.manifold is None else np.flatnonzero(~space.manifold.holds(q))
    if space.manifold is None or not some.size:
        return q

    def more(x: Array, which: NDArray[np.intp]) -> tuple[Array, Array]:
        on, pose = kept[some[which]] > 0, poses[some[which]]
        return solver.errors(x, pose) * on, -solver.slopes(x, pose) * on[:, :, None]

    q = q.copy()
    q[some] = space.manifold.projected(q[some], more)
    return q


def what_bars(solver: RowSolver, space: Space, poses: Array, at: Array, seed: int) -> str:
    """The pair that most often is too close where one of poses (G, 4, 4) is met; empty if none is met or each is clear."""
    rng = np.random.default_rng(seed)
    for pose in poses:
        begin = np.concatenate([at[None], solver.starts(_STARTS_PER_SET - 1, at, space.free, rng)])
        same, kept = np.repeat(pose[None], len(begin), axis=0), np.ones((len(begin), solver.rows.m))
        q = solver.run(begin, same, kept, space.free)
        pair = space.nearest(q[solver.meets(q, same, kept, space.free)])
        if pair:
            return pair
    return ""


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
    """Every minimal set of rows without which a pose is met, as far as found: few rows first, turns before positions.

    A row that is met all the same is not given up; of a set without any row left the configurations meet the whole pose.
    """
    rows, found = solver.rows, dict[tuple[int, ...], Array]()
    for size in range(1, rows.m):
        sets = subsets(rows.m, size, list(found))
        if not sets or space.spent:
            break
        begin = np.concatenate([at[None], solver.starts(_STARTS_PER_SET - 1, at, space.free, rng)])
        owner = np.repeat(np.arange(len(sets)), len(begin))
        kept = np.ones((len(sets), rows.m))
        for one, given_up in zip(kept, sets, strict=True):
            one[list(given_up)] = 0.0
        poses = np.repeat(pose[None], len(owner), axis=0)
        q = solver.nearest(np.tile(begin, (len(sets), 1)), poses, kept[owner], space.free)
        q = kept_too(solver, space, q, poses, kept[owner])
        good = _good(solver, space, q, poses, kept[owner])
        missed = np.linalg.norm(solver.errors(q, poses), axis=1)
        for k, given_up in enumerate(each("sets of rows", sets)):
            some = np.flatnonzero(good & (owner == k))
            some = some[np.argsort(missed[some], kind="stable")]
            if some.size:
                for fewer, ends in _with_fewer_rows(solver, space, pose, q[some], given_up).items():
                    found[fewer] = np.concatenate([found.get(fewer, ends[:0]), ends])
        found = {one: q for one, q in found.items() if not any(set(other) < set(one) for other in found)}
    relaxed = [(given_up, _select_least_error(solver, metric, space, pose, at, given_up, q)) for given_up, q in found.items()]
    relaxed.sort(key=lambda x: (*preferred(rows, x[0]), float(np.linalg.norm(x[1].rows.misses))))
    return [one for _, one in relaxed]


def _with_fewer_rows(
    solver: RowSolver, space: Space, pose: Array, q: Array, given_up: tuple[int, ...]
) -> dict[tuple[int, ...], Array]:
    """Configurations by the rows that they miss, from some (N, n) that meet all rows but those given up.

    Those are moved to where the rows given up are missed least, and to where one of them is met too, if that leads anywhere.
    """
    found, open_ = dict[tuple[int, ...], Array](), [(given_up, q)]
    while open_:
        lost, begin = open_.pop()
        better = [_polished(solver, space, pose, x, list(lost)) for x in _distinct(begin)[:_POLISHED]]
        ends = np.concatenate([np.stack(better), begin])
        missed = solver.find_violated_rows(ends, np.repeat(pose[None], len(ends), axis=0))
        for names in {tuple(np.flatnonzero(row).tolist()) for row in missed}:
            same = ends[(missed == np.isin(np.arange(solver.rows.m), names)).all(axis=1)]
            found[names] = np.concatenate([found.get(names, same[:0]), same])
        for row in lost if len(lost) > 1 else ():
            fewer = tuple(k for k in lost if k != row)
            mask = np.ones((len(better), solver.rows.m))
            mask[:, fewer] = 0.0
            poses = np.repeat(pose[None], len(better), axis=0)
            nearer = kept_too(solver, space, solver.run(np.stack(better), poses, mask, space.free), poses, mask)
            good = _good(solver, space, nearer, poses, mask)
            if good.any() and not any(set(one) <= set(fewer) for one in found):
                open_.append((fewer, nearer[good]))
    return found


def _select_least_error(
    solver: RowSolver, metric: Metric, space: Space, pose: Array, at: Array, given_up: tuple[int, ...], q: Array
) -> Relaxed:
    """Select the configurations (N, n) with the least error of the relaxed rows, the nearest first."""
    error = np.abs(solver.errors(q, np.repeat(pose[None], len(q), axis=0))[:, given_up])
    size = np.linalg.norm(error, axis=1)
    near = size <= size.min() * (1 + 1e-3) + 1e-6
    ends = at + space.difference(q[near], at)
    ends = _distinct(ends[np.argsort(metric.length(ends - at), kind="stable")])
    names, units = ([x[i] for i in given_up] for x in (solver.rows.names, solver.rows.units))
    return Relaxed(RowsGivenUp(tuple(names), tuple(error[size.argmin()].tolist()), tuple(units)), ends)


def _polished(solver: RowSolver, space: Space, pose: Array, q: Array, lost: list[int]) -> Array:
    """From q (n,) where the other rows are met, the rows lost missed by as little as possible."""
    arm, clearance = solver.arm, space.clearance
    kept = [k for k in range(solver.rows.m) if k not in lost]

    def errors(x: Array) -> Array:
        return np.asarray(solver.errors(x[None], pose[None])[0])

    def look(x: Array) -> tuple[float, Array, Array, Array]:
        e, slopes = errors(x), solver.slopes(x, pose)
        values, rows = e[kept], slopes[kept]
        if clearance is not None:
            values, rows = np.append(values, clearance.room(x) - space.margin), np.vstack([rows, clearance.gradient(x)])
        return float(e[lost] @ e[lost]), 2 * e[lost] @ slopes[lost], values, rows

    low, high = np.where(space.free, arm.lower, q), np.where(space.free, arm.upper, q)
    with np.errstate(all="ignore"):
        found = descend(look, q, low, high, len(kept))
    if not np.isfinite(found).all():
        return q
    mask = np.ones((1, solver.rows.m))
    mask[0, lost] = 0.0
    back = solver.run(np.where(space.free, np.clip(found, low, high), q)[None], pose[None], mask, space.free)
    nearer = np.linalg.norm(errors(back[0])[lost]) < np.linalg.norm(errors(q)[lost])
    return np.asarray(back[0] if nearer and _good(solver, space, back, pose[None], mask)[0] else q)
