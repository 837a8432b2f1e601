"""The objects of a cell as triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.cell.cell import Cell
from holdfast.cell.meshes import Mesh, Points
from holdfast.cell.solids import Box, Capsule, Cylinder, HalfSpace, Solid, Sphere
from holdfast.errors import InputError
from holdfast.present.arm.body import Color, Part, ball, box, tube

Array = NDArray[np.float64]
Faces = NDArray[np.int64]

OBJECT: Color = (205, 178, 126)
NEAREST: Color = (190, 30, 45)
_SPECKS = 3000  # points of a cloud that are drawn
_PLATE = 0.02  # thickness of what is drawn of a half space, as a share of its width


def body(solid: Solid, size: float) -> tuple[Array, Faces]:
    """Corners (V, 3) m in the object's own frame and triangles (F, 3) of what is drawn of it.

    Args:
        solid: The object.
        size: Half the width of the plate that stands for a half space, m.
    """
    if isinstance(solid, Box):
        return box(solid.size)
    if isinstance(solid, Cylinder):
        return tube(np.array([0, 0, -solid.length / 2]), np.array([0, 0, solid.length / 2]), solid.radius)
    if isinstance(solid, Sphere | Capsule):
        vertices, faces = ball()
        vertices = vertices * solid.radius
        if isinstance(solid, Capsule):  # the ball cut in two halves that lie apart
            vertices[:, 2] += np.where(vertices[:, 2] > 1e-12, 0.5, -0.5) * solid.length
        return vertices, faces
    if isinstance(solid, HalfSpace):
        vertices, faces = box(np.array([2 * size, 2 * size, 2 * _PLATE * size]))
        return vertices - [0, 0, _PLATE * size], faces
    if isinstance(solid, Mesh):
        return solid.surface.vertices, solid.surface.faces
    if isinstance(solid, Points):
        return _specks(solid)
    raise InputError(f"object '{solid.name}' cannot be drawn")


def _specks(cloud: Points) -> tuple[Array, Faces]:
    """A small tetrahedron for each of some thousand points, evenly chosen."""
    places = np.asarray(cloud.points)
    some = places[:: max(len(places) // _SPECKS, 1)]
    radius = max(cloud.radius, 0.004 * float(np.ptp(some, axis=0).max()))
    corners = radius * np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(3)
    sides = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    vertices = (some[:, None] + corners).reshape(-1, 3)
    return vertices, (sides + 4 * np.arange(len(some))[:, None, None]).reshape(-1, 3)


def parts(cell: Cell, base: ArrayLike, size: float) -> list[Part]:
    """The objects as parts of the base of an arm, which does not move.

    Args:
        cell: The cell.
        base: (4, 4) pose of that base in the world.
        size: As in :func:`body`.
    """
    into = np.linalg.inv(np.asarray(base, dtype=np.float64))
    out = []
    for solid in cell:
        vertices, faces = body(solid, size)
        pose = into @ solid.pose
        out.append(Part(0, vertices @ pose[:3, :3].T + pose[:3, 3], faces, OBJECT))
    return out
