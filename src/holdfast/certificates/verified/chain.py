"""Chains of joints: an arm, or the target, which is one as well; where many configurations take the tool, and boxes of these.

Three slides and three turns take a tool to any pose. So a target is where the tool of such a chain is, and an arm reaches all
targets of a box if its tool can be where the other is, wherever the joints of that are.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from .balls import UP, Array, Balls, above, crossed, flint, stacked, times
from .forms import need, real
from .tree import Cell

Leaf = tuple[Cell, Any]  # and what shows it
ONE = [float(k % 4 == 0).hex() for k in range(9)]


def rotation(numbers: list[str]) -> Balls:
    """Nine numbers as balls that hold the nearest rotation, which is nearer than R'R is to the identity (Frobenius)."""
    matrix = flint.arb_mat(3, 3, [real(x) for x in numbers])
    gram = (matrix.transpose() * matrix - flint.arb_mat([[1, 0, 0], [0, 1, 0], [0, 0, 1]])).entries()
    off = math.hypot(*(above(abs(x)) for x in gram)) * UP
    good = off < 1e-12 and matrix.det() > 0
    need(good, "a rotation of the file is none: its columns must be orthonormal to 1e-12 and right-handed")
    return Balls(np.reshape([real(x) for x in numbers], (3, 3)), off)


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


def gantry(target: dict[str, Any]) -> dict[str, Any]:
    """The chain of a target: slides along z, y and x, or y and x; then turns by yaw, pitch and roll, or yaw."""
    axes, first, wanted = target["axes"], [ONE] * ("z" in target["axes"]), target["orientation"] or ONE
    kinds = ["prismatic"] * sum(axis in "xyz" for axis in axes) + ["revolute"] * sum(axis not in "xyz" for axis in axes)
    # The cycle of rows of ONE takes z to y, the next y to x, and so on; three are none.
    frames = [{"rotation": x, "origin": ["0x0p+0"] * 3} for x in (first + [ONE[3:] + ONE[:3]] * 6)[: len(kinds)]]
    tool = {"rotation": wanted if axes == "xya" else wanted[3:] + wanted[:3], "origin": ["0x0p+0"] * 3}
    return {"joints": [frame | {"type": kind} for frame, kind in zip(frames, kinds, strict=True)], "tool": tool}


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
    """Joints, about or along the z axes of their frames, and the tool behind them."""

    def __init__(self, arm: dict[str, Any], flat: bool = False) -> None:
        frames, self.n = [*arm["joints"], arm["tool"]], len(arm["joints"])
        self.slides = np.array([joint["type"] == "prismatic" for joint in arm["joints"]])
        self.origins = [np.array([real(x) for x in frame["origin"]]) for frame in frames]
        self.turns = [rotation(frame["rotation"]) for frame in frames]
        if flat:  # all that moves, moves in the plane: heights count nothing
            good = all(abs(x.at[2, 2]) == 1 and not x.at[2, :2].any() and not x.at[:2, 2].any() for x in self.turns)
            need(good and not self.slides.any(), "a planar task is one of arms that stay in the plane")
            self.origins = [x * [1, 1, 0] for x in self.origins]
        self.whole = self.lengths(0, self.n)

    def moved(self, joints: list[Array], first: int = 0, end: Array | None = None, count: int = 1) -> Moved:
        """Of a point in the frame of the joint behind some that begin with ``first``; the tool point, if none is given.

        Joints are each as :func:`turned` gives them, (N, 5); ``count`` is N where there are none.
        """
        count, end = len(joints[0]) if joints else count, self.origins[-1] if end is None else end
        tip, turn = Balls(np.zeros((count, 3))), Balls(np.broadcast_to(np.eye(3), (count, 3, 3)))
        none, axes, places = Balls(np.zeros((count, 0, 3))), [], []
        for k, joint in enumerate(joints, first):
            tip, turn = tip + times("nij,j->ni", turn, self.origins[k]), times("nij,jk->nik", turn, self.turns[k])
            axes.append(turn[:, :, 2])
            places.append(tip)
            if self.slides[k]:
                tip += times("ni,n->ni", axes[-1], Balls(joint[:, 0], joint[:, 1]))
            else:
                cosine, sine, still = joint[:, 4], joint[:, 3], np.zeros(count)
                about = np.array([[cosine, -sine, still], [sine, cosine, still], [still, still, still + 1]])
                turn = times("nij,njk->nik", turn, Balls(about.transpose(2, 0, 1), 2.0**-52))
        tip += times("nij,j->ni", turn, end)
        if first + len(joints) == self.n:
            turn = times("nij,jk->nik", turn, self.turns[-1])
        z, at = (stacked(x) if joints else none for x in (axes, places))
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
                whole += times("ij,j->i", self.turns[first + k + 1], links[k + 1] * [0, 0, 1])
            found[k] = math.hypot(*whole.size) * UP
        return found

    def bend(self, order: int, far: Array, lengths: Array, out: Array, first: int = 0) -> Array:
        """Above the length of a derivative of a point along what takes joints ``far`` (N, k) at most, (N,).

        ``out`` (N, k): how far slides are out in the middle.
        """
        slides = self.slides[first : first + far.shape[1]]
        c, slid = np.cumsum(far * ~slides, axis=1) * UP, far * slides
        each = c**order * (lengths + np.abs(out) * slides + slid) + order * c ** (order - 1) * slid
        return np.asarray(each.sum(axis=1) * UP)


class Boxes:
    """The axes of a tree, between the ends of its root box, and what its leaves say."""

    targets: slice | None = None  # those of its axes that are of targets

    def __init__(self, document: dict[str, Any], ends: Iterable[Iterable[Any]]) -> None:
        self._given = {key: value for key, value in document.items() if key not in ("tree", "centres")}
        numbers = [[Fraction(real(x) if isinstance(x, str) else x) for x in pair] for pair in ends]
        self.low, self.width = [low for low, _ in numbers], [high - low for low, high in numbers]
        self._known: dict[tuple[int, int, int], list[float]] = {}

    def __reduce__(self) -> tuple[Any, ...]:  # to another process, whose balls are its own
        return type(self), (self._given,)

    def middles(self, cells: Iterable[Cell], first: int = 0) -> list[Array]:
        """Of each axis from ``first`` on, what :func:`turned` gives of the middles, with half widths rounded up, (N, 5)."""
        return [
            np.array([self._middle(axis, part) for part in parts]) for axis, parts in enumerate(zip(*cells, strict=True), first)
        ]

    def unproved(self, rejected: list[Leaf], leaves: Callable[[], Iterator[Leaf]]) -> list[Cell]:
        """What rejected leaves do not prove of the root box."""
        return [cell for cell, _ in rejected]

    def rejected(self, chunk: list[Leaf]) -> tuple[int, list[Leaf]]:
        """How many leaves were checked, and those that prove nothing."""
        bad = list[Leaf]()
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for kind in sorted({self.kind(leaf) for leaf in chunk}):
                some = [leaf for leaf in chunk if self.kind(leaf) == kind]
                bad += [leaf for leaf, good in zip(some, self.proves(kind, some), strict=True) if not good]
        return len(chunk), bad

    def kind(self, leaf: Leaf) -> Any:
        """Leaves of one kind are looked at together."""
        return leaf[1]

    def proves(self, kind: Any, leaves: list[Leaf]) -> Iterable[Any]:
        """Of leaves of one kind, whether each is true."""
        raise NotImplementedError

    def _middle(self, axis: int, part: tuple[int, int]) -> list[float]:
        (k, d), key = part, (axis, *part)
        if key not in self._known:
            self._known[key] = turned(self.low[axis] + self.width[axis] * Fraction(2 * k + 1, 2 << d))
            self._known[key][2] = math.nextafter(float(self.width[axis] / (2 << d)), math.inf)
        return self._known[key]


def configuration(q: list[str]) -> list[Array]:
    """Joint values, one row for each, as :meth:`Chain.moved` takes them."""
    values = [real(x) for x in q]
    need(max(map(abs, values)) < 100, "a configuration turns by more than 100 rad")
    return [exactly(np.array([x])) for x in values]
