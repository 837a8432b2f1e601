"""Floors of relative manipulability: a motion of the joints for each box of configurations that keeps the tool where it is.

With any x for which J x = 0, the relative manipulability after a lock of joint k is at least |x_k| / |x|. In each box x follows
the joints, x = nu + N (q - q_c) + P s, with nu and N from the middle, such that J x is of second order, and P the
pseudo-inverse there: that some small s makes J x = 0 is Brouwer's theorem once more. J is made of screws.
Everything here may be wrong: the verifier decides.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.joint_boxes.halving import OPEN, Index
from holdfast.certificates.joint_boxes.screws import Screws
from holdfast.certificates.taylor import Chain

Array = NDArray[np.float64]

_MARGIN, _ROUNDS = 1e-9, 12


class Floor:
    """The test of boxes of configurations: whether relative manipulability is at least a threshold after each of some locks.

    Args:
        chain: The arm.
        rows: Of axes, then of moments, that are all of its motion.
        locks: Joints.
        threshold: Above 0, below 1.
    """

    def __init__(self, chain: Chain, rows: list[int], locks: tuple[int, ...], threshold: float) -> None:
        self.screws, self.rows, self.locks, self.threshold = Screws(chain), rows, locks, threshold

    def __call__(self, middle: Array, half: Array) -> tuple[Index, Array]:
        """Tokens, 0 where all locks leave enough, and what halving each joint gains."""
        count, n = half.shape
        screws, brackets, links, away = self.screws(middle)
        jacobian = screws.transpose(0, 2, 1)[:, self.rows]
        with np.errstate(all="ignore"):
            inverse = np.linalg.pinv(np.nan_to_num(jacobian))  # (N, n, m)
        onto = np.eye(n) - inverse @ jacobian
        spare, gain = np.full(count, np.inf), np.zeros(half.shape)
        redundant = n - len(self.rows)
        for first, locks in [(0, self.locks)] if redundant == 1 else [(k, (k,)) for k in self.locks]:
            nu = np.linalg.svd(np.nan_to_num(jacobian))[2][:, -1] if redundant == 1 else onto[:, :, first]
            nu = nu / np.maximum(np.linalg.norm(nu, axis=1), 1e-12)[:, None]
            far, shift, follow, axis, closed = self._kernel(nu, screws, jacobian, inverse, brackets, links, away, half)
            turned = np.abs(np.einsum("nl,nlj->nj", nu, follow))
            long = np.sqrt(1 + 2 * (turned * half).sum(axis=1) + (far**2).sum(axis=1)) + np.linalg.norm(shift, axis=1)
            for k in locks:
                low = np.where(closed, np.abs(nu[:, k]) - far[:, k] - shift[:, k] - self.threshold * long, -1.0)
                each = np.abs(follow[:, k]) * half + np.einsum("nb,njb->nj", np.abs(inverse[:, k]), axis)
                each += self.threshold * np.einsum("nlj,nl->nj", np.abs(follow), far) * half
                worse = np.flatnonzero(low < spare)
                spare[worse], gain[worse] = low[worse], each[worse]
        gain = np.where(np.asarray(np.isfinite(gain).all(axis=1))[:, None], gain, half * self.screws.sign.any(axis=0))
        return np.where(spare > _MARGIN, 0, OPEN), gain

    def _kernel(
        self,
        nu: Array,
        screws: Array,
        jacobian: Array,
        inverse: Array,
        brackets: Array,
        links: Array,
        away: Array,
        half: Array,
    ) -> tuple[Array, Array, Array, Array, NDArray[np.bool_]]:
        """How far x goes: with the joints and by P s (N, n) each, how it follows (N, n, n), of what, and whether s exists."""
        rows, side = self.rows, self.screws.side
        moved = brackets * np.abs(self.screws.sign).T[None, :, :, None]  # (N, j, l, 6): screw l where j moves it
        by_joint = np.einsum("njlb,nl->njb", moved, nu)
        slope = (side[:, None] * by_joint)[:, :, rows]
        follow = -np.einsum("nlb,njb->nlj", inverse, slope)
        slope = slope + np.einsum("nbl,nlj->njb", jacobian, follow)
        z, v, u, w = screws[:, :, None, :3], screws[:, :, None, 3:], by_joint[:, None, :, :3], by_joint[:, None, :, 3:]
        twice = np.concatenate([np.cross(z, u), np.cross(z, w) + np.cross(v, u)], axis=3)  # (N, i, j, 6), i the nearer
        twice = twice * (self.screws.nearer * (side[:, None] == side))[:, :, None]
        cross = np.einsum("njlb,nli->njib", moved, follow) * side[:, None, None]
        both = twice + cross + cross.transpose(0, 2, 1, 3)
        both = np.where(self.screws.nearer[:, :, None] > 0, both, both.transpose(0, 2, 1, 3))
        pairs = np.abs(both[..., rows]) * (half[:, :, None] * half[:, None])[..., None]
        pairs = pairs * np.triu(np.ones((len(side), len(side))), 1)[:, :, None]
        own = np.abs((np.einsum("njjb->njb", twice) / 2 + np.einsum("njjb->njb", cross))[..., rows]) * half[:, :, None] ** 2
        axis = np.abs(slope) * half[:, :, None] + own + (pairs.sum(axis=1) + pairs.sum(axis=2)) / 2
        z2, v2, z3, v3 = self.screws.remains(links, away, half)
        second, third = (np.stack([a] * 3 + [b] * 3, axis=2)[..., rows] for a, b in ((z2, v2), (z3, v3)))
        far = np.einsum("nlj,nj->nl", np.abs(follow), half)
        left = np.abs(np.einsum("nbl,nl->nb", jacobian, nu)) + axis.sum(axis=1)
        left = left + np.einsum("nl,nlb->nb", np.abs(nu), third) + np.einsum("nl,nlb->nb", far, second)
        first = np.abs(np.einsum("njlb,nlc->njbc", moved, inverse)[:, :, rows])
        miss = np.einsum("njbc,nj->nbc", first, half) + np.einsum("nlb,nlc->nbc", second, np.abs(inverse))
        s = left
        for _ in range(_ROUNDS):
            s = 1.02 * (left + np.einsum("nbc,nc->nb", miss, s)) + 1e-15
        closed = (left + np.einsum("nbc,nc->nb", miss, s) < s * (1 - 1e-9)).all(axis=1) & (s < 1e3).all(axis=1)
        return far, np.einsum("nlb,nb->nl", np.abs(inverse), s), follow, axis, closed
