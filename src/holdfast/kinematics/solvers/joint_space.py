"""Distances between configurations in which joints without limits have period 2 pi."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.model.arm.model import Arm

if TYPE_CHECKING:
    from scipy.spatial import KDTree


_MAX_PAIRWISE_DISTANCES = 1 << 20


def is_unlimited(arm: Arm) -> BoolArray:
    """Return (n,) True for revolute joints without limits, for which q and q + 2 pi are equal."""
    return np.asarray(~arm.prismatic & np.isinf(arm.lower) & np.isinf(arm.upper))


def joint_difference(arm: Arm, a: FloatArray, b: FloatArray) -> FloatArray:
    """Return ``a - b`` (..., n), the short way for joints without limits."""
    raw_difference = a - b
    return np.where(is_unlimited(arm), np.arctan2(np.sin(raw_difference), np.cos(raw_difference)), raw_difference)


def build_tree(arm: Arm, q: FloatArray) -> KDTree:
    """Build a k-d tree for neighbors of configurations (N, n) in that distance."""
    from scipy.spatial import KDTree

    return KDTree(wrap_joints_to_positive(arm, q), boxsize=np.where(is_unlimited(arm), 2 * np.pi, 0.0))


def find_nearest(arm: Arm, points: FloatArray, q: FloatArray) -> tuple[FloatArray, IndexArray]:
    """Return the distance (N,) of configurations q (N, n) from the nearest of the points (P, n), and its index."""
    if _is_brute_force_faster(q, points):
        distances = _pairwise_distances(arm, q, points)
        index = distances.argmin(axis=1)
        return distances[np.arange(len(q)), index], index
    distance, index = build_tree(arm, points).query(wrap_joints_to_positive(arm, q))
    return np.asarray(distance), np.asarray(index)


def find_close_pairs(arm: Arm, q: FloatArray, max_distance: float) -> IndexArray:
    """Find the pairs (M, 2) of configurations q (N, n) at most ``max_distance`` apart, k < m, in order."""
    if _is_brute_force_faster(q, q):
        return np.argwhere(np.triu(_pairwise_distances(arm, q, q) <= max_distance, 1))
    close_pairs = build_tree(arm, q).query_pairs(max_distance, output_type="ndarray")
    return np.asarray(close_pairs[np.lexsort(close_pairs.T[::-1])])


def _is_brute_force_faster(a: FloatArray, b: FloatArray) -> bool:
    """Return True if computing all distances is faster than importing SciPy's trees; the bits are the same."""
    return 0 < len(a) * len(b) <= _MAX_PAIRWISE_DISTANCES


def _pairwise_distances(arm: Arm, a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the distances (N, P) of configurations a (N, n) from b (P, n)."""
    squares = np.zeros((len(a), len(b)))
    for first, second, periodic in zip(
        wrap_joints_to_positive(arm, a).T, wrap_joints_to_positive(arm, b).T, is_unlimited(arm), strict=True
    ):
        distance = np.abs(first[:, None] - second)
        squares += (np.where(distance > np.pi, np.abs(distance - 2 * np.pi), distance) if periodic else distance) ** 2
    return np.sqrt(squares)


def wrap_joints(arm: Arm, q: FloatArray) -> FloatArray:
    """Return configurations (..., n) with joints without limits in -pi to pi."""
    return np.where(is_unlimited(arm), np.arctan2(np.sin(q), np.cos(q)), q)


def wrap_around_limit_center(arm: Arm, q: FloatArray) -> FloatArray:
    """Return configurations (..., n) with revolute joints within half a turn of the middle of their limits, or of 0."""
    unlimited = is_unlimited(arm)
    middle = (np.where(unlimited, 0.0, arm.lower) + np.where(unlimited, 0.0, arm.upper)) / 2
    revolutions = np.rint((q - middle) / (2 * np.pi))
    return q - 2 * np.pi * np.where(arm.prismatic | ~np.isfinite(middle), 0.0, revolutions)


def wrap_joints_to_positive(arm: Arm, q: FloatArray) -> FloatArray:
    """Return configurations (N, n) with joints without limits in 0 to 2 pi, 2 pi excluded."""
    remainder = q % (2 * np.pi)
    return np.where(is_unlimited(arm), np.where(remainder >= 2 * np.pi, 0.0, remainder), q)


def join_intervals(
    intervals: Iterable[tuple[float, float]], gap: float = 0.0, period: float | None = None
) -> list[tuple[float, float]]:
    """Join intervals that overlap or lie within ``gap``, by lower end; with a period also the last one with the first."""
    joined: list[tuple[float, float]] = []
    for lower, upper in sorted(intervals):
        if joined and lower <= joined[-1][1] + gap:
            joined[-1] = (joined[-1][0], max(joined[-1][1], upper))
        else:
            joined.append((lower, upper))
    while period is not None and len(joined) > 1 and joined[0][0] + period <= joined[-1][1] + gap:
        _, upper = joined.pop(0)
        joined[-1] = (joined[-1][0], max(joined[-1][1], upper + period))
    return joined
