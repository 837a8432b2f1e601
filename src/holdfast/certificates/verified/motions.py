"""Paths: after a lock at any instant, one continuous motion finishes the path of the tool.

The healthy motion goes along straight segments from knot to knot. Whole numbers count its instants, 2^20 to a segment. A slab
is an interval of lock instants; cells are intervals of the path, from the slab to the end. In a cell the error g is that of
the locked arm from the tool of the healthy one, which is a chain as well: its rotations enter E = R(q) R(qh)' backwards. As of
other claims, e(S) <= S says that for every lock instant of the slab and every point of the cell some s has g = 0. That alone
is no motion: what exists here may have nothing to do with what exists a little later. So three things more are shown.

Unique: where the slopes of g - s contract a box of half widths T, there is one such s in it, and it is a continuous function.
Glue: on the face between two cells, what the first one found lies in the box T of the second, so both have found the same.
Start: the configuration at the lock lies in the box T of the first cell, for every lock instant of the slab.

Joints that are left over follow: they go on with the healthy motion. A tube is met by six numbers more that the target is off
by: its place, and the axial part of its rotation, which below half a turn says all of it.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .balls import LEAST, UP, Balls, above, crossed, defect, flint, joined, stacked, times
from .forms import real
from .paths import ROWS, SEGMENT, UNIT, Ints, Slab

Array = NDArray[np.float64]

AT_ONCE = 256  # cells
_WIDER = 0.25 * 0.5 ** np.arange(27)  # of section boxes, tried one after the other


class Faults:
    """What slabs of a path do not prove."""

    def __init__(self, document: dict[str, Any]) -> None:
        self._given, self.n = {key: value for key, value in document.items() if key != "locks"}, len(document["arm"]["joints"])
        self._given["locks"] = [lock | {"cells": "", "centres": ""} for lock in document["locks"]]
        self.rows, frames = ROWS[document["task"]], [*document["arm"]["joints"], document["arm"]["tool"]]
        self.m, self.linear = len(self.rows), min(3, len(self.rows))
        self.origins = [np.array([real(x) for x in frame["origin"]]) for frame in frames]
        numbers = [frame["rotation"] for frame in frames]
        self.turns = [Balls(np.reshape([real(x) for x in given], (3, 3)), defect(given)) for given in numbers]
        self.knots = np.array([[real(x) for x in knot] for knot in document["knots"]])
        self.limits = np.array([[real(x) for x in pair] for pair in document["limits"]])
        metres, radians = (real(x) for x in document["tube"])
        self.tube = np.array([metres] * self.linear + [radians] * (self.m - self.linear)) if metres or radians else np.empty(0)
        self.still = [[lock["joint"], *lock["followers"]] for lock in document["locks"]]
        # What joints 1 to k turn and joint k + 1 does not: the part of link k across its axis, and that of the next along it.
        self.lengths = np.zeros(self.n)
        for k in range(self.n):
            whole = Balls(self.origins[k + 1] * [1, 1, 0])
            if k + 1 < self.n:
                whole += times("ij,j->i", self.turns[k + 1], Balls(self.origins[k + 2] * [0, 0, 1]))
            self.lengths[k] = math.hypot(*whole.size) * UP

    def __reduce__(self) -> tuple[Any, ...]:  # to another process
        return Faults, (self._given,)

    def healthy(self, middles: Ints, ends: Ints) -> tuple[Balls, Balls]:
        """Joints of the healthy motion at middles (twice the instants), and their rates over the segments of ends."""
        segment = (ends - 1) // SEGMENT
        before, after = Balls(self.knots[segment]), Balls(self.knots[segment + 1])
        rates, part = after + -before, middles / (2 * SEGMENT) - segment  # exact: 15 and 21 binary places
        return before + times("nj,n->nj", rates, Balls(part)), rates

    def turned(self, q: Balls) -> tuple[Array, Array, float]:
        """Sines and cosines, and how far off they are at most."""
        sines, cosines, off = np.zeros(q.at.shape), np.zeros(q.at.shape), 0.0
        for index, value in np.ndenumerate(q.at):
            sine, cosine = flint.arb(float(value), float(q.off[index])).sin_cos()
            sines[index], cosines[index] = float(sine.mid()), float(cosine.mid())
            off = max(off, above(sine.rad()), above(cosine.rad()))
        return sines, cosines, off * UP + 2.0**-52

    def moved(self, q: Balls) -> tuple[Balls, Balls, Balls, Balls]:
        """Place and rotation of the tool, the joints' axes, and the derivatives of the place by the joints."""
        count, (sines, cosines, off) = len(q.at), self.turned(q)
        tip, turn = Balls(np.zeros((count, 3))), Balls(np.broadcast_to(np.eye(3), (count, 3, 3)))
        axes, places = [], []
        for k in range(self.n):
            tip, turn = tip + times("nij,j->ni", turn, Balls(self.origins[k])), times("nij,jk->nik", turn, self.turns[k])
            axes.append(turn[:, :, 2])
            places.append(tip)
            about = np.zeros((count, 3, 3))
            about[:, 0, 0] = about[:, 1, 1] = cosines[:, k]
            about[:, 1, 0], about[:, 0, 1], about[:, 2, 2] = sines[:, k], -sines[:, k], 1
            turn = times("nij,njk->nik", turn, Balls(about, off))
        tip += times("nij,j->ni", turn, Balls(self.origins[-1]))
        z = stacked(axes, 1)
        columns = times("nkij,nkj->nki", crossed(z), tip[:, None] + -stacked(places, 1))
        return tip, times("nij,jk->nik", turn, self.turns[-1]), z, columns

    def expanded(self, q: Balls, healthy: Balls) -> tuple[Balls, Balls, Balls]:
        """Error (N, m), its derivatives (N, m, 2n) by joints of the arm, then of the healthy one backwards, and second ones."""
        n, (tip, turn, z, columns) = self.n, self.moved(q)
        goal, wanted, axes, slopes = self.moved(healthy)
        error, first = tip + -goal, _beside(columns, -slopes[:, ::-1])
        second = _blocks(_pairs(z, columns), -_pairs(axes, slopes)[:, :, ::-1, ::-1])
        if self.m > 3:
            off = times("nij,nkj->nik", turn, wanted)
            back = -times("nij,nkj->nki", off, axes)[:, ::-1]
            every = Balls(np.concatenate([z.at, back.at], 1), np.concatenate([z.off, back.off], 1))
            vee = stacked([(off[:, 2, 1] + -off[:, 1, 2]), off[:, 0, 2] + -off[:, 2, 0], off[:, 1, 0] + -off[:, 0, 1]], 1)
            straight = np.trace(off.at, axis1=1, axis2=2) - np.trace(off.off, axis1=1, axis2=2) > 2.9
            error = joined(error, Balls(np.where(straight[:, None], vee.at / 2, np.nan), vee.off / 2))
            first = _under(first, times("nri,nji->nrj", _axial(off[:, None])[:, 0], every))
            # The second derivative by a and a later b is vee [a][b] E.
            later = _axial(times("nkij,njl->nkil", crossed(every), off))
            twice = times("nkri,nji->nrjk", later, every)
            upper = np.triu(np.ones((2 * n, 2 * n)))
            second = _under(second, _mirrored(twice, upper))
        return error[:, : self.m], first[:, : self.m], second[:, : self.m]

    def section(self, slope: Array, rates: tuple[Balls, Balls], still: list[int]) -> tuple[Balls, Array]:
        """D (N, 2n, 2 + tube + m), of which rows of free joints may be any numbers, and an inverse of their last columns."""
        count, tube = len(slope), len(self.tube)
        free = [k for k in range(self.n) if k not in still]
        locked, path = rates
        at, off = (np.zeros((count, 2 * self.n, 2 + tube + self.m)) for _ in range(2))
        at[:, still[0], 0], off[:, still[0], 0] = locked.at[:, still[0]], locked.off[:, still[0]]
        for k in still[1:]:
            at[:, k, 1], off[:, k, 1] = path.at[:, k], path.off[:, k]
        at[:, self.n :, 1], off[:, self.n :, 1] = path.at[:, ::-1], path.off[:, ::-1]
        jacobian = np.nan_to_num(slope[:, :, free])
        good = np.abs(np.linalg.det(jacobian)) > 1e-12
        inverse = np.linalg.inv(np.where(good[:, None, None], jacobian, np.eye(self.m)))
        at[:, free, 2 + tube :] = inverse
        if tube:
            at[:, free, 2 : 2 + tube] = inverse
        at[:, free, :2] = -np.einsum("nfm,nmk,nkc->nfc", inverse, slope, at[:, :, :2])
        return Balls(np.nan_to_num(at), off), jacobian

    def contracts(self, parts: dict[str, Array], w: Array, s: Array) -> NDArray[np.bool_]:
        """Whether s -> s - g moves any two points of the box nearer to each other."""
        last = w.shape[1] - self.m
        half = np.concatenate([w[:, :last], s], axis=1)
        far = np.einsum("nkc,nc->nk", parts["reach"], half) * UP
        c = np.cumsum(far[:, : self.n], axis=1) * UP
        own = np.cumsum(parts["reach"][:, : self.n, last:], axis=1) * UP
        third = np.einsum("k,nkb,nk->nb", self.lengths, own, c**2) / 2
        slope = parts["slope"][:, :, last:] + np.einsum("nabk,nk->nab", parts["second"][:, :, last:], half)
        slope[:, : self.linear] += third[:, None]
        if self.m > 3:
            slope[:, 3:] += (own[:, -1] * (far.sum(axis=1) ** 2)[:, None] / 2)[:, None]
        moved = np.einsum("nab,nb->na", slope, s) * UP * UP + LEAST
        return np.asarray((moved < 0.999 * s).all(axis=1))

    def excess(self, parts: dict[str, Array], w: Array) -> tuple[Array, Array, Array]:
        """e(S), how far joints go, and by how much they turn the tool; rounded up."""
        far = np.einsum("nkc,nc->nk", parts["reach"], w) * UP
        ours, theirs = (np.cumsum(x, axis=1) * UP for x in (far[:, : self.n], far[:, : self.n - 1 : -1]))
        angle = (ours[:, -1] + theirs[:, -1]) * UP
        third = ((ours**3 + theirs**3) * self.lengths).sum(axis=1) / 6
        rest = np.stack([third] * self.linear + [angle**3 / 6] * (self.m - self.linear), axis=1)
        rest += np.einsum("nac,nc->na", parts["slope"], w) + np.einsum("nacd,nc,nd->na", parts["mixed"], w, w)
        high, low = ((rest + np.einsum("nac,nc->na", parts[key], w**2) / 2) * UP for key in ("up", "down"))
        return np.nextafter(np.maximum(parts["over"] + high, parts["under"] + low), np.inf) + LEAST, far, angle

    def fine(self, batch: list[Slab]) -> list[NDArray[np.bool_]]:
        """Of each of the slabs of one lock, which of its cells go on with what the one before found."""
        still = self.still[batch[0][0]]
        free, tube, m = [k for k in range(self.n) if k not in still], len(self.tube), self.m
        counts = [len(rows) for _, _, rows in batch]
        begin, stop = (np.repeat([one[i] for _, one, _ in batch], counts) for i in (0, 1))
        ends = np.concatenate([one[2:] for _, one, _ in batch])
        first = np.concatenate([np.arange(count) == 0 for count in counts])
        starts = np.where(first, begin, np.roll(ends, 1))
        locked, rate = self.healthy(begin + stop, stop)
        healthy, along = self.healthy(starts + ends, ends)
        at, off = np.concatenate([rows for _, _, rows in batch]) * UNIT, np.zeros((len(ends), self.n))
        at[:, still[0]], off[:, still[0]] = locked.at[:, still[0]], locked.off[:, still[0]]
        at[:, still[1:]], off[:, still[1:]] = healthy.at[:, still[1:]], healthy.off[:, still[1:]]
        q = Balls(at, off)
        error, slopes, twice = self.expanded(q, healthy)
        d, jacobian = self.section(slopes.at, (rate, along), still)
        ones = np.zeros((len(ends), m, 2 + tube + m))
        ones[:, :, 2 + tube :] = -np.eye(m)
        ones[:, :, 2 : 2 + tube] = -np.eye(m)[:, :tube]
        second = times("nki,nakj->naij", d, times("nakl,nlj->nakj", twice, d))
        own = np.diagonal(second.at, axis1=2, axis2=3), np.diagonal(second.off, axis1=2, axis2=3)
        parts = {
            "over": np.nextafter(error.at + error.off, np.inf), "under": np.nextafter(error.off - error.at, np.inf),
            "slope": (times("nak,nkc->nac", slopes, d) + Balls(ones)).size, "second": second.size, "reach": d.size,
            "mixed": np.triu(second.size, 1), "up": np.maximum(own[0] + own[1], 0) * UP,
            "down": np.maximum(own[1] - own[0], 0) * UP,
        }  # fmt: skip
        w = np.zeros((len(ends), 2 + tube + m))
        w[:, 0], w[:, 1], w[:, 2 : 2 + tube] = (stop - begin) / (2 * SEGMENT), (ends - starts) / (2 * SEGMENT), self.tube
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
        good = closed & unique & inside & (angle < 1.2)
        good &= self.glued(q, d, jacobian, w, wide, (locked, rate), begin + stop - starts - ends, first, free)
        return np.split(good, np.cumsum(counts)[:-1])

    def glued(
        self, q: Balls, d: Balls, jacobian: Array, w: Array, wide: Array, lock: tuple[Balls, Balls], ahead: Ints,
        first: NDArray[np.bool_], free: list[int],
    ) -> NDArray[np.bool_]:  # fmt: skip
        """Whether what the cell before found, or the configuration at the lock, lies in the box in which there is one only."""
        m, tube = self.m, len(self.tube)
        own = d[:, free]
        before = Balls(np.roll(own.at, 1, axis=0), np.roll(own.off, 1, axis=0))
        half = Balls(w[:, 1])
        earlier = Balls(np.roll(w[:, 1], 1))
        there = Balls(np.roll(q.at, 1, axis=0), np.roll(q.off, 1, axis=0))[:, free]
        face = there + -q[:, free] + times("nf,n->nf", before[:, :, 1], earlier) + times("nf,n->nf", own[:, :, 1], half)
        spread = before[:, :, : 2 + tube] + -own[:, :, : 2 + tube]
        started, rate = lock[0][:, free], lock[1][:, free]
        begun = started + -q[:, free] + -times("nf,n->nf", own[:, :, 1], Balls(ahead / (2 * SEGMENT)))
        leaves = rate + -own[:, :, 0] + -own[:, :, 1]
        inverse = Balls(jacobian)
        off = (
            times("naf,nfb->nab", inverse, own[:, :, 2 + tube :]) + Balls(np.broadcast_to(-np.eye(m), (len(wide), m, m)))
        ).size
        carried = times("naf,nfc->nac", inverse, before[:, :, 2 + tube :]).size
        sides = times("naf,nfc->nac", inverse, spread).size
        kept = [0, *range(2, 2 + tube)]
        glue = times("naf,nf->na", inverse, face).size + np.einsum("nac,nc->na", sides[:, :, kept], w[:, kept])
        glue += np.einsum("nac,nc->na", carried, np.roll(w[:, 2 + tube :], 1, axis=0))
        start = times("naf,nf->na", inverse, begun).size + times("naf,nf->na", inverse, leaves).size * w[:, :1]
        most = np.where(first[:, None], start, glue) + np.einsum("nab,nb->na", off, wide)
        return np.asarray(((most * UP + LEAST) < wide).all(axis=1))

    def rejected(self, chunk: list[Slab]) -> tuple[int, list[tuple[Slab, int]]]:
        """How many cells were checked, and slabs that prove nothing, each with how many of its cells are bad."""
        bad, waiting = list[tuple[Slab, int]](), list[Slab]()
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for k, slab in enumerate(chunk):
                waiting.append(slab)
                full = sum(len(rows) for _, _, rows in waiting) >= AT_ONCE
                if full or k + 1 == len(chunk) or chunk[k + 1][0] != slab[0]:
                    found = zip(waiting, self.fine(waiting), strict=True)
                    bad += [(one, int((~good).sum())) for one, good in found if not good.all()]
                    waiting = []
        return sum(len(rows) for _, _, rows in chunk), bad


def _pairs(z: Balls, columns: Balls) -> Balls:
    """(N, 3, n, n) second derivatives of a place: z_j x J_k for j up to k."""
    made = times("njri,nki->nrjk", crossed(z), columns)
    return _mirrored(made, np.triu(np.ones(made.at.shape[-2:])))


def _mirrored(made: Balls, upper: Array) -> Balls:
    """With what is above the diagonal below it as well."""
    half = made.signed(upper)
    lower = half.transposed(0, 1, 3, 2).signed(np.tril(np.ones_like(upper), -1))
    return Balls(half.at + lower.at, half.off + lower.off)


def _blocks(a: Balls, b: Balls) -> Balls:
    """Two blocks on the diagonal."""
    n = a.at.shape[-1]
    made = [np.zeros((*a.at.shape[:2], 2 * n, 2 * n)) for _ in range(2)]
    for whole, one, other in ((made[0], a.at, b.at), (made[1], a.off, b.off)):
        whole[:, :, :n, :n], whole[:, :, n:, n:] = one, other
    return Balls(*made)


def _beside(a: Balls, b: Balls) -> Balls:
    """(N, 3, 2n) of columns (N, n, 3) of both."""
    at, off = (np.concatenate([x, y], axis=1).transpose(0, 2, 1) for x, y in ((a.at, b.at), (a.off, b.off)))
    return Balls(at, off)


def _under(a: Balls, b: Balls) -> Balls:
    """Rows after rows."""
    return Balls(np.concatenate([a.at, b.at], axis=1), np.concatenate([a.off, b.off], axis=1))


def _axial(x: Balls) -> Balls:
    """(N, k, 3, 3) the matrices that take a to vee([a] x), where vee x is the axial vector of (x - x')/2."""
    trace = times("nkij,ij->nk", x, Balls(np.eye(3)))
    whole = times("nk,ij->nkij", trace, Balls(np.eye(3))) + -x
    return Balls(whole.at / 2, whole.off / 2)
