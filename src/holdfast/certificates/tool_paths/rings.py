"""Lock instants after which no configuration has the tool where it must be later on: boxes of joints that rings exclude.

With the tool given, base, joints, tool and base again are a ring. Two points of links are as far from each other by the joints
between them as by the others, on the way round; points on axes make these distances depend on few joints: of an arm with a
spherical shoulder and wrist, that of the two on the elbow alone. Everything here may be wrong: the verifier decides.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations_with_replacement

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.joint_boxes.halving import OPEN, Halving, Index
from holdfast.certificates.joint_boxes.segments import Segment, points_on_axes
from holdfast.certificates.taylor import Chain
from holdfast.certificates.tool_paths.cells import SEGMENT, Ints
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.forms import Following

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Point = tuple[int, Array]  # link, and where in its frame, m

_MARGIN = 1e-7  # m, so that the verifier's rounding costs nothing
_MOST, _ALIKE = 12, 2  # pairs of points; of those whose distances depend on the same joints
_NODES, _HALVINGS = 4000, 16  # boxes of a tree, and how often each joint is halved
_PLACES = 8  # on the path, where the tool is looked for
_STARTS, _STEPS, _MET = 40, 25, 1e-8  # of Newton's method; m and rad
_SEED = 15


@dataclass(frozen=True, eq=False)
class Never:
    """Lock instants that are refuted.

    Attributes:
        begin, stop: From when to when, in one segment.
        at: Where on the path, as an instant, no configuration has the tool.
        tree: Of boxes of the joints, each with the pair of points that excludes it.
    """

    begin: int
    stop: int
    at: int
    tree: bytes


@dataclass(frozen=True, eq=False)
class _Way:
    """From a point to another by some joints.

    Attributes:
        segment: The joints, and the point behind them.
        joints: Which of the arm's.
        start: (3,) m, the point before them.
        moves: Which of them move one away from the other.
    """

    segment: Segment
    joints: Ints
    start: Array
    moves: Flags

    @classmethod
    def of(cls, ring: Chain, first: int, last: int, start: Array, end: Array) -> _Way:
        """Of some successive joints of a ring."""
        segment = Segment.of(ring, first, last, end)
        return cls(
            segment, np.arange(first, last) % (len(ring.lengths) // 2), start, np.arange(last - first) >= segment.on_axes(start)
        )

    def bound(self, middle: Array, half: Array, far: bool) -> tuple[Array, Array, Array]:
        """Over boxes of all joints: the least or greatest distance, that of the middles, and what each joint costs (N, n)."""
        count, each = len(middle), np.zeros(middle.shape)
        if not len(self.joints):
            same = np.full(count, np.linalg.norm(self.segment.end - self.start))
            return same, same, each
        q, h = middle[:, self.joints], half[:, self.joints] * self.moves
        at, none = np.broadcast_to(self.start, (count, 3)), np.zeros((count, 3))
        bound, gap, cost = (self.segment.farthest if far else self.segment.nearest)(q, h, at, none)
        if far:
            cost = cost / np.maximum(gap, 1e-9)[:, None]
        each[:, self.joints] = cost[:, : len(self.joints)]
        return bound, gap, each


class Rings:
    """The search for lock instants that are refuted, of one joint.

    Args:
        following: The arm with this joint locked, all others free.
        turns: Whether the rotation of the tool is given as well.
        flat: Whether all of it happens in the plane.
    """

    def __init__(self, following: Following, turns: bool, flat: bool) -> None:
        self._f, self._turns, chain = following, turns, following.chain
        self._chain = replace(chain, origins=chain.origins * np.array([1, 1, not flat]))
        self._joint, self._limits, full = following.still[0], following.limits.copy(), np.nextafter(np.pi, 4)
        self._limits[~chain.slides & (self._limits[:, 1] - self._limits[:, 0] >= 2 * np.pi)] = -full, full
        self._end, self._kept = (len(following.knots) - 1) * SEGMENT, np.array([1, 1, not flat])
        self._rng = np.random.default_rng(_SEED)
        self.points, self.pairs = self._chosen()
        self._last = self._end

    def _chosen(self) -> tuple[list[Point], list[tuple[int, int]]]:
        """Points of links, and pairs of them whose distances depend on few joints."""
        chain, n = self._chain, self._f.n
        some = points_on_axes(chain, self._limits, self._rng)
        scale = float(chain.lengths.mean())
        points = [*some, *((k, place + scale * chain.rotations[k][:, 2]) for k, place in some)] if self._turns else some
        points = [*sorted(points, key=lambda point: point[0]), (n, chain.origins[-1])]
        q = self._rng.uniform(self._limits[:, 0], self._limits[:, 1], (8, n))
        found = list[tuple[int, bytes, tuple[int, int]]]()
        for i, j in combinations_with_replacement(range(len(points)), 2):
            if not self._turns and j + 1 < len(points):
                continue
            ways, counts = self._ways(self._end, points, (i, j)), np.zeros(n, dtype=bool)
            for way in ways:
                tip, _, columns = way.segment.frames(q[:, way.joints])
                changes = np.abs(np.einsum("na,nka->nk", tip - way.start, columns)).max(axis=0) > 1e-9
                counts[way.joints] |= changes | ((i == j) & (np.abs(columns).max(axis=(0, 2)) > 1e-9))
            if counts.any():
                found.append((int(counts.sum()), counts.tobytes(), (i, j)))
        pairs, seen = list[tuple[int, int]](), list[bytes]()
        for _, which, pair in sorted(found, key=lambda one: (one[0], one[1])):
            if seen.count(which) < _ALIKE and len(pairs) < _MOST:
                seen.append(which)
                pairs.append(pair)
        return points, pairs

    def _ways(self, at: int, points: list[Point], pair: tuple[int, int]) -> tuple[_Way, _Way]:
        """From one point to the other by the joints between, and on by the tool, which is where it is at an instant."""
        chain, n, ((first, a), (last, b)) = self._chain, self._f.n, (points[k] for k in pair)
        place, turn = (x[0] for x in self._f.moved(self._f.healthy(np.array([2 * at]), np.array([at]))[0])[:2])
        back = chain.rotations[n] @ turn.T
        base = chain.origins[n] - back @ (place * self._kept)
        rotations = np.concatenate([chain.rotations[:n], [back @ chain.rotations[0]], chain.rotations[1:]])
        origins = np.concatenate([chain.origins[:n], [base + back @ chain.origins[0]], chain.origins[1:]])
        ring = Chain(rotations, origins, np.tile(chain.lengths, 2), np.tile(chain.slides, 2))
        return _Way.of(ring, first, last, a, b), _Way.of(ring, last, n + first, b, a if first else base + back @ a)

    def tried(self, begin: int, stop: int) -> tuple[Never | None, bool, int]:
        """Lock instants of one segment: refuted as a whole, or not; whether parts of them may be; boxes that were looked at."""
        locks, parts = np.array([begin, (begin + stop) // 2, stop]), False
        for at in dict.fromkeys([self._last, *np.linspace(self._end, -(-stop // SEGMENT) * SEGMENT, _PLACES, dtype=np.int64)]):
            place = int(at) // SEGMENT * SEGMENT
            if place < stop:
                continue
            found = self._exist(locks, place)
            parts |= not found.all()
            if not found.any():
                self._last = place
                tree, done = self._tree(begin, stop, place)
                return (Never(begin, stop, place, tree.in_order()) if done else None), True, tree.tested
        return None, parts, 0

    def _exist(self, locks: Ints, at: int) -> Flags:
        """Whether Newton's method finds configurations within the limits that have the tool at a place, for each lock."""
        f, (low, high), count = self._f, self._limits.T, len(locks)
        given, goal = (f.healthy(2 * x, np.maximum(x, 1))[0] for x in (locks, np.array([at])))
        q = self._rng.uniform(low, high, (count, _STARTS, f.n))
        q[:, 0], q[:, 1] = given, goal
        q[:, :, self._joint] = given[:, [self._joint]]
        q, target = q.reshape(-1, f.n), f.moved(goal)
        for _ in range(_STEPS):
            error, slope = f.missed(f.moved(q), target)
            ours = slope[:, :, f.free]
            gram = ours @ ours.transpose(0, 2, 1) + 1e-9 * np.eye(f.m)
            q[:, f.free] -= np.clip((ours.transpose(0, 2, 1) @ np.linalg.solve(gram, error[:, :, None]))[:, :, 0], -0.4, 0.4)
        # Nearest to the middles of the limits, of all that are the same.
        q -= 2 * np.pi * np.round((q - (low + high) / 2) / (2 * np.pi)) * ([k in f.free for k in range(f.n)] & ~f.slides)
        at_last = f.moved(q)
        good = (np.abs(f.missed(at_last, target)[0]) < _MET).all(axis=1) & ((q >= low) & (q <= high))[:, f.free].all(axis=1)
        if f.rotated:
            good &= f.straight(at_last, target) > 1
        return np.asarray(good.reshape(count, -1).any(axis=1))

    def _tree(self, begin: int, stop: int, at: int) -> tuple[Halving, bool]:
        """The halving of all joints, with that which locks where it is between instants; whether each box is excluded."""
        box = self._limits.copy()
        box[self._joint] = np.sort(self._f.healthy(np.array([2 * begin, 2 * stop]), np.array([stop]))[0][:, self._joint])
        tree = Halving(box, _HALVINGS)
        test = _Test([self._ways(at, self.points, pair) for pair in self.pairs])
        return tree, tree.run(test, most=_NODES) and tree.undecided == 0


def rings_of(claim: PathClaim, joint: int) -> Rings | None:
    """What refutes lock instants of a joint; None of an arm with endless slides, or that leaves the plane of its task."""
    chain, limits = Chain.of(claim.arm), np.column_stack([claim.arm.lower, claim.arm.upper])
    flat = claim.task.startswith("planar")
    endless = claim.arm.prismatic & ~np.isfinite(limits).all(axis=1)
    in_plane = not chain.slides.any() and (np.abs(chain.rotations[:, 2, 2]) == 1).all()
    if endless.any() or (flat and not in_plane):
        return None
    arm = Following(chain, claim.knots, claim.task, still=[joint], tube=np.empty(0), limits=limits, slides=claim.arm.prismatic)
    return Rings(arm, "pose" in claim.task, flat)


class _Test:
    """Which pair of points tells boxes of joints from what closes the ring."""

    def __init__(self, pairs: list[tuple[_Way, _Way]]) -> None:
        self._pairs = pairs

    def __call__(self, middle: Array, half: Array) -> tuple[Index, Array]:
        """Tokens, and what halving each joint gains."""
        found, best, gain = np.full(len(middle), OPEN, dtype=np.int64), np.full(len(middle), -np.inf), np.zeros(half.shape)
        for token, ways in enumerate(self._pairs):
            rows = np.flatnonzero(found == OPEN)
            if not rows.size:
                break
            apart = [np.linalg.norm(way.segment.frames(middle[rows][:, way.joints])[0] - way.start, axis=1) for way in ways]
            for longer, shorter, some in ((0, 1, apart[0] >= apart[1]), (1, 0, apart[0] < apart[1])):
                which = rows[some]
                if not which.size:
                    continue
                near, gap, each = ways[longer].bound(middle[which], half[which], far=False)
                far, less, more = ways[shorter].bound(middle[which], half[which], far=True)
                spare, between = near - far, gap - less
                found[which[spare > _MARGIN]] = token
                part = between / np.maximum(between - spare, 1e-12)  # 1: just excluded
                better = part > best[which]
                best[which[better]], gain[which[better]] = part[better], (each + more)[better]
        return found, gain
