"""Triangle meshes of the objects of a cell."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.body import Color, MeshPart, mesh_box, mesh_cylinder, mesh_sphere
from holdfast.model.cell.cell import Cell
from holdfast.model.cell.meshes import Mesh, Points
from holdfast.model.cell.solids import Box, Capsule, Cylinder, HalfSpace, Solid, Sphere

Faces = NDArray[np.int64]

OBJECT_COLOR_RGB: Color = (205, 178, 126)
_MAX_DRAWN_POINTS = 3000  # maximum number of drawn points of a point cloud
_PLATE_THICKNESS_FRACTION = 0.02  # thickness of the plate that represents a half space, as a fraction of its width


def mesh_solid(solid: Solid, size: float) -> tuple[FloatArray, Faces]:
    """Return the vertices (V, 3), m, in the frame of the object, and the triangles (F, 3) of the mesh that represents it.

    A half space is represented by a plate, of which ``size`` is the half width, m.

    Raises:
        InputError: The kind of object cannot be drawn.
    """
    if isinstance(solid, Box):
        return mesh_box(solid.size)
    if isinstance(solid, Cylinder):
        return mesh_cylinder(np.array([0, 0, -solid.length / 2]), np.array([0, 0, solid.length / 2]), solid.radius)
    if isinstance(solid, Sphere | Capsule):
        vertices, faces = mesh_sphere()
        vertices = vertices * solid.radius
        if isinstance(solid, Capsule):  # a sphere that is cut into two halves and pulled apart
            vertices[:, 2] += np.where(vertices[:, 2] > 1e-12, 0.5, -0.5) * solid.length
        return vertices, faces
    if isinstance(solid, HalfSpace):
        vertices, faces = mesh_box(np.array([2 * size, 2 * size, 2 * _PLATE_THICKNESS_FRACTION * size]))
        return vertices - [0, 0, _PLATE_THICKNESS_FRACTION * size], faces
    if isinstance(solid, Mesh):
        return solid.surface.vertices, solid.surface.faces
    if isinstance(solid, Points):
        return _mesh_point_cloud(solid)
    raise InputError(f"object '{solid.name}' cannot be drawn")


def _mesh_point_cloud(cloud: Points) -> tuple[FloatArray, Faces]:
    """Return a small tetrahedron for each point, or for at most some thousand evenly selected points."""
    points = np.asarray(cloud.points)
    chosen = points[:: max(len(points) // _MAX_DRAWN_POINTS, 1)]
    radius = max(cloud.radius, 0.004 * float(np.ptp(chosen, axis=0).max()))
    corners = radius * np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(3)
    sides = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    vertices = (chosen[:, None] + corners).reshape(-1, 3)
    return vertices, (sides + 4 * np.arange(len(chosen))[:, None, None]).reshape(-1, 3)


def build_cell_parts(cell: Cell, base: ArrayLike, size: float) -> list[MeshPart]:
    """Build the objects of a cell as parts that are fixed to the base of an arm, whose pose in the world is ``base`` (4, 4).

    ``size`` is the half width of the plate that represents a half space, m.
    """
    world_to_base = np.linalg.inv(np.asarray(base, dtype=np.float64))
    mesh_parts = []
    for solid in cell:
        vertices, faces = mesh_solid(solid, size)
        pose = world_to_base @ solid.pose
        mesh_parts.append(MeshPart(0, vertices @ pose[:3, :3].T + pose[:3, 3], faces, OBJECT_COLOR_RGB))
    return mesh_parts
