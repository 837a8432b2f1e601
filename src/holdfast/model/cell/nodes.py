"""Distances of the nodes of a grid from a surface or from points: exact nearby, bounded from below and above far away.

Nearby, each triangle is compared with the nodes around it. Far away, the distance transform of a grid of half the width gives
the distance to the nodes closest to the surface, which lies within half a diagonal of these nodes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels import Kernel

HALF_DIAGONAL = np.sqrt(3) / 2  # half the diagonal of a cube of edge 1
_BATCH_PAIRS = 1 << 19  # pairs of a part and a node, which fit into the cache of a processor
_MAX_PAIRS = 1 << 24
_BAND_WIDTHS = (3.0, 2.0, 1.5, 1.0)  # widths: range of exact distances; the first that is not too much work is used


@dataclass(frozen=True)
class NodeGrid:
    """Regular grid of nodes.

    Attributes:
        origin: (3,) position of the first node, m.
        width: Distance between neighbours, m.
        shape: Number of nodes along x, y and z.
    """

    origin: FloatArray
    width: float
    shape: tuple[int, int, int]

    @property
    def finer_grid(self) -> NodeGrid:
        """Grid with half the width, of which each second node is a node of this grid."""
        nodes_x, nodes_y, nodes_z = (2 * count - 1 for count in self.shape)
        return NodeGrid(self.origin, self.width / 2, (nodes_x, nodes_y, nodes_z))

    @staticmethod
    def enclose_box(lower: FloatArray, upper: FloatArray, rim_widths: float, max_nodes: int, min_width: float) -> NodeGrid:
        """Return the finest grid around a box that has at most ``max_nodes`` nodes and a rim of ``rim_widths`` widths."""
        size = upper - lower

        def count_nodes(width: float) -> IndexArray:
            return np.asarray(np.ceil(size / width + 2 * rim_widths).astype(np.int64) + 1)

        width = max(min_width, float(size.max()) / 1000)
        while count_nodes(width).astype(np.float64).prod() > max_nodes:
            width *= 1.02
        shape = count_nodes(width)
        origin = (lower + upper) / 2 - width * (shape - 1) / 2
        return NodeGrid(origin, width, (int(shape[0]), int(shape[1]), int(shape[2])))


@dataclass(frozen=True)
class DistanceParts:
    """Points or triangles from which distances are computed.

    Attributes:
        lower, upper: (M, 3) corners of the boxes around the parts, m.
        squared_distances: Function that returns squared distances, m^2, of points (P, 3) from the parts with numbers (P,).
    """

    lower: FloatArray
    upper: FloatArray
    squared_distances: Callable[[IndexArray, FloatArray], FloatArray]


def point_parts(centers: FloatArray) -> DistanceParts:
    """Return parts that are points (N, 3)."""

    def squared_distances(part_indices: IndexArray, positions: FloatArray) -> FloatArray:
        differences = positions - centers[part_indices]
        return np.asarray(np.einsum("ij,ij->i", differences, differences))

    return DistanceParts(centers, centers, squared_distances)


def triangle_parts(corners: FloatArray, max_edge: float) -> DistanceParts:
    """Return parts that are triangles (N, 3, 3), split until no edge is longer than ``max_edge``, m.

    Each triangle has its own frame: corner a at the origin, b on the first axis, c above it.
    """
    corners = split_triangles(corners, max_edge)
    origins, first_edges, second_edges = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    base_lengths = np.linalg.norm(first_edges, axis=1)
    x_axes = _normalize_rows(first_edges, np.array([1.0, 0.0, 0.0]))
    perpendicular = second_edges - np.einsum("ij,ij->i", second_edges, x_axes)[:, None] * x_axes
    fallback = np.cross(x_axes, np.eye(3)[np.abs(x_axes).argmin(axis=1)])
    y_axes = _normalize_rows(perpendicular, fallback)
    y_axes = _normalize_rows(y_axes - np.einsum("ij,ij->i", y_axes, x_axes)[:, None] * x_axes, fallback)
    frame = np.stack([x_axes, y_axes, np.cross(x_axes, y_axes)], axis=1)
    apex_x, apex_y = np.einsum("ij,ij->i", second_edges, x_axes), np.einsum("ij,ij->i", second_edges, y_axes)
    numbers = np.concatenate([origins, frame.reshape(-1, 9), np.stack([base_lengths, apex_x, apex_y], axis=1)], axis=1)

    distance_kernel = _triangle_distance_kernel()
    return DistanceParts(
        corners.min(axis=1),
        corners.max(axis=1),
        lambda part_indices, positions: distance_kernel(positions, numbers[part_indices]),
    )


@cache
def _triangle_distance_kernel() -> Kernel:
    """Return the kernel of squared distances (P,), m^2, of points (P, 3) from triangles (P, 15): a, a frame, b and c in it."""
    point, triangle = ca.SX.sym("at", 3), ca.SX.sym("row", 15)
    relative = point - triangle[:3]
    x, y, z = (ca.dot(relative, triangle[3 + 3 * axis : 6 + 3 * axis]) for axis in range(3))
    base_length, apex_x, apex_y = triangle[12], triangle[13], triangle[14]
    side_bc = apex_y * (base_length - x) - y * (base_length - apex_x)  # of the edge from b to c
    side_ca = apex_y * x - y * apex_x  # of the edge from c to a
    projects_inside = ca.logic_and(y >= 0, ca.logic_and(side_bc >= 0, side_ca >= 0))
    edge_distance = ca.fmin(
        _segment_distance(x, y, base_length, 0),
        ca.fmin(_segment_distance(x, y, apex_x, apex_y), _segment_distance(x - base_length, y, apex_x - base_length, apex_y)),
    )
    return Kernel("distance from a triangle", [point, triangle], [ca.if_else(projects_inside, 0, edge_distance) + z * z])


def _segment_distance(x: ca.SX, y: ca.SX, ex: ca.SX, ey: ca.SX) -> ca.SX:
    """Return the squared distance of a point in a plane from a segment that starts at the origin."""
    squared_length = ex * ex + ey * ey
    fraction = ca.fmin(ca.fmax((x * ex + y * ey) / ca.if_else(squared_length > 0, squared_length, 1), 0), 1)
    return (x - fraction * ex) ** 2 + (y - fraction * ey) ** 2


def _normalize_rows(rows: FloatArray, fallback: FloatArray) -> FloatArray:
    norms = np.linalg.norm(rows, axis=1, keepdims=True)
    return np.asarray(
        np.where(
            norms > 1e-12,
            rows / np.where(norms > 1e-12, norms, 1.0),
            fallback / np.linalg.norm(fallback, axis=-1, keepdims=True),
        )
    )


def split_triangles(corners: FloatArray, max_edge: float) -> FloatArray:
    """Split triangles at their longest edge until no edge is longer than ``max_edge``; the surface is unchanged."""
    finished = []
    while len(corners):
        edges = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
        is_long = edges.max(axis=1) > max_edge
        finished.append(corners[~is_long])
        corners, longest_edge = corners[is_long], edges[is_long].argmax(axis=1)
        indices = np.arange(len(corners))
        edge_start = corners[indices, longest_edge]
        edge_end = corners[indices, (longest_edge + 1) % 3]
        apex = corners[indices, (longest_edge + 2) % 3]
        midpoint = (edge_start + edge_end) / 2
        corners = np.concatenate([np.stack([edge_start, midpoint, apex], axis=1), np.stack([midpoint, edge_end, apex], axis=1)])
    return np.concatenate(finished)


# ---- distances without a sign ------------------------------------------------------------------------------------


def node_distance_bounds(grid: NodeGrid, parts: DistanceParts) -> tuple[FloatArray, FloatArray]:
    """Return lower and upper bounds of the distance of every node from the nearest part, m, equal where they are exact."""
    from scipy.ndimage import distance_transform_edt

    fine_grid = grid.finer_grid
    half_diagonal = HALF_DIAGONAL * fine_grid.width
    is_seed = _distances_within_band(fine_grid, parts, half_diagonal * (1 + 1e-9)) <= half_diagonal * (1 + 1e-9)
    # The nearest seed of each node; with distances, the transform would return seven times as many.
    nearest = distance_transform_edt(~is_seed, sampling=fine_grid.width, return_distances=False, return_indices=True)
    offsets = fine_grid.width * (nearest[:, ::2, ::2, ::2] - 2 * np.indices(grid.shape))
    far_distance = np.sqrt((offsets * offsets).sum(axis=0))
    band = (
        next(
            (band_width for band_width in _BAND_WIDTHS if _count_pairs(grid, parts, band_width * grid.width) <= _MAX_PAIRS),
            _BAND_WIDTHS[-1],
        )
        * grid.width
    )
    near_distance = _distances_within_band(grid, parts, band)
    is_exact = near_distance <= band
    return np.where(is_exact, near_distance, np.maximum(far_distance - half_diagonal * (1 + 1e-9), 0.0)), np.where(
        is_exact, near_distance, far_distance + half_diagonal * (1 + 1e-9)
    )


def _part_node_boxes(grid: NodeGrid, parts: DistanceParts, band: float) -> tuple[IndexArray, IndexArray]:
    """Return the first node and the numbers of nodes along x, y, and z, (M, 3) each, of the box around each part."""
    last_node = np.array(grid.shape) - 1
    first_node = np.clip(np.ceil((parts.lower - band - grid.origin) / grid.width), 0, last_node).astype(np.int64)
    final_node = np.clip(np.floor((parts.upper + band - grid.origin) / grid.width), -1, last_node).astype(np.int64)
    return first_node, np.maximum(final_node - first_node + 1, 0)


def _count_pairs(grid: NodeGrid, parts: DistanceParts, band: float) -> float:
    return float(_part_node_boxes(grid, parts, band)[1].astype(np.float64).prod(axis=1).sum())


def _distances_within_band(grid: NodeGrid, parts: DistanceParts, band: float) -> FloatArray:
    """Return the distance of every node from the nearest part, m, exact up to ``band``, infinite or larger elsewhere."""
    first_nodes, counts = _part_node_boxes(grid, parts, band)
    _, nodes_y, nodes_z = grid.shape
    squared_distances = np.full(int(np.prod(grid.shape)), np.inf)
    for part_indices, (i, j, k) in _part_node_pairs(first_nodes, counts):
        node = (i * nodes_y + j) * nodes_z + k
        positions = grid.origin + grid.width * np.stack([i, j, k], axis=1)
        np.minimum.at(squared_distances, node, parts.squared_distances(part_indices, positions))
    return np.asarray(np.sqrt(squared_distances).reshape(grid.shape))


def _part_node_pairs(
    first_nodes: IndexArray, counts: IndexArray
) -> Iterator[tuple[IndexArray, tuple[IndexArray, IndexArray, IndexArray]]]:
    """Yield batches of pairs of a part and a node in its box, given by three indices."""
    pair_counts = counts.prod(axis=1)
    ends = np.cumsum(pair_counts)
    start = 0
    while start < len(pair_counts):
        done_pairs = ends[start - 1] if start else 0
        stop = max(int(np.searchsorted(ends, done_pairs + _BATCH_PAIRS, side="right")), start + 1)
        part_indices = np.repeat(np.arange(start, stop), pair_counts[start:stop])
        pair_index = np.arange(len(part_indices)) - np.repeat(
            ends[start:stop] - pair_counts[start:stop] - done_pairs, pair_counts[start:stop]
        )
        box_counts, first_node = counts[part_indices], first_nodes[part_indices]
        remainder, k = np.divmod(pair_index, box_counts[:, 2])
        i, j = np.divmod(remainder, box_counts[:, 1])
        yield part_indices, (first_node[:, 0] + i, first_node[:, 1] + j, first_node[:, 2] + k)
        start = stop


# ---- the sign ----------------------------------------------------------------------------------------------------


def find_inside_nodes(grid: NodeGrid, vertices: FloatArray, faces: IndexArray, lower_distance: FloatArray) -> BoolArray:
    """Return the nodes inside a closed surface, and the nodes for which rounding leaves a doubt.

    The triangles above a node are counted with their orientation, along z and, as a check, along x. Neighbours that are both
    farther from the surface than half a width are on the same side of it, so they vote.

    Args:
        grid: Grid of the nodes.
        vertices: (V, 3) vertices, m.
        faces: (F, 3) triangles that face outward.
        lower_distance: Lower bound of the distance of each node, m.
    """
    from scipy.ndimage import label

    inside_along_z = _winding_numbers(grid, vertices, faces) != 0
    rotated_grid = NodeGrid(grid.origin[[1, 2, 0]], grid.width, (grid.shape[1], grid.shape[2], grid.shape[0]))
    inside_along_x = (_winding_numbers(rotated_grid, vertices[:, [1, 2, 0]], faces) != 0).transpose(2, 0, 1)
    groups, group_count = label(lower_distance > grid.width / 2 * (1 + 1e-9))
    votes = np.bincount(
        groups.ravel(), weights=(inside_along_z.astype(np.float64) + inside_along_x).ravel(), minlength=group_count + 1
    )
    is_inside = votes > np.bincount(groups.ravel(), minlength=group_count + 1)
    return np.where(groups > 0, is_inside[groups], inside_along_z | inside_along_x)


def _winding_numbers(grid: NodeGrid, vertices: FloatArray, faces: IndexArray) -> NDArray[np.int32]:
    """Return, negated, how often the surface is crossed outward minus inward along z up to each node."""
    corners = vertices[faces]
    flat_grid = NodeGrid(grid.origin * [1, 1, 0], grid.width, (grid.shape[0], grid.shape[1], 1))
    lower, upper = corners.min(axis=1) * [1, 1, 0], corners.max(axis=1) * [1, 1, 0]
    first_nodes, counts = _part_node_boxes(
        flat_grid, DistanceParts(lower, upper, lambda part_indices, positions: positions[:, 0]), 0.0
    )
    crossings = np.zeros((*grid.shape[:2], grid.shape[2] + 1), dtype=np.int32)
    for part_indices, (i, j, _) in _part_node_pairs(first_nodes, counts):
        x, y = grid.origin[0] + grid.width * i, grid.origin[1] + grid.width * j
        sides = []
        weights = []
        for corner in range(3):
            # Both triangles at an edge see it from the same end, so that a line through it crosses exactly one of them.
            edge_start, edge_end = faces[part_indices, corner], faces[part_indices, (corner + 1) % 3]
            forward = edge_start < edge_end
            start, end = vertices[np.where(forward, edge_start, edge_end)], vertices[np.where(forward, edge_end, edge_start)]
            signed_area = (end[:, 0] - start[:, 0]) * (y - start[:, 1]) - (end[:, 1] - start[:, 1]) * (x - start[:, 0])
            sides.append((signed_area >= 0) == forward)
            weights.append(np.where(forward, signed_area, -signed_area))
        faces_up = sides[0] & sides[1] & sides[2]
        is_hit = faces_up | ~(sides[0] | sides[1] | sides[2])
        if not is_hit.any():
            continue
        barycentric = np.stack([weights[1], weights[2], weights[0]], axis=1)[is_hit]  # of the corner that is not on the edge
        heights = corners[part_indices[is_hit], :, 2]
        weight_sums = barycentric.sum(axis=1)
        z = np.where(
            weight_sums != 0,
            (barycentric * heights).sum(axis=1) / np.where(weight_sums != 0, weight_sums, 1.0),
            heights.mean(axis=1),
        )
        z = np.clip(z, heights.min(axis=1), heights.max(axis=1))
        first_above = np.clip(np.ceil((z - grid.origin[2]) / grid.width), 0, grid.shape[2]).astype(np.int64)
        np.add.at(crossings, (i[is_hit], j[is_hit], first_above), np.where(faces_up[is_hit], 1, -1).astype(np.int32))
    return np.cumsum(crossings[:, :, :-1], axis=2, dtype=np.int32)
