"""Rows of a task over boxes of joints and targets: if some combination is never 0, the tool is elsewhere or turned otherwise.

In doubles, for batches; it may be wrong: the verifier decides.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.claims import OutOfReachClaim
from holdfast.certificates.joint_boxes.segments import costs
from holdfast.certificates.taylor import Reach

Array = NDArray[np.float64]


class Rows:
    """The rows of a claim.

    Args:
        claim: Of which nothing is reached.
        joints: (n, 2) rad and m, where they may be.
    """

    def __init__(self, claim: OutOfReachClaim, joints: Array) -> None:
        self._given = claim, joints
        self.reach = Reach(claim.arm, claim.task, claim.locked, joints, claim.rotation, claim.angle)
        self._linear = self.reach.linear

    def __reduce__(self) -> tuple[Any, ...]:  # to another process, which compiles its own
        return Rows, self._given

    def nearest(self, q: Array, half: Array, targets: Array, wide: Array) -> tuple[Array, Array, Array]:
        """By how much a combination of rows stays from 0 over q +- half (N, n) and targets +- wide (N, a).

        Returns:
            The bound (N,), what it is in the middles (N,), and what of it each joint and axis of the target costs (N, n + a).
        """
        reach, linear = self.reach, self._linear
        count, n, more = len(q), q.shape[1], int(reach.rotated)
        m, v = reach.m + more, q.shape[1] + reach.axes - linear
        out = reach.expansion.whole.rows(q, reach.given(targets))
        error, slopes, second = np.split(out, np.cumsum([m, m * v]), axis=1)
        slopes, second = slopes.reshape(count, m, v), second.reshape(count, m, v, v)
        turns = np.concatenate([half, wide[:, linear:]], axis=1)
        place, angle = self._third(q, half, wide)
        swept = slopes * turns[:, None]
        spread = swept @ swept.transpose(0, 2, 1) + (1e-6 * (error**2).sum(axis=1) + 1e-30)[:, None, None] * np.eye(m)
        spread[:, range(linear), range(linear)] += wide[:, :linear] ** 2
        steep = np.linalg.solve(spread, error[:, :, None])[:, :, 0]
        of_place = np.arange(m) < linear
        best = np.full(count, -np.inf), np.zeros(count), np.zeros((count, n + reach.axes))
        for along in (error, steep, *([error * of_place, error * ~of_place] if more else [])):
            e = along / np.maximum(np.linalg.norm(along, axis=1), 1e-300)[:, None]
            cost, mixed = costs(np.abs(np.einsum("na,nak->nk", e, slopes)), np.einsum("na,najk->njk", e, second), turns)
            left = np.linalg.norm(e[:, :linear], axis=1) * place + np.linalg.norm(e[:, linear:], axis=1) * angle**3 / 6
            aside, gap = np.abs(e[:, :linear]) * wide[:, :linear], np.einsum("na,na->n", e, error)
            bound = gap - cost.sum(axis=1) - mixed.sum(axis=1) / 2 - left - aside.sum(axis=1)
            each = cost + mixed + (3 * left / np.maximum(turns.sum(axis=1), 1e-300))[:, None] * turns
            every = np.concatenate([each[:, :n], aside, each[:, n:]], axis=1)
            # What a combination tells is how much of its value is lost, not how large it is: rows are m and rad.
            better = bound / np.maximum(gap, 1e-12) > best[0] / np.maximum(best[1], 1e-12)
            best = tuple(  # type: ignore[assignment]
                np.where(better if new.ndim == 1 else better[:, None], new, old)
                for new, old in zip((bound, gap, every), best, strict=True)
            )
        return best

    def _third(self, q: Array, half: Array, wide: Array) -> tuple[Array, Array]:
        """What is left of the point behind second order, m, and the angle by which it turns, rad."""
        slides, lengths = self.reach.slides, self.reach.expansion.lengths
        c, slid = np.cumsum(half * ~slides, axis=1), half * slides
        place = (c**3 * (lengths + np.abs(q) * slides + slid) + 3 * c**2 * slid).sum(axis=1) / 6
        return place, c[:, -1] + wide[:, self._linear :].sum(axis=1)
