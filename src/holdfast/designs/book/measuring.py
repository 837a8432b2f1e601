"""What a record claims, measured again with NumPy alone: nothing here is shared with what found it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

_STEP = 1e-5  # rad, m


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


def jacobian_by_differences(pose: Callable[[Array], Array], q: Array) -> Array:
    """(6, n) Jacobian of the tool point in the world, to about 1e-9.

    Args:
        pose: Of q (n,) the pose (4, 4) of the tool.
        q: (n,) rad and m.
    """
    columns, turn = [], pose(q)[:3, :3].T
    for step in _STEP * np.eye(len(q)):
        change = (pose(q + step) - pose(q - step)) / (2 * _STEP)
        spin = change[:3, :3] @ turn
        columns.append([*change[:3, 3], spin[2, 1], spin[0, 2], spin[1, 0]])
    return np.array(columns).T


def null_space_of(jacobian: Array) -> Array:
    """(n, n - m) orthonormal columns."""
    return np.linalg.svd(jacobian)[2][len(jacobian) :].T


def least_left(null_space: Array, k: int) -> float:
    """Least relative manipulability over all locks of k joints."""
    some = null_space[list(combinations(range(len(null_space)), k))]
    return float(np.sqrt(max(np.linalg.det(some @ np.swapaxes(some, 1, 2)).min(), 0.0)))
