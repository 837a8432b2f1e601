"""Distances between configurations: joints that turn without limits have period 2 pi."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm

if TYPE_CHECKING:
    from scipy.spatial import KDTree

Array = NDArray[np.float64]

_FEW = 1 << 20


def turning(arm: Arm) -> NDArray[np.bool_]:
    """(n,) True for revolute joints without any limit: q and q + 2 pi are the same."""
    return np.asarray(~arm.prismatic & np.isinf(arm.lower) & np.isinf(arm.upper))


def difference(arm: Arm, a: Array, b: Array) -> Array:
    """``a - b`` (..., n), the short way round where a joint turns without limits."""
    d = a - b
    return np.where(turning(arm), np.arctan2(np.sin(d), np.cos(d)), d)


def tree(arm: Arm, q: Array) -> KDTree:
    """For neighbours of configurations (N, n) in that distance."""
    from scipy.spatial import KDTree

    return KDTree(folded(arm, q), boxsize=np.where(turning(arm), 2 * np.pi, 0.0))


def nearest(arm: Arm, points: Array, q: Array) -> tuple[Array, NDArray[np.intp]]:
    """Distance (N,) of configurations q (N, n) from the nearest of the points (P, n), and which one that is."""
    if _few(q, points):
        away = _distances(arm, q, points)
        index = away.argmin(axis=1)
        return away[np.arange(len(q)), index], index
    distance, index = tree(arm, points).query(folded(arm, q))
    return np.asarray(distance), np.asarray(index)


def pairs(arm: Arm, q: Array, apart: float) -> NDArray[np.intp]:
    """Which configurations q (N, n) are no further than ``apart`` from each other, (M, 2), each k < m, in order."""
    if _few(q, q):
        return np.argwhere(np.triu(_distances(arm, q, q) <= apart, 1))
    found = tree(arm, q).query_pairs(apart, output_type="ndarray")
    return np.asarray(found[np.lexsort(found.T[::-1])])


def _few(a: Array, b: Array) -> bool:
    """All distances take less time than importing SciPy's trees, which give the same bits."""
    return 0 < len(a) * len(b) <= _FEW


def _distances(arm: Arm, a: Array, b: Array) -> Array:
    """(N, P) distances of configurations a (N, n) from b (P, n)."""
    squares = np.zeros((len(a), len(b)))
    for x, y, turns in zip(folded(arm, a).T, folded(arm, b).T, turning(arm), strict=True):
        away = np.abs(x[:, None] - y)
        squares += (np.where(away > np.pi, np.abs(away - 2 * np.pi), away) if turns else away) ** 2
    return np.sqrt(squares)


def wrapped(arm: Arm, q: Array) -> Array:
    """Configurations (..., n) with joints that turn without limits in -pi to pi."""
    return np.where(turning(arm), np.arctan2(np.sin(q), np.cos(q)), q)


def unwound(arm: Arm, q: Array) -> Array:
    """Configurations (..., n) with revolute joints within half a turn of the middle of their limits, or of 0 without limits."""
    free = turning(arm)
    middle = (np.where(free, 0.0, arm.lower) + np.where(free, 0.0, arm.upper)) / 2
    turns = np.rint((q - middle) / (2 * np.pi))
    return q - 2 * np.pi * np.where(arm.prismatic | ~np.isfinite(middle), 0.0, turns)


def folded(arm: Arm, q: Array) -> Array:
    """Configurations (N, n) with joints that turn without limits in 0 to 2 pi, 2 pi left out."""
    x = q % (2 * np.pi)
    return np.where(turning(arm), np.where(x >= 2 * np.pi, 0.0, x), q)
