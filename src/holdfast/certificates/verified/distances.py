"""The leaves of a refutation: whichever configuration of the arm, the tool is not where the target is.

In each leaf some combination of the task's rows is not 0; or a point of some link is farther from the target than the tool can
be from this point, or nearer. How far that is, is a lemma, with a tree of its own over the joints behind the link.

Where the tool is given, base, joints, tool and base again are a ring. Two points of links are as far from each other by the
joints between them as by the others, on the way round by the tool and the base; a leaf excludes where that cannot be.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from .balls import UP, Array, Balls, Flags, crossed, flint, length, solve_regular, times
from .chain import Boxes, Chain, Leaf, configuration, turned
from .forms import need, real, unpacked
from .motions import Motion
from .paths import SEGMENT, Never
from .targets import UNIT, Leaves, Targets
from .taylor import Form, derivatives, place
from .tree import MOST_LEAVES, PROVED, SPLIT, Cell, cells

LEMMA = 3  # what the first lemma excludes; 0: where the tool itself is elsewhere
WITNESS = (-2, 0)  # which leaf: a configuration that shows the opposite; (-1, k): of the main tree, (k, k): of a lemma's


def nearest(form: Form, linear: int, rest: tuple[Any, Any], half: Array) -> Array:
    """Below the length of the numbers: along a direction e, of length 1 at most, whichever it is; some are tried.

    Of the first ``linear``, as a vector, and of the others ``rest`` (N,) is what is left behind second order.
    """
    value, swept, one = form.value.at, form.slopes.at * half[:, None], np.eye(form.value.at.shape[1])
    spread = swept @ swept.transpose(0, 2, 1) + (1e-6 * (value**2).sum(axis=1) + 1e-30)[:, None, None] * one
    steep = solve_regular(np.nan_to_num(spread) + 1e-30 * one, value[:, :, None])[:, :, 0]
    best, first = np.full(len(value), -np.inf), np.arange(len(one)) < linear
    for along in (value, steep, *([value * first, value * ~first] if linear < len(one) else [])):
        e = along / np.sqrt((along**2).sum(axis=1))[:, None] * (1 - 1e-12)
        e = np.where(((e**2).sum(axis=1) < 1 - 1e-13)[:, None], e, 0.0)
        row = form.summed(Balls(e))
        loss = row.loss(half)[0][:, 0] + length(e * first) * rest[0] + length(e * ~first) * rest[1]
        best = np.maximum(best, np.nextafter(row.value.low[:, 0] - loss * UP, -np.inf))
    return best


def span(form: Form, bends: list[Array], half: Array) -> tuple[Array, Array]:
    """Below and above the length of a vector v, the latter from half its square.

    ``bends``: above the lengths of its derivatives along half widths. Of half its square the third is at most three times
    the product of the first and the second, and the length times the third.
    """
    (one, two, three), d = bends, length(form.value.size)
    second = times("naj,nak->njk", form.slopes, form.slopes) + times("na,najk->njk", form.value, form.second)
    square = Form(form.value, times("na,nak->nk", form.value, form.slopes)[:, None], second[:, None])
    most = d**2 + 2 * (square.loss(half)[1][:, 0] + (3 * one * two + (d + one) * three) / 6)
    far = np.nextafter(np.sqrt(most * UP), np.inf)
    return nearest(form, 3, (three / 6, 0), half), np.asarray(far)


def apart(chain: Chain, joints: list[Array], first: int, start: Array, end: Array, count: int) -> tuple[Array, Array]:
    """Below and above the distance of a point of link ``first`` from one behind some joints, (N,)."""
    moved, half, out = chain.moved(joints, first, end, count), *np.zeros((2, count, len(joints)))
    for k, joint in enumerate(joints):
        half[:, k], out[:, k] = joint[:, 2], joint[:, 0]
    # Where the first axes pass by the point at a distance, turning about these changes the other's by so much at most.
    aside, still = np.zeros(count), np.ones(count, dtype=bool)
    by = times("nkij,nkj->nki", crossed(moved.axes), -moved.places + start).size
    for k, slides in enumerate(chain.slides[first : first + len(joints)]):
        cost = length(by[:, k]) * np.minimum(half[:, k], 2) * UP
        still &= (cost < 1e-6) & (not slides)
        half[:, k], aside = np.where(still, 0.0, half[:, k]), (aside + np.where(still, cost, 0.0)) * UP
    lengths = chain.lengths(first, first + len(joints), end)
    form = Form(moved.tip + -start, *derivatives(moved.spin, moved.columns))
    near, far = span(form, [chain.bend(order, half, lengths, out, first) for order in (1, 2, 3)], half)
    return np.nextafter(near - aside, -np.inf), np.nextafter(far + aside, np.inf)


class Apart(Targets):
    """The leaves of a refutation: the tool is not where the target is."""

    def __init__(self, document: dict[str, Any]) -> None:
        limits, lemmas, flat = list(document["limits"]), document["lemmas"], document["task"].startswith("planar")
        if document["locked"] >= 0:
            limits[document["locked"]] = document["angle"]
        super().__init__(document, within_a_turn(limits, document["arm"]["joints"]), [], flat)
        self.points = [np.array([real(x) for x in lemma["point"]]) * [1, 1, not flat] for lemma in lemmas]
        self.links = [lemma["link"] for lemma in lemmas]
        self.least, self.most = ([real(lemma[key]) for lemma in lemmas] for key in ("least", "most"))

    def leaves(self, document: dict[str, Any]) -> tuple[int, list[Cell], Callable[[], Iterator[Leaf]]]:
        """How many there are, which cells of the main tree are undecided, and the leaves."""
        main, axes, last = unpacked(document["tree"], 2 * MOST_LEAVES - 1, "tree"), len(self.width), 2 + len(self.links)
        trees = [unpacked(lemma["tree"], 2 * MOST_LEAVES - 1, "tree of a lemma") for lemma in document["lemmas"]]
        need(last < SPLIT, f"there are more than {SPLIT - LEMMA} lemmas")
        need(not any(tree.count(token) for tree in trees for token in (1, 2)), "a lemma is not proved everywhere")
        undecided = [cell for token, cell in cells(main, axes, last) if token in (1, 2)]
        if document["witness"]:
            need(main == b"\2" and not trees, "beside a witness nothing is proved")
            return 1, undecided, lambda: iter([(undecided[0], WITNESS)])
        count = sum(tree.count(0) for tree in trees) + sum(main.count(x) for x in (PROVED, *range(LEMMA, last + 1)))

        def leaves() -> Iterator[Leaf]:
            for k, tree in enumerate(trees):
                yield from ((cell, (k, k)) for _, cell in cells(tree, self.n - self.links[k]))
            yield from ((cell, (-1, max(token, 2) - LEMMA)) for token, cell in cells(main, axes, last) if token not in (1, 2))

        return count, undecided, leaves

    def unproved(self, rejected: list[Leaf], leaves: Callable[[], Iterator[Leaf]]) -> list[Cell]:
        """Cells of the main tree that are rejected, or need a lemma of which a leaf is."""
        broken, bad = {tree for _, (tree, _) in rejected if tree >= 0}, {cell for cell, (tree, _) in rejected if tree == -1}
        return [cell for cell, (tree, which) in leaves() if tree == -1 and (which in broken or cell in bad)]

    def proves(self, kind: tuple[int, int], leaves: list[Leaf]) -> Any:
        """Whether leaves are true, of a lemma, or of the main tree by a lemma or (-1) by the task's rows."""
        parts, (tree, which) = [cell for cell, _ in leaves], kind
        if kind == WITNESS:
            return [self.holds(self._given["witness"])]
        if tree >= 0:
            joints, end = self.middles(parts, self.links[tree]), self.arm.origins[-1]
            near, far = apart(self.arm, joints, self.links[tree], self.points[tree], end, len(parts))
            return ((near >= self.least[tree]) | (self.least[tree] <= 0)) & (far <= self.most[tree])
        axes = self.middles(parts)
        joints, target = axes[: self.n if which < 0 else self.links[which]], axes[self.n :]
        half = np.stack([x[:, 2] for x in (*joints, *(target[axis] for axis in self.variables))], 1)
        if which < 0:
            error = self.error(joints, target)
            rest, _ = error.rest(half)
            return nearest(error, error.linear, (rest[:, 0], rest[:, -1] * error.rotated), half) > 0
        near, far = self.span(which, joints, target, half)
        return (near > self.most[which]) | (far < self.least[which])

    def span(self, which: int, joints: list[Array], target: list[Array], half: Array) -> tuple[Array, Array]:
        """Below and above the distance of a lemma's point from the target; half widths (N, V) are those of an error."""
        last, end, own = len(joints), self.points[which], half[:, : len(joints)]
        at, to = self.arm.moved(joints, 0, end, len(half)), self.goal.moved([target[axis] for axis in self.places])
        out, lengths = np.reshape([x[:, 0] for x in joints], own.T.shape).T, self.arm.lengths(0, last, end)
        bends = [self.arm.bend(order, own, lengths, out) for order in (1, 2, 3)]
        bends[0] += length(half[:, last + self.turning :])
        return span(place(at, at.columns, at.tip, to, to.columns, to.tip), bends, half)

    def holds(self, witness: list[str]) -> bool:
        """Whether a configuration is one of those that are meant, and its tool in the box of targets."""
        q, given = [real(x) for x in witness], self._given
        ranges = [given["angle"] if k == given["locked"] else pair for k, pair in enumerate(given["limits"])]
        tip, sides = self.arm.moved(configuration(witness)).tip, [[real(x) for x in pair] for pair in given["target"]["box"]]
        ends = zip(sides, tip.low[0], -(-tip).low[0], strict=False)
        within = all(real(pair[0]) <= x <= real(pair[1]) for x, pair in zip(q, ranges, strict=True))
        inside = all(a <= x and y <= b for (a, b), x, y in ends) and given["task"] in ("planar", "position")
        return within and (inside or self._near(q, tip.at[0], sides))

    def _near(self, q: list[float], tip: Array, sides: list[list[float]]) -> bool:
        """Whether a configuration near one, with the same locked value, reaches a target of the box: that is a reach's leaf."""
        linear = self.p - self.turning
        where = [min(max(x, low), high) for x, (low, high) in zip(tip.tolist()[:linear], sides, strict=False)]
        where += [(low + high) / 2 for low, high in sides[linear:]]
        given = self._given | {"target": self._given["target"] | {"box": [[x.hex(), x.hex()] for x in where]}}
        if given["locked"] >= 0:
            given["angle"] = [q[given["locked"]].hex()] * 2
        leaves = Leaves(given)
        counts = np.where([k in leaves.free for k in range(self.n)], np.array(q) / UNIT, 0.0)
        return bool(leaves.proves(0, [(((0, 0),) * len(leaves.width), counts)])[0])


class Ring(Boxes):
    """That with joints in ranges of theirs no configuration has the tool where it is with all of them at other values.

    ``turns``: whether its rotation is given as well; else the later one of two points must be the tool point.
    """

    def __init__(self, arm: dict[str, Any], ranges: list[Any], *, tool: list[Fraction], turns: bool, flat: bool) -> None:
        super().__init__({}, within_a_turn(ranges, arm["joints"]))
        self.chain, self.n, self.turns_too, self._kept = Chain(arm, flat), len(ranges), turns, np.array([1, 1, not flat])
        chain, self.tip = self.chain, self.chain.origins[-1]
        at = chain.moved([np.array([turned(x)]) for x in tool])
        # From the tool back to the base: where that is seen from the last link, and how turned.
        turn = times("ij,jk->ik", chain.turns[-1], at.turn[0].transposed(1, 0))
        self._base = -times("ij,j->i", turn, at.tip[0]) + self.tip, turn
        begin = self._seen(chain.origins[0])
        chain.origins = [*chain.origins[:-1], begin.at, *chain.origins[1:]]
        chain.turns = [*chain.turns[:-1], times("ij,jk->ik", turn, chain.turns[0]), *chain.turns[1:]]
        chain.slides, chain.n, self._off = np.tile(chain.slides, 2), 2 * self.n, begin.off

    def _seen(self, point: Array) -> Balls:
        """A place of the base, from the last link."""
        return self._base[0] + times("ij,j->i", self._base[1], point)

    def excludes(self, pair: list[tuple[int, Array]], parts: list[Cell]) -> Flags:
        """Of leaves: whether two points, each (link, (3,) m in its frame), are never so far apart on both ways round."""
        (first, a), (last, b) = ((link, point * self._kept) for link, point in pair)
        known = self.turns_too or (last == self.n and (b == self.tip).all())
        need(first <= last and known, "a point is behind the one it is paired with, or its place is not known")
        joints, count = self.middles(parts), len(parts)
        near, far = apart(self.chain, joints[first:last], first, a, b, count)
        end = Balls(a) if first else self._seen(a)
        low, high = apart(self.chain, joints[last:] + joints[:first], last, b, end.at, count)
        off = length(self._off + end.off, 0) * 2
        return np.asarray((near > (high + off) * UP) | (far < low - off * UP))


class Unfinished(Motion):
    """Lock instants of a path after which no configuration has the tool where it must be, at some later place."""

    def __init__(self, document: dict[str, Any]) -> None:
        super().__init__(document)
        self._points = [(point["link"], np.array([real(x) for x in point["place"]])) for point in document["points"]]

    def rejected(self, chunk: list[Never]) -> tuple[int, list[tuple[Never, int]]]:
        """How many leaves were checked, and what is not refuted, each with how many of its leaves are bad."""
        bad, given = list[tuple[Never, int]](), self._given
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for one in chunk:
                which, ends, at, leaves = one
                lock, ranges = given["locks"][which]["joint"], [[real(x) for x in pair] for pair in given["limits"]]
                ranges[lock] = sorted(self.joints(2 * x, max(x - 1, 0) // SEGMENT)[lock] for x in ends)
                tool, turns = self.joints(2 * at, (at - 1) // SEGMENT), "pose" in self.task
                ring, good = Ring(given["arm"], ranges, tool=tool, turns=turns, flat=self.task.startswith("planar")), 0
                for token in sorted({token for token, _ in leaves}):
                    pair = [self._points[k] for k in given["pairs"][token]]
                    good += int(ring.excludes(pair, [cell for other, cell in leaves if other == token]).sum())
                bad += [(one, len(leaves) - good)] * (good < len(leaves))
        return sum(len(leaves) for *_, leaves in chunk), bad


def within_a_turn(ranges: list[Any], joints: list[dict[str, Any]]) -> list[Any]:
    """Ranges (low, high) of joints, of those that turn a full turn at most."""
    full, made = math.nextafter(math.pi, 4), list[Any]()
    for pair, joint in zip(ranges, joints, strict=True):
        low, high = (real(x) if isinstance(x, str) else x for x in pair)
        turns = joint["type"] == "revolute"
        need(turns or math.isfinite(high - low), f"{joint['name']} slides without an end")
        made.append([-full, full] if turns and not high - low < 2 * math.pi else [low, high])
    return made
