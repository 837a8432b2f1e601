"""How tools and their axes follow joints, of many configurations at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def tangents(wide: Array) -> tuple[Array, Array]:
    """Unit vectors (N, m + 1) that matrices (N, m, m + 1) take to 0, the last number positive, and pseudo-inverses."""
    u, sizes, v = np.linalg.svd(wide)
    tangent, across = v[:, -1], v[:, :-1].transpose(0, 2, 1) / np.maximum(sizes, 1e-14)[:, None] @ u.transpose(0, 2, 1)
    return np.asarray(tangent * np.where(tangent[:, -1:] < 0, -1.0, 1.0)), np.asarray(across)


def twice(axes: Array, columns: Array, moves: Array) -> Array:
    """(N, 3, c, c) second derivatives of a place along the columns of moves (N, n, c)."""
    steps = axes[:, :, None] * moves[..., None]
    last = np.cumsum(steps, axis=1) - steps / 2
    half = np.cross(last[:, :, :, None], (columns[:, :, None] * moves[..., None])[:, :, None]).sum(axis=1)
    return np.asarray((half + half.transpose(0, 2, 1, 3)).transpose(0, 3, 1, 2))


def sideways(target: tuple[Array, ...]) -> Array:
    """(N, 2, 3) unit vectors across the axis that is wanted."""
    return np.asarray(target[1][:, :, :2].transpose(0, 2, 1))


def swept(at: tuple[Array, ...]) -> Array:
    """(N, 3, n) how the tool's axis follows the joints."""
    return np.asarray(np.cross(at[2], at[1][:, None, :, 2]).transpose(0, 2, 1))


def axial(turn: Array) -> Array:
    """(N, 3) the axial vectors of rotations."""
    twice = np.stack([turn[:, 2, 1] - turn[:, 1, 2], turn[:, 0, 2] - turn[:, 2, 0], turn[:, 1, 0] - turn[:, 0, 1]], axis=1)
    return np.asarray(twice / 2)


def onto(turn: Array) -> Array:
    """(N, 3, 3) what takes a to the axial vector of [a] R."""
    return np.asarray((np.trace(turn, axis1=1, axis2=2)[:, None, None] * np.eye(3) - turn) / 2)


def solved(matrix: Array, right: Array) -> Array:
    """With a matrix that is nearly singular, something large."""
    return np.asarray(np.linalg.solve(matrix + 1e-14 * np.eye(matrix.shape[-1]), right))
