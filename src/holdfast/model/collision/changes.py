"""Bounds of how fast distances on an arm can change, from lengths only, for proofs about whole motions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm
from holdfast.model.collision.capsules import Capsules

Pairs = NDArray[np.int64]


def capsule_lipschitz_bounds(
    arm: Arm, capsules: Capsules, pairs: list[tuple[int, int]], lower: FloatArray, upper: FloatArray
) -> FloatArray:
    """Bound the change of the distances of ``pairs``, positions in ``capsules.parts``; see :func:`pair_lipschitz_bounds`."""
    positions = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    links = np.array([part.link for part in capsules], dtype=np.int64)[positions]
    ends = np.array([[part.start, part.end] for part in capsules]).reshape(-1, 2, 3)
    return pair_lipschitz_bounds(arm, links, np.linalg.norm(ends, axis=2).max(axis=1)[positions], lower, upper)


def pair_lipschitz_bounds(
    arm: Arm, links: Pairs, max_distances: FloatArray, lower: FloatArray, upper: FloatArray
) -> FloatArray:
    """Bound the change of the distance of each pair of convex bodies per rad and m of each joint, (P, n).

    A joint between the two links of a pair rotates one body about an axis and leaves the other at rest, so per rad the
    distance changes by at most the distance of the farthest point of either body from that axis, and by 1 m per m for a
    prismatic joint. The lengths along the chain bound the farthest point: a Lipschitz bound for every configuration within the
    box.

    Args:
        arm: Arm model.
        links: (P, 2) links of both bodies, the one nearer to the base first.
        max_distances: (P, 2) largest distance of each body's axis or centre from the frame of its link, m.
        lower: (n,) lower corner of the box, finite, rad and m.
        upper: (n,) upper corner of the box, finite, rad and m.
    """
    extensions, offsets = _joint_extents(arm, lower, upper)
    # Sums over the joints before each one, for the way inwards from an axis to the first body and outwards to the second.
    offset_sums, extension_sums = (np.append(0.0, np.cumsum(values)) for values in (offsets, extensions))
    bounds = np.zeros((len(links), arm.n))
    for joint in range(arm.n):
        moving = np.flatnonzero((links[:, 0] < joint) & (joint <= links[:, 1]))
        first, second = links[moving, 0] + 1, links[moving, 1] + 1
        outward = extensions[joint] + offset_sums[second] - offset_sums[joint + 1]
        outward = outward + extension_sums[second] - extension_sums[joint + 1] + max_distances[moving, 1]
        inward = offset_sums[joint + 1] - offset_sums[first] + extension_sums[joint] - extension_sums[first]
        inward = inward + max_distances[moving, 0]
        bounds[moving, joint] = 1.0 if arm.prismatic[joint] else np.minimum(outward, inward)
    return bounds


def link_lipschitz_bounds(
    arm: Arm, links: Pairs, max_distances: FloatArray, lower: FloatArray, upper: FloatArray
) -> FloatArray:
    """Bound the change of the distances between links and fixed objects, (L, n); see :func:`pair_lipschitz_bounds`.

    Args:
        arm: Arm model.
        links: (L,) index from 0 of the joint that moves each link.
        max_distances: (L,) largest distance of the sphere centres of each link from its own frame, m.
        lower: (n,) lower corner of the box, finite, rad and m.
        upper: (n,) upper corner of the box, finite, rad and m.
    """
    extensions, offsets = _joint_extents(arm, lower, upper)
    bounds = np.zeros((len(links), arm.n))
    for link_bounds, link, max_distance in zip(bounds, links, max_distances, strict=True):
        for joint in range(link + 1):
            outward = _bound_outward_distance(extensions, offsets, joint, link) + max_distance
            link_bounds[joint] = 1.0 if arm.prismatic[joint] else outward
    return bounds


def _joint_extents(arm: Arm, lower: FloatArray, upper: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the largest extension (n,) of each prismatic joint, and each joint frame's distance from the previous one, m."""
    extensions = np.where(arm.prismatic, np.maximum(np.abs(lower), np.abs(upper)), 0.0)
    return extensions, np.array([float(np.linalg.norm(joint.origin[:3, 3])) for joint in arm.joints])


def _bound_outward_distance(extensions: FloatArray, offsets: FloatArray, joint: int, link: int) -> float:
    """Bound the distance of the frame of a link from the axis of a joint, m."""
    beyond = slice(joint + 1, link + 1)
    return float(extensions[joint] + offsets[beyond].sum() + extensions[beyond].sum())
