"""Screws of an arm's axes in the frame of a middle link, with their derivatives by the joints.

The derivative of screw l by joint j, which is nearer to the middle, is the bracket of screws j and l, and so on for further
derivatives, exactly at the centre of a box. The lengths between axes bound the terms after first and second order. The first
and the last joint move no axis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.certificates.joint_boxes.segments import ChainSegment
from holdfast.certificates.taylor import CertificateChain
from holdfast.core.typing import FloatArray


@dataclass(frozen=True, eq=False)
class Screws:
    """Screws at N configurations.

    Attributes:
        axes: (N, l, 6) axes, then their moments.
        brackets: (N, j, l, 6) brackets of joint j and axis l.
        links: (N, n) distances between successive axes, m.
        distances: (N, n) distances of the axes from the point, m.
    """

    axes: FloatArray
    brackets: FloatArray
    links: FloatArray
    distances: FloatArray


class ScrewModel:
    """Model of the screws of a chain: axes, then their moments about a point of the middle axis.

    Attributes:
        n, middle: Number of joints, and the middle; the link behind joint ``middle - 1`` does not move.
        sign: (n, n) for axis l and joint j: 1 if j moves l behind the middle, -1 if it moves l before the middle, else 0.
        nearer: (n, n) 1 if joint i is at least as near to the middle as j.
        side: (n,) 1 behind the middle, -1 before it.
    """

    def __init__(self, chain: CertificateChain) -> None:
        self.n = len(chain.lengths)
        self.middle = self.n // 2
        self._arm = ChainSegment.from_chain(chain, 0, self.n, chain.origins[-1])
        rows, columns = np.indices((self.n, self.n))
        self.sign = np.where((columns >= self.middle) & (columns < rows), 1.0, 0.0)
        self.sign -= (columns < self.middle) & (columns > rows)
        order = np.abs(np.arange(self.n) - self.middle + 0.5)
        self.nearer = (order[:, None] <= order[None]).astype(float)
        self.side = np.where(np.arange(self.n) >= self.middle, 1.0, -1.0)

    def __call__(self, q: FloatArray) -> Screws:
        """Evaluate the screws at q (N, n)."""
        previous, z, points = self._arm.locate_point_and_axes(q)
        links = np.zeros(z.shape[:2])
        for joint in [*range(self.middle, self.n), *range(self.middle - 1, -1, -1)]:
            # The point of the middle axis nearest to the tool, then the point of each axis nearest to that of its neighbour.
            previous = previous if joint == self.middle else points[:, joint - 1 if joint > self.middle else joint + 1]
            points[:, joint] += z[:, joint] * np.einsum("na,na->n", z[:, joint], previous - points[:, joint])[:, None]
            links[:, joint] = np.linalg.norm(points[:, joint] - previous, axis=1)
        offsets = points - points[:, [self.middle]]
        moments = np.cross(offsets, z)
        moment_brackets = np.cross(z[:, :, None], moments[:, None]) + np.cross(moments[:, :, None], z[:, None])
        brackets = np.concatenate([np.cross(z[:, :, None], z[:, None]), moment_brackets], axis=3)
        return Screws(np.concatenate([z, moments], axis=2), brackets, links, np.linalg.norm(offsets, axis=2))

    def bound_screw_remainders(self, screws: Screws, half: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Bound the remainders of axes and moments after first order, and after second order: (N, n) each."""
        c = half @ np.abs(self.sign).T
        v1, v2, v3 = (np.zeros_like(c) for _ in range(3))
        for first, step, end in ((self.middle + 1, 1, self.n), (self.middle - 2, -1, -1)):
            angle_sum = np.zeros(len(half))
            # The joints from the middle up to the previous one rotate the link to axis j.
            for joint in range(first, end, step):
                angle_sum = angle_sum + half[:, joint - step]
                carried = slice(joint, None) if step > 0 else slice(None, joint + 1)
                for power, v in enumerate((v1, v2, v3), 1):
                    v[:, carried] += (screws.links[:, joint] * angle_sum**power)[:, None]
        max_distances = screws.distances + v1
        second = (v2 + 2 * v1 * c + max_distances * c**2) / 2
        return c**2 / 2, second, c**3 / 6, (v3 + 3 * v2 * c + 3 * v1 * c**2 + max_distances * c**3) / 6
