"""The leaves of ceilings and floors of relative manipulability.

With the moments a_l of any wrench about the axes, relative manipulability after a lock of joint k is at most
sqrt(A / (A + a_k^2)), A the sum of the other a_l^2. In each leaf of a ceiling a wrench that is affine in the joints shows this
of some k. As its axes are seen from a link in the middle of the arm, first and last joint count nothing.

A floor has a motion x of the joints in each leaf, x = nu + N (q - q_c) + P s, and for some s the tool is still (Brouwer again):
after a lock of joint k at least |x_k| / |x| is left.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .balls import LEAST, UP, Balls, above, crossed, flint, joined, length, stacked, times
from .boxes import Boxes
from .chain import Array
from .forms import real
from .tree import Cell

SIX = {"pose": [0, 1, 2, 3, 4, 5], "planar-pose": [0, 1, 5]}  # rows of a ceiling or floor, positions first
ROWS_OF_SCREWS = {6: [0, 1, 2, 3, 4, 5], 3: [2, 3, 4]}  # the same, axes first


class Wrenches(Boxes):
    """The leaves of a ceiling of relative manipulability; each has a joint whose lock costs enough."""

    def __init__(self, document: dict[str, Any]) -> None:
        self._given = document | {"tree": ""}
        super().__init__(document["arm"], document["joint_box"], document["task"] == "planar-pose")
        self.threshold, self.rows, self.locks = real(document["threshold"]), SIX[document["task"]], document["locks"]
        line, column = np.indices(
            (self.n, self.n)
        )  # joint j moves axis l, seen from link n/2: one way behind it, the other before
        self.middle = self.n // 2
        behind, before = (column >= self.middle) & (column < line), (column < self.middle) & (column > line)
        self.sign, self.side = 1.0 * behind - 1.0 * before, np.where(np.arange(self.n) >= self.middle, 1.0, -1.0)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._given,)

    def screws(self, joints: list[Array]) -> tuple[Balls, Balls, Balls, Array, Array]:
        """Axes, moments of these about a point on the middle one, brackets, distances from axis to axis and to the point."""
        moved = self.moved(joints)
        tip, z, places = moved.tip, moved.axes, moved.places
        path = [places[:, k] for k in range(self.n)]
        links, order = np.zeros((len(places.at), self.n)), [*range(self.middle, self.n), *range(self.middle - 1, -1, -1)]
        for j in order:  # any point of an axis will do: one that is near the one before, of the middle axis near the tool
            last = tip if j == self.middle else path[j - 1 if j > self.middle else j + 1]
            along = np.nan_to_num(((last.at - path[j].at) * z.at[:, j]).sum(axis=1))
            path[j] += times("n,na->na", Balls(along), z[:, j])
            links[:, j] = length((path[j] + -last).size)
        away = stacked(path, 1) + -path[self.middle][:, None]
        v = times("nlij,nlj->nli", crossed(away), z)
        # The derivative of screw l by joint j is the bracket of screws j and l, and so on with joints nearer the middle.
        shifted = times("njab,nlb->njla", crossed(z), v) + times("njab,nlb->njla", crossed(v), z)
        return z, v, joined(times("njab,nlb->njla", crossed(z), z), shifted), links, length(away.size, 2)

    def remains(self, links: Array, away: Array, half: Array) -> list[Array]:
        """Above what is left of axes and of moments behind first order, and behind second: (leaves, n) each."""
        c, v = half @ abs(self.sign).T, np.zeros((3, *links.shape))
        for j in range(self.n):
            between = slice(self.middle, j) if j > self.middle else slice(j + 1, self.middle)
            for r in range(3 if j not in (self.middle, self.middle - 1) else 0):
                carried = slice(j, self.n) if j > self.middle else slice(0, j + 1)
                v[r, :, carried] += (links[:, j] * half[:, between].sum(axis=1) ** (r + 1))[:, None]
        far = away + v[0]
        second, third = v[1] + 2 * v[0] * c + far * c**2, v[2] + 3 * v[1] * c + 3 * v[0] * c**2 + far * c**3
        return [x * UP + LEAST for x in (c**2 / 2, second / 2, c**3 / 6, third / 6)]

    def wrench(self, own: Array, others: Array, moved: Array, half: Array, k: int) -> tuple[Array, Array]:
        """Any wrench y (leaves, 6), and how it follows the joints (leaves, 6, n): such that other moments hardly change."""
        counts = half * self.sign.any(axis=0)
        gram = np.einsum("nla,nlb->nab", others, others) + 0.01 * (counts.max(axis=1) ** 2)[:, None, None] * np.eye(6)
        gram += 1e-30 * np.eye(6)
        y = np.linalg.solve(gram, own[:, :, None])[:, :, 0]
        y = y / (y * own).sum(axis=1)[:, None]
        slopes = np.einsum("nljb,nb->nlj", moved, y)
        turn = -np.linalg.solve(gram, np.einsum("nla,nlj->naj", others, np.delete(slopes, k, axis=1)))
        turn = turn - y[:, :, None] * (np.einsum("na,naj->nj", own, turn) + slopes[:, k])[:, None]
        return np.nan_to_num(y), np.nan_to_num(turn)

    def costs(self, k: int, parts: list[Cell]) -> NDArray[np.bool_]:
        """Of leaves: whether a lock of joint k costs enough."""
        joints = [self.middles(j, parts) for j in range(self.n)]
        half = np.stack([joint[:, 2] for joint in joints], 1)
        z, v, bracket, links, away = self.screws(joints)
        screws, moved = joined(z, v), bracket.transposed(0, 2, 1, 3).signed(self.sign[:, :, None])
        y, turn = self.wrench(screws.at[:, k], np.delete(screws.at, k, axis=1), moved.at, half, k)
        wrench, turning = Balls(y), Balls(turn)
        slope = times("nljb,nb->nlj", moved, wrench) + times("nla,naj->nlj", screws, turning)
        force, moment = Balls(y[:, 3:]), Balls(y[:, :3])
        down = -(times("nlab,nb->nla", crossed(z), moment) + times("nlab,nb->nla", crossed(v), force))
        right = -times("nlab,nb->nla", crossed(z), force)
        twice = times("nia,njla->nlij", joined(down, right), bracket)
        mask = abs(self.sign[:, :, None] * self.sign[:, None])
        inner = np.arange(self.n)[:, None, None] >= self.middle  # behind the middle the nearer joint has the lower number
        twice = Balls(*(mask * np.where(inner, x, x.transpose(0, 1, 3, 2)) for x in (twice.at, twice.off)))
        cross = times("nai,nlja->nlij", turning, moved)
        pairs = np.triu((twice + cross + cross.transposed(0, 1, 3, 2)).size, 1)
        own = (Balls(twice.at / 2, twice.off / 2) + cross).size * np.eye(self.n)
        rest = (slope.size * half[:, None]).sum(axis=2) + np.einsum("ni,nlij,nj->nl", half, pairs + own, half)
        more = [(length(x) * half).sum(axis=1) for x in (turn[:, :3], turn[:, 3:])]
        sizes = [x[:, None] for x in (*more, length(y[:, :3]), length(y[:, 3:]))]
        rest = (rest + sum(x * left for x, left in zip(sizes, self.remains(links, away, half), strict=True))) * UP
        moments = times("nla,na->nl", screws, wrench)
        others, least = (moments.size + rest) * UP, np.maximum(np.nextafter(moments.low - rest, -np.inf)[:, k], 0)
        others[:, k], c = 0, self.threshold
        high, low = (others**2).sum(axis=1) * ((1 - c) * (1 + c)) * UP, c**2 * least**2 * (1 - 1e-12)
        return np.asarray((high < low) & (least > 1e-100))

    def rejected(self, chunk: list[tuple[Cell, int]]) -> tuple[int, list[Cell]]:
        """How many leaves were checked, and which of them prove nothing; each with the joint whose lock costs enough."""
        bad = list[Cell]()
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            for k in sorted({k for _, k in chunk}):
                parts = [cell for cell, other in chunk if other == k]
                bad += [cell for cell, good in zip(parts, self.costs(k, parts), strict=True) if not good]
        return len(chunk), bad

    def occurs(self, q: list[str]) -> tuple[float, float]:
        """Around the least relative manipulability at a configuration: its square is 1 - J_k' (JJ')^-1 J_k."""
        moved = self.moved(self.at(q))
        made, z = moved.columns, moved.axes
        values, errors = (np.concatenate([x[0], y[0]], 1).T[self.rows] for x, y in ((made.at, z.at), (made.off, z.off)))
        entries = [flint.arb(float(x), float(e)) for x, e in zip(values.flat, errors.flat, strict=True)]
        jacobian = flint.arb_mat(*values.shape, entries)
        try:
            solved = (jacobian * jacobian.transpose()).solve(jacobian)
        except ZeroDivisionError:
            return 0.0, 1.0
        kept = [1 - sum(jacobian[i, k] * solved[i, k] for i in range(len(self.rows))) for k in self.locks]
        low, high = ([-above(-x) for x in kept], [above(x) for x in kept])
        return math.sqrt(max(0.0, min(low))) * (1 - 1e-15), math.sqrt(max(0.0, min(high))) * (1 + 1e-15)


class Motions(Wrenches):
    """The leaves of a floor; each has a motion that keeps the tool where it is."""

    def costs(self, k: int, parts: list[Cell]) -> NDArray[np.bool_]:
        """Of leaves: whether all locks leave enough."""
        joints = [self.middles(j, parts) for j in range(self.n)]
        half, rows = np.stack([joint[:, 2] for joint in joints], 1), ROWS_OF_SCREWS[len(self.rows)]
        z, v, bracket, links, away = self.screws(joints)
        screws = joined(z, v)[:, :, rows]
        given = half, z, v, screws, bracket.signed(abs(self.sign).T[:, :, None]), self.remains(links, away, half)
        jacobian = np.nan_to_num(screws.at.transpose(0, 2, 1))
        inverse = np.nan_to_num(np.linalg.pinv(jacobian))
        if self.n - len(rows) == 1:
            return self.leaves_enough(np.linalg.svd(jacobian)[2][:, -1], inverse, self.locks, *given)
        onto = np.eye(self.n) - inverse @ jacobian
        return np.asarray(np.all([self.leaves_enough(onto[:, :, k], inverse, [k], *given) for k in self.locks], axis=0))

    def leaves_enough(
        self,
        nu: Array,
        inverse: Array,
        locks: list[int],
        half: Array,
        z: Balls,
        v: Balls,
        screws: Balls,
        moved: Balls,
        left: Any,
    ) -> NDArray[np.bool_]:
        """Whether some x = nu + N (q - q_c) + P s keeps the tool still all over the leaf, and its parts are large enough."""
        rows, nu = ROWS_OF_SCREWS[len(self.rows)], np.nan_to_num(nu / length(nu)[:, None])
        second, third = (np.stack([a] * 3 + [b] * 3, axis=2)[:, :, rows] for a, b in (left[:2], left[2:]))
        u, side = times("njlb,nl->njb", moved, Balls(nu)), self.side[:, None]
        slope = u.signed(side)[:, :, rows]
        follow = np.nan_to_num(-np.einsum("nlb,njb->nlj", inverse, slope.at))
        slope += times("nlb,nlj->njb", screws, Balls(follow))
        turned, shifted = times("niab,njb->nija", crossed(z), u[:, :, :3]), times("niab,njb->nija", crossed(z), u[:, :, 3:])
        twice = joined(turned, shifted + times("niab,njb->nija", crossed(v), u[:, :, :3]))
        i, j = np.indices((self.n, self.n))  # i nearer the middle than j, or j itself
        nearer = (self.side[:, None] == self.side) & (np.where(self.side > 0, j - i, i - j) >= 0)
        twice = twice.signed(1 * nearer[:, :, None])
        cross = times("njlb,nli->njib", moved, Balls(follow)).signed(side[:, :, None])
        own = Balls(twice.at / 2, twice.off / 2) + cross
        both = twice + twice.transposed(0, 2, 1, 3) + cross + cross.transposed(0, 2, 1, 3)
        pairs = both.size * np.triu(np.ones((self.n, self.n)), 1)[:, :, None]
        bend = (pairs + own.size * np.eye(self.n)[:, :, None])[..., rows]
        off = times("nlb,nl->nb", screws, Balls(nu)).size + np.einsum("njb,nj->nb", slope.size, half)
        off += np.einsum("nijb,ni,nj->nb", bend, half, half) + np.einsum("nl,nlb->nb", abs(nu), third)
        far = np.einsum("nlj,nj->nl", abs(follow), half) * UP
        off = (off + np.einsum("nl,nlb->nb", far, second)) * UP + LEAST
        whole = times("nlb,nlc->nbc", screws, Balls(inverse)) + Balls(
            -np.broadcast_to(np.eye(len(rows)), (len(nu),) + (len(rows),) * 2)
        )
        miss = whole.size + np.einsum("njbc,nj->nbc", times("njlb,nlc->njbc", moved[..., rows], Balls(inverse)).size, half)
        miss = (miss + np.einsum("nlb,nlc->nbc", second, abs(inverse))) * UP + LEAST
        s = off
        for _ in range(12):
            s = 1.02 * (off + np.einsum("nbc,nc->nb", miss, s)) + 1e-15
        # s -> s - J x sends its box into itself; and as miss s < s, J P has an inverse everywhere: nothing is singular.
        closed = ((off + np.einsum("nbc,nc->nb", miss, s)) * UP < s).all(axis=1) & (s < 1e3).all(axis=1)
        shift = np.einsum("nlb,nb->nl", abs(inverse), s) * UP
        long = (
            (nu**2).sum(axis=1)
            + 2 * (times("nl,nlj->nj", Balls(nu), Balls(follow)).size * half).sum(axis=1)
            + (far**2).sum(axis=1)
        )
        long = (np.sqrt(long * UP) + length(shift)) * UP
        least = np.nextafter(abs(nu) - (far + shift) * UP, -np.inf)[:, locks].min(axis=1)
        return np.asarray(closed & (least > 1e-100) & (least > self.threshold * long * UP))
