"""Ceilings of relative manipulability: a wrench for each box of configurations bounds it from above.

Let a_l be the moment of a wrench y about the axis of joint l. Whatever y is, the relative manipulability after a lock of joint
k is at most sqrt(A / (A + a_k^2)), A the sum of the other a_l^2; the best y gives exactly it. In each box y moves with the
joints, y = y_0 + Y (q - q_c), where Y keeps the a_l as still as it can. Screws are those of axes seen from a link in the middle
of the arm, so that the first and the last joint count nothing; their first and second derivatives are brackets, exact at the
centre.
Everything here may be wrong: the verifier decides.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.joint_boxes.halving import OPEN, Index
from holdfast.certificates.joint_boxes.screws import Screws
from holdfast.certificates.taylor import Chain

Array = NDArray[np.float64]

LOCK = 128  # token of a box in which joint 0 costs enough
_MARGIN = 1e-9
_DAMPED = 0.01  # times the square of the largest half width that counts, added to the squares of the screws


class Ceiling:
    """The test of boxes of configurations: whether relative manipulability is at most a threshold after one of some locks.

    Args:
        chain: The arm.
        locks: Joints, one of which suffices.
        threshold: Above 0, below 1.
    """

    def __init__(self, chain: Chain, locks: tuple[int, ...], threshold: float) -> None:
        self.screws, self.locks = Screws(chain), locks
        self.slope = threshold / np.sqrt(1 - threshold**2)

    def __call__(self, middle: Array, half: Array) -> tuple[Index, Array]:
        """Tokens, and what halving each joint gains."""
        screws, brackets, links, away = self.screws(middle)
        gram, count = np.einsum("nla,nlb->nab", screws, screws), len(middle)
        counted = self.screws.sign.any(axis=0)
        damped = _DAMPED * (half * counted).max(axis=1) ** 2
        whole = gram + damped[:, None, None] * np.eye(6)
        kept = 1 - np.einsum("nla,nla->nl", screws, np.linalg.solve(whole, screws.transpose(0, 2, 1)).transpose(0, 2, 1))
        found, best, gain = np.full(count, OPEN, dtype=np.int64), np.full(count, np.inf), half * counted
        lost = kept[:, list(self.locks)]
        for rank in range(min(2, len(self.locks))):
            k = np.array(self.locks)[np.argsort(lost, axis=1)[:, rank]]
            ratio, each = self._ratio(k, screws, gram, brackets, links, away, half, damped)
            better = (ratio < best) & np.isfinite(each).all(axis=1)
            best[better], gain[better] = ratio[better], each[better]
            good = better & (ratio < self.slope * (1 - _MARGIN))
            found[good] = LOCK + k[good]
        return found, gain

    def _ratio(
        self, k: Index, screws: Array, gram: Array, brackets: Array, links: Array, away: Array, half: Array, damped: Array
    ) -> tuple[Array, Array]:
        """Above sqrt(A) / |a_k| (N,), and what of it each joint's half width costs (N, n)."""
        sign, nearer = self.screws.sign, self.screws.nearer
        moved = brackets.transpose(0, 2, 1, 3) * sign[:, :, None]  # (N, l, j, 6)
        rows = np.arange(len(k))
        own = screws[rows, k]
        others = gram - own[:, :, None] * own[:, None] + damped[:, None, None] * np.eye(6)
        y = np.linalg.solve(others, own[:, :, None])[:, :, 0]
        y = y / np.einsum("na,na->n", y, own)[:, None]  # its moment about axis k is 1
        b = np.einsum("nljb,nb->nlj", moved, y)
        pull = np.einsum("nla,nlj->naj", screws, b) - own[:, :, None] * b[rows, k][:, None]
        turn = -np.linalg.solve(others, pull)  # (N, 6, j)
        turn -= y[:, :, None] * (np.einsum("na,naj->nj", own, turn) + b[rows, k])[:, None]
        slope = b + np.einsum("nla,naj->nlj", screws, turn)
        m, f, z, v = y[:, None, :3], y[:, None, 3:], screws[:, :, :3], screws[:, :, 3:]
        w = np.concatenate([np.cross(m, z) + np.cross(f, v), np.cross(f, z)], axis=2)
        twice = np.einsum("nia,njla->nlij", w, brackets) * np.abs(sign[:, :, None] * sign[:, None])
        cross = np.einsum("nai,nlja->nlij", turn, moved)
        pair = twice * nearer + cross + cross.transpose(0, 1, 3, 2)
        pair = np.triu(np.abs(np.where(nearer > 0, pair, pair.transpose(0, 1, 3, 2))), 1)
        diagonal = np.abs(np.einsum("nljj->nlj", twice) / 2 + np.einsum("nljj->nlj", cross))
        mixed = pair * half[:, None, :, None] * half[:, None, None]
        by_axis = np.abs(slope) * half[:, None] + diagonal * half[:, None] ** 2 + (mixed.sum(axis=2) + mixed.sum(axis=3)) / 2
        z2, v2, z3, v3 = self.screws.remains(links, away, half)
        moment, force = (np.linalg.norm(x, axis=1)[:, None] for x in (y[:, :3], y[:, 3:]))
        more = [np.einsum("nj,nj->n", np.linalg.norm(x, axis=1), half)[:, None] for x in (turn[:, :3], turn[:, 3:])]
        third = moment * z3 + force * v3 + more[0] * z2 + more[1] * v2
        e = np.abs(np.einsum("nla,na->nl", screws, y)) + by_axis.sum(axis=2) + third
        own_low = 2 - e[rows, k]  # its moment is 1
        e[rows, k] = 0
        size = np.sqrt((e**2).sum(axis=1))
        each = np.einsum("nl,nlj->nj", e, by_axis + third[:, :, None] * np.abs(sign) / 2)
        return np.where(own_low > 0, size / np.maximum(own_low, 1e-9), np.inf), each
