"""Measurement of the failure-tolerant workspace of a record in two ways, independently of the search.

For a planar arm whose first joint has no artificial limits, the workspace depends only on the distance from the base. A lock
merges two links into one. A chain of free links reaches a ring, from the excess of its longest link over all others to their
sum.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.typing import FloatArray

# Numbers of distances, of angles of a lock, and of angles of each joint of the healthy arm.
_GRID_RADII = 2000
_LOCK_ANGLES = 361
_HEALTHY_ANGLES = 41


def compute_exact_area(lengths: ArrayLike, last_limits: tuple[float, float] | None) -> float:
    """Return the workspace area, m^2, of an arm of which only the last joint may have artificial limits.

    Args:
        lengths: (n,) link lengths, m; n is 3 or more.
        last_limits: Limits of the angle between the last two links, rad; None: no limits.
    """
    links = [float(x) for x in np.asarray(lengths)]
    a, b = links[-2:]
    if last_limits is None:
        lower, upper = abs(a - b), a + b
    else:
        middle, half_range = sum(last_limits) / 2, (last_limits[1] - last_limits[0]) / 2
        angle_gaps = [abs((x + np.pi) % (2 * np.pi) - np.pi) for x in (middle, middle - np.pi)]  # of the middle from 0 and pi
        end_distances = [float(np.sqrt(max(a * a + b * b + 2 * a * b * np.cos(x), 0.0))) for x in last_limits]
        upper = a + b if angle_gaps[0] <= half_range else max(end_distances)
        lower = abs(a - b) if angle_gaps[1] <= half_range else min(end_distances)
    stretches = [(abs(x - y), x + y) for x, y in pairwise(links[:-1])] + [(lower, upper)]
    for link in reversed(links[:-2]):  # range of distances of the healthy arm
        lower, upper = max(lower - link, link - upper, 0.0), upper + link
    for index, (shortest, longest) in enumerate(stretches):  # a lock of joint k + 2 at any possible angle
        rings = [_find_reachable_ring([*links[:index], r, *links[index + 2 :]]) for r in (shortest, longest)]
        lower, upper = max(lower, *(r[0] for r in rings)), min(upper, *(r[1] for r in rings))
    inner, outer = _find_reachable_ring(links[1:])
    first_link = links[0]
    # After a lock of joint 1 in any direction, the distance from the elbow is between |r - l1| and r + l1.
    upper = min(upper, outer - first_link)
    annuli = (
        [(lower, upper)] if inner == 0 else [(lower, min(upper, first_link - inner)), (max(lower, first_link + inner), upper)]
    )
    return float(sum(np.pi * (b * b - a * a) for a, b in annuli if b > a))


def estimate_area_by_grid(lengths: ArrayLike, limits: FloatArray) -> float:
    """Return the workspace area, m^2, from trial distances from the base, each with all locks of all joints.

    Args:
        lengths: (n,) link lengths, m.
        limits: (n - 1, 2) artificial limits of the angles of links 2 to n relative to the previous link, rad.
    """
    links = np.asarray(lengths, dtype=np.float64)
    radius_step = links.sum() / _GRID_RADII
    radii = (np.arange(_GRID_RADII) + 0.5) * radius_step
    tips = np.array([links[-1]], dtype=complex)
    for link, (lower, upper) in zip(links[-2::-1], limits[::-1], strict=True):
        rotated = np.exp(1j * np.linspace(lower, upper, _HEALTHY_ANGLES))[:, None] * tips
        tips = (link + rotated).ravel()
    is_reached = (np.abs(tips).min() <= radii + radius_step / 2) & (radii - radius_step / 2 <= np.abs(tips).max())
    elbow_distances = np.abs(radii[:, None] - links[0] * np.exp(1j * np.linspace(0, np.pi, _LOCK_ANGLES)))
    inner, outer = _find_reachable_ring(links[1:])
    is_reached &= ((elbow_distances >= inner) & (elbow_distances <= outer)).all(axis=1)
    for index, (lower, upper) in enumerate(limits):
        for merged_length in np.abs(links[index] + links[index + 1] * np.exp(1j * np.linspace(lower, upper, _LOCK_ANGLES))):
            inner, outer = _find_reachable_ring([*links[:index], merged_length, *links[index + 2 :]])
            is_reached &= (radii >= inner) & (radii <= outer)
    return float((2 * np.pi * radii * radius_step)[is_reached].sum())


def _find_reachable_ring(links: ArrayLike) -> tuple[float, float]:
    """Return the least and the largest distance that a chain of free links spans."""
    total, longest = float(np.sum(links)), float(np.max(links))
    return max(2 * longest - total, 0.0), total
