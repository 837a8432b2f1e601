"""That no motion leads to the goal: a flood over cells of the joints that still move, or of some of them.

A cell is a box of joints. It is certainly blocked if a ball within a link, at its middle, is deeper in an object than it can
move within the box, if the same is true of two links, or if a row kept is broken by more than it can change. What is left may
be free. If those of it that are joined to the start, by a corner at least, hold no configuration of the goal, no motion leads
to it; else they are halved.

Of many joints a few are enough where these alone decide what is blocked: an elbow that is caught between two objects, whatever
the wrist does, or a gripper beside a forearm. The other joints are then anywhere within their limits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from copy import copy
from dataclasses import dataclass
from itertools import islice, product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.poses import rotation_vectors
from holdfast.caching import cached_property
from holdfast.cell.solids import Primitive
from holdfast.clearance.capsules import BASE
from holdfast.clearance.clearance import Clearance
from holdfast.enclosure.boxes import Blocked
from holdfast.recovery.proofs.blocked_boxes import BlockedBoxes
from holdfast.recovery.rows import Rows
from holdfast.recovery.space import Space
from holdfast.solvers import joint_space

if TYPE_CHECKING:
    from holdfast.clearance.exact.meetings import Part

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Cells = NDArray[np.int64]
Indices = NDArray[np.intp]
Holds = Callable[[Array, Array], Flags]
"""Whether cells with these middles (N, n) and half widths (n,) may hold a configuration of the goal."""

_JOINTS = 3  # that move, at most
_FIRST = 8  # cells of each joint, at first
_MOST = {1: 20_000, 2: 80_000, 3: 120_000}  # cells looked at, by the number of joints
_SLACK = 1e-9  # m and rad: rounding
_ROOT = 1e-7  # m: rounding of a square root where two squares cancel
_BALLS = 24  # along a body
_CHUNK = 4096
_LOOKED = 64  # configurations
_MOST_CONFINED = 25_000  # the same of some of more joints
_REACH = 0.15  # m: deeper in an object hardly a ball is
_FEW, _TRIED = 2, 2  # of more joints: over how many of them a flood goes, and how often it is tried


def disconnected(space: Space, start: Array, holds: Holds) -> str | None:
    """A sentence that proves that no motion leads from a start (n,) to what ``holds`` knows; None if none could be proved.

    Of at most three joints that move; of more see :func:`confined`.
    """
    joints = np.flatnonzero(space.free)
    if len(joints) > _JOINTS or (space.manifold is None and space.clearance is None):
        return None
    for flood in _floods(space, start, joints, _Blocked(space)):
        if not holds(flood.middle, flood.half).any():
            return flood.sentence
    return None


def confined(space: Space, start: Array, known: Array) -> Iterator[Flood]:
    """Floods over one or two of more than three joints that move, where these cannot get anywhere, wherever the others are.

    Those between two links that touch each other, and the first two, whose links touch objects. Only floods that hold none of
    the configurations (K, n) that are known of the goal, at most two over the same joints.
    """
    if space.clearance is None or space.free.sum() <= _JOINTS:
        return
    blocked, joints = _Blocked(space), np.flatnonzero(space.free)
    itself, first = blocked.itself, joints[:_FEW]
    tried: list[tuple[Indices, Blocked]] = [(first, blocked.moved_by(first))]
    if itself is not None:
        tried = [(some, itself.by_itself) for some in _between_links(space.clearance, joints)] + tried
    for some, what in tried:
        floods = _floods(space, start, some, what, _MOST_CONFINED)
        yield from islice((flood for flood in floods if flood.misses(known, np.zeros_like(known)).all()), _TRIED)


def _between_links(clearance: Clearance, joints: Indices) -> list[Indices]:
    """Of these joints, those between two links that may touch each other, fewest first, where they are one or two."""
    ends = {tuple(sorted(clearance.capsules.parts[k].link for k in pair)) for pair in clearance.pairs}
    found = {tuple(joints[(joints > a) & (joints <= b)].tolist()) for a, b in ends}
    return [np.array(some) for some in sorted(found, key=lambda some: (len(some), some)) if 0 < len(some) <= _FEW]


@dataclass(frozen=True, eq=False)
class Flood:
    """Cells that may be joined to the start.

    Attributes:
        names: Of the joints of which they are cells.
        joints, low, width: (f,) which these are, where the first cell begins, and its width, rad and m.
        round_: (f,) which of them turn round and round.
        count: Of cells, each way.
        cells: (N, f) numbers of those that are joined.
        middle, half: (N, n) and (n,), where they are, all joints.
        looked_at: How many cells were looked at so far.
    """

    names: list[str]
    joints: Indices
    low: Array
    width: Array
    round_: Flags
    count: int
    cells: Cells
    middle: Array
    half: Array
    looked_at: int

    @property
    def sentence(self) -> str:
        """That they hold no configuration of the goal."""
        return (
            f"what {' and '.join(self.names)} can get to from the start holds no configuration of the goal, by a flood over "
            f"{self.looked_at:,} cells of joints, up to {self.count} of each, up to floating point"
        )

    @cached_property
    def _below(self) -> NDArray[np.int64]:
        """How many joined cells have numbers below each corner of the grid."""
        there = np.zeros((self.count + 1,) * self.cells.shape[1], dtype=np.int64)
        there[tuple(self.cells.T + 1)] = 1
        for axis in range(there.ndim):
            there = there.cumsum(axis=axis)
        return there

    def misses(self, q: Array, half: Array) -> Flags:
        """(N,) True where no configuration within ``half`` (N, n) of q (N, n) is in a joined cell."""
        at, by = q[:, self.joints], half[:, self.joints]
        at = np.where(self.round_, np.arctan2(np.sin(at), np.cos(at)), at)
        first = np.floor((at - by - self.low - _SLACK) / self.width).astype(np.int64)
        last = np.floor((at + by - self.low + _SLACK) / self.width).astype(np.int64) + 1
        over = self.round_ & ((first < 0) | (last > self.count))  # past where a turn ends: anywhere
        first = np.clip(np.where(over, 0, first), 0, self.count)
        last = np.clip(np.where(over, self.count, last), 0, self.count)
        total = np.zeros(len(q), dtype=np.int64)
        for corner in product((0, 1), repeat=len(self.joints)):
            sign = (-1) ** (len(corner) - sum(corner))
            total += sign * self._below[tuple(np.where(corner, last, first).T)]
        return np.asarray(total == 0)


def _floods(space: Space, start: Array, joints: Indices, blocked: Blocked, most: int | None = None) -> Iterator[Flood]:
    """What is joined to a start (n,), cells halved again and again; the other joints anywhere within their limits."""
    box = _box(space, joints)
    if box is None:
        return
    low, high, round_ = box
    at = np.where(round_, np.arctan2(np.sin(start[joints]), np.cos(start[joints])), start[joints])
    count, looked_at = _FIRST, 0
    cells = np.array(list(product(range(count), repeat=len(joints))), dtype=np.int64)
    anywhere, half = (space.low + space.high) / 2, (space.high - space.low) / 2
    while looked_at + len(cells) <= (most or _MOST[len(joints)]) and not space.spent:
        half = half.copy()
        half[joints] = (high - low) / (2 * count)
        middle = np.tile(anywhere, (len(cells), 1))
        middle[:, joints] = low + (2 * cells + 1) * half[joints]
        looked_at += len(cells)
        open_ = ~np.concatenate(
            [blocked(x, np.broadcast_to(half, x.shape)) for x in np.split(middle, range(_CHUNK, len(cells), _CHUNK))]
        )
        cells, middle = cells[open_], middle[open_]
        away = np.abs(middle[:, joints] - at)
        away = np.where(round_, np.minimum(away, 2 * np.pi - away), away)
        begin = (away <= half[joints] + _SLACK).all(axis=1)
        if not begin.any():
            return  # the start is clear, so this cannot be
        joined = _flooded(cells, begin, count, round_)
        cells, middle = cells[joined], middle[joined]
        yield Flood(
            [space.arm.joint_names[k] for k in joints],
            joints,
            low,
            (high - low) / count,
            round_,
            count,
            cells,
            middle,
            half,
            looked_at,
        )
        cells = (2 * cells[:, None] + np.array(list(product((0, 1), repeat=len(joints))))).reshape(-1, len(joints))
        count *= 2


def holds_configuration(space: Space, q: Array) -> Holds:
    """Of a goal that is a configuration (n,)."""
    return lambda middle, half: np.asarray(
        (np.abs(joint_space.difference(space.arm, middle, q)) <= half + _SLACK).all(axis=1, where=space.free)
    )


def may_meet(space: Space, rows: Rows, poses: Array, tolerance: tuple[float, float] = (1e-6, 1e-6)) -> Holds:
    """Of a goal that is any of poses (G, 4, 4), in rows of a task: rows that both turn and move are left aside."""
    arm = space.arm
    turns = np.abs(rows.matrix[:, :3]).max(axis=1) == 0
    moves = np.abs(rows.matrix[:, 3:]).max(axis=1) == 0
    linear = rows.matrix[moves, :3]
    whole_turn = int(np.linalg.matrix_rank(rows.matrix[turns, 3:])) == 3 if turns.any() else False
    tool = _Points(np.array([arm.n - 1]), arm.tool[None, :3, 3])

    def holds(middle: Array, half: Array) -> Flags:
        frames = arm.frames(middle)
        moved = tool.moved(arm, frames, half)[:, 0] + np.sqrt(3) * tolerance[0] + _SLACK
        turned = float(half[~arm.prismatic].sum()) + np.sqrt(3) * tolerance[1] + _SLACK
        found = np.zeros(len(middle), dtype=bool)
        for pose in poses:
            away, good = pose[:3, 3] - frames[:, -1, :3, 3], np.ones(len(middle), dtype=bool)
            most = moved
            if rows.linear == "tool":
                away = np.einsum("nji,nj->ni", frames[:, -1, :3, :3], away)
                most = moved + np.linalg.norm(away, axis=1) * turned
            good &= (np.abs(away @ linear.T) <= np.linalg.norm(linear, axis=1) * most[:, None]).all(axis=1)
            if whole_turn:
                turn = rotation_vectors(pose[:3, :3] @ frames[:, -1, :3, :3].transpose(0, 2, 1))
                good &= np.linalg.norm(turn, axis=1) <= turned
            found |= good
        return found

    return holds


def _box(space: Space, free: Indices) -> tuple[Array, Array, Flags] | None:
    """Between what the free joints move, and which of them turn round and round; None where that is not known."""
    low, high = space.arm.lower[free], space.arm.upper[free]
    round_ = joint_space.turning(space.arm)[free]
    low, high = np.where(round_, -np.pi, low), np.where(round_, np.pi, high)
    return (low, high, round_) if np.isfinite([low, high]).all() and (high > low).all() else None


def _flooded(cells: Cells, begin: Flags, count: int, round_: Flags) -> Flags:
    """Which cells (N, f) are joined to those where it begins, by corners too, round those joints that turn round and round."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    dimensions = (count,) * cells.shape[1]
    codes = np.ravel_multi_index(tuple(cells.T), dimensions)
    order = np.argsort(codes)
    known = codes[order]
    first, last = [], []
    for step in product((-1, 0, 1), repeat=cells.shape[1]):
        beside = cells + np.array(step)
        beside = np.where(round_, beside % count, beside)
        some = np.flatnonzero(((beside >= 0) & (beside < count)).all(axis=1))
        there = np.ravel_multi_index(tuple(beside[some].T), dimensions)
        place = np.minimum(np.searchsorted(known, there), len(known) - 1)
        met = known[place] == there
        first.append(some[met])
        last.append(order[place[met]])
    i, j = np.concatenate(first), np.concatenate(last)
    _, label = connected_components(coo_array((np.ones(len(i)), (i, j)), shape=(len(cells),) * 2), directed=False)
    return np.isin(label, label[begin])


@dataclass(frozen=True)
class _Points:
    """Points that move with an arm.

    Attributes:
        link: (P,) the joint that moves each, from 0.
        at: (P, 3) in its frame, m.
    """

    link: NDArray[np.int64]
    at: Array

    def places(self, frames: Array) -> Array:
        """(N, P, 3) in the world, m."""
        found = np.empty((len(frames), len(self.link), 3))
        for link in np.unique(self.link):
            some, pose = self.link == link, frames[:, link + 1]
            found[:, some] = self.at[some] @ pose[:, :3, :3].transpose(0, 2, 1) + pose[:, None, :3, 3]
        return found

    def moved(self, arm: Arm, frames: Array, half: Array, places: Array | None = None) -> Array:
        """(N, P) the most by which each moves where joints move by up to ``half`` (n,) from where they are, m.

        From the tool inwards: a point is no farther from axis k than it is now and what joints beyond k move it.
        """
        places, total = self.places(frames) if places is None else places, np.zeros((len(frames), len(self.link)))
        for k in range(arm.n - 1, -1, -1):
            some = np.flatnonzero(self.link >= k)
            if half[k] == 0 or not some.size:
                continue
            if arm.prismatic[k]:
                total[:, some] += half[k]
                continue
            away = places[:, some] - frames[:, k + 1, None, :3, 3]
            along = away @ (frames[:, k + 1, :3, :3] @ arm.joints[k].axis)[..., None]
            across = np.sqrt(np.maximum(np.square(away).sum(axis=2) - along[..., 0] ** 2, 0.0)) + _ROOT
            total[:, some] += (across + total[:, some]) * half[k]
        return total


class _Blocked:
    """Which cells are certainly blocked."""

    def __init__(self, space: Space) -> None:
        from holdfast.clearance.exact.bodies import solids_within  # imports scipy

        self._space = space
        seen = None if space.clearance is None else space.clearance.obstacles
        parts: Sequence[Part] = [] if seen is None or space.clearance is None else space.clearance.exactness.parts
        rows = [(part.link, *ball) for part in parts if part.link > BASE and part.known for ball in _balls(part)]
        self._radius = np.array([radius for _, _, radius in rows])
        self._points = _Points(
            np.array([link for link, _, _ in rows]), np.array([centre for _, centre, _ in rows]).reshape(-1, 3)
        )
        self._objects: list[tuple[Primitive, float, Flags]] = []
        for k, solid in enumerate(() if seen is None else seen.cell):
            assert seen is not None
            apart = seen.apart[self._points.link + 1, k] if len(rows) else np.zeros(0, dtype=bool)
            self._objects += [(inner, seen.cell.margin_of(solid), apart) for inner in solids_within(solid)]
        own = space.clearance
        self.itself = None if own is None else BlockedBoxes(own, space.margin, (space.low, space.high))

    def moved_by(self, joints: Indices) -> _Blocked:
        """The same without balls that the other joints always move too far for them to tell anything."""
        space, half = self._space, (self._space.high - self._space.low) / 2
        half[joints] = 0.0
        frames = space.arm.frames(space.sample(_LOOKED, np.random.default_rng(0)))
        some = self._points.moved(space.arm, frames, half).min(axis=0) < self._radius + _REACH
        other = copy(self)
        other._points, other._radius = _Points(self._points.link[some], self._points.at[some]), self._radius[some]
        other._objects = [(solid, margin, apart[some]) for solid, margin, apart in self._objects]
        return other

    def __call__(self, q: Array, halves: Array) -> Flags:
        """(N,) True where everything within ``halves`` (N, n), all rows the same, of q (N, n) is blocked."""
        half = halves[0]
        space, found = self._space, np.zeros(len(q), dtype=bool)
        if space.manifold is not None:
            found |= (space.manifold.gaps(q) + space.manifold.changes(half[None]) < -_SLACK).any(axis=1)
        if self.itself is not None:
            found |= self.itself.by_itself(q, halves)
        if not self._objects or not len(self._radius):
            return found
        frames = space.arm.frames(q)
        places = self._points.places(frames)
        most = self._points.moved(space.arm, frames, half, places) - self._radius
        for solid, margin, apart in self._objects:
            nearest = np.where(apart, np.inf, solid.signed_distance(places) + most)
            found |= nearest.min(axis=1) < margin + space.margin - _SLACK
        return found


def _balls(part: Part) -> list[tuple[Array, float]]:
    """Centres (3,) in the frame of the link and radii, m, of balls within a body; closer than its own along a round one."""
    body = part.body
    centres, radii = body.inside
    if body.kind in ("capsule", "cylinder") and len(radii) > 1:
        centres = np.linspace(centres[0], centres[-1], _BALLS)
        radii = np.full(_BALLS, radii[0])
    return [
        (body.pose[:3, :3] @ centre + body.pose[:3, 3], float(radius)) for centre, radius in zip(centres, radii, strict=True)
    ]
