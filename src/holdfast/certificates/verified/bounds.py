"""The leaves of ceilings and floors of relative manipulability.

With the moments a_l of any wrench about the axes, relative manipulability after a lock of joint k is at most
sqrt(A / (A + a_k^2)), A the sum of the other a_l^2. In each leaf of a ceiling a wrench that is affine in the joints shows this
of some k. As its axes are seen from a link in the middle of the arm, first and last joint count nothing.

A floor has a motion x of the joints in each leaf, x = nu + N (q - q_c) + P s, and for some s the tool is still (Brouwer again):
after a lock of joint k at least |x_k| / |x| is left.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from .balls import LEAST, UP, Array, Balls, Flags, above, crossed, flint, joined, length, solve_regular, stacked, times
from .chain import Boxes, Chain, Leaf, configuration
from .forms import need, real, unpacked
from .taylor import Form
from .tree import MOST_LEAVES, SPLIT, Cell, cells

SIX = {"pose": [0, 1, 2, 3, 4, 5], "planar-pose": [2, 3, 4]}  # rows of a screw that count
LOCK = 128  # in a ceiling: what a lock of the first joint costs enough; 2 is undecided


class Screws:
    """Axes and their moments about a point on the middle one, in boxes of joints, seen from the link in the middle.

    Joints are ordered from there to the tool, then to the base. The derivative of screw l by joint j is the bracket of screws j
    and l if j is nearer, and so on with joints nearer still; before the middle with the other sign.
    """

    def __init__(self, arm: Chain, joints: list[Array]) -> None:
        n, middle = arm.n, arm.n // 2
        self.order, moved = [*range(middle, n), *range(middle - 1, -1, -1)], arm.moved(joints)
        self.half = np.stack([joints[k][:, 2] for k in self.order], 1)
        self.side = np.array([1.0] * (n - middle) + [-1.0] * middle)
        self.same = 1.0 * (self.side[:, None] == self.side)
        self.moves = np.tril(self.same, -1)  # axis l by joint j
        z, path, last = moved.axes[:, self.order], list[Balls](), moved.tip
        links = np.zeros(self.half.shape)
        for j, k in enumerate(self.order):  # any point of an axis will do: one that is near the one before
            last, at = path[0] if j == n - middle else last, moved.places[:, k]
            path.append(at + times("n,na->na", np.nan_to_num(((last.at - at.at) * z.at[:, j]).sum(axis=1)), z[:, j]))
            links[:, j], last = length((path[j] + -last).size), path[j]
        away = stacked(path) + -path[0][:, None]
        v = times("nlij,nlj->nli", crossed(away), z)
        spin, shift, none = crossed(z), crossed(v), Balls(np.zeros((*z.at.shape, 3)))
        self.screw, self.operator = joined(2, z, v), joined(2, joined(3, spin, none), joined(3, shift, spin))
        # (N, j, l, 6), of which the second derivative by i and j is the bracket with i.
        self.bracket = times("njab,nlb->njla", self.operator, self.screw).signed(self.moves.T[:, :, None])
        # A link of the path to an axis goes with the joints between the middle and it.
        c = self.half @ self.moves.T
        one, two, three = ((links * c**power) @ (self.moves + np.eye(n)).T for power in (1, 2, 3))
        far = length(away.size, 2) + one
        left = [(c**2, two + 2 * one * c + far * c**2), (c**3 / 3, (three + 3 * two * c + 3 * one * c**2 + far * c**3) / 3)]
        # Above what is left behind first order, and behind second; (N, n, 6).
        self.second, self.third = (np.stack([x] * 3 + [y] * 3, 2) / 2 * UP + LEAST for x, y in left)


class Wrenches(Boxes):
    """The leaves of a ceiling of relative manipulability; each has a joint whose lock costs enough."""

    def __init__(self, document: dict[str, Any]) -> None:
        super().__init__(document, document["joint_box"])
        self.arm = Chain(document["arm"], document["task"] == "planar-pose")
        self.threshold, self.rows, self.locks = real(document["threshold"]), SIX[document["task"]], document["locks"]

    def leaves(self, document: dict[str, Any]) -> tuple[int, list[Cell], Callable[[], Iterator[Leaf]]]:
        """How many there are, which cells are undecided, and the leaves, each with a joint, or 0 of a floor."""
        tree, n = unpacked(document["tree"], 2 * MOST_LEAVES - 1, "tree"), self.arm.n
        good = {LOCK + k for k in self.locks} if document["kind"] == "ceiling" else {0}
        need(set(tree) <= good | {2, *range(SPLIT, SPLIT + n)}, "a token of the tree is unknown, or not among the locks")
        undecided = [cell for token, cell in cells(tree, n, 2, LOCK) if token == 2]

        def leaves() -> Iterator[Leaf]:
            return ((cell, max(token - LOCK, 0)) for token, cell in cells(tree, n, 2, LOCK) if token != 2)

        return sum(tree.count(token) for token in good), undecided, leaves

    def proves(self, kind: int, leaves: list[Leaf]) -> Flags:
        """Whether a lock of one joint costs enough, in leaves that say so."""
        x, c = Screws(self.arm, self.middles(cell for cell, _ in leaves)), self.threshold
        k, half, moves = x.order.index(kind), x.half, x.bracket.signed(x.side[:, None, None])
        y, turn = self.wrench(x, k)
        slopes = times("njla,na->nlj", moves, y) + times("nla,naj->nlj", x.screw, turn)
        cross = times("nai,njla->nlij", turn, moves)
        twice = times("nib,njlb->nlij", times("niab,na->nib", x.operator, y), x.bracket).signed(x.moves[:, :, None])
        second = twice.mirrored() + cross + cross.transposed(0, 1, 3, 2)
        form = Form(times("nla,na->nl", x.screw, y), slopes, second)
        rest = sum(
            (length(turn[:, part]) * half).sum(axis=1)[:, None] * x.second[:, :, part.start]
            + length(y[:, part])[:, None] * x.third[:, :, part.start]
            for part in (slice(0, 3), slice(3, 6))
        )
        others = form.most(half, rest)
        least = np.maximum(np.nextafter(form.value.low - (form.loss(half)[0] + rest) * UP, -np.inf)[:, k], 0)
        others[:, k] = 0
        high, low = (others**2).sum(axis=1) * ((1 - c) * (1 + c)) * UP, c**2 * least**2 * (1 - 1e-12)
        return np.asarray((high < low) & (least > 1e-100))

    def wrench(self, x: Screws, k: int) -> tuple[Array, Array]:
        """Any wrench y (N, 6), and how it follows the joints (N, 6, n): such that other moments hardly change."""
        own, others = x.screw.at[:, k], np.delete(x.screw.at, k, axis=1)
        counts = (x.half * x.moves.any(axis=0)).max(axis=1)
        gram = np.einsum("nla,nlb->nab", others, others) + (0.01 * counts**2 + 1e-30)[:, None, None] * np.eye(6)
        y = solve_regular(gram, own[:, :, None])[:, :, 0]
        y = y / (y * own).sum(axis=1)[:, None]
        slopes = np.einsum("njla,na->nlj", x.bracket.at, y) * x.side
        turn = -solve_regular(gram, np.einsum("nla,nlj->naj", others, np.delete(slopes, k, axis=1)))
        turn = turn - y[:, :, None] * (np.einsum("na,naj->nj", own, turn) + slopes[:, k])[:, None]
        return np.nan_to_num(y), np.nan_to_num(turn)

    def occurs(self, q: list[str]) -> tuple[float, float]:
        """Around the least relative manipulability at a configuration: its square is 1 - J_k' (JJ')^-1 J_k."""
        inside = all(real(a) <= real(x) <= real(b) for x, (a, b) in zip(q, self._given["joint_box"], strict=True))
        need(inside, "the configuration that was found is outside of the box")
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            moved = self.arm.moved(configuration(q))
            made = joined(2, moved.axes, moved.columns)[0][:, self.rows].transposed(1, 0)
            entries = [flint.arb(float(x), float(e)) for x, e in zip(made.at.flat, made.off.flat, strict=True)]
            jacobian = flint.arb_mat(*made.at.shape, entries)
            try:
                solved = (jacobian * jacobian.transpose()).solve(jacobian)
            except ZeroDivisionError:
                return 0.0, 1.0
            kept = [1 - sum(jacobian[i, k] * solved[i, k] for i in range(len(self.rows))) for k in self.locks]
            low, high = max(0.0, -max(above(-x) for x in kept)), max(0.0, min(above(x) for x in kept))
        return math.sqrt(low) * (1 - 1e-15), math.sqrt(high) * (1 + 1e-15)


class Motions(Wrenches):
    """The leaves of a floor; each has a motion that keeps the tool where it is."""

    def proves(self, kind: int, leaves: list[Leaf]) -> Flags:
        """Whether all locks leave enough."""
        x = Screws(self.arm, self.middles(cell for cell, _ in leaves))
        locks, n = [x.order.index(k) for k in self.locks], self.arm.n
        jacobian = np.nan_to_num(x.screw.at[:, :, self.rows].transpose(0, 2, 1))
        inverse = np.nan_to_num(np.linalg.pinv(jacobian))
        if n - len(self.rows) == 1:
            return self.enough(x, np.linalg.svd(jacobian)[2][:, -1], inverse, locks)
        onto = np.eye(n) - inverse @ jacobian
        return np.asarray(np.all([self.enough(x, onto[:, :, k], inverse, [k]) for k in locks], axis=0))

    def enough(self, x: Screws, nu: Array, inverse: Array, locks: list[int]) -> Flags:
        """Whether some nu + N (q - q_c) + P s keeps the tool still all over the leaf, and its parts are large enough."""
        nu, half, rows = np.nan_to_num(nu / length(nu)[:, None]), x.half, self.rows
        moves, screw = x.bracket.signed(x.side[:, None, None])[..., rows], x.screw[..., rows]
        u = times("njlb,nl->njb", x.bracket, nu)
        slopes = u.signed(x.side[:, None])[:, :, rows].transposed(0, 2, 1)
        follow = np.nan_to_num(-np.einsum("nlb,nbj->nlj", inverse, slopes.at))
        cross = times("njlb,nli->nbij", moves, follow)
        twice = times("niab,njb->naij", x.operator, u)[:, rows].signed(x.same).mirrored()
        slopes, second = slopes + times("nlb,nlj->nbj", screw, follow), twice + cross + cross.transposed(0, 1, 3, 2)
        far = np.einsum("nlj,nj->nl", abs(follow), half) * UP
        rest = np.einsum("nl,nlb->nb", abs(nu), x.third[..., rows]) + np.einsum("nl,nlb->nb", far, x.second[..., rows])
        off = Form(times("nlb,nl->nb", screw, nu), slopes, second).most(half, rest * UP)
        whole = times("nlb,nlc->nbc", screw, inverse) + -np.eye(len(rows))
        miss = whole.size + np.einsum("njbc,nj->nbc", times("njlb,nlc->njbc", moves, inverse).size, half)
        miss = (miss + np.einsum("nlb,nlc->nbc", x.second[..., rows], abs(inverse))) * UP + LEAST
        s = off
        for _ in range(12):
            s = 1.02 * (off + np.einsum("nbc,nc->nb", miss, s)) + 1e-15
        # s -> s - J x sends its box into itself; and as miss s < s, J P has an inverse everywhere: nothing is singular.
        closed = ((off + np.einsum("nbc,nc->nb", miss, s)) * UP < s).all(axis=1) & (s < 1e3).all(axis=1)
        shift = np.einsum("nlb,nb->nl", abs(inverse), s) * UP
        long = (nu**2).sum(axis=1) + 2 * (times("nl,nlj->nj", nu, follow).size * half).sum(axis=1) + (far**2).sum(axis=1)
        long = (np.sqrt(long * UP) + length(shift)) * UP
        least = np.nextafter(abs(nu) - (far + shift) * UP, -np.inf)[:, locks].min(axis=1)
        return np.asarray(closed & (least > 1e-100) & (least > self.threshold * long * UP))
