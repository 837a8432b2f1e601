"""The distance from a surface or a cloud as seen from outside a box about it, as far as one likes, by few numbers.

For a point p, the box's centre the origin, ``E = (|p|^2 - d^2) / r = max_s (2 u.s - |s|^2 / r)`` over all s of the surface,
where ``p = r u`` and u is on the box. On each face of the box E is convex in u and ``1 / r``, as it is a maximum of affine
functions; so what is interpolated between nodes is never below it, and the distance that follows never above the true one.
The two are equal wherever the same s is the nearest to all nodes of a cell, however far away they are.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.cell.nodes import Grid

Array = NDArray[np.float64]

ACROSS = 33  # nodes along the edges of a face
AWAY = 17  # nodes of 1 / r, from 0


def nearest_to(grid: Grid) -> float:
    """The largest 1 / r: that of one width within the box of a grid."""
    return float(1 / (1 - grid.width / half(grid).min()))


def half(grid: Grid) -> Array:
    """(3,) half the edges of its box, m."""
    return np.asarray(grid.width * (np.array(grid.shape) - 1) / 2)


def outside(grid: Grid, samples: Array, apart: float) -> tuple[NDArray[np.float32], float]:
    """E and how far the farthest sample is from the middle of the grid, m.

    E, (6, ACROSS, ACROSS, AWAY), m, is rounded up: faces (low x, high x, low y, ...), the two coordinates that follow, 1 / r.

    Args:
        grid: Its box is the one looked at from outside.
        samples: (N, 3) points of the surface, m, in the frame of the grid. The square of the distance from the nearest of them
            exceeds that from the surface by at most ``apart**2``.
        apart: m.
    """
    from scipy.spatial import cKDTree

    edges = half(grid)
    own = samples - (grid.origin + edges)
    tree, square = cKDTree(own), (own * own).sum(axis=1)
    inverse = np.linspace(0, nearest_to(grid), AWAY)
    across = np.linspace(-1, 1, ACROSS)
    a, b = (x.ravel() for x in np.meshgrid(across, across, indexing="ij"))
    found = np.empty((6, ACROSS * ACROSS, AWAY))
    for face in range(6):
        axis = face // 2
        on_box = np.empty((len(a), 3))
        on_box[:, axis] = 2.0 * (face % 2) - 1.0
        on_box[:, (axis + 1) % 3], on_box[:, (axis + 2) % 3] = a, b
        on_box *= edges
        for k, share in enumerate(inverse[1:], start=1):
            nearest = tree.query(on_box / share)[1]
            found[face, :, k] = 2 * (on_box * own[nearest]).sum(axis=1) - share * (square[nearest] - apart * apart)
    # Infinitely far away: E changes with 1 / r by at most the square of the farthest s.
    found[:, :, 0] = found[:, :, 1] + inverse[1] * square.max()
    above = np.nextafter(found.astype(np.float32), np.float32(np.inf))
    return above.reshape(6, ACROSS, ACROSS, AWAY), float(np.sqrt(square.max()))
