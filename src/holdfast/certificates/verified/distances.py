"""The leaves of a refutation: whichever configuration of the arm, the tool is not where the target is.

In each leaf some combination of the task's rows is not 0; or a point of some link is farther from the target than the tool can
be from this point, or nearer. How far that is, is a lemma, with a tree of its own over the joints behind the link. All of it is
bounded by exact derivatives at the centre, and a bound for the third.

Where the tool is given, base, joints, tool and base again are a ring. Two points of links are as far from each other by the
joints between them as by the others, on the way round by the tool and the base; a leaf excludes where that cannot be.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .balls import UP, Balls, crossed, flint, length, stacked, times
from .boxes import Boxes, bent
from .chain import Array, Moved, turned
from .forms import UNIT, need, real
from .paths import SEGMENT, Never
from .rows import Rows, point_derivatives
from .targets import Leaves
from .tree import Cell


class Distances(Boxes):
    """How far points are from each other, over boxes of joints and targets."""

    def nearest(self, form: tuple[Balls, Balls, Balls], third: tuple[Array, Array], half: Array, wide: Array) -> Array:
        """Below the length of the rows: along a direction e, of length 1 at most, whichever it is; some are tried.

        The form are rows, slopes and second derivatives; the first rows may be off by ``wide`` (N, r) as well. Of these, and of
        the others, ``third`` (N,) is what is left.
        """
        (error, slopes, second), linear = form, wide.shape[1]
        swept, one = slopes.at * half[:, None], np.eye(error.at.shape[1])
        spread = swept @ swept.transpose(0, 2, 1) + (1e-6 * (error.at**2).sum(axis=1) + 1e-30)[:, None, None] * one
        spread[:, range(linear), range(linear)] += wide**2
        steep = np.linalg.solve(np.nan_to_num(spread) + 1e-30 * one, error.at[:, :, None])[:, :, 0]
        best, of_place = np.full(len(error.at), -np.inf), np.arange(len(one)) < linear
        for along in (error.at, steep, *([error.at * of_place, error.at * ~of_place] if linear < len(one) else [])):
            e = along / np.sqrt((along**2).sum(axis=1))[:, None] * (1 - 1e-12)
            e = Balls(np.where(((e**2).sum(axis=1) < 1 - 1e-13)[:, None], e, 0.0))
            loss = bent(times("na,nak->nk", e, slopes).size, times("na,najk->njk", e, second), half)
            loss += (abs(e.at[:, :linear]) * wide).sum(axis=1)
            loss += length(e.at[:, :linear]) * third[0] + length(e.at[:, linear:]) * third[1]
            best = np.maximum(best, np.nextafter(times("na,na->n", e, error).low - loss * UP, -np.inf))
        return best

    def farthest(self, v: Balls, moved: Moved, carried: tuple[Array, ...], half: Array, wide: Array) -> Array:
        """Above the length of v, of a point from what is within ``wide`` (N, 3) of a place, from half its square.

        The third derivative of that is at most 3 |t'| |t''| + |t| times the point's.
        """
        joints = half.shape[1]
        back = np.broadcast_to(-np.eye(3), (len(half), 3, 3))
        columns, twice = point_derivatives(moved.spin, moved.columns)
        whole = Balls(np.concatenate([columns.at, back], axis=2), np.concatenate([columns.off, 0 * back], axis=2))
        bend, second = times("na,najk->njk", v, twice), times("naj,nak->njk", whole, whole)
        second.off = second.off.copy()
        inner = second[:, :joints, :joints] + bend
        second.at[:, :joints, :joints], second.off[:, :joints, :joints] = inner.at, inner.off
        width, d = np.concatenate([half, wide], axis=1), length(v.size)
        one, two, three = carried
        one = one + length(wide)
        total = bent(times("na,nak->nk", v, whole).size, -second, width) + (3 * one * two + (d + one) * three) / 6
        return np.asarray(np.nextafter(np.sqrt((d**2 + 2 * total) * UP), np.inf))

    def span(
        self, moved: Moved, away: Balls, lengths: Array, half: Array, wide: Array, at: tuple[int, list[Array]]
    ) -> tuple[Array, Array]:
        """Below and above the distance of a point of a link, ``away`` (N, 3) from what is within ``wide`` of a place.

        ``at``: the first joint, and the joints, whose values count where they slide.
        """
        slides = self.slides[at[0] : at[0] + len(at[1])]
        c, slid = np.cumsum(half * ~slides, axis=1), half * slides
        out = np.stack([joint[:, 0] for joint in at[1]], 1) if at[1] else half
        most = lengths + np.abs(out) * slides + slid
        carried = tuple((c**k * most + k * c ** (k - 1) * slid).sum(axis=1) for k in (1, 2, 3))  # above three derivatives
        third = carried[2] / 6, np.zeros(len(half))
        near = self.nearest((away, *point_derivatives(moved.spin, moved.columns)), third, half, wide)
        return near, self.farthest(away, moved, carried, half, wide)

    def apart(self, joints: list[Array], first: int, start: Array, end: Array, count: int) -> tuple[Array, Array]:
        """Below and above the distance of a point of link ``first`` from one behind some joints, (N,)."""
        point, moved = Balls(np.broadcast_to(start, (count, 3))), self.moved(joints, first, end, count)
        half = np.stack([joint[:, 2] for joint in joints], 1) if joints else np.zeros((count, 0))
        # Where the first axes pass by the point at a distance, turning about these changes the other's by so much at most.
        aside, still = np.zeros(count), np.ones(count, dtype=bool)
        by = times("nkij,nkj->nki", crossed(moved.axes), point[:, None] + -moved.places).size
        for k in range(len(joints)):
            cost = half[:, k] if self.slides[first + k] else length(by[:, k]) * np.minimum(half[:, k], 2) * UP
            still &= cost < 1e-6
            half[:, k], aside = np.where(still, 0.0, half[:, k]), (aside + np.where(still, cost, 0.0)) * UP
        lengths = self.lengths(first, first + len(joints), end)
        near, far = self.span(moved, moved.tip + -point, lengths, half, np.zeros((count, 3)), (first, joints))
        return np.nextafter(near - aside, -np.inf), np.nextafter(far + aside, np.inf)


class Apart(Distances):
    """The leaves of a refutation: the tool is not where the target is."""

    def __init__(self, document: dict[str, Any]) -> None:
        self._given, self.rows = document | {"tree": ""}, Rows(document)
        limits, target, lemmas = list(document["limits"]), document["target"], document["lemmas"]
        if document["locked"] >= 0:
            limits[document["locked"]] = document["angle"]
        ends = within_a_turn([[real(x) for x in pair] for pair in limits], document["arm"]["joints"])
        self.axes = len(target["axes"])
        flat = document["task"].startswith("planar")
        super().__init__(document["arm"], [*ends, *([real(x) for x in pair] for pair in target["box"])], flat)
        self.points = [np.array([real(x) for x in lemma["point"]]) * [1, 1, not flat] for lemma in lemmas]
        self.links = [lemma["link"] for lemma in lemmas]
        self.least, self.most = ([real(lemma[key]) for lemma in lemmas] for key in ("least", "most"))

    def __reduce__(self) -> tuple[Any, ...]:
        return Apart, (self._given,)

    def excluded(self, which: int, parts: list[Cell]) -> NDArray[np.bool_]:
        """Of leaves of the tree: by a lemma, or by none (-1), in which case some combination of the rows must not be 0."""
        last, end = (self.links[which], self.points[which]) if which >= 0 else (self.n, None)
        joints = [self.middles(k, parts) for k in range(last)]
        target = [self.middles(self.n + a, parts) for a in range(self.axes)]
        linear, half = self.rows.linear, np.stack([x[:, 2] for x in (*joints, *target)], 1)
        moved, own, wide = self.moved(joints, 0, end, len(parts)), half[:, :last], half[:, last : last + linear]
        lengths = self.lengths(0, last, end)
        if which < 0:
            out = np.stack([x[:, 0] for x in joints], 1)
            third, angle = self.third(own, lengths, out)
            angle = angle + half[:, last + linear :].sum(axis=1)
            turns = np.concatenate([own, half[:, last + linear :]], axis=1)
            return self.nearest(self.rows.error(moved, target), (third, angle**3 / 6), turns, wide) > 0
        flat = [np.zeros((len(parts), 5))] * (3 - linear)
        away = moved.tip + stacked([Balls(-x[:, 0], x[:, 1]) for x in (*target[:linear], *flat)], 1)
        near, far = self.span(moved, away, lengths, own, np.pad(wide, ((0, 0), (0, 3 - linear))), (0, joints))
        return np.asarray((near > self.most[which]) | (far < self.least[which]))

    def keeps(self, which: int, parts: list[Cell]) -> NDArray[np.bool_]:
        """Of leaves of a lemma: whether the tool keeps its distance from the point."""
        first = self.links[which]
        joints = [self.middles(k, [(*[(0, 0)] * first, *cell) for cell in parts]) for k in range(first, self.n)]
        near, far = self.apart(joints, first, self.points[which], self.origins[-1], len(parts))
        return np.asarray(((near >= self.least[which]) | (self.least[which] <= 0)) & (far <= self.most[which]))

    def holds(self, witness: list[str]) -> bool:
        """Whether a configuration is one of those that are meant, and its tool in the box of targets."""
        q, given = [real(x) for x in witness], self._given
        ranges = [given["angle"] if k == given["locked"] else pair for k, pair in enumerate(given["limits"])]
        within = all(real(pair[0]) <= x <= real(pair[1]) for x, pair in zip(q, ranges, strict=True))
        tip = self.moved(self.at(witness)).tip
        sides = [[real(x) for x in pair] for pair in given["target"]["box"]]
        low, high = tip.low[0], -(-tip).low[0]
        inside = all(a <= x and y <= b for (a, b), x, y in zip(sides, low, high, strict=False)) and not self.rows.rotated
        return within and (inside or self._near(q, tip.at[0], sides))

    def _near(self, q: list[float], tip: Array, sides: list[list[float]]) -> bool:
        """Whether a configuration near one, with the same locked value, reaches a target of the box: that is a reach's leaf."""
        where = [min(max(x, low), high) for x, (low, high) in zip(tip.tolist()[: self.rows.linear], sides, strict=False)]
        where += [(low + high) / 2 for low, high in sides[self.rows.linear :]]
        given = self._given | {"target": self._given["target"] | {"box": [[x.hex(), x.hex()] for x in where]}}
        if given["locked"] >= 0:
            given["angle"] = [q[given["locked"]].hex()] * 2
        leaves = Leaves(given)
        counts = np.where([k in leaves.free for k in range(self.n)], np.array(q) / UNIT, 0.0)
        return not leaves.rejected([(((0, 0),) * len(leaves.width), counts)])[1]

    def rejected(self, chunk: list[tuple[Cell, tuple[int, int]]]) -> tuple[int, list[tuple[Cell, tuple[int, int]]]]:
        """How many leaves were checked, and which of them prove nothing; each with its tree, -1 the main one, and its lemma."""
        bad = list[tuple[Cell, tuple[int, int]]]()
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for kind in sorted({kind for _, kind in chunk}):
                parts = [cell for cell, other in chunk if other == kind]
                good = self.excluded(kind[1], parts) if kind[0] < 0 else self.keeps(kind[0], parts)
                bad += [(cell, kind) for cell, fine in zip(parts, good, strict=True) if not fine]
        return len(chunk), bad


class Ring(Distances):
    """That with joints in ranges of theirs no configuration has the tool where it is with all of them at other values.

    ``turns``: whether its rotation is given as well; else the later one of two points must be the tool point.
    """

    def __init__(self, arm: dict[str, Any], ranges: list[Any], *, tool: list[Fraction], turns: bool, flat: bool) -> None:
        super().__init__(arm, within_a_turn(ranges, arm["joints"]), flat)
        self.joints, self.turns_too, self.tip, self._kept = self.n, turns, self.origins[-1], np.array([1, 1, not flat])
        at = self.moved([np.array([turned(x)]) for x in tool])
        # From the tool back to the base: where that is seen from the last link, and how turned.
        turn = times("ij,jk->ik", self.turns[-1], at.turn[0].transposed(1, 0))
        self._base = Balls(self.origins[-1]) + -times("ij,j->i", turn, at.tip[0]), turn
        begin = self._seen(self.origins[0])
        self.origins = [*self.origins[:-1], begin.at, *self.origins[1:]]
        self.turns = [*self.turns[:-1], times("ij,jk->ik", turn, self.turns[0]), *self.turns[1:]]
        self.slides, self.n, self._off = np.tile(self.slides, 2), 2 * self.n, begin.off

    def _seen(self, place: Array) -> Balls:
        """A place of the base, from the last link."""
        return self._base[0] + times("ij,j->i", self._base[1], Balls(place))

    def excludes(self, pair: list[tuple[int, Array]], cells: list[Cell]) -> NDArray[np.bool_]:
        """Of leaves: whether two points, each (link, (3,) m in its frame), are never so far apart on both ways round."""
        (first, a), (last, b) = ((link, place * self._kept) for link, place in pair)
        known = self.turns_too or (last == self.joints and (b == self.tip).all())
        need(first <= last and known, "a point is behind the one it is paired with, or its place is not known")
        joints, count = [self.middles(k, cells) for k in range(self.joints)], len(cells)
        near, far = self.apart(joints[first:last], first, a, b, count)
        end = Balls(a) if first else self._seen(a)
        low, high = self.apart(joints[last:] + joints[:first], last, b, end.at, count)
        off = length(self._off + end.off, 0) * 2
        return np.asarray((near > (high + off) * UP) | (far < low - off * UP))


class Unfinished:
    """Lock instants of a path after which no configuration has the tool where it must be, at some later place."""

    def __init__(self, document: dict[str, Any]) -> None:
        self._given, self._knots = document, [[Fraction(real(x)) for x in knot] for knot in document["knots"]]
        self._points = [(point["link"], np.array([real(x) for x in point["place"]])) for point in document["points"]]

    def __reduce__(self) -> tuple[Any, ...]:
        return Unfinished, (self._given,)

    def _healthy(self, instant: int) -> list[Fraction]:
        k = max(instant - 1, 0) // SEGMENT
        part = Fraction(instant, SEGMENT) - k
        return [a + (b - a) * part for a, b in zip(*self._knots[k : k + 2], strict=True)]

    def rejected(self, chunk: list[Never]) -> tuple[int, list[tuple[Never, int]]]:
        """How many leaves were checked, and what is not refuted, each with how many of its leaves are bad."""
        bad, task = list[tuple[Never, int]](), self._given["task"]
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for one in chunk:
                which, ends, at, leaves = one
                lock, ranges = self._given["locks"][which], [[real(x) for x in pair] for pair in self._given["limits"]]
                ranges[lock["joint"]] = sorted(self._healthy(instant)[lock["joint"]] for instant in ends)
                ring = Ring(
                    self._given["arm"], ranges, tool=self._healthy(at), turns="pose" in task, flat=task.startswith("planar")
                )
                good = 0
                for token in sorted({token for token, _ in leaves}):
                    pair = [self._points[k] for k in self._given["pairs"][token]]
                    good += int(ring.excludes(pair, [cell for other, cell in leaves if other == token]).sum())
                bad += [(one, len(leaves) - good)] * (good < len(leaves))
        return sum(len(leaves) for *_, leaves in chunk), bad


def within_a_turn(ranges: list[Any], joints: list[dict[str, Any]]) -> list[Any]:
    """Ranges (low, high) of joints, of those that turn a full turn at most."""
    full = math.nextafter(math.pi, 4)
    for (low, high), joint in zip(ranges, joints, strict=True):
        need(joint["type"] == "revolute" or math.isfinite(high - low), f"{joint['name']} slides without an end")
    turns = [
        joint["type"] == "revolute" and not high - low < 2 * math.pi for (low, high), joint in zip(ranges, joints, strict=True)
    ]
    return [[-full, full] if turn else pair for turn, pair in zip(turns, ranges, strict=True)]
