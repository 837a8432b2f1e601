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
from itertools import accumulate, groupby
from typing import Any

import numpy as np

from .balls import LEAST, UP, Array, Balls, Flags, either, flint, joined, solve_regular, times
from .chain import Chain, exactly, turned
from .forms import TASKS, real
from .paths import SEGMENT, UNIT, Ints, Slab
from .taylor import Error, Inclusion

AT_ONCE = 256  # cells
_WIDER = 0.25 * 0.5 ** np.arange(27)  # of section boxes, tried one after the other


class Motion:
    """The healthy motion of a path, exactly: from knot to knot along straight segments."""

    def __init__(self, document: dict[str, Any]) -> None:
        payloads = {"cells": "", "centres": "", "refutations": []}
        self._given = document | {"locks": [lock | payloads for lock in document["locks"]]}
        self.task, self.knots = document["task"], np.array([[real(x) for x in knot] for knot in document["knots"]])
        self._exact = [[Fraction(x) for x in knot] for knot in self.knots.tolist()]

    def __reduce__(self) -> tuple[Any, ...]:  # to another process
        return type(self), (self._given,)

    def joints(self, twice: int, segment: int) -> list[Fraction]:
        """Where they are at half of an instant, of a segment."""
        part = Fraction(twice, 2 * SEGMENT) - segment
        return [a + (b - a) * part for a, b in zip(*self._exact[segment : segment + 2], strict=True)]


class Faults(Motion):
    """What slabs of a path do not prove."""

    def __init__(self, document: dict[str, Any]) -> None:
        super().__init__(document)
        linear, turning, _ = TASKS[self.task]
        self.m, self.chain = linear + turning, Chain(document["arm"], self.task == "planar-pose")
        self.n, self._known = self.chain.n, dict[tuple[int, int], Array]()
        self.limits = np.array([[real(x) for x in pair] for pair in document["limits"]])
        metres, radians = (real(x) for x in document["tube"])
        self.tube = np.array([metres] * linear + [radians] * turning) if metres or radians else np.empty(0)
        self.still = [[lock["joint"], *lock["followers"]] for lock in document["locks"]]

    def healthy(self, middles: Ints, ends: Ints) -> tuple[list[Array], Balls]:
        """Joints of the healthy motion at middles (twice the instants), as :func:`turned` has them, and their rates.

        Rates are those over the segments of ends.
        """
        segment, found = (ends - 1) // SEGMENT, []
        for key in zip(segment.tolist(), middles.tolist(), strict=True):
            if key not in self._known:
                self._known[key] = np.array([turned(x) for x in self.joints(key[1], key[0])])
            found.append(self._known[key])
        return list(np.array(found).transpose(1, 0, 2)), Balls(self.knots[segment + 1]) + -self.knots[segment]

    def section(self, slope: Array, rates: tuple[Balls, Balls], still: list[int], turned: Flags) -> tuple[Balls, Balls]:
        """D (N, 2n, 2 + tube + m), and how free joints, then the place on the path follow its columns (N, f + 1, ...).

        Any numbers will do. Of a turned cell the path is followed along the tangent of the locked arm's motion, and the place
        on it is one more of what the section moves.
        """
        tube, free, (locked, path) = len(self.tube), [k for k in range(self.n) if k not in still], rates
        slope, only, follows = np.nan_to_num(slope), np.arange(self.n) == still[0], np.isin(np.arange(2 * self.n), still[1:])
        driven = joined(1, path, path[:, ::-1]).signed(follows | (np.arange(2 * self.n) >= self.n))
        jacobian, drift = slope[:, :, free], np.einsum("nmk,nk->nm", slope[:, :, : self.n], locked.at * only)
        ahead = np.einsum("nmk,nk->nm", slope, driven.at)
        wide, good = np.concatenate([jacobian, ahead[:, :, None]], axis=2), abs(np.linalg.det(jacobian)) > 1e-12
        across = np.linalg.inv(np.where(good[:, None, None], jacobian, np.eye(self.m)))
        tangent = np.pad(-np.einsum("nfm,nm->nf", across, ahead), ((0, 0), (0, 1)), constant_values=1.0)
        across = np.pad(across, ((0, 0), (0, 1), (0, 0)))
        if turned.any():
            across[turned], most = np.linalg.pinv(wide[turned]), np.linalg.svd(wide[turned])[2][:, -1]
            tangent[turned] = most * np.where(most[:, -1:] < 0, -1.0, 1.0)
        beside = turned * ((tangent[:, :-1] * locked.at[:, free]).sum(axis=1) + tangent[:, -1])
        begin = tangent * beside[:, None] - np.einsum("nfm,nm->nf", across, drift)
        own = np.concatenate([np.stack([begin, tangent], 2), across[:, :, :tube], across], axis=2)
        own, moved = np.nan_to_num(own), np.zeros((len(slope), 2 * self.n, own.shape[2]))
        moved[:, free] = own[:, :-1]
        lock = times("nk,c->nkc", joined(1, locked.signed(only), path.signed(0)), 1.0 * (np.arange(own.shape[2]) == 0))
        return times("nk,nc->nkc", driven, own[:, -1]) + lock + moved, Balls(own)

    def slopes(self, cells: Inclusion, half: Array) -> Array:
        """(N, m, 1 + m) above the slopes of g - s by the path and by s."""
        last, error = [1, *range(half.shape[1] - self.m, half.shape[1])], cells.error
        far = np.einsum("nkc,nc->nk", cells.reach, half) * UP
        slope = cells.form.steep[:, :, last] + np.einsum("nabk,nk->nab", cells.form.curved[:, :, last], half)
        turned = np.zeros(slope[:, 0].shape)
        ways = zip(error.halves(far), error.halves(cells.reach), strict=True)
        for (chain, out, way), (_, _, every) in ways:
            by = every[:, :, last]
            c, own = np.cumsum(way * ~chain.slides, axis=1) * UP, np.cumsum(by * ~chain.slides[:, None], axis=1) * UP
            slid = way * chain.slides
            # What a slide goes out by, d, counts first order already: its slope by a turn changes by d c, whatever c is.
            most = (chain.whole + abs(out) * chain.slides) * c**2 + 2 * c * slid
            third = np.einsum("nk,nkb->nb", most, own) + np.einsum("nk,nkb->nb", c**2, by * chain.slides[:, None])
            slope[:, : error.linear] += third[:, None] / 2
            turned += own[:, -1]
        slope[:, error.linear :] += (turned * cells.error.rest(far)[1][:, None] ** 2 / 2)[:, None]
        return np.asarray(slope * UP * UP + LEAST)

    def contracts(self, cells: Inclusion, s: Array) -> Flags:
        """Whether s -> s - g moves any two points of the box nearer to each other."""
        slope = self.slopes(cells, np.concatenate([cells.w[:, : -self.m], s], axis=1))[:, :, 1:]
        return np.asarray((np.einsum("nab,nb->na", slope, s) * UP + LEAST < 0.999 * s).all(axis=1))

    def forward(self, cells: Inclusion, own: Balls, place: Array) -> Flags:
        """Whether turned cells only go forward on the path, and end within the segment; place (N,) from the end of that.

        As motions begin in it, they stay there. Where slopes by s are at most M, and by the path at most b, the solution moves
        by at most u if b + M u <= u.
        """
        slope = self.slopes(cells, cells.w)
        b, inner = slope[:, :, 0], slope[:, :, 1:]
        u = solve_regular(np.eye(self.m) - np.nan_to_num(inner), b[:, :, None])[:, :, 0] * 1.001 + 1e-12
        found = (u >= 0).all(axis=1) & ((b + np.einsum("nab,nb->na", inner, u) * UP) * UP + LEAST <= u).all(axis=1)
        slower = np.einsum("nb,nb->n", abs(own.at[:, -1, -self.m :]), u) * UP
        off = np.einsum("nc,nc->n", abs(own.at[:, -1]), cells.w) * UP
        return np.asarray(found & (slower < own.at[:, -1, 1]) & (place + off * UP < 0))

    def fine(self, slabs: list[Slab]) -> Flags:
        """Which of the cells of slabs of one lock go on with what the one before found."""
        still, counts, tube, m = self.still[slabs[0][0]], [len(one[3]) for one in slabs], len(self.tube), self.m
        free = [k for k in range(self.n) if k not in still]
        begin, stop = np.repeat([one[1] for one in slabs], counts, axis=0).T
        starts, ends, width = np.concatenate([one[2] for one in slabs]).T
        first, turned = np.concatenate([np.arange(count) == 0 for count in counts]), width > 0
        locked, rate = self.healthy(begin + stop, stop)
        healthy, along = self.healthy(starts + ends, ends)
        joints = [exactly(values) for values in (np.concatenate([one[3] for one in slabs]) * UNIT).T]
        for k in still:
            joints[k] = (locked if k == still[0] else healthy)[k]
        error = Error(self.task, self.chain, joints, self.chain, healthy)
        d, own = self.section(error.slopes.at[:, :m], (rate, along), still, turned)
        less, w = np.zeros((m, 2 + tube + m)), np.zeros((len(ends), 2 + tube + m))
        less[:, 2 : 2 + tube] = np.eye(m)[:, :tube]
        w[:, 0], w[:, 2 : 2 + tube] = (stop - begin) / (2 * SEGMENT), self.tube
        w[:, 1] = np.where(turned, width * UNIT, (ends - starts) / (2 * SEGMENT))
        cells = Inclusion(error, d, less, w)
        wide, unique = np.zeros((len(ends), m)), np.zeros(len(ends), dtype=bool)
        for size in _WIDER:
            t = np.where(unique[:, None], wide, w[:, -m:] + size)
            unique |= self.contracts(cells, t)
            wide = np.where(unique[:, None], t, wide)
            if unique.all():
                break
        middle, q, each = (starts + ends) / (2 * SEGMENT), _values(joints), Balls(np.ones((len(ends), 1)))
        good = cells.good & unique & cells.within(q, self.limits, free)
        if turned.any():
            good &= ~turned | self.forward(cells, own, middle - (ends - 1) // SEGMENT - 1)
        here = joined(1, q[:, free], Balls(middle[:, None]))
        lock = (
            joined(1, _values(locked)[:, free], Balls((begin + stop)[:, None] / (2 * SEGMENT))),
            joined(1, rate[:, free], each),
        )
        return good & self.glued(here, own, w, wide, lock, first, turned)

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
        inverse = Balls(solve_regular(matrix.at, np.eye(m + 1)[None]))
        off = (times("nab,nbc->nac", inverse, matrix) + -np.eye(m + 1)).size
        # Between cells that are not turned this is on a face, exactly, and the diagonal where motions begin is in the cell.
        face = ~turned & (first | ~np.roll(turned, 1))
        room = np.concatenate([np.where(face, w[:, 1] * (1 + 1e-6) + 1e-12, w[:, 1])[:, None], wide], axis=1)
        most = times("nab,nb->na", inverse, place).size + np.einsum("nab,nb->na", off, room)
        most += np.einsum("nac,nc->na", times("nab,nbc->nac", inverse, spread).size, w[:, kept])
        most += np.einsum("nac,nc->na", times("nab,nbc->nac", inverse, found).size, earlier[:, -m:])
        return np.asarray(((most * UP + LEAST) < room).all(axis=1))

    def rejected(self, chunk: list[Slab]) -> tuple[int, list[tuple[Slab, int]]]:
        """How many cells were checked, and slabs that prove nothing, each with how many of its cells are bad."""
        bad, totals = list[tuple[Slab, int]](), accumulate(len(slab[3]) for slab in chunk)
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for _, some in groupby(zip(chunk, totals, strict=True), lambda one: (one[0][0], one[1] // AT_ONCE)):
                slabs = [slab for slab, _ in some]
                wrong = np.split(~self.fine(slabs), np.cumsum([len(one[3]) for one in slabs])[:-1])
                bad += [(one, int(cells.sum())) for one, cells in zip(slabs, wrong, strict=True) if cells.any()]
        return sum(len(slab[3]) for slab in chunk), bad


def _before(x: Balls) -> Balls:
    """Of the cell before."""
    return Balls(np.roll(x.at, 1, axis=0), np.roll(x.off, 1, axis=0))


def _values(joints: list[Array]) -> Balls:
    """(N, n) of joints as :func:`turned` has them."""
    values = np.stack([joint[:, :2] for joint in joints], 2)
    return Balls(values[:, 0], values[:, 1])
