"""How fast distances on an arm can change: bounds from lengths alone, for proofs about whole motions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.clearance.capsules import Capsules

Array = NDArray[np.float64]
Pairs = NDArray[np.int64]


def changes_between(arm: Arm, capsules: Capsules, pairs: list[tuple[int, int]], low: Array, high: Array) -> Array:
    """(P, n) bounds of how much the distance of each pair of capsules changes per rad and m of each joint.

    A joint between the two links of a pair turns one capsule about an axis that the other does not feel, so the distance
    changes by no more than the farthest point of either capsule from that axis, per rad; by 1 m per m along a slide. The
    farthest point is no farther than the lengths along the chain: a Lipschitz bound for every configuration within the box.

    Args:
        arm: The arm.
        capsules: Its shape.
        pairs: Positions in ``capsules.parts``, the capsule nearer to the base first.
        low: (n,) lower corner of the box, finite, rad and m.
        high: (n,) upper corner.
    """
    slide, step = _lengths(arm, low, high)
    bounds = np.zeros((len(pairs), arm.n))
    for row, (a, b) in zip(bounds, pairs, strict=True):
        first, second = capsules.parts[a], capsules.parts[b]
        far = [max(float(np.linalg.norm(x)) for x in (part.start, part.end)) for part in (first, second)]
        for k in range(first.link + 1, second.link + 1):
            # Outwards from axis k to the second capsule; inwards from it to the first.
            outward = slide[k] + step[k + 1 : second.link + 1].sum() + slide[k + 1 : second.link + 1].sum() + far[1]
            inward = step[first.link + 1 : k + 1].sum() + slide[first.link + 1 : k].sum() + far[0]
            row[k] = 1.0 if arm.prismatic[k] else min(outward, inward)
    return bounds


def changes_from_outside(arm: Arm, links: Pairs, far: Array, low: Array, high: Array) -> Array:
    """(L, n) as :func:`changes_between`, of the distances between links and what does not move.

    Args:
        arm: The arm.
        links: (L,) by the joint that moves each, from 0.
        far: (L,) farthest centre of the spheres of each link from its own frame, m.
        low: (n,) lower corner of the box, finite, rad and m.
        high: (n,) upper corner.
    """
    slide, step = _lengths(arm, low, high)
    bounds = np.zeros((len(links), arm.n))
    for row, link, most in zip(bounds, links, far, strict=True):
        for k in range(link + 1):
            outward = slide[k] + step[k + 1 : link + 1].sum() + slide[k + 1 : link + 1].sum() + most
            row[k] = 1.0 if arm.prismatic[k] else outward
    return bounds


def _lengths(arm: Arm, low: Array, high: Array) -> tuple[Array, Array]:
    """(n,) how far each slide can be out, and how far each joint's frame is from that of the joint before, m."""
    slide = np.where(arm.prismatic, np.maximum(np.abs(low), np.abs(high)), 0.0)
    return slide, np.array([float(np.linalg.norm(j.origin[:3, 3])) for j in arm.joints])
