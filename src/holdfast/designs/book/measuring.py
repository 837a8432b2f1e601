"""What a record claims, measured again with NumPy alone: nothing here is shared with what found it."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def jacobian_of(rows: Sequence[Sequence[float]], tool: ArrayLike, q: Array) -> Array:
    """(6, n) Jacobian of the tool point in the base.

    Args:
        rows: ``a``, ``alpha``, ``d`` and ``theta`` of each joint, m and rad.
        tool: (3,) of the tool point in the last row's frame, m.
        q: (n,) rad.
    """
    at, axes, points = np.eye(4), [], []
    for (a, alpha, d, theta), angle in zip(rows, q, strict=True):
        axes.append(at[:3, 2])
        points.append(at[:3, 3])
        c, s, ca, sa = np.cos(theta + angle), np.sin(theta + angle), np.cos(alpha), np.sin(alpha)
        at = at @ [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
    point = at[:3, :3] @ np.asarray(tool) + at[:3, 3]
    return np.array([[*np.cross(w, point - o), *w] for w, o in zip(axes, points, strict=True)]).T


def null_space_of(jacobian: Array) -> Array:
    """(n, n - m) orthonormal columns."""
    return np.linalg.svd(jacobian)[2][len(jacobian) :].T


def least_left(null_space: Array, k: int) -> float:
    """Least relative manipulability over all locks of k joints."""
    some = null_space[list(combinations(range(len(null_space)), k))]
    return float(np.sqrt(max(np.linalg.det(some @ np.swapaxes(some, 1, 2)).min(), 0.0)))
