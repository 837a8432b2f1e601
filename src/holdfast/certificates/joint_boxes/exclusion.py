"""Out of reach: boxes of configurations and targets are halved until one distance tells each of them apart.

The position of a point of link k, less the target, must be as long as the tool is from that point. How far the tool can be from
it is a lemma, about the joints behind it alone, proved by a bisection of its own; a box is excluded where the distance from the
target to the point lies outside of the lemma, which concerns the joints before it alone. With a point of the base on the first
axes (a shoulder) the lemma is the whole proof. The tool itself is the last such point: there the distance must be 0.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.claims import OutOfReachClaim
from holdfast.certificates.crew import Effort
from holdfast.certificates.joint_boxes.halving import OPEN, Halving, Index, need_room
from holdfast.certificates.joint_boxes.jobs import halved
from holdfast.certificates.joint_boxes.rows import Rows
from holdfast.certificates.joint_boxes.segments import Segment, points_on_axes
from holdfast.certificates.taylor import Chain, Reach

Array = NDArray[np.float64]

LEMMA = 3  # token of a box that the first lemma excludes; 0: the tool itself is elsewhere
_MOST_LEMMAS = 12
_MARGIN = 1e-7  # m, so that the verifier's rounding costs nothing
_SAMPLES, _CLIMBERS, _CLIMBS = 2048, 32, 60
_LEMMA_NODES = 40_000
_NARROW = 1e-3, 2e-4  # by what part of its range, and of the length behind it, a lemma is wider than what was found
_LEMMA_HALVINGS = 40
_MET, _ROOM = 1e-10, 1e-6  # m and rad: of a target, and from limits, of a witness


@dataclass(frozen=True, eq=False)
class Lemma:
    """The tool is from least to most (m) from a point of a link, wherever the joints behind it are.

    Attributes:
        link: Which link: 0 is the base.
        point: (3,) m in its frame.
        tree: Bisection of the joints behind it, each leaf of which keeps to it.
    """

    link: int
    point: Array
    least: float
    most: float
    tree: bytes


@dataclass(frozen=True, eq=False)
class Exclusion:
    """What the search found.

    Attributes:
        lemmas: Those that the tree uses.
        tree: Over all joints, then the target's coordinates.
        undecided: Exact part of pairs of configuration and target.
        leaves, nodes: Boxes that are excluded, lemmas and all; looked at.
        finished: False if the time was spent.
        witness: (n,) rad, a configuration whose tool is in the box of targets: the claim is false.
    """

    lemmas: list[Lemma]
    tree: bytes
    undecided: Fraction
    leaves: int
    nodes: int
    finished: bool
    witness: Array | None = None


def ranges(claim: OutOfReachClaim) -> Array:
    """(n, 2) rad in which joints may be, the locked one included: a full turn at most."""
    kept = claim.limits.copy()
    if claim.angle is not None:
        kept[claim.locked] = claim.angle
    turn = np.nextafter(np.pi, 4)
    kept[~claim.arm.prismatic & (kept[:, 1] - kept[:, 0] >= 2 * np.pi)] = -turn, turn
    return kept


def exclude(claim: OutOfReachClaim, halvings: int, seed: int, effort: Effort) -> Exclusion:
    """Search for a witness, then for a proof."""
    rng = np.random.default_rng(seed)
    found = _witness(claim, rng)
    if found is not None:
        return Exclusion([], b"\2", Fraction(1), 0, 1, True, found)
    chain, joints = Chain.of(claim.arm), ranges(claim)
    if claim.task.startswith("planar"):  # all of it happens in the plane
        chain = replace(chain, origins=chain.origins * [1, 1, 0])
    box, lemmas, tested, rows = np.vstack([joints, claim.box]), list[Lemma](), 0, Rows(claim, joints)
    place = claim.box[: rows.reach.linear]
    for link, point in points_on_axes(chain, joints, rng)[:_MOST_LEMMAS]:
        lemma, nodes = _lemma(chain, joints, place, link, point, effort.end, rng)
        tested += nodes
        if lemma is not None:
            lemmas.append(lemma)
            root, _ = _Apart(chain, lemmas, rows)(box.mean(axis=1)[None], np.diff(box).T / 2)
            if root[0] != OPEN:  # nothing more is needed
                break
    test = _Apart(chain, lemmas, rows)
    need_room(test, box, halvings, seed, "a smaller box, or a narrower interval of the lock, takes fewer")
    main = halved(test, box, halvings, effort)
    tree = main.tree
    used = [k for k in range(len(lemmas)) if LEMMA + k in tree]
    renamed = {LEMMA + k: LEMMA + new for new, k in enumerate(used)}
    kept = [lemmas[k] for k in used]
    return Exclusion(
        kept,
        tree.translate(bytes(renamed.get(token, token) for token in range(256))),
        main.undecided,
        main.leaves + sum(lemma.tree.count(0) for lemma in kept),
        main.nodes + tested,
        main.finished,
    )


class _Apart:
    """The test of boxes of configurations and targets: which lemma, or the tool itself, tells them apart."""

    def __init__(self, chain: Chain, lemmas: list[Lemma], rows: Rows) -> None:
        self.n, self.m, self.lemmas, self.rows = len(chain.lengths), rows.reach.linear, lemmas, rows
        self.parts = [Segment.of(chain, 0, lemma.link, lemma.point) for lemma in lemmas]

    def __call__(self, middle: Array, half: Array) -> tuple[Index, Array]:
        count, n = len(middle), self.n
        found, part, gain = np.full(count, OPEN, dtype=np.int64), np.full(count, -np.inf), np.zeros(half.shape)
        x, wide = np.zeros((count, 3)), np.zeros((count, 3))
        x[:, : self.m], wide[:, : self.m] = middle[:, n : n + self.m], half[:, n : n + self.m]

        def take(rows: Index, token: int, spare: Array, gap: Array, each: Array, joints: int) -> None:
            """What one test gives: by how much it excludes, how far apart the middles are, what each axis costs."""
            found[rows[spare > _MARGIN]] = token
            share = gap / np.maximum(gap - spare, 1e-12)  # 1: just excluded
            better = share > part[rows]
            rows, each = rows[better], each[better]
            part[rows], gain[rows] = share[better], 0.0
            more = each.shape[1] if joints == n else joints + self.m
            gain[rows, :joints], gain[rows, n : n + more - joints] = each[:, :joints], each[:, joints:more]

        for k, (lemma, segment) in enumerate(zip(self.lemmas, self.parts, strict=True)):
            rows = np.flatnonzero(found == OPEN)
            if not rows.size:
                break
            q, h = middle[rows, : lemma.link], half[rows, : lemma.link]
            bound, gap, each = segment.nearest(q, h, x[rows], wide[rows])
            take(rows, LEMMA + k, bound - lemma.most, gap - lemma.most, each, lemma.link)
            near = np.flatnonzero(np.linalg.norm(segment.frames(q)[0] - x[rows], axis=1) < lemma.least)
            if near.size:
                bound, gap, each = segment.farthest(q[near], h[near], x[rows[near]], wide[rows[near]])
                take(rows[near], LEMMA + k, lemma.least - bound, lemma.least - gap, each, lemma.link)
        rows = np.flatnonzero(found == OPEN)
        bound, gap, each = self.rows.nearest(middle[rows, :n], half[rows, :n], middle[rows, n:], half[rows, n:])
        take(rows, 0, bound, gap, each, n)
        return found, gain


def _lemma(
    chain: Chain, joints: Array, box: Array, link: int, point: Array, until: float, rng: np.random.Generator
) -> tuple[Lemma | None, int]:
    """A lemma about a point, as narrow as a few boxes prove, or None; and how many boxes were looked at."""
    n = len(joints)
    segment = Segment.of(chain, link, n, chain.origins[-1])
    least, most = _span(segment, joints[link:], point, rng)
    total = float(segment.lengths.sum() + np.linalg.norm(segment.origins, axis=1).sum() + np.linalg.norm(point))
    total += float(np.abs(joints[link:]).max(axis=1)[segment.slides].sum())
    margin = max(_NARROW[0] * (most - least), _NARROW[1] * total)
    asked = max(0.0, least - margin), most + margin
    if link == 0:  # where this alone excludes all targets, as wide as does
        away = np.maximum(np.maximum(box[:, 0] - point[: len(box)], point[: len(box)] - box[:, 1]), 0)
        far = np.maximum(np.abs(box[:, 0] - point[: len(box)]), np.abs(box[:, 1] - point[: len(box)]))
        low, high = float(np.linalg.norm(away)), float(np.linalg.norm(far))
        if low > most:
            asked = 0.0, low - min(1e-6, (low - most) / 10)
        elif high < least:
            asked = high + min(1e-6, (least - high) / 10), total
    still, tested = np.arange(n - link) < segment.on_axes(point), 0
    while margin < total:
        low, high = asked
        tree = Halving(joints[link:], _LEMMA_HALVINGS)
        finished = tree.run(
            partial(_kept, segment, point, still, low, high if high < total else np.inf), until, most=_LEMMA_NODES
        )
        tested += tree.tested
        if finished and not tree.undecided:
            useful = low > 0 or high < total
            return (Lemma(link, point, low, high, tree.in_order()) if useful else None), tested
        margin *= 3
        asked = max(0.0, least - margin), most + margin
    return None, tested


def _kept(
    segment: Segment, point: Array, still: NDArray[np.bool_], low: float, high: float, middle: Array, half: Array
) -> tuple[Index, Array]:
    """The test of boxes of joints: whether the end keeps from ``low`` to ``high`` from a point; some joints do not count."""
    half = np.where(still, 0.0, half)
    at, none = np.broadcast_to(point, (len(middle), 3)), np.zeros((len(middle), 3))
    found, gain = np.zeros(len(middle), dtype=np.int64), np.zeros(half.shape)
    for asked, bound, sign in ((high < np.inf, segment.farthest, 1.0), (low > 0, segment.nearest, -1.0)):
        if asked:
            distance, _, each = bound(middle, half, at, none)
            bad = sign * distance > sign * (high if sign > 0 else low) - _MARGIN
            found[bad] = OPEN
            gain[bad] += each[bad, : len(still)]
    return found, gain


def _span(segment: Segment, joints: Array, point: Array, rng: np.random.Generator) -> tuple[float, float]:
    """The least and greatest distance of the end from a point that were found, by random climbs from samples and corners."""
    low, high = joints.T
    shares = np.concatenate([rng.random((_SAMPLES, len(low))), rng.integers(0, 3, (_SAMPLES, len(low))) / 2])
    q, ends = low + (high - low) * shares, list[float]()
    for sign in (1.0, -1.0):
        value = sign * np.linalg.norm(segment.frames(q)[0] - point, axis=1)
        some = np.argsort(value)[:_CLIMBERS]
        at, best = q[some], value[some]
        for step in 0.3 * 0.8 ** np.arange(_CLIMBS):
            moved = np.clip(at + rng.normal(size=at.shape) * step * rng.integers(0, 2, at.shape), low, high)
            value = sign * np.linalg.norm(segment.frames(moved)[0] - point, axis=1)
            better = value < best
            at[better], best[better] = moved[better], value[better]
        ends.append(sign * float(best.min()))
    return ends[0], ends[1]


def _witness(claim: OutOfReachClaim, rng: np.random.Generator) -> Array | None:
    """A configuration within the claim whose tool is inside the box, or None."""
    joints = ranges(claim)
    reach = Reach(claim.arm, claim.task, claim.locked, joints, claim.rotation, claim.angle)
    targets = claim.box[:, 0] + np.diff(claim.box)[:, 0] * rng.uniform(0.1, 0.9, (2000, len(claim.box)))
    q = reach.solved(rng.uniform(joints[:, 0], joints[:, 1], (len(targets), claim.arm.n)), targets, 40)
    met = (reach.missed(q, targets) < _MET).all(axis=1)
    met &= ((q >= joints[:, 0] + _ROOM) & (q <= joints[:, 1] - _ROOM) | ~reach.free).all(axis=1)
    return q[met.argmax()] if met.any() else None
