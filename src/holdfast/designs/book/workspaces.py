"""The failure-tolerant workspace that a record claims, measured again in two ways; nothing is shared with the search.

Of a planar arm whose first joint has no artificial limits it depends on the distance from the base alone. A lock merges two
links into one; chains of free links reach a ring, from what their longest link has more than all others to their sum.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

_RADII, _LOCKS, _HEALTHY = 2000, 361, 41  # distances; angles of a lock; of each joint while all work


def area_in_closed_form(lengths: ArrayLike, last: tuple[float, float] | None) -> float:
    """Area, m^2, where the last joint alone has artificial limits, or none.

    Args:
        lengths: (n,) of the links, m; n of 3 or more.
        last: Limits of the angle between the last two links, rad; None: no limits.
    """
    links = [float(x) for x in np.asarray(lengths)]
    a, b = links[-2:]
    if last is None:
        low, high = abs(a - b), a + b
    else:
        middle, half = sum(last) / 2, (last[1] - last[0]) / 2
        away = [abs((x + np.pi) % (2 * np.pi) - np.pi) for x in (middle, middle - np.pi)]  # of the middle from 0 and pi
        ends = [float(np.sqrt(max(a * a + b * b + 2 * a * b * np.cos(x), 0.0))) for x in last]
        high = a + b if away[0] <= half else max(ends)
        low = abs(a - b) if away[1] <= half else min(ends)
    stretches = [(abs(x - y), x + y) for x, y in pairwise(links[:-1])] + [(low, high)]
    for link in reversed(links[:-2]):  # what all joints reach together
        low, high = max(low - link, link - high, 0.0), high + link
    for k, (short, long) in enumerate(stretches):  # a lock of joint k + 2, at any angle that it may have
        rings = [_ring([*links[:k], r, *links[k + 2 :]]) for r in (short, long)]
        low, high = max(low, *(r[0] for r in rings)), min(high, *(r[1] for r in rings))
    hole, outer = _ring(links[1:])
    first = links[0]
    # A lock of joint 1 in any direction: from the elbow all distances from |r - l1| to r + l1.
    high = min(high, outer - first)
    parts = [(low, high)] if hole == 0 else [(low, min(high, first - hole)), (max(low, first + hole), high)]
    return float(sum(np.pi * (b * b - a * a) for a, b in parts if b > a))


def area_by_grid(lengths: ArrayLike, limits: Array) -> float:
    """Area, m^2, by trying distances from the base, and at each all locks of all joints.

    Args:
        lengths: (n,) of the links, m.
        limits: (n - 1, 2) artificial limits of the angles of links 2 to n against the link before, rad.
    """
    links = np.asarray(lengths, dtype=np.float64)
    step = links.sum() / _RADII
    r = (np.arange(_RADII) + 0.5) * step
    end = np.array([links[-1]], dtype=complex)
    for link, (low, high) in zip(links[-2::-1], limits[::-1], strict=True):
        turned = np.exp(1j * np.linspace(low, high, _HEALTHY))[:, None] * end
        end = (link + turned).ravel()
    left = (np.abs(end).min() <= r + step / 2) & (r - step / 2 <= np.abs(end).max())
    elbow = np.abs(r[:, None] - links[0] * np.exp(1j * np.linspace(0, np.pi, _LOCKS)))
    hole, outer = _ring(links[1:])
    left &= ((elbow >= hole) & (elbow <= outer)).all(axis=1)
    for k, (low, high) in enumerate(limits):
        for stretch in np.abs(links[k] + links[k + 1] * np.exp(1j * np.linspace(low, high, _LOCKS))):
            hole, outer = _ring([*links[:k], stretch, *links[k + 2 :]])
            left &= (r >= hole) & (r <= outer)
    return float((2 * np.pi * r * step)[left].sum())


def _ring(links: ArrayLike) -> tuple[float, float]:
    """Least and largest distance that a chain of free links spans."""
    total, longest = float(np.sum(links)), float(np.max(links))
    return max(2 * longest - total, 0.0), total
