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
from holdfast.certificates.joint_boxes.segments import Segment
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
        n = len(chain.lengths)
        self.n, self.locks, self.middle = n, locks, n // 2
        self.slope = threshold / np.sqrt(1 - threshold**2)
        self._arm = Segment.of(chain, 0, n, chain.origins[-1])
        rows, columns = np.indices((n, n))  # joint l, which joint j moves as seen from the middle
        self.sign = np.where((columns >= self.middle) & (columns < rows), 1.0, 0.0)
        self.sign -= (columns < self.middle) & (columns > rows)
        order = np.abs(np.arange(n) - self.middle + 0.5)
        self._nearer = (order[:, None] <= order[None]).astype(float)  # i before j

    def screws(self, q: Array) -> tuple[Array, Array, Array, Array]:
        """Axes and moments (N, n, 3) about a point, links between axes (N, n) and how far axes are from it (N, n)."""
        tip, axes, columns = self._arm.frames(q)
        places = tip[:, None] + np.cross(axes, columns)  # the foot of the tool on each axis
        where = places.copy()
        links, order = np.zeros(axes.shape[:2]), [*range(self.middle + 1, self.n), *range(self.middle - 1, -1, -1)]
        for j in order:
            before = j - 1 if j > self.middle else j + 1
            z = axes[:, j]
            where[:, j] += z * np.einsum("na,na->n", z, where[:, before] - where[:, j])[:, None]
            links[:, j] = np.linalg.norm(where[:, j] - where[:, before], axis=1)
        away = where - where[:, [self.middle]]
        return axes, np.cross(away, axes), links, np.linalg.norm(away, axis=2)

    def __call__(self, middle: Array, half: Array) -> tuple[Index, Array]:
        """Tokens, and what halving each joint gains."""
        z, v, links, away = self.screws(middle)
        screws = np.concatenate([z, v], axis=2)
        gram, count = np.einsum("nla,nlb->nab", screws, screws), len(middle)
        counted = self.sign.any(axis=0)
        damped = _DAMPED * (half * counted).max(axis=1) ** 2
        whole = gram + damped[:, None, None] * np.eye(6)
        kept = 1 - np.einsum("nla,nla->nl", screws, np.linalg.solve(whole, screws.transpose(0, 2, 1)).transpose(0, 2, 1))
        by_joint = np.concatenate(
            [
                np.cross(z[:, :, None], z[:, None]),
                np.cross(z[:, :, None], v[:, None]) + np.cross(v[:, :, None], z[:, None]),
            ],
            axis=3,
        )  # (N, j, l, 6)
        moved = by_joint.transpose(0, 2, 1, 3) * self.sign[:, :, None]  # (N, l, j, 6)
        found, best, gain = np.full(count, OPEN, dtype=np.int64), np.full(count, np.inf), half * counted
        lost = kept[:, list(self.locks)]
        for rank in range(min(2, len(self.locks))):
            k = np.array(self.locks)[np.argsort(lost, axis=1)[:, rank]]
            ratio, each = self._ratio(k, screws, gram, moved, by_joint, links, away, half, damped)
            better = (ratio < best) & np.isfinite(each).all(axis=1)
            best[better], gain[better] = ratio[better], each[better]
            found[better & (ratio < self.slope * (1 - _MARGIN))] = LOCK + k[better & (ratio < self.slope * (1 - _MARGIN))]
        return found, gain

    def _ratio(
        self,
        k: Index,
        screws: Array,
        gram: Array,
        moved: Array,
        by_joint: Array,
        links: Array,
        away: Array,
        half: Array,
        damped: Array,
    ) -> tuple[Array, Array]:
        """Above sqrt(A) / |a_k| (N,), and what of it each joint's half width costs (N, n)."""
        rows = np.arange(len(k))
        own = screws[rows, k]
        others = gram - own[:, :, None] * own[:, None] + damped[:, None, None] * np.eye(6)
        y = np.linalg.solve(others, own[:, :, None])[:, :, 0]
        along = y / np.einsum("na,na->n", y, own)[:, None]  # its moment about axis k is 1
        y = along
        b = np.einsum("nljb,nb->nlj", moved, y)
        pull = np.einsum("nla,nlj->naj", screws, b) - own[:, :, None] * b[rows, k][:, None]
        turn = -np.linalg.solve(others, pull)  # (N, 6, j)
        turn -= along[:, :, None] * (np.einsum("na,naj->nj", own, turn) + b[rows, k])[:, None]
        slope = b + np.einsum("nla,naj->nlj", screws, turn)
        m, f, z, v = y[:, None, :3], y[:, None, 3:], screws[:, :, :3], screws[:, :, 3:]
        w = np.concatenate([np.cross(m, z) + np.cross(f, v), np.cross(f, z)], axis=2)
        twice = np.einsum("nia,njla->nlij", w, by_joint) * np.abs(self.sign[:, :, None] * self.sign[:, None])
        cross = np.einsum("nai,nlja->nlij", turn, moved)
        pair = twice * self._nearer + cross + cross.transpose(0, 1, 3, 2)
        pair = np.triu(np.abs(np.where(self._nearer > 0, pair, pair.transpose(0, 1, 3, 2))), 1)
        diagonal = np.abs(np.einsum("nljj->nlj", twice) / 2 + np.einsum("nljj->nlj", cross))
        mixed = pair * half[:, None, :, None] * half[:, None, None]
        by_axis = np.abs(slope) * half[:, None] + diagonal * half[:, None] ** 2 + (mixed.sum(axis=2) + mixed.sum(axis=3)) / 2
        third = self._remainder(y, turn, links, away, half)
        e = np.abs(np.einsum("nla,na->nl", screws, y)) + by_axis.sum(axis=2) + third
        own_low = 2 - e[rows, k]  # its moment is 1
        e[rows, k] = 0
        size = np.sqrt((e**2).sum(axis=1))
        each = np.einsum("nl,nlj->nj", e, by_axis + third[:, :, None] * np.abs(self.sign) / 2)
        return np.where(own_low > 0, size / np.maximum(own_low, 1e-9), np.inf), each

    def _remainder(self, y: Array, turn: Array, links: Array, away: Array, half: Array) -> Array:
        """(N, l) of third order."""
        n, f0 = self.n, self.middle
        c = half @ np.abs(self.sign).T
        sums = [np.zeros_like(c) for _ in range(3)]
        turned = np.zeros(len(half))
        for j in range(f0 + 1, n):  # the link before axis j is turned by the joints from the middle to j - 1
            turned = turned + half[:, j - 1]
            for power in range(3):
                sums[power][:, j:] += (links[:, j] * turned ** (power + 1))[:, None]
        turned = np.zeros(len(half))
        for j in range(f0 - 2, -1, -1):
            turned = turned + half[:, j + 1]
            for power in range(3):
                sums[power][:, : j + 1] += (links[:, j] * turned ** (power + 1))[:, None]
        v1, v2, v3 = sums
        moment, force = (np.linalg.norm(x, axis=1)[:, None] for x in (y[:, :3], y[:, 3:]))
        more = [np.einsum("nj,nj->n", np.linalg.norm(x, axis=1), half)[:, None] for x in (turn[:, :3], turn[:, 3:])]
        far = away + v1
        own = (force * (v3 + 3 * v2 * c + 3 * v1 * c**2 + far * c**3) + moment * c**3) / 6
        return np.asarray(own + (more[1] * (v2 + 2 * v1 * c + far * c**2) + more[0] * c**2) / 2)
