"""Screws of an arm's axes as seen from a link in the middle of it, with their derivatives by the joints.

The derivative of screw l by joint j, which is nearer to the middle, is the bracket of screws j and l, and so on: exact at the
centre of a box. What is left behind first and second order is bounded by the lengths between axes. The first and the last joint
move no axis.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.joint_boxes.segments import Segment
from holdfast.certificates.taylor import Chain

Array = NDArray[np.float64]


class Screws:
    """The screws of a chain: axes, then their moments about a point of the middle axis.

    Attributes:
        n, middle: Joints; the link behind joint ``middle - 1`` does not move.
        sign: (n, n) of axis l and joint j: 1 where j moves l behind the middle, -1 before it, else 0.
        nearer: (n, n) 1 where joint i is as near to the middle as j, or nearer.
        side: (n,) 1 behind the middle, -1 before it.
    """

    def __init__(self, chain: Chain) -> None:
        self.n = len(chain.lengths)
        self.middle = self.n // 2
        self._arm = Segment.of(chain, 0, self.n, chain.origins[-1])
        rows, columns = np.indices((self.n, self.n))
        self.sign = np.where((columns >= self.middle) & (columns < rows), 1.0, 0.0)
        self.sign -= (columns < self.middle) & (columns > rows)
        order = np.abs(np.arange(self.n) - self.middle + 0.5)
        self.nearer = (order[:, None] <= order[None]).astype(float)
        self.side = np.where(np.arange(self.n) >= self.middle, 1.0, -1.0)

    def __call__(self, q: Array) -> tuple[Array, Array, Array, Array]:
        """At q (N, n).

        Returns:
            Screws (N, l, 6), brackets (N, j, l, 6) of joint j and axis l, links from axis to axis (N, n) and how far axes are
            from the point (N, n).
        """
        before, z, where = self._arm.placed(q)
        links = np.zeros(z.shape[:2])
        for j in [*range(self.middle, self.n), *range(self.middle - 1, -1, -1)]:
            # Of the middle axis the point that is nearest to the tool, then of each the one nearest to that of its neighbour.
            before = before if j == self.middle else where[:, j - 1 if j > self.middle else j + 1]
            where[:, j] += z[:, j] * np.einsum("na,na->n", z[:, j], before - where[:, j])[:, None]
            links[:, j] = np.linalg.norm(where[:, j] - before, axis=1)
        away = where - where[:, [self.middle]]
        v = np.cross(away, z)
        shifted = np.cross(z[:, :, None], v[:, None]) + np.cross(v[:, :, None], z[:, None])
        brackets = np.concatenate([np.cross(z[:, :, None], z[:, None]), shifted], axis=3)
        return np.concatenate([z, v], axis=2), brackets, links, np.linalg.norm(away, axis=2)

    def remains(self, links: Array, away: Array, half: Array) -> tuple[Array, Array, Array, Array]:
        """What is left of axes and of moments behind first order, and behind second: (N, n) each."""
        c = half @ np.abs(self.sign).T
        v1, v2, v3 = (np.zeros_like(c) for _ in range(3))
        for first, step, end in ((self.middle + 1, 1, self.n), (self.middle - 2, -1, -1)):
            turned = np.zeros(len(half))
            for j in range(first, end, step):  # the link to axis j is turned by the joints from the middle to the one before
                turned = turned + half[:, j - step]
                carried = slice(j, None) if step > 0 else slice(None, j + 1)
                for power, v in enumerate((v1, v2, v3), 1):
                    v[:, carried] += (links[:, j] * turned**power)[:, None]
        far = away + v1
        return c**2 / 2, (v2 + 2 * v1 * c + far * c**2) / 2, c**3 / 6, (v3 + 3 * v2 * c + 3 * v1 * c**2 + far * c**3) / 6
