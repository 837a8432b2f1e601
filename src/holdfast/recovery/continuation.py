"""Whether the rest of a tool path can still be finished with joints locked, in one continuous motion."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.poses import rotation_vectors
from holdfast.notice import each
from holdfast.recovery.goals import RowsGivenUp, configurations_of, kept_too, met_from
from holdfast.recovery.layers import JUMP, continue_path, through_layers
from holdfast.recovery.routes import reachable_goals
from holdfast.recovery.rows import RowSolver, preferred, subsets
from holdfast.recovery.space import Metric, Space
from holdfast.recovery.timing.motion import OFF_PATH

if TYPE_CHECKING:
    from holdfast.paths.path import Path

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_SPACING = 0.01  # m or rad of the end effector between samples
_LEAST, _MOST = 20, 400  # samples
_STARTS_PER_SET = 12
_FINER = 8  # times as many samples, where joints move so fast that what is one motion seems to jump
_INNER = np.array([0.25, 0.5, 0.75])  # between two waypoints: where the motion is looked at
_HALVED = 8  # times what is between two waypoints is, until it is near the path


@dataclass(frozen=True, kw_only=True)
class RestOfPath:
    """What became of the rest of a tool path.

    Attributes:
        furthest: Share of the path, 0 to 1, up to which a motion was found that keeps every row, to 0.001; it begins in a
            configuration of the first pose to which a motion of the arm was found.
        begin: (n,) that configuration, rad and m; None if none was found.
        share: (S,) samples of the path, 0 to 1.
        found: (S,) True where a configuration of that pose was found at all, each sample on its own.
        q: (S, n) the motion, without the rows given up if there are any; (0, n) if none was found; rad and m.
        deviation: Largest error of the rows kept half-way between waypoints, m and rad.
        given_up: Rows given up over the whole path, with the most that they miss on the way; None if all are kept.
        starts: Configurations of the first pose from which the path was followed.
        cut_off: Configurations of the beginning were found, but no route to any of them; ``q`` is then empty.
        graph: Configurations of a graph through all poses that was searched where following the path from each start ended
            early; 0 if it was not needed, or if the arm has no self-motion left.
    """

    furthest: float
    share: Array
    found: Flags
    q: Array
    deviation: float
    given_up: RowsGivenUp | None
    starts: int
    begin: Array | None = None
    cut_off: bool = False
    graph: int = 0

    @property
    def finished(self) -> bool:
        """True if a continuous motion was found that keeps every row from beginning to end."""
        return len(self.q) > 0 and self.given_up is None

    @property
    def first_lost(self) -> float | None:
        """The first sample, 0 to 1, of which no configuration was found; None if one was found of all."""
        lost = self.share[~self.found]
        return float(lost[0]) if lost.size else None

    @property
    def why(self) -> str:
        """Why it was not finished, a phrase."""
        if self.cut_off:
            return "configurations of its beginning exist, but no route from here to any of them was found"
        if self.first_lost is not None:
            return f"no configuration was found at {100 * self.first_lost:.1f} % of it, which proves nothing"
        among = f" among {self.graph:,} configurations joined from pose to pose" if self.graph else ""
        return f"each of its poses is reached on its own, but no continuous motion through all of them was found{among}"

    def describe(self) -> str:
        """One sentence for people."""
        if self.finished:
            return (
                f"The rest of the tool path can be finished: {len(self.q)} waypoints, off the path by at most "
                f"{self.deviation:.2g} (m and rad) between them."
            )
        text = f"The rest of the tool path was not finished: {self.why}; the best motion gets to {100 * self.furthest:.1f} %"
        if self.begin is not None:
            text += f" of it, from the configuration ({', '.join(f'{x:.4g}' for x in self.begin)}) of its first pose"
        text += "."
        if self.given_up is not None:
            text += f" It can be followed if these rows are given up, which then miss at most: {self.given_up}."
        return text


def rest_of_path(
    solver: RowSolver, space: Space, metric: Metric, path: Path, at: Array, starts: int, rng: np.random.Generator
) -> tuple[RestOfPath, list[Array]]:
    """Follow a path from configurations of its first pose; also every motion (S, n) found, the shortest first."""
    share = _samples(path)
    poses = path.pose(share)
    found = np.array([not space.spent and _reached(solver, space, pose, at, rng) for pose in each("poses of the path", poses)])
    first = configurations_of(solver, space, metric, poses[0], at, starts, rng)
    made = RestOfPath(
        furthest=0.0, share=share, found=found, q=np.zeros((0, solver.arm.n)), deviation=0.0, given_up=None, starts=len(first)
    )
    made, motions = _followed(made, solver, space, metric, path, first)
    if not motions and _all_reached(solver, space, poses, made.found, at, starts, rng):
        if space.free.sum() > solver.rows.m:
            graph = through_layers(solver, space, metric, poses, first, at, starts, rng)
            furthest = max(made.furthest, float(share[graph.last]))
            made, motions = replace(made, furthest=furthest, graph=graph.size), graph.motions
        if not motions:
            made, motions = _followed(made, solver, space, metric, path, first, _FINER)
    return (along(made, solver, path, motions[0]) if motions else made), motions


def continue_unfinished_path(
    made: RestOfPath,
    solver: RowSolver,
    space: Space,
    metric: Metric,
    path: Path,
    at: Array,
    starts: int,
    rng: np.random.Generator,
) -> tuple[RestOfPath, list[Array]]:
    """Continue an unfinished path to its furthest reachable point; also return the motion if it gets to the end.

    Followed are all configurations of the first pose that were found and to which a motion leads.
    """
    made = replace(made, furthest=0.0)
    pose = path.pose(made.share[:1])[0]
    first = np.concatenate(
        [
            configurations_of(solver, space, metric, pose, at, starts, rng),
            met_from(solver, space, pose, solver.starts(starts, at, space.free, rng)),
        ]
    )
    first = at + space.difference(first, at)
    if not len(first):
        return made, []
    first = first[reachable_goals(space, metric, at, first, rng)]
    if not len(first):
        return replace(made, cut_off=True), []
    stride = float(np.diff(made.share).max())
    end = continue_path(solver, space, metric, path, first, stride=stride, rng=rng)
    furthest, graph = float(end.share[-1]), max(made.graph, end.size)
    made = replace(made, furthest=furthest, begin=end.q[0], graph=graph, cut_off=False)
    made = replace(made, found=made.found | (made.share <= furthest))
    if furthest < 1:
        return made, []
    made = replace(made, share=end.share, found=np.ones(len(end.share), dtype=bool))
    return along(made, solver, path, end.q), [end.q]


def _followed(
    made: RestOfPath, solver: RowSolver, space: Space, metric: Metric, path: Path, first: Array, finer: int = 1
) -> tuple[RestOfPath, list[Array]]:
    """The path followed from configurations (R, n) of its first pose, by samples that are finer than those made."""
    places = np.arange((len(made.share) - 1) * finer + 1) / finer
    share = np.interp(places, np.arange(len(made.share)), made.share)
    q, last = _tracked(solver, space, path.pose(share), first, np.ones((len(first), solver.rows.m)))
    furthest = max(made.furthest, float(share[last.max(initial=0)]))
    whole = np.flatnonzero(last == len(share) - 1)
    if whole.size:
        made = replace(made, share=share, found=np.ones(len(share), dtype=bool))
    # A pose on the way is found where a motion passes it.
    made = replace(made, furthest=furthest, found=made.found | (made.share <= furthest) & (last.max(initial=-1) >= 0))
    return made, _by_length(metric, [q[:, k] for k in whole])


def without_rows(
    made: RestOfPath, solver: RowSolver, space: Space, path: Path, at: Array, rng: np.random.Generator
) -> tuple[RestOfPath, list[Array]]:
    """The same path with as few rows given up as possible, and the motion (S, n) for that, if there is one."""
    poses = path.pose(made.share)
    for size in range(1, solver.rows.m):
        sets = [] if space.spent else subsets(solver.rows.m, size, [])
        best = _without(solver, space, poses, at, sets, rng) if sets else None
        if best:
            given_up, motion = best
            mask = np.ones(solver.rows.m)
            mask[list(given_up)] = 0.0
            given_up = tuple(np.flatnonzero(solver.find_violated_rows(motion, poses).any(axis=0)).tolist())
            if not given_up:  # a row that is met all the way is not given up
                return along(made, solver, path, motion), [motion]
            misses = np.abs(solver.errors(motion, poses)).max(axis=0)[list(given_up)]
            names, units = ([x[i] for i in given_up] for x in (solver.rows.names, solver.rows.units))
            rows = RowsGivenUp(tuple(names), tuple(misses.tolist()), tuple(units))
            return replace(along(made, solver, path, motion, mask), given_up=rows), [motion]
    return made, []


def _samples(path: Path) -> Array:
    coarse = path.pose(np.linspace(0, 1, 65))[:, :3, :3]
    turns = rotation_vectors(coarse[1:] @ coarse[:-1].transpose(0, 2, 1))
    turned = float(np.linalg.norm(turns, axis=1).sum()) if path.oriented else 0.0
    count = int(np.clip(np.ceil(max(path.length, turned) / _SPACING), _LEAST, _MOST))
    return np.unique(np.concatenate([np.linspace(0, 1, count + 1), path.bounds]))


def _all_reached(
    solver: RowSolver, space: Space, poses: Array, found: Flags, at: Array, starts: int, rng: np.random.Generator
) -> bool:
    """Poses that were not found are looked for longer, up to the first that is not found again."""
    for k in np.flatnonzero(~found):
        found[k] = not space.spent and _reached(solver, space, poses[k], at, rng, starts)
        if not found[k]:
            return False
    return not space.spent


def _reached(solver: RowSolver, space: Space, pose: Array, at: Array, rng: np.random.Generator, starts: int = 15) -> bool:
    begin = np.concatenate([at[None], solver.starts(starts, at, space.free, rng)])
    return len(met_from(solver, space, pose, begin)) > 0


def _tracked(solver: RowSolver, space: Space, poses: Array, first: Array, kept: Array) -> tuple[Array, NDArray[np.int64]]:
    """Motions (S, R, n) from configurations (R, n) of the first pose, NaN once lost, and the last sample of each (R,)."""
    q = np.full((len(poses), *first.shape), np.nan)
    q[0] = first
    last = np.zeros(len(first), dtype=np.int64)
    alive = np.arange(len(first))
    for k in each("waypoints", range(1, len(poses)), most=True):
        if not alive.size or space.spent:
            break
        before = q[k - 1, alive]
        target = np.repeat(poses[k][None], len(alive), axis=0)
        after = solver.nearest(before, target, kept[alive], space.free)
        far = np.abs(after - before).max(axis=1) > JUMP
        if far.any():  # rows that are given up must not pull the others onto another branch
            after[far] = solver.run(before[far], target[far], kept[alive][far], space.free)
        after = kept_too(solver, space, after, target, kept[alive])
        good = solver.meets(after, target, kept[alive], space.free) & (np.abs(after - before).max(axis=1) <= JUMP)
        some = np.flatnonzero(good)
        good[some] = space.edges(before[some], after[some])
        alive, after = alive[good], after[good]
        q[k, alive], last[alive] = after, k
    return q, last


def _by_length(metric: Metric, motions: list[Array]) -> list[Array]:
    return sorted(motions, key=lambda q: float(metric.along(q)[-1]))


def _without(
    solver: RowSolver, space: Space, poses: Array, at: Array, sets: list[tuple[int, ...]], rng: np.random.Generator
) -> tuple[tuple[int, ...], Array] | None:
    """The set of rows, of those preferred most, without which the path is followed, and the motion that misses least."""
    begin = np.concatenate([at[None], solver.starts(_STARTS_PER_SET - 1, at, space.free, rng)])
    owner = np.repeat(np.arange(len(sets)), len(begin))
    kept = np.ones((len(owner), solver.rows.m))
    for row, k in zip(kept, owner, strict=True):
        row[list(sets[k])] = 0.0
    target = np.repeat(poses[:1], len(owner), axis=0)
    first = solver.nearest(np.tile(begin, (len(sets), 1)), target, kept, space.free)
    first = kept_too(solver, space, first, target, kept)
    good = solver.meets(first, target, kept, space.free)
    good[good] = space.clear(first[good])
    q, last = _tracked(solver, space, poses, first[good], kept[good])
    whole = np.flatnonzero(last == len(poses) - 1)
    if not whole.size:
        return None
    missed = [float(np.linalg.norm(solver.errors(q[:, k], poses), axis=1).max()) for k in whole]
    keys = [(*preferred(solver.rows, sets[owner[good][k]]), miss) for k, miss in zip(whole, missed, strict=True)]
    best = whole[min(range(len(keys)), key=keys.__getitem__)]
    return sets[owner[good][best]], q[:, best]


def along(made: RestOfPath, solver: RowSolver, path: Path, q: Array, mask: Array | float = 1.0) -> RestOfPath:
    """The same with the motion q (S, n), and how far it is off between its waypoints in the rows whose ``mask`` is 1."""
    middle = path.pose((made.share[1:] + made.share[:-1]) / 2)
    off = np.abs(solver.errors((q[1:] + q[:-1]) / 2, middle) * mask).max()
    return replace(made, q=q, deviation=float(off))


def refined(made: RestOfPath, solver: RowSolver, space: Space, path: Path, q: Array) -> tuple[RestOfPath, Array] | None:
    """The motion q (S, n) with more waypoints wherever it is far off the path between two; None if none is found there.

    Where joints move fast, as beside a singular configuration, straight lines in joint space are no straight lines of the tool.
    """
    near = np.where(np.array(solver.rows.units) == "m", OFF_PATH[0] * max(solver.arm.length_unit, 1.0), OFF_PATH[1])
    share, found = made.share, made.found
    for _ in range(_HALVED):
        inner = q[:-1, None] + _INNER[:, None] * np.diff(q, axis=0)[:, None]
        places = share[:-1, None] + _INNER * np.diff(share)[:, None]
        off = np.abs(solver.errors(inner.reshape(-1, q.shape[1]), path.pose(places.ravel()))).reshape(*places.shape, -1)
        k = np.flatnonzero((off > near).any(axis=(1, 2)))
        if not k.size:
            return replace(along(replace(made, share=share, found=found), solver, path, q), q=q), q
        middle, between = (share[k] + share[k + 1]) / 2, (q[k] + q[k + 1]) / 2
        poses, kept = path.pose(middle), np.ones((len(k), solver.rows.m))
        new = kept_too(solver, space, solver.run(between, poses, kept, space.free), poses, kept)
        good = solver.meets(new, poses, kept, space.free)
        good &= np.abs(new - between).max(axis=1) <= np.abs(q[k + 1] - q[k]).max(axis=1)  # else on another branch
        if not (good.all() and space.edges(q[k], new).all() and space.edges(new, q[k + 1]).all()):
            return None
        q, share, found = np.insert(q, k + 1, new, axis=0), np.insert(share, k + 1, middle), np.insert(found, k + 1, True)
    return None
