"""Measurement of the claims of a record with NumPy alone, independently of the search."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.typing import FloatArray

_DIFFERENCE_STEP = 1e-5  # rad, m


def compute_jacobian(rows: Sequence[Sequence[float]], tool: ArrayLike, q: FloatArray) -> FloatArray:
    """Return the Jacobian (6, n) of the tool point in the base frame.

    Args:
        rows: ``a``, ``alpha``, ``d`` and ``theta`` of each joint, m and rad.
        tool: (3,) tool point in the frame of the last row, m.
        q: (n,) configuration, rad.
    """
    frame, axes, points = np.eye(4), [], []
    for (a, alpha, d, theta), angle in zip(rows, q, strict=True):
        axes.append(frame[:3, 2])
        points.append(frame[:3, 3])
        c, s, ca, sa = np.cos(theta + angle), np.sin(theta + angle), np.cos(alpha), np.sin(alpha)
        frame = frame @ [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
    point = frame[:3, :3] @ np.asarray(tool) + frame[:3, 3]
    return np.array([[*np.cross(axis, point - origin), *axis] for axis, origin in zip(axes, points, strict=True)]).T


def approximate_jacobian(pose: Callable[[FloatArray], FloatArray], q: FloatArray) -> FloatArray:
    """Return the Jacobian (6, n) of the tool point in the world, to about 1e-9.

    Args:
        pose: Function from q (n,) to the tool pose (4, 4).
        q: (n,) configuration, rad and m.
    """
    columns, inverse_rotation = [], pose(q)[:3, :3].T
    for step in _DIFFERENCE_STEP * np.eye(len(q)):
        change = (pose(q + step) - pose(q - step)) / (2 * _DIFFERENCE_STEP)
        angular_rate = change[:3, :3] @ inverse_rotation
        columns.append([*change[:3, 3], angular_rate[2, 1], angular_rate[0, 2], angular_rate[1, 0]])
    return np.array(columns).T


def compute_null_space(jacobian: FloatArray) -> FloatArray:
    """Return an orthonormal basis (n, n - m) of the null space."""
    return np.linalg.svd(jacobian)[2][len(jacobian) :].T


def compute_worst_manipulability(null_space: FloatArray, failures: int) -> float:
    """Return the least relative manipulability over all locks of ``failures`` joints."""
    locked_rows = null_space[list(combinations(range(len(null_space)), failures))]
    return float(np.sqrt(max(np.linalg.det(locked_rows @ np.swapaxes(locked_rows, 1, 2)).min(), 0.0)))
