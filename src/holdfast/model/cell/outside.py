"""Distance from a surface or a point cloud at any distance outside its box, from a small table.

A point p, with the box's centre as origin, is on a larger box whose faces are those of the first one, with half edges b, moved
outward by z. On face k ``p_k = +-(b_k + z)``, and along it ``p_i = a_i (b_i + z)`` with ``|a_i| <= 1``. With ``r = z + e`` for
a length e,

    E = (|p|^2 - d^2) / r = max_s (2 s.p / r - |s|^2 / r)

over all s of the surface is convex in ``p / r`` and ``1 / r``, because it is a maximum of affine functions. Both are affine in
each of ``a_i`` and ``1 / r``, so trilinear interpolation in these has the right mean. Its value of E is never too small
(Jensen), and the resulting distance never too large. The two are equal wherever the same s is the nearest to all nodes of a
cell.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray
from holdfast.model.cell.nodes import HALF_DIAGONAL, NodeGrid

FACE_NODES = 33  # nodes along the edges of a face
RADIAL_NODES = 17  # nodes of 1 / r, from 0, with quadratic spacing
_MAX_SURFACE_POINTS = 1 << 16  # points among which a search is fast
_CUBES_PER_EDGE = 1 << 10  # cubes along an edge


def half_edges(grid: NodeGrid) -> FloatArray:
    """Return half the edges (3,) of a grid's box, m."""
    return np.asarray(grid.width * (np.array(grid.shape) - 1) / 2)


def radial_offset(grid: NodeGrid) -> float:
    """Return the length e, m."""
    return float(half_edges(grid).max() / 2 + grid.width)


def largest_inverse_distance(grid: NodeGrid) -> float:
    """Return the largest 1 / r, 1/m: that of one width inside the box of a grid."""
    return float(2 / half_edges(grid).max())


def tabulate_outside_distances(grid: NodeGrid, samples: FloatArray, sample_gap: float) -> tuple[NDArray[np.float32], float]:
    """Return E and the distance of the farthest sample from the center of the grid, m.

    E, (6, ACROSS, ACROSS, AWAY), m, is rounded up: faces (low x, high x, low y, ...), the two coordinates that follow, 1 / r.

    Args:
        grid: Grid with the box.
        samples: (N, 3) points of the surface, m, in the frame of the grid. The square of the distance from the nearest of them
            exceeds that from the surface by at most ``sample_gap**2``.
        sample_gap: Bound for the gap between samples, m.
    """
    from scipy.spatial import cKDTree

    half_sizes, offset = half_edges(grid), radial_offset(grid)
    centered = samples - (grid.origin + half_sizes)
    enclosing_radius = float(np.sqrt((centered * centered).sum(axis=1).max()))
    thinned, thinning_error = _subsample_points(centered)
    tree = cKDTree(thinned)
    inverse_distances = largest_inverse_distance(grid) * np.linspace(0, 1, RADIAL_NODES) ** 2
    face_coordinates = np.linspace(-1, 1, FACE_NODES)
    first_coordinates, second_coordinates = (
        coordinates.ravel() for coordinates in np.meshgrid(face_coordinates, face_coordinates, indexing="ij")
    )
    table = np.empty((6, FACE_NODES * FACE_NODES, RADIAL_NODES))
    for face in range(6):
        axis = face // 2
        directions = np.empty((len(first_coordinates), 3))
        directions[:, axis] = 2.0 * (face % 2) - 1.0
        directions[:, (axis + 1) % 3], directions[:, (axis + 2) % 3] = first_coordinates, second_coordinates
        for radial_index, inverse_distance in enumerate(inverse_distances[1:], start=1):
            points = directions * (1 / inverse_distance + half_sizes - offset)
            distance = np.maximum(tree.query(points)[0] - thinning_error, 0.0)
            table[face, :, radial_index] = inverse_distance * (
                (points * points).sum(axis=1) - np.maximum(distance * distance - sample_gap * sample_gap, 0.0)
            )
    # Infinitely far away: the largest excess of E over its value at the next node.
    table[:, :, 0] = table[:, :, 1] + inverse_distances[1] * enclosing_radius * (
        2 * np.linalg.norm(half_sizes - offset) + enclosing_radius
    )
    rounded_up = np.nextafter(table.astype(np.float32), np.float32(np.inf))
    return rounded_up.reshape(6, FACE_NODES, FACE_NODES, RADIAL_NODES), enclosing_radius


def _subsample_points(points: FloatArray) -> tuple[FloatArray, float]:
    """Return at most ``_MAX_SURFACE_POINTS`` points (M, 3), and the largest distance, m, of a point (N, 3) from them."""
    if len(points) <= 8 * _MAX_SURFACE_POINTS:
        points = np.unique(points, axis=0)
    if len(points) <= _MAX_SURFACE_POINTS:
        return points, 0.0
    corner, edge = points.min(axis=0), float(np.ptp(points, axis=0).max()) / _CUBES_PER_EDGE
    cube_indices = np.floor((points - corner) / edge).astype(np.int64)
    while True:
        codes = np.unique(
            (cube_indices[:, 0] * 2 * _CUBES_PER_EDGE + cube_indices[:, 1]) * 2 * _CUBES_PER_EDGE + cube_indices[:, 2]
        )
        cube_indices = np.stack(
            [
                codes // (4 * _CUBES_PER_EDGE**2),
                codes // (2 * _CUBES_PER_EDGE) % (2 * _CUBES_PER_EDGE),
                codes % (2 * _CUBES_PER_EDGE),
            ],
            axis=1,
        )
        if len(cube_indices) <= _MAX_SURFACE_POINTS:
            return corner + edge * (cube_indices + 0.5), float(HALF_DIAGONAL * edge * (1 + 1e-9))
        cube_indices, edge = cube_indices // 2, 2 * edge
