"""The leaves of a floor of relative manipulability: each has a motion that keeps the tool where it is.

The motion of the joints is x = nu + N (q - q_c) + P s, and for some s the tool is still (Brouwer again): after a lock of joint
k at least |x_k| / |x| is left.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .balls import LEAST, UP, Balls, crossed, joined, length, times
from .chain import Array
from .tree import Cell
from .wrenches import Wrenches

ROWS_OF_SCREWS = {6: [0, 1, 2, 3, 4, 5], 3: [2, 3, 4]}  # rows of a ceiling or floor, axes first


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
