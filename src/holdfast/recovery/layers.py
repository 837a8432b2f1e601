"""Motions along a tool path through a graph: many configurations of each pose, each joined to those of the pose before."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.notice import each
from holdfast.recovery.goals import kept_too, met_from
from holdfast.recovery.rows import RowSolver
from holdfast.recovery.space import Metric, Space

if TYPE_CHECKING:
    from holdfast.paths.path import Path

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.int64]

JUMP = 0.35  # rad or m of one joint from sample to sample: more is another branch, no motion
_MOST = 150  # configurations of a pose
_COPIES = 3  # moved along the self-motion, of each of them
_STIR = 0.15  # rad or m, standard deviation of that
_SAME = 1e-3  # rad or m: configurations that are no nearer count as two
_SWEEPS = 40

FINEST_SHARE = 2.5e-4  # of a path: how closely the end of a motion along it is found
_STILL = 1e-7  # of a path: a step along the self-motion, nearly in place, so that places increase
_KEPT = 60  # configurations of a place where a path is followed as far as possible
_BENT = 0.25  # of a step, by which its middle may be off the straight line
_MAX_SPREADS = 8  # along the self-motion, before the end counts as reached
_MAX_LAYERS = 4000


@dataclass(frozen=True)
class Graph:
    """What a search through the layers found.

    Attributes:
        motions: (S, n) each, the shortest first, no two from one configuration of the first pose; rad and m.
        last: The last sample that any motion gets to.
        size: Configurations in all layers.
    """

    motions: list[Array]
    last: int
    size: int


def through_layers(
    solver: RowSolver,
    space: Space,
    metric: Metric,
    poses: Array,
    first: Array,
    at: Array,
    starts: int,
    rng: np.random.Generator,
) -> Graph:
    """Motions along poses (S, 4, 4) from configurations of the first, those given (R, n) and others, if self-motion is left.

    Each configuration leads to the nearest of the next pose and to others on its self-motion, by steps that are proved clear.
    Of the many of a pose those are kept that are spread widest: a motion through a passage that is narrower than their
    distance may be missed.
    """
    first = np.concatenate([first, met_from(solver, space, poses[0], solver.starts(starts, at, space.free, rng))])
    first = at + space.difference(first, at)
    some = _spread(first, metric.length(first - at))
    layers, came = [first[some]], [np.arange(len(some))]
    cost = metric.length(layers[0] - at)
    for pose in each("layers", list(poses[1:])):
        before = layers[-1]
        source = np.tile(np.arange(len(before)), 1 + _COPIES)
        stirred = before[source]
        stirred[len(before) :] += rng.normal(0.0, _STIR, (_COPIES * len(before), before.shape[1])) * space.free
        after, good = _met(solver, space, stirred, np.repeat(pose[None], len(source), axis=0), before[source])
        source, after = source[good], after[good]
        total = cost[source] + metric.length(after - before[source])
        some = _spread(after, total, 2 * _MOST)  # what is not kept anyway need not be proved clear
        some = some[space.edges(before[source[some]], after[some])]
        some = some[_spread(after[some], total[some])]
        source, after, total = source[some], after[some], total[some]
        if not len(after) or space.spent:
            break
        layers.append(after)
        came.append(source)
        cost = total
    size = sum(map(len, layers))
    if len(layers) < len(poses):
        return Graph([], len(layers) - 1, size)
    motions: dict[int, Array] = {}
    for end in np.argsort(cost, kind="stable"):
        chosen = [int(end)]
        for source in came[:0:-1]:
            chosen.append(int(source[chosen[-1]]))
        if chosen[-1] not in motions:
            motions[chosen[-1]] = np.stack([q[k] for q, k in zip(layers, reversed(chosen), strict=True)])
    return Graph(list(motions.values()), len(poses) - 1, size)


@dataclass(frozen=True)
class Continuation:
    """How far a path is followed from configurations of its beginning.

    Attributes:
        share: (S,) places on the path, 0 to 1, increasing; the last one is where every motion found ends.
        q: (S, n) the shortest motion to there, rad and m.
        size: Configurations of all places together, where self-motion was used; else 0.
    """

    share: Array
    q: Array
    size: int


def continue_path(
    solver: RowSolver, space: Space, metric: Metric, path: Path, first: Array, *, stride: float, rng: np.random.Generator
) -> Continuation:
    """Follow a path as far as possible from any of the configurations (R, n) of its beginning.

    Steps become shorter where none leads on, down to ``FINEST_SHARE``. If the arm has self-motion, the configurations of the
    last place are then spread along it, and the path is tried again from there.

    Args:
        solver: Of the rows that count.
        space: Where the arm may be.
        metric: By which motions are short.
        path: The path.
        first: (R, n) configurations of its beginning, at least one, rad and m.
        stride: Largest step, a share of the path.
        rng: For the spreading.
    """
    copies = _COPIES if space.free.sum() > solver.rows.m else 0
    some = _spread(first, np.zeros(len(first)), _KEPT)
    layers, came, share = [first[some]], [some], [0.0]
    cost, step, spreads, since = np.zeros(len(some)), stride, 0, 0.0
    while share[-1] < 1 and not space.spent and len(layers) < _MAX_LAYERS:
        place = min(share[-1] + step, 1.0)
        after, source, total = _next_layer(
            solver, space, metric, layers[-1], cost, path.pose(np.array([place]))[0], copies, rng
        )
        if len(after):
            layers, came, share, cost = [*layers, after], [*came, source], [*share, place], total
            if step == _STILL:
                step = FINEST_SHARE
                continue
            step = min(2 * step, stride)
            if place - since > 4 * FINEST_SHARE:
                spreads, since = 0, place
        elif step > FINEST_SHARE:
            step /= 4
        elif copies and spreads < _MAX_SPREADS:
            spreads, step = spreads + 1, _STILL
        else:
            break
    q = [int(cost.argmin())]
    for source in came[:0:-1]:
        q.append(int(source[q[-1]]))
    motion = np.stack([layer[k] for layer, k in zip(layers, reversed(q), strict=True)])
    return Continuation(np.array(share), motion, sum(map(len, layers)) if copies else 0)


def _next_layer(
    solver: RowSolver,
    space: Space,
    metric: Metric,
    before: Array,
    cost: Array,
    pose: Array,
    copies: int,
    rng: np.random.Generator,
) -> tuple[Array, Index, Array]:
    """Configurations (K, n) of a pose one step from configurations (N, n), from which each comes, and the cost up to there."""
    source = np.tile(np.arange(len(before)), 1 + copies)
    stirred = before[source]
    stirred[len(before) :] += rng.normal(0.0, _STIR, (copies * len(before), before.shape[1])) * space.free
    poses = np.repeat(pose[None], len(source), axis=0)
    after, good = _met(solver, space, stirred, poses, before[source])
    source, after = source[good], after[good]
    some = _spread(after, cost[source] + metric.length(after - before[source]), 2 * _KEPT)
    source, after = source[some], after[some]
    # On another branch the middle is not where the straight line has it.
    middle, near = _met(solver, space, (before[source] + after) / 2, poses[: len(source)], before[source])
    off = np.abs(middle - (before[source] + after) / 2).max(axis=1)
    near &= off <= _BENT * np.abs(after - before[source]).max(axis=1) + 10 * _SAME
    near[near] = space.edges(before[source[near]], after[near])
    source, after = source[near], after[near]
    total = cost[source] + metric.length(after - before[source])
    some = _spread(after, total, _KEPT)
    return after[some], source[some], total[some]


def _met(solver: RowSolver, space: Space, q: Array, poses: Array, before: Array) -> tuple[Array, Flags]:
    """From starts q (N, n): configurations of poses (N, 4, 4), and which of them are met and one step from ``before``."""
    kept = np.ones((len(q), solver.rows.m))
    after = kept_too(solver, space, solver.run(q, poses, kept, space.free), poses, kept)
    return after, solver.meets(after, poses, kept, space.free) & (np.abs(after - before).max(axis=1) <= JUMP)


def _spread(q: Array, cost: Array, most: int = _MOST) -> Index:
    """Which of configurations (N, n) to keep: the cheapest, then always the one farthest from all that are kept."""
    if not len(q):
        return np.zeros(0, dtype=np.int64)
    columns = np.ascontiguousarray(q.T)
    keep, away = [int(np.argmin(cost))], np.full(len(q), np.inf)
    while len(keep) <= most:
        away = np.minimum(away, np.abs(columns - columns[:, keep[-1:]]).max(axis=0))
        if away.max() <= _SAME:
            break
        keep.append(int(np.argmax(away)))
    return np.array(keep[:most])


def shorter(solver: RowSolver, space: Space, metric: Metric, poses: Array, q: Array) -> Array:
    """The same motion (S, n) with less to and fro along self-motions: each configuration drawn between its neighbours."""
    q = q.copy()
    for _ in range(_SWEEPS):
        before = float(metric.along(q)[-1])
        for parity in (1, 2):
            here = np.arange(parity, len(q), 2)
            after = np.minimum(here + 1, len(q) - 1)
            wanted = np.where((here < len(q) - 1)[:, None], (q[here - 1] + q[after]) / 2, q[here - 1])
            trial, good = _met(solver, space, wanted, poses[here], q[here - 1])
            good &= np.abs(trial - q[after]).max(axis=1) <= JUMP
            old = metric.length(q[here] - q[here - 1]) + metric.length(q[after] - q[here]) * (after > here)
            new = metric.length(trial - q[here - 1]) + metric.length(q[after] - trial) * (after > here)
            good &= new < old
            good[good] = space.edges(q[here[good] - 1], trial[good])
            inner = good & (after > here)
            good[inner] = space.edges(trial[inner], q[after[inner]])
            q[here[good]] = trial[good]
        if space.spent or float(metric.along(q)[-1]) > before * (1 - 1e-4):
            break
    return q
