"""Triangle meshes of an arm; each mesh is fixed in the frame of its link, so a motion changes only the frames."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.core.typing import FloatArray
from holdfast.model.arm.model import Arm

Color = tuple[int, int, int]

LINK_COLOR_RGB = (201, 208, 214)
JOINT_COLOR_RGB = (72, 84, 96)
CYLINDER_SIDES = 20
LINK_RADIUS_FRACTION = 0.017  # radius of a link, as a fraction of the length of the stretched arm


@dataclass(frozen=True)
class MeshPart:
    """Triangle mesh in the frame of a link.

    Attributes:
        frame: 0 for the base, k + 1 for a part that moves with joint k.
        vertices: (V, 3) vertices in the frame of the link, m.
        faces: (F, 3) vertex indices of the triangles.
        color: RGB, 0 to 255.
        joint: Index, from 0, of the joint that the part represents; None for a link.
        tube: Start (3,), end (3,) and radius, m, of a part that is a cylinder; None for other shapes.
    """

    frame: int
    vertices: FloatArray
    faces: NDArray[np.int64]
    color: Color
    joint: int | None = None
    tube: tuple[FloatArray, FloatArray, float] | None = None


def stretched_length(arm: Arm) -> float:
    """Return the length of the stretched arm, m, from which the sizes of all drawn parts are derived."""
    offsets = [float(np.linalg.norm(joint.origin[:3, 3])) for joint in arm.joints[1:]]
    strokes = [joint.upper - joint.lower for joint in arm.joints if joint.prismatic and np.isfinite(joint.upper - joint.lower)]
    return max(sum(offsets) + float(np.linalg.norm(arm.tool[:3, 3])) + sum(strokes), 1e-3)


def build_stick_parts(arm: Arm, size: float) -> list[MeshPart]:
    """Build the stick model from the kinematics: tubes for links, cylinders for revolute joints, blocks on rails for prismatic
    ones.
    """
    radius = LINK_RADIUS_FRACTION * size
    parts = [_make_cylinder_part(0, np.array([0, 0, -0.3 * radius]), np.zeros(3), 4.5 * radius, JOINT_COLOR_RGB)]
    for frame in range(arm.n + 1):
        end = arm.joints[frame].origin[:3, 3] if frame < arm.n else arm.tool[:3, 3]
        if np.linalg.norm(end) > 0.5 * radius:
            parts.append(_make_cylinder_part(frame, np.zeros(3), end, radius, LINK_COLOR_RGB))
    for index, joint in enumerate(arm.joints):
        if joint.prismatic:
            lower, upper = (
                limit if np.isfinite(limit) else sign * 0.3 * size for limit, sign in ((joint.lower, -1), (joint.upper, 1))
            )
            start = joint.origin[:3, 3]
            axis = joint.origin[:3, :3] @ joint.axis
            if upper - lower > radius:
                parts.append(
                    _make_cylinder_part(index, start + lower * axis, start + upper * axis, 0.6 * radius, LINK_COLOR_RGB)
                )
            parts.append(MeshPart(index + 1, *mesh_block(joint.axis, 3.6 * radius), JOINT_COLOR_RGB, index))
        else:
            half_axis = 1.9 * radius * joint.axis
            parts.append(_make_cylinder_part(index + 1, -half_axis, half_axis, 1.75 * radius, JOINT_COLOR_RGB, index))
    return parts


def _make_cylinder_part(
    frame: int, start: FloatArray, end: FloatArray, radius: float, color: Color, joint: int | None = None
) -> MeshPart:
    return MeshPart(frame, *mesh_cylinder(start, end, radius), color, joint, (start, end, radius))


def mesh_cylinder(start: FloatArray, end: FloatArray, radius: float) -> tuple[FloatArray, NDArray[np.int64]]:
    """Return a closed cylinder from start to end (3,), as vertices (V, 3) and faces (F, 3) with normals outwards."""
    axis = (end - start) / np.linalg.norm(end - start)
    radial = np.cross(axis, np.eye(3)[int(np.abs(axis).argmin())])
    radial /= np.linalg.norm(radial)
    angles = np.linspace(0, 2 * np.pi, CYLINDER_SIDES, endpoint=False)
    ring = radius * (np.cos(angles)[:, None] * radial + np.sin(angles)[:, None] * np.cross(axis, radial))
    # The rings are duplicated, so that the side and the ends are shaded separately.
    vertices = np.concatenate([start + ring, end + ring, start + ring, end + ring, [start, end]])
    corner = np.arange(CYLINDER_SIDES)
    next_corner = (corner + 1) % CYLINDER_SIDES
    side_faces = [
        np.stack([corner, next_corner, next_corner + CYLINDER_SIDES], 1),
        np.stack([corner, next_corner + CYLINDER_SIDES, corner + CYLINDER_SIDES], 1),
    ]
    start_faces = np.stack(
        [np.full(CYLINDER_SIDES, 4 * CYLINDER_SIDES), next_corner + 2 * CYLINDER_SIDES, corner + 2 * CYLINDER_SIDES], 1
    )
    end_faces = np.stack(
        [np.full(CYLINDER_SIDES, 4 * CYLINDER_SIDES + 1), corner + 3 * CYLINDER_SIDES, next_corner + 3 * CYLINDER_SIDES], 1
    )
    return vertices, np.concatenate([*side_faces, start_faces, end_faces]).astype(np.int64)


def mesh_block(axis: FloatArray, width: float) -> tuple[FloatArray, NDArray[np.int64]]:
    """Return a cube centred at the origin, with sides of ``width`` m and one edge along ``axis`` (3,)."""
    from scipy.spatial.transform import Rotation

    rotation, _ = Rotation.align_vectors(axis[None], np.array([[0.0, 0, 1]]))
    vertices, faces = mesh_box(np.full(3, width))
    return vertices @ rotation.as_matrix().T, faces


def mesh_box(size: FloatArray) -> tuple[FloatArray, NDArray[np.int64]]:
    """Return a box centred at the origin with side lengths (3,), m; its faces do not share vertices."""
    vertices: list[FloatArray] = []
    faces: list[NDArray[np.int64]] = []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            corners = np.zeros((4, 3))
            corners[:, axis] = sign
            corners[:, u], corners[:, v] = [-1, 1, 1, -1], [-1, -1, 1, 1]
            first_vertex = 4 * len(vertices)
            triangles = [[0, 1, 2], [0, 2, 3]] if sign > 0 else [[0, 2, 1], [0, 3, 2]]
            vertices.append(corners * size / 2)
            faces.append(np.array(triangles) + first_vertex)
    return np.concatenate(vertices), np.concatenate(faces).astype(np.int64)


def mesh_sphere(rings: int = 12) -> tuple[FloatArray, NDArray[np.int64]]:
    """Return a sphere of radius 1 centred at the origin, as vertices (V, 3) and faces (F, 3)."""
    polar_angles = np.linspace(0, np.pi, rings + 1)
    azimuths = np.linspace(0, 2 * np.pi, 2 * rings, endpoint=False)
    ring = np.stack([np.cos(azimuths), np.sin(azimuths), np.zeros(2 * rings)], 1)
    vertices = np.concatenate([np.sin(angle) * ring + [0, 0, np.cos(angle)] for angle in polar_angles])
    faces = []
    for ring_index in range(rings):
        corner = np.arange(2 * rings)
        next_corner = (corner + 1) % (2 * rings)
        a, b, c, d = (
            column + row * 2 * rings
            for column, row in (
                (corner, ring_index),
                (next_corner, ring_index),
                (corner, ring_index + 1),
                (next_corner, ring_index + 1),
            )
        )
        faces += [np.stack([a, c, b], 1), np.stack([b, c, d], 1)]
    return vertices, np.concatenate(faces).astype(np.int64)
