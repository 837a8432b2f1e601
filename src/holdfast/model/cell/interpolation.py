"""Interpolate a field and its gradient with two kernels that are compiled once for all fields, whose tables are inputs.

A point is looked up in two tables, the grid and the table for points outside: one kernel computes the indices, the other the
value.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray, IndexArray
from holdfast.kernels import Kernel
from holdfast.kernels.linalg import Vector
from holdfast.kernels.program import SX
from holdfast.model.cell.nodes import HALF_DIAGONAL
from holdfast.model.cell.outside import FACE_NODES, RADIAL_NODES

PARAMETER_COUNT = 10  # of a field: origin (3), width, last node (3), largest 1 / r, rim, radius
_MAX_NODE_INDEX = 1 << 20  # more nodes than any table has in a row


class FieldCoordinates(NamedTuple):
    """Coordinates of a point in the two tables of a field.

    Attributes:
        grid: (3,) coordinates in the grid, in widths from its first node.
        table: (3,) coordinates in the table for points outside, in steps from the first node of a face.
        face: Number of the face.
        outside_distance: Distance outside the box of the grid, m; below 0 inside.
        shifted_distance: Distance r of the table, m.
        centered: (3,) coordinates relative to the centre of the grid, m.
        half_edges: (3,) half the edges of the grid, m.
    """

    grid: Vector
    table: Vector
    face: SX
    outside_distance: SX
    shifted_distance: SX
    centered: Vector
    half_edges: Vector


@dataclass(frozen=True, eq=False)
class FieldTables:
    """Numbers of one field.

    Attributes:
        parameters: (FACTS,) parameters of the kernels.
        values: (X, Y, Z) values at the nodes of the grid.
        outside: (6, ACROSS, ACROSS, AWAY) values of the table for points outside.
    """

    parameters: FloatArray
    values: NDArray[np.float32]
    outside: NDArray[np.float32]


def interpolate_bounds(points: FloatArray, tables: Sequence[FieldTables], points_per_table: Sequence[int]) -> FloatArray:
    """Return bound and gradient, (N, 4), at points (N, 3), of which ``points_per_table[i]`` in turn belong to field i."""
    parameters = (
        np.repeat([field.parameters for field in tables], points_per_table, axis=0) if len(tables) > 1 else tables[0].parameters
    )
    coordinates = np.nan_to_num(_coordinate_kernel().rows(points, parameters))
    node_coordinates = np.clip(coordinates, 0, _MAX_NODE_INDEX).astype(np.int64)
    cells, corners = np.empty((len(points), 6)), np.empty((len(points), 16))
    ends = np.cumsum(points_per_table)
    for field, start, stop in zip(tables, ends - points_per_table, ends, strict=True):
        _read_cell_corners(field.values, node_coordinates[start:stop, :3], 0, cells[start:stop, :3], corners[start:stop, :8])
        _read_cell_corners(
            field.outside,
            node_coordinates[start:stop, 3:6],
            node_coordinates[start:stop, 6],
            cells[start:stop, 3:],
            corners[start:stop, 8:],
        )
    return _bound_kernel().rows(points, parameters, cells, corners)


def _read_cell_corners(
    table: NDArray[np.float32], coordinates: IndexArray, block: IndexArray | int, cells: FloatArray, corners: FloatArray
) -> None:
    """Write the cells (N, 3) of a block that contain coordinates (N, 3), or are nearest, and the values at corners (N, 8)."""
    x, y, z = table.shape[-3:]
    cell = np.minimum(coordinates, [x - 2, y - 2, z - 2])
    cells[:] = cell
    first_corner = ((block * x + cell[:, 0]) * y + cell[:, 1]) * z + cell[:, 2]
    corner_offsets = [(i * y + j) * z + k for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    corners[:] = table.reshape(-1)[first_corner[:, None] + corner_offsets]


@cache
def _coordinate_kernel() -> Kernel:
    """Return the kernel from a point (3,) and a field's parameters to its coordinates in the two tables and the face, (7,)."""
    point, parameters = ca.SX.sym("at", 3), ca.SX.sym("facts", PARAMETER_COUNT)
    coordinates = _field_coordinates(point, parameters)
    return Kernel(
        "place in a field", [point, parameters], [ca.vertcat(*coordinates.grid, *coordinates.table, coordinates.face)]
    )


@cache
def _bound_kernel() -> Kernel:
    """Return the kernel of bound and gradient (4,) from a point (3,), a field's parameters, cells (6,), and corners (16,)."""
    point, parameters, cells, corners = (
        ca.SX.sym(*x) for x in (("at", 3), ("facts", PARAMETER_COUNT), ("cells", 6), ("corners", 16))
    )
    coordinates, width = _field_coordinates(point, parameters), parameters[3]
    fractions = [x - cells[index] for index, x in enumerate(coordinates.grid)]
    grid_bound = _bound_in_grid(ca.vertsplit(corners[:8]), fractions, width)
    first_coordinate, second_coordinate, distance_coordinate = coordinates.table
    distance_node = cells[5]
    outside_fractions = [
        first_coordinate - cells[3],
        second_coordinate - cells[4],
        (distance_coordinate * distance_coordinate - distance_node * distance_node) / (2 * distance_node + 1),
    ]
    outside_bound = _bound_from_outside(ca.vertsplit(corners[8:]), outside_fractions, coordinates, parameters[8])
    weight = 1 + coordinates.outside_distance / width  # of the table for points outside
    value = ca.if_else(
        weight <= 0, grid_bound, ca.if_else(weight >= 1, outside_bound, grid_bound + weight * (outside_bound - grid_bound))
    )
    ball_bound = _safe_root(_sum_of_squares(coordinates.centered)) - parameters[9]
    value = ca.if_else(value < ball_bound, ball_bound, value)
    return Kernel("bound of a field", [point, parameters, cells, corners], [ca.vertcat(value, ca.gradient(value, point))])


def _field_coordinates(point: SX, parameters: SX) -> FieldCoordinates:
    width = parameters[3]
    half_edges = [width * parameters[4 + axis] / 2 for axis in range(3)]
    centered = [point[axis] - parameters[axis] - half_edges[axis] for axis in range(3)]
    overhang = [ca.fabs(centered[axis]) - half_edges[axis] for axis in range(3)]
    on_first_axis = ca.logic_and(overhang[0] >= overhang[1], overhang[0] >= overhang[2])
    on_second_axis = overhang[1] >= overhang[2]

    def pick_axis(v: Vector, k: int) -> SX:
        """Return the coordinate normal to the face for k = 0, then the coordinates that follow."""
        return ca.if_else(on_first_axis, v[k], ca.if_else(on_second_axis, v[(k + 1) % 3], v[(k + 2) % 3]))

    outside_distance = pick_axis(overhang, 0)
    face_distance = ca.if_else(outside_distance > -width, outside_distance, -width)  # deeper inside the table is not used
    face_coordinates = [pick_axis(centered, axis) / (pick_axis(half_edges, axis) + face_distance) for axis in (1, 2)]
    shifted_distance = face_distance + width + 1 / parameters[7]
    table = [
        *((coordinate + 1) * ((FACE_NODES - 1) / 2) for coordinate in face_coordinates),
        (RADIAL_NODES - 1) / ca.sqrt(shifted_distance * parameters[7]),
    ]
    face = 2 * ca.if_else(on_first_axis, 0.0, ca.if_else(on_second_axis, 1.0, 2.0)) + ca.if_else(
        pick_axis(centered, 0) > 0, 1.0, 0.0
    )
    return FieldCoordinates(
        [(point[axis] - parameters[axis]) / width for axis in range(3)],
        table,
        face,
        outside_distance,
        shifted_distance,
        centered,
        half_edges,
    )


def _bound_in_grid(corners: Vector, fractions: Vector, width: SX) -> SX:
    linear_bound = _interpolate_cube(corners, fractions) - HALF_DIAGONAL * width
    squared_bound = _interpolate_cube([ca.if_else(value > 0, value * value, 0.0) for value in corners], fractions)
    squared_bound -= width * width * sum(value * (1 - value) for value in fractions)
    improvement = _safe_root(squared_bound) - linear_bound
    blend = ca.if_else(squared_bound < width * width, squared_bound / (width * width), 1.0)
    return linear_bound + ca.if_else(ca.logic_and(squared_bound > 0, improvement > 0), blend * improvement, 0.0)


def _bound_from_outside(corners: Vector, fractions: Vector, coordinates: FieldCoordinates, rim_width: SX) -> SX:
    distance = _safe_root(
        _sum_of_squares(coordinates.centered) - coordinates.shifted_distance * _interpolate_cube(corners, fractions)
    )
    # A smaller box contains all of it as well.
    overhang = [ca.fabs(coordinates.centered[axis]) - coordinates.half_edges[axis] + rim_width for axis in range(3)]
    box_distance = _safe_root(_sum_of_squares([ca.if_else(overlap > 0, overlap, 0.0) for overlap in overhang]))
    return ca.if_else(distance < box_distance, box_distance, distance)


def _interpolate_cube(corners: Vector, fractions: Vector) -> SX:
    """Interpolate between the corners of a cube whose last coordinate changes first."""
    for fraction in fractions:
        middle = len(corners) // 2
        corners = [
            near_value + fraction * (far_value - near_value)
            for near_value, far_value in zip(corners[:middle], corners[middle:], strict=True)
        ]
    return corners[0]


def _sum_of_squares(vector: Vector) -> SX:
    return sum(component * component for component in vector)


def _safe_root(x: SX) -> SX:
    """Return the square root of x, or 0 with derivative 0 where x is not positive."""
    return ca.if_else(x > 0, ca.sqrt(ca.if_else(x > 0, x, 1.0)), 0.0)
