"""Fast lower bounds of the distance from a surface or a point cloud, by tables."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.caching import cached_property
from holdfast.core.files.mesh import Triangles
from holdfast.core.typing import FloatArray
from holdfast.kernels import cache
from holdfast.model.cell.interpolation import FieldTables, interpolate_bounds
from holdfast.model.cell.nodes import (
    HALF_DIAGONAL,
    NodeGrid,
    find_inside_nodes,
    node_distance_bounds,
    point_parts,
    split_triangles,
    triangle_parts,
)
from holdfast.model.cell.outside import (
    FACE_NODES,
    RADIAL_NODES,
    half_edges,
    largest_inverse_distance,
    tabulate_outside_distances,
)

# Grid, signed distances of its nodes, and the table for points outside.
FieldData = tuple[NodeGrid, FloatArray, NDArray[np.float32], float]

_CACHE_FORMAT = 3  # of the files in the cache; it changes with the computation
_MAX_NODES = 1_000_000
_MIN_NODE_SPACING_M = 1e-3  # m
_RIM_WIDTHS = 2.0  # widths
_MAX_EDGE_WIDTHS = 4.0  # widths: longest edge of the triangles to which nodes are compared
_BATCH_POINTS = 1 << 13  # points


@dataclass(frozen=True, eq=False)
class DistanceField:
    """Lower bound of a signed distance, from its values at the nodes of a grid and, outside the grid's box, on enlarged copies
    of its faces.

    Two bounds are interpolated in the grid. A signed distance changes by at most 1 m per m, so a value between the nodes
    differs from their mean, weighted as in trilinear interpolation, by at most half a diagonal of the grid's cubes. And ``|p|^2
    - d^2`` is convex, because it is the maximum of ``2 p.s - |s|^2`` over the surface, so outside ``d^2`` is at least its mean
    minus the mean of the squared distances of the nodes, ``w^2 sum t (1 - t)``. The second bound is the better one except next
    to the surface, where the first takes over gradually, so that the bound has no step. Nor does it have one at the edge of the
    grid, because within the outermost width one table passes over to the other; see :mod:`holdfast.model.cell.outside`.

    Attributes:
        grid: Nodes, in the object's own frame.
        values: Lower bound of the signed distance of each node, m.
        outside: (6, ACROSS, ACROSS, AWAY) table for points outside the grid, see
            :func:`holdfast.model.cell.outside.tabulate_outside_distances`.
        enclosing_radius: Largest distance of the object from the centre of the grid, m.
        offset: Length that is subtracted from the distance, m: the radius of the balls of a cloud.
    """

    grid: NodeGrid
    values: NDArray[np.float32]
    outside: NDArray[np.float32]
    enclosing_radius: float
    offset: float = 0.0

    @property
    def center(self) -> FloatArray:
        """Center (3,) of the grid, m."""
        return np.asarray(self.grid.origin + half_edges(self.grid))

    @property
    def max_underestimate(self) -> float:
        """Largest difference, m, between the signed distance that the nodes interpolate and the bound."""
        return float(HALF_DIAGONAL * self.grid.width)

    def distance_and_gradient(self, points: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return the bound (...,), m, and its gradient (..., 3) at points (..., 3), all in the object's own frame.

        The bound is never below the distance from the ball about ``center`` that contains the object, minus ``offset``.
        """
        point_array = np.asarray(points, dtype=np.float64)
        flat_points = point_array.reshape(-1, 3)
        parts = [flat_points[start : start + _BATCH_POINTS] for start in range(0, len(flat_points), _BATCH_POINTS)]
        results = np.concatenate([np.empty((0, 4)), *[interpolate_bounds(part, [self.tables], [len(part)]) for part in parts]])
        return results[:, 0].reshape(point_array.shape[:-1]) - self.offset, results[:, 1:].reshape(point_array.shape)

    @cached_property
    def tables(self) -> FieldTables:
        """Tables of the field, as inputs of the interpolation."""
        grid = self.grid
        last_node = np.array(grid.shape) - 1.0
        parameters = np.array(
            [
                *grid.origin,
                grid.width,
                *last_node,
                largest_inverse_distance(grid),
                _RIM_WIDTHS * grid.width,
                self.enclosing_radius,
            ]
        )
        return FieldTables(parameters, self.values, self.outside)


def surface_field(surface: Triangles, digest: str) -> DistanceField:
    """Return the field of the volume inside a closed surface, from the cache if it was computed before.

    Args:
        surface: Triangles that face outward, m.
        digest: SHA-256 of the triangles.
    """
    return _load_or_compute(digest, lambda: _compute_surface_field(surface), 0.0)


def cloud_field(centers: FloatArray, radius: float, digest: str) -> DistanceField:
    """Return the field of balls: the distance from the nearest center (N, 3), minus the radius, m."""
    return _load_or_compute(digest, lambda: _compute_cloud_field(centers), radius)


def _compute_surface_field(surface: Triangles) -> FieldData:
    corners = surface.vertices[surface.faces]
    grid = NodeGrid.enclose_box(
        surface.vertices.min(axis=0), surface.vertices.max(axis=0), _RIM_WIDTHS, _MAX_NODES, _MIN_NODE_SPACING_M
    )
    below, above = node_distance_bounds(grid, triangle_parts(corners, _MAX_EDGE_WIDTHS * grid.width))
    is_inside = find_inside_nodes(grid, surface.vertices, surface.faces, below)
    # The foot of a point on the surface is in a split triangle. A corner in the same plane, or on the same edge, is within the
    # longest edge over the root of 3 of the foot, and farther from the point by Pythagoras.
    max_edge = half_edges(grid).max() / FACE_NODES
    outside = tabulate_outside_distances(grid, split_triangles(corners, max_edge).reshape(-1, 3), max_edge / np.sqrt(3))
    return grid, np.where(is_inside, -above, below), *outside


def _compute_cloud_field(centers: FloatArray) -> FieldData:
    grid = NodeGrid.enclose_box(centers.min(axis=0), centers.max(axis=0), _RIM_WIDTHS, _MAX_NODES, _MIN_NODE_SPACING_M)
    return grid, node_distance_bounds(grid, point_parts(centers))[0], *tabulate_outside_distances(grid, centers, 0.0)


def _load_or_compute(digest: str, compute: Callable[[], FieldData], offset: float) -> DistanceField:
    """Return the field from the cache, or compute and store it."""
    cache_key = cache.cache_key(digest, "field", _CACHE_FORMAT, _MAX_NODES, _MIN_NODE_SPACING_M, FACE_NODES, RADIAL_NODES)
    cached = cache.load_entry(cache_key)
    if cached is not None:
        stored = np.load(io.BytesIO(cached), allow_pickle=False)
        values = stored["values"]
        x, y, z = values.shape
        grid = NodeGrid(stored["origin"], float(stored["width"]), (x, y, z))
        return DistanceField(grid, values, stored["beyond"], float(stored["reach"]), offset)
    grid, exact, outside, enclosing_radius = compute()
    values = np.nextafter(exact.astype(np.float32), np.float32(-np.inf))
    stream = io.BytesIO()
    np.savez(stream, values=values, beyond=outside, reach=enclosing_radius, origin=grid.origin, width=grid.width)
    cache.store_entry(cache_key, stream.getvalue())
    return DistanceField(grid, values, outside, enclosing_radius, offset)
