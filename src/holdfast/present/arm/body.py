"""What is drawn of an arm: triangles that sit still in a link's frame, so that a motion only moves frames."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm

Array = NDArray[np.float64]
Color = tuple[int, int, int]

LINK, JOINT = (201, 208, 214), (72, 84, 96)
SIDES = 20
THIN = 0.017  # radius of a link, as a share of the stretched arm


@dataclass(frozen=True)
class Part:
    """Triangles in the frame of a link.

    Attributes:
        frame: 0 for the base, k + 1 for what moves with joint k.
        vertices: (V, 3) m.
        faces: (F, 3) indices.
        color: RGB, 0 to 255.
        joint: The joint that it shows, from 0; None for a link.
        tube: Start (3,), end (3,) and radius, m, of what is a cylinder; None for anything else.
    """

    frame: int
    vertices: Array
    faces: NDArray[np.int64]
    color: Color
    joint: int | None = None
    tube: tuple[Array, Array, float] | None = None


def stretched(arm: Arm) -> float:
    """Length of the stretched arm, m: what things are drawn in proportion to."""
    offsets = [float(np.linalg.norm(j.origin[:3, 3])) for j in arm.joints[1:]]
    slides = [j.upper - j.lower for j in arm.joints if j.prismatic and np.isfinite(j.upper - j.lower)]
    return max(sum(offsets) + float(np.linalg.norm(arm.tool[:3, 3])) + sum(slides), 1e-3)


def stick_parts(arm: Arm, size: float) -> list[Part]:
    """Tubes for links, cylinders for revolute joints, blocks on rails for prismatic ones; from the kinematics alone."""
    radius = THIN * size
    parts = [_cylinder(0, np.array([0, 0, -0.3 * radius]), np.zeros(3), 4.5 * radius, JOINT)]
    for frame in range(arm.n + 1):
        end = arm.joints[frame].origin[:3, 3] if frame < arm.n else arm.tool[:3, 3]
        if np.linalg.norm(end) > 0.5 * radius:
            parts.append(_cylinder(frame, np.zeros(3), end, radius, LINK))
    for k, joint in enumerate(arm.joints):
        if joint.prismatic:
            low, high = (x if np.isfinite(x) else s * 0.3 * size for x, s in ((joint.lower, -1), (joint.upper, 1)))
            start = joint.origin[:3, 3]
            axis = joint.origin[:3, :3] @ joint.axis
            if high - low > radius:
                parts.append(_cylinder(k, start + low * axis, start + high * axis, 0.6 * radius, LINK))
            parts.append(Part(k + 1, *block(joint.axis, 3.6 * radius), JOINT, k))
        else:
            half = 1.9 * radius * joint.axis
            parts.append(_cylinder(k + 1, -half, half, 1.75 * radius, JOINT, k))
    return parts


def _cylinder(frame: int, start: Array, end: Array, radius: float, color: Color, joint: int | None = None) -> Part:
    return Part(frame, *tube(start, end, radius), color, joint, (start, end, radius))


def tube(start: Array, end: Array, radius: float) -> tuple[Array, NDArray[np.int64]]:
    """A closed cylinder from start to end (3,), as vertices (V, 3) and faces (F, 3) with normals outwards."""
    axis = (end - start) / np.linalg.norm(end - start)
    first = np.cross(axis, np.eye(3)[int(np.abs(axis).argmin())])
    first /= np.linalg.norm(first)
    angle = np.linspace(0, 2 * np.pi, SIDES, endpoint=False)
    ring = radius * (np.cos(angle)[:, None] * first + np.sin(angle)[:, None] * np.cross(axis, first))
    # Rings twice, so that the shading of the ends does not run into that of the side.
    vertices = np.concatenate([start + ring, end + ring, start + ring, end + ring, [start, end]])
    k = np.arange(SIDES)
    after = (k + 1) % SIDES
    side = [np.stack([k, after, after + SIDES], 1), np.stack([k, after + SIDES, k + SIDES], 1)]
    low = np.stack([np.full(SIDES, 4 * SIDES), after + 2 * SIDES, k + 2 * SIDES], 1)
    high = np.stack([np.full(SIDES, 4 * SIDES + 1), k + 3 * SIDES, after + 3 * SIDES], 1)
    return vertices, np.concatenate([*side, low, high]).astype(np.int64)


def block(axis: Array, width: float) -> tuple[Array, NDArray[np.int64]]:
    """A cube about the origin with one side along an axis."""
    from scipy.spatial.transform import Rotation

    turn, _ = Rotation.align_vectors(axis[None], np.array([[0.0, 0, 1]]))
    vertices, faces = box(np.full(3, width))
    return vertices @ turn.as_matrix().T, faces


def box(size: Array) -> tuple[Array, NDArray[np.int64]]:
    """A box about the origin with sides (3,), faces with corners of their own."""
    vertices: list[Array] = []
    faces: list[NDArray[np.int64]] = []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            corners = np.zeros((4, 3))
            corners[:, axis] = sign
            corners[:, u], corners[:, v] = [-1, 1, 1, -1], [-1, -1, 1, 1]
            at = 4 * len(vertices)
            order = [[0, 1, 2], [0, 2, 3]] if sign > 0 else [[0, 2, 1], [0, 3, 2]]
            vertices.append(corners * size / 2)
            faces.append(np.array(order) + at)
    return np.concatenate(vertices), np.concatenate(faces).astype(np.int64)


def ball(rings: int = 12) -> tuple[Array, NDArray[np.int64]]:
    """A sphere of radius 1 about the origin."""
    polar = np.linspace(0, np.pi, rings + 1)
    round_ = np.linspace(0, 2 * np.pi, 2 * rings, endpoint=False)
    ring = np.stack([np.cos(round_), np.sin(round_), np.zeros(2 * rings)], 1)
    vertices = np.concatenate([np.sin(t) * ring + [0, 0, np.cos(t)] for t in polar])
    faces = []
    for i in range(rings):
        k = np.arange(2 * rings)
        after = (k + 1) % (2 * rings)
        a, b, c, d = (x + y * 2 * rings for x, y in ((k, i), (after, i), (k, i + 1), (after, i + 1)))
        faces += [np.stack([a, c, b], 1), np.stack([b, c, d], 1)]
    return vertices, np.concatenate(faces).astype(np.int64)
