"""Numbers over boxes, from exact first and second derivatives in the middle: of all claims but structural zeros.

The numbers of most claims are the error of a tool from where another chain has its tool: rows of the place, then of the
rotation. Rows of a rotation are <W, E>, the sum of products of entries, with E the rotation from the other tool to the first
and W fixed matrices: with a pose the axial part (E - E')/2, in the plane the third row of it; where only the tool's axis
counts, how far that of the one goes less that of the other along two fixed vectors across. With a before b in the chain, E
changes by [a]E, and twice by [a][b]E; the other chain's joints enter backwards.
A last row is cos(angle) - 1 of what is left: the others are 0 for half a turn as well, and this one tells it from none.

Let some columns D say how joints follow the place in a box and a section variable s. This bounds |g - s| by e(S) over the
box and a box of half widths S, with g the rows. Where e(S) <= S, the map s -> s - g sends that box into itself, so by Brouwer's
theorem some s has g = 0. Any D will do; it decides whether e(S) <= S.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from .balls import LEAST, UP, Array, Balls, Flags, crossed, joined, times
from .chain import Chain, Moved
from .forms import TASKS

STRAIGHT = -0.05  # of the last row: what is left to turn is then at most 0.32 rad
MOST_TURNED = 1.5  # rad by which it may change: both together are less than half a turn
BENT = np.cross(np.eye(3)[:, None], np.eye(3)).transpose(0, 2, 1)  # [e_l], (3, 3, 3)


class Form:
    """Numbers (N, a), their slopes (N, a, V) and second derivatives (N, a, V, V), each pair of variables both ways."""

    def __init__(self, value: Balls, slopes: Balls, second: Balls) -> None:
        self.value, self.slopes, self.second = value, slopes, second

    def rows(self, key: Any) -> Form:
        """Some of the numbers."""
        return Form(self.value[:, key], self.slopes[:, key], self.second[:, key])

    def along(self, d: Balls, less: Array) -> Form:
        """Where variables follow columns D (N, V, C), less so much (a, C) of each column."""
        twice = times("nki,nakj->naij", d, times("nakl,nlj->nakj", self.second, d))
        return Form(self.value, times("nak,nkc->nac", self.slopes, d) + -less, twice)

    def summed(self, e: Balls) -> Form:
        """One number, e (N, a) times these."""
        value, slopes = times("na,na->n", e, self.value), times("na,nak->nk", e, self.slopes)
        return Form(value[:, None], slopes[:, None], times("na,najk->njk", e, self.second)[:, None])

    @cached_property
    def steep(self) -> Array:
        """Above the sizes of slopes."""
        return self.slopes.size

    @cached_property
    def curved(self) -> Array:
        """Above the sizes of second derivatives."""
        return self.second.size

    @cached_property
    def pairs(self) -> Array:
        """Of those by two variables, each pair once."""
        return np.triu(self.curved, 1)

    @cached_property
    def bends(self) -> tuple[Array, Array]:
        """Below second derivatives by one variable, and below these with the other sign."""
        low, high = (np.diagonal(x.low, axis1=2, axis2=3) for x in (self.second, -self.second))
        return low, high

    def loss(self, half: Array) -> list[Array]:
        """Above what the numbers lose, and what they gain, within half widths (N, V), to second order."""
        h, found = half[:, None], list[Array]()
        both = ((self.pairs @ h[..., None])[..., 0] * h).sum(axis=2)
        for own in self.bends:
            most = np.where(self.steep < own * h, self.steep**2 / (2 * own), self.steep * h - own * h**2 / 2)
            found.append((most.sum(axis=2) + both) * UP + LEAST)
        return found

    def most(self, half: Array, rest: Array) -> Array:
        """Above the sizes of the numbers, with what is left behind second order."""
        (less, more), value = ((x + rest) * UP for x in self.loss(half)), self.value
        over, under = np.nextafter(value.at + value.off, np.inf) + more, np.nextafter(value.off - value.at, np.inf) + less
        return np.nextafter(np.maximum(over, under), np.inf) + LEAST


class Error(Form):
    """The rows of the tool of one chain from that of another, by the joints of the one, then of the other backwards."""

    def __init__(self, task: str, arm: Chain, joints: list[Array], goal: Chain, places: list[Array]) -> None:
        self.linear, turning, _ = TASKS[task]
        self.m, self.rotated = self.linear + turning, turning > 0
        at, to = arm.moved(joints), goal.moved(places)
        self.ways = [(x, np.stack([joint[:, 0] for joint in given], 1)) for x, given in ((arm, joints), (goal, places))]
        parts = [place(at, at.columns, at.tip, to, to.columns, to.tip).rows(slice(self.linear))]
        if turning == 2:
            a, b = at.turn[:, :, 2], to.turn[:, :, 2]
            columns = (times("nkij,nj->nki", crossed(tool.spin), axis) for tool, axis in ((at, a), (to, b)))
            axis, across = place(at, next(columns), a, to, next(columns), b), to.turn.at
            slopes, second = times("nir,nij->nrj", across, axis.slopes), times("nir,nijk->nrjk", across, axis.second)
            parts.append(Form(times("nir,ni->nr", across, axis.value), slopes, second))
        elif turning:
            off = times("nij,nkj->nik", at.turn, to.turn)
            spin = joined(1, at.spin, -times("nij,nkj->nki", off, to.spin)[:, ::-1])
            weights = np.concatenate([BENT[3 - turning :] / 2, [np.eye(3) / 2]])
            moves = np.einsum("lik,rij->rlkj", BENT, weights)  # <W, [e_l]E> is this with E
            value = times("rij,nij->nr", weights, off) + -np.append(np.zeros(turning), 1.5)
            later = times("rlkj,nbkj->nrbl", moves, times("nbik,nkj->nbij", crossed(spin), off))
            slopes = times("nrl,nal->nra", times("rlkj,nkj->nrl", moves, off), spin)
            parts.append(Form(value, slopes, times("nrbl,nal->nrab", later, spin).mirrored()))
        super().__init__(*(joined(1, *[getattr(x, key) for x in parts]) for key in ("value", "slopes", "second")))

    def halves(self, far: Array) -> list[tuple[Chain, Array, Array]]:
        """Of what is there for each variable, (N, V, ...), what belongs to the joints of each chain; and that with it."""
        n = self.ways[0][0].n
        return [(chain, out, x) for (chain, out), x in zip(self.ways, (far[:, :n], far[:, : n - 1 : -1]), strict=True)]

    def rest(self, far: Array) -> tuple[Array, Array]:
        """Above what is left of each row behind second order where joints go ``far`` (N, V), and the angle they turn by."""
        parts = self.halves(far)
        third = sum(chain.bend(3, way, chain.whole, out) for chain, out, way in parts) / 6 * UP
        angle = sum((way * ~chain.slides).sum(axis=1) for chain, _, way in parts) * UP
        turned = self.value.at.shape[1] - self.linear
        return np.stack([third] * self.linear + [angle**3 / 6 * UP] * turned, axis=1), angle


class Inclusion:
    """Boxes of places and sections, of half widths w (N, C), the last m of the section, which s -> s - g sends into itself."""

    def __init__(self, error: Error, d: Balls, less: Array, w: Array) -> None:
        self.error, self.w, self.reach, self.m = error, w, d.size, error.m
        whole = less.copy()
        whole[:, -self.m :] += np.eye(self.m)
        self.form, s = error.rows(slice(self.m)).along(d, whole), w[:, -self.m :]
        for _ in range(38):
            closed = self.closed()
            if closed.all():
                break
            s[:] = np.where(closed[:, None], s, 1.05 * self.most + 1e-9)
        for _ in range(8):  # as e grows with S, a little more than e(S) is such a box again
            self.closed()
            if (self.most[closed] > 0.999999 * s[closed]).all():
                break
            s[:] = np.where(closed[:, None], np.minimum(s, self.most * (1 + 1e-9)), s)
        straight = (error.value.low[:, -1] > STRAIGHT) & (self.angle < MOST_TURNED)
        self.good = closed & self.closed() & (straight | (not error.rotated))

    def closed(self) -> Flags:
        """Whether e(S) <= S; keeps e(S), how far joints go, and by how much they turn the tool; rounded up."""
        self.far = np.einsum("nkc,nc->nk", self.reach, self.w) * UP
        rest, self.angle = self.error.rest(self.far)
        self.most, s = self.form.most(self.w, rest[:, : self.m]), self.w[:, -self.m :]
        return np.asarray(((self.most <= s) & (s < 1e3)).all(axis=1))

    def within(self, q: Balls, limits: Array, free: list[int]) -> Flags:
        """Whether free joints stay within limits (n, 2), from the middles (N, n) on."""
        far = self.far[:, : q.at.shape[1]]
        low, high = np.nextafter(q.low - far, -np.inf), np.nextafter(-(-q).low + far, np.inf)
        return np.asarray(((low >= limits[:, 0]) & (high <= limits[:, 1]))[:, free].all(axis=1))


def place(at: Moved, columns: Balls, tip: Balls, to: Moved, theirs: Balls, end: Balls) -> Form:
    """A vector (N, 3) of one chain less that of another, by the joints of both, those of the other backwards."""
    (slopes, second), (back, twice) = (derivatives(*x) for x in ((at.spin, columns), (to.spin, theirs)))
    n, v = columns.at.shape[1], columns.at.shape[1] + theirs.at.shape[1]
    made = [np.zeros((len(tip.at), 3, v, v)) for _ in range(2)]
    for whole, one, other in ((made[0], second.at, -twice.at), (made[1], second.off, twice.off)):
        whole[:, :, :n, :n], whole[:, :, n:, n:] = one, other[:, :, ::-1, ::-1]
    return Form(tip + -end, joined(2, slopes, -back[:, :, ::-1]), Balls(*made))


def derivatives(spin: Balls, columns: Balls) -> tuple[Balls, Balls]:
    """Slopes (N, 3, V) of a vector, and its second derivatives (N, 3, V, V): z_a x J_b by a and a later b."""
    return columns.transposed(0, 2, 1), times("nari,nbi->nrab", crossed(spin), columns).mirrored()
