"""The joints of an arm and the tool behind them, for many configurations at once: arrays of balls."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .balls import UP, Balls, above, crossed, defect, flint, stacked, times
from .forms import need, real

Array = NDArray[np.float64]


def rotation(numbers: list[str]) -> Balls:
    """Nine numbers as balls that hold the nearest rotation."""
    return Balls(np.reshape([real(x) for x in numbers], (3, 3)), defect(numbers))


def turned(exact: Fraction) -> list[float]:
    """A number as a double, how far off that is at most, 0 (for a half width), and the sine and cosine."""
    sine, cosine = flint.arb(flint.fmpq(exact.numerator, exact.denominator)).sin_cos()
    need(max(above(sine.rad()), above(cosine.rad())) < 2.0**-55, "an angle is too large to be computed with")
    return [float(exact), 2.0**-52 * abs(float(exact)), 0.0, float(sine), float(cosine)]


def exactly(values: Array) -> Array:
    """What :func:`turned` gives of doubles below 2^7, which are the numbers themselves (N, 5)."""
    made = np.zeros((len(values), 5))
    made[:, 0], made[:, 3:] = values, [[float(x) for x in flint.arb(value).sin_cos()] for value in values.tolist()]
    return made


def about(axis: int, given: Array) -> Balls:
    """The rotations about a coordinate axis by what :func:`turned` gave, (N, 5)."""
    i, j, made = (axis + 1) % 3, (axis + 2) % 3, np.zeros((len(given), 3, 3))
    made[:, axis, axis], made[:, i, i], made[:, j, j] = 1, given[:, 4], given[:, 4]
    made[:, j, i], made[:, i, j] = given[:, 3], -given[:, 3]
    return Balls(made, 2.0**-52)


@dataclass(frozen=True)
class Moved:
    """A point of a link, seen from another: of N configurations and k joints between.

    ``tip`` (N, 3) is the point, ``turn`` (N, 3, 3) the rotation of its link, ``axes`` (N, k, 3) those of the joints, 0
    in ``spin`` of a slide, ``places`` (N, k, 3) points on them, ``columns`` (N, k, 3) the derivatives of the point.
    """

    tip: Balls
    turn: Balls
    axes: Balls
    spin: Balls
    places: Balls
    columns: Balls


class Chain:
    """The joints of an arm, about or along the z axes of their frames, and its tool."""

    def __init__(self, arm: dict[str, Any], flat: bool) -> None:
        frames, self.n = [*arm["joints"], arm["tool"]], len(arm["joints"])
        self.slides = np.array([joint["type"] == "prismatic" for joint in arm["joints"]])
        self.origins = [np.array([real(x) for x in frame["origin"]]) for frame in frames]
        self.turns = [rotation(frame["rotation"]) for frame in frames]
        if flat:  # all that moves, moves in the plane: heights count nothing
            good = all(abs(x.at[2, 2]) == 1 and not x.at[2, :2].any() and not x.at[:2, 2].any() for x in self.turns)
            need(good and not self.slides.any(), "a planar task is one of arms that stay in the plane")
            self.origins = [x * [1, 1, 0] for x in self.origins]

    def moved(self, joints: list[Array], first: int = 0, end: Array | None = None, count: int = 1) -> Moved:
        """Of a point in the frame of the joint behind some that begin with ``first``; the tool point, if none is given.

        Joints are each as :func:`turned` gives them, (N, 5); ``count`` is N where there are none.
        """
        count, end = len(joints[0]) if joints else count, self.origins[-1] if end is None else end
        tip, turn = Balls(np.zeros((count, 3))), Balls(np.broadcast_to(np.eye(3), (count, 3, 3)))
        none, axes, places = Balls(np.zeros((count, 0, 3))), [], []
        for k, joint in enumerate(joints, first):
            tip, turn = tip + times("nij,j->ni", turn, Balls(self.origins[k])), times("nij,jk->nik", turn, self.turns[k])
            axes.append(turn[:, :, 2])
            places.append(tip)
            if self.slides[k]:
                tip += times("ni,n->ni", axes[-1], Balls(joint[:, 0], joint[:, 1]))
            else:
                turn = times("nij,njk->nik", turn, about(2, joint))
        tip += times("nij,j->ni", turn, Balls(end))
        if first + len(joints) == self.n:
            turn = times("nij,jk->nik", turn, self.turns[-1])
        z, at = (stacked(x, 1) if joints else none for x in (axes, places))
        slides = self.slides[first : first + len(joints), None]
        spin = z.signed(1.0 * ~slides)
        columns = times("nkij,nkj->nki", crossed(spin), tip[:, None] + -at) + z.signed(1.0 * slides)
        return Moved(tip, turn, z, spin, at, columns)

    def lengths(self, first: int, last: int, end: Array | None = None) -> Array:
        """Above what each of some joints and those before it turn, and the next does not, m.

        That is the part of its link across its axis (all of it where it slides), and that of the next link along the next axis.
        """
        links, found = [*self.origins[first + 1 : last], self.origins[-1] if end is None else end], np.zeros(last - first)
        for k, link in enumerate(links[: last - first]):
            whole = Balls(link * [1, 1, self.slides[first + k]])
            if k + 1 < len(links) and not self.slides[first + k + 1]:
                whole += times("ij,j->i", self.turns[first + k + 1], Balls(links[k + 1] * [0, 0, 1]))
            found[k] = math.hypot(*whole.size) * UP
        return found

    def third(self, far: Array, lengths: Array, out: Array, first: int = 0) -> tuple[Array, Array]:
        """Above what is left of a point behind second order where joints go ``far`` (N, k), and the angle they turn it by (N,).

        ``out`` (N, k): how far slides are out in the middle.
        """
        slides = self.slides[first : first + far.shape[1]]
        c, slid = np.cumsum(far * ~slides, axis=1) * UP, far * slides
        rest = c**3 * (lengths + np.abs(out) * slides + slid) + 3 * c**2 * slid
        return rest.sum(axis=1) / 6 * UP, c[:, -1] if c.shape[1] else np.zeros(len(c))
