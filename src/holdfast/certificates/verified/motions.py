"""Paths: after a lock at any instant, one continuous motion finishes the path of the tool.

The healthy motion goes along straight segments from knot to knot. Whole numbers count its instants, 2^20 to a segment. A slab
is an interval of lock instants; cells are intervals of the path, from the slab to the end. In a cell the error g is that of
the locked arm from the tool of the healthy one, which is a chain as well: its rotations enter E = R(q) R(qh)' backwards. As of
other claims, e(S) <= S says that for every lock instant of the slab and every point of the cell some s has g = 0. That alone
is no motion: what exists here may have nothing to do with what exists a little later. So three things more are shown.

Unique: where the slopes of g - s contract a box of half widths T, there is one such s in it, and it is a continuous function.
Glue: on the face between two cells, what the first one found lies in the box T of the second, so both have found the same.
Start: the configuration at the lock lies in the box T of the first cell, for every lock instant of the slab.

Where the locked arm is singular its motion is fast, as a square root is. So cells may be turned: their path is along the
tangent of the motion, and the place on the path of the tool is one more of what the section moves. Of such a cell is shown,
besides, that the place only goes forward in it, so that the motion is one of the tool along its path.

Joints that are left over follow: they go on with the healthy motion. A tube is met by six numbers more that the target is off
by: its place, and the axial part of its rotation, which below half a turn says all of it.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .balls import LEAST, UP, Balls, either, flint, joined, times
from .chain import Chain, exactly, turned
from .forms import real
from .paths import ROWS, SEGMENT, UNIT, Ints, Slab
from .rows import MOST_TURNED, STRAIGHT, Rows

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

AT_ONCE = 256  # cells
_WIDER = 0.25 * 0.5 ** np.arange(27)  # of section boxes, tried one after the other


class Faults:
    """What slabs of a path do not prove."""

    def __init__(self, document: dict[str, Any]) -> None:
        self._given, self.n = {key: value for key, value in document.items() if key != "locks"}, len(document["arm"]["joints"])
        self._given["locks"] = [lock | {"cells": "", "centres": ""} for lock in document["locks"]]
        self.rows = Rows({"task": document["task"], "target": {"axes": ROWS[document["task"]], "orientation": None}})
        self.m, self.linear, self.chain = (
            self.rows.m,
            self.rows.linear,
            Chain(document["arm"], document["task"] == "planar-pose"),
        )
        self.lengths, self._known = self.chain.lengths(0, self.n), dict[tuple[int, int], Array]()
        self.knots = np.array([[real(x) for x in knot] for knot in document["knots"]])
        self._exact = [[Fraction(x) for x in knot] for knot in self.knots.tolist()]
        self.limits = np.array([[real(x) for x in pair] for pair in document["limits"]])
        metres, radians = (real(x) for x in document["tube"])
        self.tube = np.array([metres] * self.linear + [radians] * (self.m - self.linear)) if metres or radians else np.empty(0)
        self.still = [[lock["joint"], *lock["followers"]] for lock in document["locks"]]

    def __reduce__(self) -> tuple[Any, ...]:  # to another process
        return Faults, (self._given,)

    def healthy(self, middles: Ints, ends: Ints) -> tuple[Array, Balls]:
        """Joints of the healthy motion at middles (twice the instants), as :func:`turned` has them (n, N, 5), and their rates.

        Rates are those over the segments of ends.
        """
        segment, found = (ends - 1) // SEGMENT, []
        for key in zip(segment.tolist(), middles.tolist(), strict=True):
            if key not in self._known:
                part = Fraction(key[1], 2 * SEGMENT) - key[0]
                pairs = zip(*self._exact[key[0] : key[0] + 2], strict=True)
                self._known[key] = np.array([turned(before + (after - before) * part) for before, after in pairs])
            found.append(self._known[key])
        return np.array(found).transpose(1, 0, 2), Balls(self.knots[segment + 1]) + -Balls(self.knots[segment])

    def section(self, slope: Array, rates: tuple[Balls, Balls], still: list[int], turned: Flags) -> tuple[Balls, Balls]:
        """D (N, 2n, 2 + tube + m), and how free joints, then the place on the path follow its columns (N, f + 1, ...).

        Any numbers will do. Of a turned cell the path is followed along the tangent of the locked arm's motion, and the place
        on it is one more of what the section moves.
        """
        count, tube, m, free = len(slope), len(self.tube), self.m, [k for k in range(self.n) if k not in still]
        locked, path = rates
        own = np.zeros((count, len(free) + 1, 2 + tube + m))
        own[:, -1, 1] = 1
        jacobian, drift = np.nan_to_num(slope[:, :, free]), np.nan_to_num(slope[:, :, still[0]] * locked.at[:, [still[0]]])
        ahead = np.einsum("nmk,nk->nm", slope[:, :, self.n :], path.at[:, ::-1])
        ahead = np.nan_to_num(ahead + np.einsum("nmk,nk->nm", slope[:, :, still[1:]], path.at[:, still[1:]]))
        good = np.abs(np.linalg.det(jacobian)) > 1e-12
        inverse = np.linalg.inv(np.where(good[:, None, None], jacobian, np.eye(m)))
        own[:, :-1, 2 + tube :] = inverse
        if tube:
            own[:, :-1, 2 : 2 + tube] = inverse
        own[:, :-1, :2] = -inverse @ np.stack([drift, ahead], axis=2)
        if turned.any():
            wide = np.concatenate([jacobian, ahead[:, :, None]], axis=2)[turned]
            tangent, across = np.linalg.svd(wide)[2][:, -1], np.linalg.pinv(wide)
            tangent *= np.where(tangent[:, -1:] < 0, -1.0, 1.0)
            beside = (tangent[:, :-1] * locked.at[turned][:, free]).sum(axis=1) + tangent[:, -1]
            own[turned, :, 0] = tangent * beside[:, None] - (across @ drift[turned][:, :, None])[:, :, 0]
            own[turned, :, 1] = tangent
            own[turned, :, 2:] = across
        at, off = (np.zeros((count, 2 * self.n, 2 + tube + m)) for _ in range(2))
        at[:, still[0], 0], off[:, still[0], 0] = locked.at[:, still[0]], locked.off[:, still[0]]
        at[:, free] = own[:, :-1]
        moved = times("nk,nc->nkc", path, Balls(own[:, -1]))
        at[:, still[1:]], off[:, still[1:]] = moved.at[:, still[1:]], moved.off[:, still[1:]]
        at[:, self.n :], off[:, self.n :] = moved.at[:, ::-1], moved.off[:, ::-1]
        return Balls(np.nan_to_num(at), off), Balls(np.nan_to_num(own))

    def slopes(self, parts: dict[str, Array], half: Array) -> Array:
        """(N, m, 1 + m) above the slopes of g - s by the path and by s."""
        last = [1, *range(half.shape[1] - self.m, half.shape[1])]
        far = np.einsum("nkc,nc->nk", parts["reach"], half) * UP
        slope = parts["slope"][:, :, last] + np.einsum("nabk,nk->nab", parts["second"][:, :, last], half)
        turned, slides = np.zeros(slope[:, 0].shape), self.chain.slides
        for chain, out in zip((slice(0, self.n), slice(None, self.n - 1, -1)), parts["out"].transpose(1, 0, 2), strict=True):
            way, by = far[:, chain], parts["reach"][:, chain][:, :, last]
            c, own = np.cumsum(way * ~slides, axis=1) * UP, np.cumsum(by * ~slides[:, None], axis=1) * UP
            slid = way * slides
            most = (self.lengths + abs(out) * slides + slid) * c**2 + 2 * c * slid
            third = np.einsum("nk,nkb->nb", most, own) + np.einsum("nk,nkb->nb", c**2, by * slides[:, None])
            slope[:, : self.linear] += third[:, None] / 2
            turned += own[:, -1]
        slope[:, self.linear :] += (turned * (far @ ~np.tile(slides, 2))[:, None] ** 2 / 2)[:, None]
        return np.asarray(slope * UP * UP + LEAST)

    def contracts(self, parts: dict[str, Array], w: Array, s: Array) -> Flags:
        """Whether s -> s - g moves any two points of the box nearer to each other."""
        slope = self.slopes(parts, np.concatenate([w[:, : -self.m], s], axis=1))[:, :, 1:]
        return np.asarray((np.einsum("nab,nb->na", slope, s) * UP + LEAST < 0.999 * s).all(axis=1))

    def forward(self, parts: dict[str, Array], w: Array, own: Balls, place: Array) -> Flags:
        """Whether turned cells only go forward on the path, and end within the segment; place (N,) from the end of that.

        As motions begin in it, they stay there. Where slopes by s are at most M, and by the path at most b, the solution moves
        by at most u if b + M u <= u.
        """
        slope = self.slopes(parts, w)
        b, inner = slope[:, :, 0], slope[:, :, 1:]
        u = np.linalg.solve(np.eye(self.m) - np.nan_to_num(inner), b[:, :, None])[:, :, 0] * 1.001 + 1e-12
        found = (u >= 0).all(axis=1) & ((b + np.einsum("nab,nb->na", inner, u) * UP) * UP + LEAST <= u).all(axis=1)
        slower = np.einsum("nb,nb->n", abs(own.at[:, -1, -self.m :]), u) * UP
        off = np.einsum("nc,nc->n", abs(own.at[:, -1]), w) * UP
        return np.asarray(found & (slower < own.at[:, -1, 1]) & (place + off * UP < 0))

    def excess(self, parts: dict[str, Array], w: Array) -> tuple[Array, Array, Array]:
        """e(S), how far joints go, and by how much they turn the tool; rounded up."""
        far = np.einsum("nkc,nc->nk", parts["reach"], w) * UP
        ways = zip((far[:, : self.n], far[:, : self.n - 1 : -1]), parts["out"].transpose(1, 0, 2), strict=True)
        (ours, turned), (theirs, moved) = (self.chain.third(way, self.lengths, out) for way, out in ways)
        third, angle = ours + theirs, (turned + moved) * UP
        rest = np.stack([third] * self.linear + [angle**3 / 6] * (self.m - self.linear), axis=1)
        rest += np.einsum("nac,nc->na", parts["slope"], w) + np.einsum("nacd,nc,nd->na", parts["mixed"], w, w)
        high, low = ((rest + np.einsum("nac,nc->na", parts[key], w**2) / 2) * UP for key in ("up", "down"))
        return np.nextafter(np.maximum(parts["over"] + high, parts["under"] + low), np.inf) + LEAST, far, angle

    def fine(self, batch: list[Slab]) -> list[Flags]:
        """Of each of the slabs of one lock, which of its cells go on with what the one before found."""
        still = self.still[batch[0][0]]
        free, tube, m = [k for k in range(self.n) if k not in still], len(self.tube), self.m
        counts = [len(rows) for *_, rows in batch]
        begin, stop = (np.repeat([ends[i] for _, ends, *_ in batch], counts) for i in (0, 1))
        starts, ends, width = np.concatenate([cells for *_, cells, _ in batch]).T
        first, turned = np.concatenate([np.arange(count) == 0 for count in counts]), width > 0
        locked, rate = self.healthy(begin + stop, stop)
        healthy, along = self.healthy(starts + ends, ends)
        joints = np.array([exactly(values) for values in (np.concatenate([rows for *_, rows in batch]) * UNIT).T])
        joints[still[0]], joints[still[1:]] = locked[still[0]], healthy[still[1:]]
        error, slopes, twice = self.rows.between(self.chain.moved(list(joints)), self.chain.moved(list(healthy)))
        straight = error.low[:, -1] > STRAIGHT if self.rows.rotated else True
        error, slopes, twice = (x[:, :m] for x in (error, slopes, twice))
        q = _values(joints)
        d, own = self.section(slopes.at, (rate, along), still, turned)
        ones = np.zeros((len(ends), m, 2 + tube + m))
        ones[:, :, 2 + tube :] = -np.eye(m)
        ones[:, :, 2 : 2 + tube] = -np.eye(m)[:, :tube]
        second = times("nki,nakj->naij", d, times("nakl,nlj->nakj", twice, d))
        bent = np.diagonal(second.at, axis1=2, axis2=3), np.diagonal(second.off, axis1=2, axis2=3)
        parts = {
            "over": np.nextafter(error.at + error.off, np.inf), "under": np.nextafter(error.off - error.at, np.inf),
            "slope": (times("nak,nkc->nac", slopes, d) + Balls(ones)).size, "second": second.size, "reach": d.size,
            "mixed": np.triu(second.size, 1), "up": np.maximum(bent[0] + bent[1], 0) * UP,
            "down": np.maximum(bent[1] - bent[0], 0) * UP,
            "out": np.stack([joints[:, :, 0].T, healthy[:, :, 0].T], 1),
        }  # fmt: skip
        w = np.zeros((len(ends), 2 + tube + m))
        w[:, 0], w[:, 2 : 2 + tube] = (stop - begin) / (2 * SEGMENT), self.tube
        w[:, 1] = np.where(turned, width * UNIT, (ends - starts) / (2 * SEGMENT))
        s = w[:, 2 + tube :]
        # 30 times wider until e(S) <= S; then 8 times narrower: as e grows with S, e(S) is such a box again.
        for i in range(39):
            e, far, angle = self.excess(parts, w)
            closed = np.asarray(((e <= s) & (s < 1e3)).all(axis=1))
            s[:] = np.where(closed[:, None], s if i < 30 or i == 38 else e, 1.05 * e + 1e-9)
        wide, unique = np.zeros_like(s), np.zeros(len(ends), dtype=bool)
        for size in _WIDER:
            t = np.where(unique[:, None], wide, s + size)
            unique |= self.contracts(parts, w, t)
            wide = np.where(unique[:, None], t, wide)
        low, high = np.nextafter(q.at - far[:, : self.n], -np.inf), np.nextafter(q.at + far[:, : self.n], np.inf)
        inside = ((low >= self.limits[:, 0]) & (high <= self.limits[:, 1]))[:, free].all(axis=1)
        good = closed & unique & inside & straight & ((angle < MOST_TURNED) | (not self.rows.rotated))
        middle = (starts + ends) / (2 * SEGMENT)
        if turned.any():
            some = {key: part[turned] for key, part in parts.items()}
            good[turned] &= self.forward(some, w[turned], own[turned], (middle - (ends - 1) // SEGMENT - 1)[turned])
        here, each = joined(q[:, free], Balls(middle[:, None])), Balls(np.ones((len(ends), 1)))
        lock = joined(_values(locked)[:, free], Balls((begin + stop)[:, None] / (2 * SEGMENT))), joined(rate[:, free], each)
        good &= self.glued(here, own, w, wide, lock, first, turned)
        return np.split(good, np.cumsum(counts)[:-1])

    def glued(
        self, here: Balls, own: Balls, w: Array, wide: Array, lock: tuple[Balls, Balls], first: Flags, turned: Flags
    ) -> Flags:
        """Whether what the cell before found, or the configuration at the lock, lies in the box in which there is one only.

        What is entered is a place of the free joints and on the path, as coordinates of the path and of the section.
        """
        m, kept = self.m, [0, *range(2, w.shape[1] - self.m)]
        there, before, earlier = _before(here), _before(own), np.roll(w, 1, axis=0)
        place = either(first, lock[0], there + times("nf,n->nf", before[:, :, 1], Balls(earlier[:, 1]))) + -here
        begun = Balls(np.zeros((*own.at.shape[:2], len(kept))))
        leaves = lock[1] + -own[:, :, 0]
        begun.at[:, :, 0], begun.off = leaves.at, np.repeat(leaves.off[:, :, None], len(kept), axis=2)
        spread = either(first, begun, before[:, :, kept] + -own[:, :, kept])
        found = either(first, Balls(np.zeros((*own.at.shape[:2], m))), before[:, :, -m:])
        matrix = own[:, :, [1, *range(-m, 0)]]
        good = abs(np.linalg.det(matrix.at)) > 0
        inverse = Balls(np.linalg.inv(np.where(good[:, None, None], matrix.at, np.eye(m + 1))))
        off = (times("nab,nbc->nac", inverse, matrix) + Balls(np.broadcast_to(-np.eye(m + 1), matrix.at.shape))).size
        # Between cells that are not turned this is on a face, exactly, and the diagonal where motions begin is in the cell.
        face = ~turned & (first | ~np.roll(turned, 1))
        room = np.concatenate([np.where(face, w[:, 1] * (1 + 1e-6) + 1e-12, w[:, 1])[:, None], wide], axis=1)
        most = times("nab,nb->na", inverse, place).size + np.einsum("nab,nb->na", off, room)
        most += np.einsum("nac,nc->na", times("nab,nbc->nac", inverse, spread).size, w[:, kept])
        most += np.einsum("nac,nc->na", times("nab,nbc->nac", inverse, found).size, earlier[:, -m:])
        return np.asarray(((most * UP + LEAST) < room).all(axis=1))

    def rejected(self, chunk: list[Slab]) -> tuple[int, list[tuple[Slab, int]]]:
        """How many cells were checked, and slabs that prove nothing, each with how many of its cells are bad."""
        bad, waiting = list[tuple[Slab, int]](), list[Slab]()
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for k, slab in enumerate(chunk):
                waiting.append(slab)
                full = sum(len(rows) for *_, rows in waiting) >= AT_ONCE
                if full or k + 1 == len(chunk) or chunk[k + 1][0] != slab[0]:
                    found = zip(waiting, self.fine(waiting), strict=True)
                    bad += [(one, int((~good).sum())) for one, good in found if not good.all()]
                    waiting = []
        return sum(len(rows) for *_, rows in chunk), bad


def _before(x: Balls) -> Balls:
    """Of the cell before."""
    return Balls(np.roll(x.at, 1, axis=0), np.roll(x.off, 1, axis=0))


def _values(joints: Array) -> Balls:
    """(N, n) of joints as :func:`turned` has them (n, N, 5)."""
    return Balls(joints[:, :, 0].T, joints[:, :, 1].T)
