"""The distance from a surface or a cloud as seen from outside a box about it, as far as one likes, by few numbers.

A point p, the box's centre the origin, is on a larger box: all faces of the first one, with half edges b, moved outward by z.
On face k ``p_k = +-(b_k + z)``, and along it ``p_i = a_i (b_i + z)`` with ``|a_i| <= 1``. With ``r = z + e`` for a length e

    E = (|p|^2 - d^2) / r = max_s (2 s.p / r - |s|^2 / r)

over all s of the surface is convex in ``p / r`` and ``1 / r``, being a maximum of affine functions. Both are affine in each of
``a_i`` and ``1 / r``, so trilinear interpolation in these has the right mean; what it says of E is never below it (Jensen), and
the distance that follows never above the true one. The two are equal wherever the same s is the nearest to all nodes of a cell.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.cell.nodes import DIAGONAL, Grid

Array = NDArray[np.float64]

ACROSS = 33  # nodes along the edges of a face
AWAY = 17  # nodes of 1 / r, from 0, as far apart as squares
_MANY = 1 << 16  # points that a search is quick among
_FINE = 1 << 10  # cubes along an edge


def half(grid: Grid) -> Array:
    """(3,) half the edges of its box, m."""
    return np.asarray(grid.width * (np.array(grid.shape) - 1) / 2)


def length(grid: Grid) -> float:
    """The length e, m."""
    return float(half(grid).max() / 2 + grid.width)


def nearest_to(grid: Grid) -> float:
    """The largest 1 / r, 1/m: that of one width within the box of a grid."""
    return float(2 / half(grid).max())


def seen_from_outside(grid: Grid, samples: Array, apart: float) -> tuple[NDArray[np.float32], float]:
    """E and how far the farthest sample is from the middle of the grid, m.

    E, (6, ACROSS, ACROSS, AWAY), m, is rounded up: faces (low x, high x, low y, ...), the two coordinates that follow, 1 / r.

    Args:
        grid: Its box is the one looked at from outside.
        samples: (N, 3) points of the surface, m, in the frame of the grid. The square of the distance from the nearest of them
            exceeds that from the surface by at most ``apart**2``.
        apart: m.
    """
    from scipy.spatial import cKDTree

    edges, e = half(grid), length(grid)
    own = samples - (grid.origin + edges)
    reach = float(np.sqrt((own * own).sum(axis=1).max()))
    few, off = _thinned(own)
    tree = cKDTree(few)
    inverse = nearest_to(grid) * np.linspace(0, 1, AWAY) ** 2
    across = np.linspace(-1, 1, ACROSS)
    a, b = (x.ravel() for x in np.meshgrid(across, across, indexing="ij"))
    found = np.empty((6, ACROSS * ACROSS, AWAY))
    for face in range(6):
        axis = face // 2
        on_box = np.empty((len(a), 3))
        on_box[:, axis] = 2.0 * (face % 2) - 1.0
        on_box[:, (axis + 1) % 3], on_box[:, (axis + 2) % 3] = a, b
        for k, share in enumerate(inverse[1:], start=1):
            at = on_box * (1 / share + edges - e)
            distance = np.maximum(tree.query(at)[0] - off, 0.0)
            found[face, :, k] = share * ((at * at).sum(axis=1) - np.maximum(distance * distance - apart * apart, 0.0))
    # Infinitely far away: what E can be more there than at the next node.
    found[:, :, 0] = found[:, :, 1] + inverse[1] * reach * (2 * np.linalg.norm(edges - e) + reach)
    above = np.nextafter(found.astype(np.float32), np.float32(np.inf))
    return above.reshape(6, ACROSS, ACROSS, AWAY), reach


def _thinned(points: Array) -> tuple[Array, float]:
    """Points (M, 3), not very many, and how far any of those given (N, 3) is from the nearest at most, m."""
    if len(points) <= 8 * _MANY:
        points = np.unique(points, axis=0)
    if len(points) <= _MANY:
        return points, 0.0
    low, edge = points.min(axis=0), float(np.ptp(points, axis=0).max()) / _FINE
    cubes = np.floor((points - low) / edge).astype(np.int64)
    while True:
        one = np.unique((cubes[:, 0] * 2 * _FINE + cubes[:, 1]) * 2 * _FINE + cubes[:, 2])
        cubes = np.stack([one // (4 * _FINE**2), one // (2 * _FINE) % (2 * _FINE), one % (2 * _FINE)], axis=1)
        if len(cubes) <= _MANY:
            return low + edge * (cubes + 0.5), float(DIAGONAL * edge * (1 + 1e-9))
        cubes, edge = cubes // 2, 2 * edge
