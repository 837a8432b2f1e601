"""The failure-tolerant workspace of planar arms whose first two joints turn all the way: rings about the first joint."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def ring_area(lengths: Array, limits: Array, samples: int = 25) -> Array:
    """Area (P,), m^2, of the failure-tolerant workspace of planar arms of n revolute joints, n = 3 or more.

    The first two joints turn all the way. Links that others follow after a lock of joint k are one of length
    ``|l_(k-1) + l_k e^(iq)|``, and chains of free links reach a ring. A lock of joint 1 may have any direction: the others
    must reach all distances from ``|r - l1|`` to ``r + l1`` from the elbow.

    Args:
        lengths: (P, n) of the links, m.
        limits: (P, n - 2, 2) artificial limits of the link angles of joints 3 to n, rad; all joints turn all the way after a
            lock.
        samples: Of each range, for what the healthy arm reaches; the area is not overestimated by few.

    Source: derived here.
    """
    count, n = lengths.shape
    first, second, rest = lengths[:, 0], lengths[:, 1], lengths[:, 2:]
    # Healthy: the distances between joint 2 and the tool, then those from joint 1.
    unit = np.linspace(0, 1, samples)
    end = rest[:, -1].astype(complex).reshape(count, 1)
    for k in range(n - 1, 1, -1):
        low, high = limits[:, k - 2, 0], limits[:, k - 2, 1]
        turn = np.exp(1j * (low[:, None] + (high - low)[:, None] * unit))
        before = second if k == 2 else rest[:, k - 3]
        end = (before[:, None, None] + turn[:, :, None] * end[:, None, :]).reshape(count, -1)
    distance = np.abs(end)
    near, far = distance.min(axis=1), distance.max(axis=1)
    low = np.maximum(np.maximum(first - far, near - first), 0.0)
    high = first + far
    for k in range(1, n):
        others = np.delete(lengths, [k - 1, k], axis=1)
        a, b = lengths[:, k - 1], lengths[:, k]
        if k == 1:
            short, long = np.abs(a - b), a + b
        else:
            least, most = _cosines(limits[:, k - 2])
            short, long = (np.sqrt(np.maximum(a * a + b * b + 2 * a * b * c, 0.0)) for c in (least, most))
        total, longest = others.sum(axis=1), others.max(axis=1)
        high = np.minimum(high, short + total)
        low = np.maximum(low, np.maximum(long - total, 2 * longest - total - short))
    after = lengths[:, 1:]
    high = np.minimum(high, after.sum(axis=1) - first)
    hole = np.maximum(2 * after.max(axis=1) - after.sum(axis=1), 0.0)

    def ring(inner: Array, outer: Array) -> Array:
        inner, outer = np.maximum(inner, 0), np.maximum(outer, 0)
        return np.asarray(np.pi * np.maximum(outer**2 - inner**2, 0))

    whole = ring(low, high)
    parted = ring(low, np.minimum(high, first - hole)) + ring(np.maximum(low, first + hole), high)
    return np.asarray(np.where(hole > 0, parted, whole))


def _cosines(limits: Array) -> tuple[Array, Array]:
    """Least and largest cosine within ranges (P, 2), rad."""
    low, high = limits[:, 0], limits[:, 1]
    ends = np.cos(limits)

    def holds(angle: float) -> NDArray[np.bool_]:
        return np.asarray(angle + 2 * np.pi * np.ceil((low - angle) / (2 * np.pi)) <= high)

    return np.where(holds(np.pi), -1.0, ends.min(axis=1)), np.where(holds(0.0), 1.0, ends.max(axis=1))
